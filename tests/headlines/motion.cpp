// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion.hpp"

#include "jet.hpp"

namespace headlines {
namespace {

Jet platform_angle(const Platform& platform, Real t) {
  const Real w = 2 * pi() * platform.frequency, angle = w * t + platform.phase;
  return {platform.rate * t + platform.acceleration * t * t / 2 + platform.amplitude * sinq(angle),
          platform.rate + platform.acceleration * t + platform.amplitude * w * cosq(angle),
          platform.acceleration - platform.amplitude * w * w * sinq(angle)};
}

/// a + s b
State sum(const State& a, Real s, const State& b) {
  return {{a.q_IB.w + s * b.q_IB.w, a.q_IB.v + s * b.q_IB.v},
          a.L_I + s * b.L_I,
          a.X_I + s * b.X_I,
          a.V_I + s * b.V_I,
          a.rotor_momentum + s * b.rotor_momentum,
          a.rotor_angle + s * b.rotor_angle,
          a.outer_angle + s * b.outer_angle,
          a.inner_angle + s * b.inner_angle,
          a.outer_rate + s * b.outer_rate,
          a.inner_rate + s * b.inner_rate,
          a.latitude + s * b.latitude,
          a.longitude + s * b.longitude,
          a.course + s * b.course};
}

constexpr int kColumns = 16;  // of the extrapolation: its order is 32

}  // namespace

Motion::Motion(const Scene& scene, Real rotation_rate, bool travels)
    : scene_(&scene), rate_(rotation_rate), travels_(travels && scene.travel) {
  if (scene.gimbals) {
    release_in_gimbals();
    return;
  }
  const Mat R_LB = matrix(scene.q_LB);
  Vec w_IB_B = scene.w_XB_B;
  const Vec own_rate = travels_ ? travelling(scene, rate_, 0, state_).w_I : rate_ * scene.celestial_axis;
  w_IB_B += transposed(R_LB) * (scene.inertial_rates ? reference_rate_L() : own_rate);
  state_ = {scene.q_LB, R_LB * (scene.inertia_at(0) * w_IB_B + scene.momentum_within(0)), {}, {}};
  if (scene.rotor) {
    const Rotor& rotor = *scene.rotor;
    state_.rotor_momentum = rotor.axial * (dot(rotor.axis, w_IB_B) + rotor.spin);
    state_.L_I += state_.rotor_momentum * (R_LB * rotor.axis);
  }
  if (!scene.contact) return;
  const Vec up{0, 0, 1}, W = rate_ * scene.celestial_axis, w = R_LB * w_IB_B, r_c = R_LB * scene.centre;
  const Vec tip = scene.contact->tip_radius * up;
  const Vec tip_velocity_L = scene.contact->released_rolling ? cross(w - W, tip) : Vec{};
  state_.X_I = tip + r_c;
  state_.V_I = tip_velocity_L + cross(W, tip) + cross(w, r_c);
}

Vec Motion::reference_rate_L() const {
  if (!scene_->travel) return {};
  return scene_->travel->still_reference ? scene_->rotation_rate * scene_->celestial_axis : travelling(*scene_, 0, 0, {}).w_I;
}

Vec Motion::falling_I(Real t, const State& state) const {
  if (travels_) return travelling(*scene_, rate_, t, state).falling_I;
  const Jet earth_angle{rate_ * t, rate_, 0};
  const Vec& k = scene_->celestial_axis;
  const Vec up_I = rate_ == 0 ? Vec{0, 0, 1} : headlines::turned(k, earth_angle.value, Vec{0, 0, 1});
  Vec falling = -scene_->gravity * up_I;
  if (scene_->platform) {
    const Platform& platform = *scene_->platform;
    const JetVec offset{{platform.offset.x, 0, 0}, {platform.offset.y, 0, 0}, {platform.offset.z, 0, 0}};
    // Apparent gravity includes the acceleration of the platform's centre; the pivot moves relative to it.
    const JetVec pivot = turned(k, earth_angle, turned(platform.axis, platform_angle(platform, t), offset));
    falling = falling - Vec{pivot.x.second, pivot.y.second, pivot.z.second};
  }
  return falling;
}

Vec Motion::angular_velocity(Real t, const State& state) const {
  Vec L_B = transposed(matrix(state.q_IB)) * state.L_I;
  if (scene_->rotor) L_B = L_B - state.rotor_momentum * scene_->rotor->axis;
  if (scene_->masses.empty()) return scene_->inverse_inertia * L_B;
  return inverse(scene_->inertia_at(t)) * (L_B - scene_->momentum_within(t));
}

Real Motion::rotor_rate(Real t, const State& state) const {
  return state.rotor_momentum / scene_->rotor->axial - dot(scene_->rotor->axis, angular_velocity(t, state));
}

Vec Motion::tip_L() const {
  const Vec tip_I = state_.X_I - matrix(state_.q_IB) * scene_->centre;
  return headlines::turned(scene_->celestial_axis, -rate_ * t_, tip_I);
}

Vec Motion::acting_torque_I(Real t, const Mat& R_IB, const Vec& w) const {
  const Acting& acting = scene_->acting;
  const auto from_laboratory = [&](const Vec& v) { return headlines::turned(scene_->celestial_axis, rate_ * t, v); };
  const Vec w_B = transposed(R_IB) * (w - rate_ * scene_->celestial_axis), n = R_IB * Vec{0, 0, 1};
  Vec torque = R_IB * Vec{-acting.friction.x * w_B.x, -acting.friction.y * w_B.y, -acting.friction.z * w_B.z};
  // A spring pulls the end of a unit axis along e.
  const Vec e = from_laboratory(acting.stiff_direction);
  torque += cross(n, (-acting.stiffness * dot(n, e)) * e);
  const Real course = acting.torque_oscillates ? sinq(2 * pi() * acting.frequency * t + acting.phase) : 1;
  torque += course * (acting.torque_of_body ? R_IB * acting.torque : from_laboratory(acting.torque));
  return torque;
}

State Motion::slope(Real t, const State& state) const {
  if (scene_->contact) return slope_on_table(t, state);
  if (scene_->gimbals) return slope_in_gimbals(t, state);
  const Mat R_IB = matrix(state.q_IB);
  State slope{state.q_IB * Quat{0, Real(0.5) * angular_velocity(t, state)},
              cross(R_IB * scene_->mass_moment_at(t), falling_I(t, state)) +
                  acting_torque_I(t, R_IB, R_IB * angular_velocity(t, state)),
              {},
              {}};
  if (travels_) {
    const Travelling way = travelling(*scene_, rate_, t, state);
    slope.latitude = way.latitude_rate, slope.longitude = way.longitude_rate, slope.course = way.course_rate;
  }
  if (!scene_->rotor) return slope;
  slope.rotor_angle = rotor_rate(t, state);
  slope.rotor_momentum = scene_->rotor->bearing.torque(0, slope.rotor_angle);
  return slope;
}

Real Motion::try_step(Real step, Real scale, State& result) const {
  const State first = slope(t_, state_);
  std::array<State, kColumns> row;  // row[k]: extrapolated k times, of the latest number of substeps
  for (int j = 0; j < kColumns; ++j) {
    // Gragg's midpoint rule with n substeps, whose error expands in even powers of step / n.
    const int n = 2 * (j + 1);
    const Real h = step / n;
    State before = state_, now = sum(state_, h, first);
    for (int m = 1; m < n; ++m) {
      const State next = sum(before, 2 * h, slope(t_ + m * h, now));
      before = now, now = next;
    }
    // Aitken and Neville's extrapolation to substeps of length 0.
    for (int k = 0; k < j; ++k) {
      const Real ratio = Real(n) / (2 * (j - k));
      const State next = sum(now, 1 / (ratio * ratio - 1), sum(now, -1, row[k]));
      row[k] = now, now = next;
    }
    row[j] = now;
  }
  // The difference of the last two columns of the last row, of orders 32 and 30, estimates the error.
  result = row[kColumns - 1];
  return size_of(sum(result, -1, row[kColumns - 2]), scale);
}

Real Motion::size_of(const State& error, Real scale) const {
  if (scene_->gimbals) {
    const Real of_rotor =
        scene_->rotor ? fabsq(error.rotor_momentum) / (scene_->rotor->axial * (1 + fabsq(scene_->rotor->spin))) : 0;
    const Real of_angles = fmaxq(fabsq(error.outer_angle), fabsq(error.inner_angle));
    return fmaxq(of_rotor, fmaxq(of_angles, fmaxq(fabsq(error.outer_rate), fabsq(error.inner_rate))));
  }
  const Real of_momenta = fmaxq(norm(error.L_I), fabsq(error.rotor_momentum)) / scale;
  return fmaxq(fmaxq(sqrtq(squared_norm(error.q_IB)), of_momenta), fmaxq(norm(error.X_I), norm(error.V_I)));
}

std::array<Real, 3> Motion::platform_turn(Real t) const {
  if (!scene_->platform) return {0, 0, 0};
  const Jet angle = platform_angle(*scene_->platform, t);
  return {angle.value, angle.first, angle.second};
}

Quat Motion::q_LB() const {
  if (scene_->gimbals) {
    const Quat q = q_PB();
    return scene_->platform ? turn(scene_->platform->axis, platform_turn(t_)[0]) * q : q;
  }
  if (travels_) return normalized(conjugate(travelling(*scene_, rate_, t_, state_).q_IL) * state_.q_IB);
  return normalized(conjugate(turn(scene_->celestial_axis, rate_ * t_)) * state_.q_IB);
}

Vec Motion::w_IB_B() const {
  if (!scene_->gimbals) return angular_velocity(t_, state_);
  const Posture at = posture(t_, state_);
  return transposed(at.R_PB) * at.w_B;
}

Vec Motion::w_LB_B() const {
  if (travels_ && !scene_->gimbals)
    return w_IB_B() - transposed(matrix(state_.q_IB)) * travelling(*scene_, rate_, t_, state_).w_I;
  if (!scene_->gimbals) return w_IB_B() - rate_ * (transposed(matrix(state_.q_IB)) * scene_->celestial_axis);
  const Posture at = posture(t_, state_);
  return transposed(at.R_PB) * (at.w_B - at.earth);
}

Real Motion::rotor_rate() const { return scene_->gimbals ? slope_in_gimbals(t_, state_).rotor_angle : rotor_rate(t_, state_); }

}  // namespace headlines
