// SPDX-License-Identifier: GPL-3.0-or-later
/// Derivatives of the non-rotating prediction of a top on a table, and the growth of disturbances of its motion.
#include "drift/derivatives/contact_growth.hpp"

#include <gtest/gtest.h>

#include "drift/derivatives/contact_derivatives.hpp"
#include "support/contact_references.hpp"
#include "support/contact_series.hpp"

namespace earthtop {
namespace {

using testing::ContactProblem;
using testing::ContactScene;
using testing::drift_problem;

ContactScene toy(ContactLaw law) {
  ContactSpec contact{.tip_radius_m = 0.002, .law = law};
  if (law == ContactLaw::contensou) contact.friction_coefficient = 0.2, contact.patch_radius_m = 3e-5;
  if (law == ContactLaw::viscous) contact.sliding_viscosity_N_s_m = 0.05;
  if (law == ContactLaw::rolling) contact.start = ContactStart::rolling;
  return testing::toy_on_table(contact);
}
ContactScene reference_scene(const std::string& name) {
  for (const auto& reference : testing::contact_references())
    if (std::string(reference.name).starts_with(name)) return reference.scene;
  throw std::logic_error("no such reference: " + name);
}

/// Each derivative is that of two integrations next to the scene, for a symmetric body and for another one.
TEST(ContactDerivatives, AreThoseOfNeighbouringMotions) {
  struct Input {
    double ContactSpec::*given;
    double Contact<double>::*coefficient;
  };
  for (const double I2 : {0.0, 2.9e-5}) {
    ContactScene scene = toy(ContactLaw::contensou);
    scene.contact.spinning_friction_m = 1e-4, scene.contact.rolling_resistance_m = 2e-4, scene.contact.regularisation_rad_s = 1;
    scene.I2_kg_m2 = I2;
    constexpr double kStep = 1e-3, kTime = 0.3;
    for (const Input& input : {Input{&ContactSpec::friction_coefficient, &Contact<double>::coefficient},
                               Input{&ContactSpec::patch_radius_m, &Contact<double>::patch_radius},
                               Input{&ContactSpec::spinning_friction_m, &Contact<double>::spinning_length},
                               Input{&ContactSpec::rolling_resistance_m, &Contact<double>::rolling_length}}) {
      const double value = scene.contact.*(input.given);
      ProblemDerivative change;
      change.table.contact.*(input.coefficient) = value;
      const ContactProblem<double> problem(scene);
      const auto found = contact_derivatives(drift_problem(problem), {change}, kTime, 1e-12);
      ASSERT_TRUE(found.completed);
      Vec3<double> axis[2], tip[2];
      for (int side : {0, 1}) {
        ContactScene moved = scene;
        moved.contact.*(input.given) = value * (1 + (side == 0 ? -kStep : kStep));
        const ContactProblem<double> near(moved, problem.units);
        const auto row = testing::rows_of(near, near.system<Observer::laboratory, testing::Form::general>(), {kTime}, 1e-13)[0];
        for (int i = 0; i < 3; ++i) axis[side][i] = row.contact.axis_L[i].ref, tip[side][i] = row.contact.tip_L[i].ref;
      }
      // The difference is of the second order, and its rounding is 1e-13 over the step.
      const Vec3<double> d_axis = (axis[1] - axis[0]) / (2 * kStep), d_tip = (tip[1] - tip[0]) / (2 * kStep);
      EXPECT_LT(norm(Vec3<double>(found.each[0].axis_L - d_axis)), 1e-4 * norm(d_axis));
      EXPECT_LT(norm(Vec3<double>(found.each[0].tip_L_m - d_tip)), 1e-4 * norm(d_tip));
    }
  }
}

/// A table that is tilted further, and gravity that is tilted back.
TEST(ContactDerivatives, OfTheTiltAreThoseOfATiltedTable) {
  const ContactScene scene = toy(ContactLaw::rolling);
  const ContactProblem<double> level(scene);
  const auto tilt = table_tilt_change(level.model, level.start, SinCos<double>{1, 0});
  const auto found = contact_derivatives(drift_problem(level), {tilt}, 1);
  constexpr double kTilt = 1e-4;  // rad, to the East
  ContactScene tilted = scene;
  tilted.contact.table_tilt_deg = kTilt * 180 / real::pi<double>(), tilted.contact.table_tilt_azimuth_deg = 90;
  const auto along = [](const ContactScene& of) {
    const ContactProblem<double> problem(of);
    const auto row = testing::contact_rows<double, Observer::laboratory>(of, {1}, 1e-14)[0];
    // In the table's axes, in which the derivative is at rest.
    const Mat3<double> R = rotation_matrix(problem.start.q_LH);
    return std::pair(
        transposed_times(R, Vec3<double>(row.contact.axis_L[0].ref, row.contact.axis_L[1].ref, row.contact.axis_L[2].ref)),
        transposed_times(R, Vec3<double>(row.contact.tip_L[0].ref, row.contact.tip_L[1].ref, row.contact.tip_L[2].ref)));
  };
  const auto there = along(tilted), here = along(scene);
  const Vec3<double> d_axis = (there.first - here.first) / kTilt, d_tip = (there.second - here.second) / kTilt;
  EXPECT_LT(norm(Vec3<double>(found.each[0].axis_L - d_axis)), 1e-2 * norm(d_axis));
  EXPECT_LT(norm(Vec3<double>(found.each[0].tip_L_m - d_tip)), 1e-2 * norm(d_tip));
}

/// Tippe tops amplify a disturbance while they turn over, and not after.
TEST(ContactGrowth, ComesBackWhenATippeTopHasTurnedOver) {
  struct Case {
    const char* name;
    double end_s;
  };
  constexpr double kStandsAgain_deg = 110;
  for (const Case& known : {Case{"K5", 9}, Case{"K6", 3}, Case{"K7", 4}}) {
    const ContactScene scene = reference_scene(known.name);
    const ContactProblem<double> problem(scene);
    auto drift = drift_problem(problem);
    drift.fastest_rate = problem.units.rate_from_rad_s(scene.spin_rad_s);
    const ContactGrowth growth = contact_growth(drift, known.end_s);
    // While it is more than half of what it comes to, the top turns over.
    const double log_half = std::log(growth.largest / 2);
    const auto beyond = growth.beyond(log_half);
    ASSERT_TRUE(growth.completed && beyond && beyond->until_s) << known.name;
    EXPECT_GT(growth.largest, 100);
    EXPECT_FALSE(growth.exponential_s) << "a hundred times the angle swept are some ten thousand";
    const auto rows = testing::contact_rows<double, Observer::laboratory>(scene, {beyond->from_s, *beyond->until_s}, 1e-12);
    const double degree = real::pi<double>() / 180;
    EXPECT_GT(rows[0].contact.axis_L[2].ref, 0) << known.name;
    EXPECT_LT(rows[1].contact.axis_L[2].ref, std::cos(kStandsAgain_deg * degree)) << known.name;
    // Followed into the inversion only, it has not come back.
    const auto cut = contact_growth(drift, 0.5 * (beyond->from_s + *beyond->until_s)).beyond(log_half);
    EXPECT_TRUE(cut && !cut->until_s);
  }
}

TEST(ContactGrowth, OfAToyTopIsRegularUnderEveryLaw) {
  for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::viscous, ContactLaw::contensou, ContactLaw::rolling})
    for (const double I2 : {0.0, 2.9e-5}) {
      ContactScene scene = toy(law);
      scene.I2_kg_m2 = I2;
      const ContactProblem<double> problem(scene);
      auto drift = drift_problem(problem);
      drift.fastest_rate = problem.units.rate_from_rad_s(scene.spin_rad_s);
      const ContactGrowth growth = contact_growth(drift, 2);
      EXPECT_TRUE(growth.completed && !growth.exponential_s) << static_cast<int>(law) << " " << growth.largest_ratio;
      EXPECT_GT(growth.largest, 1.5);
      EXPECT_LT(growth.largest_ratio, 3);
    }
}

/// A top that is too slow to stand falls, and disturbances grow with it to the end: the less it leaned, the more.
TEST(ContactGrowth, OfAFallingTopIsFast) {
  ContactScene scene = toy(ContactLaw::contensou);
  scene.spin_rad_s = 60, scene.tilt_deg = 1e-2;
  const ContactProblem<double> problem(scene);
  auto drift = drift_problem(problem);
  drift.fastest_rate = problem.units.rate_from_rad_s(scene.spin_rad_s);
  const ContactGrowth growth = contact_growth(drift, 0.8);
  ASSERT_TRUE(growth.exponential_s);
  const auto beyond = growth.beyond(std::log(kRegularGrowth * (1 + 60 * *growth.exponential_s)));
  EXPECT_TRUE(beyond && !beyond->until_s);
  EXPECT_NEAR(beyond->from_s, *growth.exponential_s, 0.1 * *growth.exponential_s);
}

}  // namespace
}  // namespace earthtop
