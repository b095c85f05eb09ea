// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a Cardan suspension (gimbals.hpp), written once on a scalar: a number, or the pair of both predictions.
///
/// The variables are the angles alpha and beta, and the momenta along the three free axes, each of rates in the observer's frame,
///   p_a = a.(L_A + L_B) ,  p_b = b.L_B ,  h = C (w_B.c + sigma)
/// with L_A = Theta_A w_A + l_A ,  L_B = Theta w_B + h c + l (rotor.hpp, moving_masses.hpp) ,  w_A = U + alpha' a ,  w_B = w_A + beta' b, where U is the rate at
/// which the observer sees the carrier P turn. The first two are linear in alpha' and beta', so that the rates follow from the momenta.
/// The balance of momentum of both parts, along the axes on which the bearings exert only Q_a and Q_b, gives
///   dp_a/dt = Q_a + a.(tau_A + tau_B) + (U x a).(L_A + L_B) ,  dp_b/dt = Q_b + b.tau_B + (w_A x b).L_B ,  dh/dt = Q_c + c.tau_R
/// where tau are the torques on the outer gimbal, on the body with the rotor, and on the rotor alone. There are two observers:
/// | observer   | U                            | tau                                                     |
/// | inertial   | of the Earth and the platform | of gravity and its gradient                            |
/// | laboratory | of the platform               | the same, and [F]'s Coriolis and centrifugal torques   |
/// A locked axis has no equation. No second derivative of a given motion is needed, and momenta are continuous where rates jump.
#pragma once

#include "earthtop/model/applied_torques.hpp"
#include "earthtop/model/contact_algebra.hpp"
#include "earthtop/model/model.hpp"

namespace earthtop {

/// Sine and cosine of an angle of both predictions, and their differences without cancellation:
///   sin(x + d) - sin x = 2 sin(d/2) cos(x + d/2)
template <class T>
SinCos<Paired<T>> paired_sin_cos(const Paired<T>& angle, const T& epsilon) {
  const SinCos<T> at = real::sin_cos(angle.ref), half = real::sin_cos(T(epsilon * angle.diff / T(2)));
  // At the smallest Earth rates the half angle would lose its digits, and is its own sine.
  const T chord = epsilon < T(1e-60) ? angle.diff : T(T(2) * half.sin / epsilon);
  const T sine = at.sin * half.cos + at.cos * half.sin, cosine = at.cos * half.cos - at.sin * half.sin;
  return {Paired<T>::apart(at.sin, T(chord * cosine), epsilon), Paired<T>::apart(at.cos, T(-chord * sine), epsilon)};
}
template <class T>
SinCos<T> paired_sin_cos(const T& angle, const T&) {
  return real::sin_cos(angle);
}

/// A vector or a matrix of numbers, over another scalar.
template <class S, class T, int kRows, int kColumns>
Eigen::Matrix<S, kRows, kColumns> over_scalar(const Eigen::Matrix<T, kRows, kColumns>& m) {
  Eigen::Matrix<S, kRows, kColumns> made;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) made(i, j) = S(m(i, j));
  return made;
}

/// The surroundings of a suspension, in the axes P of its carrier.
template <class S>
struct GimbalSurroundings {
  Vec3<S> turning;                  ///< U
  Vec3<S> earth;                    ///< W of the torques of [F]; not read by the inertial observer
  Vec3<S> field;                    ///< apparent gravity, tide and the acceleration of the carrier
  std::array<Vec3<S>, 2> gradient;  ///< directions of the terms of the gradient tensor
};

/// The surroundings of both motions at a time.   @tparam kLaboratory  whether the laboratory observes, else an inertial observer
template <bool kLaboratory, class T>
GimbalSurroundings<Paired<T>> gimbal_surroundings(const Model<T>& model, const T& t) {
  const PrescribedMotion<T>& turn = model.platform.turn;
  const Mat3<T> R_LP = turn_matrix(turn.axis, turn.angle(t));
  const auto into_P = [&](const Vec3<T>& v_L) -> Vec3<T> { return transposed_times(R_LP, v_L); };
  const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
  GimbalSurroundings<Paired<T>> around;
  if (!model.journey.empty()) {
    const LaboratoryAxes<T> axes(model.journey, t);
    const LaboratoryTurning<T> laboratory(model, axes, t);
    const auto both_into_P = [&](const Vec3<Paired<T>>& v_L) {
      return paired_vector(into_P(parts(v_L, &Paired<T>::ref)), into_P(parts(v_L, &Paired<T>::diff)), model.epsilon);
    };
    around.earth = both_into_P(laboratory.earth_L);
    around.turning = both_into_P(CarrierTurning<T>(laboratory, turn, t).w_IP_L);
    if constexpr (kLaboratory) around.turning -= around.earth;
    around.field = both_into_P(axes.into_L(field.reference_L, field.difference_L_scaled, model.epsilon));
  } else {
    around.earth = paired_vector(Vec3<T>(Vec3<T>::Zero()), into_P(model.W_IL_L_scaled), model.epsilon);
    around.turning = paired_vector(Vec3<T>(turn.angle_rate(t) * turn.axis));
    if constexpr (!kLaboratory) around.turning += around.earth;
    around.field = paired_vector(into_P(field.reference_L), into_P(field.difference_L_scaled), model.epsilon);
  }
  for (std::size_t i = 0; i < 2; ++i) around.gradient[i] = paired_vector(into_P(model.applied.gradient[i].direction_L));
  return around;
}
/// Those of the rotating motion alone.
template <class T>
GimbalSurroundings<T> of_rotating(const GimbalSurroundings<Paired<T>>& both) {
  constexpr auto kRotating = &Paired<T>::rot;
  return {parts(both.turning, kRotating),
          parts(both.earth, kRotating),
          parts(both.field, kRotating),
          {parts(both.gradient[0], kRotating), parts(both.gradient[1], kRotating)}};
}

/// Turns vectors into the axes of the two gimbals.
/// @tparam S  T, or a pair of T
template <class T, class S>
struct GimbalPose {
  const Gimbals<T>& gimbals;
  SinCos<S> outer, inner;
  SinCos<S> inner_change = {S(T(0)),
                            S(T(0))};  ///< of `inner` from that of the base whose momentum is counted from (gimbal_motion)

  Vec3<S> into_ring(const Vec3<S>& v_P) const {
    const Vec3<S> v = mixed_times(Mat3<T>(gimbals.R_P0.transpose()), v_P);
    return {outer.cos * v[0] + outer.sin * v[1], outer.cos * v[1] - outer.sin * v[0], v[2]};
  }
  Vec3<S> into_body(const Vec3<S>& v_A) const {
    const S c = S(gimbals.skew_cos), s = S(gimbals.skew_sin);
    const S y = c * v_A[1] + s * v_A[2], z = c * v_A[2] - s * v_A[1];
    return {inner.cos * v_A[0] - inner.sin * z, y, inner.sin * v_A[0] + inner.cos * z};
  }
  /// The outer axis in body axes; the inner one is axis 2.
  Vec3<S> outer_axis_B() const { return into_body(Vec3<S>(S(T(0)), S(T(0)), S(T(1)))); }
  /// Its change from that of the base.
  Vec3<S> outer_axis_change_B() const {
    const S c = S(gimbals.skew_cos);
    return {-(c * inner_change.sin), S(T(0)), c * inner_change.cos};
  }
};
/// The pose that is turned from that of the release by some angles, with its change. Small turns keep their digits.
template <class T, class S>
GimbalPose<T, S> pose_after(const Gimbals<T>& gimbals, const S& outer_turn, const S& inner_turn, const T& epsilon) {
  const SinCos<T> base = real::sin_cos(gimbals.release.inner);
  const SinCos<S> half = paired_sin_cos(S(S(T(1) / T(2)) * inner_turn), epsilon);
  const S sine = S(T(2)) * (half.sin * half.cos), versine = S(T(2)) * (half.sin * half.sin);
  const SinCos<S> change{S(base.cos) * sine - S(base.sin) * versine, -(S(base.sin) * sine) - S(base.cos) * versine};
  return {gimbals, paired_sin_cos(S(S(gimbals.release.outer) + outer_turn), epsilon),
          SinCos<S>{S(base.sin) + change.sin, S(base.cos) + change.cos}, change};
}

/// All that a gimbal carries at one time, in its axes: its tensors, and the momentum and the velocity moment (torques.hpp) of masses that
/// move on it, relative to it.
template <class T>
struct CarriedPart {
  Mat3<T> I, S;
  Vec3<T> mass_moment;
  Vec3<T> momentum;         ///< l
  Mat3<T> velocity_moment;  ///< J
};
template <class T>
struct CarriedParts {
  CarriedPart<T> ring, body;
};
template <class T>
CarriedPart<T> carried_part(const Mat3<T>& I, const Mat3<T>& second_moment, const Vec3<T>& mass_moment,
                            const MovingMasses<T>& masses, const T& t) {
  if (!masses.any()) return {I, second_moment, mass_moment, Vec3<T>::Zero(), Mat3<T>::Zero()};
  const MassSums<T> now = masses.sums(t);
  const Mat3<T> more = now.second_moment - masses.at_release.second_moment;
  return {I + inertia_of(more), second_moment + more, mass_moment + (now.mass_moment - masses.at_release.mass_moment),
          now.momentum, now.velocity_moment};
}
template <class T>
CarriedParts<T> carried_parts(const Model<T>& model, const T& t) {
  const Gimbals<T>& gimbals = model.gimbals;
  return {carried_part(gimbals.ring.I, gimbals.ring.S, gimbals.ring.mass_moment, gimbals.masses, t),
          carried_part(model.I_BP_B, model.S_BP_B, model.mass_moment_B, model.masses, t)};
}

template <class S>
struct GimbalMomenta {
  S outer, inner, rotor;  ///< p_a, p_b, h
};
/// The motion that belongs to momenta, in the observer's frame.
template <class S>
struct GimbalMotion {
  S outer_rate, inner_rate, rotor_rate;
  Vec3<S> turning_A, turning_B;  ///< U in the axes of the outer gimbal and of the body
  Vec3<S> axis_B;                ///< the outer axis
  Vec3<S> w_A, w_B, L_A, L_B;    ///< rates and momenta, each in its own axes
};

/// The momentum inside the body about the rotor's axis.   @param h  of a free rotor
template <class T, class S>
S rotor_momentum(const Rotor<T>& rotor, const S& h, const T& t) {
  return rotor.driven ? S(T(rotor.axial * rotor.driven_rate(t))) : h;
}

/// @param p  momenta counted from those that the base alone has by its rotor: less h0 a.c, h0 b.c and h0, where the axes are those of the
/// base. Where gimbals hardly move beside a fast rotor, these are all but the smallest parts of the momenta.   @param turning_P  U
/// @param base_momentum  h0
template <class T, class S>
GimbalMotion<S> gimbal_motion(const Model<T>& model, const CarriedParts<T>& parts, const GimbalPose<T, S>& pose,
                              const GimbalMomenta<S>& p, const Vec3<S>& turning_P, const T& t, const T& base_momentum = T(0)) {
  const Gimbals<T>& gimbals = model.gimbals;
  const Rotor<T>& rotor = model.rotor;
  const Mat3<T>&I_A = parts.ring.I, &I_B = parts.body.I;
  GimbalMotion<S> m;
  m.turning_A = pose.into_ring(turning_P), m.turning_B = pose.into_body(m.turning_A);
  m.axis_B = pose.outer_axis_B();
  const S inside = rotor_momentum(rotor, S(S(base_momentum) + p.rotor), t);
  const S more = rotor.driven ? S(inside - S(base_momentum)) : p.rotor;
  const Vec3<S> c = over_scalar<S>(rotor.axis_B);
  const Vec3<S> carried_A = mixed_times(I_A, m.turning_A) + over_scalar<S>(parts.ring.momentum),
                carried_B = mixed_times(I_B, m.turning_B) + over_scalar<S>(parts.body.momentum);
  const Vec3<S> I_a = mixed_times(I_B, m.axis_B);
  const S m11 = S(I_A(2, 2)) + inner(m.axis_B, I_a), m12 = I_a[1], m22 = S(I_B(1, 1));
  const S r1 = p.outer - carried_A[2] - inner(m.axis_B, Vec3<S>(carried_B + c * more)) -
               S(base_momentum) * inner(pose.outer_axis_change_B(), c);
  const S r2 = p.inner - carried_B[1] - c[1] * more;
  m.outer_rate = m.inner_rate = S(T(0));
  if (gimbals.inner.locked) {
    m.outer_rate = r1 / m11;
  } else if (gimbals.outer.locked) {
    m.inner_rate = r2 / m22;
  } else {
    const S inverse = S(T(1)) / (m11 * m22 - m12 * m12);
    m.outer_rate = (m22 * r1 - m12 * r2) * inverse, m.inner_rate = (m11 * r2 - m12 * r1) * inverse;
  }
  const Vec3<S> z(S(T(0)), S(T(0)), m.outer_rate), y(S(T(0)), m.inner_rate, S(T(0)));
  m.w_A = m.turning_A + z, m.w_B = m.turning_B + m.axis_B * m.outer_rate + y;
  m.L_A = carried_A + mixed_times(I_A, z), m.L_B = carried_B + c * inside + I_a * m.outer_rate + mixed_times(I_B, y);
  m.rotor_rate = rotor.driven ? S(rotor.driven_rate(t)) : S(inside * S(T(1) / rotor.axial) - inner(c, m.w_B));
  return m;
}

/// The momenta that belong to rates in the base's pose, the inverse of gimbal_motion.
template <class T, class S>
GimbalMomenta<S> gimbal_momenta(const Model<T>& model, const CarriedParts<T>& parts, const GimbalPose<T, S>& pose,
                                const S& outer_rate, const S& inner_rate, const S& rotor_rate, const Vec3<S>& turning_P,
                                const T& t, const T& base_momentum = T(0)) {
  const Rotor<T>& rotor = model.rotor;
  const Vec3<S> turning_A = pose.into_ring(turning_P), axis_B = pose.outer_axis_B(), c = over_scalar<S>(rotor.axis_B);
  const Vec3<S> w_A = turning_A + Vec3<S>(S(T(0)), S(T(0)), outer_rate);
  const Vec3<S> w_B = pose.into_body(w_A) + Vec3<S>(S(T(0)), inner_rate, S(T(0)));
  const S h = rotor_momentum(rotor, S(S(rotor.axial) * (inner(c, w_B) + rotor_rate)), t) - S(base_momentum);
  const Vec3<S> L_B = mixed_times(parts.body.I, w_B) + c * h + over_scalar<S>(parts.body.momentum);
  return {S(mixed_times(parts.ring.I, w_A)[2] + S(parts.ring.momentum[2]) + inner(axis_B, L_B)), L_B[1], h};
}

/// The torques on the parts of a suspension, each in the axes of its part, and on the rotor about its axis.
template <class S>
struct GimbalTorques {
  Vec3<S> ring_A, body_B;
  S rotor;
};

/// [F]'s Coriolis and centrifugal torques on the parts.   @param earth_P  W
template <class T, class S>
GimbalTorques<S> laboratory_torques(const Model<T>& model, const CarriedParts<T>& parts, const GimbalPose<T, S>& pose,
                                    const GimbalMotion<S>& m, const Vec3<S>& earth_P) {
  const Rotor<T>& rotor = model.rotor;
  const Vec3<S> W_A = pose.into_ring(earth_P), W_B = pose.into_body(W_A), c = over_scalar<S>(rotor.axis_B);
  const auto torque = [](const Vec3<S>& W, const Mat3<S>& J, const Mat3<S>& second_moment) -> Vec3<S> {
    return coriolis_torque(W, J) + centrifugal_torque(W, second_moment);
  };
  const Mat3<S> S_A = over_scalar<S>(parts.ring.S), S_B = over_scalar<S>(parts.body.S), S_R = over_scalar<S>(rotor.S_B);
  // The rotor turns in the body: r' = sigma c x rho (rotor.hpp).
  const Mat3<S> J_R = cross_matrix(Vec3<S>(c * (S(-rotor.axial / T(2)) * m.rotor_rate)));
  const Mat3<S> J_A = over_scalar<S>(parts.ring.velocity_moment), J_B = over_scalar<S>(parts.body.velocity_moment);
  return {torque(W_A, Mat3<S>(velocity_moment(S_A, m.w_A) + J_A), S_A),
          torque(W_B, Mat3<S>(velocity_moment(S_B, m.w_B) + J_R + J_B), S_B),
          rotor.driven ? S(T(0)) : inner(c, torque(W_B, Mat3<S>(velocity_moment(S_R, m.w_B) + J_R), S_R))};
}

/// The torques of gravity and of its gradient on both parts, and of [F] where the laboratory observes. The gradient has no torque on
/// the rotor about its axis of symmetry.
template <bool kLaboratory, class T, class S>
GimbalTorques<S> gimbal_torques(const Model<T>& model, const CarriedParts<T>& parts, const GimbalPose<T, S>& pose,
                                const GimbalMotion<S>& m, const GimbalSurroundings<S>& around) {
  const Rotor<T>& rotor = model.rotor;
  Mat3<T> I_whole = parts.body.I;
  if (!rotor.driven) I_whole += rotor.axial * (rotor.axis_B * rotor.axis_B.transpose());
  const Vec3<S> field_A = pose.into_ring(around.field);
  GimbalTorques<S> tau{over_scalar<S>(parts.ring.mass_moment).cross(field_A),
                       over_scalar<S>(parts.body.mass_moment).cross(pose.into_body(field_A)), S(T(0))};
  for (std::size_t i = 0; i < 2; ++i) {
    const GradientTerm<T>& term = model.applied.gradient[i];
    if (term.strength == T(0)) continue;
    const Vec3<S> u_A = pose.into_ring(around.gradient[i]);
    tau.ring_A += gravity_gradient_torque(term, parts.ring.I, u_A);
    tau.body_B += gravity_gradient_torque(term, I_whole, pose.into_body(u_A));
  }
  if constexpr (kLaboratory) {
    const GimbalTorques<S> laboratory = laboratory_torques(model, parts, pose, m, around.earth);
    tau.ring_A += laboratory.ring_A, tau.body_B += laboratory.body_B, tau.rotor += laboratory.rotor;
  }
  return tau;
}

/// The rates of change of the momenta.
/// @tparam kLaboratory  whether the laboratory observes, else an inertial observer   @param outer, inner_angle  the angles
template <bool kLaboratory, class T, class S>
GimbalMomenta<S> momentum_rates(const Model<T>& model, const CarriedParts<T>& parts, const GimbalPose<T, S>& pose,
                                const S& outer, const S& inner_angle, const GimbalMotion<S>& m,
                                const GimbalSurroundings<S>& around) {
  const GimbalTorques<S> tau = gimbal_torques<kLaboratory>(model, parts, pose, m, around);
  const Vec3<S> b(S(T(0)), S(T(1)), S(T(0))), a(S(T(0)), S(T(0)), S(T(1)));
  const Vec3<S> ring_B = m.turning_B + m.axis_B * m.outer_rate;
  GimbalMomenta<S> rate;
  rate.outer = bearing_torque(model.gimbals.outer, outer, m.outer_rate) + tau.ring_A[2] + inner(m.axis_B, tau.body_B) +
               inner(Vec3<S>(m.turning_A.cross(a)), m.L_A) + inner(Vec3<S>(m.turning_B.cross(m.axis_B)), m.L_B);
  rate.inner =
      bearing_torque(model.gimbals.inner, inner_angle, m.inner_rate) + tau.body_B[1] + inner(Vec3<S>(ring_B.cross(b)), m.L_B);
  rate.rotor = model.rotor.driven ? S(T(0)) : S(bearing_torque(model.rotor, m.rotor_rate) + tau.rotor);
  if (model.gimbals.outer.locked) rate.outer = S(T(0));
  if (model.gimbals.inner.locked) rate.inner = S(T(0));
  return rate;
}

}  // namespace earthtop
