// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/earth_orientation.hpp"

#include <erfa.h>
#include <erfam.h>

#include <cstring>

#include "frames/ephemeris.hpp"
#include "frames/random_cases.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;

constexpr double kEps = real::epsilon<double>();
constexpr double kSites[][2] = {{45, 0},   {45, 8.5},    {-33.9, 151.2}, {0, 0},       {0, -90},   {90, 0},  {90, 33},
                                {-90, 10}, {69.7, -147}, {-12.3, 181},   {-45, -77.7}, {1e-7, 12}, {30, 90}, {60, 180}};
constexpr PolarMotion kPole = {0.21, 0.43};

double arcsec(double x) { return x * ERFA_DAS2R; }

TEST(EarthOrientation, WithPoleAndPlumbLineInPlaceEveryBitIsTheSame) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    for (const auto& [latitude, longitude] : kSites) {
      const Site site{latitude, longitude, 0, 9.8};
      const Vec3<T> plain = celestial_axis_L<T>(site), turned = celestial_axis_L<T>(site, PolarMotion{}, VerticalDeflection{});
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(turned[i], plain[i]) << latitude;
        EXPECT_EQ(std::signbit(static_cast<double>(turned[i])), std::signbit(static_cast<double>(plain[i]))) << latitude;
      }
    }
  });
}

TEST(EarthOrientation, PoleLiesWhereTheConventionsPutIt) {
  // ERFA's matrix of polar motion is R_ET, from the axes of the pole to the Earth-fixed ones: its third column is the axis.
  for (const double x : {-0.3, 0.0, 0.2, 3000.0}) {
    for (const double y : {-0.4, 0.0, 0.5, 2000.0}) {
      double R[3][3];
      eraPom00(arcsec(x), arcsec(y), 0, R);
      const Vec3<double> axis(R[0][2], R[1][2], R[2][2]);
      EXPECT_TRUE(close<double>(celestial_axis_E<double>({x, y}), axis, 4 * kEps)) << x << " " << y;
      const float128 size = norm(celestial_axis_E<float128>({x, y}));
      EXPECT_TRUE(close<float128>(size, float128(1), 8 * real::epsilon<float128>()));
    }
  }
  const Vec3<double> axis = celestial_axis_E<double>(kPole);
  EXPECT_GT(axis[0], 0);  // towards Greenwich
  EXPECT_LT(axis[1], 0);  // towards 90 degrees west
}

TEST(EarthOrientation, PolarMotionChangesLatitudesByItsShareOfTheMeridian) {
  for (const auto& [latitude, longitude] : kSites) {
    const Vec3<double> axis = celestial_axis_L<double>({latitude, longitude, 0, 0}, kPole, {});
    const double lambda = longitude * ERFA_DD2R, x = arcsec(kPole.x_arcsec), y = arcsec(kPole.y_arcsec);
    const double change = x * std::cos(lambda) - y * std::sin(lambda), across = x * std::sin(lambda) + y * std::cos(lambda);
    const double phi = latitude * ERFA_DD2R;
    // Terms of the second order, and the rounding of the sines.
    const double bound = x * x + y * y + 8 * kEps;
    EXPECT_NEAR(axis[2], std::sin(phi + change), bound) << latitude << " " << longitude;
    EXPECT_NEAR(axis[1], std::cos(phi + change), bound) << latitude << " " << longitude;
    EXPECT_NEAR(axis[0], -across, bound) << latitude << " " << longitude;
  }
}

TEST(EarthOrientation, PlumbLineShowsTheAstronomicalLatitude) {
  for (const auto& [latitude, longitude] : kSites) {
    for (const double xi : {-40.0, 0.0, 7.0, 60.0}) {
      const Vec3<double> axis = celestial_axis_L<double>({latitude, longitude, 0, 0}, {}, {xi, 0});
      const double phi = latitude * ERFA_DD2R + arcsec(xi);
      EXPECT_TRUE(close<double>(axis, Vec3<double>(0, std::cos(phi), std::sin(phi)), 8 * kEps)) << latitude << " " << xi;
    }
  }
}

TEST(EarthOrientation, DeflectionIsTheLeastTurnOntoThePlumbLine) {
  for (const VerticalDeflection deflection : {VerticalDeflection{12, -30}, {-55, 55}, {0, 8}, {900, 3000}}) {
    const double east = std::tan(arcsec(deflection.east_arcsec)), north = std::tan(arcsec(deflection.north_arcsec));
    const Vec3<double> zenith = Vec3<double>(east, north, 1).normalized(), up(0, 0, 1);
    const double angle = std::atan2(std::hypot(east, north), 1);
    const Mat3<double> R_GL = test::rodrigues<double>(up.cross(zenith).normalized(), angle);
    EXPECT_TRUE(close<double>(plumb_line_attitude<double>(deflection).matrix(), R_GL, 8 * kEps));
    for (const auto& [latitude, longitude] : kSites) {
      const Site site{latitude, longitude, 0, 0};
      const Vec3<double> axis = celestial_axis_L<double>(site, kPole, deflection);
      EXPECT_TRUE(close<double>(axis, R_GL.transpose() * celestial_axis_L<double>(site, kPole, {}), 16 * kEps));
    }
  }
}

TEST(EarthOrientation, EastComponentIsLaplacesCorrection) {
  for (const auto& [latitude, longitude] : kSites) {
    const double xi = 11, eta = 23;
    const Vec3<double> axis = celestial_axis_L<double>({latitude, longitude, 0, 0}, {}, {xi, eta});
    const double phi = latitude * ERFA_DD2R;
    const double second_order = arcsec(eta) * (arcsec(xi) + arcsec(eta));
    EXPECT_NEAR(axis[0], -arcsec(eta) * std::sin(phi), second_order + 8 * kEps) << latitude;
    EXPECT_NEAR(axis[2], std::sin(phi + arcsec(xi)), second_order + 8 * kEps) << latitude;
    // The plumb line's zenith itself: longitude east by eta / cos(latitude).
    if (std::abs(latitude) > 80) continue;
    const Rotation<double> R_EG = laboratory_attitude<double>({latitude, longitude, 0, 0});
    const Vec3<double> zenith_E = R_EG * (plumb_line_attitude<double>({xi, eta}) * Vec3<double>(0, 0, 1));
    const double lambda = std::atan2(zenith_E[1], zenith_E[0]) - longitude * ERFA_DD2R;
    EXPECT_NEAR(std::sin(lambda), arcsec(eta) / std::cos(phi), 30 * second_order) << latitude;  // 1/cos^2(69.7 deg) < 9
  }
}

TEST(EarthOrientation, LongerDaysTurnSlower) {
  EXPECT_EQ(earth_rate_with_length_of_day(7.292115e-5, 0.0), 7.292115e-5);
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const T nominal = T(7.292115146706979e-5), excess = T(0.0015);
    // The turn of 86400 s then takes 86400 s + excess, to first order.
    const T turn = earth_rate_with_length_of_day(nominal, excess) * (T(86400) + excess) / (nominal * T(86400));
    const T ratio = excess / T(86400);
    EXPECT_TRUE(close<T>(turn, T(1) - ratio * ratio, 8 * real::epsilon<T>()));
  });
  EXPECT_NEAR(1 - earth_rate_with_length_of_day(1.0, 0.001), 1.157e-8, 0.0005e-8);  // the printed digits
}

TEST(EarthOrientation, SecularPoleIsThatOfTheConventions) {
  EXPECT_EQ(secular_pole(2000).x_arcsec, 0.0550);
  EXPECT_EQ(secular_pole(2000).y_arcsec, 0.3205);
  EXPECT_NEAR(secular_pole(2020).x_arcsec, 0.08854, 2 * kEps);
  EXPECT_NEAR(secular_pole(2020).y_arcsec, 0.3897, 2 * kEps);
}

TEST(EarthOrientation, PrecessionTurnsTheAxisByTwentyArcsecondsAYear) {
  const UtcInstant utc = parse_utc("2000-01-01T18:30:00Z").value();
  const Vec3<double> rate_I = precession_rate_I(utc);
  // The pole of J2000 moves towards the equinox (x) by 2004.191903" a century [IAU 2006: Capitaine et al. 2003], a turn about
  // +y, and not across, to the change of the rate over the two years.
  const double expected = 2004.191903 * ERFA_DAS2R / (100 * ERFA_DJY * ERFA_DAYSEC);
  EXPECT_NEAR(expected, 3.079e-12, testing::reference(4, 1e-12));
  EXPECT_TRUE(close<double>(rate_I, Vec3<double>(0, expected, 0), 1e-4 * expected));
  EXPECT_LE(std::abs(rate_I.dot(mean_axis_I(terrestrial_time(utc)))), 4 * kEps * expected);

  // In the laboratory +y of the celestial frame, right ascension 6 h on the equator, stands at the hour angle of sidereal time
  // less 6 h. Sidereal time of the Astronomical Almanac; 0.002 rad covers nutation and the equator of date.
  const Site site{48, 11, 0, 0};
  const double days = 6.5 / 24, phi = 48 * ERFA_DD2R;
  const double H = (18.697374558 + 24.06570982441908 * days) * 15 * ERFA_DD2R + 11 * ERFA_DD2R - 90 * ERFA_DD2R;
  const Vec3<double> direction(-std::sin(H), -std::sin(phi) * std::cos(H), std::cos(phi) * std::cos(H));
  EXPECT_TRUE(close<double>(precession_rate_L(site, utc) / expected, direction, 0.002));
}

}  // namespace
}  // namespace earthtop
