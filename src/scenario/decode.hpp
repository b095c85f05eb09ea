// SPDX-License-Identifier: GPL-3.0-or-later
/// From a checked tree to typed parts of a scenario: the rules that involve more than one key. One function a section; each
/// adds what it finds and returns what it could read.
#pragma once

#include <optional>
#include <string>

#include "earthtop/scenario/scenario.hpp"
#include "input/section.hpp"

namespace earthtop::scenario {

using input::excerpt, input::lists, input::Node, input::Section, input::split_words;

/// The body, nothing where it is not physical or not complete.
std::optional<BodySpec> decode_body(const Section& body);

/// The release, nothing where it is not complete.
std::optional<ReleaseSpec> decode_release(const Section& release);

/// Duration, output step and start, with the limit on rows.
void decode_motion(const Section& motion, Scenario& scenario);

/// @param source  says where a table is looked for, and whether   @param duration_s  what it must cover
std::optional<PlatformSpec> decode_platform(const Section& platform, const ScenarioSource& source, double duration_s);

/// Decodes which torques act, and where the Earth's pole and the plumb line are.
/// @param scenario  its site and rate must be known; effects, site and rate are written
void decode_effects(const Section& root, Scenario& scenario);

/// Method, tolerances and steps. @param scenario  its duration and output step are used, its numerics are written
void decode_numerics(const Section& numerics, Scenario& scenario);

std::vector<CriterionSpec> decode_criteria(const Section& root);

/// Output rows that a scenario may have, and the number that it would have (as a double: it may be huge).
inline constexpr double kMostRows = 2'000'000;
double output_row_count(double duration_s, double output_step_s);

/// Returns whether a row stands at this time, within 1e-9 of the step.
bool is_output_time(double t_s, double duration_s, double output_step_s);

}  // namespace earthtop::scenario
