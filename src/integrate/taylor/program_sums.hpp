// SPDX-License-Identifier: GPL-3.0-or-later
/// The orders at which a recorded right-hand side is needed, and its sums written out: as far as each is used only once, and
/// together with the factors that are held over a step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "integrate/taylor/operations.hpp"

namespace earthtop::taylor {

inline bool uses_b(Kind kind) {
  return kind == Kind::product || kind == Kind::quotient || kind == Kind::cosine || kind == Kind::linear;
}

/// Results are named by their places in the list of operations.
template <class T>
class ProgramSums {
 public:
  struct Term {
    int operand;
    T factor;
    int held = -1;  ///< another factor
    int slot = -1;
  };
  struct Sum {
    std::vector<Term> terms;
    T number = T(0);
  };

  explicit ProgramSums(const Operations<T>& operations) : list_(operations.list), source_(operations) {
    find_still();
    mark_needed();
    one();
    write_out_sums();
  }

 protected:
  static std::size_t index(int place) { return static_cast<std::size_t>(place); }
  template <class Use>
  void for_operands(const Operation<T>& o, Use use) const {
    if (has_operand(o.kind)) use(o.a);
    if (uses_b(o.kind) && o.b >= 0) use(o.b);
  }
  bool is_late(int i) const { return late_[index(i)] && !still_[index(i)]; }
  bool is_needed(int i) const { return late_[index(i)] || early_[index(i)]; }
  /// Whether a result is a sum of others with factors that are constant over a step.
  bool is_sum(int i) const {
    const Operation<T>& o = list_[index(i)];
    if (!is_late(i)) return false;
    if (o.kind == Kind::product) return still_[index(o.a)] || still_[index(o.b)];
    return o.kind == Kind::linear || (o.kind == Kind::quotient && still_[index(o.b)]);
  }
  /// Whether a sum is a part of the only sum that uses it.
  bool is_joined(int i) const { return is_sum(i) && uses_[index(i)] == 1; }
  /// The number of a sum's terms that have orders above 0.
  int length(int i) const {
    return static_cast<int>(
        std::ranges::count_if(sums_[index(i)].terms, [&](const Term& term) { return !still_[index(term.operand)]; }));
  }
  /// The number 1.
  int one() {
    if (one_ < 0) one_ = add_held({.kind = Kind::constant, .number = T(1)});
    return one_;
  }

  std::vector<Operation<T>> list_;  ///< with the operations on held results that are added
  const Operations<T>& source_;
  std::vector<bool> still_;  ///< results without any order but 0
  std::vector<Sum> sums_;

 private:
  /// Finds results that have no order but 0, apart from functions of state and time.
  void find_still() {
    for (const Operation<T>& o : list_) {
      bool all = is_number(o.kind) || has_operand(o.kind);
      if (o.kind != Kind::held) for_operands(o, [&](int operand) { all = all && still_[index(operand)]; });
      still_.push_back(all);
    }
  }
  /// Finds the operations that the outputs need at all orders (late), those that only guards and held results need (early), and
  /// how often each is used; a use by a sum counts half.
  void mark_needed() {
    late_.assign(list_.size(), false), early_.assign(list_.size(), false), uses_.assign(list_.size(), 0);
    for (const int output : source_.outputs) late_[index(output)] = true, uses_[index(output)] += 2;
    for (const Guard& guard : source_.guards)
      for (const int place : {guard.less, guard.more}) early_[index(place)] = true, uses_[index(place)] += 2;
    for (std::size_t i = list_.size(); i-- > 0;) {
      if (!late_[i] && !early_[i]) continue;
      const Operation<T>& o = list_[i];
      // Sine and cosine are computed together.
      if (o.kind == Kind::sine) (late_[i] ? late_ : early_)[i + 1] = true;
      for_operands(o, [&](int operand) {
        (late_[i] && o.kind != Kind::held ? late_ : early_)[index(operand)] = true;
        uses_[index(operand)] += is_sum(static_cast<int>(i)) ? 1 : 2;
      });
      if (o.kind == Kind::sine && late_[i + 1]) late_[i] = true;
    }
  }
  /// Adds an operation on results that are held over a step.
  int add_held(const Operation<T>& operation) {
    list_.push_back(operation);
    still_.push_back(true), late_.push_back(false), early_.push_back(true), uses_.push_back(2);
    return static_cast<int>(list_.size()) - 1;
  }
  int product_of_held(int a, int b) { return a < 0 ? b : b < 0 ? a : add_held({.kind = Kind::product, .a = a, .b = b}); }

  void add_number(T number, int held, Sum& sum) {
    if (number == T(0)) return;
    if (held < 0)
      sum.number += number;
    else
      add_term({one(), number, held}, sum);
  }
  static void add_term(const Term& term, Sum& sum) {
    const auto same =
        std::ranges::find_if(sum.terms, [&](const Term& t) { return t.operand == term.operand && t.held == term.held; });
    if (same != sum.terms.end())
      same->factor += term.factor;
    else
      sum.terms.push_back(term);
  }
  void add_operand(int operand, T factor, int held, Sum& sum) {
    const Operation<T>& o = list_[index(operand)];
    if (is_joined(operand))
      collect(operand, factor, held, sum);
    else if (is_number(o.kind))
      add_number(factor * o.number, held, sum);
    else
      add_term({operand, factor, held}, sum);
  }
  /// The terms of a sum; sums that are used only in this one are written out.
  void collect(int place, T factor, int held, Sum& sum) {
    const Operation<T> o = list_[index(place)];
    if (o.kind == Kind::linear) {
      add_number(factor * o.number, held, sum);
      add_operand(o.a, factor * o.factor_a, held, sum);
      if (o.b >= 0) add_operand(o.b, factor * o.factor_b, held, sum);
    } else if (o.kind == Kind::product) {
      const bool is_first = still_[index(o.a)];
      add_operand(is_first ? o.b : o.a, factor, product_of_held(held, is_first ? o.a : o.b), sum);
    } else if (const Operation<T>& divisor = list_[index(o.b)]; divisor.kind == Kind::constant) {
      add_operand(o.a, factor / divisor.number, held, sum);
    } else {
      const int inverse = add_held({.kind = Kind::quotient, .a = one(), .b = o.b});
      add_operand(o.a, factor, product_of_held(held, inverse), sum);
    }
  }
  void write_out_sums() {
    const int count = static_cast<int>(list_.size());
    sums_.resize(list_.size());
    for (int i = 0; i < count; ++i) {
      if (!is_needed(i) || is_joined(i)) continue;
      Sum sum;
      if (is_sum(i)) {
        collect(i, T(1), -1, sum);
      } else if (const Operation<T>& o = list_[index(i)]; o.kind == Kind::linear) {
        sum.number = o.number;
        sum.terms.push_back({o.a, o.factor_a});
        if (o.b >= 0) sum.terms.push_back({o.b, o.factor_b});
      }
      sums_[index(i)] = std::move(sum);
    }
    sums_.resize(list_.size());
  }

  std::vector<bool> late_, early_;
  std::vector<int> uses_;
  int one_ = -1;
};

}  // namespace earthtop::taylor
