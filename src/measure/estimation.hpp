// SPDX-License-Identifier: GPL-3.0-or-later
/// The estimates of a comparison: the fit, what it means, and chi-squared.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/watch.hpp"
#include "measure/compared_release.hpp"
#include "measure/joint_inputs.hpp"
#include "measure/priors.hpp"
#include "measure/whitening.hpp"

namespace earthtop::measure {

/// @param residuals  of all rows   @param priors  those that entered the fit   @param fitted  the number of fitted inputs
ChiSquared chi_squared_of(const std::vector<MeasurementResidual>& residuals, const std::vector<Prior>& priors,
                          std::size_t fitted);
/// The same of all releases together.
ChiSquared chi_squared_of(const std::vector<MeasurementReport>& releases, const std::vector<Prior>& priors, std::size_t fitted);

/// Whitens the residuals of a whole measurement.
void whiten(std::vector<MeasurementResidual>& residuals, const Whitening& whitening);
/// The correlation of the errors of one release or of all, as it is stated.
Whitening whitening_of(const MeasurementReport& release, double correlation_time_s);
Whitening whitening_of(const ReleasesReport& report);

/// The expected number of predictions of a fit: for each parameter two to find its step, and two for its derivative in each of
/// some iterations.
double expected_predictions(std::size_t parameters);

/// Fits the inputs, from the residuals of the scenarios' own motions that the report has, and fills in what it says of the fit.
/// @param releases  those of the report   @param inputs  theirs
/// @returns of a fit that has converged, the derivatives of all residuals, those of the priors below them, by the inputs in scales
Eigen::MatrixXd fit_estimates(ReleasesReport& report, const std::vector<ComparedRelease>& releases, const JointInputs& inputs,
                              FoundPriors priors, const Watch& watch);

}  // namespace earthtop::measure
