// SPDX-License-Identifier: GPL-3.0-or-later
/// Masses that ride on a body, or on another carrier, and that motors move on given paths. What they add to the equations are a few sums
/// over them, all about the pivot and in the carrier's axes, with p and p' the place and the velocity of a mass m as seen from there:
///
///   S = sum m p p^T ,  mu = sum m p ,  l = sum m p x p' ,  J = sum m p p'^T ,  dl/dt = sum m p x p''
///
/// S and mu change what the body's own tensors are; l is a momentum inside the body; and J is the velocity moment of [F] (torques.hpp),
/// which vanishes for a rigid body seen from itself. Its symmetric part is (dS/dt)/2, and tr J = (d tr S/dt)/2 is not 0 while mass moves
/// away from the pivot or toward it; its antisymmetric part is l. [F]'s Coriolis torque of it, for an observer who turns at w with
/// the carrier, is -(dTheta/dt) w - w x l: the change of inertia, and the gyroscopic torque of what turns inside.
#pragma once

#include <vector>

#include "earthtop/model/mass_path.hpp"
#include "earthtop/model/moving_masses_spec.hpp"

namespace earthtop {

/// The sums over all masses on one carrier, at one time.
template <class T>
struct MassSums {
  Mat3<T> second_moment = Mat3<T>::Zero();    ///< S
  Mat3<T> velocity_moment = Mat3<T>::Zero();  ///< J
  Vec3<T> mass_moment = Vec3<T>::Zero();      ///< mu
  Vec3<T> momentum = Vec3<T>::Zero();         ///< l
  Vec3<T> momentum_rate = Vec3<T>::Zero();    ///< dl/dt, seen from the carrier
  EARTHTOP_MEMBERS(second_moment, velocity_moment, mass_moment, momentum, momentum_rate)

  /// dTheta/dt, seen from the carrier.
  Mat3<T> inertia_rate() const;
};

/// The inertia of a second moment: Theta = tr(S) 1 - S.
template <class T>
Mat3<T> inertia_of(const Mat3<T>& S) {
  const T trace = S(0, 0) + S(1, 1) + S(2, 2);
  Mat3<T> Theta = -S;
  for (int i = 0; i < 3; ++i) Theta(i, i) += trace;
  return Theta;
}
template <class T>
Mat3<T> MassSums<T>::inertia_rate() const {
  return inertia_of(Mat3<T>(velocity_moment + velocity_moment.transpose()));
}

/// All masses that move on one carrier. Those that do not belong to the carrier's own tensors.
template <class T>
struct MovingMasses {
  std::vector<MassOnPath<T>> masses;
  MassSums<T> at_release;  ///< the sums at t = 0, which the carrier's own tensors contain
  EARTHTOP_MEMBERS(masses, at_release)

  bool any() const { return !masses.empty(); }
  MassSums<T> sums(const T& t) const {
    MassSums<T> sums;
    for (const MassOnPath<T>& one : masses) {
      const auto [place, velocity, acceleration] = one.at(t);
      const Vec3<T> moment = one.mass * place;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          sums.second_moment(i, j) += i <= j ? moment[i] * place[j] : moment[j] * place[i];
          sums.velocity_moment(i, j) += moment[i] * velocity[j];
        }
      sums.mass_moment += moment;
      sums.momentum += moment.cross(velocity);
      sums.momentum_rate += moment.cross(acceleration);
    }
    return sums;
  }
  /// The times at which a path has no higher derivatives, of all paths and in no order.
  std::vector<T> joints() const {
    std::vector<T> times;
    for (const MassOnPath<T>& one : masses)
      if (one.pieces)
        for (const T& joint : one.pieces->joints()) times.push_back(joint);
    return times;
  }
};

/// The cubic splines of three coordinates, or of a vector's three components, as a path.   @param tables  with the same times
template <class T>
PiecewisePath<T> path_of_tables(const std::array<std::shared_ptr<const AngleTable>, 3>& tables);

/// The masses on a carrier, in SI units.   @param only_moving  whether those that are fixed to it are left out
template <class T>
MovingMasses<T> make_masses(const std::vector<MovingMassSpec>& specs, MassCarrier carrier, bool only_moving);

/// The same masses in units of 2^mass_exponent kg and 2^time_exponent s.
template <class T>
MovingMasses<T> in_units(MovingMasses<T> masses, int mass_exponent, int time_exponent);
#define EARTHTOP_MASSES(T)                                                                                  \
  extern template PiecewisePath<T> path_of_tables(const std::array<std::shared_ptr<const AngleTable>, 3>&); \
  extern template MovingMasses<T> make_masses(const std::vector<MovingMassSpec>&, MassCarrier, bool);       \
  extern template MovingMasses<T> in_units(MovingMasses<T>, int, int);
EARTHTOP_MASSES(double)
EARTHTOP_MASSES(float80)
EARTHTOP_MASSES(float128)
#undef EARTHTOP_MASSES

/// The inverse of a symmetric tensor by cofactors, in few operations: it is taken at each evaluation of the equations.
template <class T>
Mat3<T> inverse_by_cofactors(const Mat3<T>& m) {
  const T c00 = m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2), c01 = m(0, 2) * m(1, 2) - m(0, 1) * m(2, 2),
          c02 = m(0, 1) * m(1, 2) - m(0, 2) * m(1, 1), c11 = m(0, 0) * m(2, 2) - m(0, 2) * m(0, 2),
          c12 = m(0, 1) * m(0, 2) - m(0, 0) * m(1, 2), c22 = m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1);
  const T reciprocal = T(1) / (m(0, 0) * c00 + m(0, 1) * c01 + m(0, 2) * c02);
  Mat3<T> inverse;
  inverse << c00, c01, c02, c01, c11, c12, c02, c12, c22;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse(i, j) = reciprocal * inverse(i, j);
  return inverse;
}

}  // namespace earthtop
