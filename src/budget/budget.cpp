// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/budget/budget.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "budget/drift_scene.hpp"
#include "budget/effects.hpp"
#include "budget/torque_budget.hpp"
#include "drift/derivatives/drift_differences.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/input_derivatives.hpp"
#include "scene/sensitivity_route.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

constexpr double kTolerance = 1e-9;     // tolerance of the variations: a few digits, also of what friction leaves of a drift
constexpr double kFollowedPhase = 1e5;  // phase of the fastest rate (rad); takes some ten seconds
constexpr double kBeforeFrictionStops = 0.9;

/// Returns how long the motion is followed (s): to its end, up to a limit of cost, or to shortly before dry friction stops it.
double followed_time(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const double damping_rate = scene.pace_by_rule().damping / scenario.duration_s;
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

/// The inputs that represent the candidate effects and, after them, the inputs of the scene.
std::vector<ProblemDerivative> all_inputs(const std::vector<Candidate>& candidates, const InputDerivatives& inputs) {
  std::vector<ProblemDerivative> all;
  all.reserve(candidates.size() + inputs.by_scaled_input.size());
  for (const Candidate& candidate : candidates) all.push_back(candidate.input);
  all.insert(all.end(), inputs.by_scaled_input.begin(), inputs.by_scaled_input.end());
  return all;
}

/// How the responses of both motions are found.
struct Responding {
  std::optional<DifferenceMethods> differences;  ///< of whole integrations; empty for the variational equations
  double seconds = 0;
};

/// Chooses the cheaper way. Differences of whole integrations exist for symmetric tops only.
/// @param effects  number of the inputs that represent effects; they come first
Responding responding(const Scene& scene, double time_s, const std::vector<ProblemDerivative>& inputs, std::size_t effects) {
  Responding by{std::nullopt, variations_seconds(scene, time_s, kTolerance, effects) +
                                  variations_seconds(scene, time_s, kTolerance, inputs.size() - effects)};
  const Scene in_double = drift_scene(scene);
  const auto& problem = scene.problem_without_rows<double>();
  if (!has_drift_differences(problem) || in_double.method_refusal(Method::taylor)) return by;
  DifferenceMethods methods;
  methods.alone.method = methods.driven.method = Method::taylor;
  const double share = time_s / scene.scenario().duration_s;
  const double taylor = share * in_double.cost(methods.alone).seconds;
  double alone = taylor;
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const double nutation = inertia(2, 2) * std::abs(scene.release<double>().w_XB_B[2]) / inertia(0, 0);
  const bool nutates = nutation * time_s > 2 * real::pi<double>() * kLeastNutations;
  if (nutates && !in_double.method_refusal(Method::long_horizon)) {
    IntegrationOptions steps;
    steps.method = Method::long_horizon;
    if (const double seconds = in_double.cost(steps).seconds * share; seconds < taylor) methods.alone = steps, alone = seconds;
  }
  const DifferenceRuns runs = difference_runs(problem, inputs, methods);
  constexpr double kDriven = 3;  // a Taylor series with torques, over one without
  const double seconds = runs.alone * alone + runs.driven * taylor * (scene.is_plain() ? kDriven : 1);
  if (seconds < by.seconds) by = {methods, seconds};
  return by;
}

/// The responses to all inputs, and the torques of the candidates.
struct SizedUp {
  std::vector<Sized> effects;
  DriftSensitivity drift;
  double reached_s = 0;
  RunStatus inputs_status = RunStatus::completed;
};

/// The responses by the variational equations. The effects have torques of their own, which the inputs need not pay for.
/// @param inputs_status  how the integration for the inputs alone ends
DriftSensitivity integrated_responses(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                      std::size_t effects, double time_s, const Watch& watch,
                                      const std::function<void(const FollowedStep&)>& on_step, RunStatus& inputs_status) {
  const auto middle = inputs.begin() + static_cast<std::ptrdiff_t>(effects);
  const double share = double(effects) / double(inputs.size());
  DriftSensitivity drift = drift_sensitivity(problem, {inputs.begin(), middle}, time_s, kTolerance, watch.part(0, share),
                                             SensitivitySought::responses, on_step);
  inputs_status = drift.status;
  if (drift.status != RunStatus::completed || middle == inputs.end()) return drift;
  const DriftSensitivity more = drift_sensitivity(problem, {middle, inputs.end()}, time_s, kTolerance, watch.part(share, 1),
                                                  SensitivitySought::responses);
  inputs_status = more.status;
  drift.responses.insert(drift.responses.end(), more.responses.begin(), more.responses.end());
  return drift;
}

SizedUp size_up(const Scene& scene, const std::vector<Candidate>& candidates, const std::vector<ProblemDerivative>& inputs,
                double time_s, const Responding& by, const Watch& watch) {
  const auto& problem = scene.problem_without_rows<double>();
  SizedUp up;
  up.effects.resize(candidates.size());
  double end = 0;
  const auto on_step = [&](const FollowedStep& step) {
    end = step.t;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double torque = candidates[i].torque(step);
      if (step.t == 0) up.effects[i].torque_release = torque;
      up.effects[i].torque_largest = std::max(up.effects[i].torque_largest, torque);
    }
  };
  std::optional<DriftSensitivity> differences;
  if (by.differences) differences = drift_differences(problem, inputs, time_s, *by.differences, watch, on_step);
  up.drift = differences ? *std::move(differences)
                         : integrated_responses(problem, inputs, candidates.size(), time_s, watch, on_step, up.inputs_status);
  // To seconds and back the end may change by a rounding.
  up.reached_s = up.drift.status == RunStatus::completed ? time_s : real::scale(end, problem.units.time_exponent);
  if (!(up.reached_s > 0)) return up;
  for (std::size_t i = 0; i < std::min(candidates.size(), up.drift.responses.size()); ++i)
    up.effects[i].responses = up.drift.responses[i];
  return up;
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
  if (!sized.responses || !candidate.has_responses) return entry;
  if (!candidate.in_difference) entry.displacement_rad = later * size * sized.responses->displacement_largest;
  const double grown = candidate.in_difference ? drift_later : later * drift_later;  // the drift itself is displaced
  entry.drift_rad = grown * size * sized.responses->drift_largest;
  entry.drift_final_rad = grown * size * sized.responses->drift_final;
  return entry;
}

bool has_affordable_drift(const Scene& scene) {
  return scene.estimate().seconds.all() <= kAffordableDrift_s && !scene.method_refusal();
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
  DriftProblem<double> problem = scene.problem_without_rows<double>();
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
    warnings.emplace_back(
        "sizes above 1 rad are of first order only: they say no more than that the effect changes the motion altogether");
  for (const EffectEntry& omitted : effects) {
    if (omitted.modelled || omitted.assumed || !omitted.torque_largest_N_m || omitted.name == kAxisPrecession) continue;
    const EffectEntry* smallest = nullptr;
    for (const EffectEntry& modelled : effects) {
      if (!modelled.modelled || !(modelled.torque_largest_N_m.value_or(0) > 0)) continue;
      if (*modelled.torque_largest_N_m < *omitted.torque_largest_N_m &&
          (smallest == nullptr || *modelled.torque_largest_N_m < *smallest->torque_largest_N_m))
        smallest = &modelled;
    }
    if (smallest == nullptr) continue;
    const auto [small, large] = told_apart(*smallest->torque_largest_N_m, *omitted.torque_largest_N_m, 2);
    warnings.push_back(fmt::format("the scenario models {} ({} N m at its largest) and leaves out {} ({} N m), which is larger",
                                   smallest->name, small, omitted.name, large));
  }
  return warnings;
}

/// @param responses  to the inputs alone
void add_inputs(const InputDerivatives& inputs, std::span<const Responses> responses, double later, double drift_later,
                Budget& budget) {
  for (std::size_t i = 0; i < inputs.inputs.size(); ++i) {
    const Responses& r = responses[i];
    InputNeed need{std::string(kInputNames[inputs.inputs[i]]), inputs.values[i],
                   later * r.displacement_largest / inputs.scales[i], drift_later * r.drift_final / inputs.scales[i],
                   std::nullopt};
    const bool of_earth = need.name == "latitude_deg" || need.name == "rotation_rate_rad_s";
    const double moved = of_earth ? need.drift_per_unit_rad : need.displacement_per_unit_rad;
    if (moved > 0) need.hides_earth = share_of(budget.earth_drift_rad, moved);
    budget.inputs.push_back(need);
  }
}

/// Everything that a budget needs, before anything is integrated.
struct Preparation {
  std::vector<Candidate> candidates;
  InputDerivatives inputs;  ///< none where the Earth does not turn
  std::vector<ProblemDerivative> all;
  double time_s;
  Responding by;
  double drift_seconds;

  explicit Preparation(const Scene& scene)
      : candidates(effect_candidates(scene)),
        inputs(scene.rotation_rate_rad_s() != 0 && !scene.scenario().travel ? input_derivatives(scene) : InputDerivatives()),
        all(all_inputs(candidates, inputs)),
        time_s(followed_time(scene)),
        by(responding(scene, time_s, all, candidates.size())),
        drift_seconds(earthtop::drift_seconds(scene, time_s)) {}
};

/// The variations that size the effects are those of a body on a pivot.
void require_sizes(const Scene& scene) {
  const Support& support = scene.support();
  if (!support.no_effect_sizes.empty()) throw ScenarioError(std::string(support.pointer), std::string(support.no_effect_sizes));
}

/// Whether the budget states torques and the drift of all effects together: the variations start from one rate of the laboratory, and are
/// those of a single body.
bool is_of_torques(const Scene& scene) {
  const auto& travel = scene.scenario().travel;
  return scene.support().has_moving_parts() || (travel && travel->reference == TravelReference::at_rest);
}

}  // namespace

double budget_seconds(const Scene& scene) {
  if (is_of_torques(scene)) return torque_budget_seconds(scene);
  require_sizes(scene);
  const Preparation prepared(scene);
  return prepared.by.seconds + prepared.drift_seconds;
}

Budget effect_budget(const Scene& scene, const Watch& watch) {
  if (is_of_torques(scene)) return torque_budget(scene, watch);
  require_sizes(scene);
  const NaturalUnits& units = scene.problem_without_rows<double>().units;
  const Preparation prepared(scene);
  const std::vector<Candidate>& candidates = prepared.candidates;
  Parts parts(watch, prepared.by.seconds + prepared.drift_seconds);
  Budget budget;
  const SizedUp up =
      size_up(scene, candidates, prepared.all, prepared.time_s, prepared.by, parts.next(prepared.by.seconds, "effects"));
  budget.followed_s = up.reached_s;
  const bool completed = up.drift.status == RunStatus::completed, known = completed && budget.followed_s > 0;
  const double later = budget.followed_s > 0 ? scene.scenario().duration_s / budget.followed_s : 1;
  const double drift_later = drift_growth(scene, budget.followed_s, later, parts.next(prepared.drift_seconds, "drift"));
  budget.earth_drift_rad = known ? drift_later * up.drift.axis.value : std::numeric_limits<double>::quiet_NaN();
  std::size_t next = 0;  // index of the next candidate; candidates are in the catalogue's order
  for (const Effect& effect : all_effects()) {
    if (!effect.is_in_budget(scene)) continue;
    const bool is_sized = next < candidates.size() && candidates[next].effect == &effect;
    budget.effects.push_back(is_sized ? entry_of(scene, candidates[next], up.effects[next], units, later, drift_later)
                                      : unsized_entry(effect, scene));
    if (is_sized) ++next;
  }
  budget.warnings = warnings_of(budget.effects);
  if (!known)
    budget.warnings.push_back(
        fmt::format("the motion could be followed for {:.4g} s only ({}), so that the drifts are not known", budget.followed_s,
                    completed ? "dry friction has no direction at rest" : to_string(up.drift.status)));
  if (scene.rotation_rate_rad_s() == 0)
    budget.inputs_unavailable = "the Earth does not turn, so that there is no effect to see";
  else if (scene.scenario().travel)
    budget.inputs_unavailable = "on a journey they are found by runs: give /report/sensitivities true";
  else if (!known || up.inputs_status != RunStatus::completed)
    budget.inputs_unavailable = "the drift is not known";
  else
    add_inputs(prepared.inputs, std::span(up.drift.responses).subspan(candidates.size()), later, drift_later, budget);
  return budget;
}

}  // namespace earthtop
