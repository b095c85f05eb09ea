// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "earthtop/results/results.hpp"
#include "results/time_unit.hpp"
#include "results/turns.hpp"

namespace earthtop {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Unit {
  const char* name;
  double per_rad;  ///< number of these units in a radian
};

Unit angle_unit(double largest_rad) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  if (largest_rad >= 1 / kDegrees) return {"degrees", kDegrees};
  return {"arcseconds", 3600 * kDegrees};
}

/// The motion as it is drawn: at looks that resolve it; at the rows where there are none, as for a run that was interrupted.
const std::vector<DriftRow>& rows_drawn(const RunResult& result) {
  return result.looks.size() > 1 ? result.looks : result.rows;
}

Line make_line(const RunResult& result, const char* label, LineColor color, LineStyle style, TimeUnit time) {
  Line line{label, {}, {}, color, style};
  line.a_column = result.looks.size() > 1 ? result.looks_a_window : 0;
  line.x.reserve(rows_drawn(result).size());
  line.y.reserve(rows_drawn(result).size());
  for (const DriftRow& row : rows_drawn(result)) line.x.push_back(row.t_s * time.per_s);
  return line;
}

/// Looks are samples of a smooth motion; rows may be too far apart to tell where it turns.
void turn_smoothly(const RunResult& result, Line& line, std::span<const std::vector<double>> parts = {}) {
  if (result.looks.size() > 1) move_to_turns(line.x, line.y, parts);
}

/// The difference of the two axes; it is not exact, but serves to find where they are nearest.
std::array<std::vector<double>, 3> axes_apart(const RunResult& result) {
  std::array<std::vector<double>, 3> apart;
  for (std::size_t k = 0; k < apart.size(); ++k) {
    apart[k].reserve(result.looks.size());
    for (const DriftRow& row : result.looks) apart[k].push_back(row.axis_L[k] - row.ref_axis_L[k]);
  }
  return apart;
}

/// The larger of a and |b|, for the range of a picture; b is left out where it is not finite, since it is not drawn either.
double largest(double a, double b) { return std::isfinite(b) ? std::max(a, std::abs(b)) : a; }

Panel axis_panel(const RunResult& result, TimeUnit time) {
  double size = 0;
  for (const DriftRow& row : rows_drawn(result)) size = largest(size, row.drift_axis_rad);
  const Unit unit = angle_unit(size);
  Line drift = make_line(result, "drift", LineColor::blue, LineStyle::solid, time);
  Line bound = make_line(result, "bound on its error", LineColor::vermillion, LineStyle::filled, time);
  Line unreliable = make_line(result, "not reliable", LineColor::grey, LineStyle::dashed, time);
  for (const DriftRow& row : rows_drawn(result)) {
    const double angle = row.drift_axis_rad * unit.per_rad;
    drift.y.push_back(row.drift_reliable ? angle : kNone);
    unreliable.y.push_back(row.drift_reliable ? kNone : angle);
    bound.y.push_back(row.drift_axis_bound_rad * unit.per_rad);
  }
  const std::array<std::vector<double>, 3> apart = axes_apart(result);
  for (Line* line : {&drift, &unreliable}) turn_smoothly(result, *line, apart);
  std::vector<Line> lines{std::move(bound), std::move(drift)};
  if (!is_all_reliable(result)) lines.push_back(std::move(unreliable));
  return {{"Angle between the two spin axes", unit.name, AxisScale::logarithmic}, std::move(lines)};
}

Panel parts_panel(const RunResult& result, TimeUnit time) {
  double size = 0;
  for (const DriftRow& row : rows_drawn(result))
    size = largest(largest(size, row.drift_tilt_rad), row.drift_azimuth_rad.value_or(0));
  const Unit unit = angle_unit(size);
  Line azimuth = make_line(result, "azimuth, clockwise", LineColor::blue, LineStyle::solid, time);
  Line tilt = make_line(result, "tilt, from the vertical", LineColor::orange, LineStyle::solid, time);
  for (const DriftRow& row : rows_drawn(result)) {
    azimuth.y.push_back(row.drift_azimuth_rad.value_or(kNone) * unit.per_rad);
    tilt.y.push_back(row.drift_tilt_rad * unit.per_rad);
  }
  for (Line* line : {&azimuth, &tilt}) turn_smoothly(result, *line);
  std::vector<Line> lines{std::move(azimuth), std::move(tilt)};
  return {{"Drift in azimuth and in tilt", unit.name, AxisScale::linear}, std::move(lines)};
}

}  // namespace

Figure drift_figure(const RunResult& result) {
  const Scenario& scenario = result.scene.scenario();
  const TimeUnit time = time_unit(rows_drawn(result).empty() ? scenario.duration_s : rows_drawn(result).back().t_s);
  // One part after the other: of a whole that is begun when memory ends, g++ 12 destroys parts twice.
  Figure figure;
  figure.title = scenario.title.empty() ? scenario.name : scenario.title;
  figure.subtitle = "Rotating minus non-rotating Earth; " + matching_rule(scenario);
  figure.x = {"Time", time.name};
  figure.panels.push_back(axis_panel(result, time));
  figure.panels.push_back(parts_panel(result, time));
  return figure;
}

}  // namespace earthtop
