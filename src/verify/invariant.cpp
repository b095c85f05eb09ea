// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities that the exact motion conserves: the largest change over the rows, relative to the sum of the sizes of the
// quantity's terms.
#include <cmath>

#include "earthtop/model/invariants.hpp"
#include "earthtop/model/model.hpp"
#include "run/invariant_follower.hpp"
#include "text/number_words.hpp"
#include "verify/geometry.hpp"
#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

struct Term {
  double value;
  double scale;
};

/// One motion at one instant, in the variables that the integrals of special bodies use.
struct Instant {
  Vec3<double> w_B;   ///< rad/s
  Vec3<double> up_B;  ///< Up in body axes, gamma
  Vec3<double> L_B;   ///< kg m^2/s
  double c;           ///< m g l / I3, l along axis 1 (1/s^2)
};

/// (p^2 - q^2 - c g1)^2 + (2 p q - c g2)^2, for a body with I1 = I2 = 2 I3 and its centre of mass on axis 1. [S. Kowalevski,
/// Acta Math. 12 (1889) 177]
Term kovalevskaya(const Instant& i) {
  const double p = i.w_B[0], q = i.w_B[1];
  const double a = p * p - q * q - i.c * i.up_B[0], b = 2 * p * q - i.c * i.up_B[1];
  const double size = p * p + q * q + std::abs(i.c);
  return {a * a + b * b, size * size};
}

/// r (p^2 + q^2) - c p g3, for a body with I1 = I2 = 4 I3, its centre of mass on axis 1, and no angular momentum about the
/// vertical. [D. N. Goryachev 1900, S. A. Chaplygin 1901]
Term goryachev_chaplygin(const Instant& i) {
  const double p = i.w_B[0], q = i.w_B[1], r = i.w_B[2];
  return {r * (p * p + q * q) - i.c * p * i.up_B[2], std::abs(r) * (p * p + q * q) + std::abs(i.c * p)};
}

/// The angular momentum about Up: conserved without the Earth's rotation, and at a pole.
Term vertical_momentum(const Instant& i) { return {i.L_B.dot(i.up_B), norm(i.L_B)}; }

/// The rotating motion if the Earth's axis is vertical, else the reference.
Instant instant(const Model<double>& model, const DriftRow& row) {
  const bool vertical = model.W_IL_L[0] == 0 && model.W_IL_L[1] == 0;
  const Mat3<double> R_LB = rotation_matrix(quaternion(vertical ? row.q_LB : row.ref_q_LB));
  Vec3<double> w_IB_B = vector(vertical ? row.w_LB_B : row.ref_w_LB_B);
  if (vertical) w_IB_B += R_LB.transpose() * model.W_IL_L;
  const double torque = model.mass_moment_B[0] * norm(model.apparent_gravity_L);
  return {w_IB_B, R_LB.row(2).transpose(), model.I_BP_B * w_IB_B, torque / model.I_BP_B(2, 2)};
}

InvariantReport followed(const RunResult& result, Term (*integral)(const Instant&)) {
  const Model<double>& model = result.modelled.model<double>();
  InvariantFollower<double> follower({}, {});
  for (const DriftRow& row : result.rows) {
    const Term term = integral(instant(model, row));
    follower.include(term.value, term.scale);
  }
  return follower.report();
}

double relative_change(const InvariantReport& invariant) {
  return share_of(invariant.largest_change, invariant.scale).value_or(invariant.largest_change);
}

}  // namespace

double invariant_error(const CriterionSpec& criterion, Runs& runs) {
  const RunResult& result = runs.run(criterion.set);
  if (criterion.quantity == "kovalevskaya") return relative_change(followed(result, kovalevskaya));
  if (criterion.quantity == "goryachev_chaplygin") return relative_change(followed(result, goryachev_chaplygin));
  if (criterion.quantity == "vertical_momentum") return relative_change(followed(result, vertical_momentum));
  for (const InvariantReport& invariant : result.invariants)
    if (invariant.name == criterion.quantity) return relative_change(invariant);
  throw NotJudged("this scenario does not conserve it");
}

}  // namespace earthtop::verify_detail
