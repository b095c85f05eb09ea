// SPDX-License-Identifier: GPL-3.0-or-later
/// The inputs of a scenario by which a drift is differentiated, in one table: the scenario's `uncertainty` block, its schema and
/// its documentation, the sensitivities and the effect budget read the same rows.
#pragma once

#include <cstdint>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// How an input is a number of the scenario. All but `number` change several numbers at once: the tilt of an attitude that may be
/// given as a quaternion; I3/I1 about the pivot at unchanged I1 and I2; the distances of the centre of mass from the pivot, at
/// unchanged moments about the pivot, and of the pivot from the platform's centre, at unchanged directions.
enum class InputKind : std::uint8_t { number, tilt, inertia_ratio, center_of_mass, pivot_offset };

/// The number of inputs whose standard errors every `uncertainty` block has written since the first version, 0 where they are not
/// given; they come first in the table.
inline constexpr std::size_t kCommonInputs = 7;

struct InputRow {
  std::string_view pointer;  ///< JSON pointer of its standard error; the last part of it is the input's name
  std::string_view of;       ///< JSON pointer of the number itself; empty where the input is several numbers
  std::string_view unit;
  double most;           ///< largest standard error that a scenario may state
  std::string_view doc;  ///< what it is: "standard error of ..."
  InputKind kind = InputKind::number;
  /// For InputKind::number: the number in a scenario, null where the scenario does not have it.
  double* (*number)(Scenario&) = nullptr;

  constexpr std::string_view name() const { return pointer.substr(pointer.rfind('/') + 1); }
};

namespace inputs {

/// The number if it is not 0: a coefficient that is 0 is an effect that is off.
inline double* if_on(double& number) { return number != 0 ? &number : nullptr; }
/// A member of an optional part of a scenario; null where that part is missing.
template <class Part>
double* in(std::optional<Part>& part, double Part::*member) {
  return part ? if_on((*part).*member) : nullptr;
}
inline double* on_platform(Scenario& s, double PlatformSpec::*member, bool moves_so) {
  return s.platform && moves_so ? &((*s.platform).*member) : nullptr;
}
inline bool moves(const Scenario& s, PlatformMotion motion) { return s.platform && s.platform->motion == motion; }
inline bool rubs(const Scenario& s, ContactLaw law) { return s.contact && s.contact->law == law; }

}  // namespace inputs

inline constexpr std::array<InputRow, kInputCount> kInputs = {
    InputRow{"/uncertainty/latitude_deg", "/site/latitude_deg", "deg", 90, "standard error of the latitude", InputKind::number,
             [](Scenario& s) { return &s.site.latitude_deg; }},
    {"/uncertainty/gravity_m_s2", "/site/gravity_m_s2", "m/s^2", 1e6, "standard error of apparent gravity", InputKind::number,
     [](Scenario& s) { return &s.site.gravity_m_s2; }},
    {"/uncertainty/spin_rad_s", "/release/spin_rad_s", "rad/s", 1e9, "standard error of the spin, the rate about body axis 3",
     InputKind::number,
     [](Scenario& s) {
       auto& w = s.release.angular_velocity_body_rad_s;
       return w ? &(*w)[2] : &s.release.spin_rad_s;
     }},
    {"/uncertainty/tilt_deg", "/release/tilt_deg", "deg", 180, "standard error of the tilt at release, without a gimbal",
     InputKind::tilt, nullptr},
    {"/uncertainty/rotation_rate_rad_s", "/earth/rotation_rate_rad_s", "rad/s", 1e9, "standard error of the Earth's rate",
     InputKind::number, [](Scenario& s) { return &s.rotation_rate_rad_s; }},
    {"/uncertainty/inertia_ratio", "", "", 1e6, "standard error of I3/I1 about the pivot, with I1 and I2 unchanged",
     InputKind::inertia_ratio, nullptr},
    {"/uncertainty/center_of_mass_m", "", "m", 1e6,
     "standard error of the distance from the pivot to the centre of mass, with the moments about the pivot unchanged",
     InputKind::center_of_mass, nullptr},
    {"/uncertainty/viscous_torque_N_m_s", "/effects/viscous_torque_N_m_s", "N m s", 1e9,
     "standard error of effects/viscous_torque_N_m_s, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::if_on(s.effects.applied.viscous_N_m_s); }},
    {"/uncertainty/quadratic_torque_N_m_s2", "/effects/quadratic_torque_N_m_s2", "N m s^2", 1e9,
     "standard error of effects/quadratic_torque_N_m_s2, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::if_on(s.effects.applied.quadratic_N_m_s2); }},
    {"/uncertainty/coulomb_torque_N_m", "/effects/coulomb_torque_N_m", "N m", 1e9,
     "standard error of effects/coulomb_torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::if_on(s.effects.applied.coulomb_N_m); }},
    {"/uncertainty/disc_radius_m", "/effects/air_drag/disc_radius_m", "m", 1e3,
     "standard error of effects/air_drag/disc_radius_m, with air drag", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.air_drag, &AirDragSpec::disc_radius_m); }},
    {"/uncertainty/air_density_kg_m3", "/effects/air_drag/density_kg_m3", "kg/m^3", 1e5,
     "standard error of effects/air_drag/density_kg_m3, with air drag", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.air_drag, &AirDragSpec::density_kg_m3); }},
    {"/uncertainty/air_viscosity_m2_s", "/effects/air_drag/kinematic_viscosity_m2_s", "m^2/s", 1e3,
     "standard error of effects/air_drag/kinematic_viscosity_m2_s, with air drag", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.air_drag, &AirDragSpec::kinematic_viscosity_m2_s); }},
    {"/uncertainty/gimbal_damping_N_m_s", "/effects/gimbal/damping_N_m_s", "N m s", 1e9,
     "standard error of effects/gimbal/damping_N_m_s, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.gimbal, &GimbalSpec::damping_N_m_s); }},
    {"/uncertainty/platform_rate_rad_s", "/platform/rate_rad_s", "rad/s", 1e9,
     "standard error of platform/rate_rad_s, with the motions constant and ramp", InputKind::number,
     [](Scenario& s) {
       const bool turns = inputs::moves(s, PlatformMotion::constant) || inputs::moves(s, PlatformMotion::ramp);
       return inputs::on_platform(s, &PlatformSpec::rate_rad_s, turns);
     }},
    {"/uncertainty/platform_acceleration_rad_s2", "/platform/acceleration_rad_s2", "rad/s^2", 1e9,
     "standard error of platform/acceleration_rad_s2, with the motion ramp", InputKind::number,
     [](Scenario& s) {
       return inputs::on_platform(s, &PlatformSpec::acceleration_rad_s2, inputs::moves(s, PlatformMotion::ramp));
     }},
    {"/uncertainty/platform_amplitude_rad", "/platform/amplitude_rad", "rad", 1e6,
     "standard error of platform/amplitude_rad, with the motion harmonic", InputKind::number,
     [](Scenario& s) {
       return inputs::on_platform(s, &PlatformSpec::amplitude_rad, inputs::moves(s, PlatformMotion::harmonic));
     }},
    {"/uncertainty/platform_frequency_hz", "/platform/frequency_hz", "Hz", 1e6,
     "standard error of platform/frequency_hz, with the motion harmonic", InputKind::number,
     [](Scenario& s) {
       return inputs::on_platform(s, &PlatformSpec::frequency_hz, inputs::moves(s, PlatformMotion::harmonic));
     }},
    {"/uncertainty/platform_phase_deg", "/platform/phase_deg", "deg", 360,
     "standard error of platform/phase_deg, with the motion harmonic", InputKind::number,
     [](Scenario& s) { return inputs::on_platform(s, &PlatformSpec::phase_deg, inputs::moves(s, PlatformMotion::harmonic)); }},
    {"/uncertainty/pivot_offset_m", "", "m", 1e6, "standard error of the length of platform/pivot_offset_m, where it is not 0",
     InputKind::pivot_offset, nullptr},
    {"/uncertainty/tip_radius_m", "/contact/tip_radius_m", "m", 1e3,
     "standard error of contact/tip_radius_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.contact, &ContactSpec::tip_radius_m); }},
    {"/uncertainty/sliding_viscosity_N_s_m", "/contact/sliding_viscosity_N_s_m", "N s/m", 1e9,
     "standard error of contact/sliding_viscosity_N_s_m, with the law viscous", InputKind::number,
     [](Scenario& s) { return inputs::rubs(s, ContactLaw::viscous) ? &s.contact->sliding_viscosity_N_s_m : nullptr; }},
    {"/uncertainty/sliding_viscosity_s_m", "/contact/sliding_viscosity_s_m", "s/m", 1e9,
     "standard error of contact/sliding_viscosity_s_m, with the law viscous_load", InputKind::number,
     [](Scenario& s) { return inputs::rubs(s, ContactLaw::viscous_load) ? &s.contact->sliding_viscosity_s_m : nullptr; }},
    {"/uncertainty/friction_coefficient", "/contact/friction_coefficient", "", 1e6,
     "standard error of contact/friction_coefficient, with the laws coulomb and contensou", InputKind::number,
     [](Scenario& s) {
       const bool slides = inputs::rubs(s, ContactLaw::coulomb) || inputs::rubs(s, ContactLaw::contensou);
       return slides ? inputs::if_on(s.contact->friction_coefficient) : nullptr;
     }},
    {"/uncertainty/patch_radius_m", "/contact/patch_radius_m", "m", 1e3,
     "standard error of contact/patch_radius_m, with the law contensou", InputKind::number,
     [](Scenario& s) { return inputs::rubs(s, ContactLaw::contensou) ? &s.contact->patch_radius_m : nullptr; }},
    {"/uncertainty/spinning_friction_m", "/contact/spinning_friction_m", "m", 1e3,
     "standard error of contact/spinning_friction_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.contact, &ContactSpec::spinning_friction_m); }},
    {"/uncertainty/rolling_resistance_m", "/contact/rolling_resistance_m", "m", 1e3,
     "standard error of contact/rolling_resistance_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.contact, &ContactSpec::rolling_resistance_m); }},
    {"/uncertainty/rotor_spin_rad_s", "/rotor/spin_rad_s", "rad/s", 1e9,
     "standard error of rotor/spin_rad_s, the rotor's rate at release, without a table", InputKind::number,
     [](Scenario& s) { return s.rotor && s.rotor->drive != RotorDrive::table ? &s.rotor->spin_rad_s : nullptr; }},
    {"/uncertainty/rotor_axial_kg_m2", "/rotor/axial_kg_m2", "kg m^2", 1e9, "standard error of rotor/axial_kg_m2",
     InputKind::number, [](Scenario& s) { return inputs::in(s.rotor, &RotorSpec::axial_kg_m2); }},
    {"/uncertainty/rotor_transverse_kg_m2", "/rotor/transverse_kg_m2", "kg m^2", 1e9,
     "standard error of rotor/transverse_kg_m2", InputKind::number,
     [](Scenario& s) { return inputs::in(s.rotor, &RotorSpec::transverse_kg_m2); }},
    {"/uncertainty/rotor_viscous_torque_N_m_s", "/rotor/viscous_torque_N_m_s", "N m s", 1e9,
     "standard error of rotor/viscous_torque_N_m_s, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.rotor, &RotorSpec::viscous_torque_N_m_s); }},
    {"/uncertainty/rotor_coulomb_torque_N_m", "/rotor/coulomb_torque_N_m", "N m", 1e9,
     "standard error of rotor/coulomb_torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.rotor, &RotorSpec::coulomb_torque_N_m); }},
};
static_assert(!kInputs.back().pointer.empty());

/// The names of the inputs, by which results list them.
inline constexpr std::array<std::string_view, kInputCount> kInputNames = [] {
  std::array<std::string_view, kInputCount> names;
  for (std::size_t i = 0; i < kInputCount; ++i) names[i] = kInputs[i].name();
  return names;
}();

/// Whether a scenario has an input.
bool has_input(const Scenario& scenario, std::size_t input);
/// The inputs that a scenario has: their places in the table, ascending.
std::vector<std::size_t> inputs_of(const Scenario& scenario);

}  // namespace earthtop
