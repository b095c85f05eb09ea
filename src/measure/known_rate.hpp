// SPDX-License-Identifier: GPL-3.0-or-later
/// How well the Earth's rate, and its components at a site, are known besides a measurement.
#pragma once

#include <optional>

#include "earthtop/measure/rate_finding.hpp"
#include "measure/estimated_inputs.hpp"

namespace earthtop::measure {

/// The rate that an input is; none for an input that is no rate of the Earth. The Earth's own rate is known to 1e-8 of itself
/// (days differ by some milliseconds), another one, and the latitude, as the scenario's `uncertainty` says.
std::optional<KnownRate> known_rate(const Scene& scene, const EstimatedInput& input);

}  // namespace earthtop::measure
