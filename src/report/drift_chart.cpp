// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/drift_chart.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "earthtop/results/azimuth_trend.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

using compare::Row;

std::vector<double> scaled(std::vector<double> list, double factor) {
  for (double& number : list) number *= factor;
  return list;
}

/// Whether each row's drift can be trusted; rows of older results that do not say so can.
std::vector<bool> reliable_rows(const Motion& motion) {
  std::vector<bool> list;
  for (const double flag : values(motion, "drift_reliable")) list.push_back(flag != 0);
  return list;
}

/// The angle between the axes and its part in tilt, in one unit.
Panel angle_panel(const Run& run, const Motion& motion) {
  std::vector<double> angle = values(motion, "drift_axis_rad"), tilt = values(motion, "drift_tilt_rad");
  const ReadableUnit unit = angle_unit(
      std::max(largest_size(values(run.drawn, "drift_axis_rad")), largest_size(values(run.drawn, "drift_tilt_rad"))));
  angle = scaled(std::move(angle), unit.per_si);
  const std::vector<double> t = times(run, motion);
  const std::vector<bool> reliable = reliable_rows(motion);
  std::vector<double> later = angle;
  for (std::size_t i = 0; i < angle.size(); ++i) (reliable[i] ? later : angle)[i] = kNoNumber;
  const std::vector<bool> seen = reliable_rows(run.drawn);
  const bool has_later = std::find(seen.begin(), seen.end(), false) != seen.end();
  const std::array<std::vector<double>, 3> apart = axes_apart(motion);
  Panel panel{{"Angle between the two spin axes", std::string(unit.name)}, {}};
  panel.lines.push_back(line_of(motion, "angle", t, std::move(angle), LineColor::blue, LineStyle::solid, apart));
  panel.lines.push_back(
      line_of(motion, "its part in tilt", t, scaled(std::move(tilt), unit.per_si), LineColor::orange, LineStyle::dashed));
  if (has_later)
    panel.lines.push_back(line_of(motion, "not reliable", t, std::move(later), LineColor::grey, LineStyle::dotted, apart));
  return panel;
}

/// Whether azimuths tell at all rows how the axes stand to each other.
bool has_azimuths(const Motion& motion, const std::vector<double>& azimuth) {
  const std::size_t axis = column("axis_L_x"), ref_axis = column("ref_axis_L_x"), apart = column("drift_axis_rad");
  return std::all_of(motion.rows.begin(), motion.rows.end(),
                     [&](const Row& row) {
                       return azimuths_are_meaningful(&row.value[axis], &row.value[ref_axis], row.value[apart]);
                     }) &&
         std::all_of(azimuth.begin(), azimuth.end(), [](double a) { return std::isfinite(a); });
}

/// Returns the azimuths less those of a line.
std::vector<double> beside_line(const Motion& motion, double rate, double offset) {
  std::vector<double> rest = values(motion, "drift_azimuth_rad");
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= offset + rate * motion.rows[i].t_s;
  return rest;
}

/// The azimuth with its secular line, and what is left of it beside the line.
void add_azimuth(const Run& run, const Motion& motion, Figure& figure) {
  const std::vector<double> seen = values(run.drawn, "drift_azimuth_rad"), t = times(run, motion);
  if (seen.empty() || !has_azimuths(run.drawn, seen)) return;
  const ReadableUnit unit = angle_unit(largest_size(seen));
  Panel panel{{"Azimuth, clockwise from above", std::string(unit.name)}, {}};
  panel.lines.push_back(line_of(motion, "azimuth", t, values(motion, "drift_azimuth_rad", unit.per_si)));
  const auto rate = run.number("/drift/secular/azimuth_rate_rad_s");
  if (!rate) {
    figure.panels.push_back(std::move(panel));
    return;
  }
  double offset = 0;
  for (const double rest : beside_line(run.drawn, *rate, 0)) offset += rest / static_cast<double>(seen.size());
  std::vector<double> line;
  for (const Row& row : motion.rows) line.push_back((offset + *rate * row.t_s) * unit.per_si);
  panel.lines.push_back({"secular line", t, std::move(line), LineColor::grey, LineStyle::broad});
  const ReadableUnit small = angle_unit(largest_size(beside_line(run.drawn, *rate, offset)));
  Panel beside{{"Azimuth minus its secular line", std::string(small.name)}, {}, 120};
  beside.lines.push_back(line_of(motion, "residual", t, scaled(beside_line(motion, *rate, offset), small.per_si)));
  figure.panels.push_back(std::move(panel));
  figure.panels.push_back(std::move(beside));
}

}  // namespace

std::array<std::vector<double>, 3> axes_apart(const Motion& motion) {
  std::array<std::vector<double>, 3> apart;
  const std::size_t axis = column("axis_L_x"), ref_axis = column("ref_axis_L_x");
  for (std::size_t k = 0; k < apart.size(); ++k)
    for (const Row& row : motion.rows) apart[k].push_back(row.value[axis + k] - row.value[ref_axis + k]);
  return apart;
}

Figure drift_chart(const Run& run, const Motion& motion) {
  Figure figure{
      "Drift", "Rotating minus non-rotating Earth; " + run.word("/matching_rule/statement"), {"Time", run.time.name}, {}};
  figure.panels.push_back(angle_panel(run, motion));
  add_azimuth(run, motion, figure);
  return figure;
}

}  // namespace earthtop::report
