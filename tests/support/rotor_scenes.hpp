// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes of bodies with a rotor, for the tests.
#pragma once

#include <random>

#include "support/scenes.hpp"

namespace earthtop::testing {

/// The toy gyroscope in its cage, released at rest.
inline Scenario caged_gyroscope() {
  Scenario s = toy_top();
  s.name = "caged-gyroscope";
  s.body.mass_kg = 0.024;
  s.body.center_of_mass_m = {0, 0, 0.035};
  s.body.inertia_about = InertiaAbout::center_of_mass;
  set_principal(s.body, 1e-5, 1e-5, 1.2e-5);
  s.rotor.emplace();
  s.rotor->mass_kg = 0.045, s.rotor->axial_kg_m2 = 1.6e-5, s.rotor->transverse_kg_m2 = 8.5e-6;
  s.rotor->center_m = {0, 0, 0.035};
  s.rotor->spin_rad_s = 300;
  s.release.tilt_deg = 30;
  s.release.spin_rad_s = 0;
  s.duration_s = 2;
  s.output_step_s = 0.1;
  return s;
}

inline Scenario by_general_model(Scenario s) {
  s.numerics.form = ModelForm::general;
  return s;
}

/// A platform that turns steadily, ever faster or to and fro, about any axis, with the pivot off it.
inline PlatformSpec any_platform(std::mt19937_64& random) {
  const auto number = [&](double least, double most) { return std::uniform_real_distribution<double>(least, most)(random); };
  PlatformSpec platform;
  platform.motion = static_cast<PlatformMotion>(std::uniform_int_distribution<int>(0, 2)(random));
  platform.axis = {number(-1, 1), number(-1, 1), number(-1, 1)};
  platform.rate_rad_s = number(-1, 1), platform.acceleration_rad_s2 = number(-1, 1), platform.amplitude_rad = number(0, 0.3);
  platform.frequency_hz = number(0.2, 2);
  platform.pivot_offset_m = {number(-1, 1), number(-1, 1), number(-1, 1)};
  return platform;
}

/// A cage of any shape with a rotor on any axis, with any bearing or drive.
inline Scenario any_gyrostat(std::mt19937_64& random) {
  const auto number = [&](double least, double most) { return std::uniform_real_distribution<double>(least, most)(random); };
  Scenario s = caged_gyroscope();
  s.site.latitude_deg = number(-85, 85);
  for (double& component : s.body.center_of_mass_m) component += number(-2e-3, 2e-3);
  set_principal(s.body, number(1, 1.6) * 1e-5, number(1, 1.6) * 1e-5, number(1, 1.6) * 1e-5);
  RotorSpec& rotor = *s.rotor;
  rotor.axis = {number(-1, 1), number(-1, 1), number(-1, 1.5)};
  rotor.spin_rad_s = number(-400, 400);
  s.release.tilt_deg = number(10, 120), s.release.azimuth_deg = number(0, 360);
  s.release.angular_velocity_body_rad_s = {number(-3, 3), number(-3, 3), number(-3, 3)};
  if (number(0, 1) < 0.5) s.release.rates_relative_to = RatesRelativeTo::inertial;
  rotor.drive = static_cast<RotorDrive>(std::uniform_int_distribution<int>(0, 4)(random));
  if (rotor.drive == RotorDrive::ramp) rotor.acceleration_rad_s2 = number(-50, 50);
  if (rotor.drive == RotorDrive::harmonic)
    rotor.amplitude_rad_s = number(1, 20), rotor.frequency_hz = number(0.2, 2), rotor.phase_deg = number(0, 360);
  if (rotor.drive == RotorDrive::none && number(0, 1) < 0.7) {
    rotor.viscous_torque_N_m_s = number(0, 2e-6);
    if (number(0, 1) < 0.5) rotor.coulomb_torque_N_m = number(1e-6, 3e-5), rotor.regularisation_rad_s = number(0.5, 5);
  }
  if (number(0, 1) < 0.3) s.effects.applied.viscous_N_m_s = number(0, 2e-6);
  s.duration_s = number(0.5, 3);
  s.output_step_s = s.duration_s / 10;
  if (rotor.drive == RotorDrive::table) {
    AngleTable table;
    for (int k = 0; k < 8; ++k)
      table.t_s.push_back(s.duration_s * k / 7), table.value.push_back(number(-1, 1) * rotor.spin_rad_s);
    rotor.table.rows = std::make_shared<const AngleTable>(std::move(table));
  }
  if (number(0, 1) < 0.3) s.platform = any_platform(random);
  return s;
}

}  // namespace earthtop::testing
