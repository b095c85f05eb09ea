// SPDX-License-Identifier: GPL-3.0-or-later
/// The members of summary.json about the body and its motion without Earth rotation.
#pragma once

#include "earthtop/scene/top_figures.hpp"
#include "results/member_entries.hpp"

namespace earthtop::figure_table {

inline Json to_word(const std::optional<NutationKind>& kind) {
  if (!kind) return {};
  return *kind == NutationKind::of_release ? "of_release" : "small_amplitude";
}

inline std::string_view to_word(TravelReference reference) {
  return reference == TravelReference::at_rest ? "at_rest" : "same_path";
}
inline std::string_view to_word(TravelEotvos eotvos) {
  return eotvos == TravelEotvos::rotating ? "rotating" : eotvos == TravelEotvos::both ? "both" : "off";
}

/// A value that only a gyrostat has; left out for others.
inline Json of_a_rotor(R r, const std::optional<double>& value) {
  return r.scene.scenario().rotor ? json_from(value) : kLeftOut;
}

inline constexpr auto kTopMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  using MemberForm::vector, MemberForm::words;
  return std::array{
      // The body and its motion without Earth rotation. Body axes; precession is counted counterclockwise about Up.
      object("top"),
      of_scenario(compared("top.mass_kg", input, any, kAtEnd, [](R r) { return r.scene.top().mass_kg; })),
      of_scenario(compared(
          "top.center_of_mass_m", input, any, kAtEnd, [](R r) { return r.scene.top().center_of_mass_m; }, vector)),
      of_scenario(compared(
          "top.moments_about_pivot_kg_m2", input, any, kAtEnd, [](R r) { return r.scene.top().moments_about_pivot_kg_m2; },
          vector)),
      of_scenario(compared(
          "top.moments_about_center_kg_m2", input, any, kAtEnd, [](R r) { return r.scene.top().moments_about_center_kg_m2; },
          vector)),
      of_scenario(compared("top.spin_rad_s", input, any, kAtEnd, [](R r) { return r.scene.top().spin_rad_s; })),
      of_scenario(compared("top.rotor_spin_rad_s", input, any, kAtEnd,
                           [](R r) { return of_a_rotor(r, r.scene.top().rotor_spin_rad_s); })),
      of_scenario(compared("top.rotor_momentum_kg_m2_s", derived, any, kAtEnd,
                           [](R r) { return of_a_rotor(r, r.scene.top().rotor_momentum_kg_m2_s); })),
      of_scenario(
          compared("top.slow_precession_rad_s", derived, any, kAtEnd, [](R r) { return r.scene.top().slow_precession_rad_s; })),
      of_scenario(compared("top.slow_precession_period_s", derived, any, kAtEnd,
                           [](R r) { return period_of(r.scene.top().slow_precession_rad_s); })),
      of_scenario(
          compared("top.fast_precession_rad_s", derived, any, kAtEnd, [](R r) { return r.scene.top().fast_precession_rad_s; })),
      of_scenario(compared("top.fast_precession_period_s", derived, any, kAtEnd,
                           [](R r) { return period_of(r.scene.top().fast_precession_rad_s); })),
      of_scenario(
          compared("top.mean_precession_rad_s", derived, any, kAtEnd, [](R r) { return r.scene.top().mean_precession_rad_s; })),
      of_scenario(told("top.mean_precession_bound_rad_s", kAtEnd, kIsBounded,
                       [](R r) { return r.scene.top().mean_precession_bound_rad_s; })),
      of_scenario(compared("top.mean_precession_period_s", derived, any, kAtEnd,
                           [](R r) { return period_of(r.scene.top().mean_precession_rad_s); })),
      of_scenario(compared("top.nutation_rad_s", derived, any, kAtEnd, [](R r) { return r.scene.top().nutation_rad_s; })),
      of_scenario(
          compared("top.nutation_period_s", derived, any, kAtEnd, [](R r) { return period_of(r.scene.top().nutation_rad_s); })),
      of_scenario(compared("top.nutation_kind", word, any, kAtEnd, [](R r) { return to_word(r.scene.top().nutation_kind); })),
      of_scenario(
          compared("top.critical_spin_rad_s", derived, any, kAtEnd, [](R r) { return r.scene.top().critical_spin_rad_s; })),
      of_scenario(
          compared("top.spin_over_critical", derived, any, kAtEnd, [](R r) { return r.scene.top().spin_over_critical; })),
      of_scenario(compared("top.rim_speed_m_s", derived, any, kAtEnd, [](R r) { return r.scene.top().rim_speed_m_s; })),
      // Of a body in gimbals: moments about both axes; small swings about the place of rest; what would imitate the Earth.
      object_or_nothing("top.gimbals", [](R r) { return r.scene.scenario().gimbals.has_value(); }),
      of_scenario(compared("top.gimbals.outer_moment_kg_m2", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->outer_moment_kg_m2; })),
      of_scenario(compared("top.gimbals.inner_moment_kg_m2", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->inner_moment_kg_m2; })),
      of_scenario(compared("top.gimbals.slow_period_s", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->slow_period_s; })),
      of_scenario(compared("top.gimbals.fast_period_s", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->fast_period_s; })),
      of_scenario(compared("top.gimbals.outer_rest_rad", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->outer_rest_rad; })),
      of_scenario(compared("top.gimbals.inner_rest_rad", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->inner_rest_rad; })),
      of_scenario(compared("top.gimbals.earth_torque_N_m", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->earth_torque_N_m; })),
      of_scenario(compared("top.gimbals.earth_offset_m", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->earth_offset_m; })),
      of_scenario(compared("top.gimbals.earth_nutation_rad", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().gimbals->earth_nutation_rad; })),
      // These belong to a laboratory that travels.
      object_or_nothing("travel", [](R r) { return r.scene.scenario().travel.has_value(); }),
      of_scenario(
          compared("travel.reference", word, any, kAtEnd, [](R r) { return to_word(r.scene.scenario().travel->reference); })),
      of_scenario(compared("travel.eotvos", word, any, kAtEnd, [](R r) { return to_word(r.scene.scenario().travel->eotvos); })),
      of_scenario(compared("travel.length_m", derived, any, kAtEnd, [](R r) { return r.scene.top().journey->length_m; })),
      of_scenario(compared("travel.end_latitude_deg", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->end_latitude_deg; })),
      of_scenario(compared("travel.end_longitude_deg", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->end_longitude_deg; })),
      of_scenario(
          compared("travel.end_height_m", derived, any, kAtEnd, [](R r) { return r.scene.top().journey->end_height_m; })),
      of_scenario(compared("travel.transport_rate_rad_s", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->transport_rate_rad_s; })),
      of_scenario(compared("travel.transport_over_earth", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->transport_over_earth; })),
      of_scenario(
          compared("travel.plumb_lean_rad", derived, any, kAtEnd, [](R r) { return r.scene.top().journey->plumb_lean_rad; })),
      of_scenario(compared("travel.acceleration_m_s2", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->acceleration_m_s2; })),
      of_scenario(compared("travel.false_north_start_rad", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->false_north_start_rad; })),
      of_scenario(compared("travel.false_north_end_rad", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->false_north_end_rad; })),
      of_scenario(
          compared("travel.wander_rad_s", derived, any, kAtEnd, [](R r) { return r.scene.top().journey->wander_rad_s; })),
      of_scenario(compared("travel.transport_wander_rad_s", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->transport_wander_rad_s; })),
      of_scenario(compared("travel.table_noise_m_s2", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->table_noise_m_s2; })),
      of_scenario(
          compared("travel.schuler_kappa", derived, any, kAtEnd, [](R r) { return r.scene.top().journey->schuler_kappa; })),
      of_scenario(compared("travel.schuler_period_s", derived, any, kAtEnd,
                           [](R r) { return r.scene.top().journey->schuler_period_s; })),
      told(
          "top.notes", kAtEnd, kWords, [](R r) { return r.scene.top().notes; }, words),
      told(
          "top.left_out", kAtEnd, kWords, [](R r) { return r.scene.top().left_out; }, words),
  };
}();

}  // namespace earthtop::figure_table
