// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/angle_spline.hpp"

#include <cmath>
#include <stdexcept>

namespace earthtop {
namespace {

void require_sound(const AngleTable& table) {
  const std::vector<double>&t = table.t_s, &angle = table.value;
  if (t.size() < 4 || t.size() != angle.size())
    throw std::invalid_argument("angle table: at least four times, an angle for each");
  for (std::size_t i = 0; i < t.size(); ++i)
    if (!std::isfinite(t[i]) || !std::isfinite(angle[i]) || (i > 0 && !(t[i - 1] < t[i])))
      throw std::invalid_argument("angle table: finite numbers, times strictly ascending");
}

/// The slopes s of the spline at its knots. Continuous second derivatives give at the inner knots
///   h_i s_(i-1) + 2 (h_(i-1) + h_i) s_i + h_(i-1) s_(i+1) = 3 (h_i d_(i-1) + h_(i-1) d_i)
/// with the intervals h and the slopes d of the chords. A continuous third derivative at the second knot adds
///   h_1 s_0 + (h_0 + h_1) s_1 = ((3 h_0 + 2 h_1) h_1 d_0 + h_0^2 d_1) / (h_0 + h_1),
/// and its mirror image at the last-but-one knot [de Boor, chapter IV, equations (7) and (13)]. The elimination needs no
/// pivoting: its first step leaves h_0 + h_1 on the diagonal next to h_0, and from there on the matrix is diagonally dominant.
template <class T>
std::vector<T> slopes_at_knots(const std::vector<T>& h, const std::vector<T>& d) {
  const std::size_t last = h.size();
  const auto end_side = [](T near, T far, T d_near, T d_far) {
    return ((T(3) * near + T(2) * far) * far * d_near + near * near * d_far) / (near + far);
  };
  std::vector<T> diagonal(last + 1), s(last + 1);
  diagonal[0] = h[1];
  s[0] = end_side(h[0], h[1], d[0], d[1]);
  T above = h[0] + h[1];  // the upper off-diagonal element of the row eliminated last
  for (std::size_t i = 1; i <= last; ++i) {
    const bool inside = i < last;
    const T below = inside ? h[i] : h[last - 1] + h[last - 2];
    const T factor = below / diagonal[i - 1];
    diagonal[i] = (inside ? T(2) * (h[i - 1] + h[i]) : h[last - 2]) - factor * above;
    s[i] =
        (inside ? T(3) * (h[i] * d[i - 1] + h[i - 1] * d[i]) : end_side(h[last - 1], h[last - 2], d[last - 1], d[last - 2])) -
        factor * s[i - 1];
    above = h[i - 1];
  }
  s[last] /= diagonal[last];
  for (std::size_t i = last; i-- > 0;) s[i] = (s[i] - (i > 0 ? h[i - 1] : h[0] + h[1]) * s[i + 1]) / diagonal[i];
  return s;
}

/// Updates a maximum of absolute values; a NaN is kept, so that it shows.
template <class T>
void follow(T& largest, T value) {
  const T size = real::abs(value);
  if (!(size <= largest) && largest == largest) largest = size;
}

}  // namespace

template <class T>
AngleSpline<T>::AngleSpline(const AngleTable& table) {
  require_sound(table);
  const std::size_t pieces = table.t_s.size() - 1;
  std::vector<T> h(pieces), d(pieces);
  for (std::size_t i = 0; i < pieces; ++i) {
    h[i] = T(table.t_s[i + 1]) - T(table.t_s[i]);
    d[i] = (T(table.value[i + 1]) - T(table.value[i])) / h[i];
  }
  const std::vector<T> s = slopes_at_knots(h, d);
  pieces_.reserve(pieces);
  for (std::size_t i = 0; i < pieces; ++i)
    pieces_.push_back({T(table.t_s[i]), T(table.value[i]), s[i], (T(3) * d[i] - T(2) * s[i] - s[i + 1]) / h[i],
                       (s[i] + s[i + 1] - T(2) * d[i]) / h[i] / h[i], T(0)});
  end_ = T(table.t_s.back());
  for (std::size_t i = 1; i < pieces; ++i) {
    const Piece& p = pieces_[i - 1];
    pieces_[i].before =
        p.before + h[i - 1] * (p.angle + h[i - 1] * (p.rate / T(2) +
                                                     h[i - 1] * (p.half_acceleration / T(3) + h[i - 1] * p.sixth_jerk / T(4))));
  }
}

template <class T>
T AngleSpline<T>::largest_rate() const {
  T largest = T(0);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& p = pieces_[i];
    const T length = end_of(i) - p.start;
    const T turning = -p.half_acceleration / (T(3) * p.sixth_jerk);  // infinite or NaN if the rate has no extremum
    for (const T u : {T(0), turning, length})
      if (u >= T(0) && u <= length) follow(largest, p.rate + u * (T(2) * p.half_acceleration + u * T(3) * p.sixth_jerk));
  }
  return largest;
}

template <class T>
T AngleSpline<T>::largest_acceleration() const {
  T largest = T(0);
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    for (const T u : {T(0), end_of(i) - pieces_[i].start})
      follow(largest, T(2) * pieces_[i].half_acceleration + T(6) * u * pieces_[i].sixth_jerk);
  return largest;
}

template <class T>
std::vector<T> AngleSpline<T>::joints() const {
  std::vector<T> times;
  for (std::size_t i = 2; i + 1 < pieces_.size(); ++i) times.push_back(pieces_[i].start);
  return times;
}

template <class T>
bool AngleSpline<T>::is_zero() const {
  return angle(end_) == T(0) && std::all_of(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.angle == T(0); });
}

template <class T>
AngleSpline<T> AngleSpline<T>::in_time_units(int time_exponent) const {
  AngleSpline scaled = *this;
  for (Piece& p : scaled.pieces_) {
    p.start = real::scale(p.start, -time_exponent);
    p.before = real::scale(p.before, -time_exponent);
    p.rate = real::scale(p.rate, time_exponent);
    p.half_acceleration = real::scale(p.half_acceleration, 2 * time_exponent);
    p.sixth_jerk = real::scale(p.sixth_jerk, 3 * time_exponent);
  }
  scaled.end_ = real::scale(end_, -time_exponent);
  return scaled;
}

template class AngleSpline<double>;
template class AngleSpline<float80>;
template class AngleSpline<float128>;

}  // namespace earthtop
