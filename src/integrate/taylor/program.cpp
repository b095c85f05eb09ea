// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/program.hpp"

#include <algorithm>
#include <utility>

#include "integrate/taylor/for_each_processor.hpp"
#include "integrate/taylor/products.hpp"

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
/// Four numbers from their places.
template <class T>
EARTHTOP_PACK_INLINE void gather(const T* numbers, const std::uint32_t* places, Pack<T, 4>& gathered) {
  gathered = Pack<T, 4>{numbers[places[0]], numbers[places[1]], numbers[places[2]], numbers[places[3]]};
}

}  // namespace

template <class T>
Program<T>::Program(const Operations<T>& operations) : code_(program_code(operations)), given_(operations.given) {
  const std::size_t size = static_cast<std::size_t>(code_.lanes) * (kMostOrder<T> + 1);
  left_.assign(size, T(0)), right_.assign(size, T(0));
  even_sums_.assign(static_cast<std::size_t>(code_.lanes), T(0)), odd_sums_ = even_sums_;
  now_.assign(static_cast<std::size_t>(code_.places), T(0)), zero_ = now_;
  for (const auto& constant : code_.constants) zero_[static_cast<std::size_t>(constant.out)] = constant.number;
  given_rows_.assign(given_.size(), std::vector<std::array<T, 3>>(kMostOrder<T> + 1));
}

template <class T>
void Program<T>::start(std::span<const T> x, T t) {
  for (std::size_t i = 0; i < given_.size(); ++i) given_[i].expand(t, given_rows_[i]);
  T *left = left_.data(), *right = right_.data();
  std::ranges::fill(odd_sums_, T(0));
  T* zero = zero_.data();
  const auto at = [&](int place) { return zero[place]; };
  std::ranges::copy(x, zero);
  for (const auto& run : code_.start_runs) {
    const std::span<const Instruction> instructions(code_.at_start.data() + run.begin, code_.at_start.data() + run.end);
    if (run.kind == Kind::linear) {
      for (const Instruction& in : instructions) {
        T sum = in.number;
        for (const auto *term = code_.start_terms.data() + in.first_term, *end = term + in.terms; term != end; ++term) {
          const T factor = term->factor * at(term->held);
          code_.factors[static_cast<std::size_t>(term->slot)] = factor;
          sum += factor * at(term->place);
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
  T* const left = left_.data();
  T* const right = right_.data();
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
  const std::ptrdiff_t lanes = code_.lanes;
  Pack<T, kWidth> even[kPacks], odd[kPacks], before[kPacks];
  const T* a = left_.data() + lanes + lane;
  const T* b = right_.data() + (k - 1) * lanes + lane;
  each<kPacks>([&](int i) __attribute__((always_inline)) {
    before[i] = pack_at<kWidth>(b + i * kWidth);
    even[i] = pack_at<kWidth>(a + i * kWidth) * before[i];
    odd[i] = Pack<T, kWidth>{};
  });
  for (int j = 2; j < k; ++j) {
    a += lanes, b -= lanes;
    each<kPacks>([&](int i) __attribute__((always_inline)) {
      const Pack<T, kWidth> factor = pack_at<kWidth>(a + i * kWidth);
      odd[i] = odd[i] + factor * before[i];
      before[i] = pack_at<kWidth>(b + i * kWidth);
      even[i] = even[i] + factor * before[i];
    });
  }
  each<kPacks>([&](int i) __attribute__((always_inline)) {
    pack_at<kWidth>(even_sums_.data() + lane + i * kWidth) = even[i];
    pack_at<kWidth>(odd_sums_.data() + lane + i * kWidth) = odd[i];
  });
}
template <class T>
template <int kWidth>
EARTHTOP_PACK_INLINE void Program<T>::sweep(int k) {
  constexpr int kLanes = 4 * kWidth;
  int lane = 0;
  for (; lane + kLanes <= code_.lanes; lane += kLanes) sweep_lanes<kWidth, 4>(k, lane);
  // The number of lanes is a multiple of 8.
  if constexpr (kWidth == 8) {
    if (lane + 16 <= code_.lanes) sweep_lanes<8, 2>(k, lane), lane += 16;
    if (lane < code_.lanes) sweep_lanes<8, 1>(k, lane);
  } else if constexpr (kWidth == 4) {
    if (lane < code_.lanes) sweep_lanes<4, 2>(k, lane);
  }
}

/// @tparam kBegins  whether the order begins a pair, so that the next one needs two terms with factors of this one
template <class T>
template <bool kBegins>
EARTHTOP_PACK_INLINE void Program<T>::run_products(const Run& run, int k) {
  using Four = Pack<T, 4>;
  const T* now = now_.data();
  T* out = now_.data() + run.out;
  const std::uint32_t* operands = code_.operands.data() + run.first;
  const T* inner = (kBegins ? even_sums_ : odd_sums_).data() + run.lane;
  T* odd = odd_sums_.data() + run.lane;
  T *left_k = row(left_, k) + run.lane, *right_k = row(right_, k) + run.lane;
  const T *left_0 = left_.data() + run.lane, *right_0 = right_.data() + run.lane;
  const T *left_1 = left_0 + code_.lanes, *right_1 = right_0 + code_.lanes;
  for (int i = 0; i < 4 * run.count; i += 4, operands += 8) {
    Four a, b;
    gather(now, operands, a), gather(now, operands + 4, b);
    pack_at<4>(left_k + i) = a, pack_at<4>(right_k + i) = b;
    pack_at<4>(out + i) = pack_at<4>(inner + i) + (pack_at<4>(left_0 + i) * b + a * pack_at<4>(right_0 + i));
    if constexpr (kBegins)
      pack_at<4>(odd + i) = pack_at<4>(odd + i) + (pack_at<4>(left_1 + i) * b + a * pack_at<4>(right_1 + i));
  }
}

/// @tparam kTerms  their number; 0: any
template <class T>
template <int kTerms>
EARTHTOP_PACK_INLINE void Program<T>::run_sums(const Run& run) {
  const T* now = now_.data();
  T* out = now_.data() + run.out;
  const std::uint32_t* operands = code_.operands.data() + run.first;
  const T* factors = code_.factors.data() + run.first_slot;
  const int terms = kTerms > 0 ? kTerms : run.terms;
  for (int i = 0; i < run.count; ++i, out += 4) {
    Pack<T, 4> sum, numbers;
    gather(now, operands, numbers);
    sum = pack_at<4>(factors) * numbers;
    operands += 4, factors += 4;
    for (int j = 1; j < terms; ++j, operands += 4, factors += 4) {
      gather(now, operands, numbers);
      sum = sum + pack_at<4>(factors) * numbers;
    }
    pack_at<4>(out) = sum;
  }
}

template <class T>
template <bool kBegins>
EARTHTOP_PACK_INLINE void Program<T>::run_instruction(const Instruction& in, int k) {
  const T order = T(k);
  const auto now = [&](int place) -> T& { return now_[static_cast<std::size_t>(place)]; };
  const T *left_0 = left_.data() + in.lane, *right_0 = right_.data() + in.lane;
  const T* inner = (kBegins ? even_sums_ : odd_sums_).data() + in.lane;
  const auto put = [&](int lane, T left, T right) {
    row(left_, k)[in.lane + lane] = left, row(right_, k)[in.lane + lane] = right;
    if constexpr (kBegins)
      odd_sums_[static_cast<std::size_t>(in.lane + lane)] +=
          left_0[code_.lanes + lane] * right + left * right_0[code_.lanes + lane];
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

template <class T>
template <bool kBegins>
EARTHTOP_PACK_INLINE void Program<T>::run_order(int k) {
  for (const auto& given : code_.given)
    now_[static_cast<std::size_t>(given.out)] =
        given_rows_[static_cast<std::size_t>(given.function)][static_cast<std::size_t>(k)]
                   [static_cast<std::size_t>(given.component)];
  if (code_.time >= 0) now_[static_cast<std::size_t>(code_.time)] = k == 1 ? T(1) : T(0);
  for (const Run& run : code_.runs) {
    if (run.kind == Kind::product) {
      run_products<kBegins>(run, k);
    } else if (run.kind == Kind::linear) {
      switch (run.terms) {
        case 1: run_sums<1>(run); break;
        case 2: run_sums<2>(run); break;
        case 3: run_sums<3>(run); break;
        default: run_sums<0>(run);
      }
    } else {
      for (int i = 0; i < run.count; ++i)
        run_instruction<kBegins>(code_.instructions[static_cast<std::size_t>(run.first + i)], k);
    }
  }
}

template <class T>
template <int kWidth>
EARTHTOP_PACK_INLINE void Program<T>::expand_here(T* x, int order) {
  const std::size_t size = code_.outputs.size();
  for (int k = 0; k < order; ++k, x += size) {
    if (k > 0) {
      for (std::size_t i = 0; i < size; ++i) now_[i] = x[i];
      if (k % 2 == 0)
        sweep<kWidth>(k), run_order<true>(k);
      else
        run_order<false>(k);
    }
    const T* found = (k > 0 ? now_ : zero_).data();
    const T factor = T(1) / T(k + 1);
    for (std::size_t i = 0; i < size; ++i) x[size + i] = found[static_cast<std::size_t>(code_.outputs[i])] * factor;
  }
}

template <class T>
void Program<T>::expand(T* x, int order) {
  if constexpr (std::is_same_v<T, double>)
    expand_for_processor(*this, x, order);
  else
    expand_here<4>(x, order);
}

template class Program<double>;
template class Program<long double>;
template class Program<float128>;

}  // namespace earthtop::taylor
