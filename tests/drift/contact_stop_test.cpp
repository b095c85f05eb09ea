// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs under the exact Coulomb law: both motions slide to the stops of their slips, and roll on. And runs that an event ends.
#include <gtest/gtest.h>

#include "drift/table/contact_integration.hpp"
#include "support/contact_references.hpp"
#include "support/contact_series.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::ContactProblem;
using testing::ContactScene;

ContactSpec coulomb(double tip_radius_m, double mu) {
  return {.tip_radius_m = tip_radius_m, .law = ContactLaw::coulomb, .friction_coefficient = mu};
}
DriftTrajectory<double> integrated(const ContactScene& scene, const std::vector<double>& times_s,
                                   Observer observer = Observer::laboratory) {
  const ContactProblem<double> problem(scene);
  DriftProblem<double> drift = testing::drift_problem(problem);
  drift.times_s = times_s;
  drift.fastest_rate = problem.units.rate_from_rad_s(2 * scene.spin_rad_s + 50);
  IntegrationOptions options;
  options.method = Method::taylor, options.observer = observer, options.relative_tolerance = 1e-14;
  return integrate_contact(drift, options, {});
}
std::vector<ContactEvent> of_kind(const DriftTrajectory<double>& run, ContactEventKind kind) {
  std::vector<ContactEvent> found;
  for (const ContactEvent& event : run.contact_events)
    if (event.kind == kind) found.push_back(event);
  return found;
}
void expect_stops(const DriftTrajectory<double>& run, double reference, double rotating, double difference, double digits) {
  const auto stops = of_kind(run, ContactEventKind::slip_stopped);
  ASSERT_EQ(stops.size(), 2U);
  EXPECT_LE(stops[0].t_s, stops[1].t_s);
  for (const ContactEvent& stop : stops) {
    EXPECT_NEAR(stop.t_s / (stop.prediction == Prediction::reference ? reference : rotating), 1, 1e-11);
    EXPECT_NEAR(*stop.time_difference_s / difference, 1, digits);
  }
  EXPECT_NE(stops[0].prediction, stops[1].prediction);
}

TEST(ContactStops, LeineAndGlockersTopRollsOn) {
  const ContactScene scene = testing::leine_glocker_top(coulomb(0.015, 0.3));
  const auto run = integrated(scene, {0, 0.01, 0.03, 0.0361445, 0.04, 0.5, 1});
  EXPECT_EQ(run.status, RunStatus::completed);
  expect_stops(run, 0.036144921891384602188, 0.036144125060008348602, -7.9683137625358639e-7, 1e-10);
  EXPECT_TRUE(of_kind(run, ContactEventKind::slip_started).empty());  // rolling needs 12 % of mu N
  ASSERT_EQ(run.samples.size(), 7U);
  const auto& at_end = *run.samples.back().contact;
  const double epsilon = run.samples.back().state.epsilon;
  const double p[2] = {9.453646349557655e-7, 2.801364679312270e-5}, n[2] = {-2.017236267302578e-5, 3.454428095376827e-6};
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(epsilon * at_end.tip_L[i].diff, p[i], testing::rounding(5000) * std::hypot(p[0], p[1]));
    EXPECT_NEAR(epsilon * at_end.axis_L[i].diff, n[i], testing::rounding(5000) * std::hypot(n[0], n[1]));
  }
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const auto& sample = run.samples[i];
    if (i < 3) {
      EXPECT_GT(sample.contact->slip.ref, 0);
    } else if (i > 3) {
      EXPECT_EQ(sample.contact->slip.ref, 0);
    }
    // The attitude's axis is that of the reduced state, before and after the stop.
    EXPECT_NEAR(norm(Vec3<double>(rotation_matrix(sample.state.ref_q_LB).col(2) - Vec3<double>(sample.contact->axis_L[0].ref,
                                                                                               sample.contact->axis_L[1].ref,
                                                                                               sample.contact->axis_L[2].ref))),
                0, 1e-12);
  }
}

TEST(ContactStops, OfABallAndOfAToyTopAreAtTheirTimes) {
  ContactSpec contact = coulomb(0.02, 0.2);
  contact.start = ContactStart::tip_velocity, contact.tip_velocity_m_s = {1, 0};
  const ContactScene ball{0.1, 0, 1.6e-5, 1.6e-5, 9.80665, 200, 0, contact};
  const auto rolled = integrated(ball, {0, 0.1, 0.2});
  expect_stops(rolled, 0.1456737447111326, 0.1456750579911984475, 1.3132800658475e-6, 1e-9);
  EXPECT_EQ(rolled.samples.size(), 3U);

  const auto toy = integrated(testing::toy_on_table(coulomb(0.002, 0.2)), {0, 0.04, 0.05});
  expect_stops(toy, 0.041675440557094284672, 0.041675219113489381289, -2.21443604903383e-7, 1e-9);
  EXPECT_EQ(toy.contact_events.size(), 2U);  // rolling takes 0.7559 of mu N
}

/// A release without slip rolls from the start, and is seen to need more friction than there is.
TEST(ContactStops, ATipAtRestRollsFromTheStart) {
  ContactSpec contact = coulomb(0.002, 0.3);
  contact.start = ContactStart::rolling;
  ContactScene scene = testing::toy_on_table(contact);
  const auto rolling = integrated(scene, {0, 0.05, 0.1});
  EXPECT_EQ(rolling.samples.size(), 3U);
  EXPECT_TRUE(rolling.contact_events.empty());  // it takes 0.2557 of the normal force at most
  EXPECT_EQ(rolling.samples.back().contact->slip.rot, 0);
  scene.contact.friction_coefficient = 0.25;
  const auto slipping = integrated(scene, {0, 0.05, 0.1});
  ASSERT_FALSE(slipping.contact_events.empty());
  EXPECT_EQ(slipping.contact_events[0].kind, ContactEventKind::slip_started);
}

TEST(ContactRuns, EndAtLiftOff) {
  ContactSpec contact{.tip_radius_m = 0.002, .law = ContactLaw::frictionless, .start = ContactStart::center_of_mass_at_rest};
  ContactScene scene = testing::toy_on_table(contact);
  scene.tilt_deg = 60, scene.spin_rad_s = 50, scene.transverse_rad_s = {-3, -15};
  for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
    const auto run = integrated(scene, {0, 0.002, 0.004, 0.00708638, 0.0070865, 0.01, 1}, observer);
    EXPECT_EQ(run.status, RunStatus::completed);
    ASSERT_EQ(run.samples.size(), 4U);
    ASSERT_EQ(run.contact_events.size(), 2U);
    EXPECT_EQ(run.contact_events[0].prediction, Prediction::reference);
    EXPECT_NEAR(run.contact_events[0].t_s / 0.0070863810694653000743, 1, 1e-11);
    EXPECT_NEAR(run.contact_events[1].t_s / 0.0070864527085555633182, 1, 1e-11);
  }
}

}  // namespace
}  // namespace earthtop
