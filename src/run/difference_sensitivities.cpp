// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/difference_sensitivities.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "scene/moved_input.hpp"
#include "scene/sensitivity_route.hpp"

namespace earthtop {
namespace {

constexpr int kQuantities = 4;  // axis, attitude, tilt, azimuth
using Quantities = std::array<double, kQuantities>;

constexpr int kLevels = 10;          // most steps tried, each a fourth of the one before
constexpr double kRatio = 4;         // of two steps
constexpr double kLargest = 0x1p-6;  // first step, as a share of the input's scale
constexpr double kPhaseStep = 0.25;  // rad: by which a step changes a phase
constexpr double kClose = 1e-9;      // difference of two extrapolations, as a share, that ends the search
constexpr double kGood = 1e-6;       // error of a derivative, as a share, for which no finer steps are tried
constexpr double kUnsettled = 0.1;   // difference of two extrapolations, as a share, above which there is no derivative
constexpr double kNoiseSafety = 4;   // times the largest second difference seen, for the noise of a drift
constexpr double kProbe = 0.004;     // rad: so small a change of the fastest phase that a drift's curvature does not show
constexpr std::size_t kProbed[] = {0, 1, 2};  // latitude, gravity and spin; a body in gimbals has none
constexpr double kDriftRounding = 1e-13;      // of a drift, as a share: what a bound leaves out

/// A derivative and a bound on its error.
struct Estimate {
  Quantities value{};
  Quantities error{};
  bool settled = false;  ///< whether the differences come together
};

class Differences {
 public:
  Differences(const Scene& scene, double time_s, const DriftBounds& bounds)
      : base_(scene_for_differences(scene)), time_s_(time_s), phases_(phases_until(scene, time_s)) {
    options_ = base_.choice().options;
    bounds_ = {bounds.axis, bounds.attitude, bounds.axis, bounds.axis};
  }

  /// Integrates the scene itself, and scenes so near it that second differences show the noise of a drift. The drifts' errors
  /// are smooth apart from that, as all of them are integrated with the same steps. @returns whether all came to the end
  bool integrate_itself(const Watch& watch) {
    const auto drift = drift_of(base_, watch.part(0, 0.1));
    if (!drift) return false;
    has_azimuth_ = horizontal_ > 0;
    options_.kick_steps = found_;
    Quantities seen;
    for (int q = 0; q < kQuantities; ++q) seen[at(q)] = kDriftRounding * std::abs((*drift)[at(q)]);
    for (const std::size_t input : kProbed) {
      if (!has_input(base_.scenario(), input)) continue;
      const auto pair = moved_drifts(input, scale_of_input(base_, input) * kProbe / phases_.fast, watch.part(0.1, 1));
      if (!pair) return false;
      for (int q = 0; q < kQuantities; ++q)
        seen[at(q)] =
            std::max(seen[at(q)], kNoiseSafety * std::abs(pair->high[at(q)] - 2 * (*drift)[at(q)] + pair->low[at(q)]));
    }
    if (has_azimuth_) bounds_[3] /= horizontal_;
    for (int q = 0; q < kQuantities; ++q) noise_[at(q)] = std::min(seen[at(q)], bounds_[at(q)] + seen_rounding(*drift, q));
    return true;
  }
  bool has_azimuth() const { return has_azimuth_; }
  const std::string& failure() const { return failure_; }

  /// The derivatives by one input. @returns nothing where one of the scenes cannot be followed, or the watch asks to stop
  std::optional<Estimate> by(std::size_t input, const Watch& watch) {
    const double scale = scale_of_input(base_, input);
    const double coarse = std::min(kLargest, kPhaseStep / phases_.slow), fine = kPhaseStep / phases_.fast;
    const auto slow = extrapolated(input, scale, coarse, std::min(fine, coarse), watch.part(0, 0.75));
    if (!slow || fine >= last_step_) return slow;
    const auto check = difference(input, scale * fine, watch.part(0.75, 0.9));
    if (!check) return std::nullopt;
    Estimate estimate = *slow;
    for (int q = 0; q < kQuantities; ++q)
      estimate.error[at(q)] = std::max(estimate.error[at(q)], std::abs(slow->value[at(q)] - (*check)[at(q)]) +
                                                                  noise_[at(q)] / (scale * fine) + smooth_error(q, scale));
    const double noise = noise_[0] / (scale * fine);
    if (estimate.settled && estimate.error[0] <= 2 * noise + kGood * std::abs(estimate.value[0])) return estimate;
    // The drift depends on the motion's fast angles.
    const auto fast = extrapolated(input, scale, fine, 0, watch.part(0.9, 1));
    if (!fast) return std::nullopt;
    return estimate.settled && estimate.error[0] <= fast->error[0] ? estimate : *fast;
  }

 private:
  static std::size_t at(int q) { return static_cast<std::size_t>(q); }
  static double seen_rounding(const Quantities& drift, int q) { return kDriftRounding * std::abs(drift[at(q)]); }
  /// A bound on the derivative of a drift's smooth error, which depends on an input as the drift itself does.
  double smooth_error(int q, double scale) const { return bounds_[at(q)] * (1 + phases_.slow) / scale; }

  /// The drift of a scene at the time sought. @returns nothing, and says why, where it does not get there
  std::optional<Quantities> drift_of(const Scene& scene, const Watch& watch) {
    DriftProblem<double> problem = scene.problem_without_rows<double>();
    problem.times_s = {0, time_s_};
    const DriftTrajectory<double> drift = integrate_drift(problem, options_, watch);
    if (drift.status != RunStatus::completed || drift.samples.size() < 2) {
      failure_ = fmt::format("a run with a different value of it {}",
                             drift.status == RunStatus::completed ? std::string("ended earlier")
                                                                  : fmt::format("ended with {}", to_string(drift.status)));
      return std::nullopt;
    }
    const DriftMeasures<double>& m = drift.samples.back().measures;
    const double axis = watched_drift(drift.samples.back().state).angle;
    const Vec3<double> n_L = rotation_matrix(drift.samples.back().state.ref_q_LB).col(2);
    horizontal_ = m.azimuth_defined ? real::hypot(n_L[0], n_L[1]) : 0;
    found_ = drift.kick_steps;
    return Quantities{axis, m.attitude, m.tilt, m.azimuth};
  }

  /// The drifts with an input moved up and down, and the distance between the two values of the input.
  struct Pair {
    Quantities high, low;
    double distance;
  };
  std::optional<Pair> moved_drifts(std::size_t input, double step, const Watch& watch) {
    const auto moved = [&](double by, const Watch& part, double& change) -> std::optional<Quantities> {
      MovedScenario to = with_moved_input(base_, input, by);
      change = to.change;
      try {
        return drift_of(resolve(std::move(to.scenario)), part);
      } catch (const ScenarioError& error) {
        failure_ = error.what();
        return std::nullopt;
      }
    };
    double up = 0, down = 0;
    const auto high = moved(step, watch.part(0, 0.5), up);
    if (!high) return std::nullopt;
    const auto low = moved(-step, watch.part(0.5, 1), down);
    if (!low) return std::nullopt;
    return Pair{*high, *low, up - down};
  }

  /// The central difference quotient with a step.
  std::optional<Quantities> difference(std::size_t input, double step, const Watch& watch) {
    const auto pair = moved_drifts(input, step, watch);
    if (!pair) return std::nullopt;
    Quantities quotient;
    for (int q = 0; q < kQuantities; ++q) {
      double by = pair->high[at(q)] - pair->low[at(q)];
      if (q == 3) by = std::remainder(by, 2 * std::numbers::pi);
      quotient[at(q)] = by / pair->distance;
    }
    return quotient;
  }

  /// Extrapolates differences with steps from `first` on down, in units of `scale`.
  /// @param least  steps below are not taken, as the difference with it is taken anyway
  std::optional<Estimate> extrapolated(std::size_t input, double scale, double first, double least, const Watch& watch) {
    Estimate best;
    best.error.fill(HUGE_VAL);
    std::vector<Quantities> row, before;
    double step = first;
    for (int level = 0; level < kLevels; ++level, step /= kRatio) {
      if (level > 1 && step < least) break;
      const auto quotient = difference(input, scale * step, watch.part(level / 4.0, (level + 1) / 4.0));
      if (!quotient) return std::nullopt;
      last_step_ = step;
      before = std::exchange(row, {*quotient});
      double factor = 1;
      for (int j = 1; j <= level; ++j) {
        factor *= kRatio * kRatio;
        Quantities next;
        Estimate here;
        for (int q = 0; q < kQuantities; ++q) {
          const double finer = row.back()[at(q)], coarser = before[at(j - 1)][at(q)];
          next[at(q)] = finer + (finer - coarser) / (factor - 1);
          const double truncation = std::max(std::abs(next[at(q)] - finer), std::abs(next[at(q)] - coarser));
          const double noise = noise_[at(q)] / (scale * step);
          here.value[at(q)] = next[at(q)], here.error[at(q)] = truncation + noise + smooth_error(q, scale);
          if (q == 0) here.settled = truncation <= std::max(kUnsettled * std::abs(next[at(q)]), 3 * noise);
        }
        row.push_back(next);
        for (int q = 0; q < kQuantities; ++q)
          if (here.error[at(q)] < best.error[at(q)]) {
            best.value[at(q)] = here.value[at(q)], best.error[at(q)] = here.error[at(q)];
            if (q == 0) best.settled = here.settled;
          }
      }
      const double noise = noise_[0] / (scale * step), value = std::abs(best.value[0]);
      if (level > 0 && (best.error[0] <= kClose * value + 2 * noise + smooth_error(0, scale) || noise > best.error[0])) break;
    }
    return best;
  }

  Scene base_;
  double time_s_;
  Phases phases_;
  IntegrationOptions options_;
  Quantities bounds_{};  ///< on the errors of a drift
  Quantities noise_{};   ///< what of these errors is not a smooth function of the inputs
  double horizontal_ = 0, last_step_ = 0;
  bool has_azimuth_ = false;
  std::optional<KickSteps> found_;
  std::string failure_;
};

}  // namespace

std::optional<std::vector<InputSensitivity>> difference_sensitivities(const Scene& scene, double time_s,
                                                                      const DriftBounds& bounds, const Watch& watch) {
  const std::vector<std::size_t> inputs = inputs_of(scene.scenario());
  Differences differences(scene, time_s, bounds);
  const double share = 1 / (1 + 8 * double(inputs.size()));  // of one integration
  std::vector<InputSensitivity> sensitivities;
  const bool whole = differences.integrate_itself(watch.part(0, share));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (watch.asks_to_stop()) return std::nullopt;
    InputSensitivity& entry = sensitivities.emplace_back();
    entry.name = kInputNames[inputs[i]], entry.value = value_of_input(scene, inputs[i]);
    const auto part = watch.part(share * double(1 + 8 * i), share * double(9 + 8 * i));
    const auto estimate = whole ? differences.by(inputs[i], part) : std::nullopt;
    if (!estimate || !estimate->settled) {
      entry.unavailable =
          estimate ? "the drift has no derivative with respect to it: differences do not settle as their step decreases"
                   : differences.failure();
      continue;
    }
    entry.axis_rad = estimate->value[0], entry.attitude_rad = estimate->value[1], entry.tilt_rad = estimate->value[2];
    if (differences.has_azimuth()) entry.azimuth_rad = estimate->value[3];
    entry.axis_bound_rad = estimate->error[0];
  }
  if (watch.asks_to_stop()) return std::nullopt;
  return sensitivities;
}

}  // namespace earthtop
