// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes of bodies in gimbals, for the tests.
#pragma once

#include <random>

#include "support/mass_scenes.hpp"

namespace earthtop::testing {

/// A rotor of 0.3 kg in two gimbals of the size of a hand, at rest.
inline Scenario foucault_gyroscope() {
  Scenario s;
  s.name = "foucault";
  s.site.latitude_deg = 45, s.site.gravity_m_s2 = 9.80665;
  s.body.mass_kg = 0.1;
  set_principal(s.body, 1.2e-4, 1.0e-4, 2.0e-4);
  s.rotor.emplace();
  s.rotor->mass_kg = 0.3, s.rotor->axial_kg_m2 = 2e-4, s.rotor->transverse_kg_m2 = 1.1e-4, s.rotor->spin_rad_s = 1000;
  BodySpec& ring = s.gimbals.emplace().ring.emplace();
  ring.mass_kg = 0.15;
  set_principal(ring, 4e-4, 4e-4, 3e-4);
  s.release.gimbals = GimbalReleaseSpec{20, 60, 0, 0};
  s.duration_s = 0.5, s.output_step_s = 0.05;
  return s;
}

/// A suspension of any shape: skew, off-centre masses, bearings, locks, a rotor or none, masses on either gimbal, a platform.
inline Scenario any_suspension(std::mt19937_64& random) {
  const auto number = [&](double least, double most) { return std::uniform_real_distribution<double>(least, most)(random); };
  const auto chance = [&](double share) { return number(0, 1) < share; };
  Scenario s = foucault_gyroscope();
  s.site.latitude_deg = number(-85, 85);
  GimbalsSpec& gimbals = *s.gimbals;
  gimbals.axis_tilt_deg = chance(0.4) ? 0 : number(0, 170), gimbals.axis_azimuth_deg = number(-180, 180);
  if (chance(0.5)) gimbals.axis_skew_deg = number(-20, 20);
  gimbals.ring->inertia_about = s.body.inertia_about = InertiaAbout::center_of_mass;
  set_principal(*gimbals.ring, number(2, 4) * 1e-4, number(2, 4) * 1e-4, number(2, 4) * 1e-4);
  set_principal(s.body, number(1, 1.8) * 1e-4, number(1, 1.8) * 1e-4, number(1, 1.8) * 1e-4);
  const double off = chance(0.5) ? 3e-3 : 0;
  for (double& x : gimbals.ring->center_of_mass_m) x = number(-off, off);
  for (double& x : s.body.center_of_mass_m) x = number(-off, off);
  RotorSpec& rotor = *s.rotor;
  rotor.spin_rad_s = number(100, 600) * (chance(0.5) ? 1 : -1);
  if (chance(0.5)) rotor.axis = {number(-0.4, 0.4), number(-0.4, 0.4), 1};
  for (double& x : rotor.center_m) x = number(-off, off);
  rotor.drive = static_cast<RotorDrive>(std::uniform_int_distribution<int>(0, 3)(random));
  if (rotor.drive == RotorDrive::ramp) rotor.acceleration_rad_s2 = number(-50, 50);
  if (rotor.drive == RotorDrive::harmonic)
    rotor.amplitude_rad_s = number(1, 20), rotor.frequency_hz = number(0.2, 5), rotor.phase_deg = number(0, 360);
  if (rotor.drive == RotorDrive::none && chance(0.5)) {
    rotor.viscous_torque_N_m_s = number(0, 2e-5);
    if (chance(0.5)) rotor.coulomb_torque_N_m = number(1e-5, 1e-3), rotor.regularisation_rad_s = number(0.5, 5);
  }
  for (BearingSpec* bearing : {&gimbals.outer, &gimbals.inner}) {
    if (chance(0.4)) bearing->viscous_torque_N_m_s = number(0, 2e-4);
    if (chance(0.25)) bearing->coulomb_torque_N_m = number(1e-6, 2e-4), bearing->regularisation_rad_s = number(0.02, 0.5);
    if (chance(0.3)) bearing->torsion_N_m_rad = number(0, 0.05), bearing->torsion_rest_deg = number(-90, 90);
  }
  GimbalReleaseSpec& release = *s.release.gimbals;
  release = {number(-180, 180), number(30, 150), number(-2, 2), number(-2, 2)};
  if (chance(0.2)) {
    gimbals.inner = {};
    gimbals.inner.locked = true, release.inner_rate_rad_s = 0;
    if (chance(0.3)) s.rotor.reset();
  } else if (chance(0.15)) {
    gimbals.outer = {};
    gimbals.outer.locked = true, release.outer_rate_rad_s = 0;
  }
  if (chance(0.5)) s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.duration_s = number(0.1, 0.6), s.output_step_s = s.duration_s / 10;
  if (chance(0.3)) s.platform = any_platform(random);
  if (chance(0.4)) {
    const int masses = std::uniform_int_distribution<int>(1, 3)(random);
    for (int i = 0; i < masses; ++i) {
      s.moving_masses.push_back(
          any_mass(random, static_cast<MassMotion>(std::uniform_int_distribution<int>(0, 4)(random)), s.duration_s));
      if (chance(0.4)) s.moving_masses.back().carrier = MassCarrier::outer;
    }
  }
  return s;
}

}  // namespace earthtop::testing
