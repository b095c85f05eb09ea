// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of bodies with a rotor: a rotor in a symmetric cage against the equations of a gyrostat, special gyrostats against rigid bodies
/// and closed forms, bounds against truth, what is conserved, and what is refused.
#include <gtest/gtest.h>

#include <numbers>

#include "earthtop/run.hpp"
#include "earthtop/scenario/support.hpp"
#include "support/json.hpp"
#include "support/rotor_bounds.hpp"

namespace earthtop {
namespace {

using testing::any_gyrostat;
using testing::by_general_model;
using testing::caged_gyroscope;

template <std::size_t N>
double components_apart(const std::array<double, N>& a, const std::array<double, N>& b, double sign = 1) {
  double most = 0;
  for (std::size_t i = 0; i < N; ++i) most = std::max(most, std::abs(a[i] - sign * b[i]));
  return most;
}
double quaternions_apart(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return std::min(components_apart(a, b), components_apart(a, b, -1));
}

/// Every kind of drive, and the bearing's viscous friction.
std::vector<Scenario> caged_scenes() {
  std::vector<Scenario> scenes(5, caged_gyroscope());
  scenes[1].rotor->viscous_torque_N_m_s = 2e-6;
  scenes[2].rotor->drive = RotorDrive::constant;
  scenes[3].rotor->drive = RotorDrive::ramp, scenes[3].rotor->acceleration_rad_s2 = 40;
  scenes[4].rotor->drive = RotorDrive::harmonic;
  scenes[4].rotor->amplitude_rad_s = 20, scenes[4].rotor->frequency_hz = 0.7, scenes[4].rotor->phase_deg = 50;
  scenes[1].release.rates_relative_to = scenes[4].release.rates_relative_to = RatesRelativeTo::inertial;
  for (Scenario& s : scenes) s.release.spin_rad_s = 5, s.rotation_rate_rad_s = 0.01;
  return scenes;
}

TEST(CagedTop, MovesAsTheEquationsOfAGyrostatSay) {
  for (const Scenario& scenario : caged_scenes()) {
    ASSERT_TRUE(is_caged_top(scenario));
    const RunResult caged = run(scenario), whole = run(by_general_model(scenario));
    ASSERT_EQ(support_of(whole.scene.scenario()).kind, SupportKind::rotor);
    ASSERT_EQ(caged.rows.size(), whole.rows.size());
    for (std::size_t i = 0; i < caged.rows.size(); ++i) {
      const DriftRow &a = caged.rows[i], &b = whole.rows[i];
      // Tolerances of 1e-12 a step: over some hundred steps an attitude is good to 1e-11, a rate of 40 rad/s to 1e-9, an angle of 600 rad to
      // 1e-9. The Earth moves the axis by 1e-2 rad here.
      EXPECT_LT(quaternions_apart(a.q_LB, b.q_LB), 1e-11);            // of attitudes, see above
      EXPECT_LT(quaternions_apart(a.ref_q_LB, b.ref_q_LB), 1e-11);    // of attitudes, see above
      EXPECT_LT(components_apart(a.w_LB_B, b.w_LB_B), 1e-9);          // of rates and angles, see above
      EXPECT_LT(components_apart(a.ref_w_LB_B, b.ref_w_LB_B), 1e-9);  // of rates and angles, see above
      EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad);
      EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad);
      EXPECT_NEAR(a.drift_spin_rad, b.drift_spin_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad);
      EXPECT_NEAR(a.rotor->rate_rad_s, b.rotor->rate_rad_s, 1e-9);           // of rates and angles, see above
      EXPECT_NEAR(a.rotor->ref_angle_rad, b.rotor->ref_angle_rad, 1e-9);     // of rates and angles, see above
      EXPECT_LT(components_apart(a.rotor->axis_L, b.rotor->axis_L), 1e-11);  // of attitudes, see above
      EXPECT_NEAR(a.rotor->drift_axis_rad, b.rotor->drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad);
      EXPECT_NEAR(b.rotor->drift_angle_rad, 0, 1e-12);  // rounding of an angle of 600 rad that is 0 in theory
    }
  }
}

TEST(CagedTop, IsNotTakenWhereSomethingBrakesTheCage) {
  Scenario s = caged_gyroscope();
  s.effects.applied.viscous_N_m_s = 1e-6;
  EXPECT_FALSE(is_caged_top(s));
  s = caged_gyroscope();
  s.rotor->axis = {0, 1e-9, 1};
  EXPECT_FALSE(is_caged_top(s));
  s = caged_gyroscope();
  s.body.center_of_mass_m[0] = 1e-9;
  EXPECT_FALSE(is_caged_top(s));
  s = caged_gyroscope();
  s.rotor->coulomb_torque_N_m = 1e-6, s.rotor->regularisation_rad_s = 1;
  EXPECT_FALSE(is_caged_top(s));
}

/// A rotor that a motor holds still is a part of a rigid body.
TEST(Gyrostat, WithAHeldRotorIsARigidBody) {
  Scenario with = caged_gyroscope(), rigid = with;
  with.rotor->drive = RotorDrive::constant, with.rotor->spin_rad_s = 0;
  with = by_general_model(with);
  with.rotation_rate_rad_s = rigid.rotation_rate_rad_s = 0.01;
  with.release.angular_velocity_body_rad_s = rigid.release.angular_velocity_body_rad_s = std::array{1.0, -2.0, 30.0};
  const Scene scene(with);
  const Body<double>& body = scene.body<double>();
  rigid.rotor.reset();
  rigid.body.mass_kg = body.mass, rigid.body.center_of_mass_m = {0, 0, body.p_PBcm_B[2]};
  rigid.body.inertia_about = InertiaAbout::pivot;
  testing::set_principal(rigid.body, body.I_BP_B(0, 0), body.I_BP_B(1, 1), body.I_BP_B(2, 2));
  const DriftRow a = run(with).rows.back(), b = run(by_general_model(rigid)).rows.back();
  EXPECT_LT(quaternions_apart(a.q_LB, b.q_LB), 1e-11);                                   // of attitudes, see above
  EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, 1e-9 * b.drift_axis_rad);              // two integrations at 1e-12 a step
  EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, 1e-9 * b.drift_attitude_rad);  // two integrations at 1e-12 a step
}

/// A balanced gyrostat with the same inertial rates stays as it is in inertial space: seen from the floor its attitude turns by Omega t,
/// whatever bearing or motor do.
TEST(Gyrostat, WithoutTorqueTurnsWithTheStars) {
  std::mt19937_64 random(50);
  for (int i = 0; i < 8; ++i) {
    Scenario s = any_gyrostat(random);
    s.site.gravity_m_s2 = 0;
    s.platform.reset();
    s.effects.applied.viscous_N_m_s = 0;
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    s.rotation_rate_rad_s = 0.5;
    const RunResult result = run(s);
    for (const DriftRow& row : result.rows)
      EXPECT_NEAR(row.drift_attitude_rad, 0.5 * row.t_s, 1e-12 + row.drift_attitude_bound_rad);  // rounding of 0.5 t
    EXPECT_LT(result.rows.back().drift_attitude_bound_rad, 1e-11);  // so that the line above can fail
  }
}

/// At the smallest rates the drift is in proportion to the rate.
TEST(Gyrostat, DriftsInProportionToTheEarthsRate) {
  std::mt19937_64 random(51);
  for (int i = 0; i < 4; ++i) {
    Scenario s = any_gyrostat(random);
    s.rotation_rate_rad_s = 1e-11;
    const DriftRow slow = run(s).rows.back();
    s.rotation_rate_rad_s = 1e-300;
    const DriftRow least = run(s).rows.back();
    EXPECT_NEAR(least.drift_axis_rad / 1e-300, slow.drift_axis_rad / 1e-11,
                1e-7 * slow.drift_axis_rad / 1e-11);  // the second order in 1e-11 rad/s, and bounds of 1e-12 of the drift
    EXPECT_NEAR(least.rotor->drift_axis_rad / 1e-300, slow.rotor->drift_axis_rad / 1e-11,
                1e-7 * slow.rotor->drift_axis_rad / 1e-11);  // the same
  }
}

TEST(Gyrostat, KeepsWhatItConserves) {
  Scenario s = caged_gyroscope();
  s.rotor->axis = {0.1, 0.05, 1};
  s.rotation_rate_rad_s = 0.1;
  const auto names = [](const RunResult& result) {
    std::vector<std::string> all;
    for (const InvariantReport& report : result.invariants) {
      all.emplace_back(report.name);
      EXPECT_LT(report.largest_change, 1e-12 * report.scale) << report.name;  // some hundred steps at 1e-14
    }
    return all;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(run(s)), (Names{"jacobi_integral", "reference_energy", "rotor_momentum"}));
  s.rotor->drive = RotorDrive::constant;
  EXPECT_EQ(names(run(s)), (Names{"jacobi_integral", "reference_energy"}));
  s.rotor->drive = RotorDrive::ramp, s.rotor->acceleration_rad_s2 = 10;
  EXPECT_EQ(names(run(s)), Names{});
  s.rotor->drive = RotorDrive::none, s.rotor->viscous_torque_N_m_s = 1e-6;
  EXPECT_EQ(names(run(s)), Names{});
  s = caged_gyroscope();
  EXPECT_EQ(names(run(s)), (Names{"jacobi_integral", "reference_energy", "rotor_momentum"}));
}

/// The rows in double against 113 bits in the equations of another observer.
TEST(Gyrostat, ErrorsAreWithinTheirBounds) { testing::expect_bounds_of_gyrostats(52, 2); }

/// A balanced body with a rotor on one of its axes, free or at a constant rate, whose motion has a closed form.
std::vector<Scenario> free_gyrostats() {
  std::vector<Scenario> all;
  for (int i = 0; i < 8; ++i) {
    Scenario s = caged_gyroscope();
    s.site.gravity_m_s2 = 0;
    s.body.center_of_mass_m = s.rotor->center_m = {0, 0, 0};
    s.body.mass_kg = 0.2, s.rotor->mass_kg = 0.1;
    testing::set_principal(s.body, 2e-4, 3e-4, 2.5e-4);
    s.rotor->axial_kg_m2 = 4e-5, s.rotor->transverse_kg_m2 = 2.5e-5, s.rotor->spin_rad_s = i < 4 ? 8 : -3;
    s.rotor->axis = {0, 0, 0};
    s.rotor->axis[static_cast<std::size_t>(i % 3)] = i % 2 == 0 ? 2 : -1;
    if (i >= 4) s.rotor->drive = RotorDrive::constant;
    s.release.angular_velocity_body_rad_s = {1, 0.5, 2};
    if (i % 4 < 2) s.release.rates_relative_to = RatesRelativeTo::inertial;
    s.rotation_rate_rad_s = i % 2 == 0 ? 7.292115e-5 : 0.05;
    s.duration_s = 2, s.output_step_s = 0.5;
    all.push_back(s);
  }
  return all;
}

/// Two derivations of one motion: formulas, and the equations of motion in double and, of every third scene, in 113 bits.
TEST(Gyrostat, ClosedFormAgreesWithTheIntegration) {
  int scene = 0;
  for (Scenario s : free_gyrostats()) {
    s.numerics.method = Method::taylor;
    const RunResult integrated = run(s);
    s.numerics.method = Method::closed_form;
    const RunResult exact = run(s);
    ASSERT_EQ(exact.rows.size(), integrated.rows.size());
    for (std::size_t i = 0; i < exact.rows.size(); ++i) {
      const DriftRow &a = exact.rows[i], &b = integrated.rows[i];
      const double attitude = exact.attitude_bound_rad + integrated.attitude_bound_rad;
      EXPECT_LE(quaternions_apart(a.q_LB, b.q_LB), attitude);
      EXPECT_LE(quaternions_apart(a.ref_q_LB, b.ref_q_LB), attitude);
      EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad);
      EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad);
      EXPECT_LE(components_apart(a.rotor->axis_L, b.rotor->axis_L), attitude);
      EXPECT_LE(components_apart(a.rotor->ref_axis_L, b.rotor->ref_axis_L), attitude);
      EXPECT_NEAR(a.rotor->drift_axis_rad, b.rotor->drift_axis_rad,
                  a.rotor->drift_axis_bound_rad + b.rotor->drift_axis_bound_rad);
      EXPECT_NEAR(a.rotor->rate_rad_s, b.rotor->rate_rad_s, 1e-11);          // of rates and angles, of 8 and 40
      EXPECT_NEAR(a.rotor->ref_rate_rad_s, b.rotor->ref_rate_rad_s, 1e-11);  // of rates and angles, see above
      EXPECT_NEAR(a.rotor->angle_rad, b.rotor->angle_rad, 1e-11);            // of rates and angles, see above
      EXPECT_NEAR(a.rotor->ref_angle_rad, b.rotor->ref_angle_rad, 1e-11);    // of rates and angles, see above
      // In double to 1e-12 of the Earth's rate, and of the angle by which it turns.
      EXPECT_NEAR(a.rotor->drift_rate_rad_s, b.rotor->drift_rate_rad_s, 1e-11 * s.rotation_rate_rad_s);
      EXPECT_NEAR(a.rotor->drift_angle_rad, b.rotor->drift_angle_rad, 1e-11 * s.rotation_rate_rad_s);  // see above
    }
    EXPECT_LT(exact.attitude_bound_rad,
              1e-12);  // of the rounding of the given numbers, which the bound follows through the motion
    if (scene++ % 3 != 0) continue;
    const auto truth = testing::reference_run(s, Observer::inertial, 1e-18);
    EXPECT_GE(testing::compare(exact, truth).least_margin, 1);
    for (std::size_t i = 0; i < exact.rows.size(); ++i) {
      const RotorState<float128>& rotor = *truth.samples[i].rotor;
      const double difference = static_cast<double>(truth.samples[i].state.epsilon * rotor.angle_difference_scaled);
      EXPECT_NEAR(exact.rows[i].rotor->angle_rad, static_cast<double>(rotor.angle), 20 * 1e-15);     // some roundings of 16 rad
      EXPECT_NEAR(exact.rows[i].rotor->drift_angle_rad, difference, 1e-13 * s.rotation_rate_rad_s);  // some of the Earth's turn
    }
  }
}

TEST(Gyrostat, ClosedFormIsTakenWhereOneMotionIsTheOtherTurned) {
  for (const Scenario& s : free_gyrostats()) {
    const bool one = s.release.rates_relative_to == RatesRelativeTo::inertial;
    EXPECT_EQ(Scene(s).choice().options.method, one ? Method::closed_form : Method::taylor);
  }
}

TEST(Gyrostat, ClosedFormIsRefusedWithItsReason) {
  const auto reason = [](const auto& change) {
    Scenario s = free_gyrostats().front();
    change(s);
    return Scene(s).method_refusal(Method::closed_form).value_or("");
  };
  EXPECT_EQ(reason([](Scenario&) {}), "");
  EXPECT_EQ(reason([](Scenario& s) { s.site.gravity_m_s2 = 9.8; }), "");  // the centre of mass is at the pivot
  EXPECT_EQ(
      reason([](Scenario& s) {
        s.site.gravity_m_s2 = 9.8, s.rotor->center_m = {0, 0, 0.01};
      }),
      "under the torque of gravity a body with a rotor has no closed form; take \"auto\", or put the centre of mass of both at "
      "the pivot, or gravity to 0");
  EXPECT_EQ(reason([](Scenario& s) { s.rotor->viscous_torque_N_m_s = 1e-6; }),
            "friction in the rotor's bearing leaves no closed form; take \"auto\", or leave the friction out");
  EXPECT_EQ(
      reason([](Scenario& s) { s.rotor->drive = RotorDrive::ramp, s.rotor->acceleration_rad_s2 = 1; }),
      "a motor that changes the rotor's rate leaves no closed form; take \"auto\", or the drive \"constant\" or \"none\"");
  EXPECT_EQ(reason([](Scenario& s) {
              s.rotor->axis = {1e-9, 0, 1};
            }),
            "a body with a rotor has a closed form here only if the rotor turns about body axis 1, 2 or 3 and this axis has no "
            "products of inertia (in any other direction the rates need the roots of a general quartic); take \"auto\"");
  EXPECT_EQ(reason([](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-6; }),
            "\"closed_form\" works only with gravity and the Earth's rotation; take \"auto\", or leave the other effects out");
}

TEST(Gyrostat, TellsOfItsFigures) {
  const Scene caged(caged_gyroscope()), whole(by_general_model(caged_gyroscope()));
  EXPECT_EQ(caged.top().spin_rad_s, 0);
  EXPECT_NEAR(*caged.top().rotor_momentum_kg_m2_s, 1.6e-5 * 300, 1e-18);  // a rounding of the product
  EXPECT_EQ(caged.top().notes.back(), "the axis moves as that of a rigid top with these moments and a spin of 171.429 rad/s");
  EXPECT_EQ(whole.top().notes.back(), "the moments are those of body and rotor without the rotor's axial moment");
  EXPECT_FALSE(whole.top().slow_precession_rad_s);
  EXPECT_EQ(whole.choice().reason, "Taylor series of the equations of the observer asked for");
}

/// I1 cos(tilt) V^2 - (I3 w3 + h) V + m g l = 0 with the momentum of cage and rotor.
TEST(CagedTop, PrecessesSteadily) {
  Scenario s = caged_gyroscope();
  s.rotation_rate_rad_s = 0;
  s.release.precession = Precession::steady_slow;
  for (const DriftRow& row : run(by_general_model(s)).rows)
    EXPECT_NEAR(row.ref_axis_L[2], std::cos(30 * std::numbers::pi / 180), 1e-12);  // a hundred steps at 1e-14
}

TEST(Gyrostat, BadInputIsRefused) {
  const char* kRotor = R"("mass_kg": 0.045, "axial_kg_m2": 1.6e-5, "transverse_kg_m2": 8.5e-6)";
  const auto refusal = [&](const std::string& rotor, const std::string& more = "") {
    const std::string text = R"({"name": "g", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
      "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": {"principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
      "release": {"tilt_deg": 20}, "motion": {"duration_s": 1}, "rotor": {)" +
                             rotor + "}" + more + "}";
    const ScenarioReport report = examine_scenario({"g.json", text});
    EXPECT_EQ(report.errors.size(), 1u) << text;
    return report.errors.empty() ? "" : report.errors.front().pointer + ": " + report.errors.front().message;
  };
  const auto says = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  const std::string whole = std::string(kRotor) + R"(, "spin_rad_s": 300)";
  says(refusal(kRotor), "spin_rad_s: is missing");
  says(refusal(whole + R"(, "spin_rpm": 3000)"), "give exactly one");
  says(refusal(R"("axial_kg_m2": 1.6e-5, "transverse_kg_m2": 8.5e-6, "spin_rad_s": 1)"), "mass_kg: is missing");
  says(refusal(R"("mass_kg": 0, "axial_kg_m2": 1.6e-5, "transverse_kg_m2": 8.5e-6, "spin_rad_s": 1)"), "/rotor/mass_kg");
  says(refusal(R"("mass_kg": 1, "axial_kg_m2": 0, "transverse_kg_m2": 8.5e-6, "spin_rad_s": 1)"), "/rotor/axial_kg_m2");
  says(refusal(R"("mass_kg": 1, "axial_kg_m2": 2e-5, "transverse_kg_m2": 9e-6, "spin_rad_s": 1)"),
       "no body is flatter than a disc");
  says(refusal(whole + R"(, "axis": [0, 0, 0])"), "is the zero vector");
  says(refusal(whole + R"(, "drive": "motor")"), "/rotor/drive");
  says(refusal(whole + R"(, "drive": "ramp")"), "acceleration_rad_s2: is missing");
  says(refusal(whole + R"(, "drive": "constant", "acceleration_rad_s2": 1)"), "allowed with it: spin_rad_s, spin_rpm");
  says(refusal(whole + R"(, "drive": "constant", "viscous_torque_N_m_s": 1e-6)"), "does not belong to the drive");
  says(refusal(whole + R"(, "drive": "harmonic", "amplitude_rad_s": 1)"), "frequency_hz: is missing");
  says(refusal(whole + R"(, "coulomb_torque_N_m": 1e-6)"),
       "is missing; coulomb_torque_N_m needs the rate below which the torque is proportional to it: give one above 0");
  says(refusal(whole + R"(, "regularisation_rad_s": 1)"), "belongs to coulomb_torque_N_m, which is not given; leave it out");
  says(refusal(whole + R"(, "viscous_torque_N_m_s": -1)"), "/rotor/viscous_torque_N_m_s");
  says(refusal(whole + R"(, "cage": 1)"), "the cage of a rotor is /body");
  says(refusal(whole, R"(, "effects": {"gimbal": true})"), "it holds a rigid wheel");
  says(refusal(whole, R"(, "effects": {"air_drag": {"disc_radius_m": 0.01}})"),
       "it is the drag of a disc that spins about body axis 3 itself");
  says(refusal(whole + R"(, "axis": [0, 1, 1])", R"(, "effects": {"coriolis": false})"),
       "is not available with /rotor: the torques of a rotor's own motion belong to all three; leave one of the two out");
  says(refusal(whole + R"(, "axis": [0, 1, 1])", R"(, "effects": {"coulomb_torque_N_m": 1e-6})"),
       "dry friction at the pivot of a gyrostat is not modelled");
  says(refusal(std::string(kRotor) + R"(, "drive": "table")"), "file: is missing");
  says(refusal(std::string(kRotor) + R"(, "drive": "table", "file": "none.csv")"), "there is no such file");
  says(refusal(whole + R"(, "axis": [0, 1, 1])", R"(, "numerics": {"method": "dop853"})"),
       "is not built for a body with a rotor");
  Scenario steady = caged_gyroscope();
  steady.rotor->axis = {0, 1, 1}, steady.release.precession = Precession::steady_slow;
  const ScenarioReport report = examine_scenario({"g.json", canonical_json(steady)});
  ASSERT_EQ(report.errors.size(), 1u);
  says(report.errors.front().message, "with a rotor only one on axis 3 of a symmetric cage has it");
  says(refusal(whole, R"(, "contact": {"tip_radius_m": 0.001, "law": "frictionless"})"),
       "a gyrostat on a table is not modelled");
}

}  // namespace
}  // namespace earthtop
