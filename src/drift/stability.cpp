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
constexpr double kTaken = 0.25;        // share of the spin that friction takes from a motion next to a closed form, at most
constexpr double kEFoldings = 1;       // e-foldings that a weak torque could make in such a motion, at most

/// The inertial rates with which the two motions start, in body axes.
std::array<Vec3<double>, 2> inertial_rates(const MotionProblem<double>& problem) {
  const NaturalRelease<double> release = problem.natural_release();
  return {release.w_XB_B, release.inertial_rate_B(problem.model.W_IL_L)};
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

bool is_upright(const StandingTop& top) {
  return top.lean_rad <= kUpright && top.transverse_rate <= kUpright * top.falling_rate;
}

/// Whether a body is a symmetric top whose nutation, or swing, is so fast that the Earth's rotation cannot make it chaotic.
bool is_Lagrange_top(const MotionProblem<double>& problem) {
  const Model<double>& model = problem.model;
  if (symmetry_axis(model.I_BP_B, model.mass_moment_B) < 0) return false;
  const ReducedTop<double> top = reduced_top(model);
  const double nutation = std::abs(top.spin_ratio * problem.natural_release().w_XB_B[top.axis]);
  const double pendulum = std::sqrt(norm(model.apparent_gravity_L) * std::abs(top.moment_ratio));
  return norm(model.W_IL_L) <= kSlowEarth * std::max(nutation, pendulum);
}

/// Whether the motions of a top symmetric about axis 3 that start with these inertial rates are far from every separatrix.
bool is_regular_top(const MotionProblem<double>& problem, const std::array<Vec3<double>, 2>& rates_B) {
  const Model<double>& model = problem.model;
  if (symmetry_axis(model.I_BP_B, model.mass_moment_B) != 2) return false;
  const ReducedTop<double> top = reduced_top(model);
  const SymmetricTop<double> symmetric{top.I1, top.I3, model.mass_moment_B[2] * norm(model.apparent_gravity_L)};
  return std::ranges::all_of(rates_B, [&](const Vec3<double>& w_B) {
    const auto upright = standing_top(model, problem.release.q_LB, w_B);
    if (upright && is_upright(*upright) && upright->spin_ratio_squared < kSafelyAsleep) return false;
    return LagrangeTop<double>(symmetric, problem.release.q_LB, w_B).parameter() < kFarModulus;
  });
}

/// The largest rate of change of the torques of a tide, of the gravity gradient and of an unequal support with the top's
/// angles, divided by I1. In a resonance with the top's own motion a disturbance grows by at most about the exponent
/// sqrt(stiffness) t, as a pendulum's next to its upper equilibrium does [B. V. Chirikov, Phys. Rep. 52 (1979) 263, section
/// 2.4]. (natural units)
double stiffness_of_weak_torques(const Model<double>& model) {
  const ReducedTop<double> top = reduced_top(model);
  double stiffness = std::abs(top.moment_ratio) * model.tide.largest();
  for (const GradientTerm<double>& term : model.applied.gradient)
    stiffness += std::abs(term.strength * (top.I3 - top.I1) / top.I1);
  return stiffness + model.applied.support.largest() / top.I1;
}

/// The largest share of a symmetric top's spin that friction takes within a duration: all friction falls with the rate, so that
/// none takes more than it does at the rate of release.
double share_of_spin_taken(const MotionProblem<double>& problem, double duration) {
  const AppliedTorques<double>& applied = problem.model.applied;
  if (!applied.friction()) return 0;
  const Vec3<double> w = problem.natural_release().w_XB_B;
  const double spin = std::abs(w[2]);
  const double torque =
      (friction_coefficient(applied, w.dot(w)) + disc_drag_coefficient(applied, spin) + applied.viscous_3) * spin;
  return torque * duration / (problem.model.I_BP_B(2, 2) * spin);
}

}  // namespace

bool is_integrable(const MotionProblem<double>& problem) {
  if (problem.model.kind != SceneKind::plain) return false;
  return is_free(problem.model) || is_Lagrange_top(problem);
}

std::optional<StandingTop> standing_top(const Model<double>& model, const Quaternion<double>& q_LB,
                                        const Vec3<double>& w_IB_B) {
  const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B);
  if (axis < 0 || model.kind == SceneKind::gyrostat || is_free(model) || model.applied.level_axis ||
      norm(model.platform.pivot_offset_P) > 0)
    return std::nullopt;
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
  const auto top = standing_top(problem.model, problem.release.q_LB, problem.natural_release().w_XB_B);
  if (!top || !is_upright(*top)) return std::nullopt;
  return UprightTop{top->spin_ratio_squared};
}

std::optional<UprightTop> marginal_top(const MotionProblem<double>& problem) {
  constexpr double kCritical = 1e-3;  // of the square of the spin ratio
  const auto upright = upright_top(problem);
  return upright && std::abs(upright->spin_ratio_squared - 1) <= kCritical ? upright : std::nullopt;
}

bool is_regular(const MotionProblem<double>& problem) {
  if (!is_integrable(problem)) return false;
  if (!is_free(problem.model)) return is_regular_top(problem, inertial_rates(problem));
  if (symmetry_axis(problem.model.I_BP_B, Vec3<double>(Vec3<double>::Zero())) >= 0) return true;
  const PrincipalAxes<double> axes = principal_axes(problem.model.I_BP_B);
  return std::ranges::all_of(inertial_rates(problem),
                             [&](const Vec3<double>& w) { return free_modulus(axes, w) < kFarModulus; });
}

bool stays_regular(const MotionProblem<double>& problem, double duration_s) {
  const Model<double>& model = problem.model;
  if (model.kind == SceneKind::plain) return is_regular(problem);
  const bool rests = model.platform.turn.never_turns() && norm(model.platform.pivot_offset_P) == 0;
  if (!rests || !is_reducible_when_driven(model) || model.applied.given.acts || is_free(model) || !is_Lagrange_top(problem))
    return false;
  const double duration = problem.units.time_from_s(duration_s);
  if (std::sqrt(stiffness_of_weak_torques(model)) * duration > kEFoldings) return false;
  const double taken = share_of_spin_taken(problem, duration);
  if (!(taken <= kTaken)) return false;
  std::array<Vec3<double>, 2> slower = inertial_rates(problem);
  for (Vec3<double>& w : slower) w[2] *= 1 - taken;
  return is_regular_top(problem, inertial_rates(problem)) && is_regular_top(problem, slower);
}

std::optional<double> growth_tolerance(const MotionProblem<double>& problem, double duration_s) {
  constexpr double kClose = 1e-13;
  if (marginal_top(problem) || stays_regular(problem, duration_s)) return std::nullopt;
  return is_integrable(problem) ? kClose : kCoarseGrowthTolerance;
}

}  // namespace earthtop
