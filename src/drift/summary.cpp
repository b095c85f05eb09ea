// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "earthtop/drift/drift.hpp"

namespace earthtop {
namespace {

std::optional<SecularDrift> fit_secular_drift(const std::vector<DriftRow>& rows) {
  std::vector<double> t, azimuth;
  double size = 0;
  for (const DriftRow& row : rows) {
    if (!row.drift_azimuth_rad) continue;
    t.push_back(row.t_s);
    azimuth.push_back(*row.drift_azimuth_rad);
    size = std::max(size, std::abs(azimuth.back()));
  }
  if (t.size() < 3) return std::nullopt;
  SecularDrift secular;
  if (size == 0) return secular;  // exactly zero, as without the Earth's rate
  // The fit is in units of the largest value, so that the squares of tiny drifts do not underflow.
  for (double& value : azimuth) value /= size;
  double offset = 0, slope = 0, cov00 = 0, cov01 = 0, cov11 = 0, residual_squares = 0;
  gsl_fit_linear(t.data(), 1, azimuth.data(), 1, t.size(), &offset, &slope, &cov00, &cov01, &cov11, &residual_squares);
  double oscillation = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    oscillation = std::max(oscillation, std::abs(azimuth[i] - (offset + slope * t[i])));
  secular.azimuth_rate_rad_s = slope * size;
  secular.azimuth_rate_standard_error_rad_s = std::sqrt(cov11) * size;
  secular.azimuth_oscillation_rad = oscillation * size;
  secular.mean_precession_rate_change_rad_s = 0.0 - secular.azimuth_rate_rad_s;
  return secular;
}

}  // namespace

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

DriftSummary summarize_drift(const std::vector<DriftRow>& rows, double rotation_rate_rad_s) {
  DriftSummary summary;
  if (rows.empty()) return summary;
  for (const DriftRow& row : rows) {
    summary.axis_max_rad = std::max(summary.axis_max_rad, row.drift_axis_rad);
    summary.axis_bound_rad = std::max(summary.axis_bound_rad, row.drift_axis_bound_rad);
    summary.attitude_bound_rad = std::max(summary.attitude_bound_rad, row.drift_attitude_bound_rad);
    if (!row.contact) continue;
    summary.tip_final_m = row.contact->drift_tip_m;
    summary.tip_max_m = std::max(summary.tip_max_m.value_or(0), row.contact->drift_tip_m);
    summary.tip_bound_m = std::max(summary.tip_bound_m.value_or(0), row.contact->drift_tip_bound_m);
  }
  const DriftRow& last = rows.back();
  summary.axis_final_rad = last.drift_axis_rad;
  summary.attitude_final_rad = last.drift_attitude_rad;
  summary.spin_final_rad = last.drift_spin_rad;
  summary.azimuth_final_rad = last.drift_azimuth_rad;
  summary.tilt_final_rad = last.drift_tilt_rad;
  if (rotation_rate_rad_s != 0 && last.t_s > 0)
    summary.axis_final_over_earth_angle = last.drift_axis_rad / std::abs(rotation_rate_rad_s) / last.t_s;
  summary.secular = fit_secular_drift(rows);
  return summary;
}

}  // namespace earthtop
