// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes of bodies in which masses move, for the tests.
#pragma once

#include <memory>
#include <random>

#include "earthtop/scenario/support.hpp"
#include "support/rotor_scenes.hpp"

namespace earthtop::testing {

/// A mass on a path of each kind that moves, near the middle of a body of the size of the toy gyroscope.
inline MovingMassSpec any_mass(std::mt19937_64& random, MassMotion motion, double duration_s) {
  const auto number = [&](double least, double most) { return std::uniform_real_distribution<double>(least, most)(random); };
  const auto place = [&](double size) { return std::array{number(-size, size), number(-size, size), number(-size, size)}; };
  MovingMassSpec mass;
  mass.mass_kg = number(5e-4, 5e-3);
  mass.motion = motion;
  if (motion != MassMotion::waypoints && motion != MassMotion::table) mass.center_m = place(0.03);
  if (motion == MassMotion::harmonic) mass.amplitude_m = place(0.01);
  if (motion == MassMotion::circle) {
    mass.axis = place(1);
    const auto &n = mass.axis, other = place(0.02);
    mass.start_m = {n[1] * other[2] - n[2] * other[1], n[2] * other[0] - n[0] * other[2], n[0] * other[1] - n[1] * other[0]};
  }
  if (motion == MassMotion::harmonic || motion == MassMotion::circle)
    mass.frequency_hz = number(0.3, 6), mass.phase_deg = number(0, 360);
  constexpr int kPoints = 6;
  if (motion == MassMotion::waypoints)
    for (int k = 0; k < kPoints; ++k)
      mass.times_s.push_back(duration_s * (k + number(0.1, 0.9)) / kPoints), mass.points_m.push_back(place(0.03));
  if (motion == MassMotion::table)
    for (FiledTable& table : mass.coordinates) {
      AngleTable made;
      for (int k = 0; k < kPoints; ++k)
        made.t_s.push_back(duration_s * k / (kPoints - 1)), made.value.push_back(number(-0.03, 0.03));
      table.rows = std::make_shared<const AngleTable>(std::move(made));
    }
  return mass;
}

/// Any gyrostat, or any cage without a rotor, with masses of some kinds of motion in it.
inline Scenario any_body_with_masses(std::mt19937_64& random) {
  Scenario s = any_gyrostat(random);
  if (std::uniform_int_distribution<int>(0, 3)(random) == 0) s.rotor.reset();
  const int masses = std::uniform_int_distribution<int>(1, 4)(random);
  const int first = std::uniform_int_distribution<int>(1, 4)(random);
  for (int i = 0; i < masses; ++i)
    s.moving_masses.push_back(any_mass(random, static_cast<MassMotion>((first + i) % 5), s.duration_s));
  if (!masses_move(s)) s.moving_masses.push_back(any_mass(random, MassMotion::circle, s.duration_s));
  return s;
}

}  // namespace earthtop::testing
