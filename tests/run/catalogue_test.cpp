// SPDX-License-Identifier: GPL-3.0-or-later
// Walks the catalogue of effects: a run by Taylor series, whose coefficients have gone over to the scalar that records formulas,
// against a run by steps of a Runge-Kutta method in another observer's equations, where every formula is that of plain numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "budget/effects.hpp"
#include "support/effect_cases.hpp"

namespace earthtop {
namespace {

/// The error of both runs may hide this share of what an effect does to the motion: a coefficient that is lost is seen a
/// thousandfold.
constexpr double kHidden = 1e-3;

RunResult run_by(Scenario s, Method method, Observer observer) {
  s.numerics.method = method, s.numerics.observer = observer, s.numerics.form = ModelForm::general;
  RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  EXPECT_EQ(result.solution.method, method);
  EXPECT_EQ(result.solution.form, ModelForm::general);
  return result;
}
RunResult run_by_series(const Scenario& s) {
  return run_by(s, Method::taylor, s.contact ? Observer::inertial : Observer::body);  // a table has no equations in body axes
}
RunResult run_by_steps(const Scenario& s) { return run_by(s, Method::rkf78, Observer::laboratory); }

double angle_between(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  const auto q = [](const std::array<double, 4>& c) { return Quaternion<double>{c[0], {c[1], c[2], c[3]}}; };
  const Quaternion<double> turn = q(a).conjugate() * q(b);
  return 2 * real::atan2(norm(turn.v), std::abs(turn.w));
}

/// The largest differences of two runs.
struct Apart {
  double attitude = 0, drift = 0;

  Apart(const RunResult& a, const RunResult& b) {
    EXPECT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i) {
      const DriftRow &x = a.rows[i], &y = b.rows[i];
      attitude = std::max({attitude, angle_between(x.q_LB, y.q_LB), angle_between(x.ref_q_LB, y.ref_q_LB)});
      drift = std::max(drift, std::abs(x.drift_attitude_rad - y.drift_attitude_rad));
    }
  }
};

void expect_the_series_has(const Effect& effect, const testing::EffectCase& scene) {
  Scenario with = testing::fast_earth_top();
  scene.add(with);
  Scenario without = with;
  scene.leave_out(without);
  EXPECT_TRUE(effect.is_modelled(Scene(with)));
  const RunResult series = run_by_series(with), steps = run_by_steps(with);
  const double attitude_error = series.attitude_bound_rad + steps.attitude_bound_rad;
  const double drift_error = series.rows.back().drift_attitude_bound_rad + steps.rows.back().drift_attitude_bound_rad;
  const Apart apart(series, steps), acts(steps, run_by_steps(without));
  EXPECT_LE(apart.attitude, attitude_error);
  EXPECT_LE(apart.drift, drift_error);
  if (effect.is_zero) return;
  EXPECT_LT(attitude_error, kHidden * acts.attitude);
  EXPECT_LT(drift_error, kHidden * acts.drift);
}

TEST(Catalogue, EveryEffectThatAScenarioCanGiveIsInItsSeries) {
  const std::vector<testing::EffectCase> cases = testing::effect_cases();
  for (const Effect& effect : all_effects()) {
    if (effect.key.empty()) continue;  // no scenario can give or omit it
    int tried = 0;
    for (const testing::EffectCase& scene : cases) {
      if (scene.effect != effect.name) continue;
      SCOPED_TRACE(scene.effect + ": " + scene.name);
      expect_the_series_has(effect, scene);
      ++tried;
    }
    EXPECT_GT(tried, 0) << "tests/support/effect_cases.hpp has no scene for the effect " << effect.name;
  }
}

/// The scenario read from its text, with all checks; nothing where it is refused for this key.
std::optional<Scenario> unless_refused(const Scenario& s, std::string_view key) {
  try {
    return parse_scenario({"built in code", canonical_json(s)});
  } catch (const ScenarioError& refusal) {
    EXPECT_NE(std::string_view(refusal.what()).find(key), std::string_view::npos) << refusal.what();
    return std::nullopt;
  }
}

// A torque for which no force on a table is known would have no effect there, in both integrations.
TEST(Catalogue, EveryEffectActsOnATableOrIsRefusedThere) {
  for (const Effect& effect : all_effects())
    for (const testing::EffectCase& scene : testing::effect_cases()) {
      if (scene.effect != effect.name || effect.is_zero) continue;
      SCOPED_TRACE(scene.effect + ": " + scene.name);
      Scenario with = testing::fast_earth_top();
      scene.add(with);
      with.contact = ContactSpec{.tip_radius_m = 0.002, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.5};
      with.release.tilt_deg = 20;
      with.duration_s = with.output_step_s = 0.5;
      Scenario without = with;
      scene.leave_out(without);
      const std::optional<Scenario> accepted = unless_refused(with, effect.key);
      if (!accepted) continue;
      const RunResult acting = run(*accepted), not_acting = run(without);
      EXPECT_EQ(acting.status, RunStatus::completed);
      EXPECT_LT(acting.attitude_bound_rad + not_acting.attitude_bound_rad, kHidden * Apart(acting, not_acting).attitude);
    }
}

// The estimate of a run's work, from which its limit comes, would be that of an undamped motion.
TEST(Catalogue, ThePaceCountsWhateverRubs) {
  for (const testing::EffectCase& scene : testing::effect_cases()) {
    SCOPED_TRACE(scene.effect + ": " + scene.name);
    Scenario with = testing::fast_earth_top();
    scene.add(with);
    const AppliedTorquesSpec& applied = with.effects.applied;
    const bool rubs = applied.friction() || (applied.gimbal && applied.gimbal->damping_N_m_s > 0) ||
                      (with.rotor && with.rotor->has_friction());
    const Pace pace = Scene(with).pace();
    EXPECT_EQ(pace.damping > 0 || pace.halts > 0, rubs);
  }
}

TEST(Catalogue, EveryCaseIsOfAnEffect) {
  for (const testing::EffectCase& scene : testing::effect_cases())
    EXPECT_TRUE(std::ranges::any_of(all_effects(), [&](const Effect& effect) { return effect.name == scene.effect; }))
        << scene.effect;
}

}  // namespace
}  // namespace earthtop
