// SPDX-License-Identifier: GPL-3.0-or-later
/// What carries a top, and what moves in it: a fixed pivot, a platform, a level gimbal, a rotor, masses, a Cardan suspension or a table. What is known of a support before
/// anything is computed is one row of a table; its equations, its checks and its reports are in sources of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// In the order of the table: a top is carried by the first support that its scenario asks for.
enum class SupportKind : std::uint8_t { table, suspension, masses, rotor, platform, journey, gimbal, pivot };

inline constexpr std::size_t kSupportCount = 8;

/// Ends what is said of a closed form or an exact flow where the laboratory travels, on any support.
inline constexpr std::string_view kNotOnJourney = "is not available on a journey; take \"auto\", or leave the journey out";

/// A support, by what the rest of the program asks of it. Where something is not available on it, a text says so and what to do
/// instead; the text is empty where it is available.
struct Support {
  SupportKind kind;
  std::string_view pointer;          ///< JSON pointer of the key that asks for it; empty for a fixed pivot
  bool (*carries)(const Scenario&);  ///< whether a scenario asks for it
  /// Whether it is at rest in the laboratory and exerts no torque: closed forms and exact flows may hold.
  bool is_fixed_pivot = false;
  /// Whether the tip moves: rows, files and pages have its path, its slip and the force on it.
  bool has_contact = false;
  /// Whether the equations are those of a gyrostat, in which a rotor turns or masses move; not for a caged top, which has a rotor, too.
  bool has_rotor = false;
  bool has_gimbals = false;            ///< whether a Cardan suspension holds the body, with a rotor in it or without
  bool may_damp = false;               ///< whether it may brake the body itself, beside the friction among the effects
  std::string_view no_exact_motion{};  ///< of a method, after its name
  std::string_view no_motion_alone{};  ///< of one motion without the deviation from the other
  std::string_view no_effect_sizes{};  ///< of the effect budget
  std::string_view no_trend{};         ///< of a secular drift

  /// Whether the equations are not those of a rigid body.
  bool has_moving_parts() const { return has_rotor || has_gimbals; }
};

/// Whether a mass moves in a scenario's body. Masses that are fixed to it only make it another rigid body.
bool masses_move(const Scenario& scenario);

/// Whether a scenario's rotor turns about body axis 3 of a cage that is symmetric about it and carries no masses.
bool has_symmetric_cage(const Scenario& scenario);

/// Whether a scenario's rotor turns about the symmetry axis of a symmetric cage on which nothing brakes its turn about that axis. Axis and
/// attitude drift then as those of a rigid top do, whatever the bearing or the motor does: with L the momentum along the axis, I3 that of
/// both and I3 w3 = L. So the scene is that of this rigid top, and the rows get the cage's own turn and the rotor. Not with dry friction in
/// the bearing, which leaves no closed form of the turn, nor where the general model is asked for.
bool is_caged_top(const Scenario& scenario);

/// Whether a scenario's motion may come to other rates than those of its release: on a platform, on a journey, and in a gimbal.
bool may_be_driven(const Scenario& scenario);

/// Returns what carries the top of a scenario.
const Support& support_of(const Scenario& scenario);

}  // namespace earthtop
