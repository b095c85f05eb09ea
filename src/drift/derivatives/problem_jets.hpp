// SPDX-License-Identifier: GPL-3.0-or-later
/// A problem whose coefficients carry their derivatives by some inputs. To be included before any header of the model.
#pragma once

#include "drift/derivatives/jet.hpp"
//
#include <array>

#include "drift/derivatives/problem_derivative.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/model/converted.hpp"

namespace earthtop {

using Jet = real::Jet<kInputsAtOnce>;
using Inputs = std::array<ProblemDerivative, kInputsAtOnce>;

namespace real {
template <>
constexpr Jet<kInputsAtOnce> pi_rest<Jet<kInputsAtOnce>>() {
  return pi_rest<double>();
}
}  // namespace real

/// Takes a coefficient to a jet whose derivatives are zero. Functions of time are left out: no input changes one.
struct ToJet {
  Jet operator()(double number) const { return number; }
  std::shared_ptr<const AngleSpline<Jet>> operator()(const std::shared_ptr<const AngleSpline<double>>&) const {
    return nullptr;
  }
  std::shared_ptr<const PiecewisePath<Jet>> operator()(const std::shared_ptr<const PiecewisePath<double>>&) const {
    return nullptr;
  }
  TideSeries<Jet> operator()(const TideSeries<double>&) const { return {}; }
  Journey<Jet> operator()(const Journey<double>&) const { return {}; }
  std::shared_ptr<const Journey<Jet>> operator()(const std::shared_ptr<const Journey<double>>&) const { return nullptr; }
};

/// A vector or a matrix with its derivatives.   @param member  takes a ProblemDerivative to its derivative of that quantity
template <class Derived, class Member>
auto with_derivatives(const Eigen::MatrixBase<Derived>& values, const Inputs& inputs, const Member& member) {
  Eigen::Matrix<Jet, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> jets;
  for (int i = 0; i < values.rows(); ++i)
    for (int j = 0; j < values.cols(); ++j) {
      jets(i, j) = values(i, j);
      for (std::size_t k = 0; k < inputs.size(); ++k) jets(i, j).d[k] = member(inputs[k])(i, j);
    }
  return jets;
}

/// Adds the derivative of a gradient tensor by input k to its terms. The torque of the terms depends on the sum of k_i u_i u_i^T
/// up to a multiple of the unit tensor alone, whether or not the u_i are unit vectors.
/// @param d  terms of the tensor's derivative   @param terms  those of the tensor, which may be zero
inline void differentiate_gradient(const std::array<GradientTerm<double>, 2>& d, std::size_t k,
                                   std::array<GradientTerm<Jet>, 2>& terms) {
  if (d[0].strength == 0 && d[1].strength == 0) return;
  const auto direction = [&](std::size_t i) {
    const Vec3<Jet>& u = terms[i].direction_L;
    return Vec3<double>(u[0].value, u[1].value, u[2].value);
  };
  const std::size_t first = terms[0].strength.value != 0 ? 0 : 1, second = 1 - first;
  const double k1 = terms[first].strength.value, k2 = terms[second].strength.value;
  if (k1 == 0) {
    for (std::size_t i = 0; i < 2; ++i)
      terms[i].strength.d[k] = d[i].strength, terms[i].direction_L = d[i].direction_L.cast<Jet>();
    return;
  }
  Mat3<double> tensor = Mat3<double>::Zero();
  for (const auto& term : d) tensor += term.strength * term.direction_L * term.direction_L.transpose();
  const Vec3<double> u1 = direction(first);
  Vec3<double> u2 = direction(second);
  if (k2 == 0) {  // any direction across u1 will do: the one in which the derivative has no part to be turned
    const Vec3<double> across = Vec3<double>(tensor * u1).cross(u1);
    u2 = norm(across) > 0 ? Vec3<double>(across / norm(across)) : u1.unitOrthogonal();
    terms[second].direction_L = u2.cast<Jet>();
  }
  const Vec3<double> u3 = u1.cross(u2), change1 = tensor * u1, change2 = tensor * u2;
  const double rest = u3.dot(tensor * u3);
  terms[first].strength.d[k] = u1.dot(change1) - rest;
  terms[second].strength.d[k] = u2.dot(change2) - rest;
  const auto turn = [&](std::size_t i, const Vec3<double>& by) {
    for (int j = 0; j < 3; ++j) terms[i].direction_L[j].d[k] = by[j];
  };
  turn(first, Vec3<double>((u2.dot(change1) * u2 + u3.dot(change1) * u3) / k1));
  if (k2 != 0) turn(second, Vec3<double>(u3.dot(change2) / k2 * u3));
}

/// The model without its functions of time.
inline Model<Jet> jets_of(const Model<double>& model, const Inputs& inputs) {
  Model<Jet> jets = converted<Jet>(model, ToJet());
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    using Gradient = std::array<GradientTerm<double>, 2>;
    const auto number = [k](double d, Jet& jet) { jet.d[k] = d; };
    const auto of_gradient = [k](const Gradient& d, std::array<GradientTerm<Jet>, 2>& terms) {
      differentiate_gradient(d, k, terms);
    };
    const auto of_model = ByKind{
        number,
        [k]<int rows, int columns>(const Eigen::Matrix<double, rows, columns>& d, Eigen::Matrix<Jet, rows, columns>& jet) {
          for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) jet(i, j).d[k] = d(i, j);
        },
        [&](const AppliedTorques<double>& d, AppliedTorques<Jet>& jet) {
          for_each_coefficient(number, of_gradient, d, jet);  // no input turns a gimbal on
          jet.any = jet.any || d.any;
        },
        [](const TideSeries<double>&, TideSeries<Jet>&) {}};
    for_each_derivative(of_model, inputs[k], jets);
  }
  jets.W_IL_L = jets.epsilon * jets.W_IL_L_scaled;
  return jets;
}

/// Numbers of a table with their derivatives.
template <template <class> class Struct>
Struct<Jet> jets_of(const Struct<double>& values, const Inputs& inputs, Struct<double> TableDerivative::*derivative) {
  auto jets = converted<Jet>(values, ToJet());
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for_each_number([k](double d, Jet& jet) { jet.d[k] = d; }, inputs[k].table.*derivative, jets);
  return jets;
}

inline NaturalRelease<Jet> jets_of(const NaturalRelease<double>& release, const Inputs& inputs) {
  NaturalRelease<Jet> jets;
  jets.q_LB.w = release.q_LB.w;
  for (std::size_t k = 0; k < inputs.size(); ++k) jets.q_LB.w.d[k] = inputs[k].q_LB.w;
  jets.q_LB.v = with_derivatives(release.q_LB.v, inputs, [](const ProblemDerivative& d) { return d.q_LB.v; });
  jets.w_XB_B = with_derivatives(release.w_XB_B, inputs, [](const ProblemDerivative& d) { return d.w_XB_B; });
  jets.X = release.X;
  return jets;
}

}  // namespace earthtop
