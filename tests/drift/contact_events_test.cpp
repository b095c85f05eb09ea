// SPDX-License-Identifier: GPL-3.0-or-later
/// Events of a top on a table, found while it is integrated: in both predictions, with their time difference.
#include <gtest/gtest.h>

#include "support/contact_references.hpp"
#include "support/contact_series.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::ContactScene;
using testing::watched_motion;
using testing::WatchedMotion;

/// The first event of a kind in each prediction.
struct Found {
  const ContactEvent *reference = nullptr, *rotating = nullptr;
};
Found found(const WatchedMotion& motion, ContactEventKind kind) {
  Found both;
  for (const ContactEvent& event : motion.events) {
    const ContactEvent*& slot = event.prediction == Prediction::reference ? both.reference : both.rotating;
    if (event.kind == kind && slot == nullptr) slot = &event;
  }
  return both;
}
/// @param difference  of the two times as a reference has it   @param digits  relative error that its own digits leave it
void expect_times(const WatchedMotion& motion, ContactEventKind kind, double reference, double rotating, double difference,
                  double digits) {
  const Found both = found(motion, kind);
  ASSERT_TRUE(both.reference && both.rotating) << to_string(kind);
  EXPECT_NEAR(both.reference->t_s / reference, 1, testing::rounding(4000));
  EXPECT_NEAR(both.rotating->t_s / rotating, 1, testing::rounding(4000));
  ASSERT_TRUE(both.reference->time_difference_s && both.rotating->time_difference_s);
  EXPECT_NEAR(*both.reference->time_difference_s / difference, 1, digits);
  EXPECT_EQ(*both.reference->time_difference_s, *both.rotating->time_difference_s);
}

ContactScene lifting(std::array<double, 2> transverse, double spin) {
  ContactSpec contact{.tip_radius_m = 0.002, .law = ContactLaw::frictionless, .start = ContactStart::center_of_mass_at_rest};
  ContactScene scene = testing::toy_on_table(contact);
  scene.tilt_deg = 60, scene.spin_rad_s = spin, scene.transverse_rad_s = transverse;
  return scene;
}

TEST(ContactEvents, LiftOffIsTimedInBothPredictions) {
  // The differences have the digits that the printed times leave them.
  const ContactScene spun = lifting({-3, -15}, 50), straight = lifting({0, -22}, 0);
  for (const auto& motion : {watched_motion<double, Observer::laboratory>(spun, 0.05, 1e-14),
                             watched_motion<double, Observer::inertial>(spun, 0.05, 1e-14)}) {
    expect_times(motion, ContactEventKind::lifted_off, 0.0070863810694653000743, 0.0070864527085555633182, 7.16390902632439e-8,
                 1e-9);
    EXPECT_LT(motion.reached_s, 0.05);
  }
  expect_times(watched_motion<double, Observer::laboratory>(straight, 0.05, 1e-14), ContactEventKind::lifted_off,
               0.011612370196280499907, 0.011612370196216116821, -6.4383086e-14, 1e-6);
}

TEST(ContactEvents, TippeTopsPassTheHorizontalAtTheirTimes) {
  const auto references = testing::contact_references();
  struct Case {
    const char* name;
    double reference, rotating, difference;
  };
  for (const Case& known : {Case{"K5", 5.8797495180457983792, 5.8797330688474554265, -1.64491983429527e-5},
                            Case{"K6", 1.0152340906175009096, 1.0152324042882726541, -1.6863292282555e-6},
                            Case{"K7", 0.99197416215108351295, 0.99197493514116597806, 7.7299008246511e-7}}) {
    const auto scene = std::find_if(references.begin(), references.end(), [&](const auto& r) {
                         return std::string(r.name).starts_with(known.name);
                       })->scene;
    const WatchedMotion motion = watched_motion<double, Observer::laboratory>(scene, 1.01 * known.reference, 1e-14);
    expect_times(motion, ContactEventKind::inverted, known.reference, known.rotating, known.difference, 1e-7);
    EXPECT_GE(motion.reached_s, known.reference);  // nothing ends
  }
}

/// The largest tilt is passed at the same times in all forms of the equations, and the tilt is the one asked for.
TEST(ContactEvents, RimIsTouchedAtTheSameTimesInAllForms) {
  ContactSpec contact{.tip_radius_m = 0.002, .law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4};
  contact.max_tilt_deg = 30;
  ContactScene scene = testing::toy_on_table(contact);
  scene.spin_rad_s = 60;  // too slow to stand
  const auto laboratory = watched_motion<double, Observer::laboratory>(scene, 5, 1e-14);
  const Found known = found(laboratory, ContactEventKind::rim_touched);
  ASSERT_TRUE(known.reference && known.rotating && known.reference->time_difference_s);
  EXPECT_LT(laboratory.reached_s, known.reference->t_s + 0.05);
  const double times[2] = {known.reference->t_s, known.rotating->t_s}, difference = *known.reference->time_difference_s;
  EXPECT_NEAR(difference, times[1] - times[0], testing::rounding(4) * times[1]);
  for (const auto& motion : {watched_motion<double, Observer::inertial>(scene, 5, 1e-14),
                             watched_motion<double, Observer::laboratory, testing::Form::general>(scene, 5, 1e-14)})
    expect_times(motion, ContactEventKind::rim_touched, times[0], times[1], difference, 1e-8);
  const auto rows = testing::contact_rows<double, Observer::laboratory>(scene, {times[0], times[1]}, 1e-14);
  EXPECT_NEAR(std::acos(rows[0].contact.axis_L[2].ref) * 180 / real::pi<double>(), 30, 1e-10);
  EXPECT_NEAR(std::acos(rows[1].contact.axis_L[2].rot) * 180 / real::pi<double>(), 30, 1e-10);
}

/// A rolling tip that needs more friction than it may: the first time, and the run goes on.
TEST(ContactEvents, RollingExceedsItsStaticFriction) {
  ContactSpec contact{.tip_radius_m = 0.002, .law = ContactLaw::rolling, .start = ContactStart::rolling};
  contact.static_coefficient = 0.35;
  ContactScene scene = testing::toy_on_table(contact);
  scene.transverse_rad_s = {-3, 0};
  const auto motion = watched_motion<double, Observer::laboratory>(scene, 0.2, 1e-14);
  const Found onset = found(motion, ContactEventKind::slip_started);
  ASSERT_TRUE(onset.reference && onset.rotating);
  EXPECT_EQ(motion.events.size(), 2U);
  EXPECT_EQ(motion.reached_s, 0.2);
  const auto row = testing::contact_rows<double, Observer::laboratory>(scene, {onset.reference->t_s}, 1e-14)[0];
  const auto& F = row.contact.reaction;
  EXPECT_NEAR(std::hypot(F.friction[0].ref, F.friction[1].ref, F.friction[2].ref) / F.normal_force.ref, 0.35,
              testing::rounding(2000));
}

/// A rod on a rough table, released where no unique force holds it (mu l^2 m/I1 is beyond Painleve's limit).
TEST(ContactEvents, NoUniqueForceAtTheRelease) {
  ContactSpec contact{.tip_radius_m = 0, .law = ContactLaw::coulomb, .friction_coefficient = 3, .regularisation_m_s = 1e-3};
  contact.start = ContactStart::tip_velocity, contact.tip_velocity_m_s = {-1, 0};
  const ContactScene rod{1, 0.3, 0.03, 0.0001, 9.80665, 0, 10, contact};
  const auto motion = watched_motion<double, Observer::laboratory>(rod, 1, 1e-12);
  ASSERT_EQ(motion.events.size(), 2U);
  for (const ContactEvent& event : motion.events) EXPECT_EQ(event.kind, ContactEventKind::no_unique_force);
  EXPECT_EQ(motion.events[0].t_s, 0);
}

}  // namespace
}  // namespace earthtop
