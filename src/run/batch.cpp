// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>
#include <utility>

#include "earthtop/arithmetic.hpp"
#include "earthtop/drift/drift_lanes.hpp"
#include "earthtop/run_batch.hpp"
#include "run/assemble.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

/// A scene that is integrated in a lane, that is, side by side with others.
struct LanePoint {
  std::size_t index;  ///< index in the batch
  IntegrationOptions options;
  std::string reason;
};
/// What points side by side must share: the kind of their equations, whether they are those of a wheel in a gimbal, form, tolerance and
/// step limit.
using Shared = std::tuple<SceneKind, bool, ModelForm, double, std::int64_t>;

/// Whether the equations of a scene that is not plain can be recorded for lanes: a motion on a pivot that is smooth from the release on.
/// That of a table or of waypoints is smooth only between its points, where the steps of a lane do not end.
/// Against a laboratory that stays the laboratory's and the inertial observer's equations, by which lanes check each other, are the same.
bool can_be_recorded(const Scene& scene) {
  const Journey<double>& journey = scene.model<double>().journey;
  if (!journey.empty() && (journey.has_still_reference() || !journey.joints().empty())) return false;
  return !scene.support().has_contact && scene.scenario().effects.applied.coulomb_N_m == 0 &&
         tables_of(scene.scenario()).empty() &&
         std::ranges::none_of(scene.scenario().moving_masses,
                              [](const MovingMassSpec& mass) { return mass.motion == MassMotion::waypoints; }) &&
         scene.problem_without_rows<double>().model.kind != SceneKind::plain;
}

/// Returns whether the run of this scene is a single pair of integrations of which the first is a Taylor series, either of a
/// symmetric top without its spin or of any body in body axes.
bool fits_lanes(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const IntegrationOptions& options = scene.choice().options;
  return scenario.precision == Precision::bits53 && !scenario.accuracy_rad && !scenario.effects.automatic &&
         options.method == Method::taylor && options.observer != Observer::inertial &&
         (scene.is_plain() || can_be_recorded(scene));
}

/// Makes the point of a scene, with the form of its equations written into the options.
LanePoint lane_point(std::size_t index, const Scene& scene) {
  MethodChoice choice = scene.choice();
  choice.options.form = scene.form(choice.options);
  return {index, choice.options, std::move(choice.reason)};
}

/// Returns the options of a lane's second integration: the equations in inertial axes, in which gravity rotates, by a series of
/// another order, at ten times the first one's tolerance. As a rule its error is then the larger one by far, and the distance
/// is that error: a multiple of it contains the rows' error, and it is the cheaper way round. Nearer tolerances let both errors
/// agree by chance; others far apart widen the bound. At loose tolerances, where that bound would be too wide, the second
/// tolerance is a hundredth of the first. Because the method is the same as that of the rows, the bound is ten times the
/// distance.
IntegrationOptions second_lane_options(const IntegrationOptions& first) {
  constexpr double kLooser = 10, kFiner = 1e-2, kLoose = 5e-10;
  IntegrationOptions second = first;
  second.observer = Observer::inertial;
  const double asked = first.relative_tolerance;
  second.relative_tolerance = asked * (asked > kLoose ? kFiner : kLooser);
  return second;
}

/// Size of the nudge of the second integration's scene (units in the last place). Both integrations are series and have rounding
/// errors only, so their distance may be small by chance where the rounding of the scene itself has grown; the nudge has to be the
/// larger part of the distance. Of 285 random scenes most of which are unstable or near it, the largest share of a bound is 0.15 with
/// 8, 16 and 32 units, and with 128, which had been enough for a start, half of the bounds near a separatrix are wider by five times.
constexpr double kNudgeUnits = 16;

/// Integrates points side by side. The time reported for each is its share of the work.
std::vector<DriftTrajectory<double>> integrate_together(std::span<const DriftProblem<double>> problems,
                                                        const IntegrationOptions& options, const Watch& watch,
                                                        std::vector<double>& seconds) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<DriftTrajectory<double>> trajectories = integrate_drift_in_lanes(problems, options, watch);
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double evaluations = 0;
  for (const auto& trajectory : trajectories) evaluations += static_cast<double>(trajectory.counters.evaluations);
  for (const auto& trajectory : trajectories)
    seconds.push_back(evaluations > 0 ? all * static_cast<double>(trajectory.counters.evaluations) / evaluations : 0);
  return trajectories;
}

/// Runs points that have the same `Shared` options.
void run_in_lanes(std::span<const Scene> scenes, std::span<const LanePoint> points, const Watch& watch, bool between,
                  std::vector<BatchOutcome>& outcomes) {
  const IntegrationOptions options = points.front().options, other_options = second_lane_options(options);
  std::vector<DriftProblem<double>> problems;
  problems.reserve(points.size());
  std::vector<TwoIntegrations<double>> made(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Scene& scene = scenes[points[i].index];
    made[i].options = points[i].options;
    problems.push_back(scene.problem<double>());
    plan_first(scene, between, made[i], problems.back());
  }

  std::vector<double> seconds;
  seconds.reserve(2 * points.size());
  auto trajectories = integrate_together(problems, options, watch.part(0, 0.5), seconds);
  for (std::size_t i = 0; i < points.size(); ++i) {
    made[i].first = std::move(trajectories[i]);
    make_second(problems[i], made[i].looks, made[i].first.samples.size(), options, kNudgeUnits);
  }
  trajectories = integrate_together(problems, other_options, watch.part(0.5, 1), seconds);
  for (std::size_t i = 0; i < points.size(); ++i) {
    TwoIntegrations<double>& both = made[i];
    const Scene& scene = scenes[points[i].index];
    const Precision precision = scene.scenario().precision;
    both.second = std::move(trajectories[i]);
    both.other_options = second_lane_options(both.options);
    describe(problems[i], both.options, both.first, precision, both.solution);
    describe(problems[i], both.other_options, both.second, precision, both.certificate);
    both.solution.reason = points[i].reason + "; in SIMD lanes";
    both.solution.seconds = seconds[i];
    both.certificate.seconds = seconds[points.size() + i];
    outcomes[points[i].index].result =
        assemble_result(scene, std::move(both), {}, Parts(watch, 0), {.watch = {}, .between = between});
    both = {};
  }
}

/// The number of points, starting at the first, whose trajectories are held in memory together.
std::size_t together(std::span<const Scene> scenes, std::span<const LanePoint> points, bool between) {
  constexpr double kMostTimes = 40'000;  // in which a run can be interrupted; but the widest vectors want eight points
  constexpr std::size_t kWidest = 8;
  std::size_t count = 0;
  for (double times = 0; count < points.size(); ++count)
    if (times += times_held(scenes[points[count].index], between); times > kMostTimes && count >= kWidest) break;
  return count;
}

}  // namespace

std::vector<BatchOutcome> run_batch(std::span<const Scene> scenes, const Watch& watch, bool between) {
  require_ieee_arithmetic();
  std::vector<BatchOutcome> outcomes(scenes.size());
  std::map<Shared, std::vector<LanePoint>> lanes;
  Parts parts(watch, static_cast<double>(scenes.size()));
  const auto share_of = [&](std::size_t points) { return parts.next(static_cast<double>(points)); };
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    try {
      if (!scene.scenario().effects.automatic) {
        scene.require_integrable();
        if (fits_lanes(scene)) {
          scene.require_affordable();
          LanePoint point = lane_point(i, scene);
          const Model<double>& model = scene.problem_without_rows<double>().model;
          const Shared shared{model.kind, is_compass(model), point.options.form, point.options.relative_tolerance,
                              point.options.step_limit};
          lanes[shared].push_back(std::move(point));
          continue;
        }
      }
      outcomes[i].result = run(scene, {.watch = share_of(1), .between = between});
    } catch (const ScenarioError& refusal) {
      outcomes[i].refusal = refusal.what();
    }
  }
  for (const auto& [shared, points] : lanes)
    for (std::size_t begin = 0; begin < points.size();) {
      const std::size_t count = together(scenes, std::span(points).subspan(begin), between);
      run_in_lanes(scenes, std::span(points).subspan(begin, count), share_of(count), between, outcomes);
      begin += count;
    }
  return outcomes;
}

}  // namespace earthtop
