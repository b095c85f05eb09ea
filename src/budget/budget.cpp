// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/budget/budget.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "budget/effects.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "scene/input_derivatives.hpp"

namespace earthtop {
namespace {

constexpr double kTolerance = 1e-7;     // tolerance of the variations: a few digits of a budget suffice
constexpr double kFollowedPhase = 1e5;  // phase of the fastest rate (rad); takes some ten seconds
constexpr double kBeforeFrictionStops = 0.9;

/// Returns how long the motion is followed (s): to its end, up to a limit of cost, or to shortly before dry friction stops it.
double followed_time(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const double damping_rate = scene.pace().damping / scenario.duration_s;
  double time_s = std::min(scenario.duration_s, kFollowedPhase / std::max(scene.fastest_rate_rad_s(), damping_rate));
  if (const double coulomb = scenario.effects.applied.coulomb_N_m; coulomb > 0) {
    const double momentum = norm(Vec3<double>(times(scene.body<double>().I_BP_B, scene.release<double>().w_XB_B)));
    time_s = std::min(time_s, kBeforeFrictionStops * momentum / coulomb);
  }
  return time_s;
}

/// The responses to one candidate effect, combined from the responses to the inputs that represent it.
struct Sized {
  std::optional<Responses> responses;  ///< empty if the motion could not be followed
  double torque_release = 0, torque_largest = 0;
};

double in_newton_metres(double torque, const NaturalUnits& units) {
  return real::scale(torque, units.mass_exponent - 2 * units.time_exponent);
}

std::vector<Sized> size_up(const std::vector<Candidate>& candidates, const DriftProblem<double>& problem, double time_s,
                           double& drift_rad, double& reached_s, RunStatus& status, const Watch& watch) {
  std::vector<Sized> sized(candidates.size());
  std::vector<ProblemDerivative> inputs;
  inputs.reserve(candidates.size());
  for (const Candidate& candidate : candidates) inputs.push_back(candidate.input);
  double end = 0;
  const auto on_step = [&](const FollowedStep& step) {
    end = step.t;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double torque = candidates[i].torque(step);
      if (step.t == 0) sized[i].torque_release = torque;
      sized[i].torque_largest = std::max(sized[i].torque_largest, torque);
    }
  };
  const DriftSensitivity drift = drift_sensitivity(problem, inputs, time_s, kTolerance, watch, on_step);
  reached_s = real::scale(end, problem.units.time_exponent);
  status = drift.status;
  drift_rad = status == RunStatus::completed ? drift.axis.value : std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < drift.responses.size(); ++i) sized[i].responses = drift.responses[i];
  return sized;
}

/// Makes the budget entry of a candidate effect.
/// @param later, drift_later  factors by which displacements and drifts grow from the time followed to the end of the run
EffectEntry entry_of(const Scene& scene, const Candidate& candidate, const Sized& sized, const NaturalUnits& units,
                     double later, double drift_later) {
  EffectEntry entry;
  entry.name = candidate.effect->name;
  entry.modelled = candidate.effect->is_modelled(scene);
  entry.assumed = candidate.assumed;
  entry.in_difference = candidate.in_difference;
  entry.reason = candidate.reason;
  const double size = std::abs(candidate.size);
  entry.torque_release_N_m = in_newton_metres(size * sized.torque_release, units);
  entry.torque_largest_N_m = in_newton_metres(size * sized.torque_largest, units);
  if (!sized.responses) return entry;
  if (!candidate.in_difference) entry.displacement_rad = later * size * sized.responses->displacement_largest;
  const double grown = candidate.in_difference ? drift_later : later * drift_later;  // the drift itself is displaced
  entry.drift_rad = grown * size * sized.responses->drift_largest;
  entry.drift_final_rad = grown * size * sized.responses->drift_final;
  return entry;
}

/// Returns the scene whose drift is computed for a budget: in double precision, without sensitivities and ledger.
Scene drift_scene(const Scene& scene) {
  Scenario scenario = scene.scenario();
  scenario.sensitivities = false;
  scenario.ledger.reset();
  if (scenario.precision != Precision::bits53) {
    scenario.precision = Precision::bits53;
    scenario.numerics.relative_tolerance = default_tolerance(scenario.precision);
  }
  return resolve(std::move(scenario));
}

bool has_affordable_drift(const Scene& scene) {
  constexpr double kAffordable_s = 60;
  return scene.estimate().seconds.all() <= kAffordable_s && !scene.method_refusal();
}

/// Returns the time (s) to compute the drift at the end, which is needed if the motion is followed for a part of its time only.
double drift_seconds(const Scene& scene, double followed_s) {
  if (!(followed_s < scene.scenario().duration_s)) return 0;
  const Scene drift = drift_scene(scene);
  return has_affordable_drift(drift) ? drift.costs()[0].seconds : 0;
}

/// Returns the factor by which the drift grows from the time followed to the end. The factor is computed from the drift itself
/// if a run takes at most a minute; otherwise it is `in_proportion`, the ratio of the times.
double drift_growth(const Scene& scene, double followed_s, double in_proportion, const Watch& watch) {
  const double duration_s = scene.scenario().duration_s;
  if (!(followed_s > 0) || !(followed_s < duration_s)) return 1;
  const Scene in_double = drift_scene(scene);
  if (!has_affordable_drift(in_double)) return in_proportion;
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = {0, followed_s, duration_s};
  const DriftTrajectory<double> drift = integrate_drift(problem, in_double.choice().options, watch);
  if (drift.samples.size() < 3 || !(drift.samples[1].measures.axis > 0)) return in_proportion;
  return drift.samples[2].measures.axis / drift.samples[1].measures.axis;
}

/// Returns warnings for a scene that models one effect and omits a larger one.
std::vector<std::string> warnings_of(const std::vector<EffectEntry>& effects) {
  std::vector<std::string> warnings;
  const auto lost = [](const EffectEntry& entry) {
    return std::max(entry.drift_rad.value_or(0), entry.displacement_rad.value_or(0)) > 1;
  };
  if (std::any_of(effects.begin(), effects.end(), lost))
    warnings.emplace_back("sizes above 1 rad say only that the effect carries the motion away: they are of the first order");
  for (const EffectEntry& omitted : effects) {
    if (omitted.modelled || omitted.assumed || !omitted.torque_largest_N_m || omitted.name == kAxisPrecession) continue;
    const EffectEntry* smallest = nullptr;
    for (const EffectEntry& modelled : effects) {
      if (!modelled.modelled || !(modelled.torque_largest_N_m.value_or(0) > 0)) continue;
      if (*modelled.torque_largest_N_m < *omitted.torque_largest_N_m &&
          (smallest == nullptr || *modelled.torque_largest_N_m < *smallest->torque_largest_N_m))
        smallest = &modelled;
    }
    if (smallest != nullptr)
      warnings.push_back(
          fmt::format("the scene models {} ({:.2g} N m at its largest) and leaves out {} ({:.2g} N m), which is "
                      "larger",
                      smallest->name, *smallest->torque_largest_N_m, omitted.name, *omitted.torque_largest_N_m));
  }
  return warnings;
}

void add_inputs(const Scene& scene, double time_s, double later, double drift_later, const Watch& watch, Budget& budget) {
  if (scene.rotation_rate_rad_s() == 0) {
    budget.inputs_unavailable = "the Earth does not turn: there is no effect to be seen";
    return;
  }
  const InputDerivatives inputs = input_derivatives(scene);
  const DriftSensitivity drift = drift_sensitivity(scene.problem<double>(), inputs.by_scaled_input, time_s, kTolerance, watch);
  if (drift.status != RunStatus::completed) {
    budget.inputs_unavailable = fmt::format("their integration ended with {}", to_string(drift.status));
    return;
  }
  for (std::size_t i = 0; i < kInputNames.size(); ++i) {
    const Responses& r = drift.responses[i];
    InputNeed need{std::string(kInputNames[i]), inputs.values[i], later * r.displacement_largest / inputs.scales[i],
                   drift_later * r.drift_final / inputs.scales[i], std::nullopt};
    const bool of_earth = need.name == "latitude_deg" || need.name == "rotation_rate_rad_s";
    const double moved = of_earth ? need.drift_per_unit_rad : need.displacement_per_unit_rad;
    if (moved > 0) need.hides_earth = budget.earth_drift_rad / moved;
    budget.inputs.push_back(need);
  }
}

/// Times of the parts of a budget on one core (s).
struct BudgetSeconds {
  double effects = 0, drift = 0, inputs = 0;
  double all() const { return effects + drift + inputs; }
};

BudgetSeconds seconds_of(const Scene& scene, double time_s, std::size_t candidates) {
  BudgetSeconds seconds;
  seconds.effects = sensitivity_seconds(scene, time_s, kTolerance, candidates);
  seconds.drift = drift_seconds(scene, time_s);
  if (scene.rotation_rate_rad_s() != 0) seconds.inputs = sensitivity_seconds(scene, time_s, kTolerance, kInputNames.size());
  return seconds;
}

}  // namespace

double budget_seconds(const Scene& scene) {
  return seconds_of(scene, followed_time(scene), effect_candidates(scene).size()).all();
}

Budget effect_budget(const Scene& scene, const Watch& watch) {
  const auto& problem = scene.problem<double>();
  const std::vector<Candidate> candidates = effect_candidates(scene);
  const double time_s = followed_time(scene);
  const BudgetSeconds seconds = seconds_of(scene, time_s, candidates.size());
  Parts parts(watch, seconds.all());
  Budget budget;
  RunStatus status = RunStatus::completed;
  const std::vector<Sized> sized = size_up(candidates, problem, time_s, budget.earth_drift_rad, budget.followed_s, status,
                                           parts.next(seconds.effects, "effects"));
  const double later = budget.followed_s > 0 ? scene.scenario().duration_s / budget.followed_s : 1;
  const double drift_later = drift_growth(scene, budget.followed_s, later, parts.next(seconds.drift, "drift"));
  budget.earth_drift_rad *= drift_later;
  std::size_t next = 0;  // index of the next candidate; candidates are in the catalogue's order
  for (const Effect& effect : all_effects()) {
    if (!effect.is_in_budget(scene)) continue;
    const bool is_sized = next < candidates.size() && candidates[next].effect == &effect;
    budget.effects.push_back(is_sized ? entry_of(scene, candidates[next], sized[next], problem.units, later, drift_later)
                                      : unsized_entry(effect, scene));
    if (is_sized) ++next;
  }
  budget.warnings = warnings_of(budget.effects);
  if (status != RunStatus::completed)
    budget.warnings.push_back(fmt::format("the motion could be followed for {:.4g} s only ({}): drifts are not known",
                                          budget.followed_s, to_string(status)));
  add_inputs(scene, budget.followed_s, later, drift_later, parts.next(seconds.inputs, "inputs"), budget);
  return budget;
}

}  // namespace earthtop
