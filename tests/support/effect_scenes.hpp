// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes with torques other than gravity and the Earth's.
#pragma once

#include "support/scenes.hpp"

namespace earthtop::testing {

inline constexpr double kPi = 3.14159265358979323846;

/// A flat disc at 6000 rpm with its axis held level, released at rest at `amplitude_deg` from North.
inline Scenario gyrocompass(double latitude_deg, double amplitude_deg, double damping_N_m_s) {
  Scenario s = toy_top();
  s.site.latitude_deg = latitude_deg;
  s.body.center_of_mass_m = {0, 0, 0};
  set_principal(s.body, 5e-4, 5e-4, 1e-3);
  s.release.tilt_deg = 90;
  s.release.azimuth_deg = amplitude_deg;
  s.release.spin_rad_s = 200 * real::pi<double>();
  s.effects.applied.gimbal = GimbalSpec{damping_N_m_s};
  return s;
}

/// A balanced top that spins about its axis only, on an Earth at rest.
inline Scenario spinning_top() {
  Scenario s = non_rotating(toy_top());
  s.body.center_of_mass_m = {0, 0, 0};
  s.release.tilt_deg = 35;
  s.release.spin_rad_s = 100;
  s.duration_s = 4;
  s.output_step_s = 0.25;
  return s;
}

/// A spinning top that dry friction stops; in both predictions the inertial spin is 100 rad/s.
inline Scenario stopping_top(double latitude_deg, double tilt_deg, double rotation_rate_rad_s) {
  Scenario s = spinning_top();
  s.site.latitude_deg = latitude_deg;
  s.rotation_rate_rad_s = rotation_rate_rad_s;
  s.release.tilt_deg = tilt_deg;
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.effects.applied.coulomb_N_m = 2e-3;
  s.duration_s = 2.05;
  s.output_step_s = 0.005;
  return s;
}

/// All torques that can be combined, and a platform; dry friction cannot be combined with others.
inline Scenario busy_scene() {
  Scenario s = asymmetric_top();
  s.name = "busy";
  s.effects.applied.viscous_N_m_s = 2e-6;
  s.effects.applied.quadratic_N_m_s2 = 1e-8;
  s.effects.applied.air_drag.emplace().disc_radius_m = 0.05;
  s.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::given, 1e-3};
  TideSpec& tide = s.effects.tide.emplace();
  tide.given = true, tide.amplitude_m_s2 = {1e-3, 2e-3, -1e-3}, tide.frequency_hz = 0.3;
  PlatformSpec& platform = s.platform.emplace();
  platform.motion = PlatformMotion::harmonic;
  platform.axis = {0.1, 0, 1};
  platform.amplitude_rad = 0.2;
  platform.frequency_hz = 0.5;
  platform.pivot_offset_m = {0.1, 0, 0.05};
  s.duration_s = 0.5;
  s.output_step_s = 0.1;
  return s;
}

/// Friction of the body axes apart, an unequal support and a torque of the laboratory on a body with three different moments.
inline Scenario apparatus_scene() {
  Scenario s = asymmetric_top();
  s.name = "apparatus";
  AppliedTorquesSpec& applied = s.effects.applied;
  applied.viscous_by_axis_N_m_s = {4e-6, 1e-6, 2e-6};
  applied.unequal_support = UnequalSupportSpec{.kappa_N_m = 0.02, .azimuth_deg = 35};
  applied.given_torque = GivenTorqueSpec{.course = TorqueCourse::harmonic,
                                         .axes = TorqueAxes::laboratory,
                                         .torque_N_m = {2e-3, -1e-3, 3e-3},
                                         .frequency_hz = 0.7,
                                         .phase_deg = 20};
  s.duration_s = 0.5;
  s.output_step_s = 0.1;
  return s;
}

/// An asymmetric rotor in a gimbal, with the torques that a gimbal allows.
inline Scenario held_rotor() {
  Scenario s = gyrocompass(30, 10, 1e-5);
  s.name = "held-rotor";
  set_principal(s.body, 5e-4, 7e-4, 1e-3);
  s.body.center_of_mass_m = {0, 0, 0.001};
  s.release.spin_rad_s = 60;
  s.effects.applied.viscous_N_m_s = 1e-5;
  s.effects.applied.gravity_gradient = GravityGradientSpec{};
  s.duration_s = 0.2;
  s.output_step_s = 0.05;
  return s;
}

}  // namespace earthtop::testing
