// SPDX-License-Identifier: GPL-3.0-or-later
/// Fits of many simulated measurements, whose scatter is held against the planned standard errors.
#pragma once

#include <string>
#include <vector>

#include "earthtop/plan/plan.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

struct ScatterCase {
  std::string name, scenario;
  std::vector<Overrides> releases;  ///< of which data are simulated
  MeasurementPlan plan;
  Overrides start = {};  ///< where the fits start, beside that
};
/// A heavy top, one with friction, a gyrocompass; a top seen by a tilted camera, and by a late clock; one that is spun both ways; rates, turning points and times of passages instead of angles.
std::vector<ScatterCase> scatter_cases();

struct Scatter {
  std::vector<std::string> names;
  std::vector<double> over_prediction;  ///< of each number, the standard deviation of its estimates over the planned error
  std::vector<double> mean_pull;        ///< of each number, the mean of estimate less true value, in planned errors
  std::vector<double> fitted_error;     ///< of each number, the mean of the fits' standard errors over the planned one
};
/// @param sets  number of data sets, with seeds from 1 on
Scatter scatter_of(const ScatterCase& what, std::uint64_t sets);

/// Expects that the estimates of 1,000 simulated measurements scatter as planned, within 8 %: 3.6 times the 2.2 % by which the standard
/// deviation of 1,000 normal numbers scatters itself. Their mean is within 0.1 planned errors of the truth, 3.2 times its own standard
/// error. The fits' own standard errors are the planned ones, within 5 %. @param name  of the case
void expect_scatter_as_planned(const std::string& name);

}  // namespace earthtop::testing
