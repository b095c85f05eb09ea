// SPDX-License-Identifier: GPL-3.0-or-later
/// The derivatives of a run's drift by its inputs, and the drift error due to the errors of the inputs.
#pragma once

#include <optional>

#include "earthtop/run.hpp"

namespace earthtop {

/// Returns the derivatives of the last reliable drift; empty if the scenario does not request them.
std::optional<SensitivityReport> assess_sensitivities(const RunResult& result, const Watch& watch);

}  // namespace earthtop
