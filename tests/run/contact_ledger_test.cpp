// SPDX-License-Identifier: GPL-3.0-or-later
/// The torque ledger of a top on a table: its sum is dL'/dt to round-off, for every observer, law and effect; dL'/dt is that of
/// the rows; and the table's force is that of the rows.
#include <gtest/gtest.h>

#include "earthtop/results/results.hpp"
#include "frames/random_cases.hpp"
#include "model/ledger_sizes.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"
#include "support/tolerances.hpp"

namespace earthtop::contact_ledger_run {
namespace {

Vec3<double> vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

ContactSpec spec_of(ContactLaw law) {
  ContactSpec contact{.tip_radius_m = 0.004, .law = law};
  contact.sliding_viscosity_N_s_m = 0.05, contact.sliding_viscosity_s_m = 0.1;
  contact.friction_coefficient = 0.2, contact.patch_radius_m = 1e-4;
  if (law == ContactLaw::rolling) contact.start = ContactStart::rolling;
  return contact;
}

/// A scene on an Earth that turns once in six seconds, so that each of its torques is seen.
Scenario lively_scene(ContactLaw law) {
  testing::ContactScene scene = testing::toy_on_table(spec_of(law));
  scene.spin_rad_s = 60, scene.transverse_rad_s = {1, -2}, scene.earth_rate_rad_s = 1;
  Scenario s = testing::scenario_of(scene);
  s.duration_s = 0.03, s.output_step_s = 0.01;
  return s;
}

/// The scene, and the same with a body without symmetry, on a slope, with the gradient of gravity and a tide, without a force.
std::vector<Scenario> varieties(ContactLaw law) {
  std::vector<Scenario> all(5, lively_scene(law));
  testing::set_principal(all[1].body, 3e-5, 2.5e-5, 4e-5);
  all[1].body.center_of_mass_m = {0.001, -0.002, 0.03};
  all[2].contact->table_tilt_deg = 10, all[2].contact->table_tilt_azimuth_deg = 200;
  all[3].effects.applied.gravity_gradient.emplace().gm_over_r3_s2 = 0.5;
  all[3].effects.tide.emplace().given = true;
  all[3].effects.tide->amplitude_m_s2 = {0.5, 0.25, -0.125}, all[3].effects.tide->frequency_hz = 3;
  all[4].effects.coriolis = false;
  all[4].contact->spinning_friction_m = 1e-4, all[4].contact->rolling_resistance_m = 1e-4;
  all[4].contact->regularisation_rad_s = 1;
  return all;
}

constexpr ContactLaw kLaws[] = {ContactLaw::frictionless, ContactLaw::viscous,   ContactLaw::viscous_load,
                                ContactLaw::coulomb,      ContactLaw::contensou, ContactLaw::rolling};

// The terms of the angular acceleration are as large as I w^2, here 15 times the largest torque; they are added up in some 100
// roundings, and the terms of Cramer's rule lose a digit more. A wrong term would be 1e8 times as large.
TEST(ContactLedger, ClosesToRoundOffForEveryObserver) {
  std::size_t turn = 0;
  for (const ContactLaw law : kLaws)
    for (Scenario s : varieties(law)) {
      const bool exact = law == ContactLaw::coulomb && s.body.center_of_mass_m[0] != 0;
      if (exact) s.contact->regularisation_m_s = 0.02;  // the exact law is for symmetric bodies
      const std::size_t first = turn++ % 2;             // two of the four observers, in turn
      for (const LedgerObserver observer : {test::kLedgerObservers[first], test::kLedgerObservers[first + 2]}) {
        s.ledger = observer;
        const RunResult result = run(s);
        ASSERT_EQ(result.status, RunStatus::completed) << static_cast<int>(law);
        ASSERT_TRUE(result.ledger);
        ASSERT_EQ(result.ledger->entries.size(), result.rows.size());
        EXPECT_LT(result.ledger->largest.relative_residual(), 1e-12);
        // An observer who turns with the laboratory sees a Coriolis torque; one at rest, and one in whose axes nothing moves, none.
        const bool in_laboratory = observer == LedgerObserver::laboratory || observer == LedgerObserver::platform;
        EXPECT_EQ(result.ledger->largest.tau_cor > 1e-4, in_laboratory && s.effects.coriolis);
        for (std::size_t i = 0; i < result.rows.size(); ++i) {
          const LedgerRow<double>& row = result.ledger->entries[i];
          if (in_laboratory && s.contact->table_tilt_deg == 0) {
            EXPECT_NEAR(row.force_table_A[2] / result.rows[i].contact->normal_force_N, 1, 1e-12);
          }
          const double friction = norm(vector(row.share_A[2]));
          EXPECT_EQ(friction == 0, law == ContactLaw::frictionless && s.contact->spinning_friction_m == 0);
        }
      }
    }
}

// Rows on both sides of the stop of the slip: without it, the exact law's force is that of rolling.
TEST(ContactLedger, ClosesAcrossTheStopOfTheSlip) {
  Scenario s = testing::scenario_of(
      testing::toy_on_table({.tip_radius_m = 0.002, .law = ContactLaw::coulomb, .friction_coefficient = 0.2}));
  s.duration_s = 0.06, s.output_step_s = 0.01, s.ledger = LedgerObserver::laboratory;
  const RunResult result = run(s);
  ASSERT_EQ(result.rows.size(), 7U);
  EXPECT_EQ(result.rows[4].contact->state, ContactState::slide);
  EXPECT_EQ(result.rows[5].contact->state, ContactState::roll);
  EXPECT_LT(result.ledger->largest.relative_residual(), 1e-12);
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    EXPECT_NEAR(result.ledger->entries[i].force_table_A[2] / result.rows[i].contact->normal_force_N, 1, 1e-12);
}

// L' = Theta_O w of rows h apart, differenced: the error of the difference, (W h)^2/6 of the quickest part with W = 60 rad/s, and
// the rows' own, 1e-13/h. The torque of the Earth's force alone is 1e-3 of the largest.
TEST(ContactLedger, MomentumRateIsThatOfTheRows) {
  constexpr double h = 1e-5, kTolerance = 2e-6;
  for (const ContactLaw law : {ContactLaw::coulomb, ContactLaw::contensou, ContactLaw::rolling})
    for (Scenario s : varieties(law)) {
      if (law == ContactLaw::coulomb) s.contact->regularisation_m_s = 0.02;
      s.duration_s = 4 * h, s.output_step_s = h;
      for (const LedgerObserver observer : {LedgerObserver::laboratory, LedgerObserver::inertial}) {
        s.ledger = observer;
        const Scene scene(s);
        const RunResult result = run(s);
        ASSERT_EQ(result.rows.size(), 5U);
        const Body<double>& body = scene.body<double>();
        const Vec3<double> W_L = s.rotation_rate_rad_s * celestial_axis_L<double>(s.site);
        const auto momentum = [&](const DriftRow& row) {
          const Mat3<double> R_LB =
              rotation_matrix(Quaternion<double>{row.q_LB[0], Vec3<double>(row.q_LB[1], row.q_LB[2], row.q_LB[3])});
          Vec3<double> w_B = vector(row.w_LB_B);
          if (observer == LedgerObserver::laboratory) return Vec3<double>(R_LB * (body.I_BP_B * w_B));
          w_B += R_LB.transpose() * W_L;
          return Vec3<double>(test::rodrigues<double>(W_L / norm(W_L), norm(W_L) * row.t_s) * (R_LB * (body.I_BP_B * w_B)));
        };
        const Vec3<double> coarse = (momentum(result.rows[4]) - momentum(result.rows[0])) / (4 * h);
        const Vec3<double> fine = (momentum(result.rows[3]) - momentum(result.rows[1])) / (2 * h);
        const Vec3<double> rate = (4 * fine - coarse) / 3;
        const LedgerRow<double>& row = result.ledger->entries[2];
        EXPECT_LT(norm(Vec3<double>(rate - vector(row.dL_dt_A))), kTolerance * result.ledger->largest.tau_phys);
      }
    }
}

TEST(ContactLedger, ColumnsOfTheTable) {
  Scenario s = lively_scene(ContactLaw::contensou);
  s.ledger = LedgerObserver::laboratory, s.precision = Precision::bits113, s.duration_s = 0.01;
  const RunResult result = run(s);
  ASSERT_TRUE(result.ledger);
  EXPECT_LT(result.ledger->largest.relative_residual(), testing::rounding<float128>(100));
  const std::string text = torques_csv(result), header = text.substr(0, text.find('\n'));
  EXPECT_TRUE(header.ends_with(
      ",tau_friction_x_N_m,tau_friction_y_N_m,tau_friction_z_N_m,force_table_x_N,force_table_y_N,force_table_z_N"))
      << header;
  s.precision = Precision::bits53, s.contact = spec_of(ContactLaw::frictionless);
  const std::string frictionless = torques_csv(run(s));
  EXPECT_EQ(frictionless.find("tau_friction"), std::string::npos);
  EXPECT_NE(frictionless.find("force_table_z_N"), std::string::npos);
}

}  // namespace
}  // namespace earthtop::contact_ledger_run
