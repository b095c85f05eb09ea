// SPDX-License-Identifier: GPL-3.0-or-later
/// The estimates of a comparison: the fit, what it means, and chi-squared.
#pragma once

#include <cstddef>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/watch.hpp"
#include "measure/estimated_inputs.hpp"
#include "measure/priors.hpp"
#include "measure/whitening.hpp"

namespace earthtop::measure {

/// @param priors  those that entered the fit   @param fitted  the number of fitted inputs
ChiSquared chi_squared_of(const std::vector<MeasurementResidual>& residuals, const std::vector<Prior>& priors,
                          std::size_t fitted);

/// Whitens the residuals of a whole measurement.
void whiten(std::vector<MeasurementResidual>& residuals, const Whitening& whitening);
/// The correlation of the errors as it is stated.
Whitening whitening_of(const MeasurementReport& report);

/// The expected number of predictions of a fit: for each parameter two to find its step, and two for its derivative in each of
/// some iterations.
double expected_predictions(std::size_t parameters);

/// Fits the inputs, from the residuals of the scenario's own motion that the report has, and fills in what it says of the fit.
void fit_estimates(MeasurementReport& report, const Measurement& measurement, const EstimatedInputs& inputs, FoundPriors priors,
                   const Watch& watch);

}  // namespace earthtop::measure
