// SPDX-License-Identifier: GPL-3.0-or-later
// The laws behind the sentences on tops with friction, on a table, with unequal moments and without a torque: each against an integration
// of its own, or against the run, in random scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "earthtop/run.hpp"
#include "run/slow_precession.hpp"
#include "run/turn_over.hpp"
#include "support/changed_scene.hpp"
#include "support/tolerances.hpp"
#include "support/why_sentences.hpp"

namespace earthtop {
namespace {

using testing::find;
using testing::number;
using testing::rounding;
using testing::says;

constexpr double kRadians = std::numbers::pi / 180;  // in a degree

class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : random_(seed) {}
  double between(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  double sign() { return between(-1, 1) < 0 ? -1 : 1; }

 private:
  std::mt19937 random_;
};

/// One step of the classical Runge-Kutta method for any state of numbers.
template <std::size_t N, class Rate>
std::array<double, N> runge_kutta_step(const std::array<double, N>& from, double h, const Rate& rate) {
  const auto plus = [](std::array<double, N> a, double s, const std::array<double, N>& b) {
    for (std::size_t i = 0; i < N; ++i) a[i] += s * b[i];
    return a;
  };
  const auto k1 = rate(from), k2 = rate(plus(from, h / 2, k1)), k3 = rate(plus(from, h / 2, k2)), k4 = rate(plus(from, h, k3));
  return plus(plus(plus(plus(from, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
}

// -- friction

/// The mean azimuth (rad) over the last nutations of a top with viscous friction, from the whole equations of axis and momentum.
double mean_azimuth(const SlowTop& top, const Vec3<double>& W, double duration_s, double nutation_s) {
  constexpr double kStep = 1e-3;
  const double sine = std::sqrt(1 - top.cos_tilt * top.cos_tilt);
  const Vec3<double> n0(sine * std::cos(top.azimuth_rad), sine * std::sin(top.azimuth_rad), top.cos_tilt);
  const Vec3<double> w0 = top.w_L + (top.in_laboratory ? W : Vec3<double>(Vec3<double>::Zero()));
  const Vec3<double> L0 = top.I1 * w0 + (top.I3 - top.I1) * w0.dot(n0) * n0;
  std::array<double, 6> state = {n0[0], n0[1], n0[2], L0[0], L0[1], L0[2]};
  const auto rate = [&](const std::array<double, 6>& s) {
    const Vec3<double> n(s[0], s[1], s[2]), L(s[3], s[4], s[5]);
    const Vec3<double> w = L / top.I1 + (1 / top.I3 - 1 / top.I1) * L.dot(n) * n, seen = w - W;
    const Vec3<double> dn = seen.cross(n),
                       dL = top.mgl * Vec3<double>(0, 0, 1).cross(n) - W.cross(L) - top.applied.viscous * seen;
    return std::array<double, 6>{dn[0], dn[1], dn[2], dL[0], dL[1], dL[2]};
  };
  double azimuth = top.azimuth_rad, sum = 0, weights = 0;
  const int steps = static_cast<int>(std::lround((duration_s + 2 * nutation_s) / kStep));
  for (int i = 1; i <= steps; ++i) {
    state = runge_kutta_step(state, kStep, rate);
    azimuth += std::remainder(std::atan2(state[1], state[0]) - azimuth, 2 * std::numbers::pi);
    const double from_end = (i * kStep - duration_s) / (2 * nutation_s);
    if (std::abs(from_end) > 1) continue;
    const double weight = std::pow(std::cos(from_end * std::numbers::pi / 2), 2);
    sum += weight * azimuth, weights += weight;
  }
  return sum / weights;
}

TEST(WhyFriction, TheSlowPrecessionIsThatOfTheWholeEquations) {
  RandomNumbers draw(71);
  int fast = 0;
  for (int i = 0; i < 12; ++i) {
    SlowTop top{1.2e-4, draw.between(4e-5, 1.5e-4), draw.sign() * 0.0294, 1.2e-4, {}, Vec3<double>::Zero()};
    const double spin = draw.sign() * draw.between(200, 400), latitude = draw.between(-80, 80) * kRadians;
    constexpr double kDuration = 8, kRate = 1e-3;  // rad/s: larger than the Earth's, for the difference of two integrations
    top.W_L = kRate * Vec3<double>(0, std::cos(latitude), std::sin(latitude));
    top.cos_tilt = std::cos(draw.between(20, 150) * kRadians), top.azimuth_rad = draw.between(0, 6.28);
    top.in_laboratory = i % 2 == 0;
    top.applied.any = true, top.applied.viscous = draw.between(0.1, 0.7) * top.I3 / kDuration;
    const double sine = std::sqrt(1 - top.cos_tilt * top.cos_tilt);
    top.w_L = spin * Vec3<double>(sine * std::cos(top.azimuth_rad), sine * std::sin(top.azimuth_rad), top.cos_tilt);
    const std::optional<SlowPrecession> slow = slow_precession(top, kDuration);
    if (!slow) continue;
    ++fast;
    // The nutation and its decay, of second order in the smallness.
    EXPECT_NEAR(slow->last_spin_rad_s, spin * std::exp(-top.applied.viscous / top.I3 * kDuration), 0.01 * std::abs(spin));
    const double without = mean_azimuth(top, Vec3<double>::Zero(), kDuration, slow->period_s);
    // Second order in the smallness, 0.15 at most.
    EXPECT_NEAR(slow->turned_rad, without - top.azimuth_rad, 0.02 * std::abs(slow->turned_rad)) << i;
    const double drift = mean_azimuth(top, top.W_L, kDuration, slow->period_s) - without;
    EXPECT_NEAR(slow->drift_rad, drift, slow->left_out_rad) << i;
    // A wrong sign or factor of a part of the law is more than this part of the Earth's turn.
    EXPECT_NEAR(slow->drift_rad, drift, 0.03 * kRate * kDuration / sine) << i;
    EXPECT_GT(std::abs(slow->last_rad_s), std::abs(slow->first_rad_s)) << "the precession quickens";
  }
  EXPECT_GE(fast, 8);
}

Scenario rubbed_top(RandomNumbers& draw) {
  Scenario s;
  s.site = {draw.between(-80, 80), 0, 0, 9.80665};
  s.body.mass_kg = 0.1;
  s.body.center_of_mass_m = {0, 0, draw.sign() * 0.03};
  s.body.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, draw.between(3e-5, 5.9e-5)}}};
  s.release.tilt_deg = draw.between(15, 165);
  s.release.azimuth_deg = draw.between(0, 360);
  s.release.spin_rad_s = draw.sign() * draw.between(250, 600);
  s.release.rates_relative_to = draw.between(0, 1) < 0.5 ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  s.duration_s = draw.between(10, 30);
  s.output_step_s = 0.05;
  return s;
}

TEST(WhyFriction, TheDriftOfARunIsThatOfTheLaw) {
  RandomNumbers draw(72);
  int told = 0;
  for (int i = 0; i < 12; ++i) {
    Scenario s = rubbed_top(draw);
    const double I3 = s.body.inertia_kg_m2[2][2], lost = draw.between(0.05, 0.5), spin = s.release.spin_rad_s;
    AppliedTorquesSpec& applied = s.effects.applied;
    if (i % 3 == 0) applied.viscous_N_m_s = lost * I3 / s.duration_s;
    if (i % 3 == 1) applied.coulomb_N_m = lost * I3 * std::abs(spin) / s.duration_s;
    if (i % 3 == 2) applied.quadratic_N_m_s2 = lost * I3 / s.duration_s / std::abs(spin);
    const RunResult result = run(s);
    if (!find(result, "friction_slows")) continue;
    ++told;
    const double T = result.reached_s;
    const double last = i % 3 == 0 ? spin * std::exp(-lost) : i % 3 == 1 ? spin * (1 - lost) : spin / (1 + lost);
    // The precession changes |w| by a part of this size.
    EXPECT_NEAR(number(result, "friction_slows", "predicted_spin_last_rad_s"), last, 0.005 * std::abs(spin));
    EXPECT_EQ(number(result, "friction_slows", "computed_spin_last_rad_s"), result.motion->spin_end_rad_s.reference.value);
    const double up = s.rotation_rate_rad_s * std::sin(s.site.latitude_deg * kRadians);
    // The end of the run is averaged over three nutations.
    EXPECT_NEAR(number(result, "laboratory_turns", "turned_rad"), -up * T, 0.05 * std::abs(up * T));
    EXPECT_TRUE(
        says(result, "laboratory_turns", up > 0 ? "is therefore turned clockwise" : "is therefore turned counterclockwise"));
    const double predicted = number(result, "what_is_left", "predicted_rad");
    EXPECT_NEAR(predicted, number(result, "what_is_left", "computed_rad"),
                number(result, "what_is_left", "predicted_error_rad"));
    // The drift of the rows: their last one has the nutation besides.
    EXPECT_NEAR(predicted, -*result.rows.back().drift_azimuth_rad,
                0.1 * std::abs(predicted) + 0.05 * s.rotation_rate_rad_s * T);
  }
  EXPECT_GE(told, 7);
}

TEST(WhyFriction, ABalancedGyroscopeKeepsItsDirectionWhileItSlows) {
  for (const double latitude : {-40.0, 0.0, 60.0})
    for (const double spin : {-300.0, 300.0}) {
      Scenario s;
      s.site = {latitude, 0, 0, 9.80665};
      s.body.mass_kg = 0.1;
      s.body.center_of_mass_m = {0, 0, 0};
      s.body.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, 2e-4}}};
      s.release.tilt_deg = 30, s.release.azimuth_deg = 200, s.release.spin_rad_s = spin;
      s.duration_s = 20, s.output_step_s = 0.5;
      s.effects.applied.viscous_N_m_s = 1e-5;
      const RunResult result = run(s);
      ASSERT_TRUE(find(result, "no_torque_across")) << latitude << ' ' << spin;
      // 256 steps of Runge and Kutta over one decay.
      EXPECT_NEAR(number(result, "friction_slows", "predicted_spin_last_rad_s"), spin * std::exp(-1.0), 1e-6 * std::abs(spin));
      const double east = std::sin(30 * kRadians) * std::sin(200 * kRadians),
                   north = std::sin(30 * kRadians) * std::cos(200 * kRadians);
      const double along = north * std::cos(latitude * kRadians) + std::cos(30 * kRadians) * std::sin(latitude * kRadians);
      EXPECT_GT(std::abs(east), 0);
      const double moved = std::sqrt(1 - along * along) * s.rotation_rate_rad_s * 20;
      // The sine of half the small angle against the angle.
      EXPECT_NEAR(number(result, "what_is_left", "predicted_rad"), moved, 1e-6 * moved);
      // The small circle of the release, I1 Omega/(I3 w3).
      EXPECT_NEAR(number(result, "what_is_left", "computed_rad"), moved, 0.01 * moved);
      EXPECT_EQ(number(result, "what_is_left", "computed_rad"), result.drift.axis_final_rad);
    }
}

/// A constant and an alternating torque along the axis, on a top that precesses.
TEST(WhyGivenTorque, TheSpinAndTheDriftOfARunAreThoseOfTheLaw) {
  RandomNumbers draw(74);
  int told = 0;
  for (int i = 0; i < 8; ++i) {
    Scenario s = rubbed_top(draw);
    const double I3 = s.body.inertia_kg_m2[2][2], spin = s.release.spin_rad_s, T = s.duration_s;
    const double torque = draw.between(-0.3, 0.5) * I3 * spin / T, frequency = 1.3;
    GivenTorqueSpec given;
    given.torque_N_m = {0, 0, torque};
    if (i % 2 == 1) given.course = TorqueCourse::harmonic, given.frequency_hz = frequency, given.phase_deg = 20;
    s.effects.applied.given_torque = given;
    const RunResult result = run(s);
    if (!find(result, "given_torque")) continue;
    ++told;
    const double cycle = 2 * std::numbers::pi * frequency, phase = 20 * kRadians;
    constexpr double kNutation = 0.01;  // what it makes of the spin's change
    const double taken = i % 2 == 0 ? torque * T : torque * (std::cos(phase) - std::cos(cycle * T + phase)) / cycle;
    EXPECT_NEAR(number(result, "given_torque", "predicted_spin_last_rad_s"), spin + taken / I3,
                kNutation * std::abs(taken / I3) + rounding(1000 * std::abs(spin)));
    EXPECT_EQ(number(result, "given_torque", "computed_spin_last_rad_s"), result.motion->spin_end_rad_s.reference.value);
    const double predicted = number(result, "what_is_left", "predicted_rad");
    EXPECT_NEAR(predicted, number(result, "what_is_left", "computed_rad"),
                number(result, "what_is_left", "predicted_error_rad"));
    const bool quickens = says(result, "given_torque", "quickens to"), slows = says(result, "given_torque", "slows to");
    EXPECT_EQ(quickens, i % 2 == 0 && torque * spin < 0) << i;
    EXPECT_EQ(slows, i % 2 == 0 && torque * spin > 0) << i;
  }
  EXPECT_GE(told, 5);
}

TEST(WhyGivenTorque, ABalancedGyroscopeKeepsItsDirection) {
  Scenario s;
  s.site = {30, 0, 0, 9.80665};
  s.body.mass_kg = 0.1;
  s.body.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, 2e-4}}};
  s.release.tilt_deg = 30, s.release.azimuth_deg = 200, s.release.spin_rad_s = 300;
  s.duration_s = 20, s.output_step_s = 0.5;
  s.effects.applied.given_torque.emplace().torque_N_m = {0, 0, 1e-3};
  const RunResult result = run(s);
  EXPECT_TRUE(says(result, "no_torque_across", "while the spin rises"));
  EXPECT_NEAR(number(result, "given_torque", "predicted_spin_last_rad_s"), 400, rounding(256 * 400));  // in as many steps
  // A torque across the axis is told by no law.
  s.effects.applied.given_torque->torque_N_m = {0, 1e-6, 1e-3};
  EXPECT_FALSE(find(run(s), "given_torque"));
}

// -- without a torque

struct Crossings {
  double first_s, second_s;
};
/// When the rate about body axis `axis` changes its sign, by Euler's equations.
Crossings crossings(const Vec3<double>& moments, const Vec3<double>& w0, int axis, double duration_s) {
  constexpr double kStep = 2e-4;
  std::array<double, 3> w = {w0[0], w0[1], w0[2]};
  const auto rate = [&](const std::array<double, 3>& v) {
    return std::array<double, 3>{(moments[1] - moments[2]) / moments[0] * v[1] * v[2],
                                 (moments[2] - moments[0]) / moments[1] * v[2] * v[0],
                                 (moments[0] - moments[1]) / moments[2] * v[0] * v[1]};
  };
  const auto at = static_cast<std::size_t>(axis);
  Crossings found{NAN, NAN};
  for (double t = 0; t < duration_s && std::isnan(found.second_s); t += kStep) {
    const double before = w[at];
    w = runge_kutta_step(w, kStep, rate);
    if (before * w[at] > 0) continue;
    (std::isnan(found.first_s) ? found.first_s : found.second_s) = t + kStep * before / (before - w[at]);
  }
  return found;
}

TEST(WhyFree, ASpinAboutTheMiddleAxisTurnsOverAsEulersEquationsSay) {
  RandomNumbers draw(73);
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int i = 0; i < 24; ++i) {
    const auto& order = orders[i % 6];
    Vec3<double> moments, w;
    moments[order[0]] = draw.between(3e-6, 5e-6), moments[order[1]] = draw.between(6e-6, 7e-6);
    moments[order[2]] = draw.between(7.5e-6, 9e-6);
    const double spin = draw.sign() * draw.between(15, 40), size = std::pow(10.0, draw.between(-6, -2)) * std::abs(spin);
    w[order[0]] = size * draw.between(-1, 1), w[order[1]] = spin, w[order[2]] = size * draw.between(-1, 1);
    const std::optional<Moments> sorted = three_moments(Mat3<double>(moments.asDiagonal()));
    ASSERT_TRUE(sorted);
    EXPECT_EQ(sorted->b, order[1]);
    const std::optional<TurnOver> found = turn_over(*sorted, w);
    ASSERT_TRUE(found && found->first_s && found->again_s) << i;
    const double A = sorted->A, B = sorted->B, C = sorted->C;
    // Rounding of a root.
    EXPECT_NEAR(found->growth_1_s, std::abs(spin) * std::sqrt((B - A) * (C - B) / (A * C)), 1e-12 * found->growth_1_s);
    const Crossings seen = crossings(moments, w, order[1], *found->first_s + 1.2 * *found->again_s);
    constexpr double kSteps = 1e-6;  // s, of the integration
    EXPECT_NEAR(*found->first_s, seen.first_s, found->left_out_s + kSteps) << i;
    // Next to the axis for a long time, the steps' own errors disturb the body, too.
    constexpr double kOfSteps = 1e-5;
    if (found->smallness > 3e-4)
      EXPECT_NEAR(*found->again_s, seen.second_s - seen.first_s, 3 * found->left_out_s + kOfSteps) << i;
  }
}

TEST(WhyFree, NoTurnIsPredictedWhereNothingGrows) {
  const std::optional<Moments> moments = three_moments(Vec3<double>(4e-6, 7e-6, 1e-5).asDiagonal());
  ASSERT_TRUE(moments);
  EXPECT_FALSE(turn_over(*moments, {0, 20, 0})->first_s);
  EXPECT_FALSE(turn_over(*moments, {20, 0.1, 0})) << "about the axis of the smallest moment";
  EXPECT_FALSE(turn_over(*moments, {0, 20, 5})) << "far from the axis";
  EXPECT_FALSE(three_moments(Vec3<double>(4e-6, 7e-6, 7e-6).asDiagonal()));
  Mat3<double> products = Vec3<double>(4e-6, 7e-6, 1e-5).asDiagonal();
  products(0, 1) = products(1, 0) = 1e-7;
  EXPECT_FALSE(three_moments(products));
}

Scenario wing_nut(double spin_rad_s, double rate_rad_s) {
  Scenario s;
  s.site = {45, 0, 0, 9.80665};
  s.rotation_rate_rad_s = rate_rad_s;
  s.body.mass_kg = 0.02;
  s.body.center_of_mass_m = {0, 0, 0};
  s.body.inertia_kg_m2 = {{{4e-6, 0, 0}, {0, 1e-5, 0}, {0, 0, 7e-6}}};
  s.release.tilt_deg = 60, s.release.azimuth_deg = 30, s.release.spin_rad_s = spin_rad_s;
  s.duration_s = 48 / std::abs(spin_rad_s), s.output_step_s = s.duration_s / 200;
  return s;
}

TEST(WhyFree, AWingNutTurnsOverLaterBesideASlowerEarth) {
  const double growth = std::sqrt(3e-6 * 3e-6 / (4e-6 * 1e-5));  // in the spin
  for (const double spin : {-20.0, 20.0, 30.0}) {
    std::vector<double> times;
    for (const double faster : {1.0, 10.0}) {
      const RunResult result = run(wing_nut(spin, faster * kEarthRateWgs84));
      ASSERT_TRUE(find(result, "turns_over")) << spin << ' ' << result.verdict.reason;
      // The root's moments as printed here.
      EXPECT_NEAR(number(result, "middle_axis", "growth_1_s"), growth * std::abs(spin), 1e-4 * std::abs(spin));
      const double computed = number(result, "turns_over", "computed_s");
      EXPECT_NEAR(number(result, "turns_over", "predicted_s"), computed, number(result, "turns_over", "predicted_error_s"));
      EXPECT_LT(number(result, "turns_over", "predicted_error_s"), 1e-3 * computed);
      times.push_back(computed);
      // In the rows the spin changes its sense there.
      const auto turned =
          std::find_if(result.rows.begin(), result.rows.end(), [&](const DriftRow& row) { return row.w_LB_B[2] * spin < 0; });
      ASSERT_NE(turned, result.rows.end());
      EXPECT_NEAR(turned->t_s, computed, result.scene.scenario().output_step_s);
      // s; the growth as the moments give it.
      EXPECT_NEAR(number(result, "turns_over", "tenfold_earlier_s"), std::log(10.0) / (growth * std::abs(spin)), 1e-4);
      EXPECT_TRUE(says(result, "turns_over", "does not turn over in this run"));
    }
    // A/w of the faster Earth squared, and the steps of the looks.
    EXPECT_NEAR(times[0] - times[1], std::log(10.0) / (growth * std::abs(spin)), 1e-3 * times[0]) << spin;
  }
}

TEST(WhyFree, AWingNutReleasedOffItsAxisTurnsOverALittleEarlierOrLater) {
  RandomNumbers draw(74);
  int told = 0, later = 0;
  for (int i = 0; i < 8; ++i) {
    Scenario s = wing_nut(20, kEarthRateWgs84);
    s.release.spin_rad_s = 0;
    s.release.angular_velocity_body_rad_s = std::array{draw.between(-0.02, 0.02), draw.between(-0.02, 0.02), 20.0};
    const RunResult result = run(s);
    if (!find(result, "turns_over")) continue;
    ++told;
    const double predicted = number(result, "turns_over", "predicted_later_s");
    // Size of what the law leaves out at these releases.
    EXPECT_NEAR(predicted, number(result, "turns_over", "computed_later_s"), 0.02 * std::abs(predicted)) << i;
    EXPECT_TRUE(says(result, "turns_over", predicted > 0 ? "turn over later by" : "turn over earlier by"));
    later += predicted > 0;
    const auto& rows = result.rows;
    const auto first = std::find_if(rows.begin(), rows.end(), [](const DriftRow& r) { return r.ref_w_LB_B[2] < 0; });
    ASSERT_NE(first, rows.end());
    EXPECT_EQ(first->drift_axis_rad > 0, true);
  }
  EXPECT_GE(told, 5);
  EXPECT_GT(later, 0);
  EXPECT_LT(later, told);
}

Scenario free_body(RandomNumbers& draw) {
  Scenario s = wing_nut(20, kEarthRateWgs84);
  s.site.latitude_deg = draw.between(-80, 80);
  s.body.inertia_kg_m2 = {
      {{draw.between(4e-6, 6e-6), 0, 0}, {0, draw.between(6e-6, 8e-6), 0}, {0, 0, draw.between(8e-6, 9.9e-6)}}};
  s.release.tilt_deg = draw.between(5, 170), s.release.azimuth_deg = draw.between(0, 360), s.release.spin_rad_s = 0;
  s.release.angular_velocity_body_rad_s = std::array{draw.between(-20, 20), draw.between(-3, 3), draw.between(-20, 20)};
  s.duration_s = 6, s.output_step_s = 0.1;
  return s;
}

TEST(WhyFree, WithTheSameRatesInSpaceTheAttitudeTurnsWithTheStars) {
  RandomNumbers draw(75);
  for (int i = 0; i < 6; ++i) {
    Scenario s = free_body(draw);
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    const RunResult result = run(s);
    ASSERT_TRUE(find(result, "turns_with_the_stars") && find(result, "axis_turns")) << i;
    // Rounding of the product.
    EXPECT_NEAR(number(result, "turns_with_the_stars", "predicted_rad"), kEarthRateWgs84 * 6, 1e-15);
    const DriftRow& last = result.rows.back();
    // Rounding, and that of the rows.
    EXPECT_NEAR(number(result, "axis_turns", "predicted_rad"), last.drift_axis_rad, 1e-12 * last.drift_axis_rad + 1e-16);
    const double phi = s.site.latitude_deg * kRadians;
    const double along = std::abs(last.ref_axis_L[1] * std::cos(phi) + last.ref_axis_L[2] * std::sin(phi));
    // Rounding of the arc.
    EXPECT_NEAR(std::cos(number(result, "axis_turns", "angle_from_celestial_axis_rad")), along, 1e-9);
  }
}

TEST(WhyFree, AtAPoleGravityLeavesTheStarsTurn) {
  RandomNumbers draw(76);
  for (const double latitude : {-90.0, 90.0}) {
    Scenario s = free_body(draw);
    s.site.latitude_deg = latitude;
    s.body.center_of_mass_m = {0.001, 0, 0.002};
    s.body.inertia_kg_m2 = {{{6e-6, 0, 0}, {0, 7e-6, 0}, {0, 0, 8e-6}}};
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    const RunResult result = run(s);
    EXPECT_TRUE(says(result, "turns_with_the_stars", "Gravity acts along the axis")) << latitude << result.verdict.reason;
    s.site.latitude_deg = 0.9 * latitude;
    EXPECT_FALSE(find(run(s), "turns_with_the_stars"));
  }
}

TEST(WhyFree, ReleasedWithTheLaboratorysRatesABodyHasTheEarthsBesides) {
  RandomNumbers draw(77);
  int told = 0;
  for (int i = 0; i < 8; ++i) {
    const Scenario s = free_body(draw);
    const RunResult result = run(s);
    if (!find(result, "released_with_laboratory")) continue;
    ++told;
    // Rounding of 120 rad in two closed forms.
    EXPECT_NEAR(number(result, "what_is_left", "predicted_rad"), result.rows.back().drift_attitude_rad,
                1e-9 * result.rows.back().drift_attitude_rad + 1e-13);
    // The energy in space, from the release: w + W in body axes against w.
    const DriftRow& first = result.rows.front();
    const double phi = s.site.latitude_deg * kRadians, *q = first.q_LB.data();
    const Vec3<double> W(0, kEarthRateWgs84 * std::cos(phi), kEarthRateWgs84 * std::sin(phi)), v(-q[1], -q[2], -q[3]);
    const Vec3<double> W_B = W + 2 * v.cross(Vec3<double>(v.cross(W) + q[0] * W));
    double before = 0, after = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = (*s.release.angular_velocity_body_rad_s)[k], I = s.body.inertia_kg_m2[k][k],
                   W_k = W_B[static_cast<int>(k)];
      before += I * w * w, after += I * (2 * w * W_k + W_k * W_k);
    }
    // Rounding, of a sum that may cancel.
    EXPECT_NEAR(number(result, "released_with_laboratory", "energy_change"), after / before,
                1e-9 * std::abs(after / before) + 1e-15);
    EXPECT_TRUE(says(result, "released_with_laboratory", after > 0 ? "its energy more by" : "its energy less by"));
  }
  EXPECT_GE(told, 6);
}

// -- unequal moments

TEST(WhyUnequal, ThePrecessionIsThatOfTheMeanInverseMoment) {
  RandomNumbers draw(78);
  int told = 0;
  for (int i = 0; i < 12; ++i) {
    const double unequal = draw.between(0.01, 0.1);
    Scenario s = rubbed_top(draw);
    s.body.inertia_kg_m2[0][0] = 1.25e-4 * (1 + unequal), s.body.inertia_kg_m2[1][1] = 1.25e-4 * (1 - unequal);
    s.body.inertia_kg_m2[2][2] = draw.between(3e-5, 4.5e-5);
    const RunResult result = run(s);
    if (!find(result, "unequal_moments")) continue;
    ++told;
    // kg m^2: rounding.
    EXPECT_NEAR(number(result, "unequal_moments", "moment_kg_m2"), 1.25e-4 * (1 - unequal * unequal), 1e-15);
    const double rate = *result.drift.secular->azimuth_rate_rad_s, Omega = s.rotation_rate_rad_s;
    // The same number with another sign.
    EXPECT_NEAR(std::abs(number(result, "what_is_left", "computed_faster_by_rad_s")), std::abs(rate), 1e-18);
    // Second order in the inequality, at most a tenth, times what precedes.
    EXPECT_NEAR(number(result, "what_is_left", "predicted_faster_by_rad_s"),
                number(result, "what_is_left", "computed_faster_by_rad_s"), 0.05 * Omega)
        << i;
    double turned = 0, before = 0;  // of the non-rotating prediction
    for (const DriftRow& row : result.rows) {
      const double azimuth = std::atan2(row.ref_axis_L[1], row.ref_axis_L[0]);
      if (row.t_s > 0) turned += std::remainder(azimuth - before, 2 * std::numbers::pi);
      before = azimuth;
    }
    // Second order in the inequality, and the rest of a nutation.
    EXPECT_NEAR(number(result, "unequal_moments", "predicted_precession_rad_s"), std::abs(turned) / s.duration_s,
                0.02 * std::abs(turned) / s.duration_s);
  }
  EXPECT_GE(told, 8);
}

// -- on a table

Scenario top_on_table(RandomNumbers& draw, ContactLaw law) {
  Scenario s;
  s.site = {draw.between(20, 80) * draw.sign(), 0, 0, 9.80665};
  s.body.mass_kg = 0.1;
  s.body.center_of_mass_m = {0, 0, 0.03};
  s.body.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, 4e-5}}};
  s.contact.emplace();
  s.contact->law = law, s.contact->tip_radius_m = 0.002, s.contact->start = ContactStart::tip_at_rest;
  s.release.tilt_deg = draw.between(10, 40), s.release.azimuth_deg = draw.between(0, 360);
  s.release.spin_rad_s = draw.sign() * draw.between(200, 350);
  s.duration_s = 6, s.output_step_s = 0.1;
  return s;
}

TEST(WhyTable, WithoutFrictionTheTopPrecessesAboutItsCentreOfMass) {
  RandomNumbers draw(79);
  int told = 0;
  for (int i = 0; i < 6; ++i) {
    const Scenario s = top_on_table(draw, ContactLaw::frictionless);
    const RunResult result = run(s);
    if (!find(result, "no_friction_holds")) continue;
    ++told;
    const double predicted = number(result, "what_is_left", "predicted_rad");
    EXPECT_NEAR(predicted, number(result, "what_is_left", "computed_rad"),
                number(result, "what_is_left", "predicted_error_rad"));
    EXPECT_LT(number(result, "what_is_left", "predicted_error_rad"), 0.2 * std::abs(predicted));
    const double S = 4e-5 * s.release.spin_rad_s, mgl = 0.1 * 9.80665 * 0.03, u = std::cos(s.release.tilt_deg * kRadians);
    const double p = mgl / S * (1 + 3e-5 * mgl * u / (S * S));  // of the slow precession about C, with its first correction
    // The next correction, and the nutation at the end.
    EXPECT_NEAR(number(result, "no_friction_holds", "predicted_turned_rad"), p * 6, 0.02 * std::abs(p) * 6);
    // The same, of the run.
    EXPECT_NEAR(number(result, "no_friction_holds", "computed_turned_rad"), p * 6, 0.03 * std::abs(p) * 6);
  }
  EXPECT_GE(told, 4);
}

TEST(WhyTable, MoreFrictionMovesTheAxisAsFarAsIsSaid) {
  RandomNumbers draw(80);
  int told = 0;
  for (int i = 0; i < 5; ++i) {
    Scenario s = top_on_table(draw, ContactLaw::contensou);
    s.contact->friction_coefficient = 0.2, s.contact->patch_radius_m = 3e-5;
    const RunResult result = run(s);
    const double percent = number(result, "friction_weighs", "friction_percent"),
                 axis = number(result, "friction_weighs", "axis_rad");
    if (!find(result, "friction_weighs")) continue;  // an event has ended the run
    ++told;
    EXPECT_EQ(axis, result.rows.back().drift_axis_rad);
    const double up = s.rotation_rate_rad_s * std::sin(s.site.latitude_deg * kRadians);
    if (find(result, "laboratory_turns")) {
      // rad: rounding of the product.
      EXPECT_NEAR(number(result, "laboratory_turns", "turned_rad"), -up * 6, 1e-12);
      // The part up to which it is told, 0.3, and rounding.
      EXPECT_NEAR(number(result, "laboratory_turns", "computed_rad"), -up * 6, 0.31 * std::abs(up) * 6);
    }
    s.contact->friction_coefficient *= 1 + percent / 100;
    const auto &one = result.rows.back().ref_axis_L, &other = run(s).rows.back().ref_axis_L;
    const double moved = std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
    // Second order in the change.
    EXPECT_NEAR(moved, axis, 0.1 * axis) << i;
  }
  EXPECT_GE(told, 3);
}

TEST(WhyTable, ATableThatLeansMovesTheAxisAsFarAsIsSaid) {
  RandomNumbers draw(83);
  for (int i = 0; i < 2; ++i) {
    Scenario s = top_on_table(draw, ContactLaw::rolling);
    s.contact->start = ContactStart::rolling, s.contact->tip_radius_m = 0.004, s.duration_s = 2;
    const RunResult result = run(s);
    const double tilt = number(result, "tilt_weighs", "table_tilt_rad"), axis = number(result, "tilt_weighs", "axis_rad");
    ASSERT_GT(tilt, 0) << i << result.verdict.reason;
    EXPECT_EQ(axis, result.rows.back().drift_axis_rad);
    // The change by an arcsecond is held by the tests of the contact's report.
    const PredictionChange& change = result.contact->changes.back();
    EXPECT_EQ(change.input, "table_tilt");
    EXPECT_DOUBLE_EQ(tilt, axis / change.axis_rad * kRadians / 3600);
  }
}

TEST(WhyTable, ATippeTopStandsUpAtAnotherTime) {
  Scenario s;
  s.site = {45, 0, 0, 9.81};
  s.body.mass_kg = 0.006;
  s.body.center_of_mass_m = {0, 0, -0.003};
  s.body.inertia_kg_m2 = {{{8e-7 + 0.006 * 9e-6, 0, 0}, {0, 8e-7 + 0.006 * 9e-6, 0}, {0, 0, 7e-7}}};
  s.contact.emplace();
  s.contact->law = ContactLaw::contensou, s.contact->tip_radius_m = 0.015, s.contact->friction_coefficient = 0.3;
  s.contact->patch_radius_m = 5e-4, s.contact->start = ContactStart::tip_at_rest;
  s.release.tilt_deg = 5.729577951308232, s.release.azimuth_deg = 90, s.release.spin_rad_s = 180;
  s.duration_s = 2, s.output_step_s = 0.002;
  const RunResult result = run(s);
  ASSERT_TRUE(find(result, "stands_up")) << result.verdict.reason;
  const auto level =
      std::find_if(result.rows.begin(), result.rows.end(), [](const DriftRow& r) { return r.ref_axis_L[2] < 0; });
  ASSERT_NE(level, result.rows.end());
  // A step of the rows.
  EXPECT_NEAR(number(result, "stands_up", "passes_s"), level->t_s, 0.0021);
  const DriftRow &next = *level, &before = *(level - 1);
  const double part = before.ref_axis_L[2] / (before.ref_axis_L[2] - next.ref_axis_L[2]);
  const double drift = before.drift_tilt_rad + part * (next.drift_tilt_rad - before.drift_tilt_rad);
  // A parabola between two looks.
  EXPECT_NEAR(number(result, "stands_up", "computed_tilt_rad"), drift, 0.05 * std::abs(drift));
  // The change of the rate between two looks.
  EXPECT_NEAR(number(result, "stands_up", "predicted_tilt_rad"), drift, 0.1 * std::abs(drift));
  const bool later = number(result, "stands_up", "later_s") > 0;
  EXPECT_TRUE(says(result, "stands_up", later ? " s later. There" : " s earlier. There"));
  EXPECT_EQ(later, level->drift_tilt_rad < 0) << "who is later leans less";
}

// -- where they are told

std::vector<double> all_numbers(const RunResult& result) {
  std::vector<double> numbers;
  for (const WhySentence& sentence : result.why)
    for (const auto& [name, value] : sentence.numbers) numbers.push_back(value);
  return numbers;
}

TEST(WhyLaws, TheRowsChangeNothing) {
  RandomNumbers draw(81);
  Scenario rubbed = rubbed_top(draw), nut = wing_nut(20, kEarthRateWgs84), table = top_on_table(draw, ContactLaw::frictionless);
  table.site.latitude_deg = 45, table.release.tilt_deg = 20, table.release.azimuth_deg = 90, table.release.spin_rad_s = 200;
  rubbed.duration_s = 12, rubbed.release.spin_rad_s = 400, rubbed.release.tilt_deg = 40,
  rubbed.effects.applied.viscous_N_m_s = 5e-7;
  Scenario unequal = rubbed;
  unequal.effects.applied = {}, unequal.body.inertia_kg_m2[1][1] = 1.15e-4;
  for (const Scenario& s : {rubbed, nut, table, unequal}) {
    const RunResult result = run(s);
    const std::vector<double> few =
        all_numbers(run(testing::changed(s, [](Scenario& t) { t.output_step_s = t.duration_s / 4; })));
    const std::vector<double> many = all_numbers(result);
    ASSERT_EQ(few.size(), many.size()) << result.verdict.reason;
    EXPECT_GT(many.size(), 4u);
    // the run takes other steps; a bound is of rounding only.
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_NEAR(few[i], many[i], 1e-7 * std::abs(many[i]) + 1e-15) << i;
  }
}

TEST(WhyLaws, NothingIsSaidWhereTheLawsDoNotHold) {
  RandomNumbers draw(82);
  Scenario rubbed = rubbed_top(draw);
  rubbed.effects.applied.viscous_N_m_s = 5e-7, rubbed.duration_s = 12;
  const auto sentences = [](const Scenario& s, const auto& change) { return run(testing::changed(s, change)).why.size(); };
  EXPECT_GT(sentences(rubbed, [](Scenario&) {}), 0u);
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.release.spin_rad_s = 60; }), 0u) << "a slow top";
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.effects.applied.gravity_gradient = GravityGradientSpec{}; }), 0u);
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.platform.emplace().axis = {0, 0, 1}; }), 0u);
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.rotation_rate_rad_s = 0; }), 0u);
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.effects.coriolis = false; }), 0u);
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.release.tilt_deg = 0; }), 0u) << "upright";
  EXPECT_EQ(sentences(rubbed, [](Scenario& s) { s.body.inertia_kg_m2[0][0] = 1.25e-4; }), 0u)
      << "unequal moments, with friction";
  const Scenario nut = wing_nut(20, kEarthRateWgs84);
  EXPECT_GT(sentences(nut, [](Scenario&) {}), 0u);
  EXPECT_EQ(sentences(nut, [](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-12; }), 0u);
  EXPECT_EQ(sentences(nut, [](Scenario& s) { s.effects.coriolis = false; }), 0u);
  const auto turns = [&](const auto& change) { return find(run(testing::changed(nut, change)), "turns_over") != nullptr; };
  EXPECT_TRUE(turns([](Scenario&) {}));
  EXPECT_FALSE(turns([](Scenario& s) { s.duration_s = 1; })) << "before it turns over";
  EXPECT_FALSE(turns([](Scenario& s) { s.body.inertia_kg_m2[0][0] = 8e-6; })) << "about the axis of the smallest moment";
  EXPECT_FALSE(turns([](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::inertial; }));
}

}  // namespace
}  // namespace earthtop
