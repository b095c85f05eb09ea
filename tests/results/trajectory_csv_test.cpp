// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <limits>
#include <sstream>

#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"
#include "run/rows.hpp"

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

constexpr std::string_view kContactColumns =
    ",tip_L_x_m,tip_L_y_m,ref_tip_L_x_m,ref_tip_L_y_m,slip_m_s,ref_slip_m_s,normal_force_N,ref_normal_force_N,"
    "drift_tip_x_m,drift_tip_y_m,drift_tip_m,drift_tip_bound_m,drift_slip_m_s,drift_spin_rate_rad_s,contact_state";

/// A row whose number in each column of the contact, counted from 1, is that column's.
template <class T>
BasicContactRow<T> numbered_contact() {
  BasicContactRow<T> contact;
  contact.tip_m = {T(1), T(2)};
  contact.ref_tip_m = {T(3), T(4)};
  contact.slip_m_s = 5;
  contact.ref_slip_m_s = 6;
  contact.normal_force_N = 7;
  contact.ref_normal_force_N = 8;
  contact.drift_tip_xy_m = {T(9), T(10)};
  contact.drift_tip_m = 11;
  contact.drift_tip_bound_m = 12;
  contact.drift_slip_m_s = 13;
  contact.drift_spin_rate_rad_s = 14;
  return contact;
}

TEST(TrajectoryCsv, TheContactsColumnsFollowTheOthers) {
  RunResult result = test::made_up_contact_run(2);
  const std::string without = trajectory_csv(made_up_run(2));
  for (const ContactState state : {ContactState::slide, ContactState::roll, ContactState::mixed}) {
    for (DriftRow& row : result.rows) {
      row.contact = numbered_contact<double>();
      row.contact->state = state;
    }
    const auto lines = lines_of(trajectory_csv(result)), others = lines_of(without);
    ASSERT_EQ(lines.size(), others.size());
    EXPECT_EQ(lines[0], others[0] + std::string(kContactColumns));
    for (std::size_t i = 1; i < lines.size(); ++i)
      EXPECT_EQ(lines[i], others[i] + ",1,2,3,4,5,6,7,8,9,10,11,12,13,14," + std::string(to_string(state)));
  }
}

TEST(TrajectoryCsv, RowsOfMoreDigitsHaveTheContactToo) {
  for (const Precision precision : {Precision::bits64, Precision::bits113}) {
    RunResult result = test::made_up_contact_run(2);
    result.scene = testing::changed(result.scene, [&](Scenario& s) { s.precision = precision; });
    result.extended_rows.resize(2);
    for (ExtendedDriftRow& row : result.extended_rows) row.contact = numbered_contact<float128>();
    result.extended_rows[1].contact->state = ContactState::mixed;
    result.extended_rows[1].contact->drift_tip_m = static_cast<float128>(1.0L / 3);
    const auto lines = lines_of(trajectory_csv(result));
    EXPECT_TRUE(lines.at(0).ends_with(kContactColumns));
    EXPECT_TRUE(lines.at(1).ends_with(",1,2,3,4,5,6,7,8,9,10,11,12,13,14,slide"));
    EXPECT_TRUE(lines.at(2).ends_with(",12,13,14,mixed"));
    const std::string third = fields_of(lines.at(2)).at(29 + 10);
    EXPECT_GT(third.size(), 20u) << third;
    EXPECT_TRUE(third.starts_with("0.3333333333333333333")) << third;
  }
}

// Rows of every scalar are the same row: nothing of the contact is lost on the way from one to the other.
TEST(TrajectoryCsv, RowsOfAnotherScalarKeepTheContact) {
  ExtendedDriftRow row;
  EXPECT_FALSE(row_cast<double>(row).contact);
  row.contact = numbered_contact<float128>();
  row.contact->state = ContactState::mixed;
  RunResult result = test::made_up_contact_run(2);
  result.rows[1] = row_cast<double>(row);
  EXPECT_TRUE(lines_of(trajectory_csv(result)).at(2).ends_with(",1,2,3,4,5,6,7,8,9,10,11,12,13,14,mixed"));
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
