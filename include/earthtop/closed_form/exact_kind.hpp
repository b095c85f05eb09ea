// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of closed form that the whole motion of a model may have.
#pragma once

namespace earthtop {

/// The closed form that a model has, or why it has none.
enum class ExactKind {
  free_body,        ///< any body without torque, anywhere on the Earth
  symmetric_top,    ///< a symmetric top with its centre of mass on the axis, if gravity keeps its direction in inertial space
  not_plain,        ///< no closed form: a platform, applied torques, or an omitted non-inertial torque
  not_symmetric,    ///< no closed form: gravity acts on a body that is not a symmetric top
  turning_gravity,  ///< no closed form: away from the poles the Earth's rotation turns gravity
  free_gyrostat,    ///< a body without torque and a rotor on a principal axis, without friction or at a constant rate, anywhere
  heavy_gyrostat,   ///< no closed form: gravity acts on a body with a rotor
  braked_rotor,     ///< no closed form: friction in the rotor's bearing
  changing_rotor,   ///< no closed form: a motor changes the rotor's rate
  moving_masses,    ///< no closed form: masses move in the body
  skew_rotor        ///< no closed form: the rotor's axis is no body axis, or has products of inertia
};
constexpr bool has_closed_form(ExactKind kind) {
  return kind == ExactKind::free_body || kind == ExactKind::symmetric_top || kind == ExactKind::free_gyrostat;
}

}  // namespace earthtop
