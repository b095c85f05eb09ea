// SPDX-License-Identifier: GPL-3.0-or-later
/// A rotor in the body beside other effects: platforms, the gravity gradient, tables of rates, thin cages, thresholds and the ledger.
#include <gtest/gtest.h>

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/run.hpp"
#include "earthtop/run_batch.hpp"
#include "earthtop/scenario/support.hpp"
#include "support/rotor_bounds.hpp"

namespace earthtop {
namespace {

using testing::any_gyrostat;
using testing::by_general_model;
using testing::caged_gyroscope;

Scenario with_tilted_rotor() {
  Scenario s = caged_gyroscope();
  s.rotor->axis = {0.3, -0.2, 1};
  s.rotation_rate_rad_s = 0.01;
  return s;
}
/// A platform that turns and rocks the pivot about, and a strong gradient of gravity.
void put_on_platform(Scenario& s) {
  PlatformSpec& platform = s.platform.emplace();
  platform.motion = PlatformMotion::harmonic;
  platform.axis = {0.2, 0.3, 1};
  platform.amplitude_rad = 0.3, platform.frequency_hz = 0.8;
  platform.pivot_offset_m = {0.1, 0.2, -0.1};
  s.effects.applied.gravity_gradient = {GradientField::given, 0.5};
}
double vectors_apart(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return real::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A cubic spline through points of a ramp is the ramp, by the equations of a gyrostat and for a caged top.
TEST(RotorTable, OfARampIsTheRamp) {
  for (Scenario ramp : {caged_gyroscope(), with_tilted_rotor()}) {
    ramp.rotation_rate_rad_s = 0.01;
    ramp.rotor->drive = RotorDrive::ramp, ramp.rotor->acceleration_rad_s2 = 40;
    Scenario table = ramp;
    table.rotor->drive = RotorDrive::table;
    table.rotor->table.rows =
        std::make_shared<const AngleTable>(AngleTable{{-1, 0.3, 1.1, 1.7, 2.5}, {260, 312, 344, 368, 400}});
    const RunResult a = run(ramp), b = run(table);
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
      const DriftRow &x = a.rows[i], &y = b.rows[i];
      EXPECT_LT(vectors_apart(x.axis_L, y.axis_L), 1e-11);           // two integrations at 1e-12 a step
      EXPECT_NEAR(x.rotor->rate_rad_s, y.rotor->rate_rad_s, 1e-11);  // rounding of 400 rad/s in a spline
      EXPECT_NEAR(x.rotor->angle_rad, y.rotor->angle_rad, 1e-9);     // the same of an angle of 700 rad
      EXPECT_NEAR(x.rotor->drift_axis_rad, y.rotor->drift_axis_rad,
                  x.rotor->drift_axis_bound_rad + y.rotor->drift_axis_bound_rad);
    }
    EXPECT_NEAR(b.rows.back().rotor->rate_rad_s, 380, 1e-11);  // rounding, as above
  }
}

/// Beside a platform and a gradient a held rotor is a part of a rigid body, and a caged top moves as its rigid top: the gradient takes hold
/// of a free rotor's axial moment, too.
TEST(Gyrostat, OnAPlatformMovesAsRigidBodiesDo) {
  Scenario held = caged_gyroscope(), rigid = held;
  held.rotor->drive = RotorDrive::constant, held.rotor->spin_rad_s = 0;
  const Scene whole_scene(by_general_model(held));
  const Body<double>& whole = whole_scene.body<double>();
  rigid.rotor.reset();
  rigid.body.mass_kg = whole.mass, rigid.body.center_of_mass_m = {0, 0, whole.p_PBcm_B[2]};
  rigid.body.inertia_about = InertiaAbout::pivot;
  testing::set_principal(rigid.body, whole.I_BP_B(0, 0), whole.I_BP_B(1, 1), whole.I_BP_B(2, 2));
  for (auto [a, b] : {std::pair{held, rigid}, std::pair{by_general_model(caged_gyroscope()), caged_gyroscope()}}) {
    for (Scenario* s : {&a, &b}) put_on_platform(*s), s->rotation_rate_rad_s = 0.01, s->release.spin_rad_s = 30;
    const RunResult first = run(by_general_model(a)), second = run(b);
    EXPECT_EQ(support_of(first.scene.scenario()).kind, SupportKind::rotor);
    EXPECT_EQ(support_of(second.scene.scenario()).kind, SupportKind::platform);
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
      const DriftRow &x = first.rows[i], &y = second.rows[i];
      EXPECT_LT(vectors_apart(x.ref_axis_L, y.ref_axis_L), 1e-10);  // two integrations of some 1,000 steps at 1e-12
      EXPECT_NEAR(x.drift_axis_rad, y.drift_axis_rad, x.drift_axis_bound_rad + y.drift_axis_bound_rad);
    }
    EXPECT_GT(second.rows.back().drift_axis_rad, 1e-3);  // so that the line above can fail
  }
}

TEST(Gyrostat, ObserversAgreeOverDrivesBearingsAndPlatforms) { testing::expect_observers_agree(60, 12); }

/// The largest drifts of a long run are those of the rigid top, whose nutation is known beforehand; that of the gyrostat is far slower than
/// the fastest rate that its moments allow.
TEST(CagedTop, HasTheLargestDriftsOfTheGyrostat) {
  Scenario s = caged_gyroscope();
  s.rotor->viscous_torque_N_m_s = 1e-8;
  s.duration_s = 60;
  s.output_step_s = 1;
  const DriftSummary caged = run(s).drift, whole = run(by_general_model(s)).drift;
  EXPECT_NEAR(caged.axis_max_rad, whole.axis_max_rad, caged.axis_max_bound_rad + whole.axis_max_bound_rad);
  EXPECT_NEAR(caged.tilt_max_rad, whole.tilt_max_rad, caged.tilt_max_bound_rad + whole.tilt_max_bound_rad);
  EXPECT_NEAR(*caged.rotor_axis_max_rad, *whole.rotor_axis_max_rad,
              *caged.rotor_axis_max_bound_rad + *whole.rotor_axis_max_bound_rad);
}

/// Differences of whole runs of a gyrostat and the tangents of its rigid top give the same derivatives, by the rotor's numbers, too.
TEST(CagedTop, HasTheSensitivitiesOfTheGyrostat) {
  Scenario s = caged_gyroscope();
  s.rotation_rate_rad_s = 1e-3;
  s.release.spin_rad_s = 3;
  s.sensitivities = true;
  s.output_step_s = s.duration_s = 1;
  const RunResult caged = run(s), whole = run(by_general_model(s));
  const std::vector<InputSensitivity>&a = caged.sensitivities->inputs, &b = whole.sensitivities->inputs;
  ASSERT_EQ(a.size(), 10u);  // the seven common ones, and rate and moments of the rotor
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].unavailable + b[i].unavailable, "") << a[i].name;
    EXPECT_NEAR(a[i].axis_rad, b[i].axis_rad, a[i].axis_bound_rad + b[i].axis_bound_rad) << a[i].name;
    EXPECT_LT(b[i].axis_bound_rad, 1e-3 * std::abs(b[i].axis_rad)) << a[i].name;  // so that the line above can fail
  }
}

/// A rod has no moment about its own axis; with a rotor across it, or a driven one, the two may turn.
TEST(ThinCage, MayHaveNoMomentAboutAnAxis) {
  const auto examined = [](const std::string& rotor) {
    return examine_scenario({"g.json", R"({"name": "g", "site": {"latitude_deg": 45},
      "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": {"principal_kg_m2": [1.2e-4, 1.2e-4, 0]}},
      "release": {"tilt_deg": 20}, "motion": {"duration_s": 1},
      "rotor": {"mass_kg": 0.045, "axial_kg_m2": 1.6e-5, "transverse_kg_m2": 8.5e-6, "spin_rad_s": 300, )" +
                                           rotor + "}}"});
  };
  EXPECT_TRUE(examined(R"("axis": [0.1, 0, 1])").errors.empty());
  EXPECT_TRUE(examined(R"("drive": "constant")").errors.empty());
  const ScenarioReport free = examined(R"("axis": [0, 0, 1])");
  ASSERT_EQ(free.errors.size(), 1u);
  EXPECT_EQ(free.errors[0].pointer, "/body/inertia");
  EXPECT_NE(free.errors[0].message.find("body and rotor together are not free to turn about three axes"), std::string::npos);
  const RunResult result = run(*examined(R"("axis": [0.1, 0, 1])").scene);
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable);
}

/// Side by side, in the equations of either observer, gyrostats drift as each by itself does.
TEST(GyrostatLanes, DriftAsEachByItself) {
  std::mt19937_64 random(62);
  for (const Observer observer : {Observer::laboratory, Observer::body}) {
    std::vector<Scene> scenes;
    for (int i = 0; i < 6; ++i) {
      Scenario s = any_gyrostat(random);
      s.numerics.observer = observer, s.numerics.form = ModelForm::general;
      scenes.push_back(resolve(std::move(s)));
    }
    const std::vector<BatchOutcome> together = run_batch(scenes);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      ASSERT_TRUE(together[i].result) << together[i].refusal;
      const RunResult& batch = *together[i].result;
      const RunResult alone = run(scenes[i]);
      ASSERT_EQ(batch.rows.size(), alone.rows.size());
      for (std::size_t row = 0; row < alone.rows.size(); ++row) {
        const BasicRotorRow<double>&a = *batch.rows[row].rotor, &b = *alone.rows[row].rotor;
        EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad) << i;
        EXPECT_NEAR(a.drift_rate_rad_s, b.drift_rate_rad_s, a.drift_rate_bound_rad_s + b.drift_rate_bound_rad_s) << i;
      }
      // The bound has to be a small part of the drift, so that the lines above can fail.
      EXPECT_LT(batch.rows.back().rotor->drift_axis_bound_rad, 1e-3 * batch.rows.back().rotor->drift_axis_rad)
          << i;  // so that the lines above can fail
    }
  }
}

/// The threshold is that of the rotor's axis, and is passed when the row there says so.
TEST(Gyrostat, ThresholdIsOfTheRotorsAxis) {
  Scenario s = with_tilted_rotor();
  s.threshold_rad = 3e-3;
  const RunResult found = run(s);
  ASSERT_EQ(found.drift.threshold_crossing, ThresholdCrossing::clear);
  const double t_s = *found.drift.threshold_time_s;
  s.duration_s = s.output_step_s = t_s;
  const DriftRow row = run(s).rows.back();
  EXPECT_NEAR(row.rotor->drift_axis_rad, 3e-3, 1e-10);   // the row's bound, and the time's
  EXPECT_GT(std::abs(row.drift_axis_rad - 3e-3), 1e-5);  // body axis 3 is elsewhere
}

/// [F]'s torques against Euler's equation, for every observer; the Coriolis torque is the sum of its parts; for the observer in the body
/// it is l x w.
TEST(GyrostatLedger, BalancesForEveryObserver) {
  std::mt19937_64 random(61);
  for (int i = 0; i < 12; ++i) {
    Scenario s = i < 2 ? caged_gyroscope() : any_gyrostat(random);
    s.rotation_rate_rad_s = 0.5;
    if (i == 1) s.rotor->viscous_torque_N_m_s = 2e-6;
    for (const LedgerObserver observer :
         {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
      s.ledger = observer;
      const RunResult result = run(s);
      const Vec3<double> W_L = result.scene.model<double>().W_IL_L;
      EXPECT_EQ(is_caged_top(s), i < 2);
      EXPECT_LT(result.ledger->largest.relative_residual(), 1e-12) << i << to_string(observer);  // rounding of the states
      for (std::size_t row = 0; row < result.rows.size(); ++row) {
        const LedgerRow<double>& torques = result.ledger->entries[row];
        const std::array<double, 3>&a = torques.tau_cor_inertia_A, &b = torques.tau_cor_gyroscopic_A;
        EXPECT_LE(vectors_apart(torques.tau_cor_A, {a[0] + b[0], a[1] + b[1], a[2] + b[2]}),
                  1e-14 * result.ledger->largest.tau_cor);  // some roundings
        if (observer != LedgerObserver::body) continue;
        const DriftRow& at = result.rows[row];
        const Vec3<double> w_LB_B(at.w_LB_B[0], at.w_LB_B[1], at.w_LB_B[2]);
        const Mat3<double> R_LB = rotation_matrix(Quaternion<double>{at.q_LB[0], {at.q_LB[1], at.q_LB[2], at.q_LB[3]}});
        const Vec3<double> w_IB_B = w_LB_B + transposed_times(R_LB, W_L);
        const Rotor<double> rotor = make_rotor<double>(*s.rotor);
        const Vec3<double> expected = rotor.axial * at.rotor->rate_rad_s * rotor.axis_B.cross(w_IB_B);
        EXPECT_LE(vectors_apart(torques.tau_cor_A, {expected[0], expected[1], expected[2]}),
                  1e-13 * (norm(expected) + 1e-9));                                 // the same
        EXPECT_LT(real::hypot(a[0], a[1], a[2]), 1e-15 * (norm(expected) + 1e-9));  // no inertia changes in the body
      }
    }
  }
}

}  // namespace
}  // namespace earthtop
