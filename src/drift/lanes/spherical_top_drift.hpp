// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift of a symmetric top as that of a spherical top, on quaternions: the form that takes the fewest products.
///
/// The axis n of a symmetric top moves like that of a spherical top whose rate is l = u + b n, the angular momentum divided by
/// I1, with the transverse rate u and b = r w3, r = I3/I1 (reduced_top.hpp). Its attitude q, a unit quaternion with n = q k q^*
/// (k is the vertical and body axis 3), obeys q' = l q / 2 and, with gravity as the only torque, l' = -Gamma n x k with
/// Gamma = m g l / I1. With the height z of n and the conserved energy |l|^2/2 + Gamma z = 2 c,
///
///   q'' = (Gamma z - c) q + Gamma k q k / 2
///
/// which is Lame's equation, linear but for z, for each complex component of q (F. Klein, A. Sommerfeld, Theorie des Kreisels
/// II). On the rotating Earth, Q is the attitude of the spherical top relative to the laboratory and lambda = l_Q - W its rate;
/// Jacobi's integral |lambda|^2/2 + Gamma z_Q = 2 (c + epsilon j) is conserved, and
///
///   Q'' = (Gamma z_Q - c - epsilon j - W.lambda / 2) Q + Gamma k Q k / 2 - W Q'
///
/// In inertial axes gravity is along k + epsilon h, which turns about W, and |l_Q|^2/2 + Gamma z_Q - W.l_Q = 2 (c + epsilon j) is
/// conserved, with z_Q = n_Q.(k + epsilon h):
///
///   Q'' = (Gamma z_Q - c - epsilon j - W.l_Q / 2) Q + Gamma (k + epsilon h) Q k / 2
///
/// The deviation is delta = (Q - q) / epsilon, whose equation is the difference of the two, formed by hand: no large terms
/// cancel. The state is q, delta, their time derivatives, and in inertial axes h.
///
/// q goes round at the rate b/2, and with the nutation at up to 3 b/2 or more. The steps are longest in a frame that turns back
/// at about the rate of half of b; and where the axis hardly nutates, at b. So q and Q are replaced by q e^(k mu t / 2) and
/// Q e^(k mu t / 2), with mu between 0 and b. Then q'' has the further term -mu q' k, W Q' becomes W (Q' + mu Q k / 2), and c is
/// less by mu^2/4.
///
/// The body differs from that frame by turns about its axis that are exact: by psi = (w3 - b + mu) t, and on the rotating Earth
/// by psi + 2 theta, theta = epsilon (1 - r) k_3 t / 2 with k_3 = (w3_rot - w3_ref) / epsilon.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "drift/lanes/drift_kernels.hpp"
#include "drift/pivot/reduced_drift_system.hpp"
#include "integrate/lanes/schedule.hpp"

namespace earthtop {

/// The drift of a symmetric top in lanes. @tparam O  laboratory, or inertial, in whose axes gravity turns
template <Observer O>
class SphericalTopDrift {
 public:
  static constexpr bool kInertial = O == Observer::inertial;
  static constexpr int kVariables = kInertial ? lanes::kInertialDriftVariables : lanes::kLaboratoryDriftVariables;
  static constexpr std::size_t kSize = kVariables;
  using State = std::array<double, kSize>;
  using Shape = SphericalTopDrift;
  /// The system that the search for a threshold integrates.
  using Flow = ReducedDriftSystem<double, O>;
  static constexpr auto groups() { return std::array<ComponentGroup, 2>{{{0, 4, 1.0}, {4, 4, 1e-5}}}; }

  explicit SphericalTopDrift(const DriftProblem<double>& problem)
      : model_(problem.model),
        flow_(problem.model, problem.natural_release()),
        sought_(problem.sought),
        axis_(flow_.top().axis),
        w3_(problem.natural_release().w_XB_B[axis_]),
        gravity_(-flow_.top().moment_ratio * model_.apparent_gravity_L[2]) {
    if (axis_ == 0) q_BF_ = {0.5, Vec3<double>(0.5, 0.5, 0.5)};
    if (axis_ == 1) q_BF_ = {0.5, Vec3<double>(-0.5, -0.5, -0.5)};
    const NutationRate<double>& b = flow_.constants().b;
    const typename Flow::State at_release = flow_.initial_state();
    const Vec3<double> n = load_vector(at_release, 0), u = load_vector(at_release, 3), V = load_vector(at_release, 13);

    const double nutation = (norm(u) + std::abs(gravity_ / b.value) * real::hypot(n[0], n[1])) / std::abs(b.value);
    const double share = nutation < kLeastNutation ? 1 : nutation < kMostNutation ? 0.5 : 0;  // mu / b
    mu_ = share * b.value;
    // A relative error of c would become the same relative error of q's phase: what rounding leaves out of c is kept.
    const double of_square = (1 - share * share) / 4, b_square = b.value * b.value, square = of_square * b_square;
    const double square_rest = real::fma(of_square, b_square, -square) + of_square * real::fma(b.value, b.value, -b_square);
    const double energy = (u.dot(u) / 2 + gravity_ * n[2]) / 2;
    c_ = square + energy;
    const double of_energy = c_ - square;
    c_rest_ = (square - (c_ - of_energy)) + (energy - of_energy) + (square_rest + b.value * b.rest / 2);

    const Vec3<double>& w = model_.W_IL_L_scaled;
    Vec3<double> deviation = V + (flow_.top().spin_ratio * flow_.constants().k) * n;  // of the rate l, over epsilon
    if constexpr (!kInertial) deviation -= w;
    const Vec3<double> rate = u + b.value * n;
    j_ = (rate.dot(deviation) + model_.epsilon * deviation.dot(deviation) / 2) / 2;
    if constexpr (kInertial) j_ -= w.dot(rate + model_.epsilon * deviation) / 2;

    const Quaternion<double> q = (problem.release.q_LB * q_BF_).normalized();
    release_.fill(0);
    store(q, 0);
    store(half_of(Vec3<double>(u + (b.value - mu_) * n), q), 8);
    store(half_of(deviation, q), 12);
    deviation_size_ = norm(deviation) + norm(w);
    // A phase of 4 rad is too far for a series of any order and tolerance, and 1e3 units of time are long for every motion.
    const double slower = b.value - mu_;
    longest_ = std::min(4 / std::sqrt(std::max(slower * slower / 4 + energy + std::abs(gravity_), 0.0)), 1e3);
    const double turn = model_.epsilon * norm(w) * longest_;
    // The share of the term of order n in h is turn^(n - 1) / n! at most.
    for (double share_of_next = turn / 2; last_term_ < lanes::kMostOrder && share_of_next > kNegligible;
         share_of_next *= turn / (last_term_ + 1))
      ++last_term_;
    spin_ = w3_ - slower;
    const double of_less = spin_ - w3_;
    spin_rest_ = (w3_ - (spin_ - of_less)) - (slower + of_less) - b.rest;
  }

  State initial_state() const { return release_; }
  /// A state with the sizes that errors are measured against from the start. That of delta is what the deviation of the rates
  /// makes of it within about a unit of time.
  State typical_state() const {
    State x = release_;
    x[4] = deviation_size_;
    return x;
  }
  /// The longest step, by which the number of terms of h is chosen.
  double longest() const { return kInertial ? longest_ : HUGE_VAL; }
  double largest_step() const { return flow_.largest_step(); }
  void follow(const State&) {}

  template <class Put>
  void constants(const Put& put) const {
    using Constants = lanes::DriftConstants;
    put(Constants::gravity, gravity_);
    put(Constants::c, c_);
    put(Constants::c_rest, c_rest_);
    put(Constants::j, j_);
    put(Constants::epsilon, model_.epsilon);
    put(Constants::b, flow_.constants().b.value);
    put(Constants::mu, mu_);
    for (int i = 0; i < 3; ++i) put(Constants::W_scaled + i, model_.W_IL_L_scaled[i]);
    put(Constants::last_term, static_cast<double>(last_term_));
  }

  const Flow& flow() const { return flow_; }
  typename Flow::State flow_state(const State& x, double t) const {
    const Now now(*this, x, t);
    const Mat3<double> R = rotation_matrix(now.q);
    const Vec3<double> U = 2 * (now.q.conjugate() * now.velocity).v;
    const Quaternion<double> Q = rotating(now.q, now.delta);
    Vec3<double> G = 2 * Vec3<double>((now.delta.conjugate() * now.velocity).v + (Q.conjugate() * now.delta_velocity).v);
    if constexpr (!kInertial) G += transposed_times(rotation_matrix(Q), model_.W_IL_L_scaled);
    // The rotating body's transverse rate U + epsilon G, turned back by 2 theta, less U; over epsilon.
    const double c = now.cosine * now.cosine - now.sine * now.sine, s = 2 * now.sine * now.cosine;
    const double c_scaled = -2 * now.sine_scaled * now.sine, s_scaled = 2 * now.sine_scaled * now.cosine;
    const Vec3<double> V(c * G[0] + s * G[1] + c_scaled * U[0] + s_scaled * U[1],
                         c * G[1] - s * G[0] + c_scaled * U[1] - s_scaled * U[0], 0);
    const Quaternion<double> of_delta = now.delta * now.q.conjugate();
    const Quaternion<double> turned = Q * Quaternion<double>{0, Vec3<double>(0, 0, 1)} * now.q.conjugate();
    const double unspin = (mu_ - flow_.constants().b.value) * t - flow_.constants().b.rest * t;
    const SinCos<double> spin = real::sin_cos(unspin);

    typename Flow::State y;
    store_vector(Vec3<double>(R.col(2)), y, 0);
    store_vector(times(R, Vec3<double>(U[0], U[1], 0)), y, 3);
    store_vector(times(R, Vec3<double>(spin.cos, spin.sin, 0)), y, 6);
    y[9] = now.cosine * (now.q.squared_norm() + model_.epsilon * of_delta.w) + now.sine * turned.w;
    store_vector(Vec3<double>(now.cosine * of_delta.v + now.sine_scaled * turned.v), y, 10);
    store_vector(times(R, V), y, 13);
    return y;
  }

  /// The state in the variables that all observers share, with rates in natural units; without rates where only distances are
  /// sought. The norms of the quaternions are 1 but for the rounding of the steps.
  DriftState<double> shared_state(const State& x, double t) const {
    const Now now(*this, x, t);
    const Quaternion<double> spin = steady_turn(2, spin_, t) * small_turn(spin_rest_ * t);
    const double epsilon = model_.epsilon;
    DriftState<double> s = deviation_at(now, spin, t);
    s.q_LB = s.ref_q_LB * Quaternion<double>{s.e_w, epsilon * s.e_v_scaled};
    if (sought_ == DriftSought::distances) return s;
    s.ref_w_LB_B = rates_in_body(now.q, now.velocity, spin, w3_);
    const Quaternion<double> further = spin * Quaternion<double>{now.cosine, Vec3<double>(0, 0, now.sine)};
    s.w_LB_B = rates_in_body(rotating(now.q, now.delta), rotating(now.velocity, now.delta_velocity), further,
                             w3_ + epsilon * flow_.constants().k);
    // In laboratory axes the transverse rates are already those relative to the laboratory.
    const Vec3<double> W_B = transposed_times(rotation_matrix(s.q_LB), model_.W_IL_L);
    if constexpr (kInertial)
      s.w_LB_B -= W_B;
    else
      s.w_LB_B[axis_] -= W_B[axis_];
    return s;
  }
  /// As `ReducedDriftSystem::deviation_state`.
  DriftState<double> deviation_state(const State& x, double t) const {
    const Quaternion<double> spin = axis_ == 2 ? Quaternion<double>() : steady_turn(2, spin_, t);
    return deviation_at(Now(*this, x, t), spin, t);
  }

 private:
  /// Sizes of the nutation (rad) at which the frame's spin changes: its smallest share in a series of high order, and where the
  /// motion has no rate b of its own.
  static constexpr double kLeastNutation = 0x1p-23, kMostNutation = 0.1;
  /// The smallest share of a term of h in the whole.
  static constexpr double kNegligible = 1e-16;

  static Quaternion<double> load(const State& x, std::size_t at) { return {x[at], load_vector(x, at + 1)}; }
  void store(const Quaternion<double>& q, std::size_t at) {
    release_[at] = q.w;
    store_vector(q.v, release_, at + 1);
  }
  static Quaternion<double> half_of(const Vec3<double>& rate, const Quaternion<double>& q) {
    return Quaternion<double>{0, rate / 2} * q;
  }
  static Quaternion<double> small_turn(double angle) { return {1, Vec3<double>(0, 0, angle / 2)}; }

  /// The state at a time, with the turn by theta about the axis.
  struct Now {
    Quaternion<double> q, delta, velocity, delta_velocity;
    double cosine = 1, sine = 0, sine_scaled = 0;  ///< of theta; the last over epsilon
    Now(const SphericalTopDrift& system, const State& x, double t)
        : q(load(x, 0)), delta(load(x, 4)), velocity(load(x, 8)), delta_velocity(load(x, 12)) {
      const double theta_scaled = system.flow_.constants().axis_rate_factor * t / 2;
      if (theta_scaled == 0) return;
      const SinCos<double> both = real::sin_cos(system.model_.epsilon * theta_scaled);
      cosine = both.cos, sine = both.sin, sine_scaled = both.sin / system.model_.epsilon;
    }
  };
  Quaternion<double> rotating(const Quaternion<double>& reference, const Quaternion<double>& deviation) const {
    return {reference.w + model_.epsilon * deviation.w, reference.v + model_.epsilon * deviation.v};
  }
  /// The components of a vector of the frame, after a turn back by the frame's spin, in body axes.
  Vec3<double> in_body(const Vec3<double>& v, const Quaternion<double>& spin) const {
    const double c = spin.w * spin.w - spin.v[2] * spin.v[2], s = 2 * spin.w * spin.v[2];
    Vec3<double> v_B;
    v_B[(axis_ + 1) % 3] = c * v[0] + s * v[1];
    v_B[(axis_ + 2) % 3] = c * v[1] - s * v[0];
    v_B[axis_] = v[2];
    return v_B;
  }
  Vec3<double> rates_in_body(const Quaternion<double>& q, const Quaternion<double>& velocity, const Quaternion<double>& spin,
                             double along) const {
    Vec3<double> rate = 2 * (q.conjugate() * velocity).v;
    rate[2] = along;
    return in_body(rate, spin);
  }
  /// The attitude of the reference and the deviation from it, e = q^* Q e^(k theta), as seen from the laboratory.
  DriftState<double> deviation_at(const Now& now, const Quaternion<double>& spin, double t) const {
    const double epsilon = model_.epsilon;
    Quaternion<double> delta = now.delta;
    if constexpr (kInertial) {
      const LaboratoryTurn<double> turn = laboratory_turn(model_, t);
      // (turn.w - 1) / epsilon; while the turn is small, the square of its sine avoids the subtraction.
      const double less_one = turn.w > 0 ? -epsilon * turn.v_scaled.dot(turn.v_scaled) / (1 + turn.w) : (turn.w - 1) / epsilon;
      const Quaternion<double> back{turn.w, -epsilon * turn.v_scaled}, change{less_one, -turn.v_scaled};
      const Quaternion<double> of_delta = back * delta, of_q = change * now.q;
      delta = {of_delta.w + of_q.w, of_delta.v + of_q.v};
    }
    const Quaternion<double> g = now.q.conjugate() * delta;
    const double whole = now.q.squared_norm() + epsilon * g.w;
    DriftState<double> s;
    s.epsilon = epsilon;
    s.ref_q_LB = now.q * spin;
    if (axis_ != 2) s.ref_q_LB = s.ref_q_LB * q_BF_.conjugate();
    s.e_w = whole * now.cosine - epsilon * g.v[2] * now.sine;
    s.e_v_scaled = in_body(Vec3<double>(now.cosine * g.v[0] + now.sine * g.v[1], now.cosine * g.v[1] - now.sine * g.v[0],
                                        now.cosine * g.v[2] + whole * now.sine_scaled),
                           spin);
    return s;
  }

  const Model<double>& model_;
  Flow flow_;
  DriftSought sought_;
  int axis_;
  double w3_, gravity_;
  Quaternion<double> q_BF_;  ///< F: body axes in another order, with the axis of symmetry last
  double mu_ = 0, c_ = 0, c_rest_ = 0, j_ = 0;
  double deviation_size_ = 0, longest_ = 0;
  int last_term_ = 1;
  double spin_ = 0, spin_rest_ = 0;  ///< w3 - b + mu, and what its rounding left out
  State release_;
};

static_assert(lanes::are_groups_of<SphericalTopDrift<Observer::laboratory>>(lanes::kDriftGroups));
static_assert(lanes::are_groups_of<SphericalTopDrift<Observer::inertial>>(lanes::kDriftGroups));

}  // namespace earthtop
