// SPDX-License-Identifier: GPL-3.0-or-later
/// The torque ledger: every torque that an observer counts, next to the rate of change of the angular momentum that he sees.
#pragma once

#include <array>

#include "earthtop/model/contact_release.hpp"
#include "earthtop/model/ledger_row.hpp"
#include "earthtop/model/model.hpp"

namespace earthtop {

/// The torques about the pivot at one instant (N m), in the axes of the observing frame A.
template <class T>
struct LedgerEntry {
  Vec3<T> tau_phys_A = Vec3<T>::Zero();   ///< apparent gravity, the effect of a driven pivot, and the applied torques
  Vec3<T> tau_cor_A = Vec3<T>::Zero();    ///< Coriolis
  Vec3<T> tau_trans_A = Vec3<T>::Zero();  ///< transverse
  Vec3<T> tau_cent_A = Vec3<T>::Zero();   ///< centrifugal
  Vec3<T> dL_dt_A = Vec3<T>::Zero();      ///< derivative, taken in A, of the momentum L' that A sees
  Vec3<T> residual_A = Vec3<T>::Zero();   ///< the sum of the four torques minus dL_dt_A: round-off
  /// Parts of tau_phys_A, in the order of kAppliedShares.
  std::array<Vec3<T>, kAppliedShares.size()> share_A = {Vec3<T>::Zero(), Vec3<T>::Zero(), Vec3<T>::Zero(),
                                                        Vec3<T>::Zero(), Vec3<T>::Zero(), Vec3<T>::Zero()};
  /// The two parts of the Coriolis torque, for a frame that turns at u: -(dTheta/dt) u, from the change of the inertia as A sees it, and
  /// L' x u, the gyroscopic torque of the momentum L'.
  Vec3<T> tau_cor_inertia_A = Vec3<T>::Zero(), tau_cor_gyroscopic_A = Vec3<T>::Zero();
  Vec3<T> force_table_A = Vec3<T>::Zero();  ///< of a top on a table: the force of the table on the tip
  /// Of a Cardan suspension: the torques of the support on the outer gimbal, and of that on the body (gimbal_ledger.hpp).
  Vec3<T> bearing_outer_A = Vec3<T>::Zero(), bearing_inner_A = Vec3<T>::Zero();
  /// On a journey: the part of tau_cor_A that the rate of East, North and Up over the Earth makes. The torque is linear in the rate.
  Vec3<T> tau_cor_transport_A = Vec3<T>::Zero();
};

/// The entry as a result stores it.
template <class T>
LedgerRow<T> ledger_row(const LedgerEntry<T>& entry) {
  return ledger_row_from<T>(entry, [](const Vec3<T>& v) { return std::array<T, 3>{v[0], v[1], v[2]}; });
}

/// The ledger of one state. Its two sides are computed independently from the state:
///   torques   [F]'s tensor forms, from the second moment S and the velocity moment J in A axes
///   dL'/dt    Euler's equation in body axes for w_IB, minus the rotation of A, with the inertia tensor Theta:
///             with w = w_AB = w_IB - u and u = w_IA,  (dL'/dt)_A = Theta dw_IB/dt - Theta du/dt + w x Theta w,
///             where dw_IB/dt is Euler's and du/dt = R_BA alpha_IA - w x u is taken in B. What grows with the square of the
///             spin cancels between the terms, and is left out here:
///             tau_phys + [Theta (w x u) - w x Theta u - u x Theta w] - u x Theta u - Theta alpha_IA
/// A torque that the scene switches off is missing for the laboratory observer. The other observers see it, with opposite sign,
/// as an applied torque among the physical ones.
/// With a rotor in the body (rotor.hpp) L' = Theta w + l, where l = C s c is the rotor's momentum relative to the body, Theta is that of
/// both, and the second side has l x u more. For the observer in the body L' = l; its rate follows from the rotor's own balance.
/// @param model  in SI units   @param t  time since the release (s)   @param w_LB_B  rate relative to the laboratory (rad/s)
/// @param spin  of the rotor relative to the body (rad/s)
template <class T>
LedgerEntry<T> ledger_entry(LedgerObserver observer, const Model<T>& model, T t, const Quaternion<T>& q_LB,
                            const Vec3<T>& w_LB_B, T spin = T(0));
extern template LedgerEntry<double> ledger_entry(LedgerObserver, const Model<double>&, double, const Quaternion<double>&,
                                                 const Vec3<double>&, double);
extern template LedgerEntry<float80> ledger_entry(LedgerObserver, const Model<float80>&, float80, const Quaternion<float80>&,
                                                  const Vec3<float80>&, float80);
extern template LedgerEntry<float128> ledger_entry(LedgerObserver, const Model<float128>&, float128,
                                                   const Quaternion<float128>&, const Vec3<float128>&, float128);

/// The state of a top on a table, in the model's units.
template <class T>
struct StateOnTable {
  Quaternion<T> q_LB;
  Vec3<T> w_LB_B = Vec3<T>::Zero();  ///< relative to the laboratory
  Vec3<T> slip_L = Vec3<T>::Zero();
  Vec3<T> tip_L = Vec3<T>::Zero();  ///< the contact point
};

/// The ledger of a top on a table, about the moving centre O of the tip's sphere, whose acceleration acts like a driven pivot's.
/// Here, too, the two sides are computed independently: the torques about O, in which the normal force does not appear; and
/// dL'_O/dt from the angular acceleration that the equations about the centre of mass give with that force, so that the residual
/// tests the table's force as well.
/// @param model, contact, start  in the same units   @param t  time since the release
/// @returns the entry in these units
template <class T>
LedgerEntry<T> ledger_entry_on_table(LedgerObserver observer, const Model<T>& model, const Contact<T>& contact,
                                     const ContactRelease<T>& start, T t, const StateOnTable<T>& state);
#define EARTHTOP_LEDGER_ON_TABLE(T)                                                                                           \
  template LedgerEntry<T> ledger_entry_on_table(LedgerObserver, const Model<T>&, const Contact<T>&, const ContactRelease<T>&, \
                                                T, const StateOnTable<T>&)
extern EARTHTOP_LEDGER_ON_TABLE(double);
extern EARTHTOP_LEDGER_ON_TABLE(float80);
extern EARTHTOP_LEDGER_ON_TABLE(float128);

}  // namespace earthtop
