// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of both motions of a Cardan suspension: those of gimbal_equations.hpp on pairs.
///
/// The state is that of the reference, then the differences of the rotating motion over epsilon, each
///   [0] alpha   [1] beta   [2] p_a   [3] p_b   [4] h   [5] the rotor's angle minus that of a steady spin
#pragma once

#include <array>

#include "earthtop/drift/deviation.hpp"
#include "earthtop/model/gimbal_equations.hpp"
#include "integrate/group_norms.hpp"

namespace earthtop {

struct GimbalShape {
  static constexpr std::size_t kOuter = 0, kInner = 1, kMomenta = 2, kAngle = 5;
  static constexpr std::size_t kHalf = 6, kSize = 2 * kHalf;
  /// Angles and momenta are of the size of 1 in natural units. The differences of both are one group: where one of them vanishes, its
  /// round-off is that of the other.
  static constexpr auto groups() {
    return std::array<ComponentGroup, 5>{
        {{kOuter, 2, 1.0}, {kMomenta, 3, 1e-3}, {kAngle, 1, 2.0}, {kHalf, 5, 1e-5}, {kHalf + kAngle, 1, 2.0}}};
  }
};

/// @tparam T  a number, or a scalar that records operations   @tparam O  laboratory, or inertial
template <class T, Observer O>
struct GimbalDriftEquations {
  static_assert(O != Observer::body);
  using Shape = GimbalShape;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<T, kSize>;
  using P = Paired<T>;

  Model<T> model;
  EARTHTOP_MEMBERS(model)

  void operator()(const State& x, State& dxdt, T t) const {
    const GimbalPose<T, P> pose = pose_of(x);
    const GimbalSurroundings<P> around = surroundings(t);
    const CarriedParts<T> parts = carried_parts(model, t);
    const GimbalMotion<P> m = gimbal_motion(model, parts, pose, momenta(x), around.turning, t);
    const GimbalMomenta<P> rate =
        momentum_rates<O == Observer::laboratory>(model, parts, pose, at(x, Shape::kOuter), at(x, Shape::kInner), m, around);
    put(m.outer_rate, dxdt, Shape::kOuter), put(m.inner_rate, dxdt, Shape::kInner);
    put(rate.outer, dxdt, Shape::kMomenta), put(rate.inner, dxdt, Shape::kMomenta + 1),
        put(rate.rotor, dxdt, Shape::kMomenta + 2);
    put(m.rotor_rate - P(model.rotor.spin), dxdt, Shape::kAngle);
  }

  /// A quantity of a state in both motions.
  P at(const State& x, std::size_t i) const { return P::apart(x[i], x[Shape::kHalf + i], model.epsilon); }
  GimbalPose<T, P> pose_of(const State& x) const {
    return {model.gimbals, paired_sin_cos(at(x, Shape::kOuter), model.epsilon),
            paired_sin_cos(at(x, Shape::kInner), model.epsilon)};
  }
  GimbalMomenta<P> momenta(const State& x) const {
    return {at(x, Shape::kMomenta), at(x, Shape::kMomenta + 1), at(x, Shape::kMomenta + 2)};
  }
  /// The motion of a state in the observer's frame.
  GimbalMotion<P> motion(const State& x, T t) const {
    return gimbal_motion(model, carried_parts(model, t), pose_of(x), momenta(x), surroundings(t).turning, t);
  }
  GimbalSurroundings<P> surroundings(const T& t) const { return gimbal_surroundings<O == Observer::laboratory>(model, t); }
  void put(const P& both, State& x, std::size_t i) const { x[i] = both.ref, x[Shape::kHalf + i] = both.diff; }
};

}  // namespace earthtop
