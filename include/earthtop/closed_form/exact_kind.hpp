// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of closed form that the whole motion of a model may have.
#pragma once

namespace earthtop {

/// The closed form that a model has, or why it has none.
enum class ExactKind {
  free_body,       ///< any body without torque, anywhere on the Earth
  symmetric_top,   ///< a symmetric top with its centre of mass on the axis, if gravity keeps its direction in inertial space
  not_plain,       ///< no closed form: a platform, applied torques, or an omitted non-inertial torque
  not_symmetric,   ///< no closed form: gravity acts on a body that is not a symmetric top
  turning_gravity  ///< no closed form: away from the poles the Earth's rotation turns gravity
};
constexpr bool has_closed_form(ExactKind kind) { return kind == ExactKind::free_body || kind == ExactKind::symmetric_top; }

}  // namespace earthtop
