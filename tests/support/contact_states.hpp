// SPDX-License-Identifier: GPL-3.0-or-later
/// Random tops on tables and random states of them, for tests of the equations of contact. Units are natural: moments and rates
/// near 1.
#pragma once

#include <random>
#include <vector>

#include "earthtop/model/general_contact.hpp"
#include "earthtop/model/reduced_contact.hpp"

namespace earthtop::testing {

inline constexpr std::array kLaws{ContactLaw::frictionless, ContactLaw::viscous,   ContactLaw::viscous_load,
                                  ContactLaw::coulomb,      ContactLaw::contensou, ContactLaw::rolling};

/// The quantities that are varied besides the state.
struct ContactVariety {
  ContactLaw law;
  bool moments = false;   ///< spinning friction and rolling resistance
  bool weights = false;   ///< torques weighed by numbers other than 1
  bool gradient = false;  ///< a gradient of gravitation as large as the other terms
  bool symmetric = true;
  bool point_tip = false;
};

/// A top, what surrounds it, and a state of it.
template <class T>
struct ContactCase {
  Contact<T> contact;
  ContactSurroundings<T> around;
  Mat3<T> R_HB;
  Vec3<T> w;  ///< rate relative to the laboratory
  Vec3<T> v_P, p_O;

  ReducedContactState<T> reduced() const {
    const Vec3<T> n = R_HB.col(2), w_IB = w + around.W;
    const T w3 = inner(w_IB, n);
    return {n, Vec3<T>(w_IB - w3 * n), w3, v_P, p_O};
  }
  GeneralContactState<T> general() const { return {R_HB, times(turned_tensor(R_HB, contact.I_BC_B), w), v_P, p_O}; }
};

class ContactCases {
 public:
  explicit ContactCases(unsigned seed) : engine_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  template <class T>
  Vec3<T> vector(double size) {
    return {T(number(-size, size)), T(number(-size, size)), T(number(-size, size))};
  }
  /// An Earth rate of 0.5 in a random direction, gravity that does not lie along the table's normal, rates of 20.
  template <class T>
  ContactCase<T> make(const ContactVariety& variety) {
    ContactCase<T> made;
    Contact<T>& c = made.contact;
    c.law = variety.law;
    c.has_spinning_friction = c.has_rolling_resistance = variety.moments;
    c.has_gradient = variety.gradient, c.omits_torques = variety.weights;
    c.mass = T(number(10, 20));
    c.tip_radius = variety.point_tip ? T(0) : T(number(0.05, 0.2));
    c.viscosity = T(number(0.1, 2)), c.coefficient = T(number(0.1, 0.3)), c.slip_floor = T(number(0.1, 1));
    c.patch_radius = T(number(0.01, 0.1));
    c.slip_of_spin = T(8) / (T(3) * real::pi<T>()), c.spin_of_slip = T(15) * real::pi<T>() / T(16);
    c.moment_factor = T(3) * real::pi<T>() / T(16);
    c.spinning_length = T(number(0.01, 0.03)), c.rolling_length = T(number(0.01, 0.03)), c.rate_floor = T(number(0.1, 1));
    c.p_OC_B = variety.symmetric ? Vec3<T>(T(0), T(0), T(number(-0.2, 0.2))) : vector<T>(0.2);
    c.I1 = T(number(0.3, 1)), c.I3 = T(number(0.3, 0.6));
    c.I_BC_B = Vec3<T>(c.I1, variety.symmetric ? c.I1 : T(T(number(0.8, 1.2)) * c.I1), c.I3).asDiagonal();
    if (!variety.symmetric) c.I_BC_B(0, 1) = c.I_BC_B(1, 0) = T(number(-0.05, 0.05));
    for (int j = 0; j < 3; ++j) c.I_BC_B_inverse.col(j) = solved<T>(c.I_BC_B, Vec3<T>::Unit(j));
    c.S_BC_B = (c.I_BC_B.trace() / T(2)) * Mat3<T>::Identity() - c.I_BC_B;
    c.height_of_center = c.p_OC_B[2];
    if (variety.weights) c.weights = {T(number(0, 1)), T(1), T(number(0, 1))};
    c.gradient_H = Mat3<T>::Zero();
    if (variety.gradient) {
      const Vec3<T> a = vector<T>(0.5), b = vector<T>(0.5);
      c.gradient_H = a * a.transpose() - b * b.transpose();
    }
    Vec3<T> W = vector<T>(1);
    W *= T(0.5) / norm(W);
    made.around = {Vec3<T>::UnitZ(), Vec3<T>(T(number(-1, 1)), T(number(-1, 1)), T(-5)), W, c.gradient_H};
    made.R_HB = rotation_matrix(Quaternion<T>{T(number(0.2, 1)), vector<T>(0.5)});
    made.w = vector<T>(5) + T(number(-20, 20)) * Vec3<T>(made.R_HB.col(2));
    made.v_P = variety.law == ContactLaw::rolling ? Vec3<T>(Vec3<T>::Zero()) : vector<T>(1);
    made.v_P[2] = T(0);
    made.p_O = vector<T>(1);
    made.p_O[2] = c.tip_radius;
    return made;
  }

 private:
  std::mt19937 engine_;
};

/// All kinds of cases under a law.
inline std::vector<ContactVariety> varieties(ContactLaw law) {
  std::vector<ContactVariety> all;
  for (int bits = 0; bits < 32; ++bits) {
    ContactVariety v{law, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
    all.push_back(v);
  }
  return all;
}

}  // namespace earthtop::testing
