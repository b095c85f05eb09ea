// SPDX-License-Identifier: GPL-3.0-or-later
// The cost of one integration whose options are known, before any of it is done.
#include <algorithm>
#include <cmath>

#include "drift/long_horizon/long_horizon_work.hpp"
#include "earthtop/closed_form/exact_motion.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

/// Returns the sum of the turn rates of both motions and of the laboratory (rad/s), without the spin of a top that is symmetric
/// about body axis 3. @param scene  must have a closed form
double closed_form_turn_rate_rad_s(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  const Release<double>& release = scene.release<double>();
  const Vec3<double> W_B = transposed_times(rotation_matrix(release.q_LB), model.W_IL_L);
  const ExactBody<double> body = exact_body(model);
  const auto turn_rate = [&](const Vec3<double>& w_B) { return ExactMotion<double>(body, release.q_LB, w_B).turn_rate(); };
  return turn_rate(release.w_XB_B) + turn_rate(Vec3<double>(release.w_XB_B + W_B)) + norm(model.W_IL_L);
}

/// Returns the work of a closed form: at each row two or three evaluations in 113 bits, and between rows as many evaluations in
/// double as are needed to count full turns of the angles.
Work work_of_closed_form(const Scene& scene) {
  const double looks =
      has_closed_form(scene.closed_form_kind()) ? scene.scenario().duration_s * closed_form_turn_rate_rad_s(scene) : 0;
  return {scene.rows() + looks, scene.rows() + looks};
}

/// Returns the factor by which a right-hand side, or an order of a series, is slower in extended precision; AMD EPYC, 27 November 2026.
/// Series about a pivot take vectors in double, and higher orders beyond.
double slowness(Precision precision, bool in_vectors) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return in_vectors ? 60 : 8;
    case Precision::bits113: return in_vectors ? 600 : 100;
  }
  return 1;
}

/// Returns the time (s) of one evaluation, as counted in the work of the method.
double seconds_an_evaluation(const Scene& scene, const IntegrationOptions& options) {
  if (options.method == Method::closed_form) return scene.support().has_rotor ? 1e-5 : 5e-7;
  const bool in_vectors = options.method == Method::taylor && !scene.support().has_contact;
  return slowness(scene.scenario().precision, in_vectors) * laws_of(scene).evaluation_seconds(scene, options);
}

bool is_long_horizon(const Scene& scene, const IntegrationOptions& options) {
  return options.method == Method::long_horizon && !scene.method_refusal(options.method);
}

/// Returns the time of finding the Fourier sums and of so many looks by them (s).
double seconds_of_sums(const Scene& scene, double looks) {
  constexpr double kSecondsALook = 1.5e-6;  // AMD EPYC, 28 November 2026
  return slowness(scene.scenario().precision, true) * (scene.fourier_outlook().set_up_s + kSecondsALook * looks);
}

/// Returns the cost of the Fourier sums: a look at each row and wherever an angle may go round.
IntegrationCost fourier_cost(const Scene& scene) {
  IntegrationCost cost;
  const double looks = scene.rows() + scene.scenario().duration_s / scene.fourier_outlook().longest_step_s;
  cost.work = {looks, looks};
  cost.seconds = seconds_of_sums(scene, looks);
  return cost;
}

/// Returns the cost of the long-horizon method, in sets-up of its closed form and in looks between the rows.
IntegrationCost long_horizon_cost(const Scene& scene, const IntegrationOptions& options, double looks) {
  // Between the parts of a kick that is spread over the nutation, the closed form is set up in double.
  constexpr double kSecondsALook = 1e-6, kAveraging = 1.4e-6, kFollowing = 2e-6;  // AMD EPYC, 26 November 2026
  const double but_the_last = scene.rows() - 1;
  const LongHorizonDriftWork expected =
      long_horizon_drift_work(scene.problem_without_rows<double>(), options, but_the_last + looks);
  const double each = expected.averages ? kAveraging : kFollowing;
  return {expected.work, each * expected.work.evaluations + kSecondsALook * expected.looks};
}

/// Returns the time (s) of looks by the long-horizon method, less what the dense output of a series takes for them.
/// @param asides  those of them that take a step aside
double seconds_looking_far(const Scene& scene, const IntegrationOptions& options, double looks, double asides) {
  constexpr double kSecondsALook = 1e-6;
  return long_horizon_cost(scene, options, asides).seconds + kSecondsALook * looks;
}

/// Returns how many of a long run's looks between its rows take a step aside: one in each window for pictures, and those for the trend.
double asides_in(const Scene& scene, const IntegrationOptions& options) {
  constexpr double kAWindow = 20;  // looks
  const double turns = long_horizon_drift_work(scene.problem_without_rows<double>(), options, 0).precession_turns;
  return std::clamp(kWindowsATurn * turns, kFewestWindows, kMostPictureLooks / kAWindow) +
         std::max(kFewestTrendLooks, kTrendLooksATurn * std::min(turns, kTrendTurns));
}

}  // namespace

double PivotLaws::evaluation_seconds(const Scene& scene, const IntegrationOptions& options) const {
  constexpr double kReduced = 1.7e-7;  // AMD EPYC, 26 November 2026
  constexpr double kDrivenOrder = 2e-7, kGeneralOrder = 4.5e-7;
  const bool reduced = scene.form(options) == ModelForm::reduced;
  if (options.method == Method::taylor && !scene.is_plain()) return reduced ? kDrivenOrder : kGeneralOrder;
  return reduced ? kReduced : general_evaluation_seconds(scene);
}

void PivotLaws::take_series_form(const Scene& scene, IntegrationOptions& series) const {
  series.observer = Observer::laboratory;
  series.form = ModelForm::automatic;
  if (scene.form(series) != ModelForm::reduced) series.observer = Observer::body, series.form = ModelForm::general;
}

double general_evaluation_seconds(const Scene& scene) {
  const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
  if (applied.gimbal) return 1.3e-6;
  if (applied.any()) return 5e-7;
  return scene.is_plain() ? 1.8e-7 : 2.8e-7;
}

IntegrationCost cost_of(const Scene& scene, const IntegrationOptions& options) {
  IntegrationCost cost;
  const bool closed_form = options.method == Method::closed_form;
  if (closed_form)
    cost.work = work_of_closed_form(scene);
  else if (options.method == Method::fourier && !scene.method_refusal(options.method))
    return fourier_cost(scene);
  else if (is_long_horizon(scene, options))
    return long_horizon_cost(scene, options, judgement_looks(options.method));
  else
    cost.work = estimated_work(scene.pace(), options, scene.form(options) == ModelForm::reduced);
  cost.seconds = seconds_an_evaluation(scene, options) * cost.work.evaluations;
  // Unless the two motions differ only by a turn of the laboratory, the drift of a closed form is evaluated in 113 bits.
  const double wide = scene.support().has_rotor ? 1e-3 : 1e-4;
  if (closed_form) cost.seconds += (scene.is_one_motion() ? 1e-6 : wide) * scene.rows();
  return cost;
}

IntegrationOptions options_for_looks(const Scene& scene, const IntegrationOptions& first, double looks, double asides) {
  IntegrationOptions again = first;
  again.relative_tolerance = std::max(again.relative_tolerance, least_tolerance(Precision::bits53));
  if (is_exact(first.method) || first.method == Method::taylor || scene.method_refusal(Method::taylor)) return again;
  IntegrationOptions series = again;
  series.method = Method::taylor;
  series.step_s.reset();
  series.relative_tolerance = default_tolerance(Precision::bits53);
  laws_of(scene).take_series_form(scene, series);
  const bool is_far = is_long_horizon(scene, first);
  return is_far && seconds_looking_far(scene, first, looks, asides) < cost_of(scene, series).seconds ? again : series;
}

double picture_looks(const Scene& scene) {
  constexpr double kLooksARadian = 2;
  return std::min<double>(kMostPictureLooks, kLooksARadian * scene.pace().axis_rate_rad_s * scene.scenario().duration_s);
}

double seconds_looking(const Scene& scene, const IntegrationOptions& first) {
  const double looks = picture_looks(scene);
  if (first.method == Method::fourier && !scene.method_refusal(first.method)) return seconds_of_sums(scene, looks);
  const double asides = is_long_horizon(scene, first) ? asides_in(scene, first) : 0;
  const IntegrationOptions options = options_for_looks(scene, first, looks, asides);
  return is_long_horizon(scene, options) ? seconds_looking_far(scene, options, looks, asides) : cost_of(scene, options).seconds;
}

}  // namespace earthtop
