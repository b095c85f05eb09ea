// SPDX-License-Identifier: GPL-3.0-or-later
/// A rotation angle as a smooth function of time, given by a table: the not-a-knot cubic spline through angles at given times.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "earthtop/frames/angle_table.hpp"
#include "earthtop/real.hpp"

namespace earthtop {

/// The piecewise cubic through the points of a table. Its first two derivatives are continuous, at the second and the
/// last-but-one time also the third: if the angles lie on a cubic polynomial, the spline is that polynomial [de Boor, A
/// Practical Guide to Splines, chapter IV]. Between samples of a smooth motion with spacing h the error of the angle is O(h^4),
/// of the rate O(h^3), of the acceleration O(h^2). Outside the table the first and the last cubic are continued.
template <class T>
class AngleSpline {
 public:
  /// @throws std::invalid_argument for a table that breaks the conditions of AngleTable, or with a number that is not finite
  explicit AngleSpline(const AngleTable& table);

  T angle(T t) const {
    const Piece& p = piece(t);
    const T u = t - p.start;
    return p.angle + u * (p.rate + u * (p.half_acceleration + u * p.sixth_jerk));
  }
  T angle_rate(T t) const {
    const Piece& p = piece(t);
    const T u = t - p.start;
    return p.rate + u * (T(2) * p.half_acceleration + u * T(3) * p.sixth_jerk);
  }
  /// The integral of the angle from 0 to t.
  T angle_integral(T t) const { return since_start(t) - since_start(T(0)); }
  T angle_acceleration(T t) const {
    const Piece& p = piece(t);
    return T(2) * p.half_acceleration + T(6) * (t - p.start) * p.sixth_jerk;
  }
  /// The coefficients of the powers of (t' - t) of the angle, up to the cube, just after t. A t that is earlier than a joint only
  /// by rounding counts as the joint.
  std::array<T, 4> cubic(T t) const { return cubic_of(piece(t + T(64) * real::epsilon<T>() * (real::abs(t) + T(1))), t); }
  /// The same of the piece that starts at t.
  std::array<T, 4> cubic_from(T t) const { return cubic_of(piece(t), t); }

  /// The largest absolute values of rate and acceleration within the table.
  T largest_rate() const;
  T largest_acceleration() const;
  /// The times at which the third derivative jumps.
  std::vector<T> joints() const;
  /// Whether every angle is zero.
  bool is_zero() const;

  /// The same function of time with times in units of 2^time_exponent s: exact, no digit changes.
  AngleSpline in_time_units(int time_exponent) const;

 private:
  /// The angle is angle + u (rate + u (half_acceleration + u sixth_jerk)) with u = t - start, until the next piece starts.
  struct Piece {
    T start, angle, rate, half_acceleration, sixth_jerk;
    T before = T(0);  ///< the integral of the angle up to `start`
  };
  static std::array<T, 4> cubic_of(const Piece& p, T t) {
    const T u = t - p.start;
    return {p.angle + u * (p.rate + u * (p.half_acceleration + u * p.sixth_jerk)),
            p.rate + u * (T(2) * p.half_acceleration + u * T(3) * p.sixth_jerk), p.half_acceleration + u * T(3) * p.sixth_jerk,
            p.sixth_jerk};
  }
  const Piece& piece(T t) const {
    const auto later = [](T at, const Piece& p) { return at < p.start; };
    return *(std::upper_bound(pieces_.begin() + 1, pieces_.end(), t, later) - 1);
  }
  T since_start(T t) const {
    const Piece& p = piece(t);
    const T u = t - p.start;
    return p.before + u * (p.angle + u * (p.rate / T(2) + u * (p.half_acceleration / T(3) + u * p.sixth_jerk / T(4))));
  }
  T end_of(std::size_t i) const { return i + 1 < pieces_.size() ? pieces_[i + 1].start : end_; }

  std::vector<Piece> pieces_;
  T end_;
};
extern template class AngleSpline<double>;
extern template class AngleSpline<float80>;
extern template class AngleSpline<float128>;

}  // namespace earthtop
