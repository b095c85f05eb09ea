// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/interpolate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace earthtop::compare {
namespace {

/// The slope at b of the parabola through a, b and c, in column i.
double slope(const Row& a, const Row& b, const Row& c, std::size_t i) {
  const double to_a = a.t_s - b.t_s, to_c = c.t_s - b.t_s;
  const double secant_a = (a.value[i] - b.value[i]) / to_a, secant_c = (c.value[i] - b.value[i]) / to_c;
  return (secant_a * to_c - secant_c * to_a) / (to_c - to_a);
}

/// The slope at `end` of the span from `end` to `other`. It is that of the parabola through `outer`, `end` and `other`; where
/// `outer` is missing (the same row as `end`), through `end`, `other` and `behind`; where that is missing, too, of the straight
/// line.
double slope_at_end(const Row& outer, const Row& end, const Row& other, const Row& behind, std::size_t i) {
  if (outer.t_s != end.t_s) return slope(outer, end, other, i);
  if (behind.t_s != other.t_s) return slope(other, end, behind, i);
  return (other.value[i] - end.value[i]) / (other.t_s - end.t_s);
}

double hermite(const Row& a, const Row& b, std::size_t i, double slope_a, double slope_b, double t_s) {
  const double h = b.t_s - a.t_s, x = (t_s - a.t_s) / h, y = 1 - x;
  return y * y * (1 + 2 * x) * a.value[i] + x * x * (1 + 2 * y) * b.value[i] + h * x * y * (y * slope_a - x * slope_b);
}

/// The first columns of one motion's attitude, rates and axis.
struct Motion {
  std::size_t attitude, rates, axis;
};

bool are_numbers(const Row& row, std::size_t first, std::size_t count) {
  return std::all_of(row.kind.data() + first, row.kind.data() + first + count,
                     [](CellKind kind) { return kind == CellKind::number; });
}

/// Gives the quaternion of row b the sign that is nearer to that of row a; both signs are the same attitude.
void near_sign(const Row& a, Row& b, std::size_t attitude) {
  double cosine = 0;
  for (std::size_t i = attitude; i < attitude + 4; ++i) cosine += a.value[i] * b.value[i];
  if (cosine < 0)
    for (std::size_t i = attitude; i < attitude + 4; ++i) b.value[i] = -b.value[i];
}

/// dq/dt = q w / 2, w in body axes; the axis moves by w_L x axis.
struct Slopes {
  Eigen::Quaterniond attitude;
  Eigen::Vector3d axis;
};
Slopes slopes_of(const Row& row, const Motion& motion) {
  const double* q = row.value.data() + motion.attitude;
  const double* w = row.value.data() + motion.rates;
  const Eigen::Quaterniond q_LB(q[0], q[1], q[2], q[3]);
  Eigen::Quaterniond turn = q_LB * Eigen::Quaterniond(0, w[0], w[1], w[2]);
  turn.coeffs() *= 0.5;
  const Eigen::Vector3d w_L = q_LB.normalized() * Eigen::Vector3d(w[0], w[1], w[2]);
  const double* axis = row.value.data() + motion.axis;
  return {turn, w_L.cross(Eigen::Vector3d(axis[0], axis[1], axis[2]))};
}

/// Interpolates attitude and axis with slopes from the rates; does nothing where attitude or rates are missing.
void interpolate_motion(const Row& a, const Row& b, const Motion& motion, double t_s, Row& between) {
  for (const Row* row : {&a, &b})
    if (!are_numbers(*row, motion.attitude, 4) || !are_numbers(*row, motion.rates, 3)) return;
  const Slopes at_a = slopes_of(a, motion), at_b = slopes_of(b, motion);
  const double qa[] = {at_a.attitude.w(), at_a.attitude.x(), at_a.attitude.y(), at_a.attitude.z()};
  const double qb[] = {at_b.attitude.w(), at_b.attitude.x(), at_b.attitude.y(), at_b.attitude.z()};
  double norm = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double& q = between.value[motion.attitude + i];
    q = hermite(a, b, motion.attitude + i, qa[i], qb[i], t_s);
    norm += q * q;
  }
  for (std::size_t i = 0; i < 4; ++i) between.value[motion.attitude + i] /= std::sqrt(norm);
  if (!are_numbers(a, motion.axis, 3) || !are_numbers(b, motion.axis, 3)) return;
  norm = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double& n = between.value[motion.axis + i];
    n = hermite(a, b, motion.axis + i, at_a.axis[static_cast<Eigen::Index>(i)], at_b.axis[static_cast<Eigen::Index>(i)], t_s);
    norm += n * n;
  }
  for (std::size_t i = 0; i < 3; ++i) between.value[motion.axis + i] /= std::sqrt(norm);
}

}  // namespace

Row interpolate(const std::array<const Row*, 4>& rows, double t_s) {
  const Row &before = *rows[0], &a = *rows[1], &after = *rows[3];
  Row b = *rows[2];
  const Table& table = trajectory_table();
  static const Motion kRotating = {*table.find("q_LB_w"), *table.find("w_LB_B_x_rad_s"), *table.find("axis_L_x")};
  static const Motion kReference = {*table.find("ref_q_LB_w"), *table.find("ref_w_LB_B_x_rad_s"), *table.find("ref_axis_L_x")};
  for (const Motion& motion : {kRotating, kReference}) near_sign(a, b, motion.attitude);
  Row between;
  between.t_s = t_s;
  for (std::size_t i = 0; i < Row::kMostColumns; ++i) {
    between.kind[i] = std::max(a.kind[i], b.kind[i]);
    if (between.kind[i] != CellKind::number) continue;
    const Row& left = before.kind[i] == CellKind::number ? before : a;
    const Row& right = after.kind[i] == CellKind::number ? after : b;
    between.value[i] = hermite(a, b, i, slope_at_end(left, a, b, right, i), slope_at_end(right, b, a, left, i), t_s);
  }
  for (const Motion& motion : {kRotating, kReference}) interpolate_motion(a, b, motion, t_s, between);
  const std::size_t reliable = *table.find("drift_reliable");
  between.value[reliable] = std::min(a.value[reliable], b.value[reliable]);
  static const std::size_t kState = *table.find("contact_state");
  between.value[kState] = a.value[kState];
  return between;
}

}  // namespace earthtop::compare
