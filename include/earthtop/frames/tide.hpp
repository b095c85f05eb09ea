// SPDX-License-Identifier: GPL-3.0-or-later
/// The tidal acceleration: the attraction of the Moon and the Sun at the site, less their attraction of the Earth as a whole.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
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
/// summed over the bodies. Relative accuracy about 1e-4, limited by an abridged theory of the Moon and by taking UT1 = UTC. It
/// has a mean value, the permanent tide. Normal gravity does not contain the permanent tide; measured gravity, by the usual
/// convention ("zero tide"), contains only part of it.
Vec3<double> tidal_acceleration_L(const Site& site, const UtcInstant& utc, double seconds_later = 0,
                                  const TideOptions& options = {});

/// The tidal acceleration at the place r due to one body with gravitational constant `gm` (m^3/s^2) at d; r and d from the
/// Earth's centre in any common axes (m). No digits are lost however far the body is. (m/s^2)
Vec3<double> differential_attraction(double gm, const Vec3<double>& d, const Vec3<double>& r);

/// A function of time in pieces of equal length; on each piece a sum of Chebyshev polynomials in the piece's own time, scaled
/// to [-1, 1].
struct ChebyshevPieces {
  static constexpr int kTerms = 13;
  double begin_s = 0;
  double half_piece_s = 1;
  std::vector<Vec3<double>> coefficients;  ///< kTerms for each piece, the constant term first
};

/// tidal_acceleration_L in pieces of 3 hours that cover [0, duration_s] (or [duration_s, 0] if negative). The relative error is
/// 1e-13, apart from the rounding of the Moon's position, a few 1e-12.
ChebyshevPieces tidal_pieces(const Site& site, const UtcInstant& utc, double duration_s, const TideOptions& options);

/// A small acceleration of the laboratory as a function of time, fast enough for the inner loops: zero, the tide of Moon and
/// Sun, or a harmonic oscillation of given amplitude. Copies share the coefficients.
template <class T>
class TideSeries {
 public:
  /// Zero at all times.
  TideSeries() = default;
  /// The tide, with t = 0 at `utc`. Outside [0, duration_s] the nearest piece is continued, which is good for some minutes.
  static TideSeries of_bodies(const Site& site, const UtcInstant& utc, double duration_s, const TideOptions& options = {}) {
    TideSeries series;
    if (!options.moon && !options.sun) return series;
    series.pieces_ = std::make_shared<const ChebyshevPieces>(tidal_pieces(site, utc, duration_s, options));
    return series;
  }
  /// amplitude_L sin(2 pi frequency t + phase).   @param amplitude_L  in laboratory axes (m/s^2)
  static TideSeries harmonic(const Vec3<T>& amplitude_L, T frequency_Hz, T phase_rad) {
    TideSeries series;
    series.amplitude_L_ = amplitude_L;
    series.pulsation_ = T(2) * real::pi<T>() * frequency_Hz;
    series.phase_ = phase_rad;
    return series;
  }

  bool empty() const { return !pieces_ && is_zero(amplitude_L_); }

  /// The same with times in units of 2^time_exponent s: t and the result (m per squared unit) are in the new unit. Exact.
  TideSeries scaled(int time_exponent) const {
    TideSeries series = *this;
    series.unit_s_ = real::scale(unit_s_, time_exponent);
    return series;
  }

  /// The acceleration at time t, in laboratory axes: in m/s^2 for t in s.
  Vec3<T> acceleration_L(T t) const {
    const T t_s = t * unit_s_;
    Vec3<T> a = Vec3<T>::Zero();
    if (pieces_) a = value(*pieces_, t_s);
    if (!is_zero(amplitude_L_)) a += real::sin(pulsation_ * t_s + phase_) * amplitude_L_;
    return (unit_s_ * unit_s_) * a;
  }
  /// The largest acceleration at any time is at most this; in the unit of `acceleration_L`.
  T largest() const {
    T largest = T(0);
    for (std::size_t i = 0; pieces_ && i < pieces_->coefficients.size(); i += ChebyshevPieces::kTerms) {
      T sum = T(0);
      for (std::size_t n = 0; n < ChebyshevPieces::kTerms; ++n) sum += T(norm(pieces_->coefficients[i + n]));
      largest = std::max(largest, sum);
    }
    return (unit_s_ * unit_s_) * (largest + norm(amplitude_L_));
  }
  /// Puts the coefficients of the powers of (t' - t) of the acceleration into rows, one for each order starting at 0.
  void expand(T t, std::span<std::array<T, 3>> rows) const {
    for (std::array<T, 3>& row : rows) row = {T(0), T(0), T(0)};
    const T t_s = t * unit_s_;
    if (pieces_) expand(*pieces_, t_s, rows);
    if (!is_zero(amplitude_L_)) {
      const SinCos<T> both = real::sin_cos(T(pulsation_ * t_s + phase_));
      const T cycle[4] = {both.sin, both.cos, -both.sin, -both.cos};
      T factor = T(1);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) rows[k][i] += factor * cycle[k % 4] * amplitude_L_[static_cast<int>(i)];
        factor *= pulsation_ / T(k + 1);
      }
    }
    T power = unit_s_ * unit_s_;
    for (std::array<T, 3>& row : rows) {
      for (T& value : row) value *= power;
      power *= unit_s_;
    }
  }

 private:
  static bool is_zero(const Vec3<T>& v) { return v[0] == T(0) && v[1] == T(0) && v[2] == T(0); }

  /// The number of the piece that a time lies in, or the nearest one; `halves` is the time in half pieces from the beginning.
  static int piece_at(const ChebyshevPieces& pieces, T halves) {
    const int last = static_cast<int>(pieces.coefficients.size()) / ChebyshevPieces::kTerms - 1;
    // Compared before the conversion to int: so no time, not even NaN, gives an index out of range.
    return !(halves > T(0)) ? 0 : halves < T(2 * last) ? static_cast<int>(halves / T(2)) : last;
  }

  /// The coefficients of the powers of time (s), from those of the Chebyshev polynomials: T_(n+1) = 2 x T_n - T_(n-1), as
  /// polynomials in the distance from x.
  static void expand(const ChebyshevPieces& pieces, T t_s, std::span<std::array<T, 3>> rows) {
    constexpr std::size_t kTerms = ChebyshevPieces::kTerms;
    const T halves = (t_s - T(pieces.begin_s)) / T(pieces.half_piece_s);
    const int piece = piece_at(pieces, halves);
    const T x = halves - T(2 * piece + 1);
    const Vec3<double>* c = &pieces.coefficients[static_cast<std::size_t>(piece) * kTerms];
    std::array<T, kTerms> before{}, now{}, sum[3] = {};
    now[0] = T(1);
    for (std::size_t n = 0; n < kTerms; ++n) {
      for (std::size_t k = 0; k <= n; ++k)
        for (std::size_t i = 0; i < 3; ++i) sum[i][k] += T(c[n][static_cast<int>(i)]) * now[k];
      std::array<T, kTerms> next{};
      const T factor = n == 0 ? T(1) : T(2);
      for (std::size_t k = 0; k <= n + 1 && k < kTerms; ++k)
        next[k] = factor * (x * now[k] + (k > 0 ? now[k - 1] : T(0))) - (n == 0 ? T(0) : before[k]);
      before = now, now = next;
    }
    T factor = T(1);
    for (std::size_t k = 0; k < kTerms && k < rows.size(); ++k, factor /= T(pieces.half_piece_s))
      for (std::size_t i = 0; i < 3; ++i) rows[k][i] += factor * sum[i][k];
  }

  /// Clenshaw's recurrence, bracketed so that each step waits for only one product and one sum of the step before.
  static Vec3<T> value(const ChebyshevPieces& pieces, T t_s) {
    const T halves = (t_s - T(pieces.begin_s)) / T(pieces.half_piece_s);
    const int piece = piece_at(pieces, halves);
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
