// SPDX-License-Identifier: GPL-3.0-or-later
/// The Taylor stepper (taylor_stepper.hpp) for points side by side. It is included by sources that are each compiled for one
/// instruction set: everything in it is local to the source, and it uses nothing of the standard library or of Eigen.
///
/// The arithmetic of a lane is the same whatever the width of the vectors and whatever its neighbours do: basic operations in
/// one fixed order, never contracted, and no function whose last digit depends on a library.
#pragma once

#include "integrate/lanes/block.hpp"

#ifndef EARTHTOP_LANE_WIDTH
#error "the source says how many doubles its processor's vectors have"
#endif
#define EARTHTOP_LANE_INLINE [[gnu::always_inline]] inline

namespace earthtop::lanes {
namespace {

constexpr int kWidth = EARTHTOP_LANE_WIDTH, kChunks = kLanes / kWidth;
static_assert(kChunks * kWidth == kLanes);

using Pack = double __attribute__((vector_size(8 * kWidth)));
using Bits = long long __attribute__((vector_size(8 * kWidth)));

EARTHTOP_LANE_INLINE Pack spread(double x) { return x - Pack{}; }
EARTHTOP_LANE_INLINE Bits spread_bits(long long x) { return x - Bits{}; }
EARTHTOP_LANE_INLINE Pack larger(Pack a, Pack b) { return a > b ? a : b; }
EARTHTOP_LANE_INLINE Pack smaller(Pack a, Pack b) { return a < b ? a : b; }

/// The part of a row of doubles that belongs to one chunk, as many lanes as a vector of the processor holds.
using RowPart = double __attribute__((vector_size(8 * kWidth), may_alias));
EARTHTOP_LANE_INLINE Pack load(const Row& row, int chunk) { return reinterpret_cast<const RowPart*>(row.lane)[chunk]; }
EARTHTOP_LANE_INLINE void store(Row& row, int chunk, Pack value) { reinterpret_cast<RowPart*>(row.lane)[chunk] = value; }

struct Vec {
  Pack x, y, z;
};
EARTHTOP_LANE_INLINE Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
EARTHTOP_LANE_INLINE Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
EARTHTOP_LANE_INLINE Vec operator*(Pack a, const Vec& b) { return {a * b.x, a * b.y, a * b.z}; }
EARTHTOP_LANE_INLINE Pack dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
EARTHTOP_LANE_INLINE Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Adds the positive and the negative products of a x b to sums of their own, which are subtracted at the end: so no sum waits
/// for another.
EARTHTOP_LANE_INLINE void add_cross(const Vec& a, const Pack* b, Vec& plus, Vec& minus) {
  plus.x += a.y * b[2], minus.x += a.z * b[1];
  plus.y += a.z * b[0], minus.y += a.x * b[2];
  plus.z += a.x * b[1], minus.z += a.y * b[0];
}

/// The series of one chunk: the coefficients of order k, `kStored` packs in a row, follow those of order k - 1.
template <int kStored>
struct Coefficients {
  Pack* first;
  EARTHTOP_LANE_INLINE Pack* at(int k) const { return first + static_cast<long>(k) * kStored; }
  EARTHTOP_LANE_INLINE Pack get(int k, int variable) const { return at(k)[variable]; }
  EARTHTOP_LANE_INLINE Vec vector(int k, int variable) const {
    const Pack* p = at(k) + variable;
    return {p[0], p[1], p[2]};
  }
  EARTHTOP_LANE_INLINE void put(int k, int variable, Pack value) const { at(k)[variable] = value; }
  EARTHTOP_LANE_INLINE void put(int k, int variable, const Vec& v) const {
    Pack* p = at(k) + variable;
    p[0] = v.x, p[1] = v.y, p[2] = v.z;
  }
  /// The coefficient of order k of the cross product of two vectors.
  EARTHTOP_LANE_INLINE Vec cross(int k, int left, int right) const {
    Vec plus{}, minus{};
    const Pack *a = at(0) + left, *b = at(k) + right;
    for (int j = 0; j <= k; ++j, a += kStored, b -= kStored) add_cross(Vec{a[0], a[1], a[2]}, b, plus, minus);
    return plus - minus;
  }
};

/// log2 of a positive number, to 2e-6; about -1023 for 0, and about 1024 for infinity.
EARTHTOP_LANE_INLINE Pack logarithm(Pack x) {
  const Bits bits = reinterpret_cast<Bits>(x);
  // The last bits of the double 2^52 + n are n.
  const Bits offset = spread_bits(0x4330000000000000);
  const Bits biased = (bits >> 52) & spread_bits(0x7ff);
  const Pack exponent = reinterpret_cast<Pack>(biased | offset) - spread(4503599627370496.0 + 1023.0);
  const Pack part =
      reinterpret_cast<Pack>((bits & spread_bits(0x000fffffffffffff)) | spread_bits(0x3ff0000000000000));  // in [1, 2)
  const Pack root = spread(1.4142135623730951), z = (part - root) / (part + root), zz = z * z;
  const Pack odd = z * (spread(2.8853900817779268) + zz * (spread(0.96179669392597560) + zz * spread(0.57707801635558536)));
  return exponent + (spread(0.5) + odd);
}

/// 2^x to 3e-6, for x well within the range of exponents.
EARTHTOP_LANE_INLINE Pack power_of_two(Pack x) {
  const Pack rounder = spread(6755399441055744.0);  // 1.5 * 2^52: adding it rounds x to a whole number, in the last bits
  const Pack shifted = x + rounder, f = x - (shifted - rounder);
  const Pack part =
      spread(1.0) +
      f * (spread(0.69314718055994531) +
           f * (spread(0.24022650695910071) +
                f * (spread(0.055504108664821580) + f * (spread(0.0096181291076284772) + f * spread(0.0013333558146428443)))));
  const Bits whole = reinterpret_cast<Bits>(shifted) << 52;
  return reinterpret_cast<Pack>(reinterpret_cast<Bits>(part) + whole);
}

/// Takes one chunk of a block through one step.
/// @tparam Series  the equations, with
///   kVariables, kStored   number of state variables, and of all series kept, of which the state's are the first
///   kCoordinates          how many of the variables have equations of second order: these come first in the state, then as many
///                         velocities, which have no series of their own, then the variables with equations of first order
///   kGroups, kGroupCount  the component groups of the state, and their number
///   Series(constants, chunk), or Series(block, chunk) for recorded equations
///   start(c)              is given the state, as coefficients of order 0; velocities as those of order 1
///   extend(c, k)          finds the state's coefficients of order k + 1, those of coordinates of order k + 2, from all those
///                         below
///   turns(c, first, second)   if there are coordinates: the largest first and second coefficients of everything that turns,
///                         squared; otherwise they are those of the groups that turn
template <class Series>
struct Chunk {
  static constexpr int n = Series::kVariables, kStored = Series::kStored;
  static constexpr int kCoordinates = Series::kCoordinates;
  static_assert(n <= kMostVariables && kStored <= kMostStored && 2 * kCoordinates <= n);

  EARTHTOP_LANE_INLINE static Coefficients<kStored> coefficients(const Block& block, int chunk) {
    Pack* all = reinterpret_cast<Pack*>(const_cast<double*>(block.series[0].lane));
    return {all + static_cast<long>(chunk) * (kMostOrder + 1) * kStored};
  }

  /// log2 of the step at whose end the term of order k meets the tolerance.
  EARTHTOP_LANE_INLINE static Pack log_step(const Block& block, int chunk, const Coefficients<kStored>& c, int k) {
    Pack largest{};
    for (int g = 0; g < Series::kGroupCount; ++g) largest = larger(largest, square(c, k, g) / load(block.squares[g], chunk));
    return logarithm(spread(block.tolerance_squared) / largest) / spread(2.0 * k);
  }
  EARTHTOP_LANE_INLINE static Pack square(const Coefficients<kStored>& c, int k, int g) {
    const Group group = Series::kGroups[g];
    Pack sum{};
    for (int i = group.begin; i < group.begin + group.count; ++i) sum += c.get(k, i) * c.get(k, i);
    return sum;
  }

  static constexpr int kFirstOrder = 2 * kCoordinates;
  static constexpr bool is_velocity(int i) { return i >= kCoordinates && i < kFirstOrder; }
  /// The number of a variable's series.
  static constexpr int series_of(int i) { return i < kCoordinates ? i : i - kCoordinates; }
  /// A component at the beginning of the step.
  EARTHTOP_LANE_INLINE static Pack at_start(const Coefficients<kStored>& c, int i) {
    return c.get(is_velocity(i) ? 1 : 0, series_of(i));
  }
  /// The change of kCount coordinates and of their velocities. With U = c_2 + c_3 t + ..., the change of a coordinate is
  /// (c_1 + t U) t, and that of its velocity (2 U + t U') t; Horner's scheme gives U and U' together.
  template <int kCount>
  EARTHTOP_LANE_INLINE static void add_changes_of_both(const Coefficients<kStored>& c, int order, int begin, Pack dt,
                                                       const Row* rest, int chunk, Pack* change) {
    Pack value[kCount], slope[kCount];
    for (int i = 0; i < kCount; ++i) value[i] = c.get(order, begin + i), slope[i] = Pack{};
    for (int k = order - 1; k > 1; --k)
      for (int i = 0; i < kCount; ++i) {
        slope[i] = slope[i] * dt + value[i];
        value[i] = value[i] * dt + c.get(k, begin + i);
      }
    for (int i = 0; i < kCount; ++i) {
      const int velocity = begin + i + kCoordinates;
      change[begin + i] = (c.get(1, begin + i) + value[i] * dt) * dt + load(rest[begin + i], chunk);
      change[velocity] = (value[i] + value[i] + slope[i] * dt) * dt + load(rest[velocity], chunk);
    }
  }
  /// The change of kCount variables with equations of first order from the beginning of the step to the time dt after it,
  /// including their rests.
  template <int kCount>
  EARTHTOP_LANE_INLINE static void add_change(const Coefficients<kStored>& c, int order, int begin, Pack dt, const Row* rest,
                                              int chunk, Pack* change) {
    const int series = series_of(begin);
    Pack sum[kCount];
    for (int i = 0; i < kCount; ++i) sum[i] = c.get(order, series + i);
    for (int k = order - 1; k > 0; --k)
      for (int i = 0; i < kCount; ++i) sum[i] = sum[i] * dt + c.get(k, series + i);
    for (int i = 0; i < kCount; ++i) change[begin + i] = sum[i] * dt + load(rest[begin + i], chunk);
  }
  EARTHTOP_LANE_INLINE static void find_change(const Coefficients<kStored>& c, int order, Pack dt, const Row* rest, int chunk,
                                               Pack* change) {
    constexpr int kBoth = 4, kTogether = 8, kWith = n - kFirstOrder;
    static_assert(kCoordinates % kBoth == 0);
    for (int i = 0; i < kCoordinates; i += kBoth) add_changes_of_both<kBoth>(c, order, i, dt, rest, chunk, change);
    const int last = order - (kCoordinates > 0 ? 1 : 0);
    for (int i = 0; i + kTogether <= kWith; i += kTogether)
      add_change<kTogether>(c, last, kFirstOrder + i, dt, rest, chunk, change);
    if constexpr (kWith % kTogether != 0)
      add_change<kWith % kTogether>(c, last, kFirstOrder + kWith / kTogether * kTogether, dt, rest, chunk, change);
  }

  EARTHTOP_LANE_INLINE static void step(Block& block, int chunk) {
    const Coefficients<kStored> c = coefficients(block, chunk);
    for (int i = 0; i < n; ++i) c.put(is_velocity(i) ? 1 : 0, series_of(i), load(block.x[i], chunk));
    auto series = [&] {
      if constexpr (requires { Series(block, chunk); })
        return Series(block, chunk);
      else
        return Series(block.constants, chunk);
    }();
    series.start(c);
    const int order = block.order;
    for (int k = 0; k < order - (kCoordinates > 0 ? 1 : 0); ++k) series.extend(c, k);

    // The last two terms count, as one of them may vanish by symmetry.
    const Pack log_h = smaller(log_step(block, chunk, c, order), log_step(block, chunk, c, order - 1));
    const Pack h = smaller(power_of_two(log_h), load(block.longest, chunk));
    store(block.step, chunk, h);
    Pack change[n], not_finite{};
    find_change(c, order, h, block.rest, chunk, change);
    // The sum is compensated: what rounding leaves out of it goes into the next step's.
    for (int i = 0; i < n; ++i) {
      const Pack x = at_start(c, i), sum = x + change[i];
      store(block.rest_before[i], chunk, load(block.rest[i], chunk));
      store(block.rest[i], chunk, change[i] - (sum - x));
      store(block.x[i], chunk, sum);
      not_finite += sum - sum;
    }
    store(block.not_finite, chunk, not_finite);
    for (int g = 0; g < Series::kGroupCount; ++g) {
      const Group group = Series::kGroups[g];
      Pack size{};
      for (int i = group.begin; i < group.begin + group.count; ++i) size += load(block.x[i], chunk) * load(block.x[i], chunk);
      store(block.squares[g], chunk, larger(size, load(block.squares[g], chunk)));
    }
    Pack first{}, second{};
    if constexpr (kCoordinates > 0)
      series.turns(c, first, second);
    else
      for (int g = 0; g < Series::kGroupCount; ++g)
        if (Series::kGroups[g].turns) first = larger(square(c, 1, g), first), second = larger(square(c, 2, g), second);
    store(block.first_turn, chunk, first);
    store(block.second_turn, chunk, second);
  }

  EARTHTOP_LANE_INLINE static void evaluate(const Block& block, int chunk, const Row& after, Row* x) {
    const Coefficients<kStored> c = coefficients(block, chunk);
    Pack change[n];
    find_change(c, block.order, load(after, chunk), block.rest_before, chunk, change);
    for (int i = 0; i < n; ++i) store(x[i], chunk, at_start(c, i) + change[i]);
  }
};

template <class Series>
void step_block(Block& block) {
  for (int chunk = 0; chunk < kChunks; ++chunk) Chunk<Series>::step(block, chunk);
}
template <class Series>
void evaluate_block(const Block& block, const Row& after, unsigned wanted, Row* x) {
  constexpr unsigned kAll = (1U << static_cast<unsigned>(kWidth)) - 1U;
  for (int chunk = 0; chunk < kChunks; ++chunk)
    if ((wanted >> static_cast<unsigned>(chunk * kWidth) & kAll) != 0U) Chunk<Series>::evaluate(block, chunk, after, x);
}

}  // namespace
}  // namespace earthtop::lanes
