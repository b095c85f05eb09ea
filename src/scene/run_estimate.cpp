// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the cost of a whole run in advance, and refuses scenes that are too expensive.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/sensitivity_route.hpp"
#include "scene/support_laws.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

/// Returns the time (s) of one evaluation of a motion with three disturbances, as measured.
double seconds_a_variation(const Scene& scene) {
  const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
  if (scene.is_plain() && scene.symmetry_axis() < 0) return 3e-7;
  return applied.friction() || applied.gimbal ? 1.1e-6 : 8e-7;
}

/// Measured times for one output row (s): `integrated` for the row in an integration, with its drift measures and its counted
/// turns; `assessed` for its invariants, or for its ledger entry.
struct RowSeconds {
  double integrated, assessed;
};
RowSeconds seconds_a_row(Precision precision) {
  return precision == Precision::bits53 ? RowSeconds{7e-7, 1e-6} : RowSeconds{3e-5, 1e-4};
}

}  // namespace

Work PivotLaws::growth_work(const Scene& scene) const {
  MotionProblem<double> problem = scene.problem_without_rows<double>();
  const auto tolerance = growth_tolerance(problem, scene.scenario().duration_s);
  if (!tolerance) return {};
  problem.pace = scene.pace();
  const Work work = earthtop::growth_work(problem, scene.scenario().duration_s, *tolerance);
  const double motions = !scene.has_drift() ? 1 : 2;
  const double share = std::min(1.0, static_cast<double>(kMostGrowthSteps) / work.steps);
  return {motions * share * work.steps, motions * share * work.evaluations};
}

RunEstimate estimate_run(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const auto& [first, second] = scene.costs();
  RunEstimate estimate{first.work, second.work, laws_of(scene).growth_work(scene), {}};
  const RowSeconds row = seconds_a_row(scenario.precision);
  RunSeconds& seconds = estimate.seconds;
  seconds.solution = first.seconds + row.integrated * scene.rows();
  seconds.bound = second.seconds + row.integrated * scene.rows();
  seconds.rows = row.assessed * scene.rows();
  // The drift is computed anew at the times of the largest values in half of the runs. Where windows stand for a long run, as much goes into
  // the looks of smaller ones, which begin at stops; a long_horizon also has to look at all of them first.
  constexpr double kAnew = 0.5, kFar = 1.5;
  const IntegrationOptions& chosen = scene.choice().options;
  seconds.largest = row.assessed * picture_looks(scene) +
                    seconds_looking(scene, chosen) * (chosen.method == Method::long_horizon ? kFar : kAnew);
  seconds.growth = seconds_a_variation(scene) * estimate.growth.evaluations;
  if (scenario.ledger) seconds.ledger = row.assessed * scene.rows();
  if (scenario.sensitivities)
    if (const SensitivityPlan plan = plan_sensitivities(scene, scenario.duration_s); plan.refusal.empty())
      seconds.sensitivities = plan.seconds;
  return estimate;
}

double times_held(const Scene& scene, bool between) {
  return 2 + scene.rows() + kJudgementLooks + (between ? picture_looks(scene) : 0);
}

std::string about_seconds(double seconds, double limit_s) {
  const auto in = [&](double unit_s, const char* name) {
    return fmt::format("about {} {}", told_apart(seconds / unit_s, limit_s / unit_s, 2).first, name);
  };
  if (seconds < 0.1) return "less than 0.1 s";
  if (seconds < 100) return in(1, "s");
  if (seconds < 7200) return in(60, "minutes");
  if (seconds < 2 * 86400) return in(3600, "hours");
  return in(86400, "days");
}

std::string PivotLaws::too_stiff(const Scene& scene, const std::string& work) const {
  const StiffFriction& stiffest = scene.stiffest_friction();
  return fmt::format(
      "this friction is too stiff: it damps at about {:.1e} 1/s (coefficient over moment of inertia), {:.1e} time "
      "constants within the duration, of which a step of an explicit method covers a few: {}; at most an hour is "
      "allowed; take a smaller coefficient or a shorter duration; a motion so strongly damped stands still, or "
      "creeps at the rate torque / coefficient",
      stiffest.damping / scene.scenario().duration_s, stiffest.damping, work);
}

void refuse_unaffordable(const Scene& scene) {
  if (is_too_short_to_look(scene)) return;
  // A motion that turns has to be followed; a motion that friction merely holds still does not justify hours of computing.
  constexpr double kStiff_s = 3600, kDay_s = 86400, kNearlyAll = 0.9;
  const Scenario& scenario = scene.scenario();
  const IntegrationOptions& options = scene.choice().options;
  const double first = scene.costs()[0].work.steps, second = scene.costs()[1].work.steps;
  const auto limit = static_cast<double>(scenario.numerics.step_limit);
  const bool within = first <= limit && second <= std::max(limit, static_cast<double>(IntegrationOptions{}.step_limit));
  const bool friction = scenario.effects.applied.friction() || scene.support().may_damp;
  const bool stiff = friction && !options.step_s && damping_steps(scene.pace_by_rule(), options) > kNearlyAll * first;
  if (within && !stiff && scenario.precision == Precision::bits53) return;

  const double steps = std::min(std::max(first, second), 1e300);
  const double seconds = std::min(scene.estimate().seconds.all(), 1e300);
  const auto [needed, most] = told_apart(steps, limit, 2, 'e');
  const std::string work =
      fmt::format("about {} steps, {} of computing", needed, about_seconds(seconds, stiff ? kStiff_s : kDay_s));
  if (stiff && !(within && seconds <= kStiff_s))
    throw ScenarioError(std::string(scene.stiffest_friction().pointer), laws_of(scene).too_stiff(scene, work));
  if (!within)
    throw ScenarioError(
        "/motion/duration_s",
        fmt::format("this scenario needs {}; at most {} steps are allowed; take a shorter duration, a slower spin or a looser "
                    "tolerance",
                    work, most));
  if (scenario.precision != Precision::bits53 && !(seconds <= kDay_s))
    throw ScenarioError("/motion/duration_s",
                        fmt::format("in {} this scenario needs {}; at most one day is allowed; take a shorter duration, a "
                                    "slower spin, a looser tolerance or less precision",
                                    to_string(scenario.precision), work));
}

}  // namespace earthtop
