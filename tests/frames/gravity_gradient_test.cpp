// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/gravity_gradient.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/NormalGravity.hpp>

#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::close;

constexpr double kRounding = real::epsilon<double>();
// The order of magnitude of the tensor's components (1/s^2).
constexpr double kGradient = 3.1e-6;

struct Place {
  double latitude_deg, height_m;
};
constexpr Place kPlaces[] = {{0, 0},   {0, 4000},   {90, 0},   {90, 300}, {-90, -12000}, {45, 0},     {45, -12000}, {-45, 2500},
                             {30, 80}, {-12.5, 10}, {67.3, 0}, {89.9, 0}, {0.01, 0},     {52, 400e3}, {-71, 20e6}};

/// The matrix from East, North, Up to Earth-centred axes at longitude 0, where East is y.
Mat3<double> axes_E(double latitude_deg) {
  const auto [s, c] = sin_cos_degrees(latitude_deg);
  Mat3<double> R_EL;
  R_EL << 0, -s, c, 1, 0, 0, 0, c, s;
  return R_EL;
}

/// GeographicLib's closed form of the gravitational field, in ellipsoidal coordinates.
Vec3<double> gravitation_E(const Vec3<double>& r_E) {
  Vec3<double> g;
  GeographicLib::NormalGravity::WGS84().V0(r_E[0], r_E[1], r_E[2], g[0], g[1], g[2]);
  return g;
}

TEST(GravityGradient, IsTheDerivativeOfTheNormalField) {
  for (const auto [latitude, height] : kPlaces) {
    Vec3<double> r_E;
    GeographicLib::Geocentric::WGS84().Forward(latitude, 0, height, r_E[0], r_E[1], r_E[2]);
    const Mat3<double> R_EL = axes_E(latitude);
    const Mat3<double> G_L = normal_gravity_gradient_L(latitude, height);
    // Two extrapolations leave f^(7) h^6 / (7! 64), and GM/r^2 has f^(7) = 8! g/r^7; four times that for the flattening.
    // GeographicLib's g is good to some 30 eps, of which the difference quotients make g 30 eps / h at h/4.
    const double h = 100e3, r = 6.34e6, g = 9.9;
    const double bound = 4 * g / (8 * r) * std::pow(h / r, 6) + 4 * g * 30 * kRounding / h;
    ASSERT_LT(bound, 1e-11 * kGradient);
    for (int j = 0; j < 3; ++j) {
      const auto along = [&](double x) -> Vec3<double> { return R_EL.transpose() * gravitation_E(r_E + x * R_EL.col(j)); };
      EXPECT_TRUE(close<double>(test::first_derivative(along, 0.0, h), G_L.col(j), bound))
          << latitude << " " << height << " " << j;
    }
  }
}

TEST(GravityGradient, AgreesWithTheCurvatureOfTheEllipsoid) {
  // Bruns: on the level surface the apparent gravity turns with the normal, by 1/M along the meridian and 1/N along the
  // parallel, its size changes as Somigliana's formula says, and its divergence is 2 Omega^2.
  const auto& field = GeographicLib::NormalGravity::WGS84();
  const double a = kEquatorialRadiusWgs84, f = 1 / kInverseFlatteningWgs84, b = a * (1 - f), e2 = f * (2 - f);
  const double Omega2 = kEarthRateWgs84 * kEarthRateWgs84;
  for (const double latitude : {0.0, 10.0, -35.0, 45.0, 60.0, -88.0, 90.0}) {
    const auto [s, c] = sin_cos_degrees(latitude);
    const double root2 = a * a * c * c + b * b * s * s,
                 above = a * field.EquatorialGravity() * c * c + b * field.PolarGravity() * s * s;
    const double gamma = above / std::sqrt(root2);
    const double slope = 2 * s * c * (b * field.PolarGravity() - a * field.EquatorialGravity()) / std::sqrt(root2) +
                         gamma * s * c * (a * a - b * b) / root2;  // d gamma / d latitude
    const double N = a / std::sqrt(1 - e2 * s * s), M = N * (1 - e2) / (1 - e2 * s * s);
    Mat3<double> apparent;
    apparent << -gamma / N, 0, 0, 0, -gamma / M, -slope / M, 0, -slope / M, gamma / M + gamma / N + 2 * Omega2;
    const Vec3<double> axis(0, c, s);
    const Mat3<double> centrifugal = Omega2 * (Mat3<double>::Identity() - axis * axis.transpose());
    // Some hundred operations on either side, none of which cancels.
    EXPECT_TRUE(close<double>(normal_gravity_gradient_L(latitude, 0), apparent - centrifugal, 100 * kRounding * kGradient))
        << latitude;
  }
}

TEST(GravityGradient, HasNoTraceIsSymmetricAndMirrorsAtTheEquator) {
  for (const auto [latitude, height] : kPlaces) {
    const Mat3<double> G = normal_gravity_gradient_L(latitude, height), mirrored = normal_gravity_gradient_L(-latitude, height);
    EXPECT_LE(std::abs(G.trace()), 8 * kRounding * kGradient);
    EXPECT_EQ(G, G.transpose());
    EXPECT_EQ(G(0, 1), 0);
    EXPECT_EQ(G(0, 2), 0);
    EXPECT_EQ(G(1, 2), -mirrored(1, 2));
    EXPECT_EQ(G(2, 2), mirrored(2, 2));
  }
  // At a pole no horizontal direction is preferred; at the equator the principal axes are East, North and Up.
  const Mat3<double> pole = normal_gravity_gradient_L(90, 0);
  EXPECT_TRUE(close<double>(pole(0, 0), pole(1, 1), 8 * kRounding * kGradient));
  EXPECT_EQ(pole(1, 2), 0);
  EXPECT_EQ(normal_gravity_gradient_L(0, 0)(1, 2), 0);
}

TEST(GravityGradient, IsThatOfASphereToTheFlattening) {
  for (const auto [latitude, height] : kPlaces) {
    const Vec3<double> up = geocentric_up_L(latitude, height);
    const double gm_over_r3 = geocentric_gm_over_r3(latitude, height);
    const Mat3<double> sphere = spherical_gradient(gm_over_r3, up);
    // J_2 changes it by 12 J_2 at most: its coefficients are 6, 9/2, 15/2 and 12.
    EXPECT_TRUE(close<double>(normal_gravity_gradient_L(latitude, height), sphere, 12 * 1.1e-3 * gm_over_r3)) << latitude;
    EXPECT_TRUE(close<double>(sphere * up, 2 * gm_over_r3 * up, 8 * kRounding * kGradient));
  }
  EXPECT_NEAR(kGravitationalConstantWgs84 / std::pow(kEquatorialRadiusWgs84, 3), geocentric_gm_over_r3(0, 0),
              4 * kRounding * 1.6e-6);
  EXPECT_NEAR(geocentric_gm_over_r3(0, 0), 1536.2e-9, 0.05e-9);  // the printed digits
}

TEST(GravityGradient, PlacesTheSiteWhereTheEllipsoidDoes) {
  for (const auto [latitude, height] : kPlaces) {
    double X = 0, Y = 0, Z = 0;
    GeographicLib::Geocentric::WGS84().Forward(latitude, 0, height, X, Y, Z);
    const Vec3<double> r_L = geocentric_position_L(latitude, height);
    EXPECT_TRUE(close<double>(axes_E(latitude) * r_L, Vec3<double>(X, Y, Z), 8 * kRounding * norm(r_L))) << latitude;
    const Vec3<double> up = geocentric_up_L(latitude, height);
    // tan(geodetic less geocentric latitude) from the two tangents' own definition.
    const double less = latitude * real::pi<double>() / 180 - std::atan2(Z, X);
    EXPECT_TRUE(close<double>(up, Vec3<double>(0, -std::sin(less), std::cos(less)), 8 * kRounding)) << latitude;
  }
  for (const double latitude : {-90.0, 0.0, 90.0}) EXPECT_EQ(geocentric_up_L(latitude, 100), Vec3<double>::UnitZ());
}

}  // namespace
}  // namespace earthtop
