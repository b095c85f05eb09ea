// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a row of a top on a table besides attitudes and rates, in SI units, from the natural units of a sample.
#pragma once

#include <algorithm>
#include <vector>

#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Makes the contact part of rows. Differences of the two predictions are the pairs' own, never those of two numbers.
template <class T>
class ContactRows {
 public:
  /// @param problem  must have a table   @param events  of the integration that the rows are from, ascending in time
  ContactRows(const DriftProblem<T>& problem, const std::vector<ContactEvent>& events)
      : units_(problem.units),
        R_LH_(rotation_matrix(problem.table->start.q_LH)),
        contact_(problem.table->contact),
        events_(events) {}

  /// @param sample  must have a contact
  BasicContactRow<T> row(const DriftSample<T>& sample, T tip_bound) const {
    const ContactDriftState<T>& c = *sample.contact;
    const T epsilon = sample.state.epsilon;
    const auto on_table = [&](T Paired<T>::*member) {
      const Vec3<T> tip_H = transposed_times(R_LH_, Vec3<T>(c.tip_L[0].*member, c.tip_L[1].*member, c.tip_L[2].*member));
      return std::array<T, 2>{tip_H[0] + T(0), tip_H[1] + T(0)};
    };
    BasicContactRow<T> row;
    row.tip_m = on_table(&Paired<T>::rot), row.ref_tip_m = on_table(&Paired<T>::ref);
    row.drift_tip_xy_m = on_table(&Paired<T>::diff);
    for (T& component : row.drift_tip_xy_m) component *= epsilon;
    row.drift_tip_m = real::hypot(row.drift_tip_xy_m[0], row.drift_tip_xy_m[1]);
    row.drift_tip_bound_m = tip_bound;
    row.slip_m_s = units_.rate_to_rad_s(c.slip.rot), row.ref_slip_m_s = units_.rate_to_rad_s(c.slip.ref);
    row.drift_slip_m_s = units_.rate_to_rad_s(epsilon * c.slip.diff);
    row.drift_spin_rate_rad_s = units_.rate_to_rad_s(epsilon * c.spin.diff);
    const int newtons = units_.mass_exponent - 2 * units_.time_exponent;  // lengths are metres in both units
    row.normal_force_N = real::scale(c.reaction.normal_force.rot, newtons);
    row.ref_normal_force_N = real::scale(c.reaction.normal_force.ref, newtons);
    const bool rolls = rolls_at(Prediction::rotating, c.slip.rot, sample.state.t_s);
    const bool ref_rolls = rolls_at(Prediction::reference, c.slip.ref, sample.state.t_s);
    row.state = rolls != ref_rolls ? ContactState::mixed : rolls ? ContactState::roll : ContactState::slide;
    return row;
  }

 private:
  /// Whether a prediction's tip rolls, by the law, and by the events up to a time.
  bool rolls_at(Prediction prediction, T slip, T t_s) const {
    const bool exact = contact_.law == ContactLaw::coulomb && contact_.slip_floor == T(0);
    bool rolls = contact_.law == ContactLaw::rolling, changed = false;
    for (const ContactEvent& event : events_) {
      if (event.prediction != prediction) continue;
      if (T(event.t_s) > t_s) {
        if (!changed && event.kind == ContactEventKind::slip_stopped) return false;  // it slides until then
        break;
      }
      if (event.kind == ContactEventKind::slip_stopped) rolls = changed = true;
      if (event.kind == ContactEventKind::slip_started) rolls = false, changed = true;
    }
    return changed ? rolls : rolls || (exact && slip == T(0));
  }

  const NaturalUnits& units_;
  Mat3<T> R_LH_;
  const Contact<T>& contact_;
  const std::vector<ContactEvent>& events_;
};

template <class To, class From>
BasicContactRow<To> contact_cast(const BasicContactRow<From>& row) {
  const auto to = [](const auto& x) { return static_cast<To>(x); };
  const auto both = [&](const std::array<From, 2>& x) { return std::array<To, 2>{to(x[0]), to(x[1])}; };
  return {both(row.tip_m),          both(row.ref_tip_m),           to(row.slip_m_s),
          to(row.ref_slip_m_s),     to(row.normal_force_N),        to(row.ref_normal_force_N),
          both(row.drift_tip_xy_m), to(row.drift_tip_m),           to(row.drift_tip_bound_m),
          to(row.drift_slip_m_s),   to(row.drift_spin_rate_rad_s), row.state};
}

}  // namespace earthtop
