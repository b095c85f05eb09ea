// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds what the estimates of a fit say of the Earth's rate, and on which inputs they rest.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/watch.hpp"
#include "measure/compared_release.hpp"

namespace earthtop::measure {

/// The expected number of predictions that the findings take with so many fitted and exact inputs.
double expected_derivatives(std::size_t inputs);

/// Fills in the findings of a fit that converged, and the inputs that it took as exact.
/// @param releases  those of the report   @param shared  names of numbers that have one value in all of them
/// @param by_fitted  derivatives of the residuals by the fitted inputs, from the fit
/// @param watch  may end the work early: then the fit is `interrupted`
void add_findings(ReleasesReport& report, const std::vector<ComparedRelease>& releases, const std::vector<std::string>& shared,
                  const Eigen::MatrixXd& by_fitted, const Watch& watch);

}  // namespace earthtop::measure
