// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/seen_motion.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "run/look_between.hpp"

namespace earthtop {
namespace {

/// The steps that a run finds at its rows: to search for them at all looks would take far longer.
std::optional<KickSteps> kick_steps_of(const Scene& scene, const IntegrationOptions& options, const Watch& watch) {
  if (options.method != Method::long_horizon) return std::nullopt;
  DriftProblem<double> problem = scene.problem_without_rows<double>();
  problem.threshold_rad.reset();
  return integrate_drift(problem, options, watch.with_progress(nullptr)).kick_steps;
}

}  // namespace

SeenMotion look_at_motion(const Scene& scene, double until_s, double checked_s, const Watch& watch) {
  constexpr int kLastLooks = 6000;  // five hundred swings
  const IntegrationOptions& options = scene.choice().options;
  const PicturePlan plan = plan_looks(scene, options).picture;
  std::vector<double> last_s;
  if (plan.looks_a_window > 0)
    for (int k = kLastLooks; k >= 0; --k) last_s.push_back(until_s - k * plan.step_s);
  // The purposes of these looks have no names of their own: those of a run's looks tell them apart.
  constexpr LookFor kChecked = LookFor::row, kLast = LookFor::trend;
  Looks looks;
  looks.add(plan.times_s, LookFor::picture);
  looks.add(last_s, kLast);
  looks.add(std::vector{checked_s}, kChecked);
  std::vector<double> times_s = looks.times_s;
  std::erase_if(times_s, [&](double t_s) { return t_s > until_s; });
  const DriftTrajectory<double> trajectory =
      look_again(scene, std::move(times_s), options, {kick_steps_of(scene, options, watch)}, watch.with_progress(nullptr));
  SeenMotion seen;
  seen.a_window = plan.looks_a_window;
  const std::vector<DriftRow> rows = rows_of(scene, trajectory.contact_events, trajectory.samples);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (looks.serves(i, LookFor::picture)) seen.looks.push_back(rows[i]);
    if (looks.serves(i, kLast)) seen.last.push_back(rows[i]);
    if (looks.serves(i, kChecked)) seen.checked = rows[i];
  }
  return seen;
}

double seconds_to_look(const Scene& scene) { return scene.cost(scene.choice().options).seconds; }

}  // namespace earthtop
