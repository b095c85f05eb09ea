// SPDX-License-Identifier: GPL-3.0-or-later
/// A start of a fit that follows from the measured precession.
#pragma once

#include <vector>

#include "measure/joint_inputs.hpp"
#include "measure/prediction_problem.hpp"

namespace earthtop::measure {

/// The scenarios' values, with other spins where a measured azimuth precesses otherwise than the predicted one: a heavy top's slow
/// precession is m g l / (I3 w3), so that the spin is the scenario's times predicted over measured rate, with its sign. The turns are
/// counted from the data, as far as neighbouring rows are less than half a turn apart.
/// @param releases  with the residuals of the scenarios' own motions
std::vector<double> start_by_precession(const JointInputs& inputs, const std::vector<VariedRelease>& releases);

}  // namespace earthtop::measure
