// SPDX-License-Identifier: GPL-3.0-or-later
// The top on a table, seen by an observer who does not turn: no Coriolis term appears. The table's normal z(t) turns with the
// Earth; that the tip's centre stays at the height r above the table, z . X_O = r, is differentiated twice.
#include "motion.hpp"

namespace headlines {
namespace {

/// The force of the table on the tip, and its moment about the point of contact.
struct Contacting {
  Vec force, moment;
};

/// The friction of a patch with Coulomb's law everywhere, by Contensou's approximation, for the normal force 1.
/// @param slip  of the point of contact on the table (m/s)   @param pivoting  rate about the normal relative to the table (rad/s)
Contacting friction_on_patch(const Contact& contact, const Vec& slip, Real pivoting, const Vec& up) {
  const Real u = contact.patch_radius * pivoting, v = norm(slip), a = 8 / (3 * pi()), b = 15 * pi() / 16;
  const Real force = contact.friction / sqrtq(v * v + a * a * u * u);
  const Real moment = 3 * pi() / 16 * contact.friction * contact.patch_radius * u / sqrtq(u * u + b * b * v * v);
  return {-force * slip, -moment * up};
}

}  // namespace

State Motion::slope_on_table(Real t, const State& state) const {
  const Contact& contact = *scene_->contact;
  const Mat R_IB = matrix(state.q_IB);
  const Vec w_IB_B = angular_velocity(t, state), w = R_IB * w_IB_B, r_c = R_IB * scene_->centre;
  const Vec W = rate_ * scene_->celestial_axis, up = headlines::turned(scene_->celestial_axis, rate_ * t, Vec{0, 0, 1});
  const Real r = contact.tip_radius, m = scene_->mass;
  const auto solve_inertia = [&](const Vec& torque) { return R_IB * (scene_->inverse_inertia * (transposed(R_IB) * torque)); };

  const Vec tip = state.X_I - r_c, tip_velocity = state.V_I - cross(w, r_c), at_contact = tip - r * up;
  const Vec s = Real(-1) * (r * up + r_c), up_rate = cross(W, up), up_rate_rate = cross(W, up_rate);
  const Vec slip = state.V_I + cross(w, s) - cross(W, at_contact);

  // Accelerations are linear in the contact's force and moment. With neither of them:
  // Below 1 mm/s the air's force is linear.
  const Vec velocity = state.V_I - cross(W, state.X_I), torque = acting_torque_I(t, R_IB, w);
  const Acting& acting = scene_->acting;
  const Real drag = acting.drag + acting.drag_by_speed * sqrtq(dot(velocity, velocity) + Real(1e-3) * Real(1e-3));
  const Vec falling = -scene_->gravity * up - (drag / m) * velocity, turning = solve_inertia(torque - cross(w, state.L_I));
  const auto acceleration = [&](const Contacting& k) { return (1 / m) * k.force; };
  const auto spin_up = [&](const Contacting& k) { return solve_inertia(cross(s, k.force) + k.moment); };

  Contacting table;
  if (contact.rolling) {
    // The body's point of contact has the table's velocity: the time derivative of `slip` is zero in all three components.
    const Vec s_rate = Real(-1) * (r * up_rate + cross(w, r_c));
    const Vec free = falling + cross(turning, s) + cross(w, s_rate) - cross(W, tip_velocity - r * up_rate);
    const auto response = [&](const Vec& force) {
      const Contacting k{force, {}};
      return acceleration(k) + cross(spin_up(k), s);
    };
    const Mat columns = {response({1, 0, 0}), response({0, 1, 0}), response({0, 0, 1})};
    table.force = inverse(transposed(columns)) * (Real(-1) * free);
  } else {
    const auto height_of = [&](const Vec& a_C, const Vec& w_rate) { return dot(up, a_C - cross(w_rate, r_c)); };
    const Real free =
        height_of(falling - cross(w, cross(w, r_c)), turning) + 2 * dot(up_rate, tip_velocity) + dot(up_rate_rate, tip);
    Contacting unit = friction_on_patch(contact, slip, dot(w - W, up), up);
    unit.force += up;
    const Real normal_force = -free / height_of(acceleration(unit), spin_up(unit));
    table = {normal_force * unit.force, normal_force * unit.moment};
  }
  return {state.q_IB * Quat{0, Real(0.5) * w_IB_B}, cross(s, table.force) + table.moment + torque, state.V_I,
          falling + acceleration(table)};
}

}  // namespace headlines
