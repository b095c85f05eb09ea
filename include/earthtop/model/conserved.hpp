// SPDX-License-Identifier: GPL-3.0-or-later
/// What the exact motions conserve: one row for each quantity, with its name and unit, which motion conserves it under which
/// conditions, and how it is found from a state of a body on a pivot or of a top on a table. The invariants of a run, the names that
/// criteria may use, and what criteria find for them are made from these rows.
#pragma once

#include <algorithm>
#include <string_view>

#include "earthtop/model/contact_invariants.hpp"
#include "earthtop/model/contact_spec.hpp"
#include "earthtop/model/gimbal_equations.hpp"
#include "earthtop/model/invariants.hpp"

namespace earthtop {

/// One motion of a body on a pivot at one instant, in SI units.
template <class T>
struct InstantOnPivot {
  const Model<T>& model;
  Vec3<T> W_IL_L;     ///< rate of the laboratory in space; 0 for a reference motion that is at rest
  Vec3<T> gravity_L;  ///< what takes the place of apparent gravity
  Quaternion<T> q_LB;
  Vec3<T> w_LB_B;
  T rotor_rate = T(0);                  ///< relative to the body
  GimbalAngles<T> gimbals = {};         ///< of a Cardan suspension
  const MassSums<T>* masses = nullptr;  ///< that move in the body, of which the model has the place at this instant
  T t = T(0);                           ///< of a suspension, whose model is that of the release

  /// The rotor's momentum about its axis: of a free rotor that of its inertial rate, of a driven one that of its rate in the body.
  T rotor_momentum() const {
    const Rotor<T>& rotor = model.rotor;
    if (model.kind != SceneKind::gyrostat && model.kind != SceneKind::suspension) return T(0);
    return rotor.axial * (rotor.driven ? rotor_rate : T(rotor.axis_B.dot(w_IB_B()) + rotor_rate));
  }
  Vec3<T> up_B() const { return rotation_matrix(q_LB).row(2).transpose(); }
  Vec3<T> w_IB_B() const { return w_LB_B + transposed_times(rotation_matrix(q_LB), W_IL_L); }
  /// m g l / I3 of a body whose centre of mass is on axis 1 (1/s^2).
  T pull() const { return model.mass_moment_B[0] * norm(gravity_L) / model.I_BP_B(2, 2); }
};

/// One motion of a top on a table at one instant, in natural units and in the table's axes H.
template <class T>
struct InstantOnTable {
  const Contact<T>& contact;
  const ContactSurroundings<T>& around;
  Mat3<T> R_HB;
  Vec3<T> w;  ///< rate relative to the laboratory
  T rate;     ///< its size
  Vec3<T> n;  ///< body axis 3
  T spin;     ///< about body axis 3, relative to inertial space
  Vec3<T> slip;
  Vec3<T> p_O;  ///< place of the centre of the tip's sphere

  ReducedContactState<T> reduced() const {
    const Vec3<T> w_IB = w + around.W;
    return {n, w_IB - inner(w_IB, n) * n, spin, slip, p_O};
  }
};

/// What decides what a body on a pivot conserves.
struct PivotConditions {
  int symmetry_axis = -1;       ///< of a rigid body
  bool alone = false;           ///< whether only gravity and the Earth's rotation act, in a laboratory that turns evenly
  bool aboard = false;          ///< whether only these act on a journey, on which gravity and the rate change
  bool beside_support = false;  ///< whether nothing else acts but an unequal support, which has an energy
  const GimbalsSpec* gimbals = nullptr;     ///< null without a Cardan suspension
  bool outer_axis_without_gravity = false;  ///< of a suspension: whether gravity has no moment about its outer axis
  bool has_rotor = false;
  bool masses_move = false;      ///< in the body, so that motors work
  bool rotor_is_steady = false;  ///< whether neither friction nor a changing drive takes or gives energy
  bool rotor_keeps_momentum = false;

  bool conserves_energy() const {
    return (alone || beside_support) && !masses_move && (!has_rotor || rotor_is_steady) && !bearings_brake();
  }
  /// An unequal support has no torque along body axis 3.
  bool conserves_spin() const { return alone || aboard ? symmetry_axis >= 0 : beside_support && symmetry_axis == 2; }
  bool bearings_brake() const {
    const auto brakes = [](const BearingSpec& b) { return b.viscous_torque_N_m_s != 0 || b.coulomb_torque_N_m != 0; };
    return gimbals != nullptr && (brakes(gimbals->outer) || brakes(gimbals->inner));
  }
  /// The bearing of the inner axis, the rotor's and the motors of masses act between parts that the outer axis carries.
  bool conserves_outer_momentum() const {
    if (gimbals == nullptr || !alone || !outer_axis_without_gravity) return false;
    const BearingSpec& outer = gimbals->outer;
    return !outer.locked && outer.viscous_torque_N_m_s == 0 && outer.coulomb_torque_N_m == 0 && outer.torsion_N_m_rad == 0;
  }
};

/// Whether all of the Earth's torques act on a top on a table, and neither a tide nor the gradient of gravitation does; and what
/// else decides what it conserves.
struct TableConditions {
  const ContactSpec& spec;
  bool symmetric;  ///< about body axis 3
  bool alone;

  bool has_moments() const {
    return spec.spinning_friction_m > 0 || spec.rolling_resistance_m > 0 || spec.law == ContactLaw::contensou;
  }
  bool conserves_energy() const {
    return alone && !has_moments() && (spec.law == ContactLaw::frictionless || spec.law == ContactLaw::rolling);
  }
  bool conserves_spin() const {
    return alone && symmetric && !has_moments() && (spec.law == ContactLaw::frictionless || spec.tip_radius_m == 0);
  }
  bool conserves_jellett() const { return alone && symmetric && !has_moments(); }
  /// On a tilted table gravity is not along the normal.
  bool conserves_routh() const { return conserves_jellett() && spec.law == ContactLaw::rolling && spec.table_tilt_deg == 0; }
};

namespace conserved {

/// A suspension at one instant, as an inertial observer sees it; without a platform.
template <class T>
struct SeenSuspension {
  GimbalPose<T, T> pose;
  CarriedParts<T> parts;
  GimbalMomenta<T> momenta;
  GimbalMotion<T> motion;
  Vec3<T> W_A, W_B;

  explicit SeenSuspension(const InstantOnPivot<T>& i)
      : pose{i.model.gimbals, real::sin_cos(i.gimbals.outer), real::sin_cos(i.gimbals.inner)},
        parts(carried_parts(i.model, i.t)),
        momenta(gimbal_momenta(i.model, parts, pose, i.gimbals.outer_rate, i.gimbals.inner_rate, i.rotor_rate, i.W_IL_L, i.t)),
        motion(gimbal_motion(i.model, parts, pose, momenta, i.W_IL_L, i.t)),
        W_A(pose.into_ring(i.W_IL_L)),
        W_B(pose.into_body(W_A)) {}
};
/// w_A.L_A / 2 + w_B.L_B / 2, with the rotor as below, and the energy of gravity and of the springs, minus W.(L_A + L_B).
template <class T>
ConservedValue<T> jacobi_of_suspension(const InstantOnPivot<T>& i) {
  const SeenSuspension<T> s(i);
  const Model<T>& model = i.model;
  const GimbalMotion<T>& m = s.motion;
  const T h = s.momenta.rotor;
  const T turning = (m.w_A.dot(m.L_A) + m.w_B.dot(times(model.I_BP_B, m.w_B))) / T(2);
  const T spinning = model.rotor.driven ? T(0) : T(h * h / (T(2) * model.rotor.axial));
  const Vec3<T> gravity_A = s.pose.into_ring(i.gravity_L);
  const T of_gravity = model.gimbals.ring.mass_moment.dot(gravity_A) + model.mass_moment_B.dot(s.pose.into_body(gravity_A));
  const auto spring = [](const Bearing<T>& b, const T& angle) -> T {
    return b.torsion * (angle - b.rest) * (angle - b.rest) / T(2);
  };
  const T sprung = spring(model.gimbals.outer, i.gimbals.outer) + spring(model.gimbals.inner, i.gimbals.inner);
  const T of_earth = s.W_A.dot(m.L_A) + s.W_B.dot(m.L_B);
  return {turning + spinning - of_gravity + sprung - of_earth,
          turning + spinning + norm(i.gravity_L) * (norm(model.mass_moment_B) + norm(model.gimbals.ring.mass_moment)) + sprung +
              real::abs(of_earth)};
}
/// The inertial momentum of all parts about the outer axis.
template <class T>
ConservedValue<T> outer_momentum(const InstantOnPivot<T>& i) {
  const SeenSuspension<T> s(i);
  return {s.momenta.outer, norm(s.motion.L_A) + norm(s.motion.L_B)};
}

/// With the energy of an unequal support. With a rotor: h^2 / (2 C) of a free one, and -W.(h c) of any.
template <class T>
ConservedValue<T> jacobi(const InstantOnPivot<T>& i) {
  if (i.model.kind == SceneKind::suspension) return jacobi_of_suspension(i);
  ConservedValue<T> J = jacobi_integral(i.model.I_BP_B, i.model.mass_moment_B, i.gravity_L, i.W_IL_L, i.q_LB, i.w_LB_B);
  if (const SupportStiffness<T>& K = i.model.applied.support; K.acts()) {
    const Mat3<T> R_LB = rotation_matrix(i.q_LB);
    J.value += support_energy(K, R_LB(0, 2), R_LB(1, 2)), J.scale += K.largest();
  }
  const Rotor<T>& rotor = i.model.rotor;
  if (i.model.kind != SceneKind::gyrostat) return J;
  const T h = i.rotor_momentum(), kinetic = rotor.driven ? T(0) : T(h * h / (T(2) * rotor.axial));
  const T turning = h * rotor.axis_B.dot(transposed_times(rotation_matrix(i.q_LB), i.W_IL_L));
  return {J.value + kinetic - turning, J.scale + kinetic + real::abs(turning)};
}
template <class T>
ConservedValue<T> rotor_momentum(const InstantOnPivot<T>& i) {
  const T h = i.rotor_momentum();
  return {h, real::abs(h)};
}
template <class T>
ConservedValue<T> jacobi(const InstantOnTable<T>& i) {
  const Contact<T>& c = i.contact;
  const Vec3<T> r_c = times(i.R_HB, c.p_OC_B), z = Vec3<T>::UnitZ();
  const Vec3<T> v_O = i.slip + c.tip_radius * Vec3<T>(i.w.cross(z));
  const Vec3<T> p_C = i.p_O + r_c;
  const Vec3<T> v_C = v_O + Vec3<T>(i.w.cross(r_c));
  const auto J = contact_jacobi(c, i.around, turned_tensor(i.R_HB, c.I_BC_B), i.w, p_C, v_C);
  return {J.value, J.kinetic + real::abs(J.potential)};
}

/// The inertial rate about the symmetry axis.
template <class T>
ConservedValue<T> spin(const InstantOnPivot<T>& i) {
  const T w3 = i.w_IB_B()[symmetry_axis(i.model.I_BP_B, i.model.mass_moment_B)];
  return {w3, std::max(real::abs(w3), norm(i.w_LB_B))};
}
template <class T>
ConservedValue<T> spin(const InstantOnTable<T>& i) {
  return {i.spin, std::max(real::abs(i.spin), i.rate)};
}

template <class T>
ConservedValue<T> jellett(const InstantOnTable<T>& i) {
  const Contact<T>& c = i.contact;
  return {earthtop::jellett(c, i.around, i.reduced()),
          std::max(c.I1, c.I3) * i.rate * (c.tip_radius + real::abs(c.height_of_center))};
}
template <class T>
ConservedValue<T> routh(const InstantOnTable<T>& i) {
  const T value = earthtop::routh(i.contact, i.around, i.reduced());
  return {value, real::abs(value)};
}

/// The angular momentum about Up: conserved without the Earth's rotation, and at a pole.
template <class T>
ConservedValue<T> vertical_momentum(const InstantOnPivot<T>& i) {
  Vec3<T> L_B = i.model.I_BP_B * i.w_IB_B();
  if (i.model.kind == SceneKind::gyrostat) L_B += i.rotor_momentum() * i.model.rotor.axis_B;
  if (i.masses) L_B += i.masses->momentum;
  return {L_B.dot(i.up_B()), norm(L_B)};
}

/// (p^2 - q^2 - c g1)^2 + (2 p q - c g2)^2, for a body with I1 = I2 = 2 I3 and its centre of mass on axis 1. [S. Kowalevski,
/// Acta Math. 12 (1889) 177]
template <class T>
ConservedValue<T> kovalevskaya(const InstantOnPivot<T>& i) {
  const Vec3<T> w = i.w_IB_B(), up_B = i.up_B();
  const T c = i.pull(), p = w[0], q = w[1];
  const T a = p * p - q * q - c * up_B[0], b = T(2) * p * q - c * up_B[1], size = p * p + q * q + real::abs(c);
  return {a * a + b * b, size * size};
}

/// r (p^2 + q^2) - c p g3, for a body with I1 = I2 = 4 I3, its centre of mass on axis 1, and no angular momentum about the
/// vertical. [D. N. Goryachev 1900, S. A. Chaplygin 1901]
template <class T>
ConservedValue<T> goryachev_chaplygin(const InstantOnPivot<T>& i) {
  const Vec3<T> w = i.w_IB_B();
  const T c = i.pull(), p = w[0], q = w[1], r = w[2];
  return {r * (p * p + q * q) - c * p * i.up_B()[2], real::abs(r) * (p * p + q * q) + real::abs(c * p)};
}

}  // namespace conserved

/// The motion that conserves a quantity: that on the rotating Earth, the reference motion, or of these the one in which nothing
/// distinguishes a direction across Up, or across the outer axis of a suspension (the first where the Earth's axis is parallel to it, else
/// the second).
enum class ConservingMotion { rotating, reference, about_up, about_outer_axis };

/// One conserved quantity. A function is null where the quantity has no meaning.
template <class T>
struct ConservedQuantity {
  std::string_view name, unit;
  int mass_power, rate_power;  ///< of the unit: kg^mass_power s^-rate_power; lengths are metres in natural units, too
  ConservingMotion motion;
  ConservedValue<T> (*on_pivot)(const InstantOnPivot<T>&);
  /// Whether a scene on a pivot conserves it. Null where only special bodies and releases do: a run does not report it, and
  /// who names it in a criterion claims that the scene conserves it.
  bool (*holds_on_pivot)(const PivotConditions&) = nullptr;
  ConservedValue<T> (*on_table)(const InstantOnTable<T>&) = nullptr;
  bool (*holds_on_table)(const TableConditions&) = nullptr;
};

/// All of them, in the order in which a run reports them.
template <class T>
inline constexpr ConservedQuantity<T> kConserved[] = {
    {"jacobi_integral", "J", 1, 2, ConservingMotion::rotating, conserved::jacobi<T>,
     [](const PivotConditions& pivot) { return pivot.conserves_energy(); }, conserved::jacobi<T>,
     [](const TableConditions& table) { return table.conserves_energy(); }},
    {"reference_energy", "J", 1, 2, ConservingMotion::reference, conserved::jacobi<T>,
     [](const PivotConditions& pivot) { return pivot.conserves_energy(); }, conserved::jacobi<T>,
     [](const TableConditions& table) { return table.conserves_energy(); }},
    {"inertial_spin", "rad/s", 0, 1, ConservingMotion::rotating, conserved::spin<T>,
     [](const PivotConditions& pivot) { return pivot.conserves_spin(); }, conserved::spin<T>,
     [](const TableConditions& table) { return table.conserves_spin(); }},
    {"reference_jellett_integral", "kg m^3/s", 1, 1, ConservingMotion::reference, nullptr, nullptr, conserved::jellett<T>,
     [](const TableConditions& table) { return table.conserves_jellett(); }},
    {"reference_routh_integral", "kg m^2 rad/s", 1, 1, ConservingMotion::reference, nullptr, nullptr, conserved::routh<T>,
     [](const TableConditions& table) { return table.conserves_routh(); }},
    {"rotor_momentum", "kg m^2/s", 1, 1, ConservingMotion::rotating, conserved::rotor_momentum<T>,
     [](const PivotConditions& pivot) { return pivot.rotor_keeps_momentum; }},
    {"outer_momentum", "kg m^2/s", 1, 1, ConservingMotion::about_outer_axis, conserved::outer_momentum<T>,
     [](const PivotConditions& pivot) { return pivot.conserves_outer_momentum(); }},
    {"vertical_momentum", "kg m^2/s", 1, 1, ConservingMotion::about_up, conserved::vertical_momentum<T>},
    {"kovalevskaya", "1/s^4", 0, 4, ConservingMotion::about_up, conserved::kovalevskaya<T>},
    {"goryachev_chaplygin", "1/s^3", 0, 3, ConservingMotion::about_up, conserved::goryachev_chaplygin<T>},
};

}  // namespace earthtop
