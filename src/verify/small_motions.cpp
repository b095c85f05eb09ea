// SPDX-License-Identifier: GPL-3.0-or-later
// Exact consequences of the linear equations for motions near the vertical.
#include <cmath>

#include "earthtop/closed_form/special_cases.hpp"
#include "verify/formulas.hpp"
#include "verify/geometry.hpp"
#include "verify/scene.hpp"

namespace earthtop::verify_detail {
namespace {

/// Direction of the plane of swing over the rows [from, to): the major axis of the second moments about their mean (rad).
double swing_plane(const std::vector<DriftRow>& rows, std::size_t from, std::size_t to) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  const double n = static_cast<double>(to - from);
  for (std::size_t i = from; i < to; ++i) x += rows[i].axis_L[0] / n, y += rows[i].axis_L[1] / n;
  for (std::size_t i = from; i < to; ++i) {
    const double dx = rows[i].axis_L[0] - x, dy = rows[i].axis_L[1] - y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  return real::atan2(2 * xy, xx - yy) / 2;
}

}  // namespace

// The squared tilt is a e^(2gt) + b e^(-2gt) + c. Its differences d over equal times h therefore obey d[k+1] + d[k-1] = 2
// cosh(2 g h) d[k]: three unknowns need not be fitted, and the growing part need not dominate first.
double growth_rate_error(const RunResult& result) {
  std::vector<double> d;
  for (std::size_t i = 1; i < result.rows.size(); ++i) {
    const auto square = [](const std::array<double, 3>& n) { return n[0] * n[0] + n[1] * n[1]; };
    d.push_back(square(result.rows[i].ref_axis_L) - square(result.rows[i - 1].ref_axis_L));
  }
  double sum = 0, squares = 0;
  for (std::size_t k = 1; k + 1 < d.size(); ++k) sum += d[k] * (d[k + 1] + d[k - 1]) / 2, squares += d[k] * d[k];
  const double computed = real::acosh(sum / squares) / (2 * result.scene.scenario().output_step_s);
  const double theory = upright_growth_rate(symmetric_top(result.scene), result.scene.release<double>().w_XB_B[2]);
  return std::abs(computed / theory - 1);
}

// Compares the planes of swing of the first and the last sixth of the run; each sixth should hold a whole number of swings.
double foucault_rate_error(const RunResult& result) {
  const Scenario& scenario = result.scene.scenario();
  const auto rate = foucault_rate(symmetric_top(result.scene), scenario.release.tilt_deg * real::pi<double>() / 180,
                                  earth_rate_L(result.scene));
  const std::size_t last = result.rows.size() - 1, window = last / 6;
  const double angle = swing_plane(result.rows, last - window, last) - swing_plane(result.rows, 0, window);
  const double between_s = result.rows[last - window].t_s;
  const double computed = std::remainder(angle, real::pi<double>()) / between_s;
  return std::abs(computed / rate.value - 1);
}

// An axis that is released at rest at its place of rest stays there.
double resting_axis_error(const RunResult& result) {
  const Vec3<double> W_L = earth_rate_L(result.scene);
  const auto release = result.scene.release<double>();
  const Vec3<double> W_B = rotation_matrix(release.q_LB).transpose() * W_L;
  const double w3 = release.w_XB_B[2] + (release.X == RatesRelativeTo::laboratory ? W_B[2] : 0);
  const Vec3<double> rest = resting_axis_L(symmetric_top(result.scene), w3, W_L);
  double error = 0;
  for (const DriftRow& row : result.rows) error = worse(error, norm(Vec3<double>(vector(row.axis_L) - rest)));
  return error / real::hypot(rest[0], rest[1]);
}

// The axis circles its place of rest. With the window sin^4 the mean of this circling is zero if the run is a whole number of
// turns long (at least three), and nearly zero if the run is long.
double mean_lean_error(const RunResult& result) {
  const Vec3<double> rest =
      resting_axis_L(symmetric_top(result.scene), result.scene.release<double>().w_XB_B[2], earth_rate_L(result.scene));
  double east = 0, north = 0, weights = 0;
  for (const DriftRow& row : result.rows) {
    const double sine = real::sin(real::pi<double>() * row.t_s / result.scene.scenario().duration_s),
                 weight = sine * sine * sine * sine;
    east += weight * row.axis_L[0], north += weight * row.axis_L[1], weights += weight;
  }
  return real::hypot(east / weights - rest[0], north / weights - rest[1]) / real::hypot(rest[0], rest[1]);
}

}  // namespace earthtop::verify_detail
