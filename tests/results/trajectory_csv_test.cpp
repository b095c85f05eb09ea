// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <limits>
#include <sstream>

#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"

namespace earthtop {
namespace {

using test::made_up_run;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

double parse(const std::string& field) {
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  EXPECT_EQ(end, field.data() + field.size()) << field;
  EXPECT_EQ(error, std::errc()) << field;
  return value;
}

constexpr std::size_t kAzimuthColumn = 23;

TEST(TrajectoryCsv, HeaderIsTheContracts) {
  const std::string csv = trajectory_csv(made_up_run(2));
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "t_s,"
            "q_LB_w,q_LB_x,q_LB_y,q_LB_z,"
            "w_LB_B_x_rad_s,w_LB_B_y_rad_s,w_LB_B_z_rad_s,"
            "ref_q_LB_w,ref_q_LB_x,ref_q_LB_y,ref_q_LB_z,"
            "ref_w_LB_B_x_rad_s,ref_w_LB_B_y_rad_s,ref_w_LB_B_z_rad_s,"
            "axis_L_x,axis_L_y,axis_L_z,"
            "ref_axis_L_x,ref_axis_L_y,ref_axis_L_z,"
            "drift_axis_rad,drift_axis_bound_rad,"
            "drift_azimuth_rad,drift_tilt_rad,"
            "drift_attitude_rad,drift_attitude_bound_rad,drift_spin_rad,"
            "drift_reliable");
}

TEST(TrajectoryCsv, EveryColumnHoldsItsOwnNumber) {
  RunResult result = made_up_run(2);
  result.rows.resize(1);
  DriftRow& row = result.rows[0];
  row.t_s = 0;
  row.q_LB = {1, 2, 3, 4};
  row.w_LB_B = {5, 6, 7};
  row.ref_q_LB = {8, 9, 10, 11};
  row.ref_w_LB_B = {12, 13, 14};
  row.axis_L = {15, 16, 17};
  row.ref_axis_L = {18, 19, 20};
  row.drift_axis_rad = 21;
  row.drift_axis_bound_rad = 22;
  row.drift_azimuth_rad = 23;
  row.drift_tilt_rad = 24;
  row.drift_attitude_rad = 25;
  row.drift_attitude_bound_rad = 26;
  row.drift_spin_rad = 27;
  EXPECT_EQ(lines_of(trajectory_csv(result)).at(1),
            "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,1");
  row.drift_reliable = false;
  EXPECT_TRUE(lines_of(trajectory_csv(result)).at(1).ends_with(",27,0"));
}

TEST(TrajectoryCsv, NumbersReadBackToTheSameBits) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> values = {1e-300, 5e-324,        -0.0,   0.1,  1.0 / 3.0,     -7.292115e-5,
                                      1e22,   Limits::max(), -1e308, 2e-3, Limits::min(), 0x1.fffffffffffffp-3};
  RunResult result = made_up_run(2);
  for (const double value : values) {
    result.rows[1].drift_spin_rad = value;
    result.rows[1].t_s = value;
    const auto fields = fields_of(lines_of(trajectory_csv(result)).at(2));
    ASSERT_EQ(fields.size(), 29U);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parse(fields.front())), std::bit_cast<std::uint64_t>(value)) << value;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parse(fields.at(27))), std::bit_cast<std::uint64_t>(value)) << value;
  }
}

TEST(TrajectoryCsv, NumbersAreTheShortest) {
  RunResult result = made_up_run(2);
  result.rows[1].t_s = 0.1;
  EXPECT_TRUE(lines_of(trajectory_csv(result)).at(2).starts_with("0.1,"));
}

TEST(TrajectoryCsv, AbsentAzimuthIsAnEmptyField) {
  RunResult result = made_up_run(2);
  result.rows[1].drift_azimuth_rad.reset();
  const auto lines = lines_of(trajectory_csv(result));
  EXPECT_FALSE(fields_of(lines.at(1)).at(kAzimuthColumn).empty());
  const auto fields = fields_of(lines.at(2));
  ASSERT_EQ(fields.size(), 29U);
  for (std::size_t i = 0; i < fields.size(); ++i) EXPECT_EQ(fields[i].empty(), i == kAzimuthColumn) << i;
}

TEST(TrajectoryCsv, WhatIsNotFiniteIsAnEmptyField) {
  RunResult result = made_up_run(3);
  DriftRow& row = result.rows[1];
  row.drift_axis_bound_rad = std::numeric_limits<double>::infinity();
  row.w_LB_B[1] = -std::numeric_limits<double>::infinity();
  row.drift_azimuth_rad = std::numeric_limits<double>::quiet_NaN();
  const auto fields = fields_of(lines_of(trajectory_csv(result)).at(2));
  ASSERT_EQ(fields.size(), 29U);
  EXPECT_EQ(fields[6], "");
  EXPECT_EQ(fields[22], "");
  EXPECT_EQ(fields[kAzimuthColumn], "");
}

TEST(TrajectoryCsv, OneLineForEachRow) {
  EXPECT_EQ(lines_of(trajectory_csv(made_up_run(7))).size(), 8U);
  RunResult none = made_up_run(2);
  none.rows.clear();
  EXPECT_EQ(lines_of(trajectory_csv(none)).size(), 1U);
}

}  // namespace
}  // namespace earthtop
