// SPDX-License-Identifier: GPL-3.0-or-later
// The sentences that say why a drift is what it is: each number, and each word of a direction, against the motion itself.
#include "run/why.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closed_form/top_constants.hpp"
#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/ledger.hpp"
#include "earthtop/model/release.hpp"
#include "support/changed_scene.hpp"
#include "support/tolerances.hpp"
#include "support/why_sentences.hpp"

namespace earthtop {
namespace {

using testing::find;
using testing::number;
using testing::says;

constexpr double kDegree = std::numbers::pi / 180;

Scenario toy_top(double latitude_deg, double spin_rad_s) {
  Scenario s;
  s.site = {latitude_deg, 0, 0, 9.80665};
  s.body.mass_kg = 0.1;
  s.body.center_of_mass_m = {0, 0, 0.03};
  s.body.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, 4e-5}}};
  s.release.tilt_deg = 20;
  s.release.azimuth_deg = 70;
  s.release.spin_rad_s = spin_rad_s;
  s.duration_s = 16;
  s.output_step_s = 0.013;
  return s;
}

/// The mean rate at which an axis goes round (rad/s, counterclockwise about Up): the slope of its azimuth's line.
double seen_precession(const RunResult& result, std::array<double, 3> DriftRow::*axis) {
  double before = 0, turned = 0, t = 0, tt = 0, a = 0, ta = 0, n = 0;
  for (const DriftRow& row : result.rows) {
    const double angle = std::atan2((row.*axis)[1], (row.*axis)[0]);
    turned = n == 0 ? angle : turned + std::remainder(angle - before, 2 * std::numbers::pi);
    before = angle;
    t += row.t_s, tt += row.t_s * row.t_s, a += turned, ta += turned * row.t_s, ++n;
  }
  return (n * ta - t * a) / (n * tt - t * t);
}

/// How much lower the axis stands above South than above North, halved, because of the Earth (rad).
double seen_lean(const RunResult& result) {
  double south = 0, weight = 0;
  for (const DriftRow& row : result.rows) {
    const double to_south = -row.axis_L[1] / std::hypot(row.axis_L[0], row.axis_L[1]);
    south += row.drift_tilt_rad * to_south, weight += to_south * to_south;
  }
  return south / weight;
}

struct Precessing {
  const char* name;
  Scenario scenario;
};
void PrintTo(const Precessing& top, std::ostream* out) { *out << top.name; }

std::vector<Precessing> precessing_tops() {
  std::vector<Precessing> tops;
  const auto add = [&](const char* name, Scenario scenario, const auto& change) {
    change(scenario);
    tops.push_back({name, std::move(scenario)});
  };
  for (const double latitude : {-50.0, 35.0})
    for (const double spin : {-200.0, 200.0})
      for (const RatesRelativeTo frame : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial})
        add("a toy top", toy_top(latitude, spin), [&](Scenario& s) { s.release.rates_relative_to = frame; });
  const auto steady = [](double tilt_deg) {
    return [tilt_deg](Scenario& s) { s.release.precession = Precession::steady_slow, s.release.tilt_deg = tilt_deg; };
  };
  add("small tilt", toy_top(35, 200), steady(3));
  add("large tilt", toy_top(-50, -200), steady(80));
  add("hanging", toy_top(35, 200), steady(130));
  add("fast precession", toy_top(35, -300), [](Scenario& s) {
    s.release.precession = Precession::steady_fast, s.release.tilt_deg = 20;
    s.output_step_s = 0.007;
  });
  add("slow top", toy_top(-50, 110), steady(40));
  add("an Earth that turns the other way, faster", toy_top(35, 200), [](Scenario& s) { s.rotation_rate_rad_s *= -30; });
  return tops;
}

class WhyPrecessing : public ::testing::TestWithParam<Precessing> {};
INSTANTIATE_TEST_SUITE_P(Tops, WhyPrecessing, ::testing::ValuesIn(precessing_tops()));

TEST_P(WhyPrecessing, TheEarthAndItsTorqueHaveTheirSizes) {
  const RunResult result = run(GetParam().scenario);
  const Scenario& s = result.scene.scenario();
  EXPECT_DOUBLE_EQ(number(result, "earth_turns", "earth_angle_rad"), std::abs(s.rotation_rate_rad_s) * s.duration_s);
  double coriolis = 0, gravity = 0;
  for (const DriftRow& row : result.looks) {
    const Quaternion<double> q{row.q_LB[0], Vec3<double>(row.q_LB[1], row.q_LB[2], row.q_LB[3])};
    const auto entry = ledger_entry(LedgerObserver::laboratory, result.modelled.model<double>(), row.t_s, q,
                                    Vec3<double>(row.w_LB_B[0], row.w_LB_B[1], row.w_LB_B[2]));
    coriolis = std::max(coriolis, entry.tau_cor_A.norm());
    gravity = std::max(gravity, entry.tau_phys_A.norm());
  }
  // Between the looks, twelve of which see each swing, they rise a little higher.
  constexpr double kHigher = 0.034, kRounding = 1e-12;
  const double told = number(result, "coriolis_torque", "coriolis_torque_N_m"),
               beside = number(result, "coriolis_torque", "gravity_torque_N_m");
  EXPECT_GE(told, coriolis * (1 - kRounding));
  EXPECT_LE(told, coriolis * (1 + kHigher));
  EXPECT_GE(beside, gravity * (1 - kRounding));
  EXPECT_LE(beside, gravity * (1 + kHigher));
  EXPECT_NEAR(number(result, "coriolis_torque", "ratio"), told / beside, kRounding * told / beside);
}

TEST_P(WhyPrecessing, LooksSlowerOrFasterAsItIsSeen) {
  const RunResult result = run(GetParam().scenario);
  const Scenario& s = result.scene.scenario();
  const double there = seen_precession(result, &DriftRow::axis_L), without = seen_precession(result, &DriftRow::ref_axis_L);
  const double Omega_up = s.rotation_rate_rad_s * std::sin(s.site.latitude_deg * kDegree);
  const WhySentence *turns = find(result, "laboratory_turns"), *left = find(result, "what_is_left");
  ASSERT_TRUE(turns && left);
  EXPECT_NEAR(number(result, "laboratory_turns", "laboratory_rate_rad_s"), Omega_up, 1e-12 * std::abs(Omega_up));
  EXPECT_NEAR(number(result, "laboratory_turns", "precession_rad_s"), without, 2e-3 * std::abs(without));
  EXPECT_TRUE(says(*turns, Omega_up > 0 ? "rad/s counterclockwise seen from above" : "rad/s clockwise seen from above"))
      << turns->text;
  EXPECT_TRUE(says(*turns, without > 0 ? "rad/s counterclockwise, therefore" : "rad/s clockwise, therefore")) << turns->text;
  // The laboratory runs after the axis, or against it.
  const double faster = Omega_up * without > 0 ? -std::abs(Omega_up) : std::abs(Omega_up);
  EXPECT_NEAR(number(result, "laboratory_turns", "faster_by_rad_s"), faster, 1e-12 * std::abs(faster));
  EXPECT_TRUE(says(*turns, faster > 0 ? "looks faster" : "looks slower")) << turns->text;
  // The whole change, from the azimuths of the rows.
  const double change = std::abs(there) - std::abs(without), told = number(result, "what_is_left", "computed_faster_by_rad_s");
  EXPECT_NEAR(told, change, 0.05 * std::abs(change) + 1e-9) << left->text;
  const std::string word = told > 0 ? "faster" : "slower", other = told > 0 ? "slower" : "faster";
  const std::string all = left->text.substr(left->text.find("In all"));
  EXPECT_NE(all.find("the precession is " + word + " by"), all.npos) << all;
  EXPECT_NE(all.find("theory and " + word + " by"), all.npos) << all;
  EXPECT_EQ(all.find(other), all.npos) << all;
  EXPECT_LE(std::abs(told - number(result, "what_is_left", "predicted_faster_by_rad_s")),
            number(result, "what_is_left", "predicted_error_rad_s") + number(result, "what_is_left", "computed_error_rad_s"));
}

TEST_P(WhyPrecessing, TheConeLeansAsTheTiltsShow) {
  const RunResult result = run(GetParam().scenario);
  const WhySentence* leans = find(result, "cone_leans");
  ASSERT_TRUE(leans);
  const double seen = seen_lean(result), told = number(result, "cone_leans", "lean_south_rad");
  EXPECT_NEAR(told, seen, 0.12 * std::abs(seen)) << leans->text;
  EXPECT_TRUE(says(*leans, seen > 0 ? "to the South." : "to the North.")) << leans->text;
}

TEST_P(WhyPrecessing, WhatIsLeftIsTheSwingBesideTheLine) {
  const RunResult result = run(GetParam().scenario);
  const double rate = *result.drift.secular->azimuth_rate_rad_s;
  double least = 0, most = 0;
  for (const DriftRow& row : result.rows) {
    least = std::min(least, *row.drift_azimuth_rad - rate * row.t_s);
    most = std::max(most, *row.drift_azimuth_rad - rate * row.t_s);
  }
  EXPECT_NEAR(number(result, "what_is_left", "azimuth_swing_rad"), (most - least) / 2, 0.03 * (most - least));
}

// At a pole, with the same rates in space, the laboratory's turning is all there is: the motion is the same one.
TEST(Why, AtAPoleTheLaboratorysTurningIsAll) {
  for (const double latitude : {-90.0, 90.0})
    for (const double spin : {-200.0, 200.0}) {
      Scenario s = toy_top(latitude, spin);
      s.release.rates_relative_to = RatesRelativeTo::inertial;
      const RunResult result = run(s);
      const double faster = latitude * spin > 0 ? -kEarthRateWgs84 : kEarthRateWgs84;
      EXPECT_NEAR(number(result, "laboratory_turns", "faster_by_rad_s"), faster, testing::rounding(20) * kEarthRateWgs84);
      EXPECT_NEAR(number(result, "what_is_left", "computed_faster_by_rad_s"), faster, testing::rounding(100) * kEarthRateWgs84);
      EXPECT_NEAR(number(result, "what_is_left", "of_release_faster_by_rad_s"), 0, testing::rounding(20) * kEarthRateWgs84);
      EXPECT_FALSE(says(*find(result, "what_is_left"), "With this release"));
      EXPECT_FALSE(find(result, "cone_leans")) << "there is no North";
    }
}

// With the same rates in the laboratory, the top at a pole is another one in space: it has the Earth's rate besides.
TEST(Why, AtAPoleTheReleaseCountsAsTheRatesInSpaceSay) {
  for (const double latitude : {-90.0, 90.0})
    for (const double spin : {-200.0, 200.0}) {
      const RunResult result = run(toy_top(latitude, spin));
      const Scene& scene = result.modelled;
      const Release<double>& release = scene.release<double>();
      const auto precession = [&](const Vec3<double>& w_B) {
        return mean_rates(top_constants(scene.body<double>(), scene.axial_gravity_torque_N_m(), release.q_LB, w_B))
            ->precession_rad_s;
      };
      const Vec3<double> W_L(0, 0, latitude > 0 ? kEarthRateWgs84 : -kEarthRateWgs84);
      const Vec3<double> W_B = transposed_times(rotation_matrix(release.q_LB), W_L);
      const double faster = std::abs(precession(release.w_XB_B + W_B)) - std::abs(precession(release.w_XB_B));
      EXPECT_NEAR(number(result, "what_is_left", "of_release_faster_by_rad_s"), faster, 1e-3 * std::abs(faster));
      EXPECT_TRUE(
          says(*find(result, "what_is_left"), faster > 0 ? "makes the precession faster" : "makes the precession slower"));
    }
}

TEST(Why, AtTheEquatorTheLaboratoryDoesNotTurnAboutItsVertical) {
  Scenario s = toy_top(0, 200);
  s.release.azimuth_deg = 90;  // nothing of the Earth's rate along the axis
  const RunResult result = run(s);
  EXPECT_TRUE(find(result, "earth_turns"));
  EXPECT_FALSE(find(result, "laboratory_turns"));
  ASSERT_TRUE(find(result, "what_is_left"));
  EXPECT_TRUE(says(*find(result, "what_is_left"), "In all, the precession is neither slower nor faster within"));
  EXPECT_TRUE(says(*find(result, "cone_leans"), "to the South"));
}

// The lean of steady precession, slow and rather fast, standing and hanging, to first order in the Earth's rate.
TEST(Why, TheLeanOfSteadyPrecessionIsThatOfTheMotion) {
  for (const double tilt_deg : {10.0, 60.0, 90.0, 150.0})
    for (const double spin : {-120.0, 400.0}) {
      Scenario s = toy_top(20, spin);
      s.rotation_rate_rad_s = 1e-9;
      s.release.precession = Precession::steady_slow;
      s.release.tilt_deg = tilt_deg;
      s.release.rates_relative_to = RatesRelativeTo::inertial;
      const RunResult result = run(testing::changed(s, [](Scenario& x) { x.duration_s = 40; }));
      ASSERT_TRUE(find(result, "cone_leans")) << tilt_deg << ' ' << spin;
      EXPECT_NEAR(number(result, "cone_leans", "lean_south_rad"), seen_lean(result), 0.02 * std::abs(seen_lean(result)))
          << tilt_deg << ' ' << spin;
    }
}

TEST(Why, AFreeGyroscopeTurnsWithTheStars) {
  for (const double latitude : {-30.0, 50.0})
    for (const double rate : {kEarthRateWgs84, -0.02}) {
      Scenario s = toy_top(latitude, 200);
      s.body.center_of_mass_m = {0, 0, 0};
      s.release.rates_relative_to = RatesRelativeTo::inertial;
      s.rotation_rate_rad_s = rate;
      const RunResult result = run(s);
      const WhySentence* stars = find(result, "turns_with_the_stars");
      ASSERT_TRUE(stars && find(result, "no_torque") && find(result, "what_is_left"));
      // The pole of the sky is due North at the height of the latitude; seen from there, the axis moves as the sentence says.
      const Vec3<double> pole(0, std::cos(latitude * kDegree), std::sin(latitude * kDegree));
      const auto& first = result.rows.front().axis_L;
      const auto& last = result.rows.back().axis_L;
      const Vec3<double> from(first[0], first[1], first[2]), to(last[0], last[1], last[2]);
      EXPECT_NEAR(number(result, "turns_with_the_stars", "angle_from_celestial_pole_rad"), std::acos(pole.dot(from)),
                  testing::rounding(100));
      const Vec3<double> across = from - pole.dot(from) * pole, after = to - pole.dot(to) * pole;
      const double turned = std::atan2(pole.dot(across.cross(after)), across.dot(after));  // counterclockwise about the pole
      EXPECT_NEAR(turned, -rate * s.duration_s, testing::rounding(100));
      EXPECT_TRUE(says(*stars, turned > 0 ? ", counterclockwise seen" : ", clockwise seen")) << stars->text;
      EXPECT_NEAR(number(result, "what_is_left", "predicted_rad"), std::acos(from.dot(to)), 1e-9);
    }
}

TEST(Why, ASleepingTopLeansWhereTheTorquesBalance) {
  for (const double latitude : {-30.0, 50.0})
    for (const double spin : {-300.0, 300.0}) {
      Scenario s = toy_top(latitude, spin);
      s.release.tilt_deg = 0;
      s.duration_s = 30;
      const RunResult result = run(s);
      const WhySentence *rest = find(result, "rest_leans"), *left = find(result, "what_is_left");
      ASSERT_TRUE(rest && left) << latitude << ' ' << spin;
      double south = 0;
      for (const DriftRow& row : result.rows) south -= row.axis_L[1] / static_cast<double>(result.rows.size());
      EXPECT_GT(south * spin, 0);
      EXPECT_NEAR(number(result, "rest_leans", "lean_south_rad"), south, 0.1 * std::abs(south));
      EXPECT_TRUE(says(*rest, south > 0 ? "to the South" : "to the North")) << rest->text;
      EXPECT_TRUE(says(*left, south > 0 ? "to the South" : "to the North")) << left->text;
      const double coriolis = 4e-5 * 300 * kEarthRateWgs84 * std::cos(latitude * kDegree);
      EXPECT_NEAR(number(result, "coriolis_torque", "coriolis_torque_N_m"), coriolis, testing::rounding(40) * coriolis);
      EXPECT_NEAR(number(result, "rest_leans", "gravity_torque_N_m"), coriolis, testing::rounding(40) * coriolis);
    }
}

Scenario pendulum(double latitude_deg) {
  Scenario s;
  s.site = {latitude_deg, 0, 0, 9.80665};
  s.body.mass_kg = 1;
  s.body.center_of_mass_m = {0, 0, -1};
  s.body.inertia_kg_m2 = {{{1.5, 0, 0}, {0, 1.5, 0}, {0, 0, 0.15}}};
  s.release.tilt_deg = 0.1;
  s.release.azimuth_deg = 40;
  s.duration_s = 60;
  s.output_step_s = 0.05;
  return s;
}

/// The azimuth (rad, clockwise from North) at which an axis is farthest out, near the end of the run.
double last_turning_point(const RunResult& result, std::array<double, 3> DriftRow::*axis) {
  double most = 0, azimuth = 0;
  for (const DriftRow& row : result.rows) {
    const double far = std::hypot((row.*axis)[0], (row.*axis)[1]);
    if (row.t_s > result.reached_s - 1.5 && far > most) most = far, azimuth = std::atan2((row.*axis)[0], (row.*axis)[1]);
  }
  return azimuth;
}

TEST(Why, APendulumsPlaneTurnsAsItsTurningPointsShow) {
  for (const double latitude : {-50.0, 35.0})
    for (const double tilt_deg : {0.1, 179.9}) {
      Scenario s = pendulum(latitude);
      if (tilt_deg > 90) s.body.center_of_mass_m[2] = 1;  // the same bob at the other end
      s.release.tilt_deg = tilt_deg;
      const RunResult result = run(s);
      const WhySentence *turns = find(result, "laboratory_turns"), *left = find(result, "what_is_left");
      ASSERT_TRUE(turns && left && find(result, "bob_has_spin")) << latitude << ' ' << tilt_deg;
      const double clockwise = std::remainder(
          last_turning_point(result, &DriftRow::axis_L) - last_turning_point(result, &DriftRow::ref_axis_L), std::numbers::pi);
      EXPECT_EQ(clockwise > 0, latitude > 0);
      EXPECT_NEAR(number(result, "what_is_left", "computed_rad_s") * s.duration_s, -clockwise, 0.05 * std::abs(clockwise));
      EXPECT_TRUE(says(*turns, clockwise > 0 ? "plane turns clockwise" : "plane turns counterclockwise")) << turns->text;
      EXPECT_TRUE(says(*turns, clockwise > 0 ? "rad/s counterclockwise from" : "rad/s clockwise from")) << turns->text;
      EXPECT_TRUE(says(*left, clockwise > 0 ? "plane turns clockwise" : "plane turns counterclockwise")) << left->text;
      EXPECT_DOUBLE_EQ(number(result, "bob_has_spin", "part"), 0.05);
      const double up = kEarthRateWgs84 * std::sin(latitude * kDegree);
      EXPECT_NEAR(number(result, "laboratory_turns", "laboratory_rate_rad_s"), up, 1e-12 * std::abs(up));
      EXPECT_NEAR(number(result, "what_is_left", "predicted_rad_s"), -0.95 * up, 1e-12 * std::abs(up));
    }
}

Scenario gyrocompass(double latitude_deg, double spin_rad_s) {
  Scenario s = toy_top(latitude_deg, spin_rad_s);
  s.body.center_of_mass_m = {0, 0, 0};
  s.release.tilt_deg = 90;
  s.release.azimuth_deg = spin_rad_s > 0 ? 4 : -176;
  s.effects.applied.gimbal = GimbalSpec{};
  s.duration_s = 130;
  s.output_step_s = 0.05;
  return s;
}

TEST(Why, AGyrocompassSwingsAboutNorthInItsPeriod) {
  for (const double latitude : {-50.0, 0.0, 35.0})
    for (const double spin : {-400.0, 400.0}) {
      const RunResult result = run(gyrocompass(latitude, spin));
      const WhySentence *swings = find(result, "swings_about_north"), *holds = find(result, "gimbal_holds");
      ASSERT_TRUE(swings && holds) << latitude << ' ' << spin;
      // Passages through the meridian, half a period apart, and the mean direction.
      std::vector<double> passed_s;
      double north = 0;
      for (std::size_t i = 1; i < result.rows.size(); ++i) {
        const double before = result.rows[i - 1].axis_L[0], now = result.rows[i].axis_L[0], step = 0.05;
        if ((before > 0) != (now > 0)) passed_s.push_back(result.rows[i - 1].t_s + step * before / (before - now));
        north += result.rows[i].axis_L[1];
      }
      ASSERT_GE(passed_s.size(), 3u);
      const double period = passed_s[2] - passed_s[0];
      // Straight lines between rows a step apart leave a share of it that is the square of the phase in between.
      const double left = std::pow(2 * std::numbers::pi * 0.05 / period, 2) * 0.05;
      EXPECT_NEAR(number(result, "swings_about_north", "period_s"), period, left);
      EXPECT_NEAR(number(result, "swings_about_north", "amplitude_rad"), 4 * kDegree, testing::rounding(20));
      EXPECT_NEAR(number(result, "what_is_left", "swings"), 130 / period, left / period * 130 / period);
      EXPECT_TRUE(says(*swings, north > 0 ? "the axis to the North:" : "the axis to the South, and its spin to the North:"));
      const auto& q_LB = result.rows[0].q_LB;
      const auto entry =
          ledger_entry(LedgerObserver::laboratory, result.modelled.model<double>(), 0.0,
                       Quaternion<double>{q_LB[0], Vec3<double>(q_LB[1], q_LB[2], q_LB[3])}, Vec3<double>(0, 0, spin));
      EXPECT_NEAR(number(result, "gimbal_holds", "coriolis_torque_N_m"), std::abs(entry.tau_cor_A[2]),
                  testing::rounding(200) * std::abs(entry.tau_cor_A[2]));
    }
}

/// A ball or a top that rolls on a level table, spinning upright.
Scenario on_table(double latitude_deg, double spin_rad_s, bool ball) {
  Scenario s;
  s.site = {latitude_deg, 0, 0, 9.80665};
  s.body.mass_kg = 0.2;
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.body.center_of_mass_m = {0, 0, ball ? 0 : 0.025};
  s.body.inertia_kg_m2 = {{{5e-5, 0, 0}, {0, 5e-5, 0}, {0, 0, 5e-5}}};
  if (!ball) s.body.inertia_kg_m2[2][2] = 6e-5;
  s.contact.emplace().tip_radius_m = ball ? 0.03 : 0.003;
  s.contact->law = ContactLaw::rolling;
  s.release.spin_rad_s = spin_rad_s;
  s.duration_s = ball ? 12 : 40;
  s.output_step_s = 0.1;
  return s;
}

TEST(Why, ABallThatSpinsRollsAsItsPathShows) {
  for (const double latitude : {-40.0, 60.0})
    for (const double spin : {-150.0, 150.0}) {
      const RunResult result = run(on_table(latitude, spin, true));
      const WhySentence *rolls = find(result, "ball_rolls"), *left = find(result, "what_is_left");
      ASSERT_TRUE(rolls && left) << latitude << ' ' << spin << ' ' << result.verdict.reason;
      const auto& rows = result.rows;
      const double north = rows.back().contact->drift_tip_xy_m[1], t = rows.back().t_s;
      EXPECT_GT(north * spin, 0) << "to the North in both hemispheres if the spin is counterclockwise";
      EXPECT_TRUE(says(*rolls, north > 0 ? "to the North" : "to the South")) << rolls->text;
      const double acceleration = number(result, "ball_rolls", "acceleration_north_m_s2");
      EXPECT_NEAR(acceleration, 2 * north / (t * t), 1e-3 * std::abs(acceleration));
      EXPECT_NEAR(number(result, "ball_rolls", "share"), 5e-5 / (5e-5 + 0.2 * 0.03 * 0.03), 1e-12);
      EXPECT_EQ(number(result, "what_is_left", "computed_north_m"), north);
      EXPECT_NEAR(number(result, "what_is_left", "predicted_north_m"), north,
                  number(result, "what_is_left", "predicted_error_m"));
      EXPECT_LT(number(result, "what_is_left", "predicted_error_m"), 0.003 * std::abs(north));
      const double torque = 5e-5 * 150 * kEarthRateWgs84 * std::cos(latitude * kDegree);
      EXPECT_NEAR(number(result, "coriolis_torque", "coriolis_torque_N_m"), torque, testing::rounding(40) * torque);
      EXPECT_TRUE(find(result, "earth_turns"));
    }
}

TEST(Why, ASleepingTopThatRollsWalksAsItsPathShows) {
  for (const double latitude : {-40.0, 60.0})
    for (const double spin : {-260.0, 260.0}) {
      const RunResult result = run(on_table(latitude, spin, false));
      const WhySentence *leans = find(result, "rest_leans"), *walks = find(result, "walks_west");
      ASSERT_TRUE(leans && walks) << latitude << ' ' << spin << ' ' << result.verdict.reason;
      double south = 0, t = 0, x = 0, tt = 0, tx = 0;
      const double n = static_cast<double>(result.looks.size());
      for (const DriftRow& row : result.looks) {
        const double west = -row.contact->tip_m[0] + row.contact->ref_tip_m[0];
        south -= row.axis_L[1] / n, t += row.t_s, x += west, tt += row.t_s * row.t_s, tx += row.t_s * west;
      }
      const double speed = (n * tx - t * x) / (n * tt - t * t);
      EXPECT_GT(speed, 0) << "to the West in both hemispheres, whichever the sense of spin";
      EXPECT_TRUE(says(*walks, "to the West")) << walks->text;
      EXPECT_NEAR(number(result, "walks_west", "computed_west_m_s"), speed, testing::rounding(5000) * speed);
      EXPECT_NEAR(number(result, "walks_west", "predicted_west_m_s"), speed, 0.02 * speed);
      EXPECT_GT(south * spin, 0);
      EXPECT_TRUE(says(*leans, south > 0 ? "to the South" : "to the North")) << leans->text;
      const double lean = 6e-5 * spin * kEarthRateWgs84 * std::cos(latitude * kDegree) / (0.2 * 9.80665 * 0.025);
      EXPECT_NEAR(number(result, "rest_leans", "lean_south_rad"), lean, testing::rounding(40) * std::abs(lean));
      EXPECT_NEAR(number(result, "rest_leans", "mean_lean_south_rad"), south, testing::rounding(20) * std::abs(south));
      const double walked = -result.rows.back().contact->drift_tip_xy_m[0], off = number(result, "what_is_left", "off_m");
      EXPECT_NEAR(number(result, "what_is_left", "walked_west_m"), walked, 2 * off);
      EXPECT_LT(off, 0.02 * walked);
    }
}

TEST(Why, OfOtherTopsOnATableNoRollingIsTold) {
  for (const bool ball : {true, false}) {
    const auto sentences = [&](const auto& change) {
      const RunResult result = run(testing::changed(on_table(40, 260, ball), change));
      return static_cast<int>(find(result, "ball_rolls") != nullptr) + static_cast<int>(find(result, "walks_west") != nullptr);
    };
    EXPECT_GT(sentences([](Scenario&) {}), 0);
    EXPECT_EQ(sentences([](Scenario& s) { s.contact->rolling_resistance_m = 1e-9, s.contact->regularisation_rad_s = 0.1; }), 0);
    EXPECT_EQ(sentences([](Scenario& s) { s.contact->spinning_friction_m = 1e-9, s.contact->regularisation_rad_s = 0.1; }), 0);
    EXPECT_EQ(sentences([](Scenario& s) { s.contact->table_tilt_deg = 1e-4; }), 0);
    EXPECT_EQ(sentences([](Scenario& s) { s.contact->law = ContactLaw::frictionless; }), 0);
    EXPECT_EQ(sentences([](Scenario& s) {
                s.contact->start = ContactStart::tip_velocity, s.contact->tip_velocity_m_s = {1e-3, 0};
              }),
              0);
    EXPECT_EQ(sentences([](Scenario& s) { s.effects.coriolis = false; }), 0);
    EXPECT_EQ(sentences([](Scenario& s) { s.site.latitude_deg = 90; }), 0) << "no part of the Earth's rate is level";
    EXPECT_EQ(sentences([](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::inertial; }), 0);
  }
  Scenario tilted = on_table(40, 260, false);
  tilted.release.tilt_deg = 1;
  EXPECT_FALSE(find(run(tilted), "walks_west"));
}

TEST(Why, OfOtherPendulumsAndCompassesNothingIsSaid) {
  const auto of_pendulum = [](const auto& change) { return run(testing::changed(pendulum(35), change)).why.size(); };
  EXPECT_EQ(of_pendulum([](Scenario&) {}), 4u);
  EXPECT_EQ(of_pendulum([](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::inertial; }), 0u);
  EXPECT_EQ(of_pendulum([](Scenario& s) { s.release.tilt_deg = 40; }), 0u) << "an ellipse as wide turns by itself";
  EXPECT_EQ(of_pendulum([](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-3; }), 0u);
  EXPECT_EQ(of_pendulum([](Scenario& s) { s.site.latitude_deg = 0; }), 0u);
  EXPECT_EQ(of_pendulum([](Scenario& s) { s.duration_s = 5; }), 0u) << "too few swings";
  const auto of_compass = [](const auto& change) { return run(testing::changed(gyrocompass(35, 400), change)).why.size(); };
  EXPECT_EQ(of_compass([](Scenario&) {}), 4u);
  EXPECT_EQ(of_compass([](Scenario& s) { s.effects.applied.gimbal->damping_N_m_s = 1e-6; }), 0u);
  EXPECT_EQ(of_compass([](Scenario& s) { s.release.azimuth_deg = 100; }), 0u) << "no small swing";
  EXPECT_EQ(of_compass([](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-7; }), 0u);
  EXPECT_EQ(of_compass([](Scenario& s) { s.site.latitude_deg = 90; }), 0u);
}

TEST(Why, NothingIsSaidWhereTheoryDoesNotApply) {
  const auto sentences = [](const auto& change) { return run(testing::changed(toy_top(45, 200), change)).why.size(); };
  EXPECT_GT(sentences([](Scenario&) {}), 0u);
  EXPECT_EQ(sentences([](Scenario& s) { s.platform.emplace().axis = {0, 0, 1}; }), 0u);
  EXPECT_EQ(sentences([](Scenario& s) { s.effects.coriolis = false; }), 0u);
  EXPECT_EQ(sentences([](Scenario& s) { s.rotation_rate_rad_s = 0; }), 0u);
  EXPECT_EQ(sentences([](Scenario& s) { s.rotation_rate_rad_s = 1; }), 0u);
  EXPECT_EQ(sentences([](Scenario& s) { s.duration_s = 1; }), 0u) << "no turn of precession";
}

TEST(Why, NothingIsSaidWhereTheRunSaysOtherwise) {
  const RunResult good = run(toy_top(45, 200));
  EXPECT_EQ(why_sentences(good).size(), 5u);
  RunResult result = good;
  *result.theory[0].computed += result.theory[0].predicted_error + 2 * *result.theory[0].computed_error;
  EXPECT_TRUE(why_sentences(result).empty()) << "another trend";
  result = good;
  result.theory[0].applies = false;
  EXPECT_TRUE(why_sentences(result).empty());
  result = good;
  result.verdict.verdict = Verdict::unstable;
  EXPECT_TRUE(why_sentences(result).empty());
  result = good;
  result.verdict.from_s = 10;
  EXPECT_TRUE(why_sentences(result).empty());
  result = good;
  result.status = RunStatus::step_limit;
  EXPECT_TRUE(why_sentences(result).empty());
  result = good;
  for (DriftRow& row : result.looks) row.drift_tilt_rad = -row.drift_tilt_rad;
  result.why = why_sentences(result);
  EXPECT_TRUE(find(result, "what_is_left"));
  EXPECT_FALSE(find(result, "cone_leans")) << "the tilts lean the other way";
}

}  // namespace
}  // namespace earthtop
