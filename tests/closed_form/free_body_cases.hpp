// SPDX-License-Identifier: GPL-3.0-or-later
/// Random motions of the free body, by regime.
#pragma once

#include <string>
#include <vector>

#include "closed_form/error_table.hpp"
#include "earthtop/closed_form/free_body.hpp"

namespace earthtop::test {

/// A body, its start and the time of evaluation; every number is exact in double.
struct FreeBodyCase {
  Vec3<double> moments = Vec3<double>::Ones();
  Vec3<double> products = Vec3<double>::Zero();  ///< I_23, I_13, I_12; unless zero, the body axes are not principal axes
  Quaternion<double> q0_NB;
  Vec3<double> w0_NB_B = Vec3<double>::Zero();
  double t_s = 0;
};

struct FreeBodyGenerator {
  std::string name;
  FreeBodyCase (*draw)(std::mt19937_64&);
};
const std::vector<FreeBodyGenerator>& free_body_generators();

template <class T>
FreeBody<T> free_body(const Vec3<T>& moments, const Vec3<T>& products, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B) {
  if (products[0] == T(0) && products[1] == T(0) && products[2] == T(0)) return FreeBody<T>(moments, q0_NB, w0_NB_B);
  Mat3<T> I;
  I << moments[0], products[2], products[1], products[2], moments[1], products[0], products[1], products[0], moments[2];
  return FreeBody<T>(I, q0_NB, w0_NB_B);
}

/// The case in any scalar type.
template <class T>
FreeBody<T> free_body(const FreeBodyCase& c) {
  const auto vector = [](const Vec3<double>& v) { return Vec3<T>(T(v[0]), T(v[1]), T(v[2])); };
  return free_body<T>(vector(c.moments), vector(c.products), Quaternion<T>{T(c.q0_NB.w), vector(c.q0_NB.v)}, vector(c.w0_NB_B));
}

Measure measure(const FreeBodyCase& c);
std::string to_string(const FreeBodyCase& c);

}  // namespace earthtop::test
