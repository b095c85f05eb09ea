// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/tide.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "frames/ephemeris.hpp"

namespace earthtop {

Vec3<double> differential_attraction(double gm, const Vec3<double>& d, const Vec3<double>& r) {
  // With q = |d - r|^2/|d|^2 - 1 the difference is -GM/|d - r|^3 (r + f d), f = (1 + q)^(3/2) - 1. f is written so that a small
  // q loses no digits [Battin 1999, sec. 8.4].
  const double q = r.dot(r - 2 * d) / d.squaredNorm();
  const double root = real::sqrt(1 + q);
  const double f = q * (3 + q * (3 + q)) / (1 + root * root * root);
  const double distance = norm<double>(d - r);
  return -gm / (distance * distance * distance) * (r + f * d);
}

Vec3<double> tidal_acceleration_L(const Site& site, const UtcInstant& utc, double seconds_later, const TideOptions& options) {
  const TerrestrialTime tt = terrestrial_time(utc, seconds_later);
  const Mat3<double> R_EI = celestial_to_terrestrial(utc, seconds_later);
  const Rotation<double> R_LE = laboratory_attitude<double>(site).inverse();
  const Vec3<double> r_L = geocentric_position_L(site.latitude_deg, site.height_m);
  const auto tide_of = [&](double gm, const Vec3<double>& d_I) -> Vec3<double> {
    return differential_attraction(gm, R_LE * (R_EI * d_I), r_L);
  };
  Vec3<double> a = Vec3<double>::Zero();
  if (options.moon) a += tide_of(kGravitationalConstantMoon, moon_position_I(tt));
  if (options.sun) a += tide_of(kGravitationalConstantSun, sun_position_I(tt));
  return {options.tilt_factor * a[0], options.tilt_factor * a[1], options.gravimetric_factor * a[2]};
}

ChebyshevPieces tidal_pieces(const Site& site, const UtcInstant& utc, double duration_s, const TideOptions& options) {
  // The fastest part of the tide, of degree 3, turns by 2.4 rad in 3 hours. Half a piece is therefore x = 1.2 rad, and the
  // first omitted term, 2 J_13(x) = 2 (x/2)^13 / 13!, is 4e-13 of that part, which is itself at most a sixtieth of the tide.
  constexpr double kPiece_s = 3 * 3600;
  constexpr int kTerms = ChebyshevPieces::kTerms;
  const std::size_t count = static_cast<std::size_t>(real::abs(duration_s) / kPiece_s) + 1;
  ChebyshevPieces pieces;
  pieces.begin_s = std::min(duration_s, 0.0);
  pieces.half_piece_s = kPiece_s / 2;
  pieces.coefficients.assign(count * kTerms, Vec3<double>::Zero());
  // Interpolation at the zeros x_j of T_13: c_n = (2/13) sum_j f(x_j) T_n(x_j), half of it for n = 0.
  const auto cosine = [](int halves) { return sin_cos_degrees(90.0 * halves / kTerms).cos; };  // cosine of pi/26 * halves
  for (std::size_t piece = 0; piece < count; ++piece) {
    Vec3<double>* c = &pieces.coefficients[piece * kTerms];
    for (int j = 0; j < kTerms; ++j) {
      const double t_s = pieces.begin_s + (static_cast<double>(2 * piece + 1) + cosine(2 * j + 1)) * pieces.half_piece_s;
      const Vec3<double> a = tidal_acceleration_L(site, utc, t_s, options);
      for (int n = 0; n < kTerms; ++n) c[n] += (n == 0 ? 1.0 : 2.0) / kTerms * cosine(n * (2 * j + 1)) * a;
    }
  }
  return pieces;
}

}  // namespace earthtop
