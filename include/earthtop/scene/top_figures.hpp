// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of a top that a balance and a stopwatch can check before any run: mass, centre of mass, moments, and the rates of
/// precession and nutation of the non-rotating top with this release.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace earthtop {

class Scene;

/// To which motion a nutation belongs.
enum class NutationKind {
  of_release,      ///< the motion that the release starts, at its full amplitude
  small_amplitude  ///< the release does not nutate: the limit of small amplitudes about its motion
};

/// The figures of a Cardan suspension, at the release and without the Earth's rotation.
struct GimbalFigures {
  double outer_moment_kg_m2 = 0, inner_moment_kg_m2 = 0;  ///< about both axes, without the rotor's axial moment
  /// Periods of small swings about the place of rest on the rotating Earth, and this place (s, rad); none where there is none near.
  std::optional<double> slow_period_s, fast_period_s, outer_rest_rad, inner_rest_rad;
  /// What would turn the rotor's axis as fast as the Earth turns: a torque, an offset of the centre of mass of body and rotor, and by its
  /// drift a nutation (rad); none without a rotor, where a gimbal is locked, or where the theory does not hold.
  std::optional<double> earth_torque_N_m, earth_offset_m, earth_nutation_rad;
};

/// The figures of a laboratory's journey.
struct JourneyFigures {
  double length_m = 0;
  double end_latitude_deg = 0, end_longitude_deg = 0, end_height_m = 0;
  double transport_rate_rad_s = 0;             ///< largest rate at which East, North and Up turn over the Earth
  std::optional<double> transport_over_earth;  ///< that over the Earth's rate; none where it does not turn
  double plumb_lean_rad = 0;                   ///< largest angle of the plumb line aboard from the ellipsoid's normal
  double acceleration_m_s2 = 0;                ///< largest over an Earth that stands still, beside what its curvature makes
  /// The azimuth of the horizontal part of the laboratory's inertial rate, at the start and at the end: false North, where a damped level
  /// compass settles (rad, clockwise from North); none where that part has no component to the North.
  std::optional<double> false_north_start_rad, false_north_end_rad;
  /// The rate at which a level axis that is free turns in azimuth at the start, clockwise, and the part of it that the journey makes (rad/s).
  double wander_rad_s = 0, transport_wander_rad_s = 0;
  std::optional<double> table_noise_m_s2;  ///< of a journey by a table: what its last digits are worth as an acceleration
  /// A pendulous compass has kappa = m l M W_N / h at the start, 1 with Schuler's tuning, and the undamped period.
  std::optional<double> schuler_kappa, schuler_period_s;
};

/// A figure is empty where its theory does not apply; `left_out` says why. All rates are those of the motion without Earth
/// rotation and without friction, from the attitude and the rates of the release, which both predictions share.
struct TopFigures {
  double mass_kg = 0;
  std::array<double, 3> center_of_mass_m{};  ///< from the pivot, body axes; on a table from the centre of the tip's sphere
  /// Principal moments about the pivot and about the centre of mass. Without products of inertia they are I1, I2 and I3 of the
  /// body axes; otherwise each stands in the place of the body axis that its principal axis is nearest to.
  std::array<double, 3> moments_about_pivot_kg_m2{};
  std::array<double, 3> moments_about_center_kg_m2{};
  double spin_rad_s = 0;  ///< component of the rate at release along body axis 3
  /// Of a gyrostat: the rotor's rate relative to the body at release (rad/s), and its momentum about its axis, of a driven one that of this
  /// rate (kg m^2/s).
  std::optional<double> rotor_spin_rad_s, rotor_momentum_kg_m2_s;

  /// The steady precessions of a symmetric top at this tilt and spin (rad/s, counterclockwise about Up): the roots of
  /// I1 cos(tilt) x^2 - I3 w3 x + m g l = 0 [Landau and Lifshitz, Mechanics, section 35]. If the axis is vertical: the rates of a
  /// small lean.
  std::optional<double> slow_precession_rad_s;
  std::optional<double> fast_precession_rad_s;

  /// The mean rate of the axis's azimuth over a nutation, by the closed form (rad/s, counterclockwise about Up): what a stopwatch
  /// shows of this release. Empty where the axis passes through the vertical, or there is no torque of gravity.
  std::optional<double> mean_precession_rad_s;
  std::optional<double> mean_precession_bound_rad_s;  ///< on its error, for exactly these inputs

  /// Angular frequency of the nutation: 2 pi over the period of the tilt, from the closed form by elliptic functions at the
  /// amplitude of the release (LagrangeTop). Without a torque of gravity: |L|/I1, the rate at which the axis goes round the
  /// angular momentum. Where the release does not nutate, the limit of small amplitudes.
  std::optional<double> nutation_rad_s;
  std::optional<NutationKind> nutation_kind;

  /// The spin above which the top sleeps upright, 2 sqrt(I1 m g l)/I3, and this spin over it, both sizes. Empty where the centre
  /// of mass is at or below the pivot.
  std::optional<double> critical_spin_rad_s;
  std::optional<double> spin_over_critical;

  /// For a body of solids: the largest of their outer radii times the size of the whole rate at release. This is the largest speed
  /// of a point of that circle relative to the circle's centre on axis 3, in whatever direction the rate points (m/s).
  std::optional<double> rim_speed_m_s;

  using OfGimbals = GimbalFigures;
  std::optional<OfGimbals> gimbals = {};

  std::optional<JourneyFigures> journey = {};

  std::vector<std::string> left_out;  ///< what does not apply, and why, each a sentence without its full stop
  std::vector<std::string> notes;     ///< what holds of the figures that are given, in the same form
};

/// The period of a rate: 2 pi over its size (s); empty where there is no rate, or a rate of 0.
std::optional<double> period_of(const std::optional<double>& rate_rad_s);

}  // namespace earthtop
