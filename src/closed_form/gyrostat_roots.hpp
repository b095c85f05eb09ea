// SPDX-License-Identifier: GPL-3.0-or-later
/// The roots between which the momentum of a free gyrostat moves along its rotor's axis, see `FreeGyrostat`.
///
/// With l = L / G the direction of the momentum, x = l3, a_i = G / I_i and the energy E,
///   (a1 - a2) l1^2 = A(x) = 2E/G - a3 (x - h/G)^2 - a2 (1 - x^2),   (a2 - a1) l2^2 = B(x), the same with a1,   x'^2 = -A B.
/// Roots may nearly coincide at the start, where a nutation is small, and at x = +-1, where the motion comes near the rotor's axis. So each
/// root is found from three points: from the start, where the constants are (a1 - a2) l1^2 and (a2 - a1) l2^2, and from x = -1 and 1, where
/// A and B are equal. Each distance keeps its digits however small it is.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "earthtop/frames/rotation.hpp"

namespace earthtop::gyrostat {

/// All constants are computed in 113 bits: near the separatrix, where two roots nearly coincide, digits are lost.
using Q = float128;

/// The points from which roots are found.
enum From : std::uint8_t { start, bottom, top };

/// The motion at the start.
struct Start {
  Vec3<Q> I, w, l;
  Q h, G;
  Q plus, minus;  ///< 1 + x and 1 - x

  /// With axes 2 and 3 reversed.
  Start reversed() const {
    Start made = *this;
    for (int i = 1; i < 3; ++i) made.w[i] = -w[i], made.l[i] = -l[i];
    made.h = -h;
    std::swap(made.plus, made.minus);
    return made;
  }
};

/// How many eps of a sum are lost by rounding its terms, not more than all digits.
inline Q lost(const Q& terms, const Q& sum) {
  return terms > Q(0) ? Q(terms / std::max(Q(real::epsilon<Q>() * terms), Q(real::abs(sum)))) : Q(1);
}

/// A for which = 0, B for which = 1, as a polynomial in x minus the point; `c0_loss` is what is lost in its constant.
struct Polynomial {
  std::array<Q, 3> c0, c1, c0_loss;
  Q c2, discriminant, discriminant_loss;

  Polynomial(const Start& s, int which) {
    const int other = 1 - which;                                                         // the moment that is its own
    const Q a = s.G / s.I[other], from_3 = (s.I[2] - s.I[other]) / s.I[other] / s.I[2];  // 1/I - 1/I3
    c2 = s.G * from_3;
    const Q inside = s.h / s.I[2];
    c0[start] = a * ((s.I[other] - s.I[which]) / s.I[which]) * s.l[which] * s.l[which];
    c1[start] = Q(2) * ((s.I[2] - s.I[other]) * s.w[2] + s.h) / s.I[other];
    // (a1 - a3) l1^2 + (a2 - a3) l2^2 -+ 2 (h/I3)(1 +- x)
    Q sum = Q(0), terms = Q(0);
    for (int i = 0; i < 2; ++i) {
      const Q term = s.G * ((s.I[2] - s.I[i]) / s.I[i] / s.I[2]) * s.l[i] * s.l[i];
      sum += term, terms += real::abs(term);
    }
    for (const auto& [point, of_h] :
         {std::pair{bottom, Q(Q(-2) * inside * s.plus)}, std::pair{top, Q(Q(2) * inside * s.minus)}}) {
      c0[point] = sum + of_h;
      c0_loss[point] = lost(Q(terms + real::abs(of_h)), c0[point]);
    }
    c0_loss[start] = Q(1);
    c1[bottom] = Q(2) * (inside - c2), c1[top] = Q(2) * (inside + c2);
    // The discriminant is the same from all points.
    for (std::size_t i = 0; i < 3; ++i) {
      const Q square = c1[i] * c1[i], product = Q(4) * c0[i] * c2, made = square - product;
      const Q loss = lost(Q(square + real::abs(product) * c0_loss[i]), made);
      if (i == 0 || loss < discriminant_loss) discriminant = made, discriminant_loss = loss;
    }
  }
  /// Both roots minus the point; infinite where the degree is less than 2.
  std::array<Q, 2> roots(std::size_t from) const {
    const Q infinite = std::numeric_limits<double>::infinity(), root = real::sqrt(discriminant);
    const bool negative = c1[from] < Q(0);
    const Q half = -(c1[from] + (negative ? -root : root)) / Q(2);
    const Q small = half != Q(0) ? Q(c0[from] / half) : c2 != Q(0) ? Q(0) : infinite;
    const Q large = c2 != Q(0) ? Q(half / c2) : infinite;
    return negative ? std::array{small, large}
                    : std::array{large, small};  // with minus and with plus the root of the discriminant
  }
};

struct Root {
  int of = 0;          ///< 0 of A, where l1 = 0; 1 of B, where l2 = 0
  std::array<Q, 3> x;  ///< minus each point
  std::array<Q, 3> loss{Q(1), Q(1), Q(1)};

  bool is_finite() const { return real::isfinite(x[start]); }
};

/// The distance of two roots from the point where it is best known, and what is lost in it.
struct Gap {
  Q size, loss;

  Gap(const Root& a, const Root& b) : size(0), loss(0) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Q made = a.x[i] - b.x[i];
      const Q lost_here = lost(Q(real::abs(a.x[i]) * a.loss[i] + real::abs(b.x[i]) * b.loss[i]), made);
      if (i == 0 || lost_here < loss) size = made, loss = lost_here;
    }
  }
};

struct Roots {
  Root low, high;        ///< the ends of the motion
  Root below, above;     ///< the next root below `low`, where the line of numbers is closed at infinity, and the fourth
  bool complex = false;  ///< whether these two are complex, instead: re +- i im, minus the start
  Q re = Q(0), im = Q(0);
  Q slope = Q(0);  ///< |derivative| of the polynomial of `low` there
  Q loss = Q(1);   ///< eps that the distances of roots have lost

  /// A distance over another, (x - a) / (y - a), which is 1 for an infinite a.
  static Q ratio(const Root& x, const Root& y, const Root& a) {
    return a.is_finite() ? Q(Gap(x, a).size / Gap(y, a).size) : Q(1);
  }
};

/// @param s  not at rest along x
inline Roots find_roots(const Start& s) {
  const std::array<Polynomial, 2> both = {Polynomial(s, 0), Polynomial(s, 1)};
  const Polynomial &A = both[0], &B = both[1];
  const bool rises_from_root =
      A.c1[start] * B.c0[start] + A.c0[start] * B.c1[start] < Q(0);  // where the start is itself an end
  Roots found;
  std::array<Root, 4> all;
  std::size_t count = 0;
  for (int i = 0; i < 2; ++i) {
    const Polynomial& one = both[static_cast<std::size_t>(i)];
    found.loss = std::max(found.loss, one.discriminant_loss);
    if (one.discriminant < Q(0)) {
      found.complex = true;
      found.re = -one.c1[start] / (Q(2) * one.c2), found.im = real::sqrt(-one.discriminant) / (Q(2) * real::abs(one.c2));
      continue;
    }
    for (std::size_t from = 0; from < 3; ++from) {
      const std::array<Q, 2> roots = one.roots(from);
      for (std::size_t k = 0; k < 2; ++k) {
        Root& root = all[count + k];
        root.of = i, root.x[from] = roots[k], root.loss[from] = one.c0_loss[from];
      }
    }
    count += 2;
  }
  std::size_t low = count, high = count;
  for (std::size_t i = 0; i < count; ++i) {
    if (!all[i].is_finite()) continue;
    const Q& z = all[i].x[start];
    const bool is_below = z < Q(0) || (z == Q(0) && rises_from_root);
    if (is_below && (low == count || z >= all[low].x[start])) low = i;
    if (!is_below && (high == count || z <= all[high].x[start])) high = i;
  }
  found.low = all[low % 4], found.high = all[high % 4];
  found.slope = real::sqrt(both[static_cast<std::size_t>(found.low.of)].discriminant);
  if (found.complex) return found;
  std::array<Root, 2> rest;
  for (std::size_t i = 0, made = 0; i < count && made < 2; ++i)
    if (i != low && i != high) rest[made++] = all[i];
  const auto comes_down_to = [&](const Root& root) { return root.is_finite() && root.x[start] <= found.low.x[start]; };
  const bool first = comes_down_to(rest[0]), second = comes_down_to(rest[1]);
  const bool in_order = first != second ? first : rest[0].x[start] > rest[1].x[start];
  found.below = rest[in_order ? 0 : 1], found.above = rest[in_order ? 1 : 0];
  for (const auto& [a, b] : {std::pair{found.low, found.below}, std::pair{found.high, found.above}})
    if (b.is_finite()) found.loss = std::max(found.loss, Gap(a, b).loss);
  return found;
}

}  // namespace earthtop::gyrostat
