// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/moved_problem.hpp"

#include <array>

namespace earthtop {
namespace {

/// Adds two gradient tensors.
std::array<GradientTerm<double>, 2> sum_of(const std::array<GradientTerm<double>, 2>& a, double h,
                                           const std::array<GradientTerm<double>, 2>& b) {
  std::array<GradientTerm<double>, 2> sum = b;
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
  Model<double>& m = p.model;
  if (!d.I_BP_B.isZero(0)) {
    m.I_BP_B += h * d.I_BP_B;
    m.I_BP_B_inverse = m.I_BP_B.inverse();
    m.S_BP_B += h * d.S_BP_B;
  }
  m.mass_moment_B += h * d.mass_moment_B;
  m.apparent_gravity_L += h * d.apparent_gravity_L;
  m.W_IL_L_scaled += h * d.W_IL_L_scaled;
  m.W_IL_L = m.epsilon * m.W_IL_L_scaled;
  Release<double>& release = p.release;
  if (d.q_LB.w != 0 || norm(d.q_LB.v) != 0)
    release.q_LB = Quaternion<double>{release.q_LB.w + h * d.q_LB.w, release.q_LB.v + h * d.q_LB.v}.normalized();
  for (int i = 0; i < 3; ++i) release.w_XB_B[i] += problem.units.rate_to_rad_s(h * d.w_XB_B[i]);
  if (!adds_torque(d)) return p;
  m.kind = SceneKind::full;
  AppliedTorques<double>& applied = m.applied;
  applied.any = true;
  applied.viscous += h * d.applied.viscous, applied.quadratic += h * d.applied.quadratic;
  applied.coulomb += h * d.applied.coulomb;
  applied.gimbal_damping += h * d.applied.gimbal_damping;
  applied.disc_laminar += h * d.applied.disc_laminar, applied.disc_turbulent += h * d.applied.disc_turbulent;
  if (d.applied.gradient[0].strength != 0 || d.applied.gradient[1].strength != 0)
    applied.gradient = sum_of(applied.gradient, h, d.applied.gradient);
  return p;
}

}  // namespace earthtop
