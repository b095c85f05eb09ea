// SPDX-License-Identifier: GPL-3.0-or-later
// The cost of one integration whose options are known, before any of it is done.
#include <algorithm>
#include <cmath>

#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

/// Returns the work of a closed form: at each row two or three evaluations in 113 bits, and between rows as many evaluations in
/// double as are needed to count full turns of the angles.
Work work_of_closed_form(const Scene& scene) {
  const double looks =
      has_closed_form(scene.closed_form_kind()) ? scene.scenario().duration_s * closed_form_turn_rate_rad_s(scene) : 0;
  return {scene.rows() + looks, scene.rows() + looks};
}

/// Returns how often a long-horizon run is sampled between the rows to count full turns: once per 1.5 rad of both axes. Their
/// rate is limited by the energy of falling, or by a fast spin (tilted_top.cpp).
double long_horizon_looks(const Scene& scene) {
  const Vec3<double>& w = scene.release<double>().w_XB_B;
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const double I1 = inertia(0, 0), beta = std::abs(inertia(2, 2) * w[2]) / I1;
  const double mu = scene.gravity_torque_N_m() / I1;
  const double start = real::hypot(w[0], w[1]);
  const double rate = std::min(real::hypot(start, 2 * std::sqrt(mu)), start + 4 * mu / beta);
  return scene.scenario().duration_s * (2 * rate + std::abs(scene.rotation_rate_rad_s())) / 1.5;
}

/// Returns the work of the long-horizon method. It takes steps of about 3 rad of the precession with 12 kicks each, or steps of
/// 4 rad of the nutation with 6 kicks each where the nutation is not much faster; each row takes 19 kicks. The trials that
/// find the step double the work of the steps.
Work long_horizon_work(const Scene& scene) {
  const Vec3<double>& w = scene.release<double>().w_XB_B;
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const double momentum = std::abs(inertia(2, 2) * w[2]);
  const double torque = scene.gravity_torque_N_m() + momentum * std::abs(scene.rotation_rate_rad_s());
  const double nutation = momentum / inertia(0, 0);
  // The method cannot average over a large nutation, such as a fast precession: its steps resolve it.
  const double across = real::hypot(w[0], w[1]);
  const bool averages = torque < 0.02 * nutation * momentum && across < 0.1 * nutation;
  const double steps = averages ? scene.scenario().duration_s * torque / momentum / 3 : scene.pace().reduced_turning_rad / 4;
  const double rows = scene.rows();
  constexpr double kWalks = 6;  // integrations at amplified Earth rates, from which a small drift is found
  return {kWalks * (steps + rows) + long_horizon_looks(scene), 2 * steps * (averages ? 12 : 6) + rows * 19};
}

/// Returns the factor by which a right-hand side is slower in extended precision.
double slowness(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return 4;
    case Precision::bits113: return 75;
  }
  return 1;
}

/// Returns the time (s) of one evaluation, as counted in the work of the method.
double seconds_an_evaluation(const Scene& scene, const IntegrationOptions& options) {
  if (options.method == Method::closed_form) return 5e-7;
  if (options.method == Method::long_horizon) return 2.5e-6;
  constexpr double kReduced = 1.2e-7, kDrivenOrder = 4e-7, kGeneralOrder = 8e-7;
  const bool reduced = scene.form(options) == ModelForm::reduced;
  double seconds = reduced ? kReduced : general_evaluation_seconds(scene);
  if (options.method == Method::taylor && !scene.is_plain()) seconds = reduced ? kDrivenOrder : kGeneralOrder;
  return slowness(scene.scenario().precision) * seconds;
}

bool is_long_horizon(const Scene& scene, const IntegrationOptions& options) {
  return options.method == Method::long_horizon && !scene.method_refusal(options.method);
}

}  // namespace

double general_evaluation_seconds(const Scene& scene) {
  const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
  if (applied.gimbal) return 1.3e-6;
  if (applied.any()) return 5e-7;
  return scene.is_plain() ? 1.8e-7 : 2.8e-7;
}

IntegrationCost cost_of(const Scene& scene, const IntegrationOptions& options) {
  constexpr double kSecondsALook = 1e-6;
  IntegrationCost cost;
  const bool closed_form = options.method == Method::closed_form, long_horizon = is_long_horizon(scene, options);
  if (closed_form)
    cost.work = work_of_closed_form(scene);
  else if (long_horizon)
    cost.work = long_horizon_work(scene);
  else
    cost.work = estimated_work(scene.pace(), options, scene.form(options) == ModelForm::reduced);
  cost.seconds = seconds_an_evaluation(scene, options) * cost.work.evaluations;
  // Unless the two motions differ only by a turn of the laboratory, the drift of a closed form is evaluated in 113 bits.
  if (closed_form) cost.seconds += (scene.is_one_motion() ? 1e-6 : 1e-4) * scene.rows();
  if (long_horizon) cost.seconds += kSecondsALook * long_horizon_looks(scene);
  return cost;
}

}  // namespace earthtop
