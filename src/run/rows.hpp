// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts a sample of an integration to a row of results in the scalar of the run, and rows from one scalar to another.
#pragma once

#include "drift/row_quantities.hpp"
#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/laboratory_now.hpp"
#include "earthtop/scenario/support.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/cage_rows.hpp"
#include "run/contact_rows.hpp"
#include "run/drift_bound.hpp"
#include "run/rotor_rows.hpp"

namespace earthtop {

/// Makers of what only some tops have.
template <class T>
struct RowParts {
  std::optional<ContactRows<T>> table;
  std::optional<CageRows<T>> cage;
  std::optional<Model<T>> travelling = {};  ///< of a laboratory on a journey, in seconds

  explicit RowParts(std::optional<ContactRows<T>> rows_on_table) : table(std::move(rows_on_table)) {}
  RowParts(const Scene& scene, const std::vector<ContactEvent>& events) {
    if (scene.support().has_contact) table.emplace(scene.problem_without_rows<T>(), events);
    if (is_caged_top(scene.scenario())) cage.emplace(scene.scenario());
    if (scene.scenario().travel) travelling = scene.model<T>();
  }
};

template <class T>
BasicDriftRow<T> make_row(const DriftSample<T>& sample, const DriftBound<T>& bound, const RowParts<T>& parts) {
  const DriftState<T>& s = sample.state;
  const DriftMeasures<T>& m = sample.measures;
  BasicDriftRow<T> row;
  row.t_s = s.t_s;
  const Quaternion<T> q_LB = s.q_LB.normalized(), ref_q_LB = s.ref_q_LB.normalized();
  row.q_LB = to_array(q_LB);
  row.w_LB_B = to_array(s.w_LB_B);
  row.ref_q_LB = to_array(ref_q_LB);
  row.ref_w_LB_B = to_array(s.ref_w_LB_B);
  row.axis_L = to_array(Vec3<T>(rotation_matrix(q_LB).col(2)));
  row.ref_axis_L = to_array(Vec3<T>(rotation_matrix(ref_q_LB).col(2)));
  row.drift_axis_rad = m.axis;
  row.drift_axis_bound_rad = bound.axis();
  if (m.azimuth_defined) row.drift_azimuth_rad = sample.azimuth;
  row.drift_tilt_rad = m.tilt;
  row.drift_attitude_rad = m.attitude;
  row.drift_attitude_bound_rad = bound.attitude();
  row.drift_spin_rad = sample.spin;
  if (parts.table) row.contact = parts.table->row(sample, bound.tip());
  if (parts.cage) parts.cage->complete(row);
  if (sample.rotor) add_rotor_row(s, *sample.rotor, bound, row);
  if (sample.gimbals) add_gimbal_row(s, *sample.gimbals, bound, row);
  if (parts.travelling) {
    const JourneyPlace<T> place = parts.travelling->journey.place(s.t_s);
    const LaboratoryNow<T> now(*parts.travelling, s.t_s);
    row.journey = {place.latitude_deg, place.longitude_deg,  place.height_m,       place.course_deg,
                   place.speed_m_s,    to_array(now.w_IL_L), to_array(now.field_L)};
  }
  return row;
}

template <class To, class From>
void cast_to(To& to, const From& from) {
  to = static_cast<To>(from);
}
template <class To, class From>
void cast_to(std::optional<To>& to, const std::optional<From>& from) {
  if (from) to = static_cast<To>(*from);
}
template <class To, class From, std::size_t n>
void cast_to(std::array<To, n>& to, const std::array<From, n>& from) {
  for (std::size_t i = 0; i < n; ++i) to[i] = static_cast<To>(from[i]);
}

template <class To, class From>
BasicDriftRow<To> row_cast(const BasicDriftRow<From>& row) {
  BasicDriftRow<To> cast;
  cast_to(cast.t_s, row.t_s);
  for_each_drift_quantity([&](auto member, const RowQuantity&) { cast_to(member(cast), member(row)); });
  if (row.contact) cast.contact = contact_cast<To>(*row.contact);
  if (row.rotor) {
    BasicRotorRow<To>& made = cast.rotor.emplace();
    for_each_rotor_quantity([&](auto member, const RowQuantity&) { cast_to(member(made), member(*row.rotor)); });
  }
  if (row.gimbals) {
    BasicGimbalRow<To>& made = cast.gimbals.emplace();
    for_each_gimbal_quantity([&](auto member, const RowQuantity&) { cast_to(member(made), member(*row.gimbals)); });
    made.headline = row.gimbals->headline;
  }
  if (row.journey) {
    BasicJourneyRow<To>& made = cast.journey.emplace();
    for_each_journey_quantity([&](auto member, const RowQuantity&) { cast_to(member(made), member(*row.journey)); });
  }
  return cast;
}

}  // namespace earthtop
