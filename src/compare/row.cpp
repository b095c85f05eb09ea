// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/row.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/elementary.hpp"

namespace earthtop::compare {
namespace {

constexpr std::string_view kTrajectoryColumns[] = {"q_LB_w",
                                                   "q_LB_x",
                                                   "q_LB_y",
                                                   "q_LB_z",
                                                   "w_LB_B_x_rad_s",
                                                   "w_LB_B_y_rad_s",
                                                   "w_LB_B_z_rad_s",
                                                   "ref_q_LB_w",
                                                   "ref_q_LB_x",
                                                   "ref_q_LB_y",
                                                   "ref_q_LB_z",
                                                   "ref_w_LB_B_x_rad_s",
                                                   "ref_w_LB_B_y_rad_s",
                                                   "ref_w_LB_B_z_rad_s",
                                                   "axis_L_x",
                                                   "axis_L_y",
                                                   "axis_L_z",
                                                   "ref_axis_L_x",
                                                   "ref_axis_L_y",
                                                   "ref_axis_L_z",
                                                   "drift_axis_rad",
                                                   "drift_axis_bound_rad",
                                                   "drift_azimuth_rad",
                                                   "drift_tilt_rad",
                                                   "drift_attitude_rad",
                                                   "drift_attitude_bound_rad",
                                                   "drift_spin_rad",
                                                   "drift_reliable"};
constexpr std::string_view kTorqueColumns[] = {
    "tau_phys_x_N_m",  "tau_phys_y_N_m",  "tau_phys_z_N_m",  "tau_cor_x_N_m",  "tau_cor_y_N_m",  "tau_cor_z_N_m",
    "tau_trans_x_N_m", "tau_trans_y_N_m", "tau_trans_z_N_m", "tau_cent_x_N_m", "tau_cent_y_N_m", "tau_cent_z_N_m",
    "dL_dt_x_N_m",     "dL_dt_y_N_m",     "dL_dt_z_N_m",     "residual_x_N_m", "residual_y_N_m", "residual_z_N_m"};

constexpr std::size_t place(std::span<const std::string_view> columns, std::string_view name) {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}
constexpr Measure of_motion(std::string_view name, MeasureKind kind, std::string_view first, BoundKind bound = BoundKind::none,
                            std::string_view effect = "") {
  return {name, kind, place(kTrajectoryColumns, first), first, bound, effect};
}
constexpr Measure of_torque(std::string_view name, std::string_view first) {
  return {name, MeasureKind::vector, place(kTorqueColumns, first), first};
}

using enum MeasureKind;

constexpr Measure kTrajectoryMeasures[] = {
    of_motion("attitude_rad", attitude, "q_LB_w", BoundKind::attitude, "drift_attitude_rad"),
    of_motion("rates_rad_s", vector, "w_LB_B_x_rad_s", BoundKind::rates, "rates_rad_s"),
    of_motion("axis_rad", direction, "axis_L_x", BoundKind::attitude, "drift_axis_rad"),
    of_motion("ref_attitude_rad", attitude, "ref_q_LB_w", BoundKind::attitude, "drift_attitude_rad"),
    of_motion("ref_rates_rad_s", vector, "ref_w_LB_B_x_rad_s", BoundKind::rates, "rates_rad_s"),
    of_motion("ref_axis_rad", direction, "ref_axis_L_x", BoundKind::attitude, "drift_axis_rad"),
    of_motion("drift_axis_rad", number, "drift_axis_rad", BoundKind::drift_axis, "drift_axis_rad"),
    of_motion("drift_azimuth_rad", angle, "drift_azimuth_rad", BoundKind::drift_azimuth, "drift_azimuth_rad"),
    of_motion("drift_tilt_rad", number, "drift_tilt_rad", BoundKind::drift_tilt, "drift_axis_rad"),
    of_motion("drift_attitude_rad", number, "drift_attitude_rad", BoundKind::drift_attitude, "drift_attitude_rad"),
    of_motion("drift_spin_rad", angle, "drift_spin_rad", BoundKind::drift_attitude, "drift_attitude_rad"),
    of_motion("drift_axis_bound_rad", number, "drift_axis_bound_rad"),
    of_motion("drift_attitude_bound_rad", number, "drift_attitude_bound_rad"),
    of_motion("drift_reliable", flag, "drift_reliable"),
};
constexpr Measure kTorqueMeasures[] = {
    of_torque("tau_phys_N_m", "tau_phys_x_N_m"),   of_torque("tau_cor_N_m", "tau_cor_x_N_m"),
    of_torque("tau_trans_N_m", "tau_trans_x_N_m"), of_torque("tau_cent_N_m", "tau_cent_x_N_m"),
    of_torque("dL_dt_N_m", "dL_dt_x_N_m"),         of_torque("residual_N_m", "residual_x_N_m"),
};

double length(const double* v, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += v[i] * v[i];
  if (std::isfinite(sum)) return std::sqrt(sum);
  double largest = 0;  // whose square no double holds
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(v[i]));
  return largest;
}

/// Sine and cosine as a cross and a dot product: nothing cancels where the angle is small.
double angle_between(const double* a, const double* b) {
  const double x[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return real::atan2(length(x, 3), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// Angle of conj(a) b; either sign of a quaternion is the same attitude.
double turn_between(const double* a, const double* b) {
  const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double v[] = {a[0] * b[1] - b[0] * a[1] - (a[2] * b[3] - a[3] * b[2]),
                      a[0] * b[2] - b[0] * a[2] - (a[3] * b[1] - a[1] * b[3]),
                      a[0] * b[3] - b[0] * a[3] - (a[1] * b[2] - a[2] * b[1])};
  return 2 * real::atan2(length(v, 3), std::abs(w));
}

}  // namespace

std::optional<std::size_t> Table::find(std::string_view column) const {
  const std::size_t at = place(columns, column);
  return at < columns.size() ? std::optional(at) : std::nullopt;
}

const Table& trajectory_table() {
  static constexpr Table kTable = {"trajectory.csv", kTrajectoryColumns, kTrajectoryMeasures};
  return kTable;
}
const Table& torques_table() {
  static constexpr Table kTable = {"torques.csv", kTorqueColumns, kTorqueMeasures};
  return kTable;
}

Presence presence(const Measure& measure, const Row& row) {
  bool empty = false;
  for (std::size_t i = measure.column; i < measure.column + measure.width(); ++i) {
    if (row.kind[i] == CellKind::not_finite) return Presence::not_finite;
    empty = empty || row.kind[i] == CellKind::empty;
  }
  return empty ? Presence::empty : Presence::whole;
}

double difference(const Measure& measure, const Row& row_a, const Row& row_b) {
  const double* a = row_a.value.data() + measure.column;
  const double* b = row_b.value.data() + measure.column;
  switch (measure.kind) {
    case attitude: return std::max(turn_between(a, b), 2 * std::abs(length(a, 4) - length(b, 4)));
    case direction: return std::max(angle_between(a, b), std::abs(length(a, 3) - length(b, 3)));
    case vector: {
      const double d[] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      return length(d, 3);
    }
    case angle: return std::abs(std::remainder(*a - *b, 2 * std::numbers::pi));
    case number:
    case flag: return std::abs(*a - *b);
  }
  return 0;
}

double size(const Measure& measure, const Row& row) {
  if (measure.kind == attitude || measure.kind == direction) return 1;
  if (measure.kind == angle) return std::abs(std::remainder(row.value[measure.column], 2 * std::numbers::pi));
  return length(row.value.data() + measure.column, measure.width());
}

}  // namespace earthtop::compare
