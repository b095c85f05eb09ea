// SPDX-License-Identifier: GPL-3.0-or-later
/// What the parts of a computation cost against each other, for those who show how far it is.
#pragma once

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// One integration of both motions with these options, in the seconds of `estimated_seconds`. @param form  the one it takes
double integration_work(Scenario scenario, const IntegrationOptions& options, ModelForm form);

/// Integrations of one motion with its first variations, of the general form, from the release to a time: of the growth of
/// disturbances along both motions, and of the drift's derivatives by so many inputs.
double growth_work(const Scenario& scenario, double time_s, double relative_tolerance);
double sensitivity_work(const Scenario& scenario, double time_s, double relative_tolerance, std::size_t inputs);

}  // namespace earthtop
