// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of the reference and the deviation of any body on a table. Attitude and momentum of the rotating motion are
/// carried by the turn D = R_rot R_ref^T = (w, epsilon y), as in deviation.hpp: L_rot = D (L_ref + epsilon P). Every formula of
/// general_contact.hpp or inertial_contact.hpp is evaluated on pairs; with the torque pair tau,
///
///   dy/dt = (w d + epsilon y x d)/2 ,  dw/dt = -epsilon^2 y.d/2 ,  d = Theta_ref^-1 P ,
///   dP/dt = (L_ref + epsilon P) x d + ((D^T - 1) tau_rot + tau_rot - tau_ref) / epsilon
///
/// In axes H of the table (laboratory) the state is
///   [0,4) q_HB   [4,7) L' = Theta_C w   [7,9) slip v_P   [9,11) tip position p_O   [11] work of friction ;
/// then w, y, P, the differences of v_P and p_O, and the work of friction on the rotating motion
/// In inertial axes N the momentum is inertial, slip and position have three components, the position is that of C, and the work is
/// left out.
#pragma once

#include <algorithm>
#include <array>

#include "drift/table/contact_integrals.hpp"
#include "drift/table/contact_pairs.hpp"
#include "earthtop/drift/deviation.hpp"
#include "earthtop/model/contact_release.hpp"
#include "earthtop/model/general_contact.hpp"
#include "earthtop/model/inertial_contact.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/state_vectors.hpp"

namespace earthtop {

template <Observer O>
struct ContactGeneralShape {
  static_assert(O != Observer::body);
  static constexpr std::size_t kLength = O == Observer::laboratory ? 2 : 3;  ///< components of slip and position
  static constexpr std::size_t kMomentum = 4, kSlip = 7, kPosition = kSlip + kLength;
  static constexpr bool kHasIntegrals = O == Observer::laboratory;
  static constexpr std::size_t kWork = kPosition + kLength;
  static constexpr std::size_t kHalf = kWork + (kHasIntegrals ? 1 : 0);
  static constexpr std::size_t kSize = 2 * kHalf;
  /// The program of these equations takes long for each order besides its products, and a slip that dies out keeps steps short.
  static constexpr double kOrderOffset = 12;
  static constexpr auto groups() {
    constexpr std::size_t kIntegrals = kHasIntegrals ? 1 : 0;  // in inertial axes their groups are empty
    return std::array<ComponentGroup, 11>{{{0, 4, 1.0},
                                           {kMomentum, 3, 1e-3},
                                           {kSlip, kLength, 1e-9},
                                           {kPosition, kLength, 1e-6},
                                           {kWork - 1 + kIntegrals, kIntegrals, 1e-9},
                                           {kHalf, 1, 1.0},
                                           {kHalf + 1, 3, 1e-5},
                                           {kHalf + kMomentum, 3, 1e-5},
                                           {kHalf + kSlip, kLength, 1e-9},
                                           {kHalf + kPosition, kLength, 1e-9},
                                           {kHalf + kWork - 1 + kIntegrals, kIntegrals, 1e-9}}};
  }
};

/// Any body in both predictions, in axes H.
template <class T>
struct PairedBody {
  Vec3<Paired<T>> n;  ///< body axis 3
  Vec3<Paired<T>> w_LB;
  Vec3<Paired<T>> v_P, p_O;
  ContactReaction<Paired<T>> reaction;
};

/// @tparam T  a number, or a scalar that records operations   @tparam O  laboratory, or inertial
template <class T, Observer O>
class ContactGeneralEquations {
 public:
  using Shape = ContactGeneralShape<O>;
  static constexpr std::size_t kSize = Shape::kSize, kHalf = Shape::kHalf;
  using State = std::array<T, kSize>;
  using P = Paired<T>;

  /// @param model  in the table's axes
  ContactGeneralEquations(const Model<T>& model, const Contact<T>& contact, const Quaternion<T>& q_LH)
      : model_(model), contact_(contact), q_LH_(q_LH), R_LH_(rotation_matrix(q_LH)), pairs_(paired(contact)) {}

  void operator()(const State& x, State& dxdt, T t) const {
    const T& epsilon = model_.epsilon;
    const Loaded s = load(x);
    const Mat3<T> I_inverse_ref = turned_tensor(s.R_ref, contact_.I_BC_B_inverse);
    const Vec3<T> d = times(I_inverse_ref, s.deviation.p);
    const Found found = rates(s, surroundings(t));

    const Vec3<T> torque_ref = part<&P::ref>(found.momentum), torque_rot = part<&P::rot>(found.momentum);
    const Vec3<T> carried = turn_back_minus_one_scaled(s.deviation.w, s.deviation.y, epsilon, torque_rot);
    const Quaternion<T> turning = attitude_rate_from_outer(s.q_ref, times(I_inverse_ref, s.momentum_ref));
    dxdt[0] = turning.w;
    store_vector(turning.v, dxdt, 1);
    store_vector(torque_ref, dxdt, Shape::kMomentum);
    dxdt[kHalf] = -epsilon * epsilon * inner(s.deviation.y, d) / T(2);
    store_vector(Vec3<T>((s.deviation.w * d + epsilon * s.deviation.y.cross(d)) / T(2)), dxdt, kHalf + 1);
    store_vector(Vec3<T>(Vec3<T>(s.momentum_ref + epsilon * s.deviation.p).cross(d) + carried + part<&P::diff>(found.momentum)),
                 dxdt, kHalf + Shape::kMomentum);
    for (std::size_t i = 0; i < Shape::kLength; ++i) {
      const int axis = static_cast<int>(i);
      dxdt[Shape::kSlip + i] = found.v_P[axis].ref, dxdt[kHalf + Shape::kSlip + i] = found.v_P[axis].diff;
      dxdt[Shape::kPosition + i] = found.position[axis].ref, dxdt[kHalf + Shape::kPosition + i] = found.position[axis].diff;
    }
    if constexpr (Shape::kHasIntegrals) {
      dxdt[Shape::kWork] = friction_power(contact_, found.reaction, s.v_P, found.w, &P::ref);
      dxdt[kHalf + Shape::kWork] = friction_power(contact_, found.reaction, s.v_P, found.w, &P::rot);
      if (contact_.air.acts()) {
        const Vec3<P> z = surroundings(t).normal, r_c = times(s.R, pairs_.p_OC_B);
        const Vec3<P> v_C = s.v_P + pairs_.tip_radius * Vec3<P>(found.w.cross(z)) + Vec3<P>(found.w.cross(r_c));
        const Vec3<P> torque = times(s.R, air_torque_B(pairs_.air, transposed_times(s.R, found.w)));
        dxdt[Shape::kWork] = dxdt[Shape::kWork] + air_power(pairs_, torque, found.w, v_C, &P::ref);
        dxdt[kHalf + Shape::kWork] = dxdt[kHalf + Shape::kWork] + air_power(pairs_, torque, found.w, v_C, &P::rot);
      }
    }
  }

  /// Both motions in the table's axes, with the table's force on them.
  PairedBody<T> body(const State& x, T t) const {
    const Loaded s = load(x);
    const Found found = rates(s, surroundings(t));
    PairedBody<T> body{s.R.col(2), found.w, s.v_P, s.position, found.reaction};
    if constexpr (O == Observer::inertial) {
      const EarthTurn<T> turn(model_, t);
      body.p_O = turn.from_inertial(Vec3<P>(s.position - times(s.R, pairs_.p_OC_B)));
      for (Vec3<P>* v : {&body.n, &body.w_LB, &body.v_P, &body.reaction.friction, &body.reaction.moment})
        *v = turn.from_inertial(*v);
    }
    return body;
  }

  /// @param rate_change_H  of the rate that the momentum is made of   @param slip_change  over epsilon, as the rate's change
  State initial_state(const Quaternion<T>& q_HB, const Vec3<T>& w_H, const Vec3<T>& rate_change_H, const Vec3<T>& slip,
                      const Vec3<T>& slip_change, const Vec3<T>& p_O) const {
    State x{};
    const Mat3<T> R_HB = rotation_matrix(q_HB), I = turned_tensor(R_HB, contact_.I_BC_B);
    x[0] = q_HB.w;
    store_vector(q_HB.v, x, 1);
    store_vector(times(I, w_H), x, Shape::kMomentum);
    x[kHalf] = T(1);
    store_vector(times(I, rate_change_H), x, kHalf + Shape::kMomentum);
    const Vec3<T> position = O == Observer::laboratory ? p_O : Vec3<T>(p_O + times(R_HB, contact_.p_OC_B));
    for (std::size_t i = 0; i < Shape::kLength; ++i) {
      const int axis = static_cast<int>(i);
      x[Shape::kSlip + i] = slip[axis], x[kHalf + Shape::kSlip + i] = slip_change[axis];
      x[Shape::kPosition + i] = position[axis];
    }
    return x;
  }
  static Quaternion<T> reference_attitude(const State& x) { return load_quaternion(x, 0); }
  static Deviation<T> deviation(const State& x) {
    return {x[kHalf], load_vector(x, kHalf + 1), load_vector(x, kHalf + Shape::kMomentum)};
  }

  const Model<T>& model() const { return model_; }
  const Contact<T>& contact() const { return contact_; }
  const Quaternion<T>& q_LH() const { return q_LH_; }

 private:
  /// Both motions in the axes of the state.
  struct Loaded {
    Quaternion<T> q_ref;
    Mat3<T> R_ref;
    Vec3<T> momentum_ref;
    Deviation<T> deviation;
    Mat3<P> R;
    Vec3<P> momentum, v_P, position;
  };
  struct Found {
    Vec3<P> w, momentum, v_P, position;
    ContactReaction<P> reaction;
  };
  template <T P::*member>
  static Vec3<T> part(const Vec3<P>& v) {
    return {v[0].*member, v[1].*member, v[2].*member};
  }
  Vec3<P> length_at(const State& x, std::size_t at, const T& along_normal) const {
    Vec3<P> v(P(T(0)), P(T(0)), P(along_normal));
    for (std::size_t i = 0; i < Shape::kLength; ++i)
      v[static_cast<int>(i)] = P::apart(x[at + i], x[kHalf + at + i], model_.epsilon);
    return v;
  }
  Loaded load(const State& x) const {
    const T& epsilon = model_.epsilon;
    Loaded s;
    s.q_ref = reference_attitude(x);
    s.R_ref = rotation_matrix(s.q_ref);
    s.momentum_ref = load_vector(x, Shape::kMomentum);
    s.deviation = deviation(x);
    const auto turned = [&](const Vec3<T>& v) { return turn_minus_one_scaled(s.deviation.w, s.deviation.y, epsilon, v); };
    for (int j = 0; j < 3; ++j) {
      const Vec3<T> column = s.R_ref.col(j);
      s.R.col(j) = pair_of(column, turned(column), epsilon);
    }
    const Vec3<T> change = s.deviation.p + turned(Vec3<T>(s.momentum_ref + epsilon * s.deviation.p));
    s.momentum = pair_of(s.momentum_ref, change, epsilon);
    s.v_P = length_at(x, Shape::kSlip, T(0)), s.position = length_at(x, Shape::kPosition, contact_.tip_radius);
    return s;
  }
  Found rates(const Loaded& s, const ContactSurroundings<P>& around) const {
    if constexpr (O == Observer::laboratory) {
      const GeneralContactRates<P> found =
          general_rates(pairs_, around, GeneralContactState<P>{s.R, s.momentum, s.v_P, s.position});
      return {found.w, found.momentum, found.v_P, found.p_O, found.reaction};
    } else {
      const InertialContactBody<P> body = inertial_body(pairs_, s.R, s.momentum);
      const Vec3<P> w_IB = times(body.I_inverse, s.momentum);
      const InertialContactRates<P> found =
          inertial_rates(pairs_, around, body, InertialContactState<P>{s.position, s.v_P, w_IB});
      return {Vec3<P>(w_IB - around.W), found.momentum, found.v_P, found.X_C, found.reaction};
    }
  }
  ContactSurroundings<P> surroundings(const T& t) const { return contact_surroundings<O>(model_, R_LH_, contact_, t); }

  Model<T> model_;
  Contact<T> contact_;
  Quaternion<T> q_LH_;
  Mat3<T> R_LH_;
  Contact<P> pairs_;
};

}  // namespace earthtop
