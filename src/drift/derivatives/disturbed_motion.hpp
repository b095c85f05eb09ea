// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion with the tangents of three disturbances, whose equations follow from its law (single_motion.hpp, tangents.hpp). To be
/// included after jet.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "drift/derivatives/jet.hpp"
//
#include "drift/derivatives/single_motion.hpp"
#include "integrate/taylor/recorded_series.hpp"
#include "integrate/taylor/tangent_shape.hpp"
#include "integrate/taylor/tangents.hpp"

namespace earthtop {

inline constexpr std::size_t kDisturbances = 3;

/// An infinitesimal disturbance, in axes of the body that need not spin with it.
struct Disturbance {
  Vec3<double> theta_B;  ///< turn of the attitude
  Vec3<double> dw_B;     ///< change of the inertial rate
};

/// Restricts disturbances to those that a gimbal allows. The gimbal keeps u.e3 = 0 and therefore w_LB.h = 0, with h = u x e3
/// and u = Up as seen from the body. A disturbance that keeps both has theta.h = 0 and d(w_LB).h = -w_LB.dh, with
/// dh = (u x theta) x e3 and d(w_LB) = dw - (R^T W) x theta. Any departure from that is taken away along h.
class GimbalFreedom {
 public:
  GimbalFreedom(const Model<double>& model, const Motion<double>& motion)
      : W_B_(transposed_times(rotation_matrix(motion.q), model.W_IL_L)),
        w_LB_B_(motion.m - W_B_),
        up_B_(rotation_matrix(motion.q).row(2).transpose()),
        h_(up_B_.cross(Vec3<double>::UnitZ())),
        h_square_(h_.dot(h_)) {}
  Disturbance of(Disturbance d) const {
    d.theta_B -= (d.theta_B.dot(h_) / h_square_) * h_;
    const Vec3<double> dh = Vec3<double>(up_B_.cross(d.theta_B)).cross(Vec3<double>::UnitZ());
    const Vec3<double> dw_LB = d.dw_B - W_B_.cross(d.theta_B);
    d.dw_B -= ((dw_LB.dot(h_) + w_LB_B_.dot(dh)) / h_square_) * h_;
    return d;
  }

 private:
  Vec3<double> W_B_, w_LB_B_, up_B_, h_;
  double h_square_;
};

/// The state: that of the motion, then the change of it by each disturbance.
template <class Law>
class DisturbedMotion {
 public:
  static constexpr std::size_t kMotionSize = Law::Shape::kSize;
  static constexpr double least_scale(double) { return 1e-3; }
  struct Shape : taylor::TangentShape<typename Law::Shape, kMotionSize, kDisturbances, least_scale> {
    /// Of the work of a step (taylor_stepper.hpp): the states that are looked at in it take a third of its time, whatever its order.
    static constexpr double kOrderOffset = 12;
  };
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<double, kSize>;
  using Series = RecordedSeries<double, kSize>;

  DisturbedMotion(const Model<double>& model, Law law) : model_(&model), law_(std::move(law)) {}

  Series series() const {
    return Series([this](const State& x, double t) {
      return taylor::with_tangents<double>(law_.record(std::span(x).first(kMotionSize), t), kDisturbances, {}, x, t);
    });
  }

  bool has_friction() const { return model_->applied.friction(); }
  State initial_state() const {
    State x{};
    std::ranges::copy(law_.initial_state(), x.begin());
    return x;
  }
  /// @param x  a state, or its motion alone
  template <std::size_t kCount>
  Motion<double> motion(const std::array<double, kCount>& x) const {
    const Turning<double> turning = law_.turning(motion_of(x));
    return {quaternion_of(turning.R_LB), turning.w_IB_B};
  }
  const Model<double>& model() const { return *model_; }
  /// The disturbances of a state, apart from the body's spin.
  std::array<Disturbance, kDisturbances> disturbances(const State& x) const {
    using Jet = real::Jet<kDisturbances>;
    std::array<Jet, kMotionSize> jets;
    for (std::size_t k = 0; k < kMotionSize; ++k) {
      jets[k] = x[k];
      for (std::size_t d = 0; d < kDisturbances; ++d) jets[k].d[d] = x[(1 + d) * kMotionSize + k];
    }
    const Turning<Jet> turning = law_.turning(jets);
    const auto values = [](const auto& number) { return number.value; };
    const Mat3<double> R_LB = turning.R_LB.unaryExpr(values);
    const Vec3<double> w_B = turning.w_IB_B.unaryExpr(values), axis_B = Vec3<double>::Unit(law_.axis());
    std::array<Disturbance, kDisturbances> seen;
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      const auto change = [d](const Jet& number) { return number.d[d]; };
      const Mat3<double> turn_B = R_LB.transpose() * Mat3<double>(turning.R_LB.unaryExpr(change));
      const Vec3<double> dw_B = turning.w_IB_B.unaryExpr(change), phase_B = turning.phase.d[d] * axis_B;
      seen[d].theta_B =
          Vec3<double>(turn_B(2, 1) - turn_B(1, 2), turn_B(0, 2) - turn_B(2, 0), turn_B(1, 0) - turn_B(0, 1)) / 2 + phase_B;
      seen[d].dw_B = dw_B - phase_B.cross(w_B);
    }
    return seen;
  }
  void put(const Disturbance& disturbance, State& x, std::size_t d) const {
    std::ranges::copy(law_.change(motion_of(x), disturbance.theta_B, disturbance.dw_B), slot(x, d));
  }
  static void scale(State& x, std::size_t d, double factor) {
    std::for_each_n(slot(x, d), kMotionSize, [factor](double& number) { number *= factor; });
  }
  /// Restricts the disturbances of a body to those that a gimbal allows.
  void restrict(State& x) const {
    if (!model_->applied.level_axis) return;
    const GimbalFreedom freedom(*model_, motion(x));
    const auto seen = disturbances(x);
    for (std::size_t d = 0; d < kDisturbances; ++d) put(freedom.of(seen[d]), x, d);
  }

 private:
  template <std::size_t kCount>
  static std::array<double, kMotionSize> motion_of(const std::array<double, kCount>& x) {
    std::array<double, kMotionSize> motion;
    std::copy_n(x.begin(), kMotionSize, motion.begin());
    return motion;
  }
  static auto slot(State& x, std::size_t d) { return x.begin() + static_cast<std::ptrdiff_t>((1 + d) * kMotionSize); }

  const Model<double>* model_;
  Law law_;
};

/// The right-hand side of any body in a plain scene with its disturbances, written out: in steps of low accuracy it takes less than half the
/// time of the series of its recorded list, against which the tests hold it. With theta the turn that belongs to the change of q,
///   dq'/dt = (dq w_LB + q dw_LB) / 2 ,  Theta ddw/dt = (Theta dw) x w + (Theta w) x dw + m r x ((R^T f) x theta)
template <class System>
class PlainRate {
 public:
  using State = typename System::State;
  explicit PlainRate(const System& system) : model_(system.model()) {}
  void operator()(const State& x, State& dxdt, double) const {
    const Motion<double> motion{load_quaternion(x, 0), load_vector(x, 4)};
    put(body_equation<true, SceneKind::plain>(model_, motion, model_.apparent_gravity_L), dxdt, 0);
    const Mat3<double> R_LB = rotation_matrix(motion.q);
    const Vec3<double>& w = motion.m;
    const Vec3<double> W_B = transposed_times(R_LB, model_.W_IL_L), field_B = transposed_times(R_LB, model_.apparent_gravity_L);
    const Vec3<double> w_LB_B = w - W_B, L_B = times(model_.I_BP_B, w);
    const Quaternion<double> back = motion.q.conjugate();
    for (std::size_t i = System::kMotionSize; i < x.size(); i += System::kMotionSize) {
      const Quaternion<double> dq = load_quaternion(x, i);
      const Vec3<double> dw = load_vector(x, i + 4), theta = Vec3<double>((back * dq).v * (2 / motion.q.squared_norm()));
      const Quaternion<double> turning = attitude_rate_from_body(dq, w_LB_B);
      const Quaternion<double> turned = attitude_rate_from_body(motion.q, Vec3<double>(dw - W_B.cross(theta)));
      const Vec3<double> torque_B = times(model_.I_BP_B, dw).cross(w) + L_B.cross(dw) +
                                    field_torque(model_.mass_moment_B, Vec3<double>(field_B.cross(theta)));
      put({{turning.w + turned.w, turning.v + turned.v}, times(model_.I_BP_B_inverse, torque_B)}, dxdt, i);
    }
  }

 private:
  static void put(const Motion<double>& rate, State& dxdt, std::size_t at) {
    dxdt[at] = rate.q.w;
    store_vector(rate.q.v, dxdt, at + 1);
    store_vector(rate.m, dxdt, at + 4);
  }
  const Model<double>& model_;
};

}  // namespace earthtop
