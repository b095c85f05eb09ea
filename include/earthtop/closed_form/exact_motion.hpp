// SPDX-License-Identifier: GPL-3.0-or-later
/// Decides whether the whole motion of a model has a closed form, and gives that motion in inertial axes: one interface to the
/// free body, the heavy symmetric top and the free gyrostat.
#pragma once

#include <variant>

#include "earthtop/closed_form/exact_kind.hpp"
#include "earthtop/closed_form/free_body.hpp"
#include "earthtop/closed_form/free_gyrostat.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/model/converted.hpp"
#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

template <class T>
ExactKind exact_kind(const Model<T>& model);
extern template ExactKind exact_kind(const Model<double>&);
extern template ExactKind exact_kind(const Model<float80>&);
extern template ExactKind exact_kind(const Model<float128>&);

/// A rotor on a body axis, whose momentum along plus this axis stays what it is at the start.
template <class T>
struct ExactRotor {
  int axis = -1;        ///< of the body; -1 without a rotor
  bool driven = false;  ///< whether a motor keeps its rate
  T axial = T(0);       ///< its moment of inertia about the axis
  T sign = T(1);        ///< 1 if its axis is plus the body's, else -1
  T spin = T(0);        ///< its rate relative to the body at the start
  EARTHTOP_MEMBERS(axis, driven, axial, sign, spin)

  T momentum(const Vec3<T>& w0_B) const { return axial * ((driven ? T(0) : w0_B[axis]) + sign * spin); }
  /// The rate relative to the body where the body's rate has changed by a difference; and so the angle from the difference of turns.
  T minus_body(const T& difference) const { return driven ? T(0) : T(-sign * difference); }
};

/// The parameters of a model on which its motion depends, in the model's units.
template <class T>
struct ExactBody {
  ExactKind kind = ExactKind::free_body;
  Mat3<T> I_BP_B;          ///< inertia about the pivot
  Mat3<T> I_BP_B_inverse;  ///< its inverse
  int axis = -1;           ///< the body axis of symmetry, -1 if there is none
  SymmetricTop<T> top;     ///< only for ExactKind::symmetric_top
  ExactRotor<T> rotor;     ///< only for ExactKind::free_gyrostat
  EARTHTOP_MEMBERS(kind, I_BP_B, I_BP_B_inverse, axis, top, rotor)

  /// The same parameters in another scalar type.
  template <class To>
  ExactBody<To> as() const {
    return converted<To>(*this, [](const T& number) { return static_cast<To>(number); });
  }
};
/// @throws std::logic_error for a model without a closed form
template <class T>
ExactBody<T> exact_body(const Model<T>& model);
extern template ExactBody<double> exact_body(const Model<double>&);
extern template ExactBody<float80> exact_body(const Model<float80>&);
extern template ExactBody<float128> exact_body(const Model<float128>&);

/// The motion in the inertial axes N that coincide with the laboratory's at t = 0. `seen_from_laboratory` (special_cases.hpp)
/// converts it to a laboratory that rotates at any rate, provided that the *inertial* rate at the start is given here.
template <class T>
class ExactMotion {
 public:
  /// @param q0_NB  attitude at t = 0   @param w0_IB_B  inertial rate at t = 0, in the units of the body
  ExactMotion(const ExactBody<T>& body, const Quaternion<T>& q0_NB, const Vec3<T>& w0_IB_B);

  ClosedFormState<T> at(T t) const;
  /// Of a body with a rotor: how far it has turned about the body axis of the rotor.
  AxialTurn<T> axial_turn(T t) const { return std::get<FreeGyrostat<T>>(motion_).axial_turn(t); }

  /// The attitude with the spin about body axis 3 removed if that is the axis of symmetry, else the attitude itself. It turns
  /// slowly enough to be followed in steps when the sign of the quaternion must stay continuous.
  Quaternion<T> despun(const Quaternion<T>& q_NB, T t) const;
  /// Upper bound of the rate at which `despun` and body axis 3 turn.
  T turn_rate() const { return turn_rate_; }

 private:
  std::variant<FreeBody<T>, LagrangeTop<T>, FreeGyrostat<T>> motion_;
  Quaternion<T> q_BP_;  ///< P are axes whose axis 3 is the axis of symmetry
  int axis_;
  T spin_ = T(0);  ///< rate about body axis 3, if the top is symmetric about it; else 0
  T turn_rate_ = T(0);
};

extern template class ExactMotion<double>;
extern template class ExactMotion<float80>;
extern template class ExactMotion<float128>;

}  // namespace earthtop
