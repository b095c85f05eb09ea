// SPDX-License-Identifier: GPL-3.0-or-later
// The choice "auto": which effects a scene needs at the requested accuracy.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "budget/effects.hpp"
#include "drift/stability.hpp"
#include "earthtop/budget/budget.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "scene/sensitivity_route.hpp"

namespace earthtop {
namespace {

constexpr double kChoiceTolerance = 1e-4;  // tolerance of the variations: one digit of a size is enough
// Phase of the fastest rate (rad) to which a motion close to a closed form is followed. Later times are extrapolated: an effect
// that acts in both predictions changes their difference by at most its displacement of each times the drift, and both grow in
// proportion to the time; the change due to an effect on the Earth's rate is itself proportional to the time.
constexpr double kRegularPhase = 300;
constexpr double kLongestPhase = 3e5;  // the same for any other motion (rad), some ten seconds; longer ones are not followed
constexpr double kSafety = 3;
constexpr double kShare = 0.2;  // largest share of the requested accuracy that an effect left out may take

/// Returns the share of the duration that has to be followed; empty if the motion is too long to follow.
std::optional<double> followed_share(const Scene& scene) {
  const double phase = std::max(scene.fastest_rate_rad_s() * scene.scenario().duration_s, scene.pace_by_rule().damping);
  const bool regular = is_regular(scene.problem_without_rows<double>());
  if (!regular && phase > kLongestPhase) return std::nullopt;
  return regular ? std::min(1.0, kRegularPhase / phase) : 1;
}

/// Returns an upper estimate of each effect's change of the drift (rad); infinite where nothing is known.
std::vector<double> changes_of(const Scene& scene, const std::vector<Candidate>& candidates, const Watch& watch) {
  std::vector<double> changes(candidates.size(), HUGE_VAL);
  const auto followed = followed_share(scene);
  if (!followed) return changes;
  const double share = *followed;
  std::vector<ProblemDerivative> inputs;
  inputs.reserve(candidates.size());
  for (const Candidate& candidate : candidates) inputs.push_back(candidate.input);
  const DriftSensitivity drift =
      drift_sensitivity(scene.problem_without_rows<double>(), inputs, share * scene.scenario().duration_s, kChoiceTolerance,
                        watch, SensitivitySought::responses);
  if (drift.status != RunStatus::completed) return changes;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const double later = candidates[i].in_difference ? 1 / share : 1 / (share * share);
    const double change = kSafety * later * candidates[i].size * drift.responses[i].drift_largest;
    if (std::isfinite(change)) changes[i] = change;
  }
  return changes;
}

}  // namespace

double selection_seconds(const Scene& scene) {
  const auto share = followed_share(scene);
  return share ? variations_seconds(scene, *share * scene.scenario().duration_s, kChoiceTolerance,
                                    selectable_effects(scene).size())
               : 0;
}

Selection select_effects(Scene& scene, const Watch& watch) {
  const auto start = std::chrono::steady_clock::now();
  Selection selection;
  selection.accuracy_rad = scene.scenario().accuracy_rad.value_or(0);
  // An effect that is switched on changes the motion, so that other effects may matter: the rest are sized again.
  constexpr double kLastRound = 0.5;
  double done = 0;
  for (bool changed = true; changed && !watch.asks_to_stop();) {
    changed = false;
    const double next = done + kLastRound * (1 - done);
    const Watch round = watch.part(done, next);
    done = next;
    const std::vector<Candidate> candidates = selectable_effects(scene);
    const std::vector<double> changes = changes_of(scene, candidates, round);
    Scenario chosen = scene.scenario();
    selection.left_out.clear();
    selection.left_out_drift_rad = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (changes[i] <= kShare * selection.accuracy_rad) {
        selection.left_out.emplace_back(candidates[i].effect->name);
        selection.left_out_drift_rad += changes[i];
      } else {
        candidates[i].effect->switch_on(chosen);
        selection.switched_on.emplace_back(candidates[i].effect->name);
        changed = true;
      }
    }
    if (changed) scene = resolve(std::move(chosen));
    changed = changed && !selection.left_out.empty();
  }
  selection.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return selection;
}

std::optional<Budget> explain_effects(Scene& scene, const Watch& watch) {
  const double choice = scene.scenario().effects.automatic ? selection_seconds(scene) : 0;
  Parts parts(watch, choice + budget_seconds(scene));
  if (scene.scenario().effects.automatic) select_effects(scene, parts.next(choice, "choice of effects"));
  std::optional<Budget> budget = effect_budget(scene, parts.next(budget_seconds(scene)));
  if (watch.asks_to_stop()) budget.reset();
  return budget;
}

}  // namespace earthtop
