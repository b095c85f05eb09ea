// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scenario/support.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace earthtop {
namespace {

constexpr std::array<Support, kSupportCount> kSupports = {{
    {.kind = SupportKind::table,
     .pointer = "/contact",
     .carries = [](const Scenario& s) { return s.contact.has_value(); },
     .has_contact = true,
     .may_damp = true,
     .no_exact_motion = "is not available for a top on a table; take \"auto\", or leave the contact out",
     .no_motion_alone = "of a top on a table both motions are integrated together; take the drift",
     .no_effect_sizes =
         "effects are sized only for a top on a fixed pivot; to see what an effect does on a table, run the scenario "
         "with and without it",
     .no_trend = "the top stands on a table"},
    {.kind = SupportKind::suspension,
     .pointer = "/gimbals",
     .carries = [](const Scenario& s) { return s.gimbals.has_value(); },
     .has_gimbals = true,
     .may_damp = true,
     .no_exact_motion = "is not available for a body in gimbals; take \"auto\", or leave the gimbals out",
     .no_motion_alone = "of a body in gimbals both motions are integrated together; take the drift",
     .no_effect_sizes =
         "effects are sized only for a rigid body; to see what an effect does with gimbals, run the scenario with and "
         "without it",
     .no_trend = "gimbals hold the body"},
    {.kind = SupportKind::masses,
     .pointer = "/moving_masses",
     .carries = masses_move,
     .has_rotor = true,
     .may_damp = true,
     .no_exact_motion = "is not available with masses that move in the body; take \"auto\", or leave the masses out",
     .no_effect_sizes =
         "effects are sized only for a rigid body; to see what an effect does with moving masses, run the scenario "
         "with and without it",
     .no_trend = "masses move in the body"},
    {.kind = SupportKind::rotor,
     .pointer = "/rotor",
     .carries = [](const Scenario& s) { return s.rotor && !is_caged_top(s); },
     .has_rotor = true,
     .may_damp = true,
     .no_exact_motion = "is not available with a rotor in the body; take \"auto\", or leave the rotor out",
     .no_effect_sizes = "effects are sized only for a rigid body; to see what an effect does with a rotor, run the scenario "
                        "with and without it",
     .no_trend = "a rotor turns in the body"},
    {.kind = SupportKind::platform,
     .pointer = "/platform",
     .carries = [](const Scenario& s) { return s.platform.has_value(); },
     .no_exact_motion = "is not available on a platform; take \"auto\", or leave the platform out"},
    {.kind = SupportKind::journey,
     .pointer = "/travel",
     .carries = [](const Scenario& s) { return s.travel.has_value(); },
     .no_exact_motion = kNotOnJourney},
    {.kind = SupportKind::gimbal,
     .pointer = "/effects/gimbal",
     .carries = [](const Scenario& s) { return s.effects.applied.gimbal.has_value(); },
     .may_damp = true},
    {.kind = SupportKind::pivot, .pointer = "", .carries = [](const Scenario&) { return true; }, .is_fixed_pivot = true},
}};

constexpr bool supports_are_in_order() {
  for (std::size_t i = 0; i < kSupports.size(); ++i)
    if (kSupports[i].kind != static_cast<SupportKind>(i)) return false;
  return true;
}
static_assert(supports_are_in_order());

}  // namespace

bool is_caged_top(const Scenario& s) {
  if (!has_symmetric_cage(s) || s.contact || s.gimbals || s.travel || s.numerics.form == ModelForm::general) return false;
  const AppliedTorquesSpec& applied = s.effects.applied;
  return !applied.friction() && !applied.given_torque && !applied.gimbal && s.rotor->coulomb_torque_N_m == 0;
}

bool masses_move(const Scenario& s) { return std::ranges::any_of(s.moving_masses, &MovingMassSpec::moves); }

bool has_symmetric_cage(const Scenario& s) {
  if (!s.rotor || !s.moving_masses.empty()) return false;
  const RotorSpec& rotor = *s.rotor;
  if (!(rotor.axis[0] == 0 && rotor.axis[1] == 0 && rotor.axis[2] > 0 && rotor.center_m[0] == 0 && rotor.center_m[1] == 0))
    return false;
  if (!s.body.solids.empty()) return true;  // of revolution about axis 3
  const auto& I = s.body.inertia_kg_m2;
  const auto& center = s.body.center_of_mass_m;
  return center[0] == 0 && center[1] == 0 && I[0][0] == I[1][1] && I[0][1] == 0 && I[0][2] == 0 && I[1][2] == 0;
}

bool may_be_driven(const Scenario& s) { return s.platform || s.travel || s.effects.applied.gimbal; }

const Support& support_of(const Scenario& scenario) {
  return *std::ranges::find_if(kSupports, [&](const Support& support) { return support.carries(scenario); });
}

}  // namespace earthtop
