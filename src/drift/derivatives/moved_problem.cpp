// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/moved_problem.hpp"

#include <array>

#include "drift/derivatives/problem_derivative.hpp"

namespace earthtop {
namespace {

using Gradient = std::array<GradientTerm<double>, 2>;

/// Adds two gradient tensors.
Gradient sum_of(const Gradient& a, double h, const Gradient& b) {
  Gradient sum = b;
  bool alike = true;
  for (std::size_t i = 0; i < 2; ++i) {
    alike = alike && (a[i].strength == 0 || b[i].strength == 0 || a[i].direction_L == b[i].direction_L);
    if (b[i].strength == 0) sum[i].direction_L = a[i].direction_L;
    sum[i].strength = a[i].strength + h * b[i].strength;
  }
  if (alike) return sum;
  Mat3<double> tensor = Mat3<double>::Zero();
  for (const auto& term : a) tensor += term.strength * term.direction_L * term.direction_L.transpose();
  for (const auto& term : b) tensor += h * term.strength * term.direction_L * term.direction_L.transpose();
  return gradient_terms(tensor);
}

/// Adds h times the torques of an input.
void add(double h, const AppliedTorques<double>& d, AppliedTorques<double>& applied) {
  for_each_coefficient([h](double coefficient, double& sum) { sum += h * coefficient; },
                       [h](const Gradient& gradient, Gradient& sum) {
                         if (gradient[0].strength != 0 || gradient[1].strength != 0) sum = sum_of(sum, h, gradient);
                       },
                       d, applied);  // no input turns a gimbal on
  applied.any = true;
}

}  // namespace

bool adds_torque(const ProblemDerivative& d) { return d.applied.any || !d.tide.empty(); }

bool changes_rate_only(const ProblemDerivative& d) {
  return norm(d.W_IL_L_scaled) > 0 && d.I_BP_B.isZero(0) && norm(d.mass_moment_B) == 0 && norm(d.apparent_gravity_L) == 0 &&
         d.q_LB.w == 0 && norm(d.q_LB.v) == 0 && norm(d.w_XB_B) == 0 && !adds_torque(d);
}

ProblemDerivative centrifugal_as_gradient(const Vec3<double>& W_L) {
  ProblemDerivative d;
  d.applied.any = true;
  d.applied.gradient[0] = {-1, W_L / norm(W_L)};
  return d;
}

DriftProblem<double> moved(const DriftProblem<double>& problem, const ProblemDerivative& d, double h) {
  DriftProblem<double> p = problem;
  Model<double>& model = p.model;
  const auto move = ByKind{[h](double derivative, double& number) { number += h * derivative; },
                           [h]<int rows, int columns>(const Eigen::Matrix<double, rows, columns>& derivative,
                                                      Eigen::Matrix<double, rows, columns>& m) { m += h * derivative; },
                           [&](const AppliedTorques<double>& torques, AppliedTorques<double>& applied) {
                             if (adds_torque(d)) add(h, torques, applied);
                           },
                           [](const TideSeries<double>&, TideSeries<double>&) {}};
  for_each_derivative(move, d, model);
  if (!d.I_BP_B.isZero(0)) model.I_BP_B_inverse = model.I_BP_B.inverse();
  model.W_IL_L = model.epsilon * model.W_IL_L_scaled;
  if (adds_torque(d) && model.kind == SceneKind::plain) model.kind = SceneKind::full;
  Release<double>& release = p.release;
  if (d.q_LB.w != 0 || norm(d.q_LB.v) != 0)
    release.q_LB = Quaternion<double>{release.q_LB.w + h * d.q_LB.w, release.q_LB.v + h * d.q_LB.v}.normalized();
  for (int i = 0; i < 3; ++i) release.w_XB_B[i] += problem.units.rate_to_rad_s(h * d.w_XB_B[i]);
  return p;
}

}  // namespace earthtop
