// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/columns.hpp"

namespace earthtop {
namespace {

/// A column of rows of both kinds. @param Member  from a row of any scalar to a number, or to none
template <class Member>
constexpr Column column(std::string_view name, Member) {
  return {name, [](const DriftRow& row) -> std::optional<double> { return Member{}(row); },
          [](const ExtendedDriftRow& row) -> std::optional<float128> { return Member{}(row); }};
}

constexpr Column kColumns[] = {
    column("t_s", [](const auto& row) { return row.t_s; }),
    column("q_LB_w", [](const auto& row) { return row.q_LB[0]; }),
    column("q_LB_x", [](const auto& row) { return row.q_LB[1]; }),
    column("q_LB_y", [](const auto& row) { return row.q_LB[2]; }),
    column("q_LB_z", [](const auto& row) { return row.q_LB[3]; }),
    column("w_LB_B_x_rad_s", [](const auto& row) { return row.w_LB_B[0]; }),
    column("w_LB_B_y_rad_s", [](const auto& row) { return row.w_LB_B[1]; }),
    column("w_LB_B_z_rad_s", [](const auto& row) { return row.w_LB_B[2]; }),
    column("ref_q_LB_w", [](const auto& row) { return row.ref_q_LB[0]; }),
    column("ref_q_LB_x", [](const auto& row) { return row.ref_q_LB[1]; }),
    column("ref_q_LB_y", [](const auto& row) { return row.ref_q_LB[2]; }),
    column("ref_q_LB_z", [](const auto& row) { return row.ref_q_LB[3]; }),
    column("ref_w_LB_B_x_rad_s", [](const auto& row) { return row.ref_w_LB_B[0]; }),
    column("ref_w_LB_B_y_rad_s", [](const auto& row) { return row.ref_w_LB_B[1]; }),
    column("ref_w_LB_B_z_rad_s", [](const auto& row) { return row.ref_w_LB_B[2]; }),
    column("axis_L_x", [](const auto& row) { return row.axis_L[0]; }),
    column("axis_L_y", [](const auto& row) { return row.axis_L[1]; }),
    column("axis_L_z", [](const auto& row) { return row.axis_L[2]; }),
    column("ref_axis_L_x", [](const auto& row) { return row.ref_axis_L[0]; }),
    column("ref_axis_L_y", [](const auto& row) { return row.ref_axis_L[1]; }),
    column("ref_axis_L_z", [](const auto& row) { return row.ref_axis_L[2]; }),
    column("drift_axis_rad", [](const auto& row) { return row.drift_axis_rad; }),
    column("drift_axis_bound_rad", [](const auto& row) { return row.drift_axis_bound_rad; }),
    column("drift_azimuth_rad", [](const auto& row) { return row.drift_azimuth_rad; }),
    column("drift_tilt_rad", [](const auto& row) { return row.drift_tilt_rad; }),
    column("drift_attitude_rad", [](const auto& row) { return row.drift_attitude_rad; }),
    column("drift_attitude_bound_rad", [](const auto& row) { return row.drift_attitude_bound_rad; }),
    column("drift_spin_rad", [](const auto& row) { return row.drift_spin_rad; }),
    column("drift_reliable", [](const auto& row) { return row.drift_reliable ? 1 : 0; }),
};

}  // namespace

std::span<const Column> trajectory_columns() { return kColumns; }

}  // namespace earthtop
