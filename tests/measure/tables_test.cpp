// SPDX-License-Identifier: GPL-3.0-or-later
// Tables as instruments and spreadsheets write them, and what is said of them besides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "earthtop/measure/measurement.hpp"
#include "measure/made_up_measurements.hpp"

namespace earthtop {
namespace {

using namespace test;
using enum MeasuredQuantity;

class TablesTest : public MeasurementTest {
 protected:
  /// Expects one value, in rad or another unit, and its standard error.
  void expect_one(const std::string& text, const MeasurementFormat& format, MeasuredQuantity quantity, double value,
                  double error) const {
    const Measurement m = read(text, format);
    ASSERT_EQ(m.values.size(), 1u) << text;
    EXPECT_EQ(m.values[0].quantity, quantity) << text;
    EXPECT_NEAR(m.values[0].value, value, 1e-14 * std::max(1.0, std::abs(value))) << text;  // some roundings
    EXPECT_NEAR(m.values[0].standard_error, error, 1e-15 * error) << text;                  // likewise
  }
};

/// A phone's table: other names, units in brackets, a clock that starts elsewhere, and columns that nobody reads.
TEST_F(TablesTest, ColumnsHaveOtherNames) {
  const std::string text = "Time (s);Gyroscope x (rad/s);Temperature;phi\n22,5;1,5;20;3\n23,25;-0,5;20;90\n24,5;2,5;21;100\n";
  const Measurement m = read(text, {{"Time (s)=t_s", "Gyroscope x (rad/s)=w_IB_B_x_rad_s", "phi=_"}, {"w_IB_B_x_deg_s=2"}, 23});
  ASSERT_EQ(m.values.size(), 2u);
  EXPECT_EQ(m.values[0].quantity, w_IB_B_x);
  EXPECT_EQ(m.values[0].t_s, 0.25);
  EXPECT_EQ(m.values[0].value, -0.5);
  EXPECT_NEAR(m.values[0].standard_error, 2 * kDegree, 1e-17);  // of 0.03
  EXPECT_EQ(m.values[1].line, 4u);
  ASSERT_EQ(m.notes.size(), 2u);
  EXPECT_EQ(m.notes[0], "column not read: \"Temperature\"");
  EXPECT_EQ(m.notes[1], "1 row is left out: before the release, 23 s by the clock of the file");
}

TEST_F(TablesTest, UnitsOfTimesRatesAndLengths) {
  expect_one("t_min,spin_rpm\n2,30\n", {{}, {"spin_rpm=3"}}, spin, kPi, kPi / 10);
  EXPECT_EQ(read("t_min,spin_rpm\n2,30\n", {{}, {"spin_rpm=3"}}).values[0].t_s, 120);
  EXPECT_EQ(read("t_ms,spin_rpm\n250,30\n", {{}, {"spin_rpm=3"}}).values[0].t_s, 0.25);
  expect_one("t_s,w_LB_B_z_deg_s\n2,-90\n", {{}, {"w_LB_B_z_deg_s=9"}}, w_LB_B_z, -kPi / 2, kPi / 20);
  expect_one("t_s,tip_L_x_mm,tip_L_x_se_m\n2,-90,0.001\n", {}, tip_L_x, -0.09, 0.001);
}

/// Each word on how angles are counted, by an axis that leans towards North-East by 30 degrees.
TEST_F(TablesTest, SensesByOneWord) {
  const auto read_as = [&](const std::string& column, double number, MeasuredQuantity quantity, double value_deg) {
    expect_one("t_s,a\n0," + std::to_string(number) + "\n", {{"a=" + column}, {column.substr(0, column.find(':')) + "=1"}},
               quantity, value_deg * kDegree, kDegree);
  };
  read_as("azimuth_deg", 45, azimuth, 45);
  read_as("azimuth_deg:mathematical", 60, azimuth, 30);  // from East, counterclockwise
  read_as("azimuth_deg:counterclockwise", 315, azimuth, -315);
  read_as("azimuth_deg:from_east", -45, azimuth, 45);
  read_as("azimuth_deg:from_south", 225, azimuth, 405);
  read_as("tilt_deg:elevation", 60, tilt, 30);
  read_as("tilt_deg:from_down", 150, tilt, 30);
  read_as("drift_tilt_deg:reversed", 3, drift_tilt, -3);
  read_as("swing_azimuth_deg:mathematical", 60, swing_azimuth, 30);
  // The largest number as read is the least as meant.
  const Measurement m =
      read("t_s,a,extreme\n0,60,max\n1,20,min\n2,20,\n", {{"a=azimuth_turning_deg:mathematical"}, {"azimuth_turning_deg=1"}});
  ASSERT_EQ(m.values.size(), 3u);
  EXPECT_EQ(m.values[0].extreme, Extreme::minimum);
  EXPECT_EQ(m.values[1].extreme, Extreme::maximum);
  EXPECT_EQ(m.values[2].extreme, Extreme::either);
}

/// A stopwatch's table has no other time.
TEST_F(TablesTest, PassagesAreTimesThemselves) {
  const Measurement m = read("passage_s,passage_turns\n12.5,1\n36,3\n", {{}, {"passage_s=0.2"}, 0.5});
  ASSERT_EQ(m.values.size(), 2u);
  EXPECT_EQ(m.values[0].value, 12);
  EXPECT_EQ(m.values[0].t_s, 12);
  EXPECT_EQ(m.values[1].turns, 3);
  EXPECT_EQ(m.values[1].standard_error, 0.2);
}

TEST_F(TablesTest, DecimalCommasWhereNoCommaSeparates) {
  for (const char separator : {';', '\t'}) {
    std::string text = "\xEF\xBB\xBF# from a spreadsheet\r\nt_s|tilt_deg|tilt_se_deg\r\n0,5|20,25|1e-1\r\n";
    std::replace(text.begin(), text.end(), '|', separator);
    const Measurement m = read(text);
    ASSERT_EQ(m.values.size(), 1u);
    EXPECT_EQ(m.values[0].t_s, 0.5);
    EXPECT_NEAR(m.values[0].value, 20.25 * kDegree, 1e-15);  // of 0.35 rad
    EXPECT_EQ(m.notes.size(), 0u);
  }
  EXPECT_EQ(read("t_s;tilt_deg;tilt_se_deg\n0.5;20.25;0.1\n").values[0].t_s, 0.5);
}

TEST_F(TablesTest, WhatIsSaidOfATableHasToFit) {
  struct Case {
    MeasurementFormat format;
    std::string pointer, words;
  };
  const std::string text = "t_s,phi,azimuth_se_deg\n0,1,1\n";
  const Case cases[] = {
      {{{"phi"}}, "--columns phi", "is not of the form NAME=COLUMN"},
      {{{"=azimuth_deg"}}, "--columns =azimuth_deg", "is not of the form NAME=COLUMN"},
      {{{"psi=azimuth_deg"}}, "--columns psi=azimuth_deg", "the file has no column \"psi\"; it has t_s, phi, azimuth_se_deg"},
      {{{"Phi=azimuth_deg"}}, "--columns Phi=azimuth_deg", "did you mean \"phi\"?"},
      {{{"phi=azimut_deg"}}, "--columns phi=azimut_deg", "did you mean \"azimuth_deg\"?"},
      {{{"phi=azimuth_deg:mathematic"}},
       "--columns phi=azimuth_deg:mathematic",
       "azimuth_deg is not counted as \"mathematic\"; allowed are mathematical, counterclockwise, from_east, from_south, "
       "reversed; "
       "did you mean \"mathematical\"?"},
      {{{"phi=t_s:reversed"}}, "--columns phi=t_s:reversed", "t_s has no other sense"},
      {{{"phi=t_s"}}, "--columns phi", "is t_s then, as \"t_s\" is; keep one"},
      {{{"phi=azimuth_deg"}, {"azimuth_deg"}}, "--sigma azimuth_deg", "is not of the form COLUMN=NUMBER"},
      {{{"phi=azimuth_deg"}, {"azimuth=0.2"}},
       "--sigma azimuth=0.2",
       "there is no \"azimuth\"; it is a quantity with its unit"},
      {{{"phi=azimuth_deg"}, {"azimuth_deg=0"}}, "--sigma azimuth_deg=0", "must be a number above 0"},
      {{{"phi=azimuth_deg"}, {"azimuth_deg=x"}}, "--sigma azimuth_deg=x", "must be a number above 0"},
      {{{"phi=azimuth_deg"}, {"tilt_deg=1", "tilt_rad=1"}}, "--sigma tilt_rad=1", "tilt_deg=1 is given, too; keep one"},
      {{{"phi=azimuth_deg"}, {"tilt_deg=1"}}, "", "--sigma tilt_deg=1: there is no column tilt_rad, tilt_deg or tilt_arcsec"},
      {{{"phi=azimuth_deg"}, {"azimuth_deg=1"}}, "", "--sigma azimuth_deg=1: column azimuth_se_deg gives standard errors"},
      {{{"phi=azimuth_deg"}, {}, 2e9}, "--time-offset", "must be a time of at most 1e+09 (s)"},
      {{{"phi=azimuth_deg"}, {}, 5}, "", "all rows are before the release, which --time-offset puts at 5 s"},
  };
  for (const Case& c : cases) {
    const Diagnostic first = refusal(text, c.format).at(0);
    EXPECT_EQ(first.pointer, c.pointer);
    EXPECT_NE(first.message.find(c.words), std::string::npos) << first.message;
  }
}

}  // namespace
}  // namespace earthtop
