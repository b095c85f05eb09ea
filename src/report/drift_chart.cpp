// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/drift_chart.hpp"

#include "report/html.hpp"

namespace earthtop::report {

DriftCurves drift_curves(const Run& run, const Motion& motion) {
  DriftCurves curves;
  curves.title = title_of(run);
  curves.matching_rule = run.word("/matching_rule/statement");
  curves.compared = run.compared();
  curves.is_resolved = motion.is_resolved;
  curves.a_window = motion.a_window;
  for (const compare::Row& row : motion.rows) curves.t_s.push_back(row.t_s);
  curves.axis_rad = values(motion, "drift_axis_rad");
  curves.tilt_rad = values(motion, "drift_tilt_rad");
  curves.azimuth_rad = values(motion, "drift_azimuth_rad");
  // Rows of older results that do not say whether they can be trusted can.
  for (const double flag : values(motion, "drift_reliable")) curves.is_reliable.push_back(flag != 0);
  for (const Motion* each : {&motion, &run.listed})
    for (const double flag : values(*each, "drift_reliable")) curves.is_all_reliable = curves.is_all_reliable && flag != 0;
  const std::size_t axis = column("axis_L_x"), ref_axis = column("ref_axis_L_x");
  for (std::size_t k = 0; k < 3; ++k)
    for (const compare::Row& row : motion.rows) {
      curves.axis_L[k].push_back(row.value[axis + k]);
      curves.ref_axis_L[k].push_back(row.value[ref_axis + k]);
    }
  const Json is_mean = run.results.summary->value(Json::json_pointer("/drift/secular/mean_of_window"), Json());
  if (!is_mean.is_boolean() || !is_mean.get<bool>())
    curves.azimuth_rate_rad_s = run.number("/drift/secular/azimuth_rate_rad_s");
  const auto angle = run.number("/drift/reliable/axis_rad"), at = run.number("/drift/reliable/at_s");
  if (angle && at && *at > 0) curves.end = {*at, *angle, run.number("/drift/reliable/axis_bound_rad").value_or(kNoNumber)};
  return curves;
}

}  // namespace earthtop::report
