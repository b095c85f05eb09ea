// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts of a run of a top on a table beside its rows: events, verdict, and how far the prediction moves with its inputs.
#include <gtest/gtest.h>

#include "run/contact_report.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"
#include "support/contact_series.hpp"
#include "support/tolerances.hpp"

namespace earthtop::contact_events_run {
namespace {

using testing::ContactScene;
using testing::scenario_of;

ContactScene contensou_toy() {
  return testing::toy_on_table(
      {.tip_radius_m = 0.002, .law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 3e-5});
}
/// The first digits of a printed number.
void expect_printed(double found, double printed) { EXPECT_NEAR(found / printed, 1, 0.5 / 10) << found; }

/// The figures of the literature's toy top, to their printed digits.
TEST(ContactChanges, OfToyTops) {
  const auto changes = [](const ContactScene& scene, double at_s) {
    const testing::ContactProblem<double> problem(scene);
    return prediction_changes(testing::drift_problem(problem), at_s);
  };
  const auto contensou = changes(contensou_toy(), 5);
  ASSERT_EQ(contensou.size(), 3U);
  EXPECT_EQ(contensou[0].input, "friction_coefficient");
  EXPECT_EQ(contensou[1].input, "patch_radius_m");
  EXPECT_EQ(contensou[2].input, "table_tilt");
  expect_printed(contensou[0].axis_rad, 6.6e-5), expect_printed(contensou[0].tip_m, 1.3e-5);
  expect_printed(contensou[2].axis_rad, 9e-6), expect_printed(contensou[2].tip_m, 1.0e-5);

  const auto frictionless = changes(testing::toy_on_table({.tip_radius_m = 0.002, .law = ContactLaw::frictionless}), 5);
  ASSERT_EQ(frictionless.size(), 1U);
  EXPECT_EQ(frictionless[0].axis_rad, 0);
  // It slides down: half of g t^2 times an arcsecond.
  EXPECT_NEAR(frictionless[0].tip_m / (0.5 * 9.80665 * 25 * real::pi<double>() / 648'000), 1, testing::rounding(200));
  const auto rolling =
      changes(testing::toy_on_table({.tip_radius_m = 0.002, .law = ContactLaw::rolling, .start = ContactStart::rolling}), 5);
  ASSERT_EQ(rolling.size(), 1U);
  expect_printed(rolling[0].axis_rad, 9e-6), expect_printed(rolling[0].tip_m, 1.0e-5);
}

// Disturbances grow some hundredfold while it turns over. Of a rounding of 1e-15 that leaves the drift thirteen digits.
TEST(ContactVerdict, TippeTopIsTrustedWhileItTurnsOver) {
  for (const auto& reference : testing::contact_references()) {
    const std::string name = reference.name;
    if (!name.starts_with("K6")) continue;
    Scenario s = scenario_of(reference.scene);
    s.duration_s = 2, s.output_step_s = 0.1;
    const RunResult result = run(s);
    EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << result.verdict.reason;
    EXPECT_TRUE(is_all_reliable(result));
    EXPECT_LT(result.rows.back().drift_attitude_bound_rad, 1e-11 * result.rows.back().drift_attitude_rad);
    ASSERT_TRUE(result.contact);
    EXPECT_EQ(result.contact->at_s, 2);
    EXPECT_EQ(result.contact->changes.size(), 3U);
    ASSERT_EQ(result.contact->events.size(), 2U);
    for (const ContactEvent& event : result.contact->events) {  // one for each prediction
      EXPECT_EQ(event.kind, ContactEventKind::inverted);
      const double known = event.prediction == Prediction::reference ? 1.0152340906175009096 : 1.0152324042882726541;
      ASSERT_TRUE(event.bound_s);
      EXPECT_LE(std::abs(event.t_s - known), *event.bound_s);
      EXPECT_LT(*event.bound_s, 1e-9);
    }
  }
}

TEST(ContactVerdict, ToyTopIsReliable) {
  Scenario s = scenario_of(contensou_toy());
  s.duration_s = 2, s.output_step_s = 0.5;
  const RunResult result = run(s);
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << result.verdict.reason;
  EXPECT_TRUE(result.contact && result.contact->events.empty());
}

TEST(ContactRunEvents, LiftOffEndsTheRunWithoutFailure) {
  ContactScene scene = testing::toy_on_table(
      {.tip_radius_m = 0.002, .law = ContactLaw::frictionless, .start = ContactStart::center_of_mass_at_rest});
  scene.tilt_deg = 60, scene.spin_rad_s = 50, scene.transverse_rad_s = {-3, -15};
  Scenario s = scenario_of(scene);
  s.duration_s = 0.02, s.output_step_s = 0.001;
  const RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  ASSERT_EQ(result.rows.size(), 8U);
  EXPECT_EQ(result.rows.back().t_s, 0.007);
  ASSERT_TRUE(result.contact && result.contact->events.size() == 2U);
  EXPECT_LE(std::abs(result.contact->events[0].t_s - 0.0070863810694653000743), *result.contact->events[0].bound_s);
  EXPECT_LE(std::abs(result.contact->events[1].t_s - 0.0070864527085555633182), *result.contact->events[1].bound_s);
}

TEST(ContactRunEvents, SlipStopsMarkTheRowsBetweenThem) {
  Scenario s =
      scenario_of(testing::leine_glocker_top({.tip_radius_m = 0.015, .law = ContactLaw::coulomb, .friction_coefficient = 0.3}));
  s.duration_s = 0.1445778, s.output_step_s = 0.03614445;  // the second row is between the two stops
  const RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  ASSERT_EQ(result.rows.size(), 5U);
  const ContactState states[5] = {ContactState::slide, ContactState::mixed, ContactState::roll, ContactState::roll,
                                  ContactState::roll};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(result.rows[i].contact->state, states[i]) << i;
    EXPECT_EQ(result.rows[i].drift_reliable, i != 1) << i;
  }
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << result.verdict.reason;
  ASSERT_TRUE(result.contact && result.contact->events.size() == 2U);
  EXPECT_EQ(result.contact->events[0].prediction, Prediction::rotating);
  EXPECT_NEAR(*result.contact->events[0].time_difference_s / -7.9683137625358639e-7, 1, 1e-9);
}

/// A rod whose end slides so fast over a rough table that friction presses it down. Coming from a large tilt it runs into Painleve's
/// paradox where the denominator of the normal force falls to 0 together with its numerator: to that point a whole set of motions
/// is drawn (Genot and Brogliato 1999). There 1 + 3 sin^2 = 3 mu sin cos, and the normal force grows without bound.
TEST(ContactRunEvents, PainlevesParadoxEndsTheRunWithoutFailure) {
  ContactSpec contact{.tip_radius_m = 0, .law = ContactLaw::coulomb, .friction_coefficient = 2, .regularisation_m_s = 0.01};
  contact.start = ContactStart::tip_velocity, contact.tip_velocity_m_s = {-100, 0};
  ContactScene rod{1, 0.5, 1.0 / 12, 1e-3, 9.81, 0, 62, contact};
  rod.transverse_rad_s = {0, -4};
  Scenario s = scenario_of(rod);
  s.duration_s = 0.15, s.output_step_s = 0.0025;
  const RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  ASSERT_TRUE(result.contact);
  ASSERT_EQ(result.contact->events.size(), 1U);
  const ContactEvent& event = result.contact->events[0];
  EXPECT_EQ(event.kind, ContactEventKind::no_unique_force);
  ASSERT_TRUE(event.bound_s);
  EXPECT_LT(*event.bound_s, 1e-6);
  ASSERT_GT(result.rows.size(), 10U);
  const DriftRow& last = result.rows.back();
  EXPECT_LT(last.t_s, event.t_s);
  EXPECT_GT(last.t_s, event.t_s - s.output_step_s);
  // tan = 1.309 there, of a slip along the meridian of the tilt
  EXPECT_NEAR(std::acos(last.ref_axis_L[2]) * 180 / real::pi<double>(), 52.6, 2);
  EXPECT_GT(last.contact->ref_normal_force_N, 5 * 9.81);
  EXPECT_GT(result.rows.front().contact->ref_normal_force_N, 0);
}

/// Rolling by the exact Coulomb law takes more friction than there is: the slip starts, and what follows is marginal.
TEST(ContactRunEvents, SlipOnsetIsMarginalFromThenOn) {
  ContactSpec contact{.tip_radius_m = 0.002, .law = ContactLaw::coulomb, .friction_coefficient = 0.35};
  contact.start = ContactStart::rolling;
  ContactSpec rolling{.tip_radius_m = 0.002, .law = ContactLaw::rolling, .start = ContactStart::rolling};
  rolling.static_coefficient = 0.35;
  for (const ContactSpec& spec : {contact, rolling}) {
    testing::ContactScene scene = testing::toy_on_table(spec);
    scene.transverse_rad_s = {-3, 0};
    Scenario s = scenario_of(scene);
    s.duration_s = 0.2, s.output_step_s = 0.002;
    const RunResult result = run(s);
    EXPECT_EQ(result.status, RunStatus::completed);
    ASSERT_TRUE(result.contact);
    ASSERT_EQ(result.contact->events.size(), 2U);  // of each prediction
    for (const ContactEvent& event : result.contact->events) {
      EXPECT_EQ(event.kind, ContactEventKind::slip_started);
      ASSERT_TRUE(event.bound_s && event.time_difference_s);
      EXPECT_LT(*event.bound_s, 1e-9);
    }
    EXPECT_EQ(result.verdict.verdict, Verdict::marginal) << result.verdict.reason;
    EXPECT_EQ(result.verdict.from_s, result.contact->events[0].t_s);
    ASSERT_EQ(result.rows.size(), 101U);
    for (const DriftRow& row : result.rows) EXPECT_EQ(row.drift_reliable, row.t_s < *result.verdict.from_s) << row.t_s;
    EXPECT_TRUE(result.rows[1].drift_reliable);
  }
}

/// The largest error over its bound, of axis and attitude, against the same scenario in 113 bits.
double share_of_bound(const RunResult& result) {
  Scenario wide = result.scene.scenario();
  wide.precision = Precision::bits113;
  wide.numerics = {};
  wide.numerics.relative_tolerance = default_tolerance(wide.precision);
  const RunResult truth = run(wide);
  double share = 0;
  for (std::size_t i = 1; i < result.rows.size(); ++i) {
    const DriftRow& row = result.rows[i];
    const ExtendedDriftRow& exact = truth.extended_rows.at(i);
    const auto error = [](double found, float128 known) { return std::abs(static_cast<double>(float128(found) - known)); };
    share = std::max({share, error(row.drift_axis_rad, exact.drift_axis_rad) / row.drift_axis_bound_rad,
                      error(row.drift_attitude_rad, exact.drift_attitude_rad) / row.drift_attitude_bound_rad});
  }
  return share;
}

// Disturbances of both grow some tenfold at most, less than the angle that the motion sweeps.
TEST(ContactVerdict, GrowthByAFewTimesIsNoInstability) {
  Scenario patch;
  patch.site.latitude_deg = 90, patch.site.gravity_m_s2 = 9.80665;
  patch.body.mass_kg = 0.104841;
  patch.body.center_of_mass_m = {0, 0, 0.0556263};
  patch.body.inertia_about = InertiaAbout::center_of_mass;
  testing::set_principal(patch.body, 0.00039847, 0.000170777, 0.000416997);
  patch.release.tilt_deg = 6.643, patch.release.azimuth_deg = -101.6, patch.release.spin_rad_s = 36.591;
  patch.contact = ContactSpec{.tip_radius_m = 0.00198639,
                              .law = ContactLaw::contensou,
                              .friction_coefficient = 0.1015,
                              .patch_radius_m = 0.0001032,
                              .start = ContactStart::rolling};
  patch.duration_s = 1.996, patch.output_step_s = 0.1996;
  Scenario dry = patch;
  dry.site.latitude_deg = -53.555;
  dry.body.mass_kg = 0.726418;
  dry.body.center_of_mass_m = {0, 0, 0.02902};
  testing::set_principal(dry.body, 0.000174224, 0.000174224, 9.17964e-05);
  dry.release.tilt_deg = 14.41, dry.release.azimuth_deg = 88.27, dry.release.spin_rad_s = -460.656;
  dry.rotation_rate_rad_s = -0.0002965234;
  dry.contact = ContactSpec{.tip_radius_m = 0.00784292,
                            .law = ContactLaw::coulomb,
                            .friction_coefficient = 0.07734,
                            .start = ContactStart::center_of_mass_at_rest};
  dry.duration_s = 0.4422, dry.output_step_s = 0.04422;
  for (const Scenario& scenario : {patch, dry}) {
    const RunResult result = run(scenario);
    EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << result.verdict.reason;
    EXPECT_TRUE(is_all_reliable(result));
    EXPECT_LE(share_of_bound(result), 1);
  }
}

// A ball that only turns: the moment of the patch is constant, so that the turning ends at a known time, and a run ends where
// 1e-5 of it is left.
TEST(ContactEventsRun, APatchThatStopsEndsTheRun) {
  const double I = 1.6e-5, spin = 2, patch = 5e-4, mu = 0.2, gravity = 9.80665, mass = 0.1;
  ContactSpec contact{.tip_radius_m = 0.02, .law = ContactLaw::contensou, .friction_coefficient = mu, .patch_radius_m = patch};
  Scenario s = testing::scenario_of({mass, 0, I, I, gravity, spin, 0, contact});
  s.duration_s = 1, s.output_step_s = 0.1;
  const RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  ASSERT_TRUE(result.contact && !result.contact->events.empty());
  const double ends_s = spin * I / (3 * real::pi<double>() / 16 * mu * mass * gravity * patch);
  for (const ContactEvent& event : result.contact->events) {
    EXPECT_EQ(event.kind, ContactEventKind::patch_stopped);
    EXPECT_NEAR(event.t_s / ((1 - 1e-5) * ends_s), 1, event.prediction == Prediction::reference ? 1e-10 : 1e-6);
  }
  EXPECT_LT(result.reached_s, ends_s);
  EXPECT_GT(result.rows.size(), 4U);
}

// Dry friction cannot hold a tip that needs more than it gives; nor is a tip held in one prediction that slips in the other.
TEST(ContactEventsRun, AReleaseThatDryFrictionCannotHoldIsRefused) {
  ContactSpec contact{.tip_radius_m = 0, .law = ContactLaw::coulomb, .friction_coefficient = 0.02};
  const auto errors = [](const Scenario& s) { return examine_scenario({"test", canonical_json(s), false}).errors; };
  Scenario s = testing::scenario_of(testing::toy_on_table(contact));
  s.duration_s = 0.1, s.output_step_s = 0.1;
  ASSERT_EQ(errors(s).size(), 1U);
  EXPECT_EQ(errors(s)[0].pointer, "/contact/friction_coefficient");
  s.contact->friction_coefficient = 0.5;
  EXPECT_TRUE(errors(s).empty());
  s.contact->start = ContactStart::center_of_mass_at_rest;
  EXPECT_TRUE(errors(s).empty());
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  ASSERT_EQ(errors(s).size(), 1U);
  EXPECT_EQ(errors(s)[0].pointer, "/contact/start");
}

}  // namespace
}  // namespace earthtop::contact_events_run
