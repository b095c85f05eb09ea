// SPDX-License-Identifier: GPL-3.0-or-later
/// Decodes a checked tree into the typed parts of a scenario, and checks the rules that involve several keys. There is one
/// function per section; each adds its findings and returns what it could read.
#pragma once

#include <optional>
#include <string>

#include "earthtop/scenario/scenario.hpp"
#include "input/section.hpp"

namespace earthtop::scenario {

using input::excerpt, input::lists, input::Node, input::Section, input::split_words;

/// Decodes the body; empty if it is not physical or not complete.
/// @param has_rotor  whether a rotor belongs to it: its own moments may then be 0
std::optional<BodySpec> decode_body(const Section& body, bool has_rotor);

/// What of a scenario decides which keys its release has.
struct ReleasedParts {
  bool moves_inside = false;  ///< a rotor or masses: the body's rate may be left out
  bool gimbals = false;
};
/// Decodes the release; empty if it is not complete.
std::optional<ReleaseSpec> decode_release(const Section& release, const ReleasedParts& parts);

/// Decodes a Cardan suspension; empty if it is not complete.
std::optional<GimbalsSpec> decode_gimbals(const Section& root);

/// Checks that an inertia is given in one of the two ways, and makes its tensor symmetric. @returns whether that is so
bool complete_inertia(const Section& inertia, BodySpec& spec);

/// Decodes duration, output step and start, and checks the limit on rows.
void decode_motion(const Section& motion, Scenario& scenario);

/// Decode the rotor and the platform. @param source  says whether a table may be read, and where   @param duration_s  time it must
/// cover (s)
std::optional<RotorSpec> decode_rotor(const Section& root, const ScenarioSource& source, double duration_s);
std::optional<PlatformSpec> decode_platform(const Section& platform, const ScenarioSource& source, double duration_s);

/// Decodes a journey of the laboratory; empty if it is not complete.   @param duration_s  time that a table must cover (s)
std::optional<TravelSpec> decode_travel(const Section& root, const ScenarioSource& source, double duration_s);
/// Puts the site where a journey's table begins, and checks that the keys of it that are given say the same. @returns whether they do
bool place_at_start(const Section& site, const TravelSpec& travel, Site& place);
/// Checks that site and effects, which must have been decoded, and the other sections allow a journey.
void check_beside_travel(const Section& root, const Scenario& scenario);

/// Decodes the masses that move in the body: those that are complete.
std::vector<MovingMassSpec> decode_masses(const Section& root, const ScenarioSource& source, double duration_s);
/// Checks that the effects, which must have been decoded, allow moving masses.
void check_beside_masses(const Section& root, const Scenario& scenario);

/// Checks that body and rotor together have moments about every axis.
void check_gyrostat(const Section& root, const BodySpec& body, const RotorSpec& rotor);

/// Decodes the contact with a table, and checks that the other sections, which must have been decoded, allow one.
/// @returns the contact; empty if it is not complete
std::optional<ContactSpec> decode_contact(const Section& root, const Scenario& scenario);

/// Decodes which torques act, and the directions of the Earth's pole and of the plumb line.
/// @param source  says whether a table may be read, and where   @param scenario  must have site, rate and duration; its
/// effects, site and rate are written
void decode_effects(const Section& root, const ScenarioSource& source, Scenario& scenario);

/// Decodes method, tolerances and steps. @param scenario  its duration and output step are used, its numerics are written
void decode_numerics(const Section& numerics, Scenario& scenario);

std::vector<CriterionSpec> decode_criteria(const Section& root);

/// Largest number of output rows allowed, and the number that a scenario has (a double, as it may be huge).
inline constexpr double kMostRows = 2'000'000;
double output_row_count(double duration_s, double output_step_s);

/// Returns whether there is an output row at this time, to within 1e-9 of the step.
bool is_output_time(double t_s, double duration_s, double output_step_s);

}  // namespace earthtop::scenario
