// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of the reference and the deviation of a symmetric top on a table, without its angle of spin. The rotating motion
/// is the reference plus epsilon times the deviation, component by component; every formula of reduced_contact.hpp or
/// inertial_contact.hpp is evaluated on pairs, whose differences are the derivatives of the deviation. Nothing else is derived.
///
/// In axes H of the table (laboratory), the reference has, and the deviation has again:
///   [0,3) axis n   [3,6) transverse rate u   [6,9) frame vector a (reduced_top.hpp)
///   [9] inertial spin w3, of the reference minus that at release   [10] its integral over time
///   [11,13) slip v_P   [13,15) tip position p_O
///   [15] work of friction   [16] change of Jellett's lambda, both of each motion by itself: the second is the rotating one's
/// In inertial axes N, which are H's at release, slip and position have three components, [11,14) and [14,17), the position is
/// that of the centre of mass, and the last two are left out.
#pragma once

#include <algorithm>
#include <array>

#include "drift/table/contact_integrals.hpp"
#include "drift/table/contact_pairs.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/model/contact_release.hpp"
#include "earthtop/model/inertial_contact.hpp"
#include "earthtop/model/reduced_contact.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/state_vectors.hpp"

namespace earthtop {

/// The shape of a state. Slip and position are lengths, often much smaller than 1: each is measured against its own size.
template <Observer O>
struct ContactReducedShape {
  static_assert(O != Observer::body);
  static constexpr std::size_t kLength = O == Observer::laboratory ? 2 : 3;  ///< components of slip and position
  static constexpr std::size_t kN = 0, kU = 3, kA = 6, kSpin = 9, kPhase = 10, kSlip = 11, kPosition = kSlip + kLength;
  static constexpr bool kHasIntegrals = O == Observer::laboratory;
  static constexpr std::size_t kWork = kPosition + kLength, kJellett = kWork + 1;
  static constexpr std::size_t kHalf = kWork + (kHasIntegrals ? 2 : 0);  ///< components of the reference, and of the deviation
  static constexpr std::size_t kSize = 2 * kHalf;
  /// The program of these equations takes long for each order besides its products, and a slip that dies out keeps steps short.
  static constexpr double kOrderOffset = 12;
  static constexpr auto groups() {
    constexpr std::size_t kIntegrals = kHasIntegrals ? 2 : 0;  // in inertial axes their groups are empty
    return std::array<ComponentGroup, 17>{{{kN, 3, 1.0},
                                           {kU, 3, 1e-3},
                                           {kA, 3, 1.0},
                                           {kSpin, 1, 1e-3},
                                           {kPhase, 1, 2.0},
                                           {kSlip, kLength, 1e-9},
                                           {kPosition, kLength, 1e-6},
                                           {kWork - 2 + kIntegrals, kIntegrals / 2, 1e-9},
                                           {kWork - 1 + kIntegrals, kIntegrals / 2, 1e-9},
                                           {kHalf + kN, 3, 1e-5},
                                           {kHalf + kU, 3, 1e-5},
                                           {kHalf + kA, 3, 1e-5},
                                           {kHalf + kSpin, 2, 1e-5},
                                           {kHalf + kSlip, kLength, 1e-9},
                                           {kHalf + kPosition, kLength, 1e-9},
                                           {kHalf + kWork - 2 + kIntegrals, kIntegrals / 2, 1e-9},
                                           {kHalf + kWork - 1 + kIntegrals, kIntegrals / 2, 1e-9}}};
  }
};

/// A symmetric top in both predictions, in axes H.
template <class T>
struct PairedTop {
  ReducedContactState<Paired<T>> state;
  Vec3<Paired<T>> a;      ///< frame vector
  T phase, phase_change;  ///< integral of w3 minus that at release, and of its difference over epsilon
};

/// @tparam T  a number, or a scalar that records operations   @tparam O  laboratory, or inertial
template <class T, Observer O>
class ContactReducedEquations {
 public:
  using Shape = ContactReducedShape<O>;
  static constexpr std::size_t kSize = Shape::kSize, kHalf = Shape::kHalf;
  using State = std::array<T, kSize>;
  using P = Paired<T>;

  /// @param model  in the table's axes   @param w3  inertial spin of the reference at release
  ContactReducedEquations(const Model<T>& model, const Contact<T>& contact, const Quaternion<T>& q_LH, T w3)
      : model_(model), contact_(contact), q_LH_(q_LH), R_LH_(rotation_matrix(q_LH)), w3_(w3), pairs_(paired(contact)) {}

  void operator()(const State& x, State& dxdt, T t) const {
    const Instant now = instant(x, t);
    ReducedContactRates<P> rates;
    Vec3<P> a_dot;
    rates_of(now, rates, a_dot);
    store(x, rates, a_dot, dxdt);
    store_integrals(now, rates.reaction, dxdt);
  }
  /// The table's force on both motions.
  ContactReaction<P> reaction(const State& x, T t) const {
    ReducedContactRates<P> rates;
    Vec3<P> a_dot;
    rates_of(instant(x, t), rates, a_dot);
    if constexpr (O == Observer::laboratory) return rates.reaction;
    const EarthTurn<T> turn(model_, t);
    return {rates.reaction.normal_force, rates.reaction.denominator, turn.from_inertial(rates.reaction.friction),
            turn.from_inertial(rates.reaction.moment)};
  }

  /// Both motions in the table's axes.
  PairedTop<T> top(const State& x, T t) const {
    PairedTop<T> top = load(x);
    if constexpr (O == Observer::inertial) {
      const EarthTurn<T> turn(model_, t);
      ReducedContactState<P>& s = top.state;
      s.n = turn.from_inertial(s.n), s.u = turn.from_inertial(s.u), top.a = turn.from_inertial(top.a);
      s.v_P = turn.from_inertial(s.v_P);
      s.p_O = turn.from_inertial(s.p_O) - pairs_.height_of_center * s.n;
    }
    return top;
  }
  /// Both motions, in the axes and variables of the state, and what acts on them.
  struct Instant {
    PairedTop<T> top;
    ContactSurroundings<P> around;
  };
  Instant instant(const State& x, const T& t) const { return {load(x), surroundings(t)}; }
  /// The time derivatives as pairs, in the axes and variables of the state; `store` makes those of a state from them.
  void rates_of(const Instant& now, ReducedContactRates<P>& rates, Vec3<P>& a_dot) const {
    const auto& [top, around] = now;
    const ReducedContactState<P>& s = top.state;
    if constexpr (O == Observer::laboratory) {
      rates = reduced_rates(pairs_, around, s);
      a_dot = Vec3<P>(s.u - around.W).cross(top.a);
    } else {
      const InertialContactState<P> seen{s.p_O, s.v_P, Vec3<P>(s.u + s.w3 * s.n)};
      const InertialContactBody<P> body = inertial_body(pairs_, s.n, s.u, s.w3);
      const InertialContactRates<P> found = inertial_rates(pairs_, around, body, seen);
      rates.n = body.n_dot;
      rates.w3 = found.w3;
      rates.u = found.w_IB - rates.w3 * s.n - s.w3 * body.n_dot;
      rates.v_P = found.v_P, rates.p_O = found.X_C, rates.reaction = found.reaction;
      a_dot = s.u.cross(top.a);
    }
  }
  void store(const State& x, const ReducedContactRates<P>& rates, const Vec3<P>& a_dot, State& dxdt) const {
    store_pair(rates.n, dxdt, Shape::kN), store_pair(rates.u, dxdt, Shape::kU), store_pair(a_dot, dxdt, Shape::kA);
    dxdt[Shape::kSpin] = rates.w3.ref, dxdt[kHalf + Shape::kSpin] = rates.w3.diff;
    dxdt[Shape::kPhase] = x[Shape::kSpin], dxdt[kHalf + Shape::kPhase] = x[kHalf + Shape::kSpin];
    for (std::size_t i = 0; i < Shape::kLength; ++i) {
      const int axis = static_cast<int>(i);
      dxdt[Shape::kSlip + i] = rates.v_P[axis].ref, dxdt[kHalf + Shape::kSlip + i] = rates.v_P[axis].diff;
      dxdt[Shape::kPosition + i] = rates.p_O[axis].ref, dxdt[kHalf + Shape::kPosition + i] = rates.p_O[axis].diff;
    }
  }

  /// The rates of the integrals; of those of the second half, the rotating motion's.
  void store_integrals(const Instant& now, const ContactReaction<P>& reaction, State& dxdt) const {
    if constexpr (Shape::kHasIntegrals) {
      const ReducedContactState<P>& s = now.top.state;
      const ContactSurroundings<P>& around = now.around;
      const Vec3<P> w = s.u + s.w3 * s.n - around.W;
      for (const auto& [motion, half] : {std::pair(&P::ref, std::size_t(0)), std::pair(&P::rot, kHalf)}) {
        dxdt[half + Shape::kWork] = friction_power(contact_, reaction, s.v_P, w, motion);
        dxdt[half + Shape::kJellett] = jellett_power(contact_, reaction, around, s, motion);
      }
      if (!contact_.air.acts()) return;
      const Vec3<P> torque = air_torque_beside_axis(pairs_.air, w, s.n);
      const Vec3<P> v_O = s.v_P + pairs_.tip_radius * Vec3<P>(w.cross(around.normal));
      const Vec3<P> v_C = v_O + pairs_.height_of_center * Vec3<P>(w.cross(s.n));
      const Vec3<P> rho = pairs_.tip_radius * around.normal + pairs_.height_of_center * s.n;
      for (const auto& [motion, half] : {std::pair(&P::ref, std::size_t(0)), std::pair(&P::rot, kHalf)}) {
        dxdt[half + Shape::kWork] = dxdt[half + Shape::kWork] + air_power(pairs_, torque, w, v_C, motion);
        if (contact_.air.turns)
          dxdt[half + Shape::kJellett] =
              dxdt[half + Shape::kJellett] + inner(motion_of(torque, motion), motion_of(rho, motion));
      }
    }
  }

  /// The state of two motions at release.   @param slip, slip_change  of the reference, and of the difference over epsilon
  State initial_state(const Mat3<T>& R_HB, const Vec3<T>& w_IB_H, const Vec3<T>& rate_change_H, const Vec3<T>& slip,
                      const Vec3<T>& slip_change, const Vec3<T>& p_O) const {
    State x{};
    const Vec3<T> n = R_HB.col(2);
    const T along = inner(rate_change_H, n);
    store_vector(n, x, Shape::kN), store_vector(R_HB.col(0), x, Shape::kA);
    store_vector(Vec3<T>(w_IB_H - inner(w_IB_H, n) * n), x, Shape::kU);
    store_vector(Vec3<T>(rate_change_H - along * n), x, kHalf + Shape::kU);
    x[kHalf + Shape::kSpin] = along;
    const Vec3<T> position = O == Observer::laboratory ? p_O : Vec3<T>(p_O + contact_.height_of_center * n);
    for (std::size_t i = 0; i < Shape::kLength; ++i) {
      const int axis = static_cast<int>(i);
      x[Shape::kSlip + i] = slip[axis], x[kHalf + Shape::kSlip + i] = slip_change[axis];
      x[Shape::kPosition + i] = position[axis];
    }
    return x;
  }

  /// Goes on under another law, as when slip stops.
  void set_law(ContactLaw law) { contact_.law = pairs_.law = law; }

  const Model<T>& model() const { return model_; }
  const Contact<T>& contact() const { return contact_; }
  const Quaternion<T>& q_LH() const { return q_LH_; }
  T w3() const { return w3_; }

 private:
  P pair_at(const State& x, std::size_t i) const { return P::apart(x[i], x[kHalf + i], model_.epsilon); }
  Vec3<P> vector_at(const State& x, std::size_t i) const { return {pair_at(x, i), pair_at(x, i + 1), pair_at(x, i + 2)}; }
  Vec3<P> length_at(const State& x, std::size_t i, const T& along_normal) const {
    if constexpr (O == Observer::laboratory)
      return {pair_at(x, i), pair_at(x, i + 1), P(along_normal)};
    else
      return vector_at(x, i);
  }
  static void store_pair(const Vec3<P>& v, State& x, std::size_t at) {
    for (std::size_t i = 0; i < 3; ++i) {
      x[at + i] = v[static_cast<int>(i)].ref;
      x[kHalf + at + i] = v[static_cast<int>(i)].diff;
    }
  }
  PairedTop<T> load(const State& x) const {
    PairedTop<T> top;
    ReducedContactState<P>& s = top.state;
    s.n = vector_at(x, Shape::kN), s.u = vector_at(x, Shape::kU), top.a = vector_at(x, Shape::kA);
    using real::conserved;
    T k = x[kHalf + Shape::kSpin], w3 = w3_ + x[Shape::kSpin];
    if (keeps_spin(contact_)) k = conserved(k), w3 = conserved(w3);
    s.w3 = P::apart(w3, k, model_.epsilon);
    s.v_P = length_at(x, Shape::kSlip, T(0)), s.p_O = length_at(x, Shape::kPosition, contact_.tip_radius);
    top.phase = x[Shape::kPhase], top.phase_change = x[kHalf + Shape::kPhase];
    return top;
  }

  ContactSurroundings<P> surroundings(const T& t) const { return contact_surroundings<O>(model_, R_LH_, contact_, t); }

  Model<T> model_;
  Contact<T> contact_;
  Quaternion<T> q_LH_;
  Mat3<T> R_LH_;
  T w3_;
  Contact<P> pairs_;
};

}  // namespace earthtop
