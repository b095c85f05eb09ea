#include <charconv>
#include <cmath>
#include <string_view>

#include "earthtop/results/results.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kHeader =
    "t_s,"
    "q_LB_w,q_LB_x,q_LB_y,q_LB_z,w_LB_B_x_rad_s,w_LB_B_y_rad_s,w_LB_B_z_rad_s,"
    "ref_q_LB_w,ref_q_LB_x,ref_q_LB_y,ref_q_LB_z,ref_w_LB_B_x_rad_s,ref_w_LB_B_y_rad_s,ref_w_LB_B_z_rad_s,"
    "axis_L_x,axis_L_y,axis_L_z,ref_axis_L_x,ref_axis_L_y,ref_axis_L_z,"
    "drift_axis_rad,drift_axis_bound_rad,drift_azimuth_rad,drift_tilt_rad,"
    "drift_attitude_rad,drift_attitude_bound_rad,drift_spin_rad\n";

void append_number(std::string& line, double value) {
  if (!std::isfinite(value)) return;
  char digits[32];  // the longest shortest form of a double has 24 characters
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  line.append(digits, end);
}

void append_field(std::string& line, double value) {
  line += ',';
  append_number(line, value);
}

template <class Container>
void append_fields(std::string& line, const Container& values) {
  for (const double value : values) append_field(line, value);
}

void append_row(std::string& text, const DriftRow& row) {
  append_number(text, row.t_s);
  append_fields(text, row.q_LB);
  append_fields(text, row.w_LB_B);
  append_fields(text, row.ref_q_LB);
  append_fields(text, row.ref_w_LB_B);
  append_fields(text, row.axis_L);
  append_fields(text, row.ref_axis_L);
  append_field(text, row.drift_axis_rad);
  append_field(text, row.drift_axis_bound_rad);
  text += ',';
  if (row.drift_azimuth_rad) append_number(text, *row.drift_azimuth_rad);
  append_field(text, row.drift_tilt_rad);
  append_field(text, row.drift_attitude_rad);
  append_field(text, row.drift_attitude_bound_rad);
  append_field(text, row.drift_spin_rad);
  text += '\n';
}

}  // namespace

std::string trajectory_csv(const RunResult& result) {
  constexpr std::size_t kTypicalRow = 560;  // 28 numbers of up to 20 characters
  std::string text;
  text.reserve(kHeader.size() + result.rows.size() * kTypicalRow);
  text += kHeader;
  for (const DriftRow& row : result.rows) append_row(text, row);
  return text;
}

}  // namespace earthtop
