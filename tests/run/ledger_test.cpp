// SPDX-License-Identifier: GPL-3.0-or-later
/// The ledger of a run: at round-off in every shipped scene, and its dL'/dt compared with the integrated motion.

#include <gtest/gtest.h>

#include <filesystem>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "frames/random_cases.hpp"
#include "model/ledger_sizes.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

using Q = float128;
using test::close;
using test::kLedgerObservers;
using test::kLedgerRounding;

PlatformSpec swinging_platform() {
  PlatformSpec platform;
  platform.motion = PlatformMotion::harmonic;
  platform.axis = {0.3, -0.2, 1};
  platform.amplitude_rad = 0.5;
  platform.frequency_hz = 0.75;
  platform.phase_deg = 30;
  platform.pivot_offset_m = {0.25, -0.125, 0.0625};
  return platform;
}

/// Runs the scene for every observer and checks that every row closes to round-off. @returns the largest residual divided by
/// the largest torque
double expect_closed(Scenario scenario) {
  double worst = 0, residual = 0, torque = 0;
  for (const LedgerObserver observer : kLedgerObservers) {
    scenario.ledger = observer;
    SCOPED_TRACE(scenario.name + ", " + std::string(to_string(observer)));
    const RunResult result = run(scenario);
    EXPECT_EQ(result.status, RunStatus::completed);
    if (!result.ledger) {
      ADD_FAILURE() << "no ledger";
      continue;
    }
    EXPECT_EQ(result.ledger->observer, observer);
    EXPECT_EQ(result.ledger->entries.size(), result.rows.size());
    const LedgerLargest& largest = result.ledger->largest;
    if (scenario.gimbals) {  // a free gyroscope has no torque at all for some observers
      residual = std::max(residual, largest.residual);
      torque = std::max({torque, largest.tau_phys, largest.tau_cor, largest.tau_trans, largest.tau_cent, largest.bearing});
      continue;
    }
    worst = std::max(worst, largest.relative_residual());
    const auto model = Scene(scenario).model<double>();
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const DriftRow& row = result.rows[i];
      const Vec3<double> w_LB_B(row.w_LB_B[0], row.w_LB_B[1], row.w_LB_B[2]);
      const double size = test::ledger_size<double>(observer, model, row.t_s, w_LB_B);
      const auto& residual_A = result.ledger->entries[i].residual_A;
      EXPECT_LE(real::hypot(residual_A[0], residual_A[1], residual_A[2]), kLedgerRounding * real::epsilon<double>() * size)
          << row.t_s;
    }
  }
  EXPECT_LE(residual, 4 * kLedgerRounding * real::epsilon<double>() * torque) << scenario.name;  // sums over all parts
  return worst;
}

std::vector<Scenario> shipped_scenes() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<Scenario> scenes;
  for (const std::string& file : files) {
    Scenario scenario = parse_scenario(read_scenario_source(file));
    if (scenario.contact) continue;  // contact_ledger_test.cpp has the ledger about a tip that moves
    scenario.duration_s = std::min(scenario.duration_s, 0.5);
    scenario.output_step_s = scenario.duration_s / 25;
    scenes.push_back(scenario);
  }
  return scenes;
}

TEST(RunLedger, ShippedScenesCloseToRoundOff) {
  const auto scenes = shipped_scenes();
  ASSERT_GE(scenes.size(), 5U);
  double worst = 0;
  for (const Scenario& scene : scenes) worst = std::max(worst, expect_closed(scene));
  EXPECT_LT(worst, 2e-15);  // of the largest torque: what README promises
}

TEST(RunLedger, ChangedScenesCloseToRoundOff) {
  for (Scenario scene : shipped_scenes()) {
    scene.rotation_rate_rad_s = 1;
    scene.site.latitude_deg = scene.travel ? -70 : -90;  // no journey leads to a pole
    expect_closed(scene);
    scene.site.latitude_deg = -35;
    scene.platform = swinging_platform();
    expect_closed(scene);
    if (scene.gimbals || scene.travel) continue;  // which need all torques
    scene.effects.coriolis = false;
    expect_closed(scene);
    scene.effects.coriolis = true, scene.effects.centrifugal = scene.effects.transverse = false;
    scene.platform.reset();
    expect_closed(scene);
    scene.rotation_rate_rad_s = 0;
    scene.effects = {};
    expect_closed(scene);
  }
  for (std::uint64_t seed = 1; seed <= 12; ++seed) expect_closed(testing::random_scene(seed, 50));
}

TEST(RunLedger, NoneUnlessAsked) {
  Scenario scenario = testing::toy_top();
  scenario.duration_s = 0.1;
  EXPECT_FALSE(run(scenario).ledger);
}

/// A scene in which all torques are of similar size: Omega = 1 rad/s, three different moments, centre of mass off every axis.
Scenario lively_scene() {
  Scenario s;
  s.name = "lively";
  s.site = {50, 0, 0, 9.75};
  s.rotation_rate_rad_s = 1;
  s.body.mass_kg = 0.5;
  s.body.center_of_mass_m = {0.25, -0.125, 0.75};
  s.body.inertia_kg_m2 = {{{1.5, 0.125, -0.0625}, {0.125, 1.75, 0.25}, {-0.0625, 0.25, 1.0}}};
  s.release.tilt_deg = 70;
  s.release.azimuth_deg = 20;
  s.release.angular_velocity_body_rad_s = {1.5, -1, 2};
  s.platform = swinging_platform();
  s.duration_s = 1;
  s.output_step_s = 0.1;
  return s;
}

/// The laboratory's axes as seen in A, and the rate of A relative to L in L axes, written out from the definitions.
struct SeenFromL {
  Mat3<Q> R_AL;
  Vec3<Q> w_LA_L;
};
SeenFromL seen_from_laboratory(LedgerObserver observer, const Scenario& s, Q t) {
  const Vec3<Q> W_L = Q(s.rotation_rate_rad_s) * celestial_axis_L<Q>(s.site);
  if (observer == LedgerObserver::inertial) return {test::rodrigues<Q>(W_L / norm(W_L), norm(W_L) * t), -W_L};
  if (observer == LedgerObserver::laboratory) return {Mat3<Q>::Identity(), Vec3<Q>::Zero()};
  const PlatformSpec& p = s.platform.value();
  Vec3<Q> axis;
  for (int i = 0; i < 3; ++i) axis[i] = Q(p.axis[static_cast<std::size_t>(i)]);
  axis /= norm(axis);
  const Q pulsation = Q(2) * real::pi<Q>() * p.frequency_hz, phase = real::pi<Q>() * p.phase_deg / 180;
  const Q angle = p.amplitude_rad * real::sin(pulsation * t + phase);
  return {test::rodrigues<Q>(-axis, angle), p.amplitude_rad * pulsation * real::cos(pulsation * t + phase) * axis};
}

TEST(RunLedger, MomentumRateAgainstDifferencesOfTheIntegratedMotion) {
  // L'_A of the integrated motion at t -+ h, h/2, h/4, extrapolated. The error of the solution (tolerance 1e-20 per step) and
  // of the differences, W (W h)^6, stay nine orders below the smallest torque.
  const double centre = 0.5, h = 0x1p-13;
  EffectsSpec all_on, without_coriolis, without_centrifugal;
  without_coriolis.coriolis = without_centrifugal.centrifugal = false;
  for (const EffectsSpec& effects : {all_on, without_coriolis, without_centrifugal})
    for (const LedgerObserver observer : kLedgerObservers) {
      Scenario scenario = lively_scene();
      scenario.effects = effects;
      SCOPED_TRACE(std::string(to_string(observer)) + (effects.all_on()   ? ""
                                                       : effects.coriolis ? ", no centrifugal"
                                                                          : ", no Coriolis"));
      auto problem = Scene(scenario).problem<Q>();
      problem.times_s = {0, centre - h, centre - h / 2, centre - h / 4, centre, centre + h / 4, centre + h / 2, centre + h};
      IntegrationOptions options;
      options.method = Method::rkf78;
      options.relative_tolerance = 1e-20;
      options.observer = observer == LedgerObserver::body ? Observer::laboratory : Observer::body;
      const auto trajectory = integrate_drift(problem, options);
      ASSERT_EQ(trajectory.status, RunStatus::completed);

      const auto body = make_body<Q>(scenario.body);
      const Vec3<Q> W_L = Q(scenario.rotation_rate_rad_s) * celestial_axis_L<Q>(scenario.site);
      const auto state_at = [&](Q t) -> const DriftState<Q>& {
        for (const auto& sample : trajectory.samples)
          if (sample.state.t_s == t) return sample.state;
        throw std::logic_error("no such row");
      };
      // The momentum to be differentiated: L' in A axes. For the body's observer, in whose axes L' is zero, Theta w_IB instead.
      const auto momentum_A = [&](Q t) -> Vec3<Q> {
        const DriftState<Q>& s = state_at(t);
        const Mat3<Q> R_LB = rotation_matrix(s.q_LB);
        if (observer == LedgerObserver::body) return body.I_BP_B * (s.w_LB_B + R_LB.transpose() * W_L);
        const SeenFromL A = seen_from_laboratory(observer, scenario, t);
        return A.R_AL * (R_LB * (body.I_BP_B * (s.w_LB_B - R_LB.transpose() * A.w_LA_L)));
      };
      const Vec3<Q> differenced_A = test::first_derivative(momentum_A, Q(centre), Q(h));

      const DriftState<Q>& s = state_at(Q(centre));
      const auto entry = ledger_entry(observer, Scene(scenario).model<Q>(), Q(centre), s.q_LB, s.w_LB_B);
      // Rates, and derivatives over rates, stay below 20 per second in this scene; a thousand steps err by 1e-17 at most.
      const Q W = 20, Wh = W * Q(h);
      const Q bound = norm(momentum_A(Q(centre))) * (W * Wh * Wh * Wh * Wh * Wh * Wh + Q(1e-17) / Q(h));
      if (observer == LedgerObserver::body) {
        EXPECT_TRUE(close<Q>(Vec3<Q>(-entry.tau_trans_A), differenced_A, bound));
      } else {
        EXPECT_TRUE(close<Q>(entry.dL_dt_A, differenced_A, bound));
      }
      const Vec3<Q> torques_A = entry.tau_phys_A + entry.tau_cor_A + entry.tau_cent_A + entry.tau_trans_A;
      EXPECT_TRUE(close<Q>(torques_A, observer == LedgerObserver::body ? Vec3<Q>(Vec3<Q>::Zero()) : differenced_A, bound));
      for (const Vec3<Q>& torque : {entry.tau_phys_A, entry.tau_cor_A, entry.tau_trans_A, entry.tau_cent_A})
        EXPECT_TRUE(norm(torque) == Q(0) || bound < Q(1e-9) * norm(torque)) << static_cast<double>(norm(torque));
    }
}

}  // namespace
}  // namespace earthtop
