// SPDX-License-Identifier: GPL-3.0-or-later
/// The two exact flows into which the symmetric top's motion without its spin splits (splitting_stepper.hpp), in axes that are
/// inertial for the length of a step and the laboratory's at its start:
///
///   A  free motion: n, u and the frame vector a turn about L / I1 = u + b n, by its length times h
///   B  gravity: u grows by h (m l / I1) n x g, n and a stay; g is the laboratory's, which turns with the Earth
///
/// At the end of the step all vectors turn by exp(-[W] h) into the laboratory's axes at that time, and a turns about n by -b h,
/// because the free flows have turned it too far by b h. Both turns commute with A, and with B if its gravity takes the Earth's
/// turn into account: done once for each step, they are exact.
#pragma once

#include <array>

#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/model/equations.hpp"
#include "integrate/entire_functions.hpp"

namespace earthtop {

/// A state together with what its components have lost to rounding, which the next sum adds (Kahan's summation). So each of a
/// million updates costs a rounding of the update, not one of the state.
template <class State>
struct CompensatedState {
  State x, carry{};

  void add(std::size_t i, typename State::value_type increment) {
    const auto y = increment + carry[i];
    const auto sum = x[i] + y;
    carry[i] = y - (sum - x[i]);
    x[i] = sum;
  }
  template <class Vector>
  void add_vector(std::size_t at, const Vector& increment) {
    for (std::size_t i = 0; i < 3; ++i) add(at + i, increment[static_cast<int>(i)]);
  }
  Vec3<typename State::value_type> load(std::size_t at) const { return {x[at], x[at + 1], x[at + 2]}; }
};

/// The rotation R by the vector 2 v, given by cos|v| and sinc = sin|v| / |v|.
struct HalfAngle {
  /// @param square  v.v
  explicit HalfAngle(double square) : cosine(entire::cosine(square)), sinc(entire::sinc(square)) {}
  double cosine, sinc;

  /// (R - 1) u.
  Vec3<double> increment(const Vec3<double>& v, const Vec3<double>& u) const {
    const Vec3<double> vu = v.cross(u);
    return (2 * sinc) * (cosine * vu + sinc * v.cross(vu));
  }
};

/// Gravity at time t, in the inertial axes that are the laboratory's at time 0.
inline Vec3<double> gravity_after(const Model<double>& model, double t) {
  return times(rotation_matrix(laboratory_turn(model, t).quaternion(model.epsilon)), model.apparent_gravity_L);
}

/// (R - 1) a, where R is the turn about n that brings a frame carried by the free flows of a step back to the spinless frame.
inline Vec3<double> spinless_increment(double b, const Vec3<double>& n, const Vec3<double>& a, double h) {
  const Vec3<double> back = (-h / 2 * b) * n;
  return HalfAngle(back.dot(back)).increment(back, a);
}

/// An upper estimate of the rate of a top's nutation or pendulum motion (rad per unit of time), which sets the steps.
/// @param turning_rate  L / I1
inline double nutation_rate(const Model<double>& model, const ReducedTop<double>& top, const Vec3<double>& turning_rate) {
  return norm(turning_rate) + 2 * std::sqrt(std::abs(top.moment_ratio) * norm(model.apparent_gravity_L)) + norm(model.W_IL_L);
}

/// The flows, on the state of `ReducedMotionSystem`: n (3), u (3) and, where the attitude is sought, the frame vector a (3).
template <Observer O, MotionSought S>
class ReducedMotionFlows {
 public:
  static constexpr bool kAttitude = S == MotionSought::attitude;
  using State = std::array<double, kAttitude ? 9 : 6>;
  /// @param b  (I3/I1) w3
  ReducedMotionFlows(const Model<double>& model, const ReducedTop<double>& top, double b) : model_(model), top_(top), b_(b) {}

  // The values that a kick and the end of a step need. Those of the end are the same in all steps of one length.
  using Kick = Vec3<double>;  ///< gravity at the time of the kick
  struct End {
    double h;
    Vec3<double> half_W;  ///< -W h / 2
    HalfAngle turn;
  };
  Kick kick_at(double after) const { return gravity_after(model_, after); }
  End end_of(double h) const {
    const Vec3<double> half_W = -h / 2 * model_.W_IL_L;
    return {h, half_W, HalfAngle(half_W.dot(half_W))};
  }

  void free(double h, CompensatedState<State>& s) const {
    const Vec3<double> n = s.load(0), u = s.load(3), v = (h / 2) * Vec3<double>(u + b_ * n);
    const HalfAngle turn(v.dot(v));
    s.add_vector(0, turn.increment(v, n));
    s.add_vector(3, turn.increment(v, u));
    if constexpr (kAttitude) s.add_vector(6, turn.increment(v, s.load(6)));
  }

  /// @param t  the time of the kick, read in inertial axes only   @param at  what kick_at gives, read in laboratory axes only
  void kick(double h, double t, const Kick& at, CompensatedState<State>& s) const {
    const Vec3<double> gravity = O == Observer::inertial ? gravity_after(model_, t) : at;
    s.add_vector(3, Vec3<double>(h * field_torque(mass_moment_along(top_, s.load(0)), gravity)));
  }

  void end(const End& step, CompensatedState<State>& s) const {
    const Vec3<double> n = s.load(0), u = s.load(3);
    if constexpr (kAttitude) {
      const Vec3<double> a = s.load(6);
      Vec3<double> da = spinless_increment(b_, n, a, step.h);
      if constexpr (O == Observer::laboratory) da += step.turn.increment(step.half_W, Vec3<double>(a + da));
      s.add_vector(6, da);
    }
    if constexpr (O == Observer::laboratory) {
      s.add_vector(0, step.turn.increment(step.half_W, n));
      s.add_vector(3, step.turn.increment(step.half_W, u));
    }
  }

  double rate(const State& x) const {
    return nutation_rate(model_, top_, Vec3<double>(x[3] + b_ * x[0], x[4] + b_ * x[1], x[5] + b_ * x[2]));
  }

 private:
  const Model<double>& model_;
  const ReducedTop<double>& top_;
  double b_;
};

}  // namespace earthtop
