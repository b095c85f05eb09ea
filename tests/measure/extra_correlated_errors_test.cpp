// SPDX-License-Identifier: GPL-3.0-or-later
// The same thousand sets as in correlated_errors_test.cpp, read and fitted as `earthtop compare` does it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "measure/correlated_sets.hpp"

namespace earthtop {
namespace {

using namespace test;

class CorrelatedSets : public MeasurementTest {
 protected:
  Scores scores() const {
    const std::vector<double> times = uneven_times();
    const MeasurementOptions options{.estimates = {"omega_sin_latitude_rad_s", "/release/azimuth_deg"},
                                     .correlation_time_s = kTau_s};
    Normal normal(kCorrelatedSeed);
    Scores scores;
    for (int set = 0; set < kSets; ++set) {
      const std::vector<double> errors = correlated_errors(times, normal);
      std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
      for (std::size_t k = 0; k < times.size(); ++k)
        csv += fmt::format("{},{},{}\n", times[k], azimuth(free_axis(kEast, kNorthward45, kVertical45, times[k])) + errors[k],
                           error_of_row(k));
      const auto report = compare_with_measurement(shipped("free-gyro"), {}, read(csv), options);
      if (!report.fitted) {
        ADD_FAILURE() << report.fit_reason;
        break;
      }
      scores.pulls.push_back((*report.estimates[0].estimate - kVertical45) / *report.estimates[0].standard_error);
      scores.chances.push_back(*report.fitted->p_value);
    }
    return scores;
  }
};

TEST_F(CorrelatedSets, StatedTheyMakeErrorsOfEstimatesRight) { expect_errors_as_stated(scores()); }

}  // namespace
}  // namespace earthtop
