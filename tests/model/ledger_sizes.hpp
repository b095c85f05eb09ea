// SPDX-License-Identifier: GPL-3.0-or-later
/// The size of the products from which a ledger's torques are formed, in units of which its round-off is measured.
#pragma once

#include "earthtop/model/ledger.hpp"

namespace earthtop::test {

/// The largest residual of a ledger, in units of eps times the size of its terms. Either side of the ledger takes some 40
/// operations: a rotation matrix enters a torque up to four times (9 each), and the products themselves have 10. Each rounds by
/// eps/2 at most, with either sign, so 80 of them in three components add up to about sqrt(240)/2 = 8.
inline constexpr int kLedgerRounding = 8;

/// The size of both sides of the ledger together: |m r||f|, and the trace of the second moment (not below any moment) times
/// rates and accelerations. The Coriolis torque is 2 |J||w| twice in tensor form, and three products of Theta in Euler's form.
template <class T>
T ledger_size(LedgerObserver observer, const Model<T>& model, T t, const Vec3<T>& w_LB_B) {
  const T S = model.S_BP_B.trace(), W = norm(model.W_IL_L), w_LB = norm(w_LB_B);
  const Vec3<T> field_L = pivot_field<SceneKind::full>(model, t).rotating_L;
  const PrescribedMotion<T>& turn = model.platform.turn;
  const T w_LP = real::abs(turn.angle_rate(t)), alpha_LP = real::abs(turn.angle_acceleration(t));
  const TorqueWeights<T> left_out = model.weights.complement();
  const T left = S * W * (T(7) * left_out.coriolis * w_LB + T(2) * left_out.centrifugal * W);
  const T physical = norm(model.mass_moment_B) * (norm(field_L) + norm(model.apparent_gravity_L));
  const auto rotating = [&](T w_IA, T w_AB, T alpha_IA) {
    return S * (T(7) * w_IA * w_AB + T(2) * w_IA * w_IA + T(2) * alpha_IA);
  };
  switch (observer) {
    case LedgerObserver::inertial: return T(2) * physical + left;
    case LedgerObserver::laboratory: return T(2) * physical + rotating(W, w_LB, T(0));
    case LedgerObserver::platform: return T(2) * physical + left + rotating(W + w_LP, w_LB + w_LP, alpha_LP + W * w_LP);
    case LedgerObserver::body: {
      const T w_IB = w_LB + W;
      const T inverse = T(3) * model.I_BP_B_inverse.cwiseAbs().maxCoeff();  // not below its norm
      const T torque = S * w_IB * w_IB + physical + left;
      return T(2) * physical + left + rotating(w_IB, T(0), inverse * torque);
    }
  }
  return T(0);
}

inline constexpr LedgerObserver kLedgerObservers[] = {LedgerObserver::inertial, LedgerObserver::laboratory,
                                                      LedgerObserver::platform, LedgerObserver::body};

}  // namespace earthtop::test
