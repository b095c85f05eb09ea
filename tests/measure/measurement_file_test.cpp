// SPDX-License-Identifier: GPL-3.0-or-later
// Reads measurements from files, and refuses what cannot be one.
#include <gtest/gtest.h>

#include "earthtop/measure/measurement.hpp"
#include "measure/made_up_measurements.hpp"

namespace earthtop {
namespace {

using namespace test;

TEST_F(MeasurementTest, RefusalsSayWhereAndWhatInstead) {
  struct Case {
    std::string text;
    int line, column;
    std::string words;
  };
  const std::string header = "t_s,azimuth_deg,azimuth_se_deg\n";
  const Case cases[] = {
      {"_time,azimuth_deg,azimuth_se_deg\n0,1,1\n", 1, 1, "no column t_s"},
      {"t_s\n0\n", 1, 1, "no measured quantity; allowed are t_s, t_ms or t_min; azimuth"},
      {"t_s,azimuth_deg\n0,1\n", 1, 1,
       "azimuth has no standard error; give a column azimuth_se_rad, azimuth_se_deg or azimuth_se_arcsec, or --sigma "
       "azimuth_deg="},
      {"t_s,tilt_deg,tilt_se_deg,azimuth_se_deg\n0,1,1,1\n", 1, 1, "azimuth_se_deg is given without a column azimuth_rad"},
      {"t_s,azimuth_deg,azimuth_rad,azimuth_se_deg\n0,1,1,1\n", 1, 1,
       "azimuth_rad and azimuth_deg give the same quantity in two units"},
      {"t_s,azimut_deg,azimuth_se_deg\n0,1,1\n", 1, 1, "unknown column \"azimut_deg\"; did you mean \"azimuth_deg\"?"},
      {"t_s,axis_L_x,axis_L_z,axis_se_rad\n0,1,0,1\n", 1, 1, "axis_se_rad is given without all of axis_L_x"},
      {header + "-1,1,1\n", 2, 1, "if the clock shows another time at the release, say --time-offset T"},
      {header + ",1,1\n", 2, 1, "t_s must be a number from 0"},
      {header + "nan,1,1\n", 2, 1, "t_s must be a number from 0"},
      {header + "1,1,1\n0.5,1,1\n", 3, 1, "sort the rows by time"},
      {header + "1,nan,1\n", 2, 3, "leave the cell empty"},
      {header + "1,inf,1\n", 2, 3, "leave the cell empty"},
      {header + "10,1,\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,0\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,-1\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,nan\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,inf\n", 2, 6, "needs a standard error above 0"},
      {header + "10,x,1\n", 2, 4, "is not a number"},
      {header + "0,1,12,5,0,1\n", 2, 1, "are there decimal commas?"},
      {"t_s;azimuth_deg;azimuth_se_deg\n0;12.5;0.1\n1;12,5;0.1\n", 3, 1, "the numbers of line 2 a decimal point"},
      {"t_s;azimuth_deg;azimuth_se_deg\n1;1.234,5;0,1\n", 2, 3, "is not a number"},
      {"\xFF\xFEt_s\n", 1, 1, "is UTF-16"},
      {header + "10,,1\n", 2, 1, "no measured value"},
      {header, 1, 1, "no measured value"},
      {"t_s,tilt_rad,tilt_se_rad\n0,20,1\n", 2, 3, "at most 180 deg"},
      {"t_s,tilt_deg,tilt_se_rad\n0,180,1\n1,180.1,1\n", 3, 3, "at most 180 deg"},
      {"t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n0,1,0,0.1,1\n", 2, 3, "this one has the length 1.00499"},
      {"t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n0,1,,0,1\n", 2, 3, "give all or none"},
      {"0,90,0.1\n1,90,0.1\n", 1, 1, "it must name the columns, as t_s,azimuth_deg"},
      {"time,azimuth_deg,azimuth_se_deg\n0,1,1\n", 1, 1,
       "no column t_s, t_ms or t_min, the time since the release; if it has another name, say --columns NAME=t_s"},
      {"t_sec,azimuth_deg,azimuth_se_deg\n0,1,1\n", 1, 1, "did you mean \"t_s\"?"},
      {"t_s,t_ms,azimuth_deg,azimuth_se_deg\n0,0,1,1\n", 1, 1, "columns t_s and t_ms both give the time; keep one"},
      {"t_s,spin_rpm,spin_se_rpm,spin_rad_s\n0,1,1,1\n", 1, 1, "give the same quantity in two units"},
      {"t_s,w_IB_B_x_rads,w_IB_B_x_se_rad_s\n0,1,1\n", 1, 1, "did you mean \"w_IB_B_x_rad_s\"?"},
      {"t_s,azimuth_deg,azimuth_se_deg,extreme\n0,1,1,max\n", 1, 1, "extreme is given without a turning point"},
      {"t_s,azimuth_turning_deg,azimuth_turning_se_deg,extreme\n0,1,1,top\n", 2, 7, "\"top\" is not one of max, min"},
      {"t_s,azimuth_deg,azimuth_se_deg,passage_turns\n0,1,1,1\n", 1, 1, "passage_turns is given without passage_s"},
      {"passage_s,passage_se_s\n0,1\n", 2, 1, "must be a time above 0, and at most 1e+09 (s), after the release"},
      {"passage_s,passage_se_s,passage_turns\n10,1,-2\n", 2, 6, "how often the azimuth has gone round since the release"},
      {"t_s,precession_period_s,precession_period_se_s\n0,-3,1\n", 2, 3, "must be a time above 0"},
      {"t_s,swing_major_deg,swing_major_se_deg\n0,200,1\n", 2, 3, "a semi-axis is at most 180 deg"},
      {"t_s,azimuth,azimuth_se_deg\n0,1,1\n", 1, 1, "did you mean \"azimuth_"},
      {"t_s,rotor_rate,rotor_rate_se_rpm\n0,1,1\n", 1, 1, "did you mean \"rotor_rate_rpm\"?"},
      {"t_s,tilt_deg,tilt_deg,tilt_se_deg\n0,1,1,1\n", 1, 1, "occurs twice in the header; rename one"},
      {header + "0,90\n", 2, 1, "every column needs a cell in each row"},
      {header + "0,\"90,0.1\"\n", 2, 3, "write it as 0.1 or 1e-5"},
      {header + "0,12 deg,0.1\n", 2, 3, "without a unit"},
      {header + "0,0x10,0.1\n", 2, 3, "write it as 0.1 or 1e-5"},
      {header + "0,1e999,0.1\n", 2, 3, "leave the cell empty"},
      {header + "0,12,1e-400\n", 2, 6, "needs a standard error above 0"},
      {header + "2e9,12,1\n", 2, 1, "t_s must be a number from 0, the release, to 1e+09 (s)"},
      {header + "0,1,1\n" + header, 3, 1, "write it as 0.1 or 1e-5"},
  };
  for (const Case& c : cases) {
    const Diagnostic first = refusal(c.text).at(0);
    EXPECT_EQ(first.line, c.line) << c.text;
    EXPECT_EQ(first.column, c.column) << c.text;
    EXPECT_NE(first.message.find(c.words), std::string::npos) << c.text << first.message;
  }
  // All at once, up to twenty.
  EXPECT_EQ(refusal(header + "0,1,0\n1,1,1\n2,nan,1\n1,1,1\n").size(), 3u);
  std::string many = header;
  for (int i = 0; i < 30; ++i) many += "0,1,0\n";
  const auto diagnostics = refusal(many);
  ASSERT_EQ(diagnostics.size(), 21u);
  EXPECT_NE(diagnostics.back().message.find("10 more errors"), std::string::npos);
}

/// As spreadsheets write it: a byte order mark, tabs, the line ends of Windows.
TEST_F(MeasurementTest, ReadsTabsAndAByteOrderMark) {
  const Measurement m = read("\xEF\xBB\xBFt_s\ttilt_deg\ttilt_se_deg\r\n0.5\t20.25\t0.5\r\n1\t\t\r\n");
  EXPECT_EQ(m.rows, 2u);
  ASSERT_EQ(m.values.size(), 1u);
  EXPECT_EQ(m.values[0].t_s, 0.5);
  EXPECT_NEAR(m.values[0].value, 20.25 * kDegree, 1e-15);
}

TEST_F(MeasurementTest, ReadsWhatIsThere) {
  const Measurement m = read("# by theodolite\n_note,tilt_arcsec,t_s,tilt_se_deg\nfoo,3600,1,0.5\nbar,,2,\nbaz,7200,2,0.25\n");
  EXPECT_EQ(m.rows, 3u);
  ASSERT_EQ(m.values.size(), 2u);
  EXPECT_EQ(m.values[0].line, 3u);
  EXPECT_NEAR(m.values[0].value, kDegree, 4e-18);  // an ulp
  EXPECT_NEAR(m.values[0].standard_error, kDegree / 2, 4e-18);
  EXPECT_EQ(m.values[1].t_s, 2);
  EXPECT_EQ(m.values[1].quantity, MeasuredQuantity::tilt);
}

}  // namespace
}  // namespace earthtop
