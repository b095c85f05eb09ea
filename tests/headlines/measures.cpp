// SPDX-License-Identifier: GPL-3.0-or-later
#include "measures.hpp"

namespace headlines {
namespace {

Vec axis_L(const Motion& motion) {
  const Mat R = matrix(motion.q_LB());
  return {R.a.z, R.b.z, R.c.z};
}

Quat deviation(const Motion& rotating, const Motion& reference) { return conjugate(reference.q_LB()) * rotating.q_LB(); }

Real tilt(const Vec& n) { return atan2q(hypotq(n.x, n.y), n.z); }

}  // namespace

void DriftMeasures::Counted::include(std::optional<Real> angle) {
  if (!angle || lost_) return;
  if (!value_) {
    value_ = angle;
    return;
  }
  const Real change = remainderq(*angle - *value_, 2 * pi());
  if (fabsq(change) > 1) lost_ = true;
  *value_ += change;
}

void DriftMeasures::follow(const Motion& rotating, const Motion& reference) {
  const Vec n = axis_L(rotating), m = axis_L(reference);
  const bool vertical = hypotq(n.x, n.y) < 1e-25Q || hypotq(m.x, m.y) < 1e-25Q;
  // Compass azimuth atan2(East, North): the angle from m to n, clockwise seen from above.
  azimuth_.include(vertical ? std::nullopt : std::optional(atan2q(m.y * n.x - m.x * n.y, m.x * n.x + m.y * n.y)));
  const Quat e = deviation(rotating, reference);
  half_spin_.include(atan2q(e.v.z, e.w));
}

Columns DriftMeasures::columns(const Motion& rotating, const Motion& reference) const {
  Columns columns;
  const auto add = [&](const std::string& name, std::optional<Real> value) { columns.emplace_back(name, value); };
  const auto add_vector = [&](const std::string& name, const Vec& v, const std::string& unit) {
    add(name + "x" + unit, v.x), add(name + "y" + unit, v.y), add(name + "z" + unit, v.z);
  };
  for (const auto& [prefix, motion] : {std::pair("", &rotating), std::pair("ref_", &reference)}) {
    const Quat q = motion->q_LB();
    add(std::string(prefix) + "q_LB_w", q.w);
    add_vector(std::string(prefix) + "q_LB_", q.v, "");
    add_vector(std::string(prefix) + "w_LB_B_", motion->w_LB_B(), "_rad_s");
    add_vector(std::string(prefix) + "axis_L_", axis_L(*motion), "");
  }
  const Vec n = axis_L(rotating), m = axis_L(reference);
  const Quat e = deviation(rotating, reference);
  const auto half_spin = half_spin_.value();
  add("drift_axis_rad", atan2q(norm(cross(m, n)), dot(m, n)));
  add("drift_azimuth_rad", azimuth_.value());
  add("drift_tilt_rad", tilt(n) - tilt(m));
  add("drift_attitude_rad", 2 * atan2q(norm(e.v), fabsq(e.w)));
  add("drift_spin_rad", half_spin ? std::optional(2 * *half_spin) : std::nullopt);
  if (rotating.has_rotor()) {
    for (const auto& [prefix, motion] : {std::pair("", &rotating), std::pair("ref_", &reference)}) {
      add(std::string(prefix) + "rotor_rate_rad_s", motion->rotor_rate());
      add(std::string(prefix) + "rotor_angle_rad", motion->state().rotor_angle);
      add_vector(std::string(prefix) + "rotor_axis_L_", motion->rotor_axis_L(), "");
    }
    const Vec a = rotating.rotor_axis_L(), b = reference.rotor_axis_L();
    add("drift_rotor_rate_rad_s", rotating.rotor_rate() - reference.rotor_rate());
    add("drift_rotor_angle_rad", rotating.state().rotor_angle - reference.state().rotor_angle);
    add("drift_rotor_axis_rad", atan2q(norm(cross(b, a)), dot(b, a)));
  }
  if (rotating.in_gimbals()) {
    for (const auto& [prefix, motion] : {std::pair("", &rotating), std::pair("ref_", &reference)}) {
      const State& s = motion->state();
      add(std::string(prefix) + "outer_angle_rad", s.outer_angle), add(std::string(prefix) + "inner_angle_rad", s.inner_angle);
      add(std::string(prefix) + "outer_rate_rad_s", s.outer_rate), add(std::string(prefix) + "inner_rate_rad_s", s.inner_rate);
    }
    const State &s = rotating.state(), &r = reference.state();
    add("drift_outer_angle_rad", s.outer_angle - r.outer_angle), add("drift_inner_angle_rad", s.inner_angle - r.inner_angle);
    add("drift_outer_rate_rad_s", s.outer_rate - r.outer_rate), add("drift_inner_rate_rad_s", s.inner_rate - r.inner_rate);
  }
  if (!rotating.on_table()) return columns;
  const Vec tip = rotating.tip_L(), ref_tip = reference.tip_L(), drift = tip - ref_tip;
  add("tip_L_x_m", tip.x), add("tip_L_y_m", tip.y), add("ref_tip_L_x_m", ref_tip.x), add("ref_tip_L_y_m", ref_tip.y);
  add("drift_tip_x_m", drift.x), add("drift_tip_y_m", drift.y), add("drift_tip_m", hypotq(drift.x, drift.y));
  add("drift_spin_rate_rad_s", rotating.w_IB_B().z - reference.w_IB_B().z);
  return columns;
}

}  // namespace headlines
