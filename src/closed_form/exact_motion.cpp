// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/exact_motion.hpp"

#include <stdexcept>

#include "closed_form/principal_axes.hpp"

namespace earthtop {

namespace {

/// The body axis along which a vector lies exactly, or -1.
template <class T>
int axis_along(const Vec3<T>& v) {
  const int components = (v[0] != T(0)) + (v[1] != T(0)) + (v[2] != T(0));
  return components != 1 ? -1 : v[0] != T(0) ? 0 : v[1] != T(0) ? 1 : 2;
}

template <class T>
ExactKind kind_of_gyrostat(const Model<T>& model) {
  const Rotor<T>& rotor = model.rotor;
  if (model.applied.any) return ExactKind::not_plain;
  if (model.masses.any()) return ExactKind::moving_masses;
  if (norm(model.mass_moment_B) != T(0) && norm(model.apparent_gravity_L) != T(0)) return ExactKind::heavy_gyrostat;
  if (rotor.viscous != T(0) || rotor.coulomb != T(0)) return ExactKind::braked_rotor;
  if (rotor.driven && (rotor.drive.rate != T(0) || rotor.drive.amplitude != T(0))) return ExactKind::changing_rotor;
  const int axis = axis_along(rotor.axis_B);
  if (axis < 0 || axis_along<T>(model.I_BP_B.col(axis)) != axis) return ExactKind::skew_rotor;
  return ExactKind::free_gyrostat;
}

}  // namespace

template <class T>
ExactKind exact_kind(const Model<T>& model) {
  if (model.kind == SceneKind::gyrostat) return kind_of_gyrostat(model);
  if (model.kind != SceneKind::plain) return ExactKind::not_plain;
  if (norm(model.mass_moment_B) == T(0) || norm(model.apparent_gravity_L) == T(0)) return ExactKind::free_body;
  if (!is_reducible(model)) return ExactKind::not_symmetric;
  // Gravity lies along Up: if the Earth's rotation is about Up, or zero, the direction of gravity stays constant in inertial
  // space.
  const bool stands_still = model.W_IL_L[0] == T(0) && model.W_IL_L[1] == T(0);
  return stands_still ? ExactKind::symmetric_top : ExactKind::turning_gravity;
}
template ExactKind exact_kind(const Model<double>&);
template ExactKind exact_kind(const Model<float80>&);
template ExactKind exact_kind(const Model<float128>&);

template <class T>
ExactBody<T> exact_body(const Model<T>& model) {
  ExactBody<T> body;
  body.kind = exact_kind(model);
  if (!has_closed_form(body.kind)) throw std::logic_error("exact_body: this motion has no closed form");
  body.I_BP_B = model.I_BP_B;
  body.I_BP_B_inverse = model.I_BP_B_inverse;
  if (body.kind == ExactKind::free_gyrostat) {
    const Rotor<T>& rotor = model.rotor;
    const int axis = axis_along(rotor.axis_B);
    body.rotor = {axis, rotor.driven, rotor.axial, rotor.axis_B[axis] < T(0) ? T(-1) : T(1), rotor.spin};
    return body;
  }
  if (body.kind == ExactKind::free_body) {
    // Without gravity it does not matter where the centre of mass lies.
    body.axis = symmetry_axis(model.I_BP_B, Vec3<T>(Vec3<T>::Zero()));
    return body;
  }
  const ReducedTop<T> top = reduced_top(model);
  body.axis = top.axis;
  body.top = {top.I1, top.I3, model.mass_moment_B[top.axis] * norm(model.apparent_gravity_L)};
  return body;
}
template ExactBody<double> exact_body(const Model<double>&);
template ExactBody<float80> exact_body(const Model<float80>&);
template ExactBody<float128> exact_body(const Model<float128>&);

namespace {

template <class T>
std::variant<FreeBody<T>, LagrangeTop<T>, FreeGyrostat<T>> make_motion(const ExactBody<T>& body, const Quaternion<T>& q0_NB,
                                                                       const Vec3<T>& w0_B) {
  if (body.kind == ExactKind::free_gyrostat)
    return FreeGyrostat<T>(body.I_BP_B, body.rotor.axis, body.rotor.momentum(w0_B), q0_NB, w0_B);
  if (body.kind == ExactKind::free_body) return FreeBody<T>(body.I_BP_B, q0_NB, w0_B);
  const int a = body.axis;
  return LagrangeTop<T>(body.top, q0_NB * third_axis_is<T>(a), Vec3<T>(w0_B[(a + 1) % 3], w0_B[(a + 2) % 3], w0_B[a]));
}

}  // namespace

template <class T>
ExactMotion<T>::ExactMotion(const ExactBody<T>& body, const Quaternion<T>& q0_NB, const Vec3<T>& w0_IB_B)
    : motion_(make_motion(body, q0_NB, w0_IB_B)), axis_(body.kind == ExactKind::symmetric_top ? body.axis : 2) {
  q_BP_ = third_axis_is<T>(axis_);
  // The kinetic energy grows by at most 2 |mgl|. For a symmetric top it is the part across the axis that grows, because w3 is
  // conserved.
  const T gained = body.kind == ExactKind::symmetric_top ? T(4) * real::abs(body.top.mgl) : T(0);
  if (body.axis == 2) {
    spin_ = w0_IB_B[2];
    const T across = real::hypot(w0_IB_B[0], w0_IB_B[1]);
    turn_rate_ = real::sqrt(across * across + gained / body.I_BP_B(0, 0));
  } else {
    const T twice_T = w0_IB_B.dot(times(body.I_BP_B, w0_IB_B)) + gained;
    turn_rate_ = real::sqrt(twice_T * body.I_BP_B_inverse.trace());  // the trace is at least the inverse of the smallest moment
  }
}

template <class T>
ClosedFormState<T> ExactMotion<T>::at(T t) const {
  if (const auto* body = std::get_if<FreeBody<T>>(&motion_)) return body->at(t);
  if (const auto* gyrostat = std::get_if<FreeGyrostat<T>>(&motion_)) return gyrostat->at(t);
  ClosedFormState<T> state = std::get<LagrangeTop<T>>(motion_).at(t);
  if (axis_ == 2) return state;
  state.q_NB = state.q_NB * q_BP_.conjugate();
  const Vec3<T> w_P = state.w_NB_B;
  for (int i = 0; i < 3; ++i) state.w_NB_B[(axis_ + 1 + i) % 3] = w_P[i];
  return state;
}

template <class T>
Quaternion<T> ExactMotion<T>::despun(const Quaternion<T>& q_NB, T t) const {
  return spin_ == T(0) ? q_NB : q_NB * steady_turn(2, T(-spin_), t);
}

template class ExactMotion<double>;
template class ExactMotion<float80>;
template class ExactMotion<float128>;

}  // namespace earthtop
