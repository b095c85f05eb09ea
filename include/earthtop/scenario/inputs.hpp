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
/// A component of an optional vector; null where it is missing or 0.
inline double* component(std::optional<std::array<double, 3>>& vector, std::size_t i) {
  return vector ? if_on((*vector)[i]) : nullptr;
}
inline double* of_given_torque(Scenario& s, std::size_t i) {
  auto& given = s.effects.applied.given_torque;
  return given && given->course != TorqueCourse::table ? if_on(given->torque_N_m[i]) : nullptr;
}
inline double* of_course(Scenario& s, double GivenTorqueSpec::*member) {
  auto& given = s.effects.applied.given_torque;
  return given && given->course == TorqueCourse::harmonic ? &((*given).*member) : nullptr;
}
inline double* on_platform(Scenario& s, double PlatformSpec::*member, bool moves_so) {
  return s.platform && moves_so ? &((*s.platform).*member) : nullptr;
}
inline bool moves(const Scenario& s, PlatformMotion motion) { return s.platform && s.platform->motion == motion; }
inline bool rubs(const Scenario& s, ContactLaw law) { return s.contact && s.contact->law == law; }

inline double* at_release(Scenario& s, double GimbalReleaseSpec::*member) {
  return s.release.gimbals ? &((*s.release.gimbals).*member) : nullptr;
}
inline double* rate_at_release(Scenario& s, BearingSpec GimbalsSpec::*axis, double GimbalReleaseSpec::*member) {
  return s.gimbals && !((*s.gimbals).*axis).locked ? at_release(s, member) : nullptr;
}
inline double* of_bearing(Scenario& s, BearingSpec GimbalsSpec::*axis, double BearingSpec::*member) {
  return s.gimbals ? if_on(((*s.gimbals).*axis).*member) : nullptr;
}
/// The angle at rest of a torsion, which may be 0.
inline double* rest_of(Scenario& s, BearingSpec GimbalsSpec::*axis) {
  return of_bearing(s, axis, &BearingSpec::torsion_N_m_rad) != nullptr ? &((*s.gimbals).*axis).torsion_rest_deg : nullptr;
}
inline double* axial_of_ring(Scenario& s) {
  return s.gimbals && s.gimbals->ring ? if_on(s.gimbals->ring->inertia_kg_m2[2][2]) : nullptr;
}

/// A number of the start of a journey; a table has none.
inline double* of_start(Scenario& s, double TravelSpec::*member) {
  return s.travel && s.travel->path != TravelPath::table ? &((*s.travel).*member) : nullptr;
}

}  // namespace inputs

inline constexpr std::array<InputRow, kInputCount> kInputs = {
    InputRow{"/uncertainty/latitude_deg", "/site/latitude_deg", "deg", 90, "standard error of the latitude", InputKind::number,
             [](Scenario& s) { return &s.site.latitude_deg; }},
    {"/uncertainty/gravity_m_s2", "/site/gravity_m_s2", "m/s^2", 1e6, "standard error of apparent gravity", InputKind::number,
     [](Scenario& s) { return &s.site.gravity_m_s2; }},
    {"/uncertainty/spin_rad_s", "/release/spin_rad_s", "rad/s", 1e9, "standard error of the spin, the rate about body axis 3",
     InputKind::number,
     [](Scenario& s) {
       if (s.release.gimbals) return static_cast<double*>(nullptr);
       auto& w = s.release.angular_velocity_body_rad_s;
       return w ? &(*w)[2] : &s.release.spin_rad_s;
     }},
    {"/uncertainty/tilt_deg", "/release/tilt_deg", "deg", 180, "standard error of the tilt at release, without gimbals",
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
    {"/uncertainty/outer_angle_deg", "/release/outer_angle_deg", "deg", 360,
     "standard error of release/outer_angle_deg, with gimbals", InputKind::number,
     [](Scenario& s) { return inputs::at_release(s, &GimbalReleaseSpec::outer_angle_deg); }},
    {"/uncertainty/inner_angle_deg", "/release/inner_angle_deg", "deg", 360,
     "standard error of release/inner_angle_deg, with gimbals", InputKind::number,
     [](Scenario& s) { return inputs::at_release(s, &GimbalReleaseSpec::inner_angle_deg); }},
    {"/uncertainty/outer_rate_rad_s", "/release/outer_rate_rad_s", "rad/s", 1e9,
     "standard error of release/outer_rate_rad_s, with a gimbal that is not locked", InputKind::number,
     [](Scenario& s) { return inputs::rate_at_release(s, &GimbalsSpec::outer, &GimbalReleaseSpec::outer_rate_rad_s); }},
    {"/uncertainty/inner_rate_rad_s", "/release/inner_rate_rad_s", "rad/s", 1e9,
     "standard error of release/inner_rate_rad_s, with a gimbal that is not locked", InputKind::number,
     [](Scenario& s) { return inputs::rate_at_release(s, &GimbalsSpec::inner, &GimbalReleaseSpec::inner_rate_rad_s); }},
    {"/uncertainty/outer_torsion_N_m_rad", "/gimbals/outer/torsion_N_m_rad", "N m/rad", 1e9,
     "standard error of gimbals/outer/torsion_N_m_rad, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_bearing(s, &GimbalsSpec::outer, &BearingSpec::torsion_N_m_rad); }},
    {"/uncertainty/inner_torsion_N_m_rad", "/gimbals/inner/torsion_N_m_rad", "N m/rad", 1e9,
     "standard error of gimbals/inner/torsion_N_m_rad, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_bearing(s, &GimbalsSpec::inner, &BearingSpec::torsion_N_m_rad); }},
    {"/uncertainty/outer_torsion_rest_deg", "/gimbals/outer/torsion_rest_deg", "deg", 360,
     "standard error of gimbals/outer/torsion_rest_deg, with a torsion", InputKind::number,
     [](Scenario& s) { return inputs::rest_of(s, &GimbalsSpec::outer); }},
    {"/uncertainty/inner_torsion_rest_deg", "/gimbals/inner/torsion_rest_deg", "deg", 360,
     "standard error of gimbals/inner/torsion_rest_deg, with a torsion", InputKind::number,
     [](Scenario& s) { return inputs::rest_of(s, &GimbalsSpec::inner); }},
    {"/uncertainty/outer_viscous_torque_N_m_s", "/gimbals/outer/viscous_torque_N_m_s", "N m s", 1e9,
     "standard error of gimbals/outer/viscous_torque_N_m_s, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_bearing(s, &GimbalsSpec::outer, &BearingSpec::viscous_torque_N_m_s); }},
    {"/uncertainty/inner_viscous_torque_N_m_s", "/gimbals/inner/viscous_torque_N_m_s", "N m s", 1e9,
     "standard error of gimbals/inner/viscous_torque_N_m_s, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_bearing(s, &GimbalsSpec::inner, &BearingSpec::viscous_torque_N_m_s); }},
    {"/uncertainty/outer_coulomb_torque_N_m", "/gimbals/outer/coulomb_torque_N_m", "N m", 1e9,
     "standard error of gimbals/outer/coulomb_torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_bearing(s, &GimbalsSpec::outer, &BearingSpec::coulomb_torque_N_m); }},
    {"/uncertainty/inner_coulomb_torque_N_m", "/gimbals/inner/coulomb_torque_N_m", "N m", 1e9,
     "standard error of gimbals/inner/coulomb_torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_bearing(s, &GimbalsSpec::inner, &BearingSpec::coulomb_torque_N_m); }},
    {"/uncertainty/axis_skew_deg", "/gimbals/inner/axis_skew_deg", "deg", 90,
     "standard error of gimbals/inner/axis_skew_deg, with gimbals", InputKind::number,
     [](Scenario& s) { return s.gimbals ? &s.gimbals->axis_skew_deg : nullptr; }},
    {"/uncertainty/outer_axis_tilt_deg", "/gimbals/outer/axis_tilt_deg", "deg", 180,
     "standard error of gimbals/outer/axis_tilt_deg, with gimbals", InputKind::number,
     [](Scenario& s) { return s.gimbals ? &s.gimbals->axis_tilt_deg : nullptr; }},
    {"/uncertainty/outer_axial_kg_m2", "", "kg m^2", 1e9,
     "standard error of the moment of the outer gimbal about its axis, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::axial_of_ring(s); }},
    {"/uncertainty/viscous_torque_1_N_m_s", "/effects/viscous_torque_N_m_s/0", "N m s", 1e9,
     "standard error of effects/viscous_torque_N_m_s about body axis 1, where three are given", InputKind::number,
     [](Scenario& s) { return inputs::component(s.effects.applied.viscous_by_axis_N_m_s, 0); }},
    {"/uncertainty/viscous_torque_2_N_m_s", "/effects/viscous_torque_N_m_s/1", "N m s", 1e9,
     "standard error of effects/viscous_torque_N_m_s about body axis 2, where three are given", InputKind::number,
     [](Scenario& s) { return inputs::component(s.effects.applied.viscous_by_axis_N_m_s, 1); }},
    {"/uncertainty/viscous_torque_3_N_m_s", "/effects/viscous_torque_N_m_s/2", "N m s", 1e9,
     "standard error of effects/viscous_torque_N_m_s about body axis 3, where three are given", InputKind::number,
     [](Scenario& s) { return inputs::component(s.effects.applied.viscous_by_axis_N_m_s, 2); }},
    {"/uncertainty/support_kappa_N_m", "/effects/unequal_support/kappa_N_m", "N m", 1e9,
     "standard error of effects/unequal_support/kappa_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.unequal_support, &UnequalSupportSpec::kappa_N_m); }},
    {"/uncertainty/support_azimuth_deg", "/effects/unequal_support/azimuth_deg", "deg", 360,
     "standard error of effects/unequal_support/azimuth_deg, with an unequal support", InputKind::number,
     [](Scenario& s) {
       auto& support = s.effects.applied.unequal_support;
       return support ? &support->azimuth_deg : nullptr;
     }},
    {"/uncertainty/given_torque_1_N_m", "/effects/given_torque/torque_N_m/0", "N m", 1e9,
     "standard error of the first component of effects/given_torque/torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_given_torque(s, 0); }},
    {"/uncertainty/given_torque_2_N_m", "/effects/given_torque/torque_N_m/1", "N m", 1e9,
     "standard error of the second component of effects/given_torque/torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_given_torque(s, 1); }},
    {"/uncertainty/given_torque_3_N_m", "/effects/given_torque/torque_N_m/2", "N m", 1e9,
     "standard error of the third component of effects/given_torque/torque_N_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::of_given_torque(s, 2); }},
    {"/uncertainty/given_torque_frequency_hz", "/effects/given_torque/frequency_hz", "Hz", 1e6,
     "standard error of effects/given_torque/frequency_hz, with the course harmonic", InputKind::number,
     [](Scenario& s) { return inputs::of_course(s, &GivenTorqueSpec::frequency_hz); }},
    {"/uncertainty/given_torque_phase_deg", "/effects/given_torque/phase_deg", "deg", 360,
     "standard error of effects/given_torque/phase_deg, with the course harmonic", InputKind::number,
     [](Scenario& s) { return inputs::of_course(s, &GivenTorqueSpec::phase_deg); }},
    {"/uncertainty/air_force_linear_N_s_m", "/effects/air_force/linear_N_s_m", "N s/m", 1e9,
     "standard error of effects/air_force/linear_N_s_m, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.air_force, &AirForceSpec::linear_N_s_m); }},
    {"/uncertainty/air_force_quadratic_N_s2_m2", "/effects/air_force/quadratic_N_s2_m2", "N s^2/m^2", 1e9,
     "standard error of effects/air_force/quadratic_N_s2_m2, where it is not 0", InputKind::number,
     [](Scenario& s) { return inputs::in(s.effects.applied.air_force, &AirForceSpec::quadratic_N_s2_m2); }},
    {"/uncertainty/travel_speed_m_s", "/travel/speed_m_s", "m/s", 1e5,
     "standard error of travel/speed_m_s, of the speed at the start", InputKind::number,
     [](Scenario& s) { return inputs::of_start(s, &TravelSpec::speed_m_s); }},
    {"/uncertainty/travel_course_deg", "/travel/course_deg", "deg", 360,
     "standard error of travel/course_deg, of the course at the start", InputKind::number,
     [](Scenario& s) { return inputs::of_start(s, &TravelSpec::course_deg); }},
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
