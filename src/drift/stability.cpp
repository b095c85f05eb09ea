// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/stability.hpp"

#include <algorithm>
#include <cmath>

#include "closed_form/principal_axes.hpp"
#include "earthtop/closed_form/exact_motion.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {
namespace {

constexpr double kUpright = 0.05;      // largest lean (rad), and largest transverse rate in units of the falling rate
constexpr double kFarModulus = 0.9;    // k^2 of a motion far from its separatrix, at most
constexpr double kSafelyAsleep = 1.2;  // square of the spin ratio of an upright top far from its separatrix, at least
constexpr double kSlowEarth = 0.01;    // the Earth's rate over the nutation's, at most

Vec3<double> release_rate(const MotionProblem<double>& problem) {
  return problem.units.rate_from_rad_s(problem.release.w_XB_B);
}

/// The inertial rates with which the two motions start, in body axes.
std::array<Vec3<double>, 2> inertial_rates(const MotionProblem<double>& problem) {
  const Vec3<double> w = release_rate(problem);
  const Vec3<double> W_B = transposed_times(rotation_matrix(problem.release.q_LB), problem.model.W_IL_L);
  return {w, problem.release.X == RatesRelativeTo::laboratory ? Vec3<double>(w + W_B) : w};
}

bool is_free(const Model<double>& model) { return norm(model.mass_moment_B) == 0 || norm(model.apparent_gravity_L) == 0; }

/// The squared modulus of the elliptic functions that solve Euler's equations: k^2 = (B - A)(2 T C - L^2) / ((C - B)(L^2 - 2 T
/// A)) or its inverse, whichever is smaller, with moments A < B < C, twice the energy 2 T and momentum L; 1 on the separatrix.
double free_modulus(const PrincipalAxes<double>& axes, const Vec3<double>& w_B) {
  const Vec3<double> w = transposed_times(rotation_matrix(axes.q_BP), w_B);
  std::array<std::pair<double, double>, 3> sorted;  // moment, rate
  for (std::size_t i = 0; i < 3; ++i) sorted[i] = {axes.moments[static_cast<int>(i)], w[static_cast<int>(i)]};
  std::sort(sorted.begin(), sorted.end());
  const auto [a, b, c] = sorted;
  const double A = a.first, B = b.first, C = c.first;
  const auto square = [](double x) { return x * x; };
  const double above = (B - A) * (A * (C - A) * square(a.second) + B * (C - B) * square(b.second));
  const double below = (C - B) * (B * (B - A) * square(b.second) + C * (C - A) * square(c.second));
  const double larger = std::max(above, below);
  return larger > 0 ? std::min(above, below) / larger : 0;
}

}  // namespace

bool is_integrable(const MotionProblem<double>& problem) {
  const Model<double>& model = problem.model;
  if (model.kind != SceneKind::plain) return false;
  if (is_free(model)) return true;
  if (!is_reducible(model)) return false;
  const ReducedTop<double> top = reduced_top(model);
  const double nutation = std::abs(top.spin_ratio * release_rate(problem)[top.axis]);
  const double pendulum = std::sqrt(norm(model.apparent_gravity_L) * std::abs(top.moment_ratio));
  return norm(model.W_IL_L) <= kSlowEarth * std::max(nutation, pendulum);
}

std::optional<StandingTop> standing_top(const Model<double>& model, const Quaternion<double>& q_LB,
                                        const Vec3<double>& w_IB_B) {
  const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B);
  if (axis < 0 || is_free(model) || model.applied.level_axis || norm(model.platform.pivot_offset_P) > 0) return std::nullopt;
  const double mgl = model.mass_moment_B[axis] * norm(model.apparent_gravity_L);
  const Vec3<double> n_L = rotation_matrix(q_LB).col(axis);
  const double I1 = model.I_BP_B((axis + 1) % 3, (axis + 1) % 3), momentum = model.I_BP_B(axis, axis) * w_IB_B[axis];
  StandingTop top;
  top.spin_ratio_squared = momentum * momentum / (4 * std::abs(mgl) * I1);
  top.lean_rad = mgl * n_L[2] > 0 ? real::hypot(n_L[0], n_L[1]) : 2;
  top.transverse_rate = real::hypot(w_IB_B[(axis + 1) % 3], w_IB_B[(axis + 2) % 3]);
  top.falling_rate = std::sqrt(std::abs(mgl) / I1);
  return top;
}

std::optional<UprightTop> upright_top(const MotionProblem<double>& problem) {
  if (problem.model.kind != SceneKind::plain) return std::nullopt;
  const auto top = standing_top(problem.model, problem.release.q_LB, release_rate(problem));
  if (!top || top->lean_rad > kUpright || top->transverse_rate > kUpright * top->falling_rate) return std::nullopt;
  return UprightTop{top->spin_ratio_squared};
}

std::optional<UprightTop> marginal_top(const MotionProblem<double>& problem) {
  constexpr double kCritical = 1e-3;  // of the square of the spin ratio
  const auto upright = upright_top(problem);
  return upright && std::abs(upright->spin_ratio_squared - 1) <= kCritical ? upright : std::nullopt;
}

bool is_regular(const MotionProblem<double>& problem) {
  const Model<double>& model = problem.model;
  if (!is_integrable(problem)) return false;
  const auto far = [&](auto modulus) {
    const auto rates = inertial_rates(problem);
    return std::all_of(rates.begin(), rates.end(), [&](const Vec3<double>& w) { return modulus(w) < kFarModulus; });
  };
  if (is_free(model)) {
    if (symmetry_axis(model.I_BP_B, Vec3<double>(Vec3<double>::Zero())) >= 0) return true;
    const auto axes = principal_axes(model.I_BP_B);
    return far([&](const Vec3<double>& w) { return free_modulus(axes, w); });
  }
  if (symmetry_axis(model.I_BP_B, model.mass_moment_B) != 2) return false;
  if (const auto upright = upright_top(problem); upright && upright->spin_ratio_squared < kSafelyAsleep) return false;
  const ReducedTop<double> top = reduced_top(model);
  const SymmetricTop<double> symmetric{top.I1, top.I3, model.mass_moment_B[2] * norm(model.apparent_gravity_L)};
  return far([&](const Vec3<double>& w) { return LagrangeTop<double>(symmetric, problem.release.q_LB, w).parameter(); });
}

std::optional<double> growth_tolerance(const MotionProblem<double>& problem) {
  constexpr double kClose = 1e-13;
  if (marginal_top(problem) || is_regular(problem)) return std::nullopt;
  return is_integrable(problem) ? kClose : kCoarseGrowthTolerance;
}

}  // namespace earthtop
