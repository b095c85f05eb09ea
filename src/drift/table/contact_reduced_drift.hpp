// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift integration of a symmetric top on a table, without its angle of spin.
#pragma once

#include <algorithm>

#include "drift/table/contact_attitude.hpp"
#include "drift/table/record_contact.hpp"
#include "earthtop/drift/contact_state.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// @tparam O  laboratory, or inertial, in whose axes the table turns and no Coriolis term appears
template <class T, Observer O>
class ContactReducedDrift : public WithSeries<RecordedSeries<T, ContactReducedShape<O>::kSize>> {
 public:
  using Equations = ContactReducedEquations<T, O>;
  using Shape = ContactReducedShape<O>;
  static constexpr std::size_t kSize = Shape::kSize, kHalf = Shape::kHalf;
  static constexpr bool kBoundOnly = true, kRungeKutta = std::is_same_v<T, double>;
  using State = std::array<T, kSize>;

  /// @param model  in laboratory axes   @param release  its attitude is relative to the table
  ContactReducedDrift(const Model<T>& model, const Contact<T>& contact, const ContactRelease<T>& start,
                      const NaturalRelease<T>& release)
      : release_(release),
        start_(start),
        equations_(in_table_axes(model, start.q_LH), contact, start.q_LH, release.w_XB_B[2]),
        attitude_(release.q_LB, release.w_XB_B[2]) {}

  void operator()(const State& x, State& dxdt, T t) const { equations_(x, dxdt, t); }
  RecordedSeries<T, kSize> series() const {
    return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_contact<T, O>(equations_, x, t); });
  }
  const Equations& equations() const { return equations_; }
  /// Goes on under another law, as when slip stops.
  void set_law(ContactLaw law) { equations_.set_law(law); }

  /// The state at release, where both motions have the same attitude, position, rates of the kind that the release names, and the
  /// velocity that the start names.
  State initial_state() const {
    const Mat3<T> R_HB = rotation_matrix(release_.q_LB);
    const Vec3<T> w = times(R_HB, release_.w_XB_B), n = R_HB.col(2);
    const Contact<T>& contact = equations_.contact();
    const Vec3<T> r_c = contact.height_of_center * n, W = equations_.model().W_IL_L_scaled;
    Vec3<T> rate_change = Vec3<T>::Zero(), slip_change = Vec3<T>::Zero();
    if (release_.X == RatesRelativeTo::laboratory)
      rate_change = W;
    else
      slip_change = slip_difference_at_release(start_, contact, W, r_c);
    return equations_.initial_state(R_HB, w, rate_change, slip_at_release(start_, contact, w, r_c), slip_change, start_.p_O);
  }
  /// A state with the sizes that errors are measured against from the start: u against the nutation rate, the position against the
  /// body's lengths, the change of the spin's difference against the Earth's rate, as it may be 0 but for rounding.
  State typical_state() const {
    State x = initial_state();
    const Contact<T>& contact = equations_.contact();
    const T spin = real::abs(equations_.w3()), rate = (contact.I3 / contact.I1) * spin;
    const T length = std::max(contact.tip_radius, real::abs(contact.height_of_center));
    x[Shape::kU] = std::max(norm(load_vector(x, Shape::kU)), rate);
    x[Shape::kSpin] = spin;
    x[Shape::kHalf + Shape::kSpin] = norm(equations_.model().W_IL_L_scaled);
    x[Shape::kPosition] = std::max(real::hypot(x[Shape::kPosition], x[Shape::kPosition + 1]), length);
    if constexpr (Shape::kHasIntegrals) {
      const T momentum = contact.I3 * spin + contact.I1 * x[Shape::kU];
      x[Shape::kWork] = x[kHalf + Shape::kWork] =
          momentum * (spin + rate) / T(2) + contact.mass * norm(equations_.model().apparent_gravity_L) * length;
      x[Shape::kJellett] = x[kHalf + Shape::kJellett] = momentum * length;
    }
    return x;
  }

  /// The longest time between two states that are seen; 0: no limit.
  T largest_step() const { return T(0); }
  void follow(const State& x, T t) { attitude_.follow(equations_.top(x, t), equations_.model().epsilon); }

  /// The variables that all observers share.
  DriftState<T> shared_state(const State& x, T t) const {
    const PairedTop<T> top = equations_.top(x, t);
    const T epsilon = equations_.model().epsilon;
    const Quaternion<T> q_HB = attitude_.body(top, t);
    DriftState<T> s = measured(top, equations_.q_LH() * q_HB, q_HB.conjugate() * attitude_.frame(top));
    const Mat3<T> R_HB = rotation_matrix(q_HB);
    s.ref_w_LB_B = transposed_times(R_HB, rate<&Paired<T>::ref>(top));
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, epsilon * s.e_v_scaled}.normalized();
    const Mat3<T> R_HB_rotating = rotation_matrix(equations_.q_LH().conjugate() * s.q_LB);
    s.w_LB_B = transposed_times(R_HB_rotating, Vec3<T>(rate<&Paired<T>::rot>(top) - equations_.model().W_IL_L));
    return s;
  }
  /// The part of the shared state that the drift is measured from; the turn about axis 3 that both bodies share is left out.
  DriftState<T> deviation_state(const State& x, T t) const {
    const PairedTop<T> top = equations_.top(x, t);
    return measured(top, equations_.q_LH() * attitude_.frame(top), Quaternion<T>());
  }
  /// The table's own quantities are computed here.
  ContactDriftState<T> contact_state(const State& x, T t) const {
    using P = Paired<T>;
    const PairedTop<T> top = equations_.top(x, t);
    const ReducedContactState<P>& s = top.state;
    const Model<T>& model = equations_.model();
    const Mat3<T> R_LH = rotation_matrix(equations_.q_LH());
    const auto in_L = [&](const Vec3<P>& v) { return mixed_times(R_LH, v); };
    ContactDriftState<T> row;
    row.axis_L = in_L(s.n);
    row.tip_L = in_L(Vec3<P>(s.p_O[0], s.p_O[1], P(T(0))));
    row.slip_L = in_L(s.v_P);
    row.slip = real::sqrt(inner(s.v_P, s.v_P));
    row.spin = s.w3;
    const Vec3<P> W = pair_of(Vec3<T>(Vec3<T>::Zero()), model.W_IL_L_scaled, model.epsilon);
    row.relative_spin = s.w3 - inner(s.n, W);
    row.turning = s.u[2] + s.w3 * s.n[2] - W[2];
    const ContactReaction<P> reaction = equations_.reaction(x, t);
    row.reaction = {reaction.normal_force, reaction.denominator, in_L(reaction.friction), in_L(reaction.moment)};
    if constexpr (Shape::kHasIntegrals)
      row.integrals = {{{x[Shape::kWork], x[Shape::kJellett]}, {x[kHalf + Shape::kWork], x[kHalf + Shape::kJellett]}}};
    return row;
  }

 private:
  template <T Paired<T>::*member>
  static Vec3<T> rate(const PairedTop<T>& top) {
    const Vec3<Paired<T>> w = top.state.u + top.state.w3 * top.state.n;
    return {w[0].*member, w[1].*member, w[2].*member};
  }
  /// @param back  takes the axes of the reference's frame to those that its attitude is given for
  DriftState<T> measured(const PairedTop<T>& top, const Quaternion<T>& ref_q_LB, const Quaternion<T>& back) const {
    DriftState<T> s;
    s.epsilon = equations_.model().epsilon;
    s.ref_q_LB = ref_q_LB;
    const ScaledQuaternion<T> e = attitude_.deviation(top, s.epsilon);
    s.e_w = e.w;
    s.e_v_scaled = times(rotation_matrix(back), e.y);
    return s;
  }

  NaturalRelease<T> release_;
  ContactRelease<T> start_;
  Equations equations_;
  ContactAttitude<T> attitude_;  ///< relative to the table
};

}  // namespace earthtop
