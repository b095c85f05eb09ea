// SPDX-License-Identifier: GPL-3.0-or-later
/// A turn that a table gives: the not-a-knot cubic spline through angles at times.
#pragma once

#include <algorithm>
#include <vector>

#include "earthtop/frames/angle_table.hpp"
#include "earthtop/real.hpp"

namespace earthtop {

/// The piecewise cubic through a table with two continuous derivatives, and at the second time and the last but one a third:
/// so it is the cubic polynomial itself where the angles lie on one [de Boor, A Practical Guide to Splines, chapter IV].
/// Between samples of a smooth turn, h apart, its angle is in error by O(h^4), its rate by O(h^3), its acceleration by O(h^2).
/// Outside the table the first and the last piece go on.
template <class T>
class AngleSpline {
 public:
  /// @throws std::invalid_argument for a table that is not as AngleTable says, or holds what is no finite number.
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
  T angle_acceleration(T t) const {
    const Piece& p = piece(t);
    return T(2) * p.half_acceleration + T(6) * (t - p.start) * p.sixth_jerk;
  }

  /// The largest absolute values within the table.
  T largest_rate() const;
  T largest_acceleration() const;
  /// The times at which its third derivative jumps.
  std::vector<T> joints() const;
  /// Whether every angle is zero.
  bool is_zero() const;

  /// The same turn with times in units of 2^time_exponent s: no digit changes.
  AngleSpline in_time_units(int time_exponent) const;

 private:
  /// angle + u (rate + u (half_acceleration + u sixth_jerk)) with u = t - start, up to the next piece's start.
  struct Piece {
    T start, angle, rate, half_acceleration, sixth_jerk;
  };
  const Piece& piece(T t) const {
    const auto later = [](T at, const Piece& p) { return at < p.start; };
    return *(std::upper_bound(pieces_.begin() + 1, pieces_.end(), t, later) - 1);
  }
  T end_of(std::size_t i) const { return i + 1 < pieces_.size() ? pieces_[i + 1].start : end_; }

  std::vector<Piece> pieces_;
  T end_;
};
extern template class AngleSpline<double>;
extern template class AngleSpline<long double>;
extern template class AngleSpline<float128>;

}  // namespace earthtop
