// SPDX-License-Identifier: GPL-3.0-or-later
// Why a compass or a gyroscope aboard a laboratory that travels does what it does.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "run/why_told.hpp"

namespace earthtop::why {
namespace {

std::string beside_north(double rad) {
  return rad == 0 ? "North" : fmt::format("{} {} of North", angle_text(std::abs(rad)), rad > 0 ? "East" : "West");
}

void tell_settling(Told& told, const TheoryReport& theory) {
  const JourneyFigures& journey = *told.scene.top().journey;
  told.add("steaming_error",
           fmt::format(
               "A damped compass settles along the level part of the rate at which the laboratory turns in space: that of the "
               "Earth, and that of its own way over the Earth, {:.3g} rad/s at most. So it points {}, {} in this run.",
               journey.transport_rate_rad_s, beside_north(theory.predicted), beside_north(*theory.computed)),
           {{"transport_rate_rad_s", journey.transport_rate_rad_s},
            {"predicted_rad", theory.predicted},
            {"computed_rad", *theory.computed}});
}

void tell_wander(Told& told, const TheoryReport& theory) {
  const JourneyFigures& journey = *told.scene.top().journey;
  constexpr double kDegreesAnHour = 3600 * 180 / std::numbers::pi;
  told.add("transport_wander",
           fmt::format(
               "A level axis that is free stays in space while the laboratory turns about Up: at the start by {:.4g} deg/h, of "
               "which its way over the Earth makes {:.4g} deg/h. In azimuth it turns by {} in theory, by {} in this run.",
               journey.wander_rad_s * kDegreesAnHour, journey.transport_wander_rad_s * kDegreesAnHour,
               angle_text(theory.predicted), angle_text(*theory.computed)),
           {{"wander_rad_s", journey.wander_rad_s},
            {"transport_wander_rad_s", journey.transport_wander_rad_s},
            {"predicted_rad", theory.predicted},
            {"computed_rad", *theory.computed}});
}

void tell_beam(Told& told, const TheoryReport& theory) {
  told.add("carried_round",
           fmt::format(
               "Nothing turns the beam about its upright axis: it keeps its inertial rate about Up, while Up is carried along. "
               "So it turns in the laboratory by {} in theory, by {} in this run; how fast it was carried does not matter.",
               angle_text(theory.predicted), angle_text(*theory.computed)),
           {{"predicted_rad", theory.predicted}, {"computed_rad", *theory.computed}});
}

void tell_free_body(Told& told, const TheoryReport& theory) {
  told.add(
      "turns_with_the_earth",
      fmt::format(
          "Nothing turns the body in space. On any journey its attitude drifts by the angle by which the Earth has turned, "
          "{}, by {} in this run.",
          angle_text(theory.predicted), angle_text(*theory.computed)),
      {{"predicted_rad", theory.predicted}, {"computed_rad", *theory.computed}});
}

}  // namespace

void tell_on_journey(Told& told) {
  for (const TheoryReport& theory : told.result.theory) {
    if (!holds_in_run(theory)) continue;
    if (theory.name == "settling_azimuth") tell_settling(told, theory);
    if (theory.name == "directional_gyro_wander") tell_wander(told, theory);
    if (theory.name == "carried_beam_turn") tell_beam(told, theory);
    if (theory.name == "free_attitude_drift") tell_free_body(told, theory);
  }
}

}  // namespace earthtop::why
