// SPDX-License-Identifier: GPL-3.0-or-later
// "auto": what a scene needs at the accuracy asked for.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "budget/candidates.hpp"
#include "drift/stability.hpp"
#include "earthtop/budget/budget.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "scenario/pace.hpp"
#include "scenario/work.hpp"

namespace earthtop {
namespace {

constexpr double kChoiceTolerance = 1e-4;  // of the variations: one digit of a size is enough
// rad of the fastest rate, of a motion next to one in closed form: an effect of both predictions changes their difference by no
// more than its displacement of each times the drift, which both grow with the time; one of the Earth's rate with the time.
constexpr double kRegularPhase = 300;
constexpr double kLongestPhase = 3e5;  // rad, of any other motion: some ten seconds of computing; beyond, nothing is known
constexpr double kSafety = 3;
constexpr double kShare = 0.2;  // of the accuracy asked for: what each effect left out may cost of it

using Problem = DriftProblem<double>;

void switch_on(Scenario& scenario, std::string_view name) {
  if (name == "gravity_gradient") scenario.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  if (name == "tide") scenario.effects.tide = TideSpec{};
  if (name == "polar_motion") scenario.site.pole = secular_pole(julian_epoch_year(*parse_utc(*scenario.start_utc)));
}

/// The part of the duration that says enough; none where the motion is too long to follow.
std::optional<double> followed_share(const Scenario& scenario, const Problem& problem) {
  const double phase = std::max(fastest_rate_rad_s(scenario) * scenario.duration_s, pace_of(scenario).damping);
  const bool regular = is_regular(problem);
  if (!regular && phase > kLongestPhase) return std::nullopt;
  return regular ? std::min(1.0, kRegularPhase / phase) : 1;
}

/// By how much each effect changes the drift, to the safe side; without end where nothing is known.
std::vector<double> changes_of(const Scenario& scenario, const Problem& problem, const std::vector<Candidate>& candidates,
                               const Watch& watch) {
  std::vector<double> changes(candidates.size(), HUGE_VAL);
  const auto followed = followed_share(scenario, problem);
  if (!followed) return changes;
  const double share = *followed;
  std::vector<ProblemDerivative> inputs;
  inputs.reserve(candidates.size());
  for (const Candidate& candidate : candidates) inputs.push_back(candidate.input);
  const DriftSensitivity drift = drift_sensitivity(problem, inputs, share * scenario.duration_s, kChoiceTolerance, watch);
  if (drift.status != RunStatus::completed) return changes;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const double later = candidates[i].in_difference ? 1 / share : 1 / (share * share);
    const double change = kSafety * later * candidates[i].size * drift.responses[i].drift_largest;
    if (std::isfinite(change)) changes[i] = change;
  }
  return changes;
}

}  // namespace

double selection_work(const Scenario& scenario) {
  const auto problem = make_problem<double>(scenario);
  const auto share = followed_share(scenario, problem);
  return share ? sensitivity_work(scenario, *share * scenario.duration_s, kChoiceTolerance,
                                  selectable_effects(scenario, problem).size())
               : 0;
}

Selection select_effects(Scenario& scenario, const Watch& watch) {
  const auto start = std::chrono::steady_clock::now();
  Selection selection;
  selection.accuracy_rad = scenario.accuracy_rad.value_or(0);
  // What is switched on moves the top to where others may matter: they are asked again.
  constexpr double kLastRound = 0.5;
  double done = 0;
  for (bool changed = true; changed && !watch.asks_to_stop();) {
    changed = false;
    const double next = done + kLastRound * (1 - done);
    const Watch round = watch.part(done, next);
    done = next;
    const auto problem = make_problem<double>(scenario);
    const std::vector<Candidate> candidates = selectable_effects(scenario, problem);
    const std::vector<double> changes = changes_of(scenario, problem, candidates, round);
    selection.left_out.clear();
    selection.left_out_drift_rad = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (changes[i] <= kShare * selection.accuracy_rad) {
        selection.left_out.push_back(candidates[i].name);
        selection.left_out_drift_rad += changes[i];
      } else {
        switch_on(scenario, candidates[i].name);
        selection.switched_on.push_back(candidates[i].name);
        changed = true;
      }
    }
    changed = changed && !selection.left_out.empty();
  }
  selection.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return selection;
}

}  // namespace earthtop
