// SPDX-License-Identifier: GPL-3.0-or-later
// The ledger of a Cardan suspension.
#include "earthtop/model/gimbal_ledger.hpp"

#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/equations.hpp"
#include "earthtop/model/laboratory_now.hpp"

namespace earthtop {
namespace {

/// A vector's rate and acceleration: of a frame relative to inertial space.
template <class T>
struct Turning {
  Vec3<T> w = Vec3<T>::Zero(), alpha = Vec3<T>::Zero();
};

/// A rigid part of the suspension, all in the axes of P.
template <class T>
struct Part {
  Mat3<T> I, S;
  Vec3<T> mass_moment;
  Turning<T> turning;      ///< relative to inertial space
  Vec3<T> inside, change;  ///< momentum of what moves in it relative to it, and its rate as seen from the part
  Mat3<T> inside_moment;   ///< the velocity moment of what moves in it, relative to it
  Mat3<T> I_rate;          ///< of its inertia, as seen from the part
};

/// @param I  of all that turns with it   @param masses  that move on it
template <class T>
Part<T> part_of(const Mat3<T>& R, const Mat3<T>& I, const CarriedPart<T>& part, const MovingMasses<T>& masses, const T& t) {
  Part<T> made{turned_tensor(R, I),
               turned_tensor(R, part.S),
               times(R, part.mass_moment),
               {},
               times(R, part.momentum),
               Vec3<T>::Zero(),
               turned_tensor(R, part.velocity_moment),
               Mat3<T>::Zero()};
  if (!masses.any()) return made;
  const MassSums<T> sums = masses.sums(t);
  made.change = times(R, sums.momentum_rate), made.I_rate = turned_tensor(R, sums.inertia_rate());
  return made;
}

/// The torque that a part needs for its motion in inertial space: the rate of its momentum.
template <class T>
Vec3<T> needed(const Part<T>& part) {
  const Vec3<T>& w = part.turning.w;
  return times(part.I, part.turning.alpha) + times(part.I_rate, w) + w.cross(Vec3<T>(times(part.I, w) + part.inside)) +
         part.change;
}

/// The motion of all parts at one instant, solved for the accelerations of the gimbals by the balances of torque about both axes
/// (Newton and Euler in inertial space, without the momenta of gimbal_equations.hpp).
template <class T>
struct Suspension {
  Part<T> ring, body;
  Vec3<T> a, b;  ///< the axes
  T spin, torque_on_rotor;
};

template <class T>
Suspension<T> suspension_at(const Model<T>& model, const Turning<T>& carrier, const GimbalAngles<T>& at, T spin, T t,
                            const std::array<Vec3<T>, 2>& torque) {
  const Gimbals<T>& gimbals = model.gimbals;
  const Rotor<T>& rotor = model.rotor;
  const auto turn = [](int axis, const T& angle) { return turn_matrix(Vec3<T>(Vec3<T>::Unit(axis)), angle); };
  Mat3<T> skew = Mat3<T>::Identity();
  skew(1, 1) = skew(2, 2) = gimbals.skew_cos, skew(2, 1) = gimbals.skew_sin, skew(1, 2) = -gimbals.skew_sin;
  const Mat3<T> R_PA = gimbals.R_P0 * turn(2, at.outer), R_PB = R_PA * skew * turn(1, at.inner);
  const CarriedParts<T> now = carried_parts(model, t);
  Mat3<T> I_whole = now.body.I;
  if (!rotor.driven) I_whole += rotor.axial * (rotor.axis_B * rotor.axis_B.transpose());
  Suspension<T> s{part_of<T>(R_PA, now.ring.I, now.ring, gimbals.masses, t),
                  part_of<T>(R_PB, I_whole, now.body, model.masses, t),
                  R_PA.col(2),
                  R_PB.col(1),
                  spin,
                  T(0)};
  const Vec3<T> c = times(R_PB, rotor.axis_B);
  s.ring.turning.w = carrier.w + at.outer_rate * s.a;
  s.body.turning.w = s.ring.turning.w + at.inner_rate * s.b;
  const Vec3<T> of_masses = s.body.inside, change_of_masses = s.body.change;
  s.body.inside += (rotor.axial * spin) * c;
  s.body.inside_moment += cross_matrix(Vec3<T>((rotor.axial * spin / T(-2)) * c));
  // Accelerations without those of the angles: of the carrier, and of the axes that turn with it.
  s.ring.turning.alpha = carrier.alpha + at.outer_rate * carrier.w.cross(s.a);
  s.body.turning.alpha = s.ring.turning.alpha + at.inner_rate * s.ring.turning.w.cross(s.b);
  const T driven = rotor.driven ? T(rotor.axial * rotor.driven_acceleration(t)) : T(0);
  s.torque_on_rotor = rotor.driven ? driven : bearing_torque(rotor, spin);
  // A free rotor's momentum C (w.c + s) changes by its bearing alone; that relative to the body changes by C dw/dt.c less. In the sums
  // for the axes the free rotor's axial moment is therefore left out.
  Mat3<T> I_free = s.body.I;
  if (!rotor.driven) I_free -= rotor.axial * (c * c.transpose());
  Part<T> body = s.body;
  body.I = I_free, body.change = change_of_masses + s.torque_on_rotor * c;
  if (!rotor.driven) body.inside = of_masses + (rotor.axial * (spin + c.dot(s.body.turning.w))) * c;
  const Vec3<T> left_ring = torque[0] - needed(s.ring), left_body = torque[1] - needed(body);
  const Vec3<T> I_a = times(I_free, s.a), I_b = times(I_free, s.b);
  const T m11 = s.a.dot(times(s.ring.I, s.a)) + s.a.dot(I_a), m12 = s.a.dot(I_b), m22 = s.b.dot(I_b);
  const T r1 = bearing_torque(gimbals.outer, at.outer, at.outer_rate) + s.a.dot(left_ring) + s.a.dot(left_body);
  const T r2 = bearing_torque(gimbals.inner, at.inner, at.inner_rate) + s.b.dot(left_body);
  T outer = T(0), inner = T(0);
  if (gimbals.inner.locked) {
    outer = r1 / m11;
  } else if (gimbals.outer.locked) {
    inner = r2 / m22;
  } else {
    const T determinant = m11 * m22 - m12 * m12;
    outer = (m22 * r1 - m12 * r2) / determinant, inner = (m11 * r2 - m12 * r1) / determinant;
  }
  s.ring.turning.alpha += outer * s.a;
  s.body.turning.alpha += outer * s.a + inner * s.b;
  const T carried = rotor.driven ? T(0) : T(rotor.axial * c.dot(s.body.turning.alpha));
  s.body.change = change_of_masses + (s.torque_on_rotor - carried) * c;
  return s;
}

}  // namespace

template <class T>
LedgerEntry<T> ledger_entry_in_gimbals(LedgerObserver observer, const Model<T>& model, T t, const GimbalAngles<T>& angles,
                                       T spin) {
  const PrescribedMotion<T>& turn = model.platform.turn;
  if (observer == LedgerObserver::platform && turn.never_turns()) observer = LedgerObserver::laboratory;
  const Mat3<T> R_LP = turn_matrix(turn.axis, turn.angle(t));
  const auto into_P = [&](const Vec3<T>& v_L) -> Vec3<T> { return transposed_times(R_LP, v_L); };
  const LaboratoryNow<T> laboratory(model, t);
  const Vec3<T> W = into_P(laboratory.w_IL_L), w_LP = turn.angle_rate(t) * turn.axis, W_slope = into_P(laboratory.alpha_IL_L);
  const Turning<T> carrier{Vec3<T>(W + w_LP), Vec3<T>(turn.angle_acceleration(t) * turn.axis + W.cross(w_LP) + W_slope)};
  const Vec3<T> field = into_P(laboratory.field_L);

  // Torques of gravity on both parts, which do not depend on the accelerations.
  const Suspension<T> unloaded = suspension_at(model, carrier, angles, spin, t, {Vec3<T>::Zero(), Vec3<T>::Zero()});
  std::array<Vec3<T>, 2> torque, gradient{Vec3<T>::Zero(), Vec3<T>::Zero()}, tide{Vec3<T>::Zero(), Vec3<T>::Zero()};
  const Part<T>* parts[] = {&unloaded.ring, &unloaded.body};
  for (std::size_t k = 0; k < 2; ++k) {
    for (const GradientTerm<T>& term : model.applied.gradient)
      if (!(term.strength == T(0))) gradient[k] += gravity_gradient_torque(term, parts[k]->I, into_P(term.direction_L));
    if (!model.tide.empty()) tide[k] = parts[k]->mass_moment.cross(into_P(model.tide.acceleration_L(t)));
    torque[k] = parts[k]->mass_moment.cross(field) + gradient[k];
  }
  const Suspension<T> s = suspension_at(model, carrier, angles, spin, t, torque);

  // The observer: his rate and acceleration, and his axes as seen from P.
  Turning<T> X;
  Mat3<T> R_XP = Mat3<T>::Identity();
  switch (observer) {
    case LedgerObserver::inertial: R_XP = laboratory.R_NL * R_LP; break;
    case LedgerObserver::laboratory: X.w = W, X.alpha = W_slope, R_XP = R_LP; break;
    case LedgerObserver::platform: X = carrier; break;
    case LedgerObserver::body:
      X = s.body.turning;
      R_XP = rotation_matrix(gimbal_attitude(model.gimbals, angles.outer, angles.inner)).transpose();
      break;
  }

  LedgerEntry<T> entry;
  Mat3<T> J = Mat3<T>::Zero(), S = Mat3<T>::Zero();
  Vec3<T> dL = Vec3<T>::Zero();
  for (const Part<T>* part : {&s.ring, &s.body}) {
    const Vec3<T> w = part->turning.w - X.w;
    J += velocity_moment(part->S, w) + part->inside_moment;
    S += part->S;
    // In X the rate of w is that in inertial space, less what X itself turns and accelerates.
    const Vec3<T> w_dot = part->turning.alpha - X.alpha - X.w.cross(w);
    dL += times(part->I, w_dot) + times(part->I_rate, w) + w.cross(Vec3<T>(times(part->I, w) + part->inside)) + part->change;
  }
  entry.tau_phys_A = torque[0] + torque[1];
  entry.tau_cor_A = coriolis_torque(X.w, J);
  const Mat3<T> S_rate = J + J.transpose(), I_rate = S_rate.trace() * Mat3<T>::Identity() - S_rate;
  entry.tau_cor_inertia_A = -times(I_rate, X.w);
  entry.tau_cor_gyroscopic_A = Vec3<T>(J(1, 2) - J(2, 1), J(2, 0) - J(0, 2), J(0, 1) - J(1, 0)).cross(X.w);
  if (observer != LedgerObserver::inertial) entry.tau_cor_transport_A = coriolis_torque(into_P(laboratory.w_EL_L), J);
  entry.tau_trans_A = transverse_torque(X.alpha, S);
  entry.tau_cent_A = centrifugal_torque(X.w, S);
  entry.dL_dt_A = dL;
  entry.share_A = {Vec3<T>(tide[0] + tide[1]), Vec3<T>(gradient[0] + gradient[1]), Vec3<T>::Zero(), Vec3<T>::Zero()};
  // What the mounts feel. Along its axis a free bearing exerts only the torque of its own; the rest comes from the balance.
  const auto mounted = [](Vec3<T> whole, const Vec3<T>& axis, const Bearing<T>& bearing, const T& own) {
    if (!bearing.locked) whole += (own - whole.dot(axis)) * axis;
    return whole;
  };
  const Gimbals<T>& gimbals = model.gimbals;
  const Vec3<T> on_body = needed(s.body) - torque[1], on_both = needed(s.ring) - torque[0] + on_body;
  entry.bearing_inner_A = mounted(on_body, s.b, gimbals.inner, bearing_torque(gimbals.inner, angles.inner, angles.inner_rate));
  entry.bearing_outer_A = mounted(on_both, s.a, gimbals.outer, bearing_torque(gimbals.outer, angles.outer, angles.outer_rate));
  // The balance about the inner axis is no part of the whole one.
  entry.residual_A = entry.bearing_inner_A - on_body;
  for (Vec3<T>* v : {&entry.tau_phys_A, &entry.tau_cor_A, &entry.tau_trans_A, &entry.tau_cent_A, &entry.dL_dt_A,
                     &entry.residual_A, &entry.tau_cor_inertia_A, &entry.tau_cor_gyroscopic_A, &entry.bearing_outer_A,
                     &entry.bearing_inner_A, &entry.tau_cor_transport_A, &entry.share_A[0], &entry.share_A[1]})
    *v = times(R_XP, *v) + Vec3<T>(Vec3<T>::Zero());
  entry.residual_A +=
      (entry.tau_phys_A + entry.tau_cor_A + entry.tau_trans_A + entry.tau_cent_A + entry.bearing_outer_A) - entry.dL_dt_A;
  return entry;
}
template LedgerEntry<double> ledger_entry_in_gimbals(LedgerObserver, const Model<double>&, double, const GimbalAngles<double>&,
                                                     double);
template LedgerEntry<float80> ledger_entry_in_gimbals(LedgerObserver, const Model<float80>&, float80,
                                                      const GimbalAngles<float80>&, float80);
template LedgerEntry<float128> ledger_entry_in_gimbals(LedgerObserver, const Model<float128>&, float128,
                                                       const GimbalAngles<float128>&, float128);

}  // namespace earthtop
