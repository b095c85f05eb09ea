// SPDX-License-Identifier: GPL-3.0-or-later
/// The ledger of a Cardan suspension: the torques on all its parts about the point where the axes meet.
#pragma once

#include "earthtop/model/gimbal_equations.hpp"
#include "earthtop/model/ledger.hpp"

namespace earthtop {

/// The support exerts a torque, too, the bearing's: it stands beside the others, and closes the balance
///   tau_phys + tau_cor + tau_trans + tau_cent + bearing_outer = dL'/dt
/// It is what the motion of both parts needs in inertial space; but along a free axis it is the bearing's own torque alone, by friction
/// and torsion, so that the residual tests the equations of motion about both axes. These are solved here for the accelerations, by
/// Newton and Euler in inertial space, without the momenta of gimbal_equations.hpp. [F]'s torques are those of the sums of S and J.
/// @param model  in SI units   @param t  time since the release (s)   @param spin  of the rotor relative to the body (rad/s)
template <class T>
LedgerEntry<T> ledger_entry_in_gimbals(LedgerObserver observer, const Model<T>& model, T t, const GimbalAngles<T>& angles,
                                       T spin);
extern template LedgerEntry<double> ledger_entry_in_gimbals(LedgerObserver, const Model<double>&, double,
                                                            const GimbalAngles<double>&, double);
extern template LedgerEntry<float80> ledger_entry_in_gimbals(LedgerObserver, const Model<float80>&, float80,
                                                             const GimbalAngles<float80>&, float80);
extern template LedgerEntry<float128> ledger_entry_in_gimbals(LedgerObserver, const Model<float128>&, float128,
                                                              const GimbalAngles<float128>&, float128);

}  // namespace earthtop
