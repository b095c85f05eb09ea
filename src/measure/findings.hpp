// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds what the estimates of a fit say of the Earth's rate, and on which inputs they rest.
#pragma once

#include <cstddef>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/watch.hpp"
#include "measure/exact_inputs.hpp"
#include "measure/whitening.hpp"

namespace earthtop::measure {

/// The expected number of predictions that the findings take with so many fitted and exact inputs.
double expected_derivatives(std::size_t inputs);

/// Fills in the findings of a fit that converged, and the inputs that it took as exact.
/// @param watch  may end the work early: then the fit is `interrupted`
void add_findings(MeasurementReport& report, const Measurement& measurement, const Scene& scene, const ExactInputs& exact,
                  const ExactInputs::InputsOf& inputs_of, const Whitening& whitening, const Watch& watch);

}  // namespace earthtop::measure
