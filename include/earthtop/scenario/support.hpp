// SPDX-License-Identifier: GPL-3.0-or-later
/// What carries a top: a fixed pivot, a platform, a gimbal or a table. What is known of a support before anything is computed is one row
/// of `kSupports`; its equations, its checks and its reports are in sources of its own.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// In the order of `kSupports`.
enum class SupportKind : std::uint8_t { table, platform, gimbal, pivot };

/// A support, by what the rest of the program asks of it. Where something is not available on it, a text says so and what to do
/// instead; the text is empty where it is available.
struct Support {
  SupportKind kind;
  std::string_view pointer;          ///< JSON pointer of the key that asks for it; empty for a fixed pivot
  bool (*carries)(const Scenario&);  ///< whether a scenario asks for it
  bool is_fixed_pivot =
      false;  ///< whether it is at rest in the laboratory and exerts no torque: closed forms and exact flows may hold
  bool has_contact = false;      ///< whether the tip moves: rows, files and pages have its path, its slip and the force on it
  bool may_damp = false;         ///< whether it may brake the body itself, beside the friction among the effects
  bool drives = false;           ///< whether the rates of the motion may be others than those of the release
  bool has_motion_alone = true;  ///< whether one motion can be integrated without the deviation from the other
  std::string_view no_exact_motion{};  ///< of a method, after its name
  std::string_view no_timing{};
  std::string_view no_effect_sizes{};
  std::string_view no_trend{};
};

/// The first row that carries a scenario's top is its support: the fixed pivot carries what no other support does.
inline constexpr std::array kSupports = {
    Support{
        .kind = SupportKind::table,
        .pointer = "/contact",
        .carries = [](const Scenario& s) { return s.contact.has_value(); },
        .has_contact = true,
        .may_damp = true,
        .has_motion_alone = false,
        .no_exact_motion = "is not available for a top on a table; take \"auto\", or leave the contact out",
        .no_timing = "a top on a table cannot be timed; leave the contact out",
        .no_effect_sizes =
            "effects are sized only for a top on a fixed pivot; to see what an effect does on a table, run the scenario with "
            "and without it",
        .no_trend = "the top stands on a table"},
    Support{.kind = SupportKind::platform,
            .pointer = "/platform",
            .carries = [](const Scenario& s) { return s.platform.has_value(); },
            .drives = true,
            .no_exact_motion = "is not available on a platform; take \"auto\", or leave the platform out"},
    Support{.kind = SupportKind::gimbal,
            .pointer = "/effects/gimbal",
            .carries = [](const Scenario& s) { return s.effects.applied.gimbal.has_value(); },
            .may_damp = true,
            .drives = true},
    Support{.kind = SupportKind::pivot, .pointer = "", .carries = [](const Scenario&) { return true; }, .is_fixed_pivot = true},
};

constexpr bool supports_are_in_order() {
  for (std::size_t i = 0; i < kSupports.size(); ++i)
    if (kSupports[i].kind != static_cast<SupportKind>(i)) return false;
  return kSupports.back().kind == SupportKind::pivot;
}
static_assert(supports_are_in_order());

/// Returns what carries the top of a scenario.
inline const Support& support_of(const Scenario& scenario) {
  const Support* support = kSupports.data();
  while (!support->carries(scenario)) ++support;
  return *support;
}

}  // namespace earthtop
