// SPDX-License-Identifier: GPL-3.0-or-later
// Motions that are given by elementary functions.
#include <algorithm>
#include <cmath>

#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/frames/earth.hpp"
#include "verify/formulas.hpp"
#include "verify/geometry.hpp"
#include "verify/scene.hpp"

namespace earthtop::verify_detail {

double balanced_axis_error(const RunResult& result) {
  const Vec3<double> start = vector(result.rows.front().axis_L), W_L = earth_rate_L(result.scene);
  double error = 0;
  for (const DriftRow& row : result.rows)
    error = worse(error, norm(Vec3<double>(vector(row.axis_L) - balanced_gyroscope_axis_L(start, W_L, row.t_s))));
  return error;
}

// The axis goes round Up at the rate that the release asks for. At a pole it does so in inertial space while the laboratory
// turns below it; elsewhere only the reference does so.
double steady_precession_error(const RunResult& result) {
  const Scenario& scenario = result.scene.scenario();
  const auto release = result.scene.release<double>();
  const Vec3<double> start = rotation_matrix(release.q_LB).col(2), W_L = earth_rate_L(result.scene);
  const auto rates = steady_precession_rates(symmetric_top(result.scene), release.w_XB_B[2], start[2]);
  if (!rates || scenario.release.precession == Precession::none || scenario.release.precession == Precession::given)
    throw NotJudged("the release asks for no steady precession");
  const bool at_pole = W_L[1] == 0 && release.X == RatesRelativeTo::inertial;
  const double rate =
      (scenario.release.precession == Precession::steady_fast ? rates->fast : rates->slow) - (at_pole ? W_L[2] : 0);
  double error = 0;
  for (const DriftRow& row : result.rows) {
    const Vec3<double> axis = Rotation<double>::about(Vec3<double>::UnitZ(), rate * row.t_s) * start;
    error = worse(error, norm(Vec3<double>(vector(at_pole ? row.axis_L : row.ref_axis_L) - axis)));
  }
  return error;
}

// cos(tilt) = 1 - 2 k^2 sech^2(g t): the top is released at the lowest point of the motion that tends to the vertical.
double homoclinic_tilt_error(const RunResult& result, double until_s) {
  const SymmetricTop<double> top = symmetric_top(result.scene);
  const double w3 = result.scene.release<double>().w_XB_B[2], f = w3 / critical_spin(top), g = upright_growth_rate(top, w3);
  double error = 0;
  for (const DriftRow& row : result.rows) {
    if (row.t_s > until_s) break;
    const double sech = 1 / real::cosh(g * row.t_s);
    error = worse(error, std::abs(row.ref_axis_L[2] - (1 - 2 * (1 - f * f) * sech * sech)));
  }
  return error;
}

// The rate goes once from one end of axis 2 to the other, as tanh, while its other components vary as sech.
double separatrix_rates_error(const RunResult& result, double until_s) {
  const Body<double>& body = result.scene.body<double>();
  if (!body.p_PBcm_B.isZero(0)) throw NotJudged("the formula is for a body without torque");
  const Mat3<double>& I = body.I_BP_B;
  const double a = I(0, 0), b = I(1, 1), c = I(2, 2), start = result.scene.release<double>().w_XB_B[0];
  if (!(a < b && b < c)) throw NotJudged("the formula is for moments in ascending order");
  const double w2 = start / std::sqrt(b * (c - b) / (a * (c - a))), p = w2 * std::sqrt((c - b) * (b - a) / (a * c));
  double error = 0;
  for (const DriftRow& row : result.rows) {
    if (row.t_s > until_s) break;
    const double sech = 1 / real::cosh(p * row.t_s);
    const Vec3<double> w(start * sech, w2 * real::tanh(p * row.t_s), w2 * std::sqrt(b * (b - a) / (c * (c - a))) * sech);
    error = worse(error, norm(Vec3<double>(vector(row.ref_w_LB_B) - w)));
  }
  return error / w2;
}

// Released at rest at cos(tilt) = u0, the axis falls to L - sqrt(L^2 - 2 L u0 + 1), L = (I3 w3)^2 / (4 I1 mgl), and rises to
// its cusp again. The extremes are taken as vertices of parabolas through three rows, with an error of (row step x nutation
// rate)^4 of the swing.
double cusp_tilts_error(const RunResult& result) {
  const SymmetricTop<double> top = symmetric_top(result.scene);
  const double momentum = top.I3 * result.scene.release<double>().w_XB_B[2], L = momentum * momentum / (4 * top.I1 * top.mgl);
  const double high = result.rows.front().ref_axis_L[2], low = L - std::sqrt(L * L - 2 * L * high + 1);
  double error = 0;
  int lows = 0, highs = 0;
  for (std::size_t i = 1; i + 1 < result.rows.size(); ++i) {
    const double a = result.rows[i - 1].ref_axis_L[2], b = result.rows[i].ref_axis_L[2], c = result.rows[i + 1].ref_axis_L[2];
    const bool is_low = b <= a && b <= c, is_high = b >= a && b >= c;
    if (!is_low && !is_high) continue;
    const double vertex = b - (c - a) * (c - a) / (8 * (a - 2 * b + c));
    error = worse(error, std::abs(vertex - (is_low ? low : high)));
    ++(is_low ? lows : highs);
  }
  if (lows < 2 || highs < 2) throw NotJudged("fewer than two falls and rises in this run");
  return error;
}

double reference_turned_error(const RunResult& result, double until_s) {
  const double rate = std::abs(result.scene.rotation_rate_rad_s());
  const Vec3<double> celestial = celestial_axis_L<double>(result.scene.site());
  double error = 0, largest = 0, apart = 0;
  for (const DriftRow& row : result.rows) {
    if (row.t_s > until_s) break;
    const double angle = rate * row.t_s, sine = norm(Vec3<double>(celestial.cross(vector(row.ref_axis_L))));
    const double axis = 2 * real::asin(sine * std::abs(real::sin(angle / 2)));
    const Rotation<double> turn = Rotation<double>::about(celestial, -result.scene.rotation_rate_rad_s() * row.t_s);
    largest = std::max(largest, angle);
    error = worse(error, worse(std::abs(row.drift_attitude_rad - angle), std::abs(row.drift_axis_rad - axis)));
    apart = worse(apart, attitude_distance(quaternion(row.q_LB), turn.quaternion() * quaternion(row.ref_q_LB)));
  }
  if (!(apart <= 2 * result.attitude_bound_rad))
    throw NotJudged("the attitudes are not those of the turned reference, within the run's own bound");
  return error / largest;
}

double critical_spin_of(const Scene& scene) {
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  return critical_spin<double>({inertia(0, 0), inertia(2, 2), scene.axial_gravity_torque_N_m()});
}

}  // namespace earthtop::verify_detail
