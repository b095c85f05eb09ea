// SPDX-License-Identifier: GPL-3.0-or-later
/// The carriers of the body in both motions: the laboratory L on its journey (journey.hpp), and the platform P on it. Vectors are found in L,
/// as pairs, and are then seen from the axes A of the integration.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

/// The axes of L in A: those of the reference, and their change over epsilon.
template <class T>
struct LaboratoryAxes {
  Mat3<T> R_AL, change;
  bool is_changed;

  LaboratoryAxes(const Journey<T>& journey, const T& t) : is_changed(journey.has_still_reference()) {
    R_AL.col(0) = journey.at(JourneyPart::east, t), R_AL.col(1) = journey.at(JourneyPart::north, t);
    R_AL.col(2) = journey.at(JourneyPart::up, t);
    if (!is_changed) return;
    change.col(0) = journey.at(JourneyPart::east_change, t), change.col(1) = journey.at(JourneyPart::north_change, t);
    change.col(2) = journey.at(JourneyPart::up_change, t);
  }
  /// A vector of the reference in A.
  Vec3<T> reference(const Vec3<T>& u_L) const { return times(R_AL, u_L); }
  /// The change over epsilon, in A, of a vector that is u_L in the reference and u_L + epsilon change_L in the rotating motion.
  Vec3<T> difference(const Vec3<T>& u_L, const Vec3<T>& change_L, const T& epsilon) const {
    const Vec3<T> turned = times(R_AL, change_L);
    return is_changed ? Vec3<T>(turned + times(change, Vec3<T>(u_L + epsilon * change_L))) : turned;
  }
  /// A vector of A, as both motions see it in L.
  Vec3<Paired<T>> into_L(const Vec3<T>& u_A, const Vec3<T>& change_A, const T& epsilon) const {
    Vec3<T> difference_L = transposed_times(R_AL, change_A);
    if (is_changed) difference_L += transposed_times(change, Vec3<T>(u_A + epsilon * change_A));
    return paired_vector(transposed_times(R_AL, u_A), difference_L, epsilon);
  }
};

/// How L turns in inertial space, in L: its rate, and the rate's derivative as L sees it.
template <class T>
struct LaboratoryTurning {
  Vec3<Paired<T>> w_IL_L, alpha_IL_L;
  Vec3<T> W_L_scaled;       ///< the rate of the axes A over epsilon
  Vec3<Paired<T>> earth_L;  ///< the Earth's rate: with `same_path` that of A, with `at_rest` the same in both motions

  LaboratoryTurning(const Model<T>& model, const LaboratoryAxes<T>& axes, const T& t) {
    const Journey<T>& journey = model.journey;
    const Vec3<T> rate = journey.at(JourneyPart::rate, t), slope = journey.at(JourneyPart::rate_slope, t);
    if (axes.is_changed) {
      W_L_scaled = Vec3<T>::Zero();
      earth_L = axes.into_L(rate, Vec3<T>(Vec3<T>::Zero()), model.epsilon);
      w_IL_L = paired_vector(rate, journey.at(JourneyPart::rate_change, t), model.epsilon);
      alpha_IL_L = paired_vector(slope, journey.at(JourneyPart::slope_change, t), model.epsilon);
    } else {
      // The Earth's rate is at rest in A, and turns with -w_EL in L.
      W_L_scaled = transposed_times(axes.R_AL, model.W_IL_L_scaled);
      earth_L = paired_vector(Vec3<T>(Vec3<T>::Zero()), W_L_scaled, model.epsilon);
      w_IL_L = paired_vector(rate, W_L_scaled, model.epsilon);
      alpha_IL_L = paired_vector(slope, Vec3<T>(W_L_scaled.cross(rate)), model.epsilon);
    }
  }
};

/// How the carrier P turns in inertial space, in L.
template <class T>
struct CarrierTurning {
  Vec3<Paired<T>> w_IP_L, alpha_IP_L;

  CarrierTurning(const LaboratoryTurning<T>& laboratory, const PrescribedMotion<T>& turn, const T& t) {
    const Vec3<Paired<T>> w_LP = paired_vector(Vec3<T>(turn.angle_rate(t) * turn.axis));
    w_IP_L = laboratory.w_IL_L + w_LP;
    alpha_IP_L = laboratory.alpha_IL_L + paired_vector(Vec3<T>(turn.angle_acceleration(t) * turn.axis)) +
                 Vec3<Paired<T>>(laboratory.w_IL_L.cross(w_LP));
  }
};

/// What the rotating body's rate is more than the reference's at release, over epsilon, in body axes, because its laboratory moves on and
/// the reference's stays: where the rates relative to the laboratories are the same.
template <class T>
Vec3<T> rate_change_at_release(const Model<T>& model, const NaturalRelease<T>& release) {
  if (!model.journey.has_still_reference() || release.X == RatesRelativeTo::inertial) return Vec3<T>::Zero();
  return transposed_times(rotation_matrix(release.q_LB), model.journey.at(JourneyPart::rate_change, T(0)));
}

/// The field at the pivot of a laboratory on a journey, in A: apparent gravity, which turns with L, less the pivot's acceleration. The
/// pivot is L's origin, or rides on a platform.
template <class T>
PivotField<T> field_on_journey(const Model<T>& model, const T& t) {
  const Journey<T>& journey = model.journey;
  const T& epsilon = model.epsilon;
  const T& g = model.apparent_gravity_L[2];
  Vec3<T> reference = g * journey.at(JourneyPart::up, t) + journey.at(JourneyPart::field, t), difference;
  if (journey.has_still_reference()) {
    difference = g * journey.at(JourneyPart::up_change, t) + journey.at(JourneyPart::field_change, t);
  } else if (journey.is_felt()) {
    difference = T(-2) * model.W_IL_L_scaled.cross(journey.at(JourneyPart::velocity, t));
    if (journey.is_felt_by_both()) reference += epsilon * difference, difference = Vec3<T>::Zero();
  } else {
    difference = Vec3<T>::Zero();
  }
  const Platform<T>& platform = model.platform;
  if (!platform.is_offset()) return {reference + epsilon * difference, reference, difference};
  const LaboratoryAxes<T> axes(journey, t);
  const CarrierTurning<T> carrier(LaboratoryTurning<T>(model, axes, t), platform.turn, t);
  const Vec3<Paired<T>> d_L =
      paired_vector(Vec3<T>(turn_matrix(platform.turn.axis, platform.turn.angle(t)) * platform.pivot_offset_P));
  const Vec3<Paired<T>> acceleration_L =
      carrier.alpha_IP_L.cross(d_L) + carrier.w_IP_L.cross(Vec3<Paired<T>>(carrier.w_IP_L.cross(d_L)));
  const Vec3<T> of_reference = parts(acceleration_L, &Paired<T>::ref), change = parts(acceleration_L, &Paired<T>::diff);
  reference -= axes.reference(of_reference);
  difference -= axes.difference(of_reference, change, epsilon);
  return {reference + epsilon * difference, reference, difference};
}

/// The rotating motion of a drift state or of a sample, seen from the laboratory on a journey.
template <class State, class T>
void see_rotating_from_journey(const Model<T>& model, State& s, const T& t) {
  s.q_LB = model.journey.attitude(t, true).conjugate() * s.q_LB;
  Vec3<T> w_AL_L = model.journey.at(JourneyPart::rate, t);
  if (model.journey.has_still_reference()) w_AL_L += model.epsilon * model.journey.at(JourneyPart::rate_change, t);
  s.w_LB_B -= transposed_times(rotation_matrix(s.q_LB), w_AL_L);
}

}  // namespace earthtop
