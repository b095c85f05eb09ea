// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario file as the reference program reads it, with its own reader of the same keys, in 113 bits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "extended.hpp"

namespace headlines {

/// A turntable or rocking table that carries the pivot round its centre.
struct Platform {
  Vec axis;                                      ///< unit, laboratory axes
  Vec offset;                                    ///< from the centre to the pivot at angle 0, laboratory axes (m)
  Real rate = 0, acceleration = 0;               ///< angle = rate t + acceleration t^2 / 2 ...
  Real amplitude = 0, frequency = 0, phase = 0;  ///< ... + amplitude sin(2 pi frequency t + phase)
};

/// A table on which the tip, a sphere with its centre at the body's origin, slides or rolls.
struct Contact {
  Real tip_radius = 0;            ///< m
  bool rolling = false;           ///< else dry friction on a patch (contensou)
  Real friction = 0;              ///< coefficient
  Real patch_radius = 0;          ///< m
  bool released_rolling = false;  ///< else the tip's centre is released at rest
};

/// The torques between two parts about the axis on which one turns in the other.
struct Bearing {
  bool locked = false;
  Real viscous = 0;                      ///< torque over the rate (N m s)
  Real coulomb = 0, regularisation = 1;  ///< torque coulomb rate/sqrt(rate^2 + regularisation^2) (N m, rad/s)
  Real torsion = 0, rest = 0;            ///< of a spring (N m/rad, rad)

  Real torque(Real angle, Real rate) const {
    return -viscous * rate - coulomb * rate / sqrtq(rate * rate + regularisation * regularisation) - torsion * (angle - rest);
  }
};

/// A symmetric rotor that turns about an axis of the body: free but for friction in its bearing, or driven.
struct Rotor {
  Vec axis;         ///< unit, body axes
  Real axial = 0;   ///< moment about the axis (kg m^2)
  Real spin = 0;    ///< rate relative to the body at the release (rad/s)
  Bearing bearing;  ///< of a free rotor
  bool driven = false;
  Real acceleration = 0, amplitude = 0, frequency = 0, phase = 0;  ///< of a driven rotor's rate, as of a platform's angle
};

/// A Cardan suspension, whose inner gimbal is the body.
struct Gimbals {
  Quat q_P0;             ///< from the axes of the outer gimbal at angle 0 into those of laboratory or platform
  Quat q_skew;           ///< from the body's axes at angle 0 into those of the outer gimbal
  Mat ring_inertia;      ///< of the outer gimbal about the pivot, its own axes (kg m^2)
  Vec ring_mass_moment;  ///< its mass x centre of mass (kg m)
  Bearing outer, inner;
  Real outer_angle = 0, inner_angle = 0, outer_rate = 0, inner_rate = 0;  ///< at the release (rad, rad/s)
};

/// Place of a point with its time derivatives, in the axes of what it rides on.
struct Place {
  Vec at, velocity, acceleration;
};

/// A point mass on a given path in the body or in the outer gimbal: centre + along_cos cos(angle) + along_sin sin(angle), where
/// angle = 2 pi frequency t + phase; or, with waypoints, straight lines between them.
struct MovingMass {
  Real mass = 0;  ///< kg
  bool on_ring = false;
  Vec centre, along_cos, along_sin;  ///< m
  Real frequency = 0, phase = 0;     ///< Hz, rad
  std::vector<Real> times;           ///< at which it rests at the waypoints (s)
  std::vector<Vec> points;           ///< the waypoints (m)

  Place place(Real t) const;
};

/// What acts beside gravity: friction of the body axes, a support that is stiffer along a horizontal direction, a torque that
/// is given, and on a table the force of the air. Rates and velocities are those relative to the laboratory.
struct Acting {
  Vec friction;                      ///< torque over the rate about each body axis (N m s)
  Real stiffness = 0;                ///< kappa of the energy kappa (n.e)^2 / 2 (N m)
  Vec stiff_direction;               ///< e, unit, laboratory axes
  Vec torque;                        ///< its amplitude (N m)
  bool torque_of_body = true;        ///< else of the laboratory
  bool torque_oscillates = false;    ///< as sin(2 pi frequency t + phase)
  Real frequency = 0, phase = 0;     ///< Hz, rad
  Real drag = 0, drag_by_speed = 0;  ///< force over the velocity (N s/m), and over its square (N s^2/m^2)
};

/// A part of a journey; what changes in it does so by x^3 (10 - 15 x + 6 x^2).
struct Leg {
  Real start = 0, duration = 0;            ///< s; a duration of 0 for what follows the last one
  Real speed_before = 0, speed_after = 0;  ///< m/s
  Real turned_before = 0, turn = 0;        ///< rad
  Real climbed_before = 0, climb = 0;      ///< m
};

/// A journey of the laboratory.
struct Travel {
  bool geodesic = false;          ///< else a rhumb line
  Real radius = 6378137, e2 = 0;  ///< of the ellipsoid, or of a sphere (m)
  SinCos latitude, course;        ///< at the start
  Real height = 0;                ///< m
  std::vector<Leg> legs;          ///< the last one has no end
  bool still_reference = false;   ///< whether the prediction is the laboratory that stays
};

struct Scene {
  std::string name;
  // Laboratory: East, North, Up, which are the inertial axes too at t = 0.
  Vec celestial_axis;      ///< unit, laboratory axes
  Real rotation_rate = 0;  ///< rad/s
  Real gravity = 0;        ///< apparent, along -Up (m/s^2)
  // Body; with a rotor that of both, without the rotor's axial moment.
  Real mass = 0;    ///< kg
  Vec centre;       ///< centre of mass, body axes (m)
  Vec mass_moment;  ///< mass x centre of mass, body axes (kg m)
  Mat inertia;      ///< body axes (kg m^2), about the pivot; on a table about the centre of mass
  Mat inverse_inertia;
  // Release.
  Quat q_LB;
  Vec w_XB_B;                   ///< rad/s
  bool inertial_rates = false;  ///< rates are given relative to inertial space (X = I), else to the laboratory (X = L)
  std::optional<Platform> platform;
  std::optional<Contact> contact;
  std::optional<Rotor> rotor;
  std::optional<Gimbals> gimbals;
  std::vector<MovingMass> masses;
  Acting acting;
  std::optional<Travel> travel;
  double duration = 0;
  double headline_time = 0;  ///< time of the headline's row; the duration if none is named (s)

  /// Adds the masses in the body, where they are at t, to the body's tensor and mass moment.
  Mat inertia_at(Real t) const;
  Vec mass_moment_at(Real t) const;
  /// Momentum of the masses in the body, relative to it, in its axes.
  Vec momentum_within(Real t) const;
  /// The next time after t, or the last one at all, at which the path of a mass or the journey has a corner.
  Real next_corner(Real t, Real last) const;
};

/// Adds m (p.p 1 - p p^T) to a tensor (Huygens and Steiner).
void add_point_mass(Real mass, const Vec& place, Mat& inertia);

/// @throws std::runtime_error for a scene with keys that this program does not know
Scene read_scene(const std::string& file);

}  // namespace headlines
