// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of closed form that the whole motion of a model may have.
#pragma once

namespace earthtop {

/// The closed form that a model has, or why it has none.
enum class ExactKind {
  free_body,       ///< no torque: anywhere, any body
  symmetric_top,   ///< symmetric, its centre of mass on the axis, in a gravity that stands still in space
  not_plain,       ///< none: a platform, or one of the non-inertial torques left out
  not_symmetric,   ///< none: gravity acts on a body that is no symmetric top
  turning_gravity  ///< none: away from the poles the Earth turns gravity
};
constexpr bool has_closed_form(ExactKind kind) { return kind == ExactKind::free_body || kind == ExactKind::symmetric_top; }

}  // namespace earthtop
