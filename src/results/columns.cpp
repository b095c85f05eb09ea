#include "results/columns.hpp"

namespace earthtop {
namespace {

using Value = std::optional<double>;

template <auto member>
Value number(const DriftRow& row) {
  return row.*member;
}
template <auto member, std::size_t i>
Value component(const DriftRow& row) {
  return (row.*member)[i];
}

using Row = DriftRow;

constexpr Column kColumns[] = {
    {"t_s", number<&Row::t_s>},
    {"q_LB_w", component<&Row::q_LB, 0>},
    {"q_LB_x", component<&Row::q_LB, 1>},
    {"q_LB_y", component<&Row::q_LB, 2>},
    {"q_LB_z", component<&Row::q_LB, 3>},
    {"w_LB_B_x_rad_s", component<&Row::w_LB_B, 0>},
    {"w_LB_B_y_rad_s", component<&Row::w_LB_B, 1>},
    {"w_LB_B_z_rad_s", component<&Row::w_LB_B, 2>},
    {"ref_q_LB_w", component<&Row::ref_q_LB, 0>},
    {"ref_q_LB_x", component<&Row::ref_q_LB, 1>},
    {"ref_q_LB_y", component<&Row::ref_q_LB, 2>},
    {"ref_q_LB_z", component<&Row::ref_q_LB, 3>},
    {"ref_w_LB_B_x_rad_s", component<&Row::ref_w_LB_B, 0>},
    {"ref_w_LB_B_y_rad_s", component<&Row::ref_w_LB_B, 1>},
    {"ref_w_LB_B_z_rad_s", component<&Row::ref_w_LB_B, 2>},
    {"axis_L_x", component<&Row::axis_L, 0>},
    {"axis_L_y", component<&Row::axis_L, 1>},
    {"axis_L_z", component<&Row::axis_L, 2>},
    {"ref_axis_L_x", component<&Row::ref_axis_L, 0>},
    {"ref_axis_L_y", component<&Row::ref_axis_L, 1>},
    {"ref_axis_L_z", component<&Row::ref_axis_L, 2>},
    {"drift_axis_rad", number<&Row::drift_axis_rad>},
    {"drift_axis_bound_rad", number<&Row::drift_axis_bound_rad>},
    {"drift_azimuth_rad", number<&Row::drift_azimuth_rad>},
    {"drift_tilt_rad", number<&Row::drift_tilt_rad>},
    {"drift_attitude_rad", number<&Row::drift_attitude_rad>},
    {"drift_attitude_bound_rad", number<&Row::drift_attitude_bound_rad>},
    {"drift_spin_rad", number<&Row::drift_spin_rad>},
};

}  // namespace

std::span<const Column> trajectory_columns() { return kColumns; }

}  // namespace earthtop
