// SPDX-License-Identifier: GPL-3.0-or-later
/// The error bound of a drift: the distance to a second integration, in another observer's equations and at another tolerance,
/// multiplied by a safety factor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// The unit in the last place of a precision.
inline double epsilon_of(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return static_cast<double>(real::epsilon<float80>());
    case Precision::bits113: return static_cast<double>(real::epsilon<float128>());
  }
  return real::epsilon<double>();
}

/// The nudge of a second integration, and the round-off of the drift measures, in units in the last place. A nudge shows how
/// sensitive the drift is to its inputs, which is no error of a drift for exactly these inputs: it has to be no more than what the
/// rounding of the scene and of the first steps may be. In 2,250 random scenes with the bound of a fixed pivot the two integrations
/// agreed by chance too often with 1 or 2 units (the error of an attitude was up to 0.9 of its bound), and with 8 the bounds were
/// wider for nothing. On a table both are smaller: with those of a fixed pivot the median bound was 600 times the error in 41 random
/// scenes, with these 80 times.
struct RoundOffUnits {
  double nudge, measures;
};
inline constexpr RoundOffUnits kOnPivot{4, 1024}, kOnTable{2, 32};
template <class T>
const RoundOffUnits& round_off_of(const DriftProblem<T>& problem) {
  return problem.table ? kOnTable : kOnPivot;
}

/// Changes the contact by some units in the last place, as `nudge` changes the model; the body stays symmetric if it is so.
/// Regularisations, lengths of further friction, weights, gradient and air stay as they are.
template <class T>
void nudge_contact(Contact<T>& contact, T unit) {
  // All members have a name here, so that a further one is not forgotten.
  auto& [law, has_spinning_friction, has_rolling_resistance, has_gradient, omits_torques, mass, tip_radius, viscosity,
         coefficient, slip_floor, patch_radius, slip_of_spin, spin_of_slip, moment_factor, spinning_length, rolling_length,
         rate_floor, p_OC_B, I_BC_B, I_BC_B_inverse, S_BC_B, height_of_center, I1, I3, weights, gradient_H, air] = contact;
  Vec3<T> stretch(T(1) + unit, T(1) - unit, T(1) + unit / T(2));
  if (is_symmetric(contact)) stretch[1] = stretch[0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      I_BC_B_inverse(i, j) *= stretch[i] * stretch[j];
      I_BC_B(i, j) /= stretch[i] * stretch[j];
    }
  S_BC_B = (I_BC_B.trace() / T(2)) * Mat3<T>::Identity() - I_BC_B;
  I1 /= stretch[0] * stretch[0], I3 /= stretch[2] * stretch[2];
  p_OC_B *= T(1) + unit, height_of_center *= T(1) + unit;
  tip_radius *= T(1) - unit;
  mass *= T(1) + unit;
  viscosity *= T(1) + unit, coefficient *= T(1) + unit, patch_radius *= T(1) - unit;
}

/// Changes a suspension by some units in the last place: its angles as a turn of the body would, rates and the outer gimbal's moments.
template <class T>
void nudge_gimbals(Gimbals<T>& gimbals, T unit) {
  GimbalAngles<T>& release = gimbals.release;
  release.outer += unit, release.inner -= T(0.7) * unit;
  release.outer_rate *= T(1) + unit, release.inner_rate *= T(1) - unit;
  gimbals.ring.I *= T(1) + unit, gimbals.ring.S *= T(1) + unit, gimbals.ring.mass_moment *= T(1) - unit;
}

/// The parts of a release that are nudged: each component by itself, or attitude and rate as a whole, so that a component that is small, or
/// exactly zero, changes by units of the largest one.
enum class Nudged { components, whole };

/// By how much each component (w, x, y, z) of an attitude changes, in units of the nudge: the usual change, and others for an attitude
/// whose tilt or azimuth the usual one happens to leave alone. (A gyroscope that a gimbal holds level drifts by its tilt's rounding.)
template <class T>
std::array<double, 4> attitude_nudge(const Quaternion<T>& q_LB) {
  constexpr std::array<std::array<double, 4>, 4> kChanges{
      {{1, -1, 0.5, -0.5}, {1, -0.2, 0.6, -0.7}, {-0.3, 1, 0.5, 0.8}, {0.7, 0.4, -1, 0.1}}};
  constexpr double kSeen = 0.1, kUpright = 1e-3;
  const Quaternion<double> q{static_cast<double>(q_LB.w), q_LB.v.template cast<double>()};
  const Vec3<double> up_B = rotation_matrix(q).row(2).transpose();
  const double across = real::hypot(up_B[0], up_B[1]);
  if (across < kUpright) return kChanges[0];
  const auto seen = [&](const std::array<double, 4>& change) {  // the smaller one of the changes of tilt and azimuth
    const Quaternion<double> changed{change[0] * q.w, Vec3<double>(change[1] * q.v[0], change[2] * q.v[1], change[3] * q.v[2])};
    const Vec3<double> turn = 2 * (q.conjugate() * changed).v;
    return std::min(std::abs(turn[1] * up_B[0] - turn[0] * up_B[1]), std::abs(turn[0] * up_B[0] + turn[1] * up_B[1])) / across;
  };
  return seen(kChanges[0]) > kSeen ? kChanges[0] : *std::ranges::max_element(kChanges, {}, seen);
}

/// Changes the attitude, rates and moments of a problem by some units in the last place, in no special direction. The change is
/// well above the rounding of the scene to T, so that a nudged run does not share this error with a run that is not nudged.
template <class T>
void nudge(DriftProblem<T>& problem, T units, Nudged nudged) {
  const T kUnit = units * real::epsilon<T>();
  Quaternion<T>& q_LB = problem.release.q_LB;
  Vec3<T>& w_XB_B = problem.release.w_XB_B;
  if (nudged == Nudged::whole) {
    const Vec3<T> turn = kUnit * Vec3<T>(T(0.6), T(-0.5), T(0.7));
    q_LB = (q_LB * Quaternion<T>{T(1), turn / T(2)}).normalized();
    w_XB_B += kUnit * norm(w_XB_B) * Vec3<T>(T(0.6), T(-0.5), T(-0.7));
  } else {
    const std::array<double, 4> change = attitude_nudge(q_LB);
    Vec3<T> v = q_LB.v;
    for (int i = 0; i < 3; ++i) v[i] *= T(1) + T(change[static_cast<std::size_t>(i) + 1]) * kUnit;
    q_LB = Quaternion<T>{q_LB.w * (T(1) + T(change[0]) * kUnit), v}.normalized();
    w_XB_B = w_XB_B.cwiseProduct(Vec3<T>(T(1) + kUnit, T(1) + kUnit / T(2), T(1) - kUnit));
  }
  problem.model.mass_moment_B *= T(1) + kUnit;
  // Each moment changes differently, the tensor consistently with its inverse; but a symmetric top stays exactly symmetric.
  Model<T>& model = problem.model;
  Vec3<T> stretch(T(1) + kUnit, T(1) - kUnit, T(1) + kUnit / T(2));
  if (const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B); axis >= 0)
    stretch[(axis + 1) % 3] = stretch[(axis + 2) % 3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      model.I_BP_B_inverse(i, j) *= stretch[i] * stretch[j];
      model.I_BP_B(i, j) /= stretch[i] * stretch[j];
    }
  // What acts as gravity does, whatever the rates: numbers that are 0 stay so.
  GivenTorque<T>& given = model.applied.given;
  given.x *= T(1) + kUnit, given.y *= T(1) - kUnit, given.z *= T(1) + kUnit / T(2);
  SupportStiffness<T>& support = model.applied.support;
  support.east *= T(1) - kUnit, support.east_north *= T(1) - kUnit, support.north *= T(1) - kUnit;
  if (model.kind == SceneKind::suspension) nudge_gimbals(model.gimbals, kUnit);
  if (problem.table) {
    nudge_contact(problem.table->contact, kUnit);
    problem.table->start.p_O[2] = problem.table->contact.tip_radius;
  }
}

/// Which nudge contains the rounding of a first integration. Body axes, the equations without the spin and the closed forms keep the
/// digits of each component, however small: a top that is released upright stays so but for the Earth. Momenta in outer axes do not:
/// there round-off turns even an exact spin about a principal axis away from that axis.
template <class T>
Nudged nudged_for(const DriftProblem<T>& problem, const IntegrationOptions& first) {
  if (problem.table || first.method == Method::long_horizon) return Nudged::whole;
  const bool by_components =
      is_exact(first.method) || first.observer == Observer::body || takes_reduced_form(problem.model, first);
  return by_components ? Nudged::components : Nudged::whole;
}

/// Bounds the error of the drift from two integrations, row by row. The bound is a multiple of the largest distance so far,
/// plus the round-off of the drift measures themselves.
///
/// The second integration differs from that of the rows in method and observer, and has a much finer tolerance where one
/// exists, so that their distance is the error of the rows. Where round-off dominates, both have errors of similar size, which
/// the multiple covers. The second integration starts from a nudged scene, so that the distance also shows the growth of the
/// scene's own rounding. Distances are taken between the *vectors* of the drift in laboratory axes as well as between the
/// angles, because a vector difference does not pass through zero by chance.
template <class T>
class DriftBound {
 public:
  explicit DriftBound(int safety, const RoundOffUnits& units = kOnPivot)
      : round_off_(T(units.measures) * real::epsilon<T>()), safety_(safety) {}

  void include(const DriftMeasures<T>& rows, const DriftMeasures<T>& second, T epsilon) {
    const T axis_vector = epsilon * norm(Vec3<T>(rows.axis_difference_L_scaled - second.axis_difference_L_scaled));
    const T turn_vector = T(2) * epsilon * norm(Vec3<T>(rows.attitude_vector_L_scaled - second.attitude_vector_L_scaled));
    axis_distance_ = std::max({axis_distance_, real::abs(rows.axis - second.axis), axis_vector});
    attitude_distance_ = std::max({attitude_distance_, real::abs(rows.attitude - second.attitude), turn_vector});
    axis_largest_ = std::max(axis_largest_, rows.axis);
    attitude_largest_ = std::max(attitude_largest_, rows.attitude);
  }
  /// Includes the tips of a top on a table (m).
  void include(const ContactDriftState<T>& rows, const ContactDriftState<T>& second, T epsilon) {
    T apart[3], drift[3];
    for (int i = 0; i < 3; ++i)
      apart[i] = epsilon * (rows.tip_L[i].diff - second.tip_L[i].diff), drift[i] = epsilon * rows.tip_L[i].diff;
    tip_distance_ = std::max(tip_distance_, T(real::hypot(apart[0], apart[1], apart[2])));
    tip_largest_ = std::max(tip_largest_, T(real::hypot(drift[0], drift[1], drift[2])));
  }
  /// Includes the rotors of a gyrostat.
  void include(const RotorState<T>& rows, const RotorState<T>& second, T epsilon) {
    const T vector = epsilon * norm(Vec3<T>(rows.axis.difference_L_scaled - second.axis.difference_L_scaled));
    rotor_axis_.include(rows.axis.angle, std::max(vector, T(real::abs(rows.axis.angle - second.axis.angle))));
    rotor_rate_.include(epsilon * rows.rate_difference_scaled,
                        epsilon * (rows.rate_difference_scaled - second.rate_difference_scaled));
    rotor_angle_.include(epsilon * rows.angle_difference_scaled,
                         epsilon * (rows.angle_difference_scaled - second.angle_difference_scaled));
    has_rotor_ = true;
  }
  /// Includes the gimbals of a Cardan suspension.
  void include(const GimbalState<T>& rows, const GimbalState<T>& second, T epsilon) {
    outer_angle_.include(epsilon * rows.outer.diff, epsilon * (rows.outer.diff - second.outer.diff));
    inner_angle_.include(epsilon * rows.inner.diff, epsilon * (rows.inner.diff - second.inner.diff));
    headline_ = rows.headline;
  }
  /// Includes all that two samples have.
  void include(const DriftSample<T>& rows, const DriftSample<T>& second) {
    const T epsilon = rows.state.epsilon;
    include(rows.measures, second.measures, epsilon);
    if (rows.contact && second.contact) include(*rows.contact, *second.contact, epsilon);
    if (rows.rotor && second.rotor) include(*rows.rotor, *second.rotor, epsilon);
    if (rows.gimbals && second.gimbals) include(*rows.gimbals, *second.gimbals, epsilon);
  }
  /// Includes the error of a row that the method itself states.
  void include_stated(T error) { stated_ = std::max(stated_, error); }
  T axis() const { return T(safety_) * axis_distance_ + round_off_ * axis_largest_ + stated_; }
  /// The bound on the error of the drift that is watched: of a rotor's axis, of a gimbal's angle, else of body axis 3.
  T watched_axis() const {
    if (headline_ != GimbalHeadline::axis) return headline_ == GimbalHeadline::outer ? outer_angle() : inner_angle();
    return has_rotor_ ? rotor_axis() : axis();
  }
  /// The bounds on the errors of the drifts of both gimbals' angles (rad).
  T outer_angle() const { return of(outer_angle_); }
  T inner_angle() const { return of(inner_angle_); }
  /// The bounds on the errors of the drifts of a rotor: of its axis (rad), its rate (rad/s) and its angle (rad).
  T rotor_axis() const { return of(rotor_axis_) + stated_; }
  T rotor_rate() const { return of(rotor_rate_); }
  T rotor_angle() const { return of(rotor_angle_); }
  /// The bound on the error of the tip's drift (m).
  T tip() const { return T(safety_) * tip_distance_ + round_off_ * tip_largest_; }
  /// The bound is never below that of the axis, which is part of the attitude: in an unstable scene two runs can agree in
  /// one of the two by chance.
  T attitude() const {
    return T(safety_) * std::max(attitude_distance_, axis_distance_) + round_off_ * attitude_largest_ + stated_;
  }

 private:
  /// The largest drift of some quantity, and its largest distance from that of the second integration.
  struct Distance {
    T largest = T(0), distance = T(0);
    void include(const T& drift, const T& apart) {
      largest = std::max(largest, T(real::abs(drift))), distance = std::max(distance, T(real::abs(apart)));
    }
  };
  T of(const Distance& one) const { return T(safety_) * one.distance + round_off_ * one.largest; }

  T round_off_;
  Distance rotor_axis_, rotor_rate_, rotor_angle_, outer_angle_, inner_angle_;
  GimbalHeadline headline_ = GimbalHeadline::axis;
  bool has_rotor_ = false;
  T axis_distance_ = T(0), attitude_distance_ = T(0), axis_largest_ = T(0), attitude_largest_ = T(0);
  T tip_distance_ = T(0), tip_largest_ = T(0);
  T stated_ = T(0);
  int safety_;
};

}  // namespace earthtop
