// SPDX-License-Identifier: GPL-3.0-or-later
/// The variational equations of any body's motion, in body axes: for a disturbance xi = (theta, dw), where theta is the turn of
/// the attitude and dw the change of the inertial rate.
#pragma once

#include <array>
#include <cstddef>

#include "earthtop/drift/growth.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/equations.hpp"
#include "integrate/state_vectors.hpp"

namespace earthtop {

inline constexpr std::size_t kDisturbances = 3;

/// Restricts disturbances to those that a gimbal allows. The gimbal keeps u.e3 = 0 and therefore w_LB.h = 0, with h = u x e3
/// and u = Up as seen from the body. A disturbance that keeps both has theta.h = 0 and d(w_LB).h = -w_LB.dh, with
/// dh = (u x theta) x e3 and d(w_LB) = dw - (R^T W) x theta. Any departure from that is taken away along h.
template <bool kEarth>
class GimbalFreedom {
 public:
  GimbalFreedom(const Model<double>& model, const Motion<double>& motion)
      : w_LB_B_(motion.m), W_B_(Vec3<double>::Zero()), up_B_(Vec3<double>(rotation_matrix(motion.q).row(2).transpose())) {
    if constexpr (kEarth) W_B_ = transposed_times(rotation_matrix(motion.q), model.W_IL_L);
    w_LB_B_ -= W_B_;
    h_ = up_B_.cross(Vec3<double>::UnitZ());
    h_square_ = h_.dot(h_);
  }
  void restrict(Vec3<double>& theta, Vec3<double>& dw) const {
    theta -= (theta.dot(h_) / h_square_) * h_;
    const Vec3<double> dh = Vec3<double>(up_B_.cross(theta)).cross(Vec3<double>::UnitZ());
    const Vec3<double> dw_LB = dw - W_B_.cross(theta);
    dw -= ((dw_LB.dot(h_) + w_LB_B_.dot(dh)) / h_square_) * h_;
  }

 private:
  Vec3<double> w_LB_B_, W_B_, up_B_, h_;
  double h_square_ = 0;
};

/// The system of a motion (attitude q, inertial rate w in body axes) and its disturbances.
/// @tparam kEarth  whether it is the motion on the rotating Earth, or the non-rotating prediction
template <bool kEarth, SceneKind K>
class GeneralVariations {
 public:
  static constexpr std::size_t kMotionSize = 7, kSize = kMotionSize + 6 * kDisturbances;
  using State = std::array<double, kSize>;

  explicit GeneralVariations(const Model<double>& model) : model_(&model) {}

  void operator()(const State& x, State& dxdt, double t) const {
    const Motion<double> motion = this->motion(x);
    const PivotField<double> field = pivot_field<K>(*model_, t);
    const Vec3<double>& field_L = kEarth ? field.rotating_L : field.reference_L;
    Motion<double> rate = body_equation<kEarth, K>(*model_, motion, field_L);
    const Vec3<double>& w = motion.m;
    const bool applied = K == SceneKind::full && model_->applied.any;
    const Vec3<double> w_LB_B = kEarth ? Vec3<double>(w - transposed_times(rotation_matrix(motion.q), model_->W_IL_L)) : w;
    if (applied) rate.m += times(model_->I_BP_B_inverse, applied_torque_B(*model_, t, motion.q, w_LB_B, kEarth));
    put(rate, dxdt);
    const Vec3<double> L_B = times(model_->I_BP_B, w), field_B = transposed_times(rotation_matrix(motion.q), field_L);
    for (std::size_t i = kMotionSize; i < kSize; i += 6) {
      const Vec3<double> theta = load_vector(x, i), dw = load_vector(x, i + 3);
      store_vector(Vec3<double>(theta.cross(w) + dw), dxdt, i);
      Vec3<double> torque_B = times(model_->I_BP_B, dw).cross(w) + L_B.cross(dw) +
                              field_torque(model_->mass_moment_B, Vec3<double>(field_B.cross(theta)));
      if (applied) torque_B += applied_torque_change_B(*model_, t, motion.q, w_LB_B, kEarth, theta, dw);
      store_vector(times(model_->I_BP_B_inverse, torque_B), dxdt, i + 3);
    }
  }

  /// @param release  attitude and inertial rate at release
  State initial_state(const Motion<double>& release) const {
    State x{};
    put(release, x);
    return x;
  }
  Motion<double> motion(const State& x) const { return {{x[0], load_vector(x, 1)}, load_vector(x, 4)}; }
  Vec3<double> theta(const State& x, std::size_t d) const { return load_vector(x, kMotionSize + 6 * d); }
  Vec3<double> dw(const State& x, std::size_t d) const { return load_vector(x, kMotionSize + 6 * d + 3); }
  /// Puts in a disturbance, given in body axes.
  void put_disturbance(const Vec3<double>& theta_B, const Vec3<double>& dw_B, State& x, std::size_t d) const {
    store_vector(theta_B, x, kMotionSize + 6 * d);
    store_vector(dw_B, x, kMotionSize + 6 * d + 3);
  }
  void scale(State& x, std::size_t d, double factor) const {
    for (std::size_t k = 0; k < 6; ++k) x[kMotionSize + 6 * d + k] *= factor;
  }
  /// Restricts the disturbances to those that a gimbal allows.
  void restrict(State& x) const {
    if (!model_->applied.level_axis) return;
    const GimbalFreedom<kEarth> freedom(*model_, motion(x));
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      Vec3<double> turn = theta(x, d), rate = dw(x, d);
      freedom.restrict(turn, rate);
      put_disturbance(turn, rate, x, d);
    }
  }

 private:
  static void put(const Motion<double>& motion, State& x) {
    x[0] = motion.q.w;
    store_vector(motion.q.v, x, 1);
    store_vector(motion.m, x, 4);
  }

  const Model<double>* model_;
};

}  // namespace earthtop
