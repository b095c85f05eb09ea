// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of tops on a table: the drift of reference cases and its bounds, the same drift in the two formulations, and what a scene
/// without a turning Earth or without a table must give.

#include <gtest/gtest.h>

#include <random>

#include "run/contact_rows.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"
#include "support/scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop::contact_run {
namespace {

using testing::ContactScene;

using testing::scenario_of;

double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

// The reference cases are asked to hold to 1e-9 of each column's norm in D rows and to 1e-11 in N and E rows. A run
// that mixes up units, signs or the two predictions, or whose bound leaves out the tip, fails.
TEST(ContactRun, RowsOfReferenceCasesWithinTheirBounds) {
  for (const auto& reference : testing::contact_references()) {
    const std::string name = reference.name;
    if (!name.starts_with("K1 ") && !name.starts_with("K4") && !name.starts_with("K8")) continue;
    Scenario s = scenario_of(reference.scene);
    s.duration_s = 5, s.output_step_s = 0.1;
    const RunResult result = run(s);
    ASSERT_EQ(result.status, RunStatus::completed) << name;
    EXPECT_EQ(result.certificate.observer, Observer::inertial);
    const auto row_at = [&](double t_s) -> const DriftRow& {
      return result.rows.at(static_cast<std::size_t>(std::lround(t_s / s.output_step_s)));
    };
    for (const auto& motion : reference.motions) {
      const DriftRow& row = row_at(motion.t_s);
      const auto& axis = motion.on_earth ? row.axis_L : row.ref_axis_L;
      const auto& tip = motion.on_earth ? row.contact->tip_m : row.contact->ref_tip_m;
      const std::array<double, 2> expected{testing::parsed<double>(motion.p[0]), testing::parsed<double>(motion.p[1])};
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(axis[i], testing::parsed<double>(motion.n[i]), testing::truncation(s.numerics.relative_tolerance)) << name;
      EXPECT_LT(distance(tip, expected), 1e-11 * std::hypot(expected[0], expected[1])) << name;
    }
    for (const auto& drift : reference.drifts) {
      const DriftRow& row = row_at(drift.t_s);
      const double angle = testing::parsed<double>(drift.angle), w3 = testing::parsed<double>(drift.w3);
      const std::array<double, 2> tip{testing::parsed<double>(drift.p[0]), testing::parsed<double>(drift.p[1])};
      const double axis_error = std::abs(row.drift_axis_rad - angle), tip_error = distance(row.contact->drift_tip_xy_m, tip);
      EXPECT_LT(axis_error, testing::truncation(s.numerics.relative_tolerance) * angle) << name;
      EXPECT_LT(tip_error, 1e-9 * std::hypot(tip[0], tip[1])) << name;
      EXPECT_NEAR(row.contact->drift_spin_rate_rad_s, w3, testing::rounding(1000) * std::abs(w3)) << name;
      // The references have 17 digits.
      EXPECT_LE(axis_error, row.drift_axis_bound_rad + 1e-16 * angle) << name;
      EXPECT_LE(tip_error, row.contact->drift_tip_bound_m + 1e-16 * std::hypot(tip[0], tip[1])) << name;
    }
    const double weight = reference.scene.mass_kg * reference.scene.gravity_m_s2;
    EXPECT_GT(row_at(1).contact->normal_force_N, weight / 2);
    EXPECT_LT(row_at(1).contact->normal_force_N, 2 * weight);
    for (const InvariantReport& invariant : result.invariants)
      EXPECT_LT(invariant.largest_change, testing::rounding(500) * invariant.scale) << name << " " << invariant.name;
    EXPECT_EQ(result.invariants.empty(), name.starts_with("K4")) << name;
    EXPECT_TRUE(result.theory.empty());
    EXPECT_GT(result.drift.tip_bound_m.value(), 0);
  }
}

/// A random scene: any law, latitude and matching rule, symmetric or not.
Scenario random_scene(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const auto one_of = [&](const auto&... choices) {
    const std::array all{choices...};
    return all[random() % all.size()];
  };
  using Law = ContactLaw;
  ContactSpec contact;
  contact.law = one_of(Law::frictionless, Law::viscous, Law::viscous_load, Law::coulomb, Law::contensou, Law::rolling);
  contact.tip_radius_m = one_of(0.0, 0.002, 0.01);
  contact.sliding_viscosity_N_s_m = between(0.01, 0.1), contact.sliding_viscosity_s_m = between(0.01, 0.3);
  contact.friction_coefficient = between(0.05, 0.3), contact.regularisation_m_s = 0.02;
  contact.patch_radius_m = 1e-4;
  contact.start =
      contact.law == Law::rolling ? ContactStart::rolling : one_of(ContactStart::tip_at_rest, ContactStart::rolling);
  ContactScene scene{0.1, 0.03, 3e-5, 4e-5, 9.80665, between(150, 250), between(5, 30), contact};
  scene.latitude_deg = between(-90, 90);
  scene.rates = one_of(RatesRelativeTo::laboratory, RatesRelativeTo::inertial);
  if (random() % 3 == 0) scene.I2_kg_m2 = 2.7e-5;
  Scenario s = scenario_of(scene);
  s.release.azimuth_deg = between(0, 360);
  s.duration_s = 1, s.output_step_s = 0.25;
  return s;
}

// The two formulations have no Coriolis term in common. Bounds hold for both, so the distance is within their sum.
TEST(ContactRun, LaboratoryAndInertialAxesAgreeWithinTheBounds) {
  std::mt19937_64 random(23);
  for (int i = 0; i < 10; ++i) {
    Scenario s = random_scene(random);
    const RunResult laboratory = run(s);
    s.numerics.observer = Observer::inertial;
    const RunResult inertial = run(s);
    EXPECT_EQ(inertial.certificate.observer, Observer::laboratory);
    ASSERT_EQ(laboratory.rows.size(), inertial.rows.size()) << i;
    for (std::size_t k = 1; k < laboratory.rows.size(); ++k) {
      const DriftRow &a = laboratory.rows[k], &b = inertial.rows[k];
      EXPECT_LE(std::abs(a.drift_axis_rad - b.drift_axis_rad), a.drift_axis_bound_rad + b.drift_axis_bound_rad) << i;
      EXPECT_LE(distance(a.contact->drift_tip_xy_m, b.contact->drift_tip_xy_m),
                a.contact->drift_tip_bound_m + b.contact->drift_tip_bound_m)
          << i;
      EXPECT_LT(a.drift_axis_bound_rad, testing::truncation(s.numerics.relative_tolerance, 20) * a.drift_axis_rad) << i;
      EXPECT_LT(a.contact->drift_tip_bound_m, std::max(1e-18, 1e-8 * a.contact->drift_tip_m)) << i;
    }
  }
}

// The true error, against 113 bits in the other formulation.
TEST(ContactRun, ErrorsAreWithinTheBoundsAgainstFloat128) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 3; ++i) {
    Scenario s = random_scene(random);
    s.duration_s = 0.04, s.output_step_s = 0.02;
    const RunResult result = run(s);
    IntegrationOptions options = s.numerics;
    options.method = Method::extrapolation, options.observer = Observer::inertial, options.relative_tolerance = 1e-22;
    const Scene scene(s);
    const DriftProblem<float128>& problem = scene.problem<float128>();
    const DriftTrajectory<float128> exact = integrate_drift(problem, options);
    ASSERT_EQ(exact.samples.size(), result.rows.size());
    const DriftTrajectory<float128> none;
    const ContactRows<float128> rows(problem, none.contact_events);
    for (std::size_t k = 1; k < result.rows.size(); ++k) {
      const DriftRow& row = result.rows[k];
      const auto tip = rows.row(exact.samples[k], float128(0)).drift_tip_xy_m;
      EXPECT_LE(std::abs(static_cast<double>(exact.samples[k].measures.axis - row.drift_axis_rad)), row.drift_axis_bound_rad)
          << i;
      EXPECT_LE(std::hypot(static_cast<double>(tip[0] - row.contact->drift_tip_xy_m[0]),
                           static_cast<double>(tip[1] - row.contact->drift_tip_xy_m[1])),
                row.contact->drift_tip_bound_m)
          << i;
    }
  }
}

TEST(ContactRun, WithoutEarthRotationThereIsNoDrift) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 6; ++i) {
    Scenario s = random_scene(random);
    s.rotation_rate_rad_s = 0;
    for (const DriftRow& row : run(s).rows) {
      EXPECT_EQ(row.drift_axis_rad, 0);
      EXPECT_EQ(row.contact->drift_tip_m, 0);
      EXPECT_EQ(row.contact->drift_slip_m_s, 0);
      EXPECT_EQ(row.contact->tip_m, row.contact->ref_tip_m);
    }
  }
}

// Both predictions stand on the tilted table; with inertial rates the rotating body turns at -W more in the laboratory.
TEST(ContactRun, ATiltedTableAndInertialRates) {
  Scenario s = scenario_of(testing::toy_on_table({.tip_radius_m = 0.002, .law = ContactLaw::rolling}));
  s.contact->start = ContactStart::rolling;
  s.contact->table_tilt_deg = 5, s.contact->table_tilt_azimuth_deg = 70;
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.duration_s = 0.5, s.output_step_s = 0.1;
  const RunResult laboratory = run(s);
  s.numerics.observer = Observer::inertial;
  const RunResult inertial = run(s);
  const DriftRow &first = laboratory.rows.front(), &other = inertial.rows.front();
  EXPECT_NEAR(first.w_LB_B[2] - first.ref_w_LB_B[2],
              first.contact->drift_spin_rate_rad_s - 7.292115e-5 * (std::sin(std::numbers::pi / 4) * first.axis_L[2] +
                                                                    std::cos(std::numbers::pi / 4) * first.axis_L[1]),
              1e-12);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(first.w_LB_B[i], other.w_LB_B[i]);
  const DriftRow &a = laboratory.rows.back(), &b = inertial.rows.back();
  EXPECT_LT(distance(a.contact->drift_tip_xy_m, b.contact->drift_tip_xy_m), testing::rounding(500) * a.contact->drift_tip_m);
  EXPECT_EQ(a.contact->state, ContactState::roll);
}

TEST(ContactRun, OtherMethodsGiveTheSameDrift) {
  Scenario s = scenario_of(testing::toy_on_table(
      {.tip_radius_m = 0.002, .law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4}));
  s.duration_s = 0.2, s.output_step_s = 0.1;
  const DriftRow series = run(s).rows.back();
  for (const Method method : {Method::extrapolation, Method::rkf78}) {
    s.numerics.method = method;
    const RunResult other = run(s);
    EXPECT_EQ(other.solution.method, method);
    const DriftRow& row = other.rows.back();
    EXPECT_LE(std::abs(row.drift_axis_rad - series.drift_axis_rad), row.drift_axis_bound_rad + series.drift_axis_bound_rad);
    EXPECT_LE(distance(row.contact->drift_tip_xy_m, series.contact->drift_tip_xy_m),
              row.contact->drift_tip_bound_m + series.contact->drift_tip_bound_m);
  }
  s.numerics.method = Method::dop853;
  EXPECT_THROW(run(s), ScenarioError);
}

}  // namespace
}  // namespace earthtop::contact_run
