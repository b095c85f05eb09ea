// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/program.hpp"

#include <algorithm>
#include <utility>

#include "integrate/taylor/for_each_processor.hpp"
#include "integrate/taylor/most_order.hpp"

namespace earthtop::taylor {
namespace {

/// Calls `act(i)` for i below kCount, each with a number known at compile time: loops would keep packs in memory.
template <int kCount, class Act>
EARTHTOP_PACK_INLINE void each(const Act& act) {
  [&]<int... kNumber>(std::integer_sequence<int, kNumber...>) __attribute__((always_inline)) { (act(kNumber), ...); }
  (std::make_integer_sequence<int, kCount>());
}
template <int N, class T>
EARTHTOP_PACK_INLINE const typename PackOf<T, N>::Stored& pack_at(const T* numbers) {
  return *reinterpret_cast<const typename PackOf<T, N>::Stored*>(numbers);
}
template <int N, class T>
EARTHTOP_PACK_INLINE typename PackOf<T, N>::Stored& pack_at(T* numbers) {
  return *reinterpret_cast<typename PackOf<T, N>::Stored*>(numbers);
}
/// Puts together a pack of numbers from their places, and goes on to the next ones.
template <class T>
EARTHTOP_PACK_INLINE void gather(const T* numbers, const std::uint32_t*& places, Pack<T, 4>& gathered) {
  // Written into a variable in use, the numbers would be put in one by one.
  const Pack<T, 4> made{numbers[places[0]], numbers[places[1]], numbers[places[2]], numbers[places[3]]};
  gathered = made;
  places += 4;
}
/// A sum of terms, the first, third, .. and the others apart, so that the two sums do not have to wait for each other. A shorter
/// sum that is filled up to the length of its pack is so added up as in a pack of its own length.
/// @tparam kTerms  their number, `terms`; 0: any number of 3 or more
template <int kTerms, class T>
EARTHTOP_PACK_INLINE void add_terms(const T* numbers, const std::uint32_t*& places, const T*& factors, int terms,
                                    Pack<T, 4>& sum) {
  const auto add = [&](Pack<T, 4> & to) __attribute__((always_inline)) {
    Pack<T, 4> operands;
    gather(numbers, places, operands);
    to = to + pack_at<4>(factors) * operands;
    factors += 4;
  };
  gather(numbers, places, sum);
  sum = pack_at<4>(factors) * sum;
  factors += 4;
  if constexpr (kTerms > 0) {
    each<kTerms - 1>([&](int) __attribute__((always_inline)) { add(sum); });
  } else {
    Pack<T, 4> other{};
    int j = 1;
    for (; j + 1 < terms; j += 2) add(other), add(sum);
    if (j < terms) add(other);
    sum = sum + other;
  }
}

}  // namespace

template <class T>
Program<T>::Program(const Operations<T>& operations, int width)
    : width_(width), code_(program_code(operations)), given_(operations.given) {
  const std::size_t size = 2 * static_cast<std::size_t>(code_.lanes);
  rows_.assign(size * (kMostOrder<T> + 1), T(0)), sums_.assign(size, T(0));
  now_.assign(static_cast<std::size_t>(code_.places), T(0)), zero_ = next_ = now_;
  for (const auto& constant : code_.constants) zero_[static_cast<std::size_t>(constant.out)] = constant.number;
  given_rows_.assign(given_.size(), std::vector<std::array<T, 3>>(kMostOrder<T> + 1));
}

template <class T>
void Program<T>::start(std::span<const T> x, T t) {
  for (std::size_t i = 0; i < given_.size(); ++i) given_[i].expand(t, given_rows_[i]);
  T *left = row(0), *right = row(0) + code_.lanes;
  // The first order is odd; the sums of the even ones are made before they are read.
  std::fill(sums_.begin() + code_.lanes, sums_.end(), T(0));
  T* zero = zero_.data();
  const auto at = [&](int place) { return zero[place]; };
  std::ranges::copy(x, zero);
  for (const auto& run : code_.start_runs) {
    const std::span<const Instruction> instructions(code_.at_start.data() + run.begin, code_.at_start.data() + run.end);
    if (run.kind == Kind::linear) {
      for (const Instruction& in : instructions) {
        T sum = in.number;
        const auto *term = code_.start_terms.data() + in.first_term, *const end = term + in.terms;
        if (in.holds) {
          for (; term != end; ++term) {
            const T factor = term->factor * at(term->held);
            code_.factors[static_cast<std::size_t>(term->slot)] = factor;
            sum += factor * at(term->place);
          }
        } else {
          for (; term != end; ++term) sum += term->factor * at(term->place);
        }
        zero[in.out] = sum;
      }
    } else if (run.kind == Kind::product) {
      for (const Instruction& in : instructions) {
        const T a = at(in.a), b = at(in.b);
        zero[in.out] = a * b;
        if (in.lane >= 0) left[in.lane] = a, right[in.lane] = b;
      }
    } else {
      for (const Instruction& in : instructions) start_other(in, t);
    }
  }
}

template <class T>
void Program<T>::start_other(const Instruction& in, T t) {
  const auto at = [&](int place) { return zero_[static_cast<std::size_t>(place)]; };
  T* const left = row(0);
  T* const right = row(0) + code_.lanes;
  T& out = zero_[static_cast<std::size_t>(in.out)];
  const int l = in.lane;
  switch (in.kind) {
    case Kind::time: out = t; break;
    case Kind::given: out = given_rows_[static_cast<std::size_t>(in.a)][0][static_cast<std::size_t>(in.b)]; break;
    case Kind::held: out = at(in.a); break;
    case Kind::quotient:
      out = at(in.a) / at(in.b);
      if (l >= 0) left[l] = out, right[l] = at(in.b);
      break;
    case Kind::square_root:
      out = real::sqrt(at(in.a));
      if (l >= 0) left[l] = right[l] = out;
      break;
    case Kind::power:
      out = real::pow(at(in.a), in.number);
      if (l >= 0) left[l] = T(0), right[l] = out, left[l + 1] = at(in.a), right[l + 1] = T(0);
      break;
    case Kind::sine: {
      const SinCos<T> both = real::sin_cos(at(in.a));
      out = both.sin;
      zero_[static_cast<std::size_t>(in.out) + 1] = both.cos;
      if (l >= 0) left[l] = left[l + 1] = T(0), right[l] = both.cos, right[l + 1] = both.sin;
      break;
    }
    default: break;
  }
}

template <class T>
bool Program<T>::guards_hold() const {
  return std::ranges::all_of(code_.guards, [&](const Guard& guard) {
    return (zero_[static_cast<std::size_t>(guard.less)] < zero_[static_cast<std::size_t>(guard.more)]) == guard.outcome;
  });
}

/// Sweeps over the factors for two orders, since most of the time goes into loading them: sums the products with
/// j = 1 .. k - 1 of order k, and with j = 2 .. k - 1 of order k + 1, of some lanes whose sums fit into the processor.
template <class T>
template <int kWidth, int kPacks>
EARTHTOP_PACK_INLINE void Program<T>::sweep_lanes(int k, int lane) {
  const std::ptrdiff_t stride = 2 * code_.lanes;
  Pack<T, kWidth> even[kPacks], odd[kPacks], before[kPacks];
  const T* a = row(1) + lane;
  const T* b = row(k - 1) + code_.lanes + lane;
  each<kPacks>([&](int i) __attribute__((always_inline)) {
    before[i] = pack_at<kWidth>(b + i * kWidth);
    even[i] = pack_at<kWidth>(a + i * kWidth) * before[i];
    odd[i] = Pack<T, kWidth>{};
  });
  for (int j = 2; j < k; ++j) {
    a += stride, b -= stride;
    each<kPacks>([&](int i) __attribute__((always_inline)) {
      const Pack<T, kWidth> factor = pack_at<kWidth>(a + i * kWidth);
      odd[i] = odd[i] + factor * before[i];
      before[i] = pack_at<kWidth>(b + i * kWidth);
      even[i] = even[i] + factor * before[i];
    });
  }
  each<kPacks>([&](int i) __attribute__((always_inline)) {
    pack_at<kWidth>(sums_.data() + lane + i * kWidth) = even[i];
    pack_at<kWidth>(sums_.data() + code_.lanes + lane + i * kWidth) = odd[i];
  });
}
template <class T>
template <int kWidth>
EARTHTOP_PACK_INLINE void Program<T>::sweep(int k) {
  // Of a long double, 3 numbers for each of 2 lanes are what the x87's registers hold.
  constexpr int kPacks = kWidth == 1 ? 2 : 4, kLanes = kPacks * kWidth;
  int lane = 0;
  for (; lane + kLanes <= code_.lanes; lane += kLanes) sweep_lanes<kWidth, kPacks>(k, lane);
  // The number of lanes is a multiple of 8.
  if constexpr (kWidth == 8) {
    if (lane + 16 <= code_.lanes) sweep_lanes<8, 2>(k, lane), lane += 16;
    if (lane < code_.lanes) sweep_lanes<8, 1>(k, lane);
  } else if constexpr (kWidth == 4) {
    if (lane < code_.lanes) sweep_lanes<4, 2>(k, lane);
  }
}

/// Finds the state's coefficients of order k + 1. They are divided by it: the rounding of an inverse would be the same at every
/// step and add up to a phase error. @param found  the results of order k
template <class T>
EARTHTOP_PACK_INLINE void Program<T>::put_rates(const T* found, int k) {
  const std::uint32_t* places = code_.operands.data() + code_.first_output;
  const T order = T(k + 1);
  for (int i = 0; i < code_.components; i += 4) {
    Pack<T, 4> rate;
    gather(found, places, rate);
    pack_at<4>(next_.data() + i) = rate / order;
  }
}

template <class T>
template <bool kBegins>
EARTHTOP_PACK_INLINE void Program<T>::run_instruction(const Instruction& in, int k) {
  const T order = T(k);
  const auto now = [&](int place) -> T& { return now_[static_cast<std::size_t>(place)]; };
  const T *const left_0 = row(0) + in.lane, *const right_0 = left_0 + code_.lanes;
  const T* const inner = sums_.data() + (kBegins ? 0 : code_.lanes) + in.lane;
  const auto put = [&](int lane, T left, T right) {
    const std::ptrdiff_t l = in.lane + lane, r = l + code_.lanes;
    row(k)[l] = left, row(k)[r] = right;
    if constexpr (kBegins) sums_[static_cast<std::size_t>(r)] += row(1)[l] * right + left * row(1)[r];
  };
  const T a = now(in.a);
  T& out = now(in.out);
  switch (in.kind) {
    case Kind::quotient: {
      const T b = now(in.b);
      out = (a - (left_0[0] * b + inner[0])) / right_0[0];
      put(0, out, b);
      break;
    }
    case Kind::square_root:
      out = (a - inner[0]) / (left_0[0] + left_0[0]);
      put(0, out, out);
      break;
    case Kind::power: {
      const T slope = inner[0] + order * a * right_0[0];
      out = (in.number * slope - inner[1]) / (order * left_0[1]);
      put(0, order * a, out), put(1, a, order * out);
      break;
    }
    case Kind::sine: {
      const T rate = order * a;
      const T sine = (inner[0] + rate * right_0[0]) / order, cosine = -(inner[1] + rate * right_0[1]) / order;
      out = sine, now(in.out + 1) = cosine;
      put(0, rate, cosine), put(1, rate, sine);
      break;
    }
    default: break;
  }
}

/// @tparam kBegins  whether the order begins a pair, so that the next one needs two terms with factors of this one
template <class T>
template <bool kBegins>
EARTHTOP_PACK_INLINE void Program<T>::run_order(int k) {
  T* const now = now_.data();
  for (int i = 0; i < code_.components; i += 4) pack_at<4>(now + i) = pack_at<4>(next_.data() + i);
  for (const auto& given : code_.given) {
    const auto& rows = given_rows_[static_cast<std::size_t>(given.function)];
    now[given.out] = rows[static_cast<std::size_t>(k)][static_cast<std::size_t>(given.component)];
  }
  if (code_.time >= 0) now[code_.time] = k == 1 ? T(1) : T(0);

  T* out = now + code_.first_result;
  const std::uint32_t* operands = code_.operands.data();
  const T* factors = code_.factors.data();
  const Instruction* instruction = code_.instructions.data();
  std::ptrdiff_t lane = 0, right_lane = code_.lanes;
  T *const sums = sums_.data(), *const row_k = row(k);
  const T *const row_0 = row(0), *const row_1 = row(1);
  for (const int* step = code_.steps.data();; ++step) {
    Pack<T, 4> found, a, b;
    switch (*step) {
      case ProgramCode<T>::kEnd: return;
      case ProgramCode<T>::kInstruction: run_instruction<kBegins>(*instruction++, k); continue;
      case ProgramCode<T>::kProducts:
        gather(now, operands, a), gather(now, operands, b);
        pack_at<4>(row_k + lane) = a, pack_at<4>(row_k + right_lane) = b;
        found = pack_at<4>(row_0 + lane) * b + a * pack_at<4>(row_0 + right_lane);
        found = pack_at<4>(sums + (kBegins ? lane : right_lane)) + found;
        if constexpr (kBegins)
          pack_at<4>(sums + right_lane) =
              pack_at<4>(sums + right_lane) + (pack_at<4>(row_1 + lane) * b + a * pack_at<4>(row_1 + right_lane));
        lane += 4, right_lane += 4;
        break;
      case ProgramCode<T>::kSums + 1: add_terms<1>(now, operands, factors, 1, found); break;
      case ProgramCode<T>::kSums + 2: add_terms<2>(now, operands, factors, 2, found); break;
      default: add_terms<0>(now, operands, factors, *step - ProgramCode<T>::kSums, found);
    }
    pack_at<4>(out) = found;
    out += 4;
  }
}

template <class T>
template <int kWidth>
EARTHTOP_PACK_INLINE void Program<T>::expand_here(T* x, int order) {
  put_rates(zero_.data(), 0);
  for (int k = 1;; ++k) {
    x += code_.components;
    for (int i = 0; i < code_.components; ++i) x[i] = next_[static_cast<std::size_t>(i)];
    if (k == order) return;
    if (k % 2 == 0)
      sweep<kWidth>(k), run_order<true>(k);
    else
      run_order<false>(k);
    put_rates(now_.data(), k);
  }
}

template <class T>
void Program<T>::expand(T* x, int order) {
  if (order < 1) return;
  if constexpr (std::is_same_v<T, double>)
    expand_with_width(*this, x, order, width_);
  else
    expand_here<1>(x, order);
}

template class Program<double>;
template class Program<float80>;
template class Program<float128>;

}  // namespace earthtop::taylor
