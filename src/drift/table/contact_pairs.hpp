// SPDX-License-Identifier: GPL-3.0-or-later
/// Vectors of both predictions, and what surrounds a top on a table in both: in laboratory axes, and turned with the Earth into
/// inertial ones.
#pragma once

#include "earthtop/integrate/options.hpp"
#include "earthtop/model/contact_forces.hpp"
#include "earthtop/model/equations.hpp"

namespace earthtop {

template <class T>
Vec3<Paired<T>> pair_of(const Vec3<T>& reference, const Vec3<T>& difference, const T& epsilon) {
  Vec3<Paired<T>> both;
  for (int i = 0; i < 3; ++i) both[i] = Paired<T>::apart(reference[i], difference[i], epsilon);
  return both;
}
template <class T>
Vec3<Paired<T>> unchanged(const Vec3<T>& v) {
  return {Paired<T>(v[0]), Paired<T>(v[1]), Paired<T>(v[2])};
}

/// The turn R_NH(t) of the rotating motion's table in inertial axes; that of the reference does not turn.
template <class T>
class EarthTurn {
 public:
  EarthTurn(const Model<T>& model, const T& t) {
    const LaboratoryTurn<T> turn = laboratory_turn(model, t);
    const Vec3<T> back = -turn.v_scaled;
    for (int j = 0; j < 3; ++j) {
      const Vec3<T> unit(T(j == 0 ? 1 : 0), T(j == 1 ? 1 : 0), T(j == 2 ? 1 : 0));
      column_[j] = pair_of(unit, turn_minus_one_scaled(turn.w, turn.v_scaled, model.epsilon, unit), model.epsilon);
      row_[j] = pair_of(unit, turn_minus_one_scaled(turn.w, back, model.epsilon, unit), model.epsilon);
    }
  }
  Vec3<Paired<T>> into_inertial(const Vec3<Paired<T>>& v) const { return combined(column_, v); }
  Vec3<Paired<T>> from_inertial(const Vec3<Paired<T>>& v) const { return combined(row_, v); }
  /// R m R^T
  Mat3<Paired<T>> into_inertial(const Mat3<T>& m) const {
    Mat3<Paired<T>> half, turned;
    for (int j = 0; j < 3; ++j) half.col(j) = into_inertial(unchanged<T>(m.col(j)));
    for (int i = 0; i < 3; ++i) turned.row(i) = combined(column_, Vec3<Paired<T>>(half.row(i).transpose())).transpose();
    return turned;
  }

 private:
  static Vec3<Paired<T>> combined(const Vec3<Paired<T>>* columns, const Vec3<Paired<T>>& v) {
    return v[0] * columns[0] + v[1] * columns[1] + v[2] * columns[2];
  }
  Vec3<Paired<T>> column_[3], row_[3];  ///< of R_NH: its columns, and those of its transpose
};

/// The surroundings of both motions at a time: the reference has no Earth rate, and its table does not turn.
/// @param model  in the table's axes   @param R_LH  attitude of these axes, for the tide
template <Observer O, class T>
ContactSurroundings<Paired<T>> contact_surroundings(const Model<T>& model, const Mat3<T>& R_LH, const Contact<T>& contact,
                                                    const T& t) {
  const Vec3<T> up(T(0), T(0), T(1));
  Vec3<T> gravity = model.apparent_gravity_L;
  if (!model.tide.empty()) gravity += transposed_times(R_LH, model.tide.acceleration_L(t));
  ContactSurroundings<Paired<T>> around;
  around.W = pair_of(Vec3<T>(Vec3<T>::Zero()), model.W_IL_L_scaled, model.epsilon);
  if constexpr (O == Observer::laboratory) {
    around.normal = unchanged<T>(up), around.gravity = unchanged<T>(gravity);
    if (contact.has_gradient)
      for (int j = 0; j < 3; ++j) around.gradient.col(j) = unchanged<T>(contact.gradient_H.col(j));
  } else {
    const EarthTurn<T> turn(model, t);
    around.normal = turn.into_inertial(unchanged<T>(up)), around.gravity = turn.into_inertial(unchanged<T>(gravity));
    if (contact.has_gradient) around.gradient = turn.into_inertial(contact.gradient_H);
  }
  return around;
}

}  // namespace earthtop
