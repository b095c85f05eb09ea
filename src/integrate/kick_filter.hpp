// SPDX-License-Identifier: GPL-3.0-or-later
/// How a kick is spread over the nutation, so that steps much longer than its period do not excite it, and how the ripple, which
/// such steps leave out, is found.
///
/// Along the large flow the perturbation is a sum of terms exp(i w t) with frequencies w = j n + k p, where n is the frequency
/// of the nutation, p that of the precession, and |k| <= 1. Spread with weights c_s over times t_s, a kick responds to such a
/// term by K(w) = sum c_s exp(i w t_s). It must be 1 for j = 0 and 0 for the others. The ripple is a sum of kicks with odd
/// weights a_s and sum a_s exp(i w t_s) = (1 - K(w)) / (i w).
///
/// `coarse` has five parts, and double zeros at the first two harmonics; it suffices where the precession is some 1e-4 of the
/// nutation or slower. `fine` has 17 parts; its response is right at each of the frequencies up to j = 4, |k| = 1. It goes
/// through its parts forward and back, with unequal weights (1 + d)/2 and (1 - d)/2. As the parts do not commute, this leaves an
/// effect of second order, proportional to d. Left out by averaging is another one, which is the secular effect of the nutation
/// on the perturbation. With the right d they are equal; this is the idea of multi-revolution composition methods (P. Chartier,
/// J. Makazaga, A. Murua, G. Vilmart 2014). The parts also fail to commute with a slow term and one at the frequency n: that
/// effect depends on the phase of the nutation, and would add up over steps in resonance with it. The weights are such that it
/// vanishes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "earthtop/real.hpp"

namespace earthtop {

template <class T>
struct KickFilter {
  static constexpr int kMostParts = 17, kMostRipples = 8;

  T period = T(0);
  int spacing = 1;  ///< interval between the parts, in thirds (coarse) or fifths (fine) of the period
  int parts = 1;    ///< an odd number
  std::array<T, static_cast<std::size_t>(kMostParts)> at{}, weight{T(1)};  ///< times, and weights of sum 1
  bool returns = false;   ///< whether the parts are gone through forward and back
  T second_order = T(0);  ///< d, times the weight of the kick
  int ripples = 0;        ///< pairs of kicks for the ripple
  std::array<T, static_cast<std::size_t>(kMostRipples)> ripple_at{}, ripple_weight{};  ///< of the later kick of each pair

  /// Flows for one kick, and for the ripple at one time.
  int flows() const { return returns ? 2 * parts - 1 : parts; }
  int ripple_flows() const { return ripples > 0 ? 2 * ripples + 1 : 0; }
};

namespace kick_filters {

template <class T>
KickFilter<T> coarse(T period, int spacing = 1) {
  KickFilter<T> f;
  f.period = period;
  f.spacing = spacing;
  f.parts = 5;
  for (int i = 0; i < 5; ++i) {
    const auto at = static_cast<std::size_t>(i);
    f.at[at] = T(i - 2) * T(spacing) * period / T(3);
    f.weight[at] = T(3 - std::abs(i - 2)) / T(9);
  }
  // The ripple is the integral of the kick times s / period - sign(s)/2 over the times s from half a period before the present
  // to half a period after it. These weights integrate the first three harmonics exactly: they are a discrete sine transform of
  // 1/k.
  f.ripples = 3;
  for (int i = 1; i <= 3; ++i) {
    T sum = T(0);
    for (int k = 1; k <= 3; ++k) sum += real::sin(T(k * i) * real::pi<T>() / T(4)) / T(k);
    f.ripple_at[static_cast<std::size_t>(i - 1)] = period * T(i) / T(8);
    f.ripple_weight[static_cast<std::size_t>(i - 1)] = -period * sum / (T(8) * real::pi<T>());
  }
  return f;
}

/// Returns the solution of A x = b, by Gauss's elimination with a search for the pivot.
template <std::size_t N>
std::array<float80, N> solved(std::array<std::array<float80, N>, N> A, std::array<float80, N> b) {
  for (std::size_t c = 0; c < N; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < N; ++r)
      if (real::abs(A[r][c]) > real::abs(A[pivot][c])) pivot = r;
    std::swap(A[c], A[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < N; ++r) {
      if (r == c) continue;
      const float80 times = A[r][c] / A[c][c];
      for (std::size_t k = c; k < N; ++k) A[r][k] -= times * A[c][k];
      b[r] -= times * b[c];
    }
  }
  for (std::size_t c = 0; c < N; ++c) b[c] /= A[c][c];
  return b;
}

/// @param ratio  of the precession's frequency to the nutation's   @param spacing  no multiple of 5
template <class T>
KickFilter<T> fine(T period, T ratio, int spacing = 1) {
  // In units of the period. A slower precession counts as none, but its equations are nearly dependent.
  constexpr float80 kLeastRatio{1e-3L};
  const float80 n = 2 * real::pi<float80>();
  const float80 p = n * std::max(static_cast<float80>(ratio), kLeastRatio);
  KickFilter<T> f;
  f.period = period;
  f.spacing = spacing;
  f.parts = 17;
  constexpr std::size_t kHalf = 8, kUnknown = kHalf;
  const float80 apart = float80(spacing) / 5;
  // To parts at fifths of the period, the third and fourth harmonics are the second and first ones backward.
  const std::array<std::pair<float80, float80>, kUnknown> responses{
      {{0, 1}, {p, 1}, {n - p, 0}, {n, 0}, {n + p, 0}, {2 * n - p, 0}, {2 * n, 0}, {2 * n + p, 0}}};
  std::array<std::array<float80, kUnknown>, kUnknown> A{};
  std::array<float80, kUnknown> b{}, of_last{};
  const auto response_to = [&](float80 frequency, std::size_t s) {
    return s == 0 ? float80(1) : 2 * real::cos(frequency * apart * static_cast<float80>(s));
  };
  for (std::size_t i = 0; i < kUnknown; ++i) {
    const auto [frequency, response] = responses[i];
    for (std::size_t s = 0; s < kUnknown; ++s) A[i][s] = response_to(frequency, s);
    b[i] = response;
    of_last[i] = -response_to(frequency, kHalf);
  }
  // The weight of the first and last part is free, and `secular` and `resonant`, the two effects of second order, are quadratic
  // in it: it is the smaller root of the latter.
  const auto without_last = solved<kUnknown>(A, b), for_last = solved<kUnknown>(A, of_last);
  constexpr std::size_t kParts = 2 * kHalf + 1;
  const auto offset = [](std::size_t part) { return static_cast<float80>(part) - static_cast<float80>(kHalf); };
  const auto weights = [&](float80 last) {
    std::array<float80, kParts> c{};
    for (std::size_t i = 0; i < kParts; ++i) {
      const std::size_t s = i < kHalf ? kHalf - i : i - kHalf;
      c[i] = s == kHalf ? last : without_last[s] + last * for_last[s];
    }
    return c;
  };
  std::array<float80, kParts> sine{};  // of the nutation's phase over this many intervals
  for (std::size_t i = 0; i < kParts; ++i) sine[i] = real::sin(n * apart * static_cast<float80>(i));
  const auto secular = [&](const std::array<float80, kParts>& c) {
    float80 sum = 0;
    for (std::size_t i = 0; i < kParts; ++i)
      for (std::size_t j = 0; j < i; ++j) sum += c[i] * c[j] * sine[i - j];
    return sum;
  };
  const auto resonant = [&](const std::array<float80, kParts>& c) {
    float80 sum = 0;
    for (std::size_t i = 0; i < kParts; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto phase_sine = [&](std::size_t part) { return part < kHalf ? -sine[kHalf - part] : sine[part - kHalf]; };
        sum += c[i] * c[j] * (phase_sine(i) - phase_sine(j));
      }
    return sum;
  };
  const float80 at_0 = resonant(weights(0)), at_1 = resonant(weights(1)), at_minus_1 = resonant(weights(-1));
  const float80 half_slope = (at_1 - at_minus_1) / 4, square = (at_1 + at_minus_1) / 2 - at_0;
  const float80 root = real::sqrt(std::max(half_slope * half_slope - square * at_0, float80(0)));
  const auto c = weights(-at_0 / (half_slope + (half_slope < 0 ? -root : root)));
  for (std::size_t i = 0; i < kParts; ++i) {
    f.at[i] = T(offset(i) * apart) * period;
    f.weight[i] = T(c[i]);
  }
  f.returns = true;
  f.second_order = T(1 / (n * secular(c))) * period;

  constexpr std::size_t kPairs = 8;
  const std::array<std::pair<float80, float80>, kPairs> ripples{{{p, 0},
                                                                 {n - p, 1 / (n - p)},
                                                                 {n, 1 / n},
                                                                 {n + p, 1 / (n + p)},
                                                                 {2 * n - p, 1 / (2 * n - p)},
                                                                 {2 * n, 1 / (2 * n)},
                                                                 {2 * n + p, 1 / (2 * n + p)},
                                                                 {3 * n, 1 / (3 * n)}}};
  std::array<std::array<float80, kPairs>, kPairs> R{};
  std::array<float80, kPairs> d{};
  for (std::size_t i = 0; i < kPairs; ++i) {
    for (std::size_t s = 0; s < kPairs; ++s) R[i][s] = 2 * real::sin(ripples[i].first * static_cast<float80>(s + 1) / 7);
    d[i] = -ripples[i].second;
  }
  const auto a = solved<kPairs>(R, d);
  f.ripples = kPairs;
  for (std::size_t s = 0; s < kPairs; ++s) {
    f.ripple_at[s] = T(static_cast<float80>(s + 1) / 7) * period;
    f.ripple_weight[s] = T(a[s]) * period;
  }
  return f;
}

}  // namespace kick_filters
}  // namespace earthtop
