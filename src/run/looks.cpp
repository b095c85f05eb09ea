// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/looks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drift/motion_way.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

/// Returns times at which the errors of a run are judged. They begin close together, since bounds grow from the release onward, and are
/// shifted within their intervals by multiples of the golden ratio, so that no nutation is seen at one phase only.
std::vector<double> judgement_times(double duration_s, int looks) {
  std::vector<double> times{0};
  for (int k = 1; k < looks; ++k) {
    const double turn = k / std::numbers::phi, share = (k - 0.5 + 0.9 * (turn - std::floor(turn) - 0.5)) / looks;
    times.push_back(duration_s * share * share);
  }
  times.push_back(duration_s);
  return times;
}

/// Returns the number of windows of a long run: enough for twelve in each turn of the precession, or, where it turns too often for that, so
/// many that successive windows see it at phases in the golden ratio, and any dozen of them all its phases.
std::size_t windows_of(double turns, std::size_t most) {
  constexpr auto kFewest = static_cast<std::size_t>(kFewestWindows);
  constexpr double kGolden = std::numbers::phi - 1;
  most = std::max(most, kFewest);
  if (kWindowsATurn * turns <= static_cast<double>(most))
    return std::max(kFewest, static_cast<std::size_t>(std::ceil(kWindowsATurn * turns)));
  std::size_t best = most;
  double nearest = 1;
  for (std::size_t windows = most - most / 4; windows <= most; ++windows) {
    const double step = turns / static_cast<double>(windows - 1), phase = step - std::floor(step);
    const double away = std::min(std::abs(phase - kGolden), std::abs(phase - (1 - kGolden)));
    if (away < nearest) nearest = away, best = windows;
  }
  return best;
}

/// Returns the period (s) of the nutation of a body with this momentum about its largest moment: that of a long body, or of one in which a
/// rotor turns, takes many periods of its fastest part.
double slow_nutation_s(const Scene& scene) {
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const double momentum = norm(Vec3<double>(inertia * scene.release<double>().w_XB_B + rotor_momentum(scene)));
  return 2 * std::numbers::pi * inertia.diagonal().maxCoeff() / momentum;
}

PicturePlan plan_pictures(const Scene& scene, const std::optional<TrendFrequencies>& known) {
  constexpr double kLooksAPeriod = 12;
  constexpr double kOfBound = 3;      // the rate is an upper bound: three of its periods are at least one of the motion
  constexpr double kMostBounds = 16;  // of a body whose parts turn at rates far apart
  PicturePlan plan;
  const double duration = scene.scenario().duration_s;
  const double bound = 2 * std::numbers::pi / scene.pace().axis_rate_rad_s;
  double period = bound, window = kOfBound * bound;
  if (known) {
    const double exact = 2 * std::numbers::pi / std::max(known->nutation_rad_s, std::abs(known->precession_rad_s));
    // A motion that is far from a sine has faster parts, which the bound knows of.
    period = std::clamp(exact, bound, 1.5 * bound);
    window = std::min(window, std::max(exact, bound));
  } else if (scene.symmetry_axis() < 0 && !scene.support().has_contact) {
    window = std::max(window, std::min(slow_nutation_s(scene), kMostBounds * bound));
  }
  const double step = period / kLooksAPeriod;
  const double count = std::max(std::ceil(duration / step), 2 * kLooksAPeriod);
  if (count <= kMostPictureLooks) {
    plan.step_s = duration / count;
    for (double k = 0; k <= count; ++k) plan.times_s.push_back(k == count ? duration : duration * (k / count));
    return plan;
  }
  // Two looks more than a period has: the largest value may lie between the last look and the first.
  plan.looks_a_window = static_cast<std::size_t>(std::ceil(window / step)) + 3;
  plan.step_s = step;
  const double length = step * static_cast<double>(plan.looks_a_window - 1);
  constexpr double kUnknown = 50;  // turns that are followed where it is not known how many there are
  const double turns = known ? duration * std::abs(known->precession_rad_s) / (2 * std::numbers::pi) : kUnknown;
  const std::size_t windows = windows_of(turns, static_cast<std::size_t>(kMostPictureLooks) / plan.looks_a_window);
  for (std::size_t w = 0; w < windows; ++w)
    for (std::size_t k = 0; k < plan.looks_a_window; ++k) {
      const bool ends = w + 1 == windows && k + 1 == plan.looks_a_window;
      const double begin = (duration - length) * (static_cast<double>(w) / static_cast<double>(windows - 1));
      plan.times_s.push_back(ends ? duration : begin + step * static_cast<double>(k));
    }
  return plan;
}

/// Returns how many looks do not follow another one within a period of the axis's fastest motion.
double looks_aside(const Scene& scene, std::span<const double> times_s) {
  const double apart = 2 * std::numbers::pi / scene.pace().axis_rate_rad_s;
  double count = 0;
  for (std::size_t i = 1; i < times_s.size(); ++i) count += times_s[i] - times_s[i - 1] > apart ? 1 : 0;
  return count;
}

}  // namespace

void Looks::add(std::span<const double> added_s, LookFor purpose) {
  const auto bit = static_cast<std::uint8_t>(purpose);
  Looks merged;
  merged.times_s.reserve(size() + added_s.size()), merged.purposes.reserve(size() + added_s.size());
  std::size_t i = 0, j = 0;
  while (i < size() || j < added_s.size()) {
    const bool has_old = j == added_s.size() || (i < size() && times_s[i] <= added_s[j]);
    const bool has_new = i == size() || (j < added_s.size() && added_s[j] <= times_s[i]);
    merged.times_s.push_back(has_old ? times_s[i] : added_s[j]);
    merged.purposes.push_back(static_cast<std::uint8_t>((has_old ? purposes[i] : 0) | (has_new ? bit : 0)));
    if (has_old) ++i;
    if (has_new) ++j;
  }
  *this = std::move(merged);
}

Looks Looks::compared(std::size_t count) const {
  Looks part;
  for (std::size_t i = 0; i < std::min(count, size()); ++i) {
    if (!serves(i, LookFor::row) && !serves(i, LookFor::judgement)) continue;
    part.times_s.push_back(times_s[i]);
    part.purposes.push_back(purposes[i]);
  }
  return part;
}

LookPlan plan_looks(const Scene& scene, const IntegrationOptions& first) {
  LookPlan plan{plan_trend(scene), {}, {}};
  plan.picture = plan_pictures(scene, plan.trend.frequencies);
  if (!ends_steps_at_rows(first.method))
    plan.judged_s = judgement_times(scene.scenario().duration_s, judgement_looks(first.method));
  return plan;
}

const JudgedLook& judged_at(std::span<const JudgedLook> judged, double t_s) {
  const auto look = std::ranges::lower_bound(judged, t_s, {}, &JudgedLook::t_s);
  return look == judged.end() ? judged.back() : *look;
}

void take_bounds(std::span<const JudgedLook> judged, DriftRow& row) {
  const JudgedLook& bounds = judged_at(judged, row.t_s);
  row.drift_axis_bound_rad = bounds.axis_bound_rad, row.drift_attitude_bound_rad = bounds.attitude_bound_rad;
  if (row.contact) row.contact->drift_tip_bound_m = bounds.tip_bound_m;
  if (row.gimbals && bounds.gimbals) {
    row.gimbals->drift_outer_angle_bound_rad = bounds.gimbals->outer_bound_rad;
    row.gimbals->drift_inner_angle_bound_rad = bounds.gimbals->inner_bound_rad;
  }
  if (!row.rotor) return;
  row.rotor->drift_axis_bound_rad = bounds.watched_axis_bound_rad();
  if (!bounds.rotor) return;
  row.rotor->drift_rate_bound_rad_s = bounds.rotor->rate_bound_rad_s;
  row.rotor->drift_angle_bound_rad = bounds.rotor->angle_bound_rad;
}

bool looks_between_rows(const IntegrationOptions& first, Precision precision) {
  const bool is_dense = row_of(first.method).cost.evaluations_a_row == 1 || is_exact(first.method);
  return is_dense && precision == Precision::bits53;
}

std::shared_ptr<MotionWay> LookMemory::new_way() { return std::make_shared<MotionWay>(); }

DriftTrajectory<double> look_again(const Scene& scene, std::vector<double> times_s, const IntegrationOptions& first,
                                   const LookMemory& memory, const Watch& watch) {
  DriftProblem<double> problem = scene.problem_without_rows<double>();
  problem.times_s = std::move(times_s);
  problem.threshold_rad.reset();
  problem.way = memory.way, problem.are_looks = true;
  if (!memory.way->looked_by) {
    const auto looks = static_cast<double>(problem.times_s.size());
    IntegrationOptions known = first;
    known.kick_steps = memory.kick_steps;
    memory.way->looked_by = options_for_looks(scene, known, looks, looks_aside(scene, problem.times_s));
  }
  const LookTimer timer(*memory.way);
  return integrate_drift(problem, *memory.way->looked_by, watch);
}

}  // namespace earthtop
