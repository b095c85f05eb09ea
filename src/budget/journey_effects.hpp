// SPDX-License-Identifier: GPL-3.0-or-later
/// The effects of a laboratory's journey: the Coriolis force on it, its acceleration, and the turn of East, North and Up with the place.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "budget/effects.hpp"

namespace earthtop {

inline constexpr std::string_view kEotvosReason = "the Coriolis force on the laboratory, by which the plumb line aboard leans",
                                  kBallisticReason = "the laboratory's acceleration over the Earth",
                                  kTransportReason = "East, North and Up turn with the place";

inline bool travels(const Scene& scene) { return scene.scenario().travel.has_value(); }
/// Whether the Coriolis force on the laboratory acts.
inline bool is_felt(const Scene& scene) { return travels(scene) && scene.scenario().travel->eotvos != TravelEotvos::off; }

/// The candidates; none where the scene has no journey, or leaves the effect out. The reference has to be the same path.
/// @param scene  must outlive them
std::optional<Candidate> eotvos(const Scene& scene);
std::optional<Candidate> ballistic(const Scene& scene);
/// The Coriolis torque of the transport rate. Its share in the axis's motion is not found: that depends on the axes from which it is seen.
std::optional<Candidate> transport(const Scene& scene);

/// The sizes of the torques (N m) at the release and the largest, each in the attitude in which it is largest.
std::array<double, 2> eotvos_torque(const Scene& scene);
std::array<double, 2> ballistic_torque(const Scene& scene);

}  // namespace earthtop
