// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "earthtop/drift/drift.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {
std::string_view to_string(ContactState state) {
  switch (state) {
    case ContactState::slide: return "slide";
    case ContactState::roll: return "roll";
    case ContactState::mixed: return "mixed";
  }
  throw std::logic_error("unknown state of a contact");
}

std::string_view to_string(ThresholdCrossing crossing) {
  switch (crossing) {
    case ThresholdCrossing::not_reached: break;
    case ThresholdCrossing::clear: return "clear";
    case ThresholdCrossing::tangential: return "tangential";
    case ThresholdCrossing::uncertain: return "uncertain";
  }
  return "not_reached";
}

double horizontal(const DriftRow& row) {
  return std::min(real::hypot(row.axis_L[0], row.axis_L[1]), real::hypot(row.ref_axis_L[0], row.ref_axis_L[1]));
}

namespace {

/// The drift of an angle of a suspension.
DriftSummary::OfAngle summary_of(const std::vector<DriftRow>& rows, double BasicGimbalRow<double>::*drift,
                                 double BasicGimbalRow<double>::*bound) {
  DriftSummary::OfAngle summary;
  for (const DriftRow& row : rows) {
    const double size = std::abs((*row.gimbals).*drift), error = (*row.gimbals).*bound;
    if (size > summary.max_rad) summary.max_rad = size, summary.max_at_s = row.t_s, summary.max_bound_rad = error;
    summary.bound_rad = std::max(summary.bound_rad, error);
  }
  summary.final_rad = (*rows.back().gimbals).*drift;
  return summary;
}

}  // namespace

DriftSummary summarize_drift(const std::vector<DriftRow>& rows, double rotation_rate_rad_s) {
  DriftSummary summary;
  if (rows.empty()) return summary;
  for (const DriftRow& row : rows) {
    if (row.drift_axis_rad > summary.axis_max_rad) {
      summary.axis_max_rad = row.drift_axis_rad, summary.axis_max_at_s = row.t_s;
      summary.axis_max_bound_rad = row.drift_axis_bound_rad;
    }
    if (std::abs(row.drift_tilt_rad) > summary.tilt_max_rad) {
      summary.tilt_max_rad = std::abs(row.drift_tilt_rad), summary.tilt_max_at_s = row.t_s;
      summary.tilt_max_bound_rad = row.drift_axis_bound_rad;
    }
    if (row.drift_azimuth_rad && !(std::abs(*row.drift_azimuth_rad) <= summary.azimuth_max_rad)) {
      summary.azimuth_max_rad = std::abs(*row.drift_azimuth_rad), summary.azimuth_max_at_s = row.t_s;
      summary.azimuth_max_bound_rad = row.drift_axis_bound_rad / horizontal(row);
    }
    summary.axis_bound_rad = std::max(summary.axis_bound_rad, row.drift_axis_bound_rad);
    summary.attitude_bound_rad = std::max(summary.attitude_bound_rad, row.drift_attitude_bound_rad);
    if (const auto& tip = row.contact) {
      summary.tip_final_m = tip->drift_tip_m;
      if (!summary.tip_max_m || tip->drift_tip_m > *summary.tip_max_m) {
        summary.tip_max_m = tip->drift_tip_m, summary.tip_max_at_s = row.t_s;
        summary.tip_max_bound_m = tip->drift_tip_bound_m;
      }
      summary.tip_bound_m = std::max(summary.tip_bound_m.value_or(0), tip->drift_tip_bound_m);
    }
    if (const auto& rotor = row.rotor) {
      summary.rotor_axis_final_rad = rotor->drift_axis_rad;
      if (!summary.rotor_axis_max_rad || rotor->drift_axis_rad > *summary.rotor_axis_max_rad) {
        summary.rotor_axis_max_rad = rotor->drift_axis_rad, summary.rotor_axis_max_at_s = row.t_s;
        summary.rotor_axis_max_bound_rad = rotor->drift_axis_bound_rad;
      }
      summary.rotor_axis_bound_rad = std::max(summary.rotor_axis_bound_rad.value_or(0), rotor->drift_axis_bound_rad);
    }
  }
  if (rows.front().gimbals) {
    summary.headline = rows.front().gimbals->headline;
    summary.outer_angle =
        summary_of(rows, &BasicGimbalRow<double>::drift_outer_angle_rad, &BasicGimbalRow<double>::drift_outer_angle_bound_rad);
    summary.inner_angle =
        summary_of(rows, &BasicGimbalRow<double>::drift_inner_angle_rad, &BasicGimbalRow<double>::drift_inner_angle_bound_rad);
  }
  const DriftRow& last = rows.back();
  summary.axis_final_rad = last.drift_axis_rad;
  summary.attitude_final_rad = last.drift_attitude_rad;
  summary.spin_final_rad = last.drift_spin_rad;
  summary.azimuth_final_rad = last.drift_azimuth_rad;
  summary.tilt_final_rad = last.drift_tilt_rad;
  if (rotation_rate_rad_s != 0 && last.t_s > 0)
    summary.axis_final_over_earth_angle = last.drift_axis_rad / std::abs(rotation_rate_rad_s) / last.t_s;
  return summary;
}

}  // namespace earthtop
