// SPDX-License-Identifier: GPL-3.0-or-later
/// Decimal output of extended-precision numbers, compared with values from exact rational arithmetic.
#include "results/digits.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"

namespace earthtop {
namespace {

constexpr Precision kWidest = Precision::bits113;

TEST(Digits, OfFloat128AreThirtyFourCorrectlyRounded) {
  const std::pair<float128, const char*> cases[] = {
      {float128(1) / 3, "0.3333333333333333333333333333333333"},
      {float128(1) / 700000, "1.428571428571428571428571428571429e-06"},
      {float128(1) / 10, "0.1"},
      {0.1, "0.1000000000000000055511151231257827"},  // the double, exactly 0.1000000000000000055511151231257827021...
      {real::scale(float128(1), -1074), "4.940656458412465441765687928682214e-324"},
      {real::scale(float128(3), -1100), "2.20864554870685880263105985314349e-331"},
      {real::scale(float128(1), 200), "1.606938044258990275541962092341163e+60"},
      {0, "0"},
      {1, "1"},
      {-2, "-2"},
      {1024, "1024"},
      {0.0009765625, "0.0009765625"},
      {-6.103515625e-05, "-6.103515625e-05"},
      {200.5, "200.5"},
      {1e22, "10000000000000000000000"},
  };
  for (const auto& [value, text] : cases) EXPECT_EQ(digits(value, kWidest), text);
}

TEST(Digits, ATieGoesToTheEvenDigit) {
  // Integers of 35 digits that 113 bits hold: 10^34 + 5, + 15, + 25 and + 16.
  const float128 large = float128(1e17) * float128(1e17);
  EXPECT_EQ(digits(large + 5, kWidest), "1e+34");
  EXPECT_EQ(digits(large + 15, kWidest), "1.000000000000000000000000000000002e+34");
  EXPECT_EQ(digits(large + 25, kWidest), "1.000000000000000000000000000000002e+34");
  EXPECT_EQ(digits(large + 16, kWidest), "1.000000000000000000000000000000002e+34");
  EXPECT_EQ(digits(large - 1, kWidest), "9999999999999999999999999999999999");
  EXPECT_EQ(digits(1 - real::epsilon<float128>() / 2, kWidest), "0.9999999999999999999999999999999999");
  EXPECT_EQ(digits(large - 1 + float128(0.5), kWidest), "1e+34");  // 99...9.5 moves up a place
}

TEST(Digits, OfTheOthersAreTheShortest) {
  EXPECT_EQ(digits(float128(0.1), Precision::bits53), "0.1");
  EXPECT_EQ(digits(float128(0.1L), Precision::bits64), "0.1");
  EXPECT_EQ(digits(float128(1 / 3.0L), Precision::bits64), "0.33333333333333333334");
}

TEST(Digits, NoneOfWhatIsNotFinite) {
  for (const Precision precision : {Precision::bits53, Precision::bits64, kWidest})
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      EXPECT_EQ(digits(value, precision), "");
}

/// A made-up run with rows in extended precision.
RunResult extended_run(Precision precision) {
  RunResult result = test::made_up_run(2);
  result.scene = testing::changed(result.scene, [&](Scenario& s) { s.precision = precision; });
  for (const DriftRow& row : result.rows) {
    ExtendedDriftRow extended;
    extended.t_s = row.t_s;
    extended.drift_axis_rad = float128(1) / 3;
    extended.drift_spin_rad = float128(-2) / 3;
    result.extended_rows.push_back(extended);
  }
  return result;
}

TEST(Digits, StandInTheTrajectoryAndTheSummary) {
  const RunResult result = extended_run(kWidest);
  std::istringstream csv(trajectory_csv(result));
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(csv, line);
  EXPECT_EQ(line,
            "60,1,0,0,0,0,0,0,1,0,0,0,0,0,0,0,0,1,0,0,1,0.3333333333333333333333333333333333,0,,0,0,0,"
            "-0.6666666666666666666666666666666666,1");
  EXPECT_NE(summary_json(result).find("\"axis_final_rad\": \"0.3333333333333333333333333333333333\""), std::string::npos);
  EXPECT_FALSE(drift_digits(test::made_up_run()).has_value());
}

}  // namespace
}  // namespace earthtop
