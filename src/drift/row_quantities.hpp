// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of the quantities of a result row. Each entry states the names of the quantity's columns, where its numbers are in
/// a row, and how two rows are compared in it. All code that writes, reads, names or compares rows uses such a table. The table
/// of trajectory.csv is in this file, in a layer below the scenario, because a scenario's headline and criteria name its
/// columns; the table of torques.csv is in results/columns.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "earthtop/drift/drift.hpp"

namespace earthtop {

/// The kinds of quantities. Messages list the names of vectors in this order.
enum class MeasureKind {
  number,
  angle,      ///< a number modulo 2 pi
  flag,       ///< 0 or 1
  attitude,   ///< quaternion, w first, of either sign: two differ by the angle of the turn from one to the other
  vector,     ///< three components: two differ by the length of the difference
  direction,  ///< three components of a unit vector: two differ by the angle between them
  place,      ///< two horizontal components: two differ by the length of the difference
  word,       ///< one of several words, which are equal or not; as a number its place among them, starting at 0
};

/// The error bound that holds for a quantity.
enum class BoundKind {
  none,
  drift_axis,      ///< drift_axis_bound_rad of the row
  drift_tilt,      ///< the same, plus the effect of an error of both axes on the drift's direction
  drift_azimuth,   ///< the bound of drift_tilt divided by the sine of the tilt
  drift_attitude,  ///< drift_attitude_bound_rad of the row
  drift_rates,     ///< the same, times the motion's fastest rate
  drift_tip,       ///< drift_tip_bound_m of the row
  attitude,        ///< attitude_bound_rad of the summary
  rates            ///< attitude_bound_rad of the summary, times the motion's fastest rate
};

/// The parts of a row, to one of which each quantity belongs. A comparison lists its measures in this order.
enum class RowPart {
  rotating,   ///< the motion on the rotating Earth
  reference,  ///< the non-rotating prediction
  drift,      ///< the difference of the two
  torque,     ///< a torque of the ledger
  error       ///< an error bound, or whether the drift is reliable
};

/// The runs that have a quantity.
enum class RowOwner {
  every_top,
  contact,  ///< those of a top on a table
  rotor,    ///< those of a body with a rotor
  gimbals,  ///< those of a Cardan suspension
  journey   ///< those of a laboratory that travels
};
/// The name of an owner: the key of a summary that has its part.
constexpr std::string_view name_of(RowOwner owner) {
  switch (owner) {
    case RowOwner::every_top: break;
    case RowOwner::contact: return "contact";
    case RowOwner::rotor: return "rotor";
    case RowOwner::gimbals: return "gimbals";
    case RowOwner::journey: return "travel";
  }
  return "";
}
/// Whether a row has the quantities of an owner.
template <class T>
constexpr bool has_part(const BasicDriftRow<T>& row, RowOwner owner) {
  switch (owner) {
    case RowOwner::every_top: break;
    case RowOwner::contact: return row.contact.has_value();
    case RowOwner::rotor: return row.rotor.has_value();
    case RowOwner::gimbals: return row.gimbals.has_value();
    case RowOwner::journey: return row.journey.has_value();
  }
  return true;
}

/// One quantity of a row: a number, or several that belong together.
struct RowQuantity {
  std::string_view stem;     ///< the beginning of its columns' names, before the component: "w_LB_B" of w_LB_B_x_rad_s
  std::string_view unit;     ///< the end of its columns' names, after the component: "_rad_s"; empty for a pure number
  std::string_view meaning;  ///< what it is, with frames and axes, for people
  MeasureKind kind;
  RowPart part;
  std::string_view measure;           ///< name, with its unit, of the difference of two rows in this quantity
  BoundKind bound = BoundKind::none;  ///< the error bound that applies to that difference
  std::string_view effect = "";       ///< the measure whose largest value is the Earth's effect on this quantity
  std::string_view words = "";        ///< of a word: those it may be, separated by '|', in the order of their numbers
  RowOwner owner = RowOwner::every_top;

  /// The letters of its components; empty for a single number.
  constexpr std::string_view components() const {
    if (kind == MeasureKind::attitude) return "wxyz";
    if (kind == MeasureKind::place) return "xy";
    return kind == MeasureKind::vector || kind == MeasureKind::direction ? "xyz" : "";
  }
  constexpr std::size_t width() const { return components().empty() ? 1 : components().size(); }

  /// Passes the name of a column to `add` piece by piece, so that names can be joined at compile time.
  /// @param add  is called with each piece (a string_view)
  template <class Add>
  constexpr void spell_column(std::size_t component, const Add& add) const {
    add(stem);
    if (!components().empty()) add("_"), add(components().substr(component, 1));
    add(unit);
  }
  std::string column(std::size_t component) const {
    std::string name;
    spell_column(component, [&](std::string_view piece) { name += piece; });
    return name;
  }
  /// Whether this is the name of the whole quantity: "w_LB_B_rad_s".
  constexpr bool is_called(std::string_view name) const {
    return name.size() == stem.size() + unit.size() && name.starts_with(stem) && name.ends_with(unit);
  }
};

/// The word with a number, of a quantity that is a word; empty where there is none.
constexpr std::string_view word_of(const RowQuantity& quantity, std::size_t number) {
  std::string_view rest = quantity.words;
  for (; number > 0 && !rest.empty(); --number) rest.remove_prefix(std::min(rest.find('|'), rest.size() - 1) + 1);
  return rest.substr(0, rest.find('|'));
}

/// A quantity with functions that read its numbers from a row of doubles and from a row of extended precision.
template <class Row, class ExtendedRow>
struct ValuedQuantity : RowQuantity {
  std::optional<double> (*value)(const Row&, std::size_t component);  ///< none where the row has none
  std::optional<float128> (*extended_value)(const ExtendedRow&, std::size_t component);
};

namespace row_quantities_detail {

template <class T, std::size_t n>
constexpr std::optional<T> component_of(const std::array<T, n>& vector, std::size_t component) {
  return vector[component];
}
template <class T>
constexpr std::optional<T> component_of(const std::optional<T>& number, std::size_t) {
  return number;
}
template <class T>
constexpr std::optional<T> component_of(const T& number, std::size_t) {
  return number;
}
constexpr std::optional<double> component_of(ContactState state, std::size_t) { return static_cast<double>(state); }

}  // namespace row_quantities_detail

/// Makes a table entry. @param Member  function that takes a row of any scalar and gives the quantity's number, numbers or flag
template <class Row, class ExtendedRow, class Member>
constexpr ValuedQuantity<Row, ExtendedRow> valued(const RowQuantity& quantity, Member) {
  return {quantity,
          [](const Row& row, std::size_t component) -> std::optional<double> {
            return row_quantities_detail::component_of(Member{}(row), component);
          },
          [](const ExtendedRow& row, std::size_t component) -> std::optional<float128> {
            return row_quantities_detail::component_of(Member{}(row), component);
          }};
}

/// The quantities of trajectory.csv after the time that every run has, in the file's order.
/// @param visit  is called for each quantity with two arguments: a function that takes a row of any scalar and gives the
/// quantity's number, numbers or flag, and the RowQuantity itself
template <class Visit>
constexpr void for_each_drift_quantity(const Visit& visit) {
  using enum MeasureKind;
  using enum RowPart;
  using Bound = BoundKind;
  using Q = RowQuantity;
  visit(
      [](auto& r) -> auto& { return r.q_LB; },
      Q{"q_LB", "", "attitude of the body in the laboratory on the rotating Earth, quaternion (w, x, y, z)", attitude, rotating,
        "attitude_rad", Bound::attitude, "drift_attitude_rad"});
  visit(
      [](auto& r) -> auto& { return r.w_LB_B; },
      Q{"w_LB_B", "_rad_s", "rate of the body relative to the laboratory on the rotating Earth, in body axes", vector, rotating,
        "rates_rad_s", Bound::rates, "rates_rad_s"});
  visit(
      [](auto& r) -> auto& { return r.ref_q_LB; },
      Q{"ref_q_LB", "", "attitude of the non-rotating prediction, quaternion (w, x, y, z)", attitude, reference,
        "ref_attitude_rad", Bound::attitude, "drift_attitude_rad"});
  visit(
      [](auto& r) -> auto& { return r.ref_w_LB_B; },
      Q{"ref_w_LB_B", "_rad_s", "rate of the non-rotating prediction, in body axes", vector, reference, "ref_rates_rad_s",
        Bound::rates, "rates_rad_s"});
  visit(
      [](auto& r) -> auto& { return r.axis_L; },
      Q{"axis_L", "", "body axis 3 on the rotating Earth: East, North, Up", direction, rotating, "axis_rad", Bound::attitude,
        "drift_axis_rad"});
  visit(
      [](auto& r) -> auto& { return r.ref_axis_L; },
      Q{"ref_axis_L", "", "body axis 3 of the non-rotating prediction: East, North, Up", direction, reference, "ref_axis_rad",
        Bound::attitude, "drift_axis_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_axis_rad; },
      Q{"drift_axis", "_rad", "angle between the two spin axes", number, drift, "drift_axis_rad", Bound::drift_axis,
        "drift_axis_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_axis_bound_rad; },
      Q{"drift_axis_bound", "_rad", "bound on the error of drift_axis_rad", number, error, "drift_axis_bound_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_azimuth_rad; },
      Q{"drift_azimuth", "_rad",
        "compass azimuth, rotating minus prediction: clockwise from above is positive; continuous; absent where an axis is "
        "vertical",
        angle, drift, "drift_azimuth_rad", Bound::drift_azimuth, "drift_azimuth_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_tilt_rad; },
      Q{"drift_tilt", "_rad", "angle of the axis from the vertical, rotating minus prediction", number, drift, "drift_tilt_rad",
        Bound::drift_tilt, "drift_axis_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_attitude_rad; },
      Q{"drift_attitude", "_rad", "angle of the whole rotation between the two attitudes, 0 to pi", number, drift,
        "drift_attitude_rad", Bound::drift_attitude, "drift_attitude_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_attitude_bound_rad; },
      Q{"drift_attitude_bound", "_rad", "bound on the error of drift_attitude_rad", number, error, "drift_attitude_bound_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_spin_rad; },
      Q{"drift_spin", "_rad", "spin phase, rotating minus prediction; continuous", angle, drift, "drift_spin_rad",
        Bound::drift_attitude, "drift_attitude_rad"});
  visit(
      [](auto& r) -> auto& { return r.drift_reliable; },
      Q{"drift_reliable", "", "whether the run's verdict trusts the drift at this time", flag, error, "drift_reliable"});
}

/// The quantities that follow them in the runs of a top on a table.
/// @param visit  the same, but its function takes the part of a row on the contact (BasicContactRow of any scalar)
template <class Visit>
constexpr void for_each_contact_quantity(const Visit& visit) {
  using enum MeasureKind;
  using enum RowPart;
  using Bound = BoundKind;
  const auto visit_one = [&](auto member, RowQuantity quantity) {
    quantity.owner = RowOwner::contact;
    visit(member, quantity);
  };
  using Q = RowQuantity;
  visit_one(
      [](auto& c) -> auto& { return c.tip_m; },
      Q{"tip_L", "_m",
        "contact point on the table, on the rotating Earth: East and North, or on a tilted table its axes 1 and 2", place,
        rotating, "tip_m", Bound::none, "drift_tip_m"});
  visit_one(
      [](auto& c) -> auto& { return c.ref_tip_m; },
      Q{"ref_tip_L", "_m", "contact point of the non-rotating prediction, in the same axes", place, reference, "ref_tip_m",
        Bound::none, "drift_tip_m"});
  visit_one(
      [](auto& c) -> auto& { return c.slip_m_s; },
      Q{"slip", "_m_s", "speed of the tip over the table where it touches, on the rotating Earth", number, rotating, "slip_m_s",
        Bound::none, "drift_slip_m_s"});
  visit_one(
      [](auto& c) -> auto& { return c.ref_slip_m_s; },
      Q{"ref_slip", "_m_s", "speed of the tip over the table in the non-rotating prediction", number, reference, "ref_slip_m_s",
        Bound::none, "drift_slip_m_s"});
  visit_one(
      [](auto& c) -> auto& { return c.normal_force_N; },
      Q{"normal_force", "_N", "force of the table on the tip along the table's normal, on the rotating Earth", number, rotating,
        "normal_force_N"});
  visit_one(
      [](auto& c) -> auto& { return c.ref_normal_force_N; },
      Q{"ref_normal_force", "_N", "force of the table on the tip along its normal in the non-rotating prediction", number,
        reference, "ref_normal_force_N"});
  // The components are quantities of their own, because the vector's name would be that of its length.
  visit_one(
      [](auto& c) -> auto& { return c.drift_tip_xy_m[0]; },
      Q{"drift_tip_x", "_m", "contact point, rotating minus prediction: to East, or along axis 1 of a tilted table", number,
        drift, "drift_tip_x_m", Bound::drift_tip, "drift_tip_m"});
  visit_one(
      [](auto& c) -> auto& { return c.drift_tip_xy_m[1]; },
      Q{"drift_tip_y", "_m", "contact point, rotating minus prediction: to North, or along axis 2 of a tilted table", number,
        drift, "drift_tip_y_m", Bound::drift_tip, "drift_tip_m"});
  visit_one(
      [](auto& c) -> auto& { return c.drift_tip_m; },
      Q{"drift_tip", "_m", "distance of the two contact points", number, drift, "drift_tip_m", Bound::drift_tip,
        "drift_tip_m"});
  visit_one(
      [](auto& c) -> auto& { return c.drift_tip_bound_m; },
      Q{"drift_tip_bound", "_m", "bound on the error of drift_tip_m", number, error, "drift_tip_bound_m"});
  visit_one(
      [](auto& c) -> auto& { return c.drift_slip_m_s; },
      Q{"drift_slip", "_m_s", "slip speed, rotating minus prediction", number, drift, "drift_slip_m_s", Bound::none,
        "drift_slip_m_s"});
  visit_one(
      [](auto& c) -> auto& { return c.drift_spin_rate_rad_s; },
      Q{"drift_spin_rate", "_rad_s", "inertial rate about body axis 3, rotating minus prediction", number, drift,
        "drift_spin_rate_rad_s", Bound::none, "drift_spin_rate_rad_s"});
  visit_one(
      [](auto& c) -> auto& { return c.state; },
      Q{"contact_state", "", "whether the tips slide or roll; mixed where only one of them slides", word, rotating,
        "contact_state", Bound::none, "", "slide|roll|mixed"});
}

/// The quantities that follow in the runs of a gyrostat.
/// @param visit  the same, but its function takes the part of a row on the rotor (BasicRotorRow of any scalar)
template <class Visit>
constexpr void for_each_rotor_quantity(const Visit& visit) {
  using enum MeasureKind;
  using enum RowPart;
  using Bound = BoundKind;
  const auto visit_one = [&](auto member, RowQuantity quantity) {
    quantity.owner = RowOwner::rotor;
    visit(member, quantity);
  };
  using Q = RowQuantity;
  visit_one(
      [](auto& r) -> auto& { return r.rate_rad_s; },
      Q{"rotor_rate", "_rad_s", "rate of the rotor relative to the body, on the rotating Earth", number, rotating,
        "rotor_rate_rad_s", Bound::none, "drift_rotor_rate_rad_s"});
  visit_one(
      [](auto& r) -> auto& { return r.angle_rad; },
      Q{"rotor_angle", "_rad", "angle through which the rotor has turned in the body since the release, on the rotating Earth",
        number, rotating, "rotor_angle_rad", Bound::none, "drift_rotor_angle_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.axis_L; },
      Q{"rotor_axis_L", "", "axis of the rotor on the rotating Earth: East, North, Up", direction, rotating, "rotor_axis_rad",
        Bound::attitude, "drift_rotor_axis_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.ref_rate_rad_s; },
      Q{"ref_rotor_rate", "_rad_s", "rate of the rotor relative to the body in the non-rotating prediction", number, reference,
        "ref_rotor_rate_rad_s", Bound::none, "drift_rotor_rate_rad_s"});
  visit_one(
      [](auto& r) -> auto& { return r.ref_angle_rad; },
      Q{"ref_rotor_angle", "_rad", "angle of the rotor in the body in the non-rotating prediction", number, reference,
        "ref_rotor_angle_rad", Bound::none, "drift_rotor_angle_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.ref_axis_L; },
      Q{"ref_rotor_axis_L", "", "axis of the rotor in the non-rotating prediction: East, North, Up", direction, reference,
        "ref_rotor_axis_rad", Bound::attitude, "drift_rotor_axis_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.drift_rate_rad_s; },
      Q{"drift_rotor_rate", "_rad_s", "rate of the rotor relative to the body, rotating minus prediction", number, drift,
        "drift_rotor_rate_rad_s", Bound::drift_rates, "drift_rotor_rate_rad_s"});
  visit_one(
      [](auto& r) -> auto& { return r.drift_angle_rad; },
      Q{"drift_rotor_angle", "_rad", "angle of the rotor in the body, rotating minus prediction; continuous", number, drift,
        "drift_rotor_angle_rad", Bound::drift_attitude, "drift_rotor_angle_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.drift_axis_rad; },
      Q{"drift_rotor_axis", "_rad", "angle between the rotor's two axes", number, drift, "drift_rotor_axis_rad",
        Bound::drift_attitude, "drift_rotor_axis_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.drift_axis_bound_rad; },
      Q{"drift_rotor_axis_bound", "_rad", "bound on the error of drift_rotor_axis_rad", number, error,
        "drift_rotor_axis_bound_rad"});
  visit_one(
      [](auto& r) -> auto& { return r.drift_rate_bound_rad_s; },
      Q{"drift_rotor_rate_bound", "_rad_s", "bound on the error of drift_rotor_rate_rad_s", number, error,
        "drift_rotor_rate_bound_rad_s"});
  visit_one(
      [](auto& r) -> auto& { return r.drift_angle_bound_rad; },
      Q{"drift_rotor_angle_bound", "_rad", "bound on the error of drift_rotor_angle_rad", number, error,
        "drift_rotor_angle_bound_rad"});
}

/// The quantities that follow in the runs of a Cardan suspension.
/// @param visit  the same, but its function takes the part of a row on the gimbals (BasicGimbalRow of any scalar)
template <class Visit>
constexpr void for_each_gimbal_quantity(const Visit& visit) {
  using enum MeasureKind;
  using enum RowPart;
  using Bound = BoundKind;
  const auto visit_one = [&](auto member, RowQuantity quantity) {
    quantity.owner = RowOwner::gimbals;
    visit(member, quantity);
  };
  using Q = RowQuantity;
  visit_one(
      [](auto& g) -> auto& { return g.outer_angle_rad; },
      Q{"outer_angle", "_rad", "angle of the outer gimbal on the rotating Earth; continuous", angle, rotating,
        "outer_angle_rad", Bound::attitude, "drift_outer_angle_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.inner_angle_rad; },
      Q{"inner_angle", "_rad", "angle of the body in the outer gimbal on the rotating Earth; continuous", angle, rotating,
        "inner_angle_rad", Bound::attitude, "drift_inner_angle_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.outer_rate_rad_s; },
      Q{"outer_rate", "_rad_s", "rate of the outer angle on the rotating Earth", number, rotating, "outer_rate_rad_s",
        Bound::rates, "drift_outer_rate_rad_s"});
  visit_one(
      [](auto& g) -> auto& { return g.inner_rate_rad_s; },
      Q{"inner_rate", "_rad_s", "rate of the inner angle on the rotating Earth", number, rotating, "inner_rate_rad_s",
        Bound::rates, "drift_inner_rate_rad_s"});
  visit_one(
      [](auto& g) -> auto& { return g.ref_outer_angle_rad; },
      Q{"ref_outer_angle", "_rad", "angle of the outer gimbal in the non-rotating prediction", angle, reference,
        "ref_outer_angle_rad", Bound::attitude, "drift_outer_angle_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.ref_inner_angle_rad; },
      Q{"ref_inner_angle", "_rad", "angle of the body in the outer gimbal in the non-rotating prediction", angle, reference,
        "ref_inner_angle_rad", Bound::attitude, "drift_inner_angle_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.ref_outer_rate_rad_s; },
      Q{"ref_outer_rate", "_rad_s", "rate of the outer angle in the non-rotating prediction", number, reference,
        "ref_outer_rate_rad_s", Bound::rates, "drift_outer_rate_rad_s"});
  visit_one(
      [](auto& g) -> auto& { return g.ref_inner_rate_rad_s; },
      Q{"ref_inner_rate", "_rad_s", "rate of the inner angle in the non-rotating prediction", number, reference,
        "ref_inner_rate_rad_s", Bound::rates, "drift_inner_rate_rad_s"});
  visit_one(
      [](auto& g) -> auto& { return g.drift_outer_angle_rad; },
      Q{"drift_outer_angle", "_rad", "angle of the outer gimbal, rotating minus prediction; continuous", number, drift,
        "drift_outer_angle_rad", Bound::drift_attitude, "drift_outer_angle_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.drift_inner_angle_rad; },
      Q{"drift_inner_angle", "_rad", "angle of the body in the outer gimbal, rotating minus prediction; continuous", number,
        drift, "drift_inner_angle_rad", Bound::drift_attitude, "drift_inner_angle_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.drift_outer_rate_rad_s; },
      Q{"drift_outer_rate", "_rad_s", "rate of the outer angle, rotating minus prediction", number, drift,
        "drift_outer_rate_rad_s", Bound::drift_rates, "drift_outer_rate_rad_s"});
  visit_one(
      [](auto& g) -> auto& { return g.drift_inner_rate_rad_s; },
      Q{"drift_inner_rate", "_rad_s", "rate of the inner angle, rotating minus prediction", number, drift,
        "drift_inner_rate_rad_s", Bound::drift_rates, "drift_inner_rate_rad_s"});
  visit_one(
      [](auto& g) -> auto& { return g.drift_outer_angle_bound_rad; },
      Q{"drift_outer_angle_bound", "_rad", "bound on the error of drift_outer_angle_rad", number, error,
        "drift_outer_angle_bound_rad"});
  visit_one(
      [](auto& g) -> auto& { return g.drift_inner_angle_bound_rad; },
      Q{"drift_inner_angle_bound", "_rad", "bound on the error of drift_inner_angle_rad", number, error,
        "drift_inner_angle_bound_rad"});
}

/// The quantities that follow in the runs of a laboratory that travels.
/// @param visit  the same, but its function takes the part of a row on the journey (BasicJourneyRow of any scalar)
template <class Visit>
constexpr void for_each_journey_quantity(const Visit& visit) {
  using enum MeasureKind;
  using enum RowPart;
  using Q = RowQuantity;
  const auto visit_one = [&](auto member, RowQuantity quantity) {
    quantity.owner = RowOwner::journey;
    visit(member, quantity);
  };
  visit_one(
      [](auto& j) -> auto& { return j.latitude_deg; },
      Q{"latitude", "_deg", "geodetic latitude of the travelling laboratory", number, rotating, "latitude_deg"});
  visit_one(
      [](auto& j) -> auto& { return j.longitude_deg; },
      Q{"longitude", "_deg", "longitude of the travelling laboratory, without jumps", number, rotating, "longitude_deg"});
  visit_one(
      [](auto& j) -> auto& { return j.height_m; },
      Q{"height", "_m", "height of the travelling laboratory over the ellipsoid", number, rotating, "height_m"});
  visit_one(
      [](auto& j) -> auto& { return j.course_deg; },
      Q{"course", "_deg", "compass course of the travelling laboratory, 0 to 360", number, rotating, "course_deg"});
  visit_one(
      [](auto& j) -> auto& { return j.speed_m_s; },
      Q{"speed", "_m_s", "horizontal speed of the travelling laboratory over the Earth", number, rotating, "speed_m_s"});
  visit_one(
      [](auto& j) -> auto& { return j.w_IL_L_rad_s; },
      Q{"w_IL_L", "_rad_s", "rate of the travelling laboratory in inertial space, in laboratory axes", vector, rotating,
        "w_IL_L_rad_s"});
  visit_one(
      [](auto& j) -> auto& { return j.G_L_m_s2; },
      Q{"G_L", "_m_s2", "what takes the place of apparent gravity at the pivot of a travelling laboratory, in laboratory axes",
        vector, rotating, "G_L_m_s2"});
}

using DriftQuantity = ValuedQuantity<DriftRow, ExtendedDriftRow>;

/// A quantity's function for a row, from its function for a part of it. It gives none where the row has no such part.
template <class Member, class Part>
struct OfPart {
  template <class Row>
  constexpr auto operator()(const Row& row, std::size_t component) const
      -> decltype(row_quantities_detail::component_of(Member{}(*Part::of(row)), component)) {
    if (!Part::of(row)) return std::nullopt;
    return row_quantities_detail::component_of(Member{}(*Part::of(row)), component);
  }
};
struct ContactPart {
  static constexpr const auto& of(const auto& row) { return row.contact; }
};
struct RotorPart {
  static constexpr const auto& of(const auto& row) { return row.rotor; }
};
struct GimbalPart {
  static constexpr const auto& of(const auto& row) { return row.gimbals; }
};
struct TravelledPart {
  static constexpr const auto& of(const auto& row) { return row.journey; }
};
/// Makes a table entry of a quantity of a part.
template <class Read>
constexpr DriftQuantity read_by(const RowQuantity& quantity) {
  return {quantity, [](const DriftRow& row, std::size_t component) -> std::optional<double> { return Read{}(row, component); },
          [](const ExtendedDriftRow& row, std::size_t component) -> std::optional<float128> { return Read{}(row, component); }};
}

/// The quantities of trajectory.csv as an array, in the same order; those of a contact, a rotor, gimbals and a journey come last.
inline constexpr auto kDriftQuantities = [] {
  constexpr std::size_t kCount = [] {
    std::size_t count = 0;
    const auto one_more = [&](auto, const RowQuantity&) { ++count; };
    for_each_drift_quantity(one_more);
    for_each_contact_quantity(one_more);
    for_each_rotor_quantity(one_more);
    for_each_gimbal_quantity(one_more);
    for_each_journey_quantity(one_more);
    return count;
  }();
  std::array<DriftQuantity, kCount> all{};
  std::size_t i = 0;
  for_each_drift_quantity(
      [&](auto member, const RowQuantity& quantity) { all[i++] = valued<DriftRow, ExtendedDriftRow>(quantity, member); });
  for_each_contact_quantity(
      [&](auto member, const RowQuantity& quantity) { all[i++] = read_by<OfPart<decltype(member), ContactPart>>(quantity); });
  for_each_rotor_quantity(
      [&](auto member, const RowQuantity& quantity) { all[i++] = read_by<OfPart<decltype(member), RotorPart>>(quantity); });
  for_each_gimbal_quantity(
      [&](auto member, const RowQuantity& quantity) { all[i++] = read_by<OfPart<decltype(member), GimbalPart>>(quantity); });
  for_each_journey_quantity(
      [&](auto member, const RowQuantity& quantity) { all[i++] = read_by<OfPart<decltype(member), TravelledPart>>(quantity); });
  return all;
}();

}  // namespace earthtop
