// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "earthtop/results/azimuth_trend.hpp"
#include "earthtop/results/results.hpp"
#include "results/drift_curves.hpp"
#include "results/time_unit.hpp"
#include "results/turns.hpp"
#include "text/number_words.hpp"
#include "text/short_number.hpp"

namespace earthtop {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kWorth = 1e-3;  // a part smaller than this share of its whole is not worth a line

double largest_of(const std::vector<double>& list) {
  double most = 0;
  for (const double number : list)
    if (std::isfinite(number)) most = std::max(most, std::abs(number));
  return most;
}

std::vector<double> scaled(std::vector<double> list, double factor) {
  for (double& number : list) number *= factor;
  return list;
}

TimeUnit unit_of_time(const DriftCurves& drawn) { return time_unit(drawn.t_s.empty() ? 0 : drawn.t_s.back()); }

/// A line over time. Looks are samples of a smooth motion; rows may be too far apart to tell where it turns.
/// @param parts  as of move_to_turns
Line line_over_time(const DriftCurves& shown, TimeUnit time, std::string label, std::vector<double> y, LineColor color,
                    LineStyle style, std::span<const std::vector<double>> parts = {}) {
  Line line{std::move(label), scaled(shown.t_s, time.per_s), std::move(y), color, style};
  line.a_column = shown.a_window;
  if (shown.is_resolved) move_to_turns(line.x, line.y, parts);
  return line;
}

/// The difference of the two axes; it is not exact, but serves to find where they are nearest.
std::array<std::vector<double>, 3> axes_apart(const DriftCurves& shown) {
  std::array<std::vector<double>, 3> apart;
  for (std::size_t k = 0; k < apart.size(); ++k) {
    apart[k].reserve(shown.t_s.size());
    for (std::size_t i = 0; i < shown.t_s.size(); ++i) apart[k].push_back(shown.axis_L[k][i] - shown.ref_axis_L[k][i]);
  }
  return apart;
}

std::string end_words(const DriftCurves::End& end, TimeUnit time) {
  const ReadableUnit unit = angle_unit(end.axis_rad);
  const double error = std::isfinite(end.bound_rad) ? end.bound_rad : 0;
  return fmt::format("{}{} at {:.4g} {}", short_number(end.axis_rad * unit.per_si, error * unit.per_si), unit.symbol,
                     end.t_s * time.per_s, time.name);
}

/// The angle between the axes and its part in tilt, in one unit.
Panel angle_panel(const DriftCurves& shown, const DriftCurves& drawn, TimeUnit time) {
  const ReadableUnit unit = angle_unit(std::max(largest_of(drawn.axis_rad), largest_of(drawn.tilt_rad)));
  std::vector<double> angle = scaled(shown.axis_rad, unit.per_si), later = angle;
  for (std::size_t i = 0; i < angle.size(); ++i) (shown.is_reliable[i] ? later : angle)[i] = kNone;
  const std::array<std::vector<double>, 3> apart = axes_apart(shown);
  Panel panel{{"Angle between the two spin axes", std::string(unit.name)}, {}};
  panel.lines.push_back(line_over_time(shown, time, "angle", std::move(angle), LineColor::blue, LineStyle::solid, apart));
  if (drawn.end && drawn.end->axis_rad > 0) panel.lines.back().end_label = end_words(*drawn.end, time);
  if (largest_of(drawn.tilt_rad) >= kWorth * largest_of(drawn.axis_rad))
    panel.lines.push_back(line_over_time(shown, time, "its part in tilt", scaled(shown.tilt_rad, unit.per_si),
                                         LineColor::orange, LineStyle::dashed));
  if (!drawn.is_all_reliable)
    panel.lines.push_back(
        line_over_time(shown, time, "not reliable", std::move(later), LineColor::grey, LineStyle::dotted, apart));
  panel.labels_at_lines = true;
  return panel;
}

/// Whether azimuths tell at all times how the axes stand to each other.
bool has_azimuths(const DriftCurves& drawn) {
  for (std::size_t i = 0; i < drawn.t_s.size(); ++i) {
    const std::array<double, 3> axis{drawn.axis_L[0][i], drawn.axis_L[1][i], drawn.axis_L[2][i]},
        reference{drawn.ref_axis_L[0][i], drawn.ref_axis_L[1][i], drawn.ref_axis_L[2][i]};
    if (!std::isfinite(drawn.azimuth_rad[i]) || !azimuths_are_meaningful(axis, reference, drawn.axis_rad[i])) return false;
  }
  return !drawn.t_s.empty();
}

/// Returns the azimuths less those of a line.
std::vector<double> beside_line(const DriftCurves& curves, double rate, double offset) {
  std::vector<double> rest = curves.azimuth_rad;
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= offset + rate * curves.t_s[i];
  return rest;
}

/// Whether the angle between the axes is that of their azimuths, as for a level axis: the azimuth's picture would be the angle's.
bool is_azimuth_alone(const DriftCurves& drawn) {
  constexpr double kSame = 0.01;
  const double angle = largest_of(drawn.axis_rad), azimuth = largest_of(drawn.azimuth_rad);
  for (std::size_t i = 0; i < drawn.t_s.size(); ++i)
    if (std::abs(std::abs(drawn.azimuth_rad[i]) * angle - drawn.axis_rad[i] * azimuth) > kSame * angle * azimuth) return false;
  return true;
}

/// @returns nothing where what is left beside the line is too small to be worth a picture
std::optional<Panel> azimuth_panel(const DriftCurves& shown, const DriftCurves& drawn, TimeUnit time) {
  constexpr double kLow = 120;  // px
  if (!drawn.azimuth_rate_rad_s) {
    if (is_azimuth_alone(drawn)) return std::nullopt;
    const ReadableUnit unit = angle_unit(largest_of(drawn.azimuth_rad));
    Panel panel{{"Azimuth, clockwise from above", std::string(unit.name)}, {}, kLow};
    panel.labels_at_lines = true;  // a single line needs no label: the caption says what it is
    panel.lines.push_back(
        line_over_time(shown, time, "", scaled(shown.azimuth_rad, unit.per_si), LineColor::blue, LineStyle::solid));
    return panel;
  }
  const double rate = *drawn.azimuth_rate_rad_s;
  double offset = 0;
  for (const double rest : beside_line(drawn, rate, 0)) offset += rest / static_cast<double>(drawn.t_s.size());
  const double largest = largest_of(beside_line(drawn, rate, offset));
  if (largest < kWorth * largest_of(drawn.azimuth_rad)) return std::nullopt;
  const ReadableUnit unit = angle_unit(largest);
  Panel panel{{"Azimuth minus its secular line", std::string(unit.name)}, {}, kLow};
  panel.labels_at_lines = true;
  panel.lines.push_back(line_over_time(shown, time, "", scaled(beside_line(shown, rate, offset), unit.per_si), LineColor::blue,
                                       LineStyle::solid));
  return panel;
}

/// The motion as it is drawn: at looks that resolve it; at the rows where there are none, as for a run that was interrupted.
DriftCurves curves_of(const RunResult& result) {
  const bool is_resolved = result.looks.size() > 1;
  DriftCurves curves;
  curves.title = result.scene.scenario().title.empty() ? result.scene.scenario().name : result.scene.scenario().title;
  curves.matching_rule = matching_rule(result.scene.scenario());
  curves.compared = compared_words(result.scene.scenario());
  curves.is_resolved = is_resolved;
  curves.a_window = is_resolved ? result.looks_a_window : 0;
  for (const DriftRow& row : is_resolved ? result.looks : result.rows) {
    curves.t_s.push_back(row.t_s);
    curves.axis_rad.push_back(row.drift_axis_rad);
    curves.tilt_rad.push_back(row.drift_tilt_rad);
    curves.azimuth_rad.push_back(row.drift_azimuth_rad.value_or(kNone));
    curves.is_reliable.push_back(row.drift_reliable);
    for (std::size_t k = 0; k < 3; ++k)
      curves.axis_L[k].push_back(row.axis_L[k]), curves.ref_axis_L[k].push_back(row.ref_axis_L[k]);
  }
  curves.is_all_reliable =
      earthtop::is_all_reliable(result) && std::ranges::find(curves.is_reliable, false) == curves.is_reliable.end();
  if (result.drift.secular && !result.drift.secular->of_window)
    curves.azimuth_rate_rad_s = result.drift.secular->azimuth_rate_rad_s;
  if (const DriftRow* last = last_reliable_row(result); last && last->t_s > 0)
    curves.end = {last->t_s, last->drift_axis_rad, last->drift_axis_bound_rad};
  return curves;
}

}  // namespace

Figure drift_figure(const DriftCurves& shown, const DriftCurves& drawn) {
  const TimeUnit time = unit_of_time(drawn);
  // One part after the other: of a whole that is begun when memory ends, g++ 12 destroys parts twice.
  Figure figure;
  figure.title = shown.title;
  figure.subtitle = fmt::format("{} minus {}; {}", shown.compared.former, shown.compared.latter, shown.matching_rule);
  figure.x = {"Time", time.name};
  figure.panels.push_back(angle_panel(shown, drawn, time));
  if (has_azimuths(drawn))
    if (std::optional<Panel> azimuth = azimuth_panel(shown, drawn, time)) figure.panels.push_back(std::move(*azimuth));
  figure.id = "parts";
  return figure;
}

Figure drift_figure(const RunResult& result) {
  const DriftCurves curves = curves_of(result);
  return drift_figure(curves, curves);
}

}  // namespace earthtop
