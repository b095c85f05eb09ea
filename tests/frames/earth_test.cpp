// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/earth.hpp"

#include <array>

#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Random;

TEST(Earth, SineAndCosineAreExactAtMultiplesOf90Degrees) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const std::array<int, 4> sines = {0, 1, 0, -1}, cosines = {1, 0, -1, 0};
    for (int k = -4000; k <= 4000; k += k > -20 && k < 20 ? 1 : 199) {
      const auto at = static_cast<std::size_t>(((k % 4) + 4) % 4);
      const SinCos<T> sc = sin_cos_degrees(T(90 * k));
      EXPECT_EQ(sc.sin, T(sines[at])) << k;
      EXPECT_EQ(sc.cos, T(cosines[at])) << k;
    }
  });
}

TEST(Earth, SineAndCosineHaveTheSymmetriesOfTheCircle) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(31);
    for (int k = 0; k < 500; ++k) {
      // A multiple of 1/1024, so that 90 - x and x + 360 are exact; 45 itself has two equally near quadrants.
      const int n = random.integer(-360 * 1024, 360 * 1024);
      if (n % (45 * 1024) == 0) continue;
      const T x = T(n) / T(1024);
      const SinCos<T> at = sin_cos_degrees(x), mirrored = sin_cos_degrees(-x), complement = sin_cos_degrees(T(90) - x),
                      turned = sin_cos_degrees(x + T(360)), opposite = sin_cos_degrees(x - T(180));
      EXPECT_EQ(mirrored.sin, -at.sin);
      EXPECT_EQ(mirrored.cos, at.cos);
      EXPECT_EQ(complement.sin, at.cos);
      EXPECT_EQ(complement.cos, at.sin);
      EXPECT_EQ(turned.sin, at.sin);
      EXPECT_EQ(turned.cos, at.cos);
      EXPECT_EQ(opposite.sin, -at.sin);
      EXPECT_EQ(opposite.cos, -at.cos);
    }
  });
}

TEST(Earth, SineAndCosineAreAccurate) {
  Random random(32);
  for (int k = 0; k < 500; ++k) {
    const double degrees = random.uniform(-400, 400);
    const float128 radians = float128(degrees) * real::pi<float128>() / 180;
    const SinCos<double> sc = sin_cos_degrees(degrees);
    // The reduced angle is rounded three times (pi, product, quotient), 1.5 eps of at most pi/4, and the function by 1/2 eps.
    const double bound = 2 * real::epsilon<double>();
    EXPECT_TRUE(close<double>(sc.sin, static_cast<double>(real::sin(radians)), bound)) << degrees;
    EXPECT_TRUE(close<double>(sc.cos, static_cast<double>(real::cos(radians)), bound)) << degrees;
  }
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    // Within one unit in the last place of 1/2.
    EXPECT_TRUE(close<T>(sin_cos_degrees(T(30)).sin, T(0.5), real::epsilon<T>() / 2));
    EXPECT_TRUE(close<T>(sin_cos_degrees(T(60)).cos, T(0.5), real::epsilon<T>() / 2));
    EXPECT_TRUE(close<T>(sin_cos_degrees(T(-150)).sin, T(-0.5), real::epsilon<T>() / 2));
  });
}

TEST(Earth, CelestialAxisPointsNorthAtTheEquatorAndUpAtThePole) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    EXPECT_TRUE(identical(celestial_axis_L<T>(Site{0, 0, 0, 0}), Vec3<T>(T(0), T(1), T(0))));
    EXPECT_TRUE(identical(celestial_axis_L<T>(Site{90, 0, 0, 0}), Vec3<T>(T(0), T(0), T(1))));
    EXPECT_TRUE(identical(celestial_axis_L<T>(Site{-90, 0, 0, 0}), Vec3<T>(T(0), T(0), T(-1))));
    const T root = real::sqrt(T(3)) / T(2);
    EXPECT_TRUE(close<T>(celestial_axis_L<T>(Site{30, 77, 5, 0}), Vec3<T>(T(0), root, T(0.5)), 2 * real::epsilon<T>()));
    EXPECT_TRUE(close<T>(celestial_axis_L<T>(Site{-60, 0, 0, 0}), Vec3<T>(T(0), T(0.5), -root), 2 * real::epsilon<T>()));
  });
}

TEST(Earth, LaboratoryAxesAreEastNorthAndUp) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    for (const double latitude : {-90.0, -60.5, -1e-9, 0.0, 33.25, 45.0, 89.999, 90.0})
      for (const double longitude : {-180.0, -90.0, -77.25, 0.0, 1e-9, 45.0, 90.0, 123.5, 180.0, 359.0}) {
        const T phi = T(latitude) * real::pi<T>() / T(180), lambda = T(longitude) * real::pi<T>() / T(180);
        const T sp = real::sin(phi), cp = real::cos(phi), sl = real::sin(lambda), cl = real::cos(lambda);
        Mat3<T> R_EL;  // columns: d r/d longitude, d r/d latitude (normalised), and the ellipsoid's normal
        R_EL << -sl, -sp * cl, cp * cl, cl, -sp * sl, cp * sl, T(0), cp, sp;
        // The radians here are rounded by eps of up to 6.3 rad, twice; the quaternion's product by a few eps.
        EXPECT_TRUE(close<T>(laboratory_attitude<T>(Site{latitude, longitude, 0, 0}).matrix(), R_EL, 24 * real::epsilon<T>()))
            << latitude << " " << longitude;
      }
  });
}

TEST(Earth, LaboratoryIsCarriedEastward) {
  Random random(33);
  for (int k = 0; k < 100; ++k) {
    const Site site{random.uniform(-89, 89), random.uniform(-180, 180), 0, 0};
    const Mat3<double> R_EL = laboratory_attitude<double>(site).matrix();
    const Vec3<double> velocity = Vec3<double>::UnitZ().cross(Vec3<double>(R_EL.col(2)));  // at unit rate and radius
    const double cosine = std::cos(site.latitude_deg * real::pi<double>() / 180);
    EXPECT_TRUE(close<double>(transposed_times(R_EL, velocity), Vec3<double>(cosine, 0, 0), 16 * real::epsilon<double>()));
    EXPECT_TRUE(
        close<double>(Vec3<double>(R_EL.row(2).transpose()), celestial_axis_L<double>(site), 16 * real::epsilon<double>()));
  }
}

TEST(Earth, ApparentGravityIsTheSitesAndPointsDown) {
  EXPECT_TRUE(identical(apparent_gravity_L<float128>(Site{12, 34, 56, 9.80665}),
                        Vec3<float128>(float128(0), float128(0), -float128(9.80665))));
}

// Values of Somigliana's formula with the printed k, computed independently of this program; and the horizontal centrifugal
// acceleration divided by g, as an angle.
struct NormalGravityRow {
  double latitude_deg, gravity_m_s2, angle_arcsec;
};
constexpr std::array<NormalGravityRow, 7> kNormalGravity = {{{0, 9.7803253359, 0},
                                                             {15, 9.78378496235, 178.80},
                                                             {30, 9.7932472692, 309.57},
                                                             {45, 9.80619776934, 357.29},
                                                             {60, 9.81917695307, 309.27},
                                                             {75, 9.82869662743, 178.50},
                                                             {90, 9.8321849378, 0}}};

TEST(Earth, NormalGravityIsTheTables) {
  for (const NormalGravityRow& row : kNormalGravity)
    for (const double sign : {1.0, -1.0})
      // The table's own digits are uncertain by 6e-11 (rounding of k in Somigliana's formula).
      EXPECT_TRUE(close<double>(normal_gravity(sign * row.latitude_deg, 0), row.gravity_m_s2, 1e-10)) << row.latitude_deg;
}

TEST(Earth, NormalGravityIsSomiglianasEverywhere) {
  Random random(34);
  for (int k = 0; k < 100; ++k) {
    const double latitude = random.uniform(-90, 90), s = std::sin(latitude * real::pi<double>() / 180);
    const double somigliana = 9.7803253359 * (1 + 0.00193185265241 * s * s) / std::sqrt(1 - 0.006694379990141317 * s * s);
    // The equatorial value is printed to 5e-11 and k to 5e-15.
    EXPECT_TRUE(close<double>(normal_gravity(latitude, 0), somigliana, 5e-11 + 9.8 * 5e-14)) << latitude;
  }
}

TEST(Earth, NormalGravityFallsWithHeight) {
  // Bruns: on the ellipsoid dg/dh = -g (1/M + 1/N) - 2 Omega^2 exactly, M and N the radii of curvature (-3.0855978e-6 /s^2 at
  // 45 deg; the second-order series below says -3.08555e-6). Central difference over 2 x 100 m: a sixth of the third
  // derivative is 4 g/a^3, and the round-off a few eps g.
  const double e2 = 0.006694379990141317, step = 100;
  for (const double latitude : {0.0, 45.0, -77.0, 90.0}) {
    const double sine = std::sin(latitude * real::pi<double>() / 180), g = normal_gravity(latitude, 0);
    const double root = std::sqrt(1 - e2 * sine * sine), N = kEquatorialRadiusWgs84 / root, M = N * (1 - e2) / (root * root);
    const double slope = (normal_gravity(latitude, step) - normal_gravity(latitude, -step)) / (2 * step);
    const double bound =
        5 * g * std::pow(step, 2) / std::pow(kEquatorialRadiusWgs84, 3) + 8 * real::epsilon<double>() * g / step;
    EXPECT_TRUE(close<double>(slope, -g * (1 / M + 1 / N) - 2 * kEarthRateWgs84 * kEarthRateWgs84, bound)) << latitude;
  }
  // g(h) = g0 [1 - (2/a)(1 + f + m - 2 f sin^2) h + 3 h^2/a^2]: left out are f^2 and (h/a)^3, about 4e-5 of the slope's term.
  const double a = kEquatorialRadiusWgs84, f = 1 / kInverseFlatteningWgs84, m = 0.003449786506840845;
  for (const double latitude : {0.0, 20.0, 45.0, -70.0, 90.0})
    for (const double h : {-400.0, 10.0, 1000.0, 9000.0}) {
      const double s = std::sin(latitude * real::pi<double>() / 180), g0 = normal_gravity(latitude, 0);
      const double series = g0 * (1 - 2 / a * (1 + f + m - 2 * f * s * s) * h + 3 * h * h / (a * a));
      EXPECT_TRUE(close<double>(normal_gravity(latitude, h), series,
                                4 * f * f * 2 * g0 * std::abs(h) / a + 1e-5 * g0 * h * h / (a * a) * 3))
          << latitude << " " << h;
    }
}

TEST(Earth, GravitationAndCentrifugalMakeNormalGravityDownward) {
  Random random(35);
  for (int k = 0; k < 100; ++k) {
    const double latitude = random.uniform(-90, 90);
    const Vec3<double> g_L = gravitation_L(latitude, 0) + centrifugal_acceleration_L(latitude, 0);
    // 64 eps g: the potential's derivatives are turned twice.
    EXPECT_TRUE(close<double>(g_L, Vec3<double>(0, 0, -normal_gravity(latitude, 0)), 64 * real::epsilon<double>() * 10))
        << latitude;
  }
  // Above the ellipsoid the vertical bends (about 8e-9 /s^2 sin(2 latitude) h northward), but the size is the same.
  const Vec3<double> high = gravitation_L(50, 8000) + centrifugal_acceleration_L(50, 8000);
  EXPECT_TRUE(close<double>(norm(high), normal_gravity(50, 8000), 64 * real::epsilon<double>() * 10));
}

TEST(Earth, CentrifugalAccelerationPointsAwayFromTheAxis) {
  const double e2 = 0.006694379990141317;
  for (const double latitude : {-80.0, -45.0, 0.0, 30.0, 89.0}) {
    const long double phi = latitude * real::pi<float80>() / 180;
    const double s = static_cast<double>(std::sin(phi)), c = static_cast<double>(std::cos(phi)), h = 250;
    const double from_axis = (kEquatorialRadiusWgs84 / std::sqrt(1 - e2 * s * s) + h) * c;
    const double size = kEarthRateWgs84 * kEarthRateWgs84 * from_axis;
    EXPECT_TRUE(close<double>(centrifugal_acceleration_L(latitude, h), Vec3<double>(0, -size * s, size * c),
                              16 * real::epsilon<double>() * size))
        << latitude;
  }
}

TEST(Earth, PlumbLineLeansFromGravitationAsInTheTable) {
  for (const NormalGravityRow& row : kNormalGravity) {
    const Vec3<double> gravitation = gravitation_L(row.latitude_deg, 0);
    const Vec3<double> centrifugal = centrifugal_acceleration_L(row.latitude_deg, 0);
    const double arcsec = 180 / real::pi<double>() * 3600;
    // The table holds (horizontal centrifugal)/g; half a unit of its last digit.
    EXPECT_TRUE(close<double>(-centrifugal[1] / normal_gravity(row.latitude_deg, 0) * arcsec, row.angle_arcsec, 0.005 + 1e-9))
        << row.latitude_deg;
    // The true angle has gravitation alone, g + the upward centrifugal part, below: up to 0.35 % less.
    const Vec3<double> plumb(0, 0, -1);
    const double angle = std::atan2(norm<double>(plumb.cross(gravitation)), plumb.dot(gravitation));
    EXPECT_TRUE(close<double>(angle, std::atan2(-centrifugal[1], normal_gravity(row.latitude_deg, 0) + centrifugal[2]),
                              64 * real::epsilon<double>()));
    // In the north the plumb bob hangs to the south of gravitation's direction.
    if (row.angle_arcsec > 0) {
      EXPECT_GT(gravitation[1], 0) << row.latitude_deg;
    }
  }
}

}  // namespace
}  // namespace earthtop
