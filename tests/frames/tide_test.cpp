// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/tide.hpp"

#include <cmath>

#include "frames/ephemeris.hpp"
#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::at_most;
using test::close;
using test::for_each_scalar;
using test::Random;

constexpr double kDegree = 0.017453292519943295;
constexpr double kTide = 1.6e-6;  // the largest of both bodies together (m/s^2)
constexpr double kMoonDistance = 384.4e6, kAstronomicalUnit = 149597870700.0, kEarthRadius = 6378137.0;

UtcInstant at(const char* text) { return parse_utc(text).value(); }

TEST(Utc, ReadsOneFormOnly) {
  const auto julian = [](const char* text) { return at(text).day + at(text).fraction; };
  EXPECT_EQ(julian("2000-01-01T12:00:00Z"), 2451545.0);
  EXPECT_EQ(julian("2024-02-29T00:00:00.000Z"), 2460369.5);
  EXPECT_NEAR(at("2000-01-01T12:00:00.864Z").fraction, 0.5 + 1e-5, std::numeric_limits<double>::epsilon());
  EXPECT_TRUE(parse_utc("2016-12-31T23:59:60.5Z"));  // a leap second
  EXPECT_TRUE(parse_utc("2150-06-01T00:00:00Z"));
  for (const char* text : {"",
                           "Z",
                           "2000-01-01",
                           "2000-01-01T12:00:00",
                           "2000-01-01T12:00:00z",
                           "2000-01-01 12:00:00Z",
                           "2000-01-01T12:00Z",
                           "2000-1-01T12:00:00Z",
                           "2000-01-01T12:00:00.Z",
                           "2000-01-01T12:00:00,5Z",
                           "2000-01-01T12:00:00.5.5Z",
                           "2000-01-01T12:00:00+00:00",
                           " 2000-01-01T12:00:00Z",
                           "2000-01-01T12:00:00Z ",
                           "+000-01-01T12:00:00Z",
                           "2000-13-01T12:00:00Z",
                           "2000-00-01T12:00:00Z",
                           "2000-02-30T12:00:00Z",
                           "1900-02-29T12:00:00Z",
                           "2000-01-00T12:00:00Z",
                           "2000-01-01T24:00:00Z",
                           "2000-01-01T12:60:00Z",
                           "2000-01-01T12:00:60Z",
                           "2017-12-31T23:59:60Z",
                           "2000-01-01T12:00:1e1Z",
                           "2000-01-01T12:00:00.1e1Z"})
    EXPECT_FALSE(parse_utc(text)) << text;
}

TEST(Utc, TerrestrialTimeIsAheadByTheLeapSecondsAnd32184Milliseconds) {
  for (const auto& [text, leap_seconds] :
       {std::pair{"1999-01-01T00:00:00Z", 32}, {"2016-12-31T00:00:00Z", 36}, {"2024-04-08T18:00:00Z", 37}}) {
    const UtcInstant utc = at(text);
    const TerrestrialTime tt = terrestrial_time(utc, 1000);
    // Days to three roundings of a number below 2.
    EXPECT_NEAR((tt.day - utc.day) + (tt.fraction - utc.fraction), (1000 + leap_seconds + 32.184) / 86400,
                3 * real::epsilon<double>());
  }
}

TEST(Tide, DifferentialAttractionLosesNoDigits) {
  Random random(71);
  for (const auto& [gm, distance] :
       {std::pair{kGravitationalConstantMoon, kMoonDistance}, {kGravitationalConstantSun, kAstronomicalUnit}}) {
    for (int k = 0; k < 100; ++k) {
      const Vec3<double> d = distance * random.unit<double>(), r = kEarthRadius * random.unit<double>();
      Vec3<float128> d_128, r_128;
      for (int i = 0; i < 3; ++i) d_128[i] = d[i], r_128[i] = r[i];
      const Vec3<float128> s = d_128 - r_128;
      const float128 s3 = norm(s) * norm(s) * norm(s), d3 = norm(d_128) * norm(d_128) * norm(d_128);
      const Vec3<float128> exact = float128(gm) * (s / s3 - d_128 / d3), a = differential_attraction(gm, d, r).cast<float128>();
      // The worst is q = r.(r - 2d)/d^2 where r is across d: 3 rounded products of r d, against a tide of GM r/d^3.
      const double bound = 16 * std::numeric_limits<double>::epsilon() * gm * kEarthRadius / std::pow(distance, 3);
      EXPECT_TRUE(close<float128>(a, exact, float128(bound)));
    }
  }
}

TEST(Tide, HasTheSizesOfTheReferenceValues) {
  const auto tide = [](double gm, double distance, double zenith_deg) {
    const double z = zenith_deg * kDegree;
    return differential_attraction(gm, distance * Vec3<double>(std::sin(z), 0, std::cos(z)), {0, 0, kEarthRadius});
  };
  // 1.101e-6 and 0.506e-6 m/s^2 are of the second degree: the third, 3/2 r/d of it, is odd and leaves zenith less nadir.
  const double moon =
      (tide(kGravitationalConstantMoon, kMoonDistance, 0)[2] + tide(kGravitationalConstantMoon, kMoonDistance, 180)[2]) / 2;
  const double sun =
      (tide(kGravitationalConstantSun, kAstronomicalUnit, 0)[2] + tide(kGravitationalConstantSun, kAstronomicalUnit, 180)[2]) /
      2;
  EXPECT_NEAR(moon, 1.101e-6, 0.0005e-6 + 1.101e-6 * 2 * std::pow(kEarthRadius / kMoonDistance, 2));  // and the fourth
  EXPECT_NEAR(sun, 0.506e-6, 0.0005e-6);
  // Together in the same direction at 45 degrees from the zenith, they tilt the plumb line by 0.025 arcsec; the third degree is
  // even.
  double across = 0;
  for (const auto& [gm, distance] :
       {std::pair{kGravitationalConstantMoon, kMoonDistance}, {kGravitationalConstantSun, kAstronomicalUnit}})
    across += (tide(gm, distance, 45)[0] - tide(gm, distance, 135)[0]) / 2;
  EXPECT_NEAR(across / 9.8 / kDegree * 3600, 0.025, 0.0005);
}

TEST(Tide, EclipseOf8April2024FallsWhereItDid) {
  // Greatest eclipse 18:17:20 UTC at 25.285 N, 104.138 W, Sun 69.8 degrees high at azimuth 149.4; least distance of the
  // shadow's axis from the Earth's centre 0.3431 radii [NASA, Espenak: Five Millennium Canon of Solar Eclipses].
  const UtcInstant utc = at("2024-04-08T18:17:20Z");
  const TerrestrialTime tt = terrestrial_time(utc);
  const Vec3<double> moon = moon_position_I(tt), sun = sun_position_I(tt);
  const Vec3<double> along = (moon - sun).normalized();
  // The Moon's theory is good to 10 arcsec, the Sun's light is bent by 20 arcsec of aberration at the Moon's distance: 20 km.
  EXPECT_NEAR(norm<double>(moon - moon.dot(along) * along) / kEarthRadius, 0.3431, 0.006);

  const Site site{25.285, -104.138, 0, 0};
  const Rotation<double> R_LE = laboratory_attitude<double>(site).inverse();
  const Mat3<double> R_EI = celestial_to_terrestrial(utc);
  const Vec3<double> site_L = geocentric_position_L(site.latitude_deg, site.height_m);
  const Vec3<double> moon_L = (R_LE * (R_EI * moon) - site_L).normalized(), sun_L = (R_LE * (R_EI * sun) - site_L).normalized();
  EXPECT_LT(norm<double>(moon_L - sun_L), 0.015 * kDegree);  // discs of 0.53 degrees
  EXPECT_NEAR(std::asin(sun_L[2]) / kDegree, 69.8, 0.1);
  EXPECT_NEAR(std::atan2(sun_L[0], sun_L[1]) / kDegree, 149.4, 0.2);
  // Both pull the same way, up: the tide is near its greatest.
  const double up = tidal_acceleration_L(site, utc)[2];
  EXPECT_GT(up, 1.3e-6);
  EXPECT_LT(up, 2.0e-6);
}

// An independent, coarse formula: the low-precision Sun and Moon of the Astronomical Almanac (pages C5 and D22), mean sidereal
// time.
struct Body {
  double right_ascension, declination, distance;  // rad, rad, m
};
Body body_of(double longitude, double latitude, double distance, double obliquity) {
  const double x = std::cos(latitude) * std::cos(longitude), y = std::cos(latitude) * std::sin(longitude),
               z = std::sin(latitude);
  const double c = std::cos(obliquity), s = std::sin(obliquity);
  return {std::atan2(c * y - s * z, x), std::asin(s * y + c * z), distance};
}
double sine(double degrees) { return std::sin(degrees * kDegree); }
double cosine(double degrees) { return std::cos(degrees * kDegree); }
Body almanac_sun(double days) {
  const double g = 357.528 + 0.9856003 * days;
  const double longitude = 280.460 + 0.9856474 * days + 1.915 * sine(g) + 0.020 * sine(2 * g);
  const double distance = 1.00014 - 0.01671 * cosine(g) - 0.00014 * cosine(2 * g);
  return body_of(longitude * kDegree, 0, distance * kAstronomicalUnit, 23.439 * kDegree);
}
Body almanac_moon(double days) {
  const double T = days / 36525;
  const double longitude = 218.32 + 481267.881 * T + 6.29 * sine(135.0 + 477198.87 * T) - 1.27 * sine(259.3 - 413335.36 * T) +
                           0.66 * sine(235.7 + 890534.22 * T) + 0.21 * sine(269.9 + 954397.74 * T) -
                           0.19 * sine(357.5 + 35999.05 * T) - 0.11 * sine(186.5 + 966404.03 * T);
  const double latitude = 5.13 * sine(93.3 + 483202.02 * T) + 0.28 * sine(228.2 + 960400.89 * T) -
                          0.28 * sine(318.3 + 6003.15 * T) - 0.17 * sine(217.6 - 407332.21 * T);
  const double parallax = 0.9508 + 0.0518 * cosine(135.0 + 477198.87 * T) + 0.0095 * cosine(259.3 - 413335.36 * T) +
                          0.0078 * cosine(235.7 + 890534.22 * T) + 0.0028 * cosine(269.9 + 954397.74 * T);
  return body_of(longitude * kDegree, latitude * kDegree, kEarthRadius / sine(parallax), 23.439 * kDegree);
}
/// The second and third degree of the tidal potential on a sphere, GM r^n/d^(n+1) P_n(cos z), as an acceleration.
Vec3<double> potential_tide(double gm, const Body& body, const Site& site, double days) {
  const double sidereal = (18.697374558 + 24.06570982441908 * days) * 15 + site.longitude_deg;
  const double H = sidereal * kDegree - body.right_ascension, phi = site.latitude_deg * kDegree;
  const double c = std::cos(body.declination), s = std::sin(body.declination);
  const Vec3<double> direction(-c * std::sin(H), std::cos(phi) * s - std::sin(phi) * c * std::cos(H),
                               std::sin(phi) * s + std::cos(phi) * c * std::cos(H));
  const double r = 6371e3, ratio = r / body.distance, size = gm * r / std::pow(body.distance, 3), cos_z = direction[2];
  const double up = size * ((3 * cos_z * cos_z - 1) + ratio * 1.5 * (5 * cos_z * cos_z - 3) * cos_z);
  const double towards = size * (3 * cos_z + ratio * 1.5 * (5 * cos_z * cos_z - 1));  // times sin z along the horizon
  return {towards * direction[0], towards * direction[1], up};
}

TEST(Tide, AgreesWithTheTidalPotentialAndTheAlmanacsMoonAndSun) {
  const UtcInstant utc = at("2023-03-05T12:00:00Z");
  const double days_at_start = utc.day + utc.fraction - 2451545.0;
  for (const Site& site :
       {Site{0, 0, 0, 0}, Site{47, 8, 500, 0}, Site{-33, 151, 0, 0}, Site{-77, -120, 2000, 0}, Site{90, 0, 0, 0}}) {
    double largest = 0;
    for (int k = 0; k < 120; ++k) {
      const double days = k * 0.27;
      const double at_days = days_at_start + days;
      for (const bool moon : {true, false}) {
        const Vec3<double> coarse = moon ? potential_tide(kGravitationalConstantMoon, almanac_moon(at_days), site, at_days)
                                         : potential_tide(kGravitationalConstantSun, almanac_sun(at_days), site, at_days);
        const Vec3<double> a = tidal_acceleration_L(site, utc, days * 86400, {.moon = moon, .sun = !moon});
        // Moon: 0.3 + 0.2 degrees, each 3/2 of the amplitude a radian, and 3 x 0.003/0.95 of the parallax. Both: the flattening
        // (the vertical, 0.2 degrees, and the radius, 0.3 %).
        const double bound = moon ? 1.1e-6 * 1.2 * 0.03 : 0.506e-6 * 1.05 * 0.01;
        EXPECT_TRUE(close<double>(a, coarse, bound)) << site.latitude_deg << " day " << days << (moon ? " moon" : " sun");
        largest = std::max(largest, norm(a));
      }
    }
    EXPECT_GT(largest, 0.7e-6);
    EXPECT_LT(largest, 1.5e-6);
  }
}

TEST(Tide, BodiesAddAndTheElasticEarthScales) {
  const Site site{47, 8, 500, 0};
  const UtcInstant utc = at("2026-06-01T03:00:00Z");
  const Vec3<double> both = tidal_acceleration_L(site, utc, 1000), moon = tidal_acceleration_L(site, utc, 1000, {.sun = false}),
                     sun = tidal_acceleration_L(site, utc, 1000, {.moon = false});
  EXPECT_TRUE(close<double>(both, moon + sun, 1e-15 * kTide));
  EXPECT_EQ(tidal_acceleration_L(site, utc, 1000, {.moon = false, .sun = false}), Vec3<double>::Zero());
  const Vec3<double> elastic = tidal_acceleration_L(site, utc, 1000, {.gravimetric_factor = 1.16, .tilt_factor = 0.69});
  EXPECT_EQ(elastic, Vec3<double>(0.69 * both[0], 0.69 * both[1], 1.16 * both[2]));
  // 1000 s later is 1000 s later.
  EXPECT_TRUE(close<double>(both, tidal_acceleration_L(site, at("2026-06-01T03:16:40Z")), 1e-12 * kTide));
}

// Two evaluations of a body's tide differ by the rounding of its angles, to which the tide is up to three times as sensitive.
// Since 2000, the Moon's mean longitude has advanced by 1.3e5 degrees, and the Earth's angle relative to the mean Sun by 26
// turns.
constexpr double kMoonRounding = 2 * 3 * real::epsilon<double>() * 1.3e5 * kDegree * 1.1e-6;
constexpr double kSunRounding = 2 * 3 * real::epsilon<double>() * 26 * 360 * kDegree * 0.506e-6;

TEST(TideSeries, IsTheTide) {
  const UtcInstant utc = at("2026-03-20T22:15:00Z");
  const auto largest_difference = [&](const Site& site, double duration, const TideOptions& bodies) {
    const auto series = TideSeries<double>::of_bodies(site, utc, duration, bodies);
    double largest = 0;
    for (int k = 0; k <= 300; ++k) {
      const double t = duration * k / 300;
      largest = std::max(largest, norm<double>(series.acceleration_L(t) - tidal_acceleration_L(site, utc, t, bodies)));
    }
    return largest;
  };
  for (const Site& site : {Site{0, 10, 0, 0}, Site{51, -3, 200, 0}}) {
    for (const double duration : {10.0, 2 * 86400.0, -86400.0}) {
      EXPECT_TRUE(at_most(largest_difference(site, duration, {}), kMoonRounding)) << duration;
      EXPECT_TRUE(at_most(largest_difference(site, duration, {.moon = false}), kSunRounding)) << duration;
    }
  }
}

TEST(TideSeries, IsContinuousFromPieceToPieceAndTheSameInEveryPrecision) {
  const Site site{51, -3, 200, 0};
  const UtcInstant utc = at("2026-03-20T22:15:00Z");
  const auto in_double = TideSeries<double>::of_bodies(site, utc, 86400);
  const auto in_float128 = TideSeries<float128>::of_bodies(site, utc, 86400);
  for (int piece = 1; piece < 8; ++piece) {
    const double edge = piece * 10800.0;
    const float128 before = float128(edge) * (1 - real::epsilon<float128>() * 16);
    EXPECT_TRUE(close<float128>(in_float128.acceleration_L(before), in_float128.acceleration_L(edge), float128(kMoonRounding)));
  }
  for (const double t : {-100.0, 0.0, 5.0, 10799.0, 10800.0, 40000.1, 86400.0, 86500.0}) {
    const Vec3<float128> a = in_float128.acceleration_L(t);
    // 13 terms, each rounded twice; Clenshaw multiplies the rounding of the highest by its degree.
    EXPECT_TRUE(
        close<float128>(in_double.acceleration_L(t).cast<float128>(), a, float128(26 * 13 * real::epsilon<double>() * kTide)));
  }
  // Every time is accepted, though far out there is no value.
  for (const double t : {-1e300, 1e300, std::numeric_limits<double>::quiet_NaN()}) in_double.acceleration_L(t);
}

TEST(TideSeries, HarmonicAndNothing) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const TideSeries<T> nothing;
    EXPECT_TRUE(nothing.empty());
    EXPECT_TRUE(test::identical(nothing.acceleration_L(T(3)), Vec3<T>::Zero()));
    EXPECT_TRUE(nothing.scaled(-5).empty());
    EXPECT_TRUE(TideSeries<T>::of_bodies({}, at("2026-03-20T22:15:00Z"), 10, {.moon = false, .sun = false}).empty());
    EXPECT_FALSE(TideSeries<T>::of_bodies({}, at("2026-03-20T22:15:00Z"), 10, {.sun = false}).empty());
    const Vec3<T> amplitude(T(1e-6), T(-2e-6), T(4e-6));
    EXPECT_TRUE(TideSeries<T>::harmonic(Vec3<T>::Zero(), T(1), T(0)).empty());
    const auto harmonic = TideSeries<T>::harmonic(amplitude, T(0.25), real::pi<T>() / T(6));
    EXPECT_FALSE(harmonic.empty());
    const T bound = T(4e-6) * 8 * real::epsilon<T>();
    EXPECT_TRUE(close<T>(harmonic.acceleration_L(T(0)), amplitude / T(2), bound));
    EXPECT_TRUE(close<T>(harmonic.acceleration_L(T(1)), real::sqrt(T(3)) / T(2) * amplitude, bound));
    EXPECT_TRUE(close<T>(harmonic.acceleration_L(T(2)), -amplitude / T(2), bound));
  });
}

TEST(TideSeries, IsExactInUnitsOfAPowerOfTwo) {
  const Site site{51, -3, 200, 0};
  const UtcInstant utc = at("2026-03-20T22:15:00Z");
  for_each_scalar([&](auto scalar) {
    using T = decltype(scalar);
    const auto tide = TideSeries<T>::of_bodies(site, utc, 40000);
    const auto harmonic = TideSeries<T>::harmonic(Vec3<T>(T(1e-6), T(0), T(3e-6)), T(0.3), T(0.7));
    for (const auto& series : {tide, harmonic}) {
      for (const int k : {-7, -1, 0, 4}) {
        const T unit = real::scale(T(1), k);  // s
        const T t = T(12345.678);
        const Vec3<T> expected = unit * unit * series.acceleration_L(t);
        EXPECT_TRUE(test::identical(series.scaled(k).acceleration_L(t / unit), expected)) << k;
        EXPECT_TRUE(test::identical(series.scaled(k).scaled(-k).acceleration_L(t), series.acceleration_L(t))) << k;
      }
    }
  });
}

}  // namespace
}  // namespace earthtop
