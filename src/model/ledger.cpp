// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "earthtop/frames/frame_stack.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/contact_ledger.hpp"
#include "earthtop/model/equations.hpp"
#include "earthtop/model/laboratory_now.hpp"

namespace earthtop {

std::string_view to_string(LedgerObserver observer) {
  switch (observer) {
    case LedgerObserver::inertial: return "inertial";
    case LedgerObserver::laboratory: return "laboratory";
    case LedgerObserver::platform: return "platform";
    case LedgerObserver::body: return "body";
  }
  return "unknown";
}

namespace {

/// The observing frame A: its motion relative to I, and the body's motion relative to A.
template <class T>
struct ObservingFrame {
  Mat3<T> R_LA = Mat3<T>::Identity();
  Mat3<T> R_AB = Mat3<T>::Identity();
  Vec3<T> w_IA_A = Vec3<T>::Zero();
  Vec3<T> alpha_IA_A = Vec3<T>::Zero();
  Vec3<T> w_AB_B = Vec3<T>::Zero();
  Vec3<T> w_EL_A = Vec3<T>::Zero();  ///< the share of w_IA that a journey makes
};

template <class T>
ObservingFrame<T> inertial_frame(const LaboratoryNow<T>& laboratory, const Mat3<T>& R_LB, const Vec3<T>& w_LB_B) {
  ObservingFrame<T> N;
  N.R_LA = laboratory.R_NL.transpose();
  N.R_AB = laboratory.R_NL * R_LB;
  N.w_AB_B = w_LB_B + transposed_times(R_LB, laboratory.w_IL_L);
  return N;
}

template <class T>
ObservingFrame<T> laboratory_frame(const LaboratoryNow<T>& laboratory, const Mat3<T>& R_LB, const Vec3<T>& w_LB_B) {
  ObservingFrame<T> L;
  L.R_AB = R_LB;
  L.w_IA_A = laboratory.w_IL_L, L.alpha_IA_A = laboratory.alpha_IL_L;
  L.w_AB_B = w_LB_B;
  return L;
}

template <class T>
ObservingFrame<T> platform_frame(const Model<T>& model, const LaboratoryNow<T>& laboratory, T t, const Mat3<T>& R_LB,
                                 const Vec3<T>& w_LB_B) {
  const PrescribedMotion<T>& turn = model.platform.turn;
  const FrameKinematics<T> LP{Rotation<T>::about(turn.axis, turn.angle(t)), turn.angle_rate(t) * turn.axis,
                              turn.angle_acceleration(t) * turn.axis};
  // I with the attitude of L at time t
  const FrameKinematics<T> IL{Rotation<T>(), laboratory.w_IL_L, laboratory.alpha_IL_L};
  const FrameKinematics<T> IP = compose(IL, LP);
  ObservingFrame<T> P;
  P.R_LA = LP.R_AB.matrix();
  P.R_AB = P.R_LA.transpose() * R_LB;
  P.w_IA_A = transposed_times(P.R_LA, IP.w_AB_A);
  P.alpha_IA_A = transposed_times(P.R_LA, IP.alpha_AB_A);
  P.w_AB_B = w_LB_B - transposed_times(R_LB, LP.w_AB_A);
  return P;
}

template <class T>
ObservingFrame<T> body_frame(const Model<T>& model, const LaboratoryNow<T>& laboratory, const Quaternion<T>& q_LB,
                             const Mat3<T>& R_LB, const Vec3<T>& w_LB_B, const Vec3<T>& applied_B,
                             const RotorInside<T>& rotor) {
  const Vec3<T>& field_L = laboratory.field_L;
  ObservingFrame<T> B;
  B.R_LA = R_LB;
  B.w_IA_A = w_LB_B + transposed_times(R_LB, laboratory.w_IL_L);
  const Motion<T> motion{q_LB, B.w_IA_A};
  const Vec3<T> without_applied = model.kind == SceneKind::gyrostat
                                      ? body_equation<true, SceneKind::gyrostat>(model, motion, field_L, rotor).m
                                      : body_equation<true, SceneKind::full>(model, motion, field_L).m;
  B.alpha_IA_A = without_applied + times(model.I_BP_B_inverse, applied_B);
  return B;
}

/// What turns inside the body, with rates relative to inertial space.
template <class T>
RotorInside<T> rotor_at(const Model<T>& model, T t, const MassSums<T>* masses, const Vec3<T>& w_IB_B, T spin) {
  const Rotor<T>& rotor = model.rotor;
  if (model.kind != SceneKind::gyrostat) return {Vec3<T>::Zero(), Vec3<T>::Zero(), Mat3<T>::Zero(), T(0), T(0), nullptr};
  return rotor_inside(rotor, T(rotor.axial * (rotor.axis_B.dot(w_IB_B) + spin)), t, masses,
                      [&](const Vec3<T>&) { return w_IB_B; });
}

/// The Coriolis torque as Euler's equation gives it, for a frame that turns at u and a body that turns at w relative to it.
template <class T>
Vec3<T> coriolis_by_euler(const Mat3<T>& I_BP_B, const Vec3<T>& u_B, const Vec3<T>& w_B) {
  return times<T>(I_BP_B, w_B.cross(u_B)) - w_B.cross(times(I_BP_B, u_B)) - u_B.cross(times(I_BP_B, w_B));
}
/// The centrifugal torque as Euler's equation gives it.
template <class T>
Vec3<T> centrifugal_by_euler(const Mat3<T>& I_BP_B, const Vec3<T>& u_B) {
  return times(I_BP_B, u_B).cross(u_B);
}

/// The share of each effect in the physical torques, in the order of kAppliedShares. The gimbal reacts to all other torques.
template <class T>
std::array<Vec3<T>, kAppliedShares.size()> applied_shares_B(const Model<T>& model, const LaboratoryNow<T>& laboratory, T t,
                                                            const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B,
                                                            const Vec3<T>& applied_B) {
  const Vec3<T> nothing = Vec3<T>::Zero();
  Vec3<T> tide = nothing, gradient = nothing, friction = nothing, gimbal = nothing, support = nothing, given = nothing;
  if (!model.tide.empty())
    tide = field_torque(model.mass_moment_B, transposed_times(rotation_matrix(q_LB), model.tide.acceleration_L(t)));
  if (model.applied.any) {
    Model<T> part = model;
    part.applied.level_axis = false;
    const Vec3<T> free = applied_torque_seen_from(laboratory, part, t, q_LB, w_LB_B);
    part.applied.gradient = {}, part.applied.support = {}, part.applied.given = {};
    friction = applied_torque_seen_from(laboratory, part, t, q_LB, w_LB_B);
    const auto alone = [&](auto AppliedTorques<T>::*share) {
      part.applied = AppliedTorques<T>();
      part.applied.any = true;
      part.applied.*share = model.applied.*share;
      return applied_torque_seen_from(laboratory, part, t, q_LB, w_LB_B);
    };
    gradient = alone(&AppliedTorques<T>::gradient);
    support = alone(&AppliedTorques<T>::support), given = alone(&AppliedTorques<T>::given);
    if (model.applied.level_axis) gimbal = applied_B - free;
  }
  return {tide, gradient, friction, gimbal, support, given};
}

/// The side of the ledger with the torques of [F] (torques.hpp).
template <class T>
void count_torques(LedgerEntry<T>& entry, const Model<T>& model, const ObservingFrame<T>& A, bool in_laboratory,
                   const Vec3<T>& w_LB_B, const Vec3<T>& field_L, const Vec3<T>& applied_B, const RotorInside<T>& rotor) {
  const Mat3<T> S_BP_A = turned_tensor(A.R_AB, model.S_BP_B);
  const auto velocity_moment_A = [&](const Vec3<T>& w_B) {
    const Vec3<T> w_A = times(A.R_AB, w_B);
    return model.kind == SceneKind::gyrostat ? velocity_moment(S_BP_A, w_A, A.R_AB, rotor) : velocity_moment(S_BP_A, w_A);
  };
  const Mat3<T> J_A = velocity_moment_A(A.w_AB_B);
  entry.tau_phys_A =
      field_torque<T>(times(A.R_AB, model.mass_moment_B), transposed_times(A.R_LA, field_L)) + times(A.R_AB, applied_B);
  entry.tau_cor_A = coriolis_torque(A.w_IA_A, J_A);
  const Mat3<T> S_rate_A = J_A + J_A.transpose(), I_rate_A = S_rate_A.trace() * Mat3<T>::Identity() - S_rate_A;
  const Vec3<T> momentum_A(J_A(1, 2) - J_A(2, 1), J_A(2, 0) - J_A(0, 2), J_A(0, 1) - J_A(1, 0));
  entry.tau_cor_inertia_A = -times(I_rate_A, A.w_IA_A);
  entry.tau_cor_gyroscopic_A = momentum_A.cross(A.w_IA_A);
  entry.tau_cor_transport_A = coriolis_torque(A.w_EL_A, J_A);
  entry.tau_trans_A = transverse_torque(A.alpha_IA_A, S_BP_A);
  entry.tau_cent_A = centrifugal_torque(A.w_IA_A, S_BP_A);
  if (model.kind == SceneKind::plain) return;
  if (in_laboratory) {
    for (Vec3<T>* part : {&entry.tau_cor_A, &entry.tau_cor_inertia_A, &entry.tau_cor_gyroscopic_A})
      *part *= model.weights.coriolis;
    entry.tau_trans_A *= model.weights.transverse;
    entry.tau_cent_A *= model.weights.centrifugal;
  } else {
    const Vec3<T> W_A = transposed_times(A.R_LA, model.W_IL_L);
    entry.tau_phys_A -=
        laboratory_torque<SceneKind::full>(model.weights.complement(), W_A, W_A, velocity_moment_A(w_LB_B), S_BP_A);
  }
}

/// The side of the ledger with Euler's equation.   @param inside_B  the momentum of what turns or moves inside the body, relative to it
/// @param inertia_rate_B  of the inertia, seen from the body
template <class T>
Vec3<T> momentum_rate_A(const Model<T>& model, const ObservingFrame<T>& A, bool in_laboratory, const Mat3<T>& R_LB,
                        const Vec3<T>& w_LB_B, const Vec3<T>& field_L, const Vec3<T>& further_B, const Vec3<T>& inside_B,
                        const Mat3<T>& inertia_rate_B) {
  const Mat3<T> I_BP_B = inertia_of_all(model);
  const Vec3<T> u_B = transposed_times(A.R_AB, A.w_IA_A);
  const auto coriolis_B = [&](const Vec3<T>& frame_B, const Vec3<T>& w_B) {
    return Vec3<T>(coriolis_by_euler(I_BP_B, frame_B, w_B) + inside_B.cross(frame_B) - times(inertia_rate_B, frame_B));
  };
  Vec3<T> cor_B = coriolis_B(u_B, A.w_AB_B), cent_B = centrifugal_by_euler(I_BP_B, u_B);
  Vec3<T> applied_B = field_torque(model.mass_moment_B, transposed_times(R_LB, field_L)) + further_B;
  if (in_laboratory) {
    cor_B *= model.weights.coriolis, cent_B *= model.weights.centrifugal;
  } else {
    const TorqueWeights<T> left_out = model.weights.complement();
    const Vec3<T> W_B = transposed_times(R_LB, model.W_IL_L);
    applied_B -= left_out.coriolis * coriolis_B(W_B, w_LB_B);
    applied_B -= left_out.centrifugal * centrifugal_by_euler(I_BP_B, W_B);
  }
  const Vec3<T> carried_B = times(I_BP_B, transposed_times(A.R_AB, A.alpha_IA_A));
  return times<T>(A.R_AB, applied_B + cor_B + cent_B - carried_B);
}

/// Makes zeros positive, because a product with a rate of zero may have given -0, and takes the residual.
template <class T>
void close(LedgerEntry<T>& entry) {
  for (Vec3<T>* column : {&entry.tau_phys_A, &entry.tau_cor_A, &entry.tau_trans_A, &entry.tau_cent_A, &entry.dL_dt_A,
                          &entry.tau_cor_inertia_A, &entry.tau_cor_gyroscopic_A, &entry.tau_cor_transport_A})
    *column += Vec3<T>::Zero();
  entry.residual_A = (entry.tau_phys_A + entry.tau_cor_A + entry.tau_trans_A + entry.tau_cent_A) - entry.dL_dt_A;
}

}  // namespace

template <class T>
LedgerEntry<T> ledger_entry(LedgerObserver observer, const Model<T>& given, T t, const Quaternion<T>& q_LB,
                            const Vec3<T>& w_LB_B, T spin) {
  const ModelInTime<T> in_time(given);
  const Model<T>& model = in_time.at(t);
  const MassSums<T>* masses = in_time.masses_at(t);
  if (observer == LedgerObserver::platform && model.platform.turn.never_turns()) observer = LedgerObserver::laboratory;
  const Mat3<T> R_LB = rotation_matrix(q_LB);
  const LaboratoryNow<T> laboratory(model, t);
  const Vec3<T>& field_L = laboratory.field_L;
  const Vec3<T> applied_B =
      model.applied.any ? applied_torque_seen_from(laboratory, model, t, q_LB, w_LB_B) : Vec3<T>(Vec3<T>::Zero());
  const RotorInside<T> rotor = rotor_at(model, t, masses, Vec3<T>(w_LB_B + transposed_times(R_LB, laboratory.w_IL_L)), spin);
  const bool in_laboratory = observer == LedgerObserver::laboratory;
  ObservingFrame<T> A;
  switch (observer) {
    case LedgerObserver::inertial: A = inertial_frame(laboratory, R_LB, w_LB_B); break;
    case LedgerObserver::laboratory: A = laboratory_frame(laboratory, R_LB, w_LB_B); break;
    case LedgerObserver::platform: A = platform_frame(model, laboratory, t, R_LB, w_LB_B); break;
    case LedgerObserver::body: A = body_frame(model, laboratory, q_LB, R_LB, w_LB_B, applied_B, rotor); break;
  }
  if (observer != LedgerObserver::inertial) A.w_EL_A = transposed_times(A.R_LA, laboratory.w_EL_L);
  LedgerEntry<T> entry;
  if (model.kind != SceneKind::plain) {
    const auto shares_B = applied_shares_B(model, laboratory, t, q_LB, w_LB_B, applied_B);
    for (std::size_t i = 0; i < shares_B.size(); ++i) entry.share_A[i] = times(A.R_AB, shares_B[i]) + Vec3<T>::Zero();
  }
  count_torques(entry, model, A, in_laboratory, w_LB_B, field_L, applied_B, rotor);
  const Vec3<T> axis_B = model.kind == SceneKind::gyrostat ? model.rotor.axis_B : Vec3<T>(Vec3<T>::Zero());
  if (observer != LedgerObserver::body) {
    Vec3<T> inside_B = (model.rotor.axial * rotor.spin) * axis_B;
    if (masses) inside_B += masses->momentum;
    const Mat3<T> inertia_rate_B = masses ? masses->inertia_rate() : Mat3<T>(Mat3<T>::Zero());
    entry.dL_dt_A = momentum_rate_A(model, A, in_laboratory, R_LB, w_LB_B, field_L, applied_B, inside_B, inertia_rate_B);
  } else if (model.kind == SceneKind::gyrostat) {
    // The body is at rest in its own axes: only the momentum inside it changes. A free rotor's is C (w_IB.c + s), less what the body turns.
    const T carried = model.rotor.driven ? T(0) : T(model.rotor.axial * axis_B.dot(A.alpha_IA_A));
    entry.dL_dt_A = rotor.momentum_rate_B - carried * axis_B;
  }
  close(entry);
  return entry;
}
template LedgerEntry<double> ledger_entry(LedgerObserver, const Model<double>&, double, const Quaternion<double>&,
                                          const Vec3<double>&, double);
template LedgerEntry<float80> ledger_entry(LedgerObserver, const Model<float80>&, float80, const Quaternion<float80>&,
                                           const Vec3<float80>&, float80);
template LedgerEntry<float128> ledger_entry(LedgerObserver, const Model<float128>&, float128, const Quaternion<float128>&,
                                            const Vec3<float128>&, float128);

template <class T>
LedgerEntry<T> ledger_entry_on_table(LedgerObserver observer, const Model<T>& model, const Contact<T>& contact,
                                     const ContactRelease<T>& start, T t, const StateOnTable<T>& state) {
  if (observer == LedgerObserver::platform) observer = LedgerObserver::laboratory;  // there is no platform with a table
  const Mat3<T> R_LH = rotation_matrix(start.q_LH), R_LB = rotation_matrix(state.q_LB);
  const auto in_H = [&](const Vec3<T>& v_L) { return transposed_times(R_LH, v_L); };
  const Model<T> turned = in_table_axes(model, start.q_LH);
  const Vec3<T> z = Vec3<T>::UnitZ(), W_H = turned.W_IL_L;
  const Vec3<T> tide_H = model.tide.empty() ? Vec3<T>(Vec3<T>::Zero()) : in_H(model.tide.acceleration_L(t));
  const ContactSurroundings<T> around{z, turned.apparent_gravity_L + tide_H, W_H, contact.gradient_H};

  GeneralContactState<T> x;
  x.R_HB = R_LH.transpose() * R_LB;
  x.momentum = times(x.R_HB, times(contact.I_BC_B, state.w_LB_B));
  x.v_P = in_table_plane(in_H(state.slip_L), z);
  x.p_O = in_table_plane(in_H(state.tip_L), z) + contact.tip_radius * z;
  Contact<T> acting = contact;
  // The exact law of dry friction holds a tip that does not slip.
  if (contact.law == ContactLaw::coulomb && contact.slip_floor == T(0) && norm(x.v_P) == T(0)) acting.law = ContactLaw::rolling;
  const GeneralContactRates<T> rates = general_rates(acting, around, x);
  const ContactLedger<T> ledger = contact_ledger(acting, around, x, rates);

  // The rates of change of w_IB and w_LB, taken in B.
  const Vec3<T> w_LB_dot_B = transposed_times(x.R_HB, rates.w_dot);
  const Vec3<T> w_IB_dot_B = transposed_times(x.R_HB, Vec3<T>(rates.w_dot + Vec3<T>(W_H.cross(rates.w))));
  const bool in_laboratory = observer == LedgerObserver::laboratory;
  ObservingFrame<T> A;
  Vec3<T> w_AB_dot_B = Vec3<T>::Zero();
  if (observer == LedgerObserver::inertial) {
    A = inertial_frame(LaboratoryNow<T>(model, t), R_LB, state.w_LB_B);
    w_AB_dot_B = w_IB_dot_B;
  } else if (in_laboratory) {
    A = laboratory_frame(LaboratoryNow<T>(model, t), R_LB, state.w_LB_B);
    w_AB_dot_B = w_LB_dot_B;
  } else {
    A.R_LA = R_LB;
    A.w_IA_A = state.w_LB_B + transposed_times(R_LB, model.W_IL_L);
    A.alpha_IA_A = w_IB_dot_B;
  }
  const auto from_H = [&](const Vec3<T>& v_H) { return Vec3<T>(transposed_times(A.R_LA, times(R_LH, v_H)) + Vec3<T>::Zero()); };

  LedgerEntry<T> entry;
  const Vec3<T> physical_H = ledger.gravity + ledger.tip + ledger.gradient + ledger.friction;
  count_torques<T>(entry, model, A, in_laboratory, state.w_LB_B, Vec3<T>::Zero(), transposed_times(x.R_HB, physical_H),
                   rotor_at<T>(model, t, nullptr, state.w_LB_B, T(0)));
  const Vec3<T> mass_moment_H = contact.mass * times(x.R_HB, contact.p_OC_B);
  entry.share_A = {from_H(field_torque(mass_moment_H, tide_H)),
                   from_H(ledger.gradient),
                   from_H(ledger.friction),
                   Vec3<T>::Zero(),
                   Vec3<T>::Zero(),
                   Vec3<T>::Zero()};
  entry.force_table_A = from_H(Vec3<T>(rates.reaction.normal_force * z + rates.reaction.friction));
  if (observer != LedgerObserver::body)
    entry.dL_dt_A = times<T>(A.R_AB, times(model.I_BP_B, w_AB_dot_B) + A.w_AB_B.cross(times(model.I_BP_B, A.w_AB_B)));
  close(entry);
  return entry;
}
EARTHTOP_LEDGER_ON_TABLE(double);
EARTHTOP_LEDGER_ON_TABLE(float80);
EARTHTOP_LEDGER_ON_TABLE(float128);

void LedgerLargest::include(const LedgerRow<double>& row) {
  const auto follow = [](double& largest, const std::array<double, 3>& column) {
    const double size = real::hypot(column[0], column[1], column[2]);
    if (!(size <= largest) && !std::isnan(largest)) largest = size;  // a NaN is kept, so that it shows
  };
  follow(tau_phys, row.tau_phys_A);
  follow(tau_cor, row.tau_cor_A);
  follow(tau_trans, row.tau_trans_A);
  follow(tau_cent, row.tau_cent_A);
  follow(dL_dt, row.dL_dt_A);
  follow(residual, row.residual_A);
  follow(bearing, row.bearing_outer_A);
}

double LedgerLargest::relative_residual() const {
  const double torque = std::max({tau_phys, tau_cor, tau_trans, tau_cent, bearing});
  return torque > 0 || std::isnan(residual) ? residual / torque : 0;
}

}  // namespace earthtop
