// SPDX-License-Identifier: GPL-3.0-or-later
/// How the drift of a run changes with its inputs, and what their errors make of it.
#pragma once

#include <optional>

#include "earthtop/run.hpp"

namespace earthtop {

/// The derivatives of the last reliable drift; none where the scenario does not ask for them.
std::optional<SensitivityReport> assess_sensitivities(const RunResult& result, const Watch& watch);

}  // namespace earthtop
