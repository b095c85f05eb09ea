// SPDX-License-Identifier: GPL-3.0-or-later
/// The journey of a laboratory: its path against GeographicLib and Clairaut's constant, its rates and what its pivot feels against printed
/// digits and against places in space that are differentiated, normal gravity, and the power series that it is made of.
#include "earthtop/frames/journey.hpp"

#include <fmt/format.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <GeographicLib/Rhumb.hpp>

#include "earthtop/model/laboratory_now.hpp"
#include "frames/earth_figure.hpp"
#include "frames/power_series.hpp"
#include "frames/random_cases.hpp"
#include "support/tolerances.hpp"
#include "support/travel_scenes.hpp"
#include "support/travelling_by_force.hpp"

namespace earthtop {
namespace {

using testing::printed;
using testing::rounding;
using testing::sailing;
using testing::travel_case;
using testing::travel_scenario;

template <class T>
double apart(const Vec3<T>& made, const nlohmann::json& text) {
  const Vec3<T> truth(printed<T>(text.at(0)), printed<T>(text.at(1)), printed<T>(text.at(2)));
  return static_cast<double>(T(norm(Vec3<T>(made - truth)) / norm(truth)));
}

/// The last two of 25 printed digits of the largest component may differ.
constexpr double kPrinted = testing::reference(23, 100);

/// @param share  of a rate's or field's size that may be missed
template <class T>
void expect_laboratory_of(const char* name, double share) {
  const nlohmann::json& known = travel_case(name).at("laboratory");
  const Scene scene(travel_scenario(travel_case(name)));
  const Model<T>& model = scene.model<T>();
  const T t = T(known.at("t_s").get<double>()), degree = real::pi<T>() / T(180);
  const LaboratoryNow<T> now(model, t);
  EXPECT_LT(apart<T>(now.w_IL_L, known.at("w_IL")), share) << name;
  EXPECT_LT(apart<T>(now.alpha_IL_L, known.at("alpha_IL")), share) << name;
  if (known.contains("G")) {
    EXPECT_LT(apart<T>(now.field_L, known.at("G")), share) << name;
  }
  const Vec3<T> moved = model.journey.at(JourneyPart::place, t), course = model.journey.at(JourneyPart::course, t);
  const auto expect = [&](const char* key, const T& value) {
    if (!known.contains(key)) return;
    const T truth = printed<T>(known.at(key));
    EXPECT_LT(static_cast<double>(real::abs(value - truth)), share * std::max(1.0, std::abs(static_cast<double>(truth))))
        << name << ", " << key;
  };
  const Site& site = scene.site();
  expect("latitude_deg", T(site.latitude_deg) + moved[0] / degree);
  expect("longitude_deg", T(site.longitude_deg) + moved[1] / degree);
  expect("height_m", T(site.height_m) + moved[2]);
  expect("course_deg", T(scene.scenario().travel->course_deg) + course[0] / degree);
  expect("speed_m_s", course[1]);
}

TEST(Journey, RatesAndPlacesHaveThePrintedDigits) {
  for (const char* name : {"T1", "T3", "T4"}) {
    expect_laboratory_of<float128>(name, kPrinted);
    expect_laboratory_of<double>(name, 1e-12);  // some hundred roundings, of alpha after two derivatives of series
  }
}

TEST(Journey, NormalGravityHasThePrintedDigits) {
  for (const nlohmann::json& known : testing::travel_references().at("normal_gravity_m_s2")) {
    const double latitude_deg = known.at("latitude_deg").get<double>(), height = known.at("height_m").get<double>();
    const SinCos<float128> phi = sin_cos_degrees(float128(latitude_deg));
    using Series = PowerSeries<float128>;
    const float128 made = normal_gravity_of<float128, Series>(Series(phi.sin), Series(phi.cos), Series(float128(height)))[0];
    EXPECT_LT(static_cast<double>(real::abs(made - printed<float128>(known.at("value")))), 10 * kPrinted) << latitude_deg;
    const float128 closed =
        testing::normal_gravity_by_arc_tangent(float128(latitude_deg) * real::pi<float128>() / 180, float128(height));
    EXPECT_LT(static_cast<double>(real::abs(made - closed)), 10 * kPrinted) << latitude_deg;
    EXPECT_NEAR(normal_gravity(latitude_deg, height), static_cast<double>(made), rounding(20 * 9.8));  // what a scenario takes
  }
}

/// Any journey in 113 bits against its places in space. What does not know the transport rate, its derivative or the Coriolis force on the
/// laboratory has an effect of 1 in these units; so has a wrong figure of the Earth, by its flattening.
void expect_as_by_force(const Scenario& scenario) {
  const Scene scene(scenario);
  const Model<float128>& model = scene.model<float128>();
  const testing::TravellingByForce force(scenario);
  const bool at_rest = scenario.travel->reference == TravelReference::at_rest;
  const auto far = [](const Vec3<float128>& a, const Vec3<float128>& b, double scale) {
    return static_cast<double>(norm(Vec3<float128>(a - b))) / scale;
  };
  for (const double share : {0.0, 0.13, 0.6, 1.0}) {
    const float128 t = share * scenario.duration_s;
    const auto way = share == 0 ? force.start() : force.way_at(t);
    const testing::MovingPlace at = force.place(way, t);
    const auto [rotating, reference] = force.both(at, t);
    const LaboratoryNow<float128> now(model, t);
    const double rate = static_cast<double>(norm(rotating.w)), slope = static_cast<double>(norm(rotating.alpha)) + rate * rate;
    const double field = static_cast<double>(norm(rotating.felt));
    // 113 bits, less what W x (W x r), 6e6 m/s^2 at 1 rad/s, loses beside 10 m/s^2, and what the force's integration of the path leaves.
    constexpr double kLeft = 1e-22;
    EXPECT_LT(far(now.w_IL_L, rotating.w, rate), kLeft) << share;
    EXPECT_LT(far(now.alpha_IL_L, rotating.alpha, slope), kLeft) << share;
    EXPECT_LT(far(now.field_L, rotating.felt, field), kLeft) << share;
    const Mat3<float128> first = force.both(force.place(force.start(), 0), 0)[0].R_IL;
    const Mat3<float128> R_NL = first.transpose() * rotating.R_IL;
    EXPECT_LT(static_cast<double>(testing::TravellingByForce::angle_of(R_NL.transpose() * now.R_NL)), kLeft) << share;
    EXPECT_LT(far(model.journey.at(JourneyPart::rate, t), reference.w, rate), kLeft) << share;
    const Vec3<float128> reference_slope = at_rest ? Vec3<float128>(Vec3<float128>::Zero()) : reference.alpha;
    EXPECT_LT(far(model.journey.at(JourneyPart::rate_slope, t), reference_slope, slope), kLeft) << share;
    const JourneyPlace<double> place = scene.model<double>().journey.place(share * scenario.duration_s);
    const double degree = real::pi<double>() / 180;
    EXPECT_NEAR(place.latitude_deg, static_cast<double>(at.latitude.value) / degree, rounding(400 * 90));
    EXPECT_NEAR(place.longitude_deg, static_cast<double>(at.longitude.value) / degree, rounding(400 * 180));
    EXPECT_NEAR(place.height_m, static_cast<double>(at.height.value), rounding(400 * 12000));
  }
}

TEST(Journey, TurnsAndFeelsAsItsPlacesInSpaceSay) {
  test::Random durations(8);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario s = testing::random_journey(seed, 20);
    testing::Random random(seed + 500);
    s.effects.applied.viscous_N_m_s = 0;
    s.duration_s = durations.uniform(1, 600);
    testing::send_on_journey(s, random, s.duration_s);
    SCOPED_TRACE(s.name);
    expect_as_by_force(s);
  }
}

/// On a planet of 1 km that turns in 12 s no term is small.
TEST(Journey, TurnsAndFeelsOnASmallFastPlanet) {
  for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest}) {
    Scenario s = testing::toy_top();
    s.site.latitude_deg = 35, s.rotation_rate_rad_s = 0.5;
    s.duration_s = 3;
    s.travel = sailing(reference == TravelReference::same_path ? TravelPath::rhumb : TravelPath::geodesic, 40, 200);
    s.travel->figure = TravelFigure::sphere, s.travel->radius_m = 1000, s.travel->reference = reference;
    s.travel->legs = {{1, 250.0, 0, 0}, {1, {}, 30, 20}};
    expect_as_by_force(s);
  }
}

TEST(Journey, ByTableGoesThroughItsSplines) {
  Scenario s = testing::toy_top();
  s.site = {-38, 170, 500, 9.8};
  s.duration_s = 40;
  for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest}) {
    s.travel = testing::by_table(s.site, s.duration_s, 8, {1e-4, -2e-4, 3});
    s.travel->reference = reference;
    expect_as_by_force(s);
  }
}

Journey<double> journey_from(const TravelSpec& spec, const Site& site, double duration_s) {
  JourneySetting<double> setting;
  setting.site = site, setting.duration_s = duration_s;
  return Journey<double>(spec, setting);
}

TEST(Journey, RhumbLinesAndGeodesicsAreThoseOfGeographicLib) {
  const auto& rhumb = GeographicLib::Rhumb::WGS84();
  const auto& geodesic = GeographicLib::Geodesic::WGS84();
  test::Random random(5);
  for (int i = 0; i < 40; ++i) {
    const double latitude = random.uniform(-55, 55), longitude = random.uniform(-90, 90), course = random.uniform(-180, 180);
    const double distance = std::exp(random.uniform(std::log(1e5), std::log(3e6))), speed = random.uniform(5, 300);
    double end_latitude = 0, end_longitude = 0, end_course = 0;
    for (const TravelPath path : {TravelPath::rhumb, TravelPath::geodesic}) {
      if (path == TravelPath::rhumb)
        rhumb.Direct(latitude, longitude, course, distance, end_latitude, end_longitude), end_course = course;
      else
        geodesic.Line(latitude, longitude, course).Position(distance, end_latitude, end_longitude, end_course);
      if (std::abs(end_latitude) > 85) continue;
      const double duration = distance / speed;
      const JourneyPlace place =
          journey_from(sailing(path, course, speed), {latitude, longitude, 0, 9.8}, duration).place(duration);
      // GeographicLib states 15 nm; 1e-12 deg are 110 nm. The flattening moves the end by 1e-2 deg and more.
      constexpr double kDegrees = 1e-12;
      EXPECT_NEAR(place.latitude_deg, end_latitude, kDegrees) << i;
      EXPECT_NEAR(std::remainder(place.longitude_deg - end_longitude, 360.0), 0, kDegrees / sin_cos_degrees(end_latitude).cos)
          << i;
      EXPECT_NEAR(std::remainder(place.course_deg - end_course, 360.0), 0, 4 * kDegrees) << i;
      EXPECT_NEAR(place.length_m, distance, rounding(20) * distance);
      EXPECT_EQ(place.speed_m_s, speed);
    }
  }
}

/// At every height (N + h) cos(latitude) sin(course) is constant along a geodesic.
TEST(Journey, GeodesicsKeepClairautsConstantAtEveryHeight) {
  for (const double height : {-400.0, 0.0, 12000.0, 900000.0}) {
    const Site site{-23, 40, height, 9.8};
    const Journey<double> journey = journey_from(sailing(TravelPath::geodesic, 52, 250), site, 20000);
    const auto constant = [&](double t) {
      const JourneyPlace place = journey.place(t);
      const SinCos<double> phi = sin_cos_degrees(place.latitude_deg), course = sin_cos_degrees(place.course_deg);
      const double f = 1 / kInverseFlatteningWgs84;
      const double N = kEquatorialRadiusWgs84 / std::sqrt(1 - f * (2 - f) * phi.sin * phi.sin);
      return (N + height) * phi.cos * course.sin;
    };
    const double first = constant(0);
    for (double t = 1000; t <= 20000; t += 1000) EXPECT_NEAR(constant(t), first, rounding(40) * kEquatorialRadiusWgs84) << t;
    EXPECT_GT(std::abs(journey.place(20000).latitude_deg - site.latitude_deg), 20);
  }
}

TEST(Journey, IsOneFunctionAcrossItsJointsAndInAnyUnitOfTime) {
  Scenario s = testing::toy_top();
  s.site = {48, 9, 300, 9.81};
  s.duration_s = 4000;
  s.travel = sailing(TravelPath::geodesic, 75, 80);
  s.travel->legs = {{300, 120.0, 40, 0}, {700, {}, -90, 900}, {50, 60.0, 0, 0}};
  for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest}) {
    s.travel->reference = reference;
    const Journey<double> journey = Scene(s).model<double>().journey, other = journey.in_time_units(-7);
    const std::vector<double> joints = journey.joints();
    ASSERT_GE(joints.size(), 3U);
    for (const double corner : {300.0, 1000.0, 1050.0}) EXPECT_NE(std::ranges::find(joints, corner), joints.end()) << corner;
    for (std::size_t i = 0; i < kJourneyParts; ++i) {
      const auto part = static_cast<JourneyPart>(i);
      for (const double t : joints) {
        const Vec3<double> before = journey.at(part, std::nextafter(t, 0.0)), after = journey.at(part, t);
        // Rounding, and what a quantity changes by in an instant; a joint of the path itself would break far more.
        constexpr double kBreak = 1e-11;
        EXPECT_LE(norm(Vec3<double>(after - before)), kBreak * (norm(after) + norm(journey.at(part, t + 1))))
            << i << " at " << t;
      }
      std::array<std::array<double, 3>, 6> rows{};
      for (const double t : {0.0, 123.0, 1000.0, 3999.0}) {
        const Vec3<double> here = journey.at(part, t), there = other.at(part, std::ldexp(t, 7));
        journey.expand(part, t, rows);
        const double step = 0.01;
        Vec3<double> by_series = Vec3<double>::Zero();
        for (std::size_t k = rows.size(); k-- > 0;)
          by_series = step * by_series + Vec3<double>(rows[k][0], rows[k][1], rows[k][2]);
        const Vec3<double> later = journey.at(part, t + step);
        EXPECT_LE(norm(Vec3<double>(by_series - later)), rounding(200) * norm(later)) << i << " at " << t;
        for (int j = 0; j < 3; ++j) {
          if (here[j] == 0) continue;
          EXPECT_EQ(std::abs(std::remainder(std::log2(there[j] / here[j]), 7.0)), 0) << i << " at " << t;
        }
      }
    }
    // A rate in units of 1/128 s is 128 times smaller.
    const auto rate_of = [](const Journey<double>& one, double t) { return norm(one.at(JourneyPart::rate, t)); };
    EXPECT_EQ(rate_of(other, std::ldexp(500.0, 7)), std::ldexp(rate_of(journey, 500), -7));
    const auto speed_of = [](const Journey<double>& one, double t) { return norm(one.at(JourneyPart::velocity_in_L, t)); };
    EXPECT_EQ(speed_of(other, std::ldexp(500.0, 7)), std::ldexp(speed_of(journey, 500), -7));
  }
}

TEST(Journey, ToAPoleIsRefusedWithTheTime) {
  const Site site{89, 0, 0, 9.83};
  const double speed = 100;
  double distance = 0, unused = 0;
  GeographicLib::Geodesic::WGS84().Inverse(89, 0, kLargestLatitudeDeg, 0, distance, unused, unused);
  EXPECT_NO_THROW(journey_from(sailing(TravelPath::rhumb, 0, speed), site, 0.999 * distance / speed));
  for (const TravelPath path : {TravelPath::rhumb, TravelPath::geodesic}) try {
      journey_from(sailing(path, 0, speed), site, 1e5);
      ADD_FAILURE() << "not refused";
    } catch (const JourneyError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("0.1 deg to a pole"), std::string::npos) << text;
      EXPECT_NE(text.find(fmt::format("at t = {:.6g} s", distance / speed)), std::string::npos) << text;
    }
  EXPECT_THROW(journey_from(sailing(TravelPath::rhumb, 170, 5000), {-60, 0, 0, 9.8}, 1e5), JourneyError);
}

/// Against the series of known functions: of e^x by its own derivative, of the tangent by sine over cosine.
TEST(PowerSeries, OperationsAreThoseOfTheFunctions) {
  using Series = PowerSeries<float128>;
  Series x(float128(0.3));
  x[1] = 1;
  const float128 u = 0.07, at = float128(0.3) + u;
  const auto expect = [&](const Series& series, const float128& truth, const char* what) {
    // 28 terms of a radius of convergence above 0.3: u^28 is 1e-18 of that.
    EXPECT_LT(static_cast<double>(real::abs(series.at(u) - truth)), 1e-16) << what;
    EXPECT_LT(static_cast<double>(real::abs(series[0] + series.change_at(u) - series.at(u))), rounding<float128>(50)) << what;
  };
  const SinCos<Series> both = sin_cos(x * x);
  expect(both.sin, real::sin(at * at), "sine");
  expect(both.cos, real::cos(at * at), "cosine");
  expect(sqrt(x), real::sqrt(at), "square root");
  expect(Series(float128(1)) / x, 1 / at, "quotient");
  expect(both.sin / both.cos, real::sin(at * at) / real::cos(at * at), "tangent");
  expect(derivative(both.sin), 2 * at * real::cos(at * at), "derivative");
  expect(integral(Series(float128(1)) / x, real::log(float128(0.3))), real::log(at), "integral");
  expect(x * x * x - Series(float128(2)) * x + -x, at * at * at - 3 * at, "polynomial");
  // A derivative knows a term less, and so does all that is made with it.
  EXPECT_EQ(derivative(x).terms, Series::kMost - 1);
  EXPECT_EQ((derivative(x) * x).terms, Series::kMost - 1);
  EXPECT_EQ(integral(derivative(x), float128(0)).terms, Series::kMost);
}

}  // namespace
}  // namespace earthtop
