// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift integration of any body on a table.
#pragma once

#include <algorithm>

#include "drift/deviation_state.hpp"
#include "drift/table/contact_general_equations.hpp"
#include "drift/table/record_contact.hpp"
#include "earthtop/drift/contact_state.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// @tparam O  laboratory, or inertial, in whose axes the table turns and no Coriolis term appears
template <class T, Observer O>
class ContactGeneralDrift : public WithSeries<RecordedSeries<T, ContactGeneralShape<O>::kSize>> {
 public:
  using Equations = ContactGeneralEquations<T, O>;
  using Shape = ContactGeneralShape<O>;
  static constexpr std::size_t kSize = Shape::kSize;
  static constexpr bool kBoundOnly = true, kRungeKutta = std::is_same_v<T, double>;
  using State = std::array<T, kSize>;

  /// @param model  in laboratory axes   @param release  its attitude is relative to the table
  ContactGeneralDrift(const Model<T>& model, const Contact<T>& contact, const ContactRelease<T>& start,
                      const NaturalRelease<T>& release)
      : release_(release), start_(start), equations_(in_table_axes(model, start.q_LH), contact, start.q_LH) {}

  void operator()(const State& x, State& dxdt, T t) const { equations_(x, dxdt, t); }
  RecordedSeries<T, kSize> series() const {
    return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_contact<T, O>(equations_, x, t); });
  }
  const Equations& equations() const { return equations_; }

  /// The state at release, where both motions have the same attitude, position, rates of the kind that the release names, and the
  /// velocity that the start names.
  State initial_state() const {
    const Mat3<T> R_HB = rotation_matrix(release_.q_LB);
    const Vec3<T> w = times(R_HB, release_.w_XB_B);
    const Contact<T>& contact = equations_.contact();
    const Vec3<T> r_c = times(R_HB, contact.p_OC_B), W = equations_.model().W_IL_L_scaled;
    Vec3<T> rate_change = Vec3<T>::Zero(), slip_change = Vec3<T>::Zero();
    if (release_.X == RatesRelativeTo::laboratory) {
      if constexpr (O == Observer::inertial) rate_change = W;
    } else {
      if constexpr (O == Observer::laboratory) rate_change = -W;
      slip_change = slip_difference_at_release(start_, contact, W, r_c);
    }
    return equations_.initial_state(release_.q_LB, w, rate_change, slip_at_release(start_, contact, w, r_c), slip_change,
                                    start_.p_O);
  }
  /// A state with the sizes that errors are measured against from the start: the position against the body's lengths.
  State typical_state() const {
    State x = initial_state();
    const Contact<T>& contact = equations_.contact();
    const T length = std::max(contact.tip_radius, norm(contact.p_OC_B));
    x[Shape::kPosition] = std::max(real::hypot(x[Shape::kPosition], x[Shape::kPosition + 1]), length);
    if constexpr (Shape::kHasIntegrals)
      x[Shape::kWork] = x[Shape::kHalf + Shape::kWork] = norm(load_vector(x, Shape::kMomentum)) * norm(release_.w_XB_B) / T(2) +
                                                         contact.mass * norm(equations_.model().apparent_gravity_L) * length;
    return x;
  }

  void follow(const State&) {}

  /// The variables that all observers share.
  DriftState<T> shared_state(const State& x, T t) const {
    const Model<T>& model = equations_.model();
    const T epsilon = model.epsilon;
    const Quaternion<T> ref_q_HB = Equations::reference_attitude(x).normalized();
    DriftState<T> s = seen_from_laboratory<O>(model, ref_q_HB, Equations::deviation(x), t);
    s.ref_q_LB = equations_.q_LH() * ref_q_HB;
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, epsilon * s.e_v_scaled}.normalized();
    const PairedBody<T> body = equations_.body(x, t);
    const auto rate = [&](T Paired<T>::*member, const Quaternion<T>& q_LB) {
      const Vec3<T> w_H(body.w_LB[0].*member, body.w_LB[1].*member, body.w_LB[2].*member);
      return transposed_times(rotation_matrix(equations_.q_LH().conjugate() * q_LB), w_H);
    };
    s.ref_w_LB_B = rate(&Paired<T>::ref, s.ref_q_LB), s.w_LB_B = rate(&Paired<T>::rot, s.q_LB);
    return s;
  }
  DriftState<T> deviation_state(const State& x, T t) const {
    const Quaternion<T> ref_q_HB = Equations::reference_attitude(x);
    DriftState<T> s = seen_from_laboratory<O>(equations_.model(), ref_q_HB, Equations::deviation(x), t);
    s.ref_q_LB = equations_.q_LH() * ref_q_HB;
    return s;
  }
  /// The table's own quantities are computed here.
  ContactDriftState<T> contact_state(const State& x, T t) const {
    using P = Paired<T>;
    const PairedBody<T> body = equations_.body(x, t);
    const Model<T>& model = equations_.model();
    const Mat3<T> R_LH = rotation_matrix(equations_.q_LH());
    const auto in_L = [&](const Vec3<P>& v) { return mixed_times(R_LH, v); };
    ContactDriftState<T> row;
    row.axis_L = in_L(body.n);
    row.tip_L = in_L(Vec3<P>(body.p_O[0], body.p_O[1], P(T(0))));
    row.slip_L = in_L(body.v_P);
    row.slip = real::sqrt(inner(body.v_P, body.v_P));
    row.turning = body.w_LB[2];
    row.relative_spin = inner(body.w_LB, body.n);
    row.spin = row.relative_spin + inner(body.n, pair_of(Vec3<T>(Vec3<T>::Zero()), model.W_IL_L_scaled, model.epsilon));
    row.reaction = {body.reaction.normal_force, body.reaction.denominator, in_L(body.reaction.friction),
                    in_L(body.reaction.moment)};
    if constexpr (Shape::kHasIntegrals)
      row.integrals = {{{x[Shape::kWork], std::nullopt}, {x[Shape::kHalf + Shape::kWork], std::nullopt}}};
    return row;
  }

 private:
  NaturalRelease<T> release_;
  ContactRelease<T> start_;
  Equations equations_;
};

}  // namespace earthtop
