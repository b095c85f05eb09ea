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
/// A heavy top, one with friction, a gyrocompass; a top seen by a tilted camera, and by a late clock; one that is spun both ways.
std::vector<ScatterCase> scatter_cases();

struct Scatter {
  std::vector<std::string> names;
  std::vector<double> over_prediction;  ///< of each number, the standard deviation of its estimates over the planned error
  std::vector<double> mean_pull;        ///< of each number, the mean of estimate less true value, in planned errors
  std::vector<double> fitted_error;     ///< of each number, the mean of the fits' standard errors over the planned one
};
/// @param sets  number of data sets, with seeds from 1 on
Scatter scatter_of(const ScatterCase& what, std::uint64_t sets);

}  // namespace earthtop::testing
