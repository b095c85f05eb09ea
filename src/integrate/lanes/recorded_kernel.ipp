// SPDX-License-Identifier: GPL-3.0-or-later
/// The series of a recorded right-hand side for points side by side: what taylor::Program does for one. Each sum is added up in one
/// fixed order, whatever the width.
#pragma once

#include "integrate/lanes/kernel.ipp"
#include "integrate/lanes/lane_code.hpp"

namespace earthtop::lanes {
namespace {

/// @tparam Shape  the number of variables and the component groups of a state
template <class Shape>
class RecordedLanes {
 public:
  static constexpr int kVariables = Shape::kVariables, kStored = Shape::kVariables, kCoordinates = 0;
  static constexpr int kGroupCount = Shape::kGroupCount;
  static constexpr const Group* kGroups = Shape::kGroups;
  using C = Coefficients<kStored>;

  RecordedLanes(const Block& block, int chunk)
      : code_(*block.code),
        chunk_(chunk),
        zero_(part(code_.zero, code_.places)),
        present_(part(code_.present, code_.places)),
        factors_(part(code_.factors, code_.factor_count)),
        history_(part(code_.history, code_.slots * (kMostOrder + 1))),
        sums_(part(code_.sums, code_.packs * (2 * kPack))) {}

  void start(const C& c) const {
    for (int i = 0; i < kVariables; ++i) zero_[i] = c.get(0, i);
    for (int i = 0; i < code_.starts; ++i) start_instruction(code_.at_start[i], load(code_.start_numbers[i], chunk_));
    Pack off{};
    for (int i = 0; i < code_.guard_count; ++i) {
      const LaneGuard& guard = code_.guards[i];
      const Pack less = zero_[guard.less] < zero_[guard.more] ? spread(1.0) : Pack{};
      off = larger(off, guard.outcome != 0 ? spread(1.0) - less : less);
    }
    store(code_.off_branch, chunk_, off);
    // The first order is odd; the sums of the even ones are made before they are read.
    for (int i = 0; i < code_.packs * (2 * kPack); ++i) sums_[i] = Pack{};
    keep_factors(zero_, 0);
  }
  void extend(const C& c, int k) const {
    if (k > 0 && k % 2 == 0) sweep(k), find_order<true>(c, k);
    if (k % 2 != 0) find_order<false>(c, k);
    const RowPart* const found = k > 0 ? present_ : zero_;
    const Pack order = spread(k + 1);
    for (int i = 0; i < kVariables; ++i) c.put(k + 1, i, found[code_.operands[code_.first_output + i]] / order);
  }

 private:
  static constexpr int kPack = 4;

  EARTHTOP_LANE_INLINE RowPart* part(double* numbers, int count) const {
    return reinterpret_cast<RowPart*>(numbers) + static_cast<long>(chunk_) * count;
  }
  EARTHTOP_LANE_INLINE RowPart* factors_of(int k) const { return history_ + static_cast<long>(k) * code_.slots; }
  EARTHTOP_LANE_INLINE const int* slots_of_pack(int pack) const { return code_.product_slots + pack * (2 * kPack); }
  EARTHTOP_LANE_INLINE int left(int product) const { return slots_of_pack(product / kPack)[product % kPack]; }
  EARTHTOP_LANE_INLINE int right(int product) const { return slots_of_pack(product / kPack)[kPack + product % kPack]; }
  EARTHTOP_LANE_INLINE RowPart* sum(int product) const {
    return sums_ + static_cast<long>(product / kPack) * (2 * kPack) + product % kPack;
  }
  EARTHTOP_LANE_INLINE RowPart& odd_sum(int product) const { return sum(product)[kPack]; }
  EARTHTOP_LANE_INLINE void put_factors(int product, int k, Pack a, Pack b) const {
    RowPart* const factors = factors_of(k);
    factors[left(product)] = a, factors[right(product)] = b;
  }
  /// Keeps the results of order k that are factors.
  EARTHTOP_LANE_INLINE void keep_factors(const RowPart* results, int k) const {
    RowPart* const factors = factors_of(k);
    for (int slot = 0; slot < code_.result_slots; ++slot) factors[slot] = results[code_.slot_places[slot]];
  }
  /// Sums the products with j = 1 .. k - 1 of order k, and with j = 2 .. k - 1 of order k + 1, some orders at a time: their factors stay
  /// in the nearest memory while all products take them.
  void sweep(int k) const {
    constexpr int kOrders = 8;
    for (int begin = 1; begin < k; begin += kOrders) {
      const int end = begin + kOrders < k ? begin + kOrders : k;
      for (int pack = 0; pack < code_.packs; ++pack) {
        const int *l = slots_of_pack(pack), *r = l + kPack;
        RowPart* const sums = sum(pack * kPack);
        const RowPart *a = factors_of(begin), *b = factors_of(k - begin);
        Pack even[kPack], odd[kPack], before[kPack];
        int j = begin;
        if (begin == 1) {
          for (int i = 0; i < kPack; ++i) before[i] = b[r[i]], even[i] = a[l[i]] * before[i], odd[i] = Pack{};
          ++j, a += code_.slots, b -= code_.slots;
        } else {
          for (int i = 0; i < kPack; ++i) before[i] = b[code_.slots + r[i]], even[i] = sums[i], odd[i] = sums[kPack + i];
        }
        for (; j < end; ++j, a += code_.slots, b -= code_.slots)
          for (int i = 0; i < kPack; ++i) {
            const Pack factor = a[l[i]];
            odd[i] += factor * before[i];
            before[i] = b[r[i]];
            even[i] += factor * before[i];
          }
        for (int i = 0; i < kPack; ++i) sums[i] = even[i], sums[kPack + i] = odd[i];
      }
    }
  }
  template <class Function>
  EARTHTOP_LANE_INLINE static Pack of_each(Pack x, Function function) {
    Pack y{};
    for (int l = 0; l < kWidth; ++l) y[l] = function(x[l]);
    return y;
  }

  void start_instruction(const LaneInstruction& in, Pack number) const {
    switch (in.kind) {
      case kLinear: {
        Pack sum = number;
        for (int j = in.first_term; j < in.first_term + in.terms; ++j) {
          const LaneTerm& term = code_.start_terms[j];
          Pack factor = load(code_.start_factors[j], chunk_);
          if (in.holds != 0) {
            factor = factor * zero_[term.held];
            factors_[term.slot] = factor;
          }
          sum += factor * zero_[term.place];
        }
        zero_[in.out] = sum;
        break;
      }
      case kProduct: {
        const Pack a = zero_[in.a], b = zero_[in.b];
        zero_[in.out] = a * b;
        break;
      }
      case kTime: zero_[in.out] = load(code_.now, chunk_); break;
      case kGiven: zero_[in.out] = load(code_.given_rows[in.a], chunk_); break;
      case kHeld: zero_[in.out] = zero_[in.a]; break;
      case kQuotient: {
        const Pack b = zero_[in.b], out = zero_[in.a] / b;
        zero_[in.out] = out;
        if (in.product >= 0) put_factors(in.product, 0, out, b);
        break;
      }
      case kSquareRoot: {
        const Pack out = of_each(zero_[in.a], code_.square_root);
        zero_[in.out] = out;
        if (in.product >= 0) put_factors(in.product, 0, out, out);
        break;
      }
      case kPower: {
        const Pack a = zero_[in.a];
        Pack out{};
        for (int l = 0; l < kWidth; ++l) out[l] = code_.power(a[l], number[l]);
        zero_[in.out] = out;
        if (in.product >= 0) put_factors(in.product, 0, Pack{}, out), put_factors(in.product + 1, 0, a, Pack{});
        break;
      }
      case kSine: {
        const Pack a = zero_[in.a];
        Pack sine{}, cosine{};
        for (int l = 0; l < kWidth; ++l) {
          double of_sine = 0, of_cosine = 0;
          code_.sin_cos(a[l], &of_sine, &of_cosine);
          sine[l] = of_sine, cosine[l] = of_cosine;
        }
        zero_[in.out] = sine, zero_[in.out + 1] = cosine;
        if (in.product >= 0) put_factors(in.product, 0, Pack{}, cosine), put_factors(in.product + 1, 0, Pack{}, sine);
        break;
      }
      default: break;
    }
  }

  /// Finds the coefficients of order k of all results from those of the state.
  /// @tparam kBegins  whether the order begins a pair, so that the next one needs two terms with factors of this one
  template <bool kBegins>
  void find_order(const C& c, int k) const {
    for (int i = 0; i < kVariables; ++i) present_[i] = c.get(k, i);
    for (int i = 0; i < code_.givens; ++i)
      present_[code_.given[i].out] = load(code_.given_rows[code_.given[i].first + k], chunk_);
    if (code_.time >= 0) present_[code_.time] = k == 1 ? spread(1.0) : Pack{};
    const unsigned* operands = code_.operands;
    const RowPart* factors = factors_;
    RowPart* out = present_ + code_.first_result;
    int product = 0, instruction = 0;
    for (const int* step = code_.steps;; ++step) {
      if (*step == kEnd) return keep_factors(present_, k);
      if (*step == kOther) {
        find_other<kBegins>(code_.instructions[instruction], load(code_.instruction_numbers[instruction], chunk_), k);
        ++instruction;
        continue;
      }
      if (*step == kProducts) {
        const RowPart* const sums = sum(product);
        Pack a[kPack], b[kPack], found[kPack];
        for (int i = 0; i < kPack; ++i) a[i] = present_[operands[i]], b[i] = present_[operands[kPack + i]];
        for (int i = 0; i < kPack; ++i)
          found[i] = sums[kBegins ? i : kPack + i] + (zero_[operands[i]] * b[i] + a[i] * zero_[operands[kPack + i]]);
        if constexpr (kBegins) {
          const int *l = slots_of_pack(product / kPack), *r = l + kPack;
          const RowPart* const one = factors_of(1);
          for (int i = 0; i < kPack; ++i) odd_sum(product + i) += one[l[i]] * b[i] + a[i] * one[r[i]];
        }
        for (int i = 0; i < kPack; ++i) out[i] = found[i];
        operands += 2 * kPack, product += kPack;
      } else {
        const int terms = *step - kSums;
        Pack found[kPack];
        for (int i = 0; i < kPack; ++i) found[i] = factors[i] * present_[operands[i]];
        for (int j = 1; j < terms; ++j) {
          operands += kPack, factors += kPack;
          for (int i = 0; i < kPack; ++i) found[i] += factors[i] * present_[operands[i]];
        }
        operands += kPack, factors += kPack;
        for (int i = 0; i < kPack; ++i) out[i] = found[i];
      }
      out += kPack;
    }
  }
  static constexpr int kEnd = 0, kProducts = 1, kOther = 2, kSums = 3;

  template <bool kBegins>
  void find_other(const LaneInstruction& in, Pack number, int k) const {
    const Pack order = spread(k), a = present_[in.a];
    // The factors of order 0 of its products, and what is known of their sums.
    const auto left_first = [&](int i) { return Pack(factors_of(0)[left(in.product + i)]); };
    const auto right_first = [&](int i) { return Pack(factors_of(0)[right(in.product + i)]); };
    const auto inner = [&](int i) { return Pack(sum(in.product + i)[kBegins ? 0 : kPack]); };
    const auto put = [&](int i, Pack of_left, Pack of_right) {
      const int product = in.product + i;
      put_factors(product, k, of_left, of_right);
      if constexpr (kBegins)
        odd_sum(product) += factors_of(1)[left(product)] * of_right + of_left * factors_of(1)[right(product)];
    };
    switch (in.kind) {
      case kQuotient: {
        const Pack b = present_[in.b];
        const Pack out = (a - (left_first(0) * b + inner(0))) / right_first(0);
        present_[in.out] = out;
        put(0, out, b);
        break;
      }
      case kSquareRoot: {
        const Pack root = left_first(0), out = (a - inner(0)) / (root + root);
        present_[in.out] = out;
        put(0, out, out);
        break;
      }
      case kPower: {
        const Pack slope = inner(0) + order * a * right_first(0);
        const Pack out = (number * slope - inner(1)) / (order * left_first(1));
        present_[in.out] = out;
        put(0, order * a, out), put(1, a, order * out);
        break;
      }
      case kSine: {
        const Pack rate = order * a;
        const Pack sine = (inner(0) + rate * right_first(0)) / order;
        const Pack cosine = -(inner(1) + rate * right_first(1)) / order;
        present_[in.out] = sine, present_[in.out + 1] = cosine;
        put(0, rate, cosine), put(1, rate, sine);
        break;
      }
      default: break;
    }
  }

  LaneCode& code_;
  int chunk_;
  RowPart *zero_, *present_, *factors_, *history_, *sums_;
};

}  // namespace
}  // namespace earthtop::lanes
