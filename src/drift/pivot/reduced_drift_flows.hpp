// SPDX-License-Identifier: GPL-3.0-or-later
/// The two exact flows of a symmetric top's drift integration, free of cancellation. The state is that of
/// reduced_drift_system.hpp, the axes are those of reduced_motion_flows.hpp.
///
/// A, free motion for the time h. With r = I3/I1, the reference turns about l = L / I1 = u + b n; the rotating body, seen from
/// the reference, turns about l + epsilon p with p = V + r k n:
///
///   D' = D E ,  E = exp([l + epsilon p] h) exp(-[l] h) ,  V' = exp([l] h) V
///
/// E is a turn by an angle of order epsilon, although both its factors are large. With v = l h / 2, q = p h / 2,
/// S(z) = sin(sqrt z) / sqrt z, a = |v + epsilon q| and b = |v|, the vector part of its quaternion divided by epsilon is
///
///   cos b S(a^2) q - S(a^2) S(b^2) q x v - 2 (2 v.q + epsilon q.q) S[(a + b)^2, (a - b)^2] v
///
/// with the divided difference S[., .] of S, and a - b = (a^2 - b^2) / (a + b).
///
/// B, gravity for the time h: u grows by h (m l / I1) n x g, V by h (m l / I1) n x (D^T g_rot - g) / epsilon; n and D stay.
///
/// At the end of the step the rotating body turns about its axis because its spin exceeds the reference's, and by the Earth's
/// rotation: D' = exp(-[W] h) D N, l + epsilon p' = N^T (l + epsilon p), N = exp([n] epsilon (1 - r) k h).
#pragma once

#include "earthtop/drift/deviation.hpp"
#include "integrate/reduced_motion_flows.hpp"

namespace earthtop {

/// A turn by a small angle, as a quaternion (1 + w_less_one, epsilon y).
struct ScaledTurn {
  double w_less_one;
  Vec3<double> y;
};

/// The turn E above, for turning rates L and L + epsilon P. @param k  h / 2   @param v  k L   @param half  the turn by 2 v
inline ScaledTurn relative_turn(const Vec3<double>& L, const Vec3<double>& P, double epsilon, double k, const Vec3<double>& v,
                                const HalfAngle& half) {
  const Vec3<double> q = k * P, u = k * Vec3<double>(L + epsilon * P);
  const double square_u = u.dot(u), square_v = v.dot(v), product = std::sqrt(square_u * square_v);
  const HalfAngle half_u(square_u);
  const double difference = 2 * v.dot(q) + epsilon * q.dot(q);  // (square_u - square_v) / epsilon
  const double sum_square = square_u + square_v + 2 * product, gap = 4 * product;
  const double distance = epsilon * difference;
  const double difference_square = sum_square > 0 ? distance * distance / sum_square : 0;
  // Where the two squares are so close that their difference is round-off, the slope between them is used.
  const double divided = gap > 1e-6 ? (entire::sinc(sum_square) - entire::sinc(difference_square)) / gap
                                    : entire::sinc_slope((sum_square + difference_square) / 2);
  const Vec3<double> y = half_u.sinc * (half.cosine * q - half.sinc * q.cross(v)) - (2 * difference * divided) * v;
  const double w = half_u.cosine * half.cosine + half_u.sinc * half.sinc * u.dot(v);
  return {-epsilon * epsilon * y.dot(y) / (1 + w), y};
}

/// Gravity on the rotating Earth at the time of a kick, in the inertial axes that are the laboratory's at time 0.
struct TurnedGravity {
  Vec3<double> gravity;
  Vec3<double> difference_scaled;  ///< (gravity - that of the reference) / epsilon
};
inline TurnedGravity turned_gravity_after(const Model<double>& model, double t) {
  const LaboratoryTurn<double> turn = laboratory_turn(model, t);
  const Vec3<double>& g_L = model.apparent_gravity_L;
  const Vec3<double> difference_scaled = turn_minus_one_scaled(turn.w, turn.v_scaled, model.epsilon, g_L);
  return {g_L + model.epsilon * difference_scaled, difference_scaled};
}

template <Observer O>
class ReducedDriftFlows {
 public:
  using State = std::array<double, 16>;
  /// @param b  (I3/I1) w3 of the reference   @param k  (w3_rot - w3_ref) / epsilon
  ReducedDriftFlows(const Model<double>& model, const ReducedTop<double>& top, double b, double k)
      : model_(model), top_(top), b_(b), k_(k) {}

  using Kick = TurnedGravity;
  struct End {
    double h;
    ScaledTurn laboratory;  ///< exp(-[W] h)
    double spin_w_less_one, spin_sine_scaled;
  };
  Kick kick_at(double after) const { return turned_gravity_after(model_, after); }
  End end_of(double h) const {
    const double epsilon = model_.epsilon;
    const auto turn_by = [&](const Vec3<double>& half_scaled) -> ScaledTurn {
      const double square = epsilon * epsilon * half_scaled.dot(half_scaled);
      const Vec3<double> y = entire::sinc(square) * half_scaled;
      return {-epsilon * epsilon * y.dot(y) / (1 + entire::cosine(square)), y};
    };
    const ScaledTurn spin = turn_by({0, 0, h / 2 * (1 - top_.spin_ratio) * k_});
    return {h, turn_by(-h / 2 * model_.W_IL_L_scaled), spin.w_less_one, spin.y[2]};
  }

  void free(double h, CompensatedState<State>& s) const {
    const Vec3<double> n = s.load(0), u = s.load(3), V = s.load(13);
    const Vec3<double> l = u + b_ * n, p = V + (top_.spin_ratio * k_) * n, v = (h / 2) * l;
    const HalfAngle half(v.dot(v));
    s.add_vector(0, half.increment(v, n));
    s.add_vector(3, half.increment(v, u));
    s.add_vector(6, half.increment(v, s.load(6)));
    s.add_vector(13, half.increment(v, V));
    TurnProduct D(s, model_.epsilon);
    D.multiply(relative_turn(l, p, model_.epsilon, h / 2, v, half), 1);
    D.add_to(s);
  }

  /// @param t  the time of the kick, read in inertial axes only   @param at  what kick_at gives, read in laboratory axes only
  void kick(double h, double t, const Kick& at, CompensatedState<State>& s) const {
    const Vec3<double> mass_moment = mass_moment_along(top_, s.load(0));
    const TurnedGravity rotating = O == Observer::inertial ? turned_gravity_after(model_, t) : at;
    const Vec3<double> Dg =
        turn_back_minus_one_scaled(s.x[9], s.load(10), model_.epsilon, rotating.gravity) + rotating.difference_scaled;
    s.add_vector(3, Vec3<double>(h * field_torque(mass_moment, model_.apparent_gravity_L)));
    s.add_vector(13, Vec3<double>(h * field_torque(mass_moment, Dg)));
  }

  void end(const End& step, CompensatedState<State>& s) const {
    const double epsilon = model_.epsilon;
    const Vec3<double> n = s.load(0);
    s.add_vector(6, spinless_increment(b_, n, s.load(6), step.h));

    const Vec3<double> y = step.spin_sine_scaled * n;
    TurnProduct D(s, epsilon);
    D.multiply({step.spin_w_less_one, y}, 1);
    if constexpr (O == Observer::laboratory) D.multiply(step.laboratory, -1);
    D.add_to(s);
    // The part along n does not change: only u + epsilon V turns.
    const Vec3<double> across = Vec3<double>(s.load(3) + epsilon * s.load(13)).cross(y);
    s.add_vector(13, Vec3<double>(2 * ((1 + step.spin_w_less_one) * across + epsilon * across.cross(y))));
  }

  double rate(const State& x) const {
    return nutation_rate(model_, top_, Vec3<double>(x[3] + b_ * x[0], x[4] + b_ * x[1], x[5] + b_ * x[2]));
  }

 private:
  /// The product of D with further turns, and the change of D.
  struct TurnProduct {
    double epsilon, w, dw = 0;
    Vec3<double> y, dy = Vec3<double>::Zero();
    TurnProduct(const CompensatedState<State>& s, double epsilon_) : epsilon(epsilon_), w(s.x[9]), y(s.load(10)) {}
    /// @param side  1 from the right, -1 from the left
    void multiply(const ScaledTurn& turn, double side) {
      const double step_w = w * turn.w_less_one - epsilon * epsilon * y.dot(turn.y);
      const Vec3<double> step_y = turn.w_less_one * y + w * turn.y + (side * epsilon) * y.cross(turn.y);
      w += step_w, dw += step_w, y += step_y, dy += step_y;
    }
    void add_to(CompensatedState<State>& s) const {
      s.add(9, dw);
      s.add_vector(10, dy);
    }
  };

  const Model<double>& model_;
  const ReducedTop<double>& top_;
  double b_, k_;
};

}  // namespace earthtop
