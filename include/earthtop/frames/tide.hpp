// SPDX-License-Identifier: GPL-3.0-or-later
/// The attraction of the Moon and the Sun at the site, less that on the Earth as a whole.
#pragma once

#include <memory>
#include <vector>

#include "earthtop/frames/earth.hpp"
#include "earthtop/frames/tide_spec.hpp"
#include "earthtop/frames/utc_instant.hpp"

namespace earthtop {

/// Geocentric gravitational constants GM (m^3/s^2) of DE440 [Park et al. 2021, Astron. J. 161, 105].
inline constexpr double kGravitationalConstantMoon = 4.902800118e12;
inline constexpr double kGravitationalConstantSun = 1.32712440041279419e20;

/// The tidal acceleration at the site in geodetic East, North, Up (m/s^2), `seconds_later` after `utc`:
///   a = GM [ (d - r)/|d - r|^3 - d/|d|^3 ],  d: body, r: site, both from the Earth's centre,
/// summed over the bodies. Good to some 1e-4 of its size: the Moon's abridged theory, UT1 = UTC. It has a mean value, the
/// permanent tide, which normal gravity lacks and measured gravity, by the usual convention ("zero tide"), holds only in part.
Vec3<double> tidal_acceleration_L(const Site& site, const UtcInstant& utc, double seconds_later = 0,
                                  const TideOptions& options = {});

/// The tide of one body of a given constant GM at d, at the place r, both from the Earth's centre in any axes (m/s^2). No
/// digits are lost however far the body is.
Vec3<double> differential_attraction(double gm, const Vec3<double>& d, const Vec3<double>& r);

/// A function of time in pieces of equal length, each a sum of Chebyshev polynomials of the piece's own time in [-1, 1].
struct ChebyshevPieces {
  static constexpr int kTerms = 13;
  double begin_s = 0;
  double half_piece_s = 1;
  std::vector<Vec3<double>> coefficients;  ///< kTerms a piece, the constant first
};

/// tidal_acceleration_L as pieces of 3 hours that cover [0, duration_s] (or [duration_s, 0]); to 1e-13 of its size, less the
/// rounding of the Moon's place, a few 1e-12.
ChebyshevPieces tidal_pieces(const Site& site, const UtcInstant& utc, double duration_s, const TideOptions& options);

/// A small acceleration of the laboratory as a function of time, for the hot loops: nothing, the Moon's and the Sun's tide, or
/// a harmonic of given amplitude. Copies share the coefficients.
template <class T>
class TideSeries {
 public:
  /// Nothing: zero at all times.
  TideSeries() = default;
  /// The tide from `utc` on (t = 0). Beyond [0, duration_s] the next piece is continued, which is good for some minutes.
  static TideSeries of_bodies(const Site& site, const UtcInstant& utc, double duration_s, const TideOptions& options = {}) {
    TideSeries series;
    if (!options.moon && !options.sun) return series;
    series.pieces_ = std::make_shared<const ChebyshevPieces>(tidal_pieces(site, utc, duration_s, options));
    return series;
  }
  /// amplitude_L sin(2 pi frequency t + phase).   @param amplitude_L  m/s^2, laboratory axes
  static TideSeries harmonic(const Vec3<T>& amplitude_L, T frequency_Hz, T phase_rad) {
    TideSeries series;
    series.amplitude_L_ = amplitude_L;
    series.pulsation_ = T(2) * real::pi<T>() * frequency_Hz;
    series.phase_ = phase_rad;
    return series;
  }

  bool empty() const { return !pieces_ && is_zero(amplitude_L_); }

  /// The same in units of time of 2^time_exponent s: t and the result (m per unit squared) are in the new unit. Exact.
  TideSeries scaled(int time_exponent) const {
    TideSeries series = *this;
    series.unit_s_ = real::scale(unit_s_, time_exponent);
    return series;
  }

  /// At time t, in laboratory axes; (m/s^2) for t in s.
  Vec3<T> acceleration_L(T t) const {
    const T t_s = t * unit_s_;
    Vec3<T> a = Vec3<T>::Zero();
    if (pieces_) a = value(*pieces_, t_s);
    if (!is_zero(amplitude_L_)) a += real::sin(pulsation_ * t_s + phase_) * amplitude_L_;
    return (unit_s_ * unit_s_) * a;
  }

 private:
  static bool is_zero(const Vec3<T>& v) { return v[0] == T(0) && v[1] == T(0) && v[2] == T(0); }

  /// Clenshaw's recurrence, bracketed so that a step waits for one product and one sum of the step before.
  static Vec3<T> value(const ChebyshevPieces& pieces, T t_s) {
    const T halves = (t_s - T(pieces.begin_s)) / T(pieces.half_piece_s);
    const int last = static_cast<int>(pieces.coefficients.size()) / ChebyshevPieces::kTerms - 1;
    // Compared before it is made an int: no time, and no NaN, is out of range.
    const int piece = !(halves > T(0)) ? 0 : halves < T(2 * last) ? static_cast<int>(halves / T(2)) : last;
    const T x = halves - T(2 * piece + 1);
    const Vec3<double>* c = &pieces.coefficients[static_cast<std::size_t>(piece) * ChebyshevPieces::kTerms];
    const T twice_x = T(2) * x;
    T b0[3] = {T(0), T(0), T(0)}, b1[3] = {T(0), T(0), T(0)};
    for (int n = ChebyshevPieces::kTerms - 1; n > 0; --n) {
      for (int i = 0; i < 3; ++i) {
        const T b = (T(c[n][i]) - b1[i]) + twice_x * b0[i];
        b1[i] = b0[i];
        b0[i] = b;
      }
    }
    return {(T(c[0][0]) - b1[0]) + x * b0[0], (T(c[0][1]) - b1[1]) + x * b0[1], (T(c[0][2]) - b1[2]) + x * b0[2]};
  }

  std::shared_ptr<const ChebyshevPieces> pieces_;
  Vec3<T> amplitude_L_ = Vec3<T>::Zero();
  T pulsation_ = T(0);  ///< rad/s
  T phase_ = T(0);
  T unit_s_ = T(1);  ///< a power of two
};

}  // namespace earthtop
