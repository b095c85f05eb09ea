// SPDX-License-Identifier: GPL-3.0-or-later
// How much work a scenario asks for, before any of it is done.
#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drift/stability.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "scenario/closed_form_fit.hpp"
#include "scenario/pace.hpp"
#include "scenario/platform_demand.hpp"
#include "scenario/problem.hpp"
#include "scenario/second_integration.hpp"

namespace earthtop {

PlatformDemand demand_of(const PlatformSpec& platform, double duration_s, double earth_rate_rad_s) {
  const double amplitude = std::abs(platform.amplitude_rad);
  double omega = 2 * std::numbers::pi * std::abs(platform.frequency_hz);
  double rate = std::abs(platform.rate_rad_s) + std::abs(platform.acceleration_rad_s2) * duration_s + amplitude * omega;
  double alpha = std::abs(platform.acceleration_rad_s2) + amplitude * omega * omega;
  if (platform.table) {
    const AngleSpline<double> turn(*platform.table);
    rate = turn.largest_rate();
    alpha = turn.largest_acceleration();
    if (rate > 0) omega = alpha / rate;  // of a harmonic turn, its own
  }
  const auto& d = platform.pivot_offset_m;
  const double offset = real::hypot(d[0], d[1], d[2]), turning = rate + std::abs(earth_rate_rad_s);
  return {std::max(rate, omega), (turning * turning + alpha) * offset};
}

namespace {

bool takes_reduced_form(const Scenario& scenario, const IntegrationOptions& options) {
  if (options.form != ModelForm::automatic) return options.form == ModelForm::reduced;
  const bool splits = options.method == Method::splitting && options.observer == Observer::inertial;
  return (options.observer == Observer::laboratory || splits) && is_plain(scenario) &&
         symmetry_axis(make_body<double>(scenario.body)) >= 0;
}

double rows_of(const Scenario& scenario) { return scenario.duration_s / scenario.output_step_s; }

/// A closed form is looked at once a row, with two or three evaluations in 113 bits, and in double as often as it takes to see
/// angles go round in between.
Work work_of_closed_form(const Scenario& scenario) {
  const double rows = rows_of(scenario);
  const double looks =
      has_closed_form(closed_form_kind(scenario)) ? scenario.duration_s * closed_form_turn_rate_rad_s(scenario) : 0;
  return {rows + looks, rows + looks};
}

/// How often the watcher of a long-horizon run looks between the rows: at 1.5 rad of both axes, whose rates are what falling
/// gives them, or a fast spin leaves them (tilted_top.cpp).
double long_horizon_looks(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const double I1 = body.I_BP_B(0, 0), beta = std::abs(body.I_BP_B(2, 2) * release.w_XB_B[2]) / I1;
  const double mu = body.mass * scenario.site.gravity_m_s2 * norm(body.p_PBcm_B) / I1;
  const double start = real::hypot(release.w_XB_B[0], release.w_XB_B[1]);
  const double rate = std::min(real::hypot(start, 2 * std::sqrt(mu)), start + 4 * mu / beta);
  return scenario.duration_s * (2 * rate + std::abs(scenario.rotation_rate_rad_s)) / 1.5;
}

/// Of the long-horizon method: steps of some 3 rad of the precession, or of 4 rad of the nutation where that is not far faster;
/// 12 kicks or 6 in each, and 19 at each row. The trial of steps about as much again.
Work long_horizon_work(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const double momentum = std::abs(body.I_BP_B(2, 2) * release.w_XB_B[2]);
  const double torque =
      body.mass * scenario.site.gravity_m_s2 * norm(body.p_PBcm_B) + momentum * std::abs(scenario.rotation_rate_rad_s);
  const double nutation = momentum / body.I_BP_B(0, 0);
  // A large nutation, such as a fast precession, is followed.
  const double across = real::hypot(release.w_XB_B[0], release.w_XB_B[1]);
  const bool averages = torque < 0.02 * nutation * momentum && across < 0.1 * nutation;
  const double steps = averages ? scenario.duration_s * torque / momentum / 3 : pace_of(scenario).reduced_turning_rad / 4;
  const double rows = rows_of(scenario);
  constexpr double kWalks = 6;  // at amplified rates, from which a small drift is found
  return {kWalks * (steps + rows) + long_horizon_looks(scenario), 2 * steps * (averages ? 12 : 6) + rows * 19};
}

/// The growth of disturbances, as a run's verdict asks for it: along both motions, and closely along those that have a closed
/// form, which leave a separatrix by the integration's own error.
Work growth_work(const Scenario& scenario) {
  constexpr double kClose = 1e-13, kRough = 1e-7, kMostSteps = 5e7;
  double tolerance = kRough;
  if (is_plain(scenario)) {
    const auto problem = make_problem<double>(scenario);
    if (is_regular(problem)) return {};
    if (is_integrable(problem)) tolerance = kClose;
  }
  Work work = variational_work(pace_of(scenario), scenario.duration_s, tolerance);
  const double motions = scenario.rotation_rate_rad_s == 0 ? 1 : 2, share = std::min(1.0, kMostSteps / work.steps);
  return {motions * share * work.steps, motions * share * work.evaluations};
}

/// What a right-hand side takes more of in extended precision.
double slowness(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return 4;
    case Precision::bits113: return 75;
  }
  return 1;
}

/// What one right-hand side of both predictions and the deviation between them takes, with its share of the stepper.
double seconds_an_evaluation(const Scenario& scenario, const IntegrationOptions& options) {
  if (options.method == Method::closed_form) return 5e-7;
  if (options.method == Method::long_horizon) return 2.5e-6;
  double seconds = is_plain(scenario) ? 1.8e-7 : 2.8e-7;
  if (takes_reduced_form(scenario, options)) seconds = 1.2e-7;
  if (scenario.effects.applied.any()) seconds = 5e-7;
  if (scenario.effects.applied.gimbal) seconds = 1.3e-6;
  return slowness(scenario.precision) * seconds;
}
/// One of a motion and three disturbances.
double seconds_a_variation(const Scenario& scenario) {
  if (scenario.effects.applied.gimbal) return 1.2e-6;
  return scenario.effects.applied.any() ? 6e-7 : 2.5e-7;
}

/// What the run's second integration takes.
IntegrationOptions certificate_options(const Scenario& scenario, const IntegrationOptions& first) {
  const ModelForm form = takes_reduced_form(scenario, first) ? ModelForm::reduced : ModelForm::general;
  return second_options(scenario, first, form);
}

}  // namespace

double fastest_rate_rad_s(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> moments(body.I_BP_B, Eigen::EigenvaluesOnly);
  const double least_moment = moments.eigenvalues()[0];
  PlatformDemand platform;
  if (scenario.platform) platform = demand_of(*scenario.platform, scenario.duration_s, scenario.rotation_rate_rad_s);
  const double torque = body.mass * (scenario.site.gravity_m_s2 + platform.acceleration_m_s2) * norm(body.p_PBcm_B);
  const double rate = norm(Vec3<double>(body.I_BP_B * release.w_XB_B)) / least_moment + 2 * std::sqrt(torque / least_moment) +
                      std::abs(scenario.rotation_rate_rad_s) + platform.rate_rad_s;
  return std::max(rate, 1 / scenario.duration_s);
}

Work estimated_work(const Scenario& scenario, const IntegrationOptions& options) {
  if (options.method == Method::closed_form) return work_of_closed_form(scenario);
  if (options.method == Method::long_horizon && !method_refusal(options.method, scenario)) return long_horizon_work(scenario);
  return estimated_work(pace_of(scenario), options, takes_reduced_form(scenario, options));
}

double estimated_seconds(const Scenario& scenario, const IntegrationOptions& options) {
  constexpr double kSecondsALook = 1e-6;
  // Where the two motions are not one and a turn of the laboratory, a closed form's drift needs digits that only 113 bits have.
  const bool one_motion = scenario.rotation_rate_rad_s == 0 || scenario.release.rates_relative_to == RatesRelativeTo::inertial;
  const double seconds_a_row = one_motion ? 1e-6 : 1e-4;
  double seconds = seconds_an_evaluation(scenario, options) * estimated_work(scenario, options).evaluations;
  if (options.method == Method::closed_form) seconds += seconds_a_row * rows_of(scenario);
  if (options.method == Method::long_horizon && !method_refusal(options.method, scenario))
    seconds += kSecondsALook * long_horizon_looks(scenario);
  return seconds;
}

RunEstimate estimated_run(const Scenario& scenario) {
  constexpr double kSecondsARow = 2e-6;
  const IntegrationOptions first = method_choice(scenario).options, second = certificate_options(scenario, first);
  RunEstimate estimate{estimated_work(scenario, first), estimated_work(scenario, second), growth_work(scenario), 0};
  estimate.seconds = estimated_seconds(scenario, first) + estimated_seconds(scenario, second) +
                     seconds_a_variation(scenario) * estimate.growth.evaluations + kSecondsARow * rows_of(scenario);
  return estimate;
}

double estimated_steps(const Scenario& scenario) { return estimated_work(scenario, method_choice(scenario).options).steps; }

double estimated_seconds(const Scenario& scenario) { return estimated_run(scenario).seconds; }

std::string about_seconds(double seconds) {
  if (seconds < 0.1) return "less than 0.1 s";
  if (seconds < 100) return fmt::format("about {:.2g} s", seconds);
  if (seconds < 7200) return fmt::format("about {:.2g} minutes", seconds / 60);
  if (seconds < 2 * 86400) return fmt::format("about {:.2g} hours", seconds / 3600);
  return fmt::format("about {:.2g} days", seconds / 86400);
}

void require_affordable(const Scenario& scenario) {
  // What a motion turns through has to be followed; what friction only holds still is not worth hours.
  constexpr double kStiffDays = 1.0 / 24, kNearlyAll = 0.9;
  const IntegrationOptions options = method_choice(scenario).options;
  const double first = estimated_work(scenario, options).steps;
  const double second = estimated_work(scenario, certificate_options(scenario, options)).steps;
  const auto limit = static_cast<double>(scenario.numerics.step_limit);
  const bool within = first <= limit && second <= std::max(limit, static_cast<double>(IntegrationOptions{}.step_limit));
  const bool friction = scenario.effects.applied.friction() || scenario.effects.applied.gimbal;
  const bool stiff = friction && !options.step_s && damping_steps(pace_of(scenario), options) > kNearlyAll * first;
  if (within && !stiff && scenario.precision == Precision::bits53) return;

  const double steps = std::min(std::max(first, second), 1e300);
  const double days = std::min(estimated_seconds(scenario), 1e300) / 86400;
  if (stiff && !(within && days <= kStiffDays)) {
    const StiffFriction stiffest = stiffest_friction(scenario);
    throw ScenarioError(
        std::string(stiffest.pointer),
        fmt::format(
            "this friction is too stiff: it damps at about {:.1e} 1/s (coefficient over moment of inertia), {:.1e} time "
            "constants within the duration, of which a step of an explicit method covers a few: about {:.1e} steps, "
            "some {:.1g} days of computing, at most an hour is allowed; take a smaller coefficient or a shorter "
            "duration; a motion so strongly damped stands still, or creeps at the rate torque / coefficient",
            stiffest.damping / scenario.duration_s, stiffest.damping, steps, days));
  }
  if (!within)
    throw ScenarioError("/motion/duration_s",
                        fmt::format("this scene needs about {:.1e} steps, some {:.1g} days of computing; at most {:.1e} are "
                                    "allowed; take a shorter duration, a slower spin or a longer step",
                                    steps, days, limit));
  if (scenario.precision != Precision::bits53 && !(days <= 1))
    throw ScenarioError("/motion/duration_s",
                        fmt::format("this scene needs about {:.1e} steps in {}, some {:.1g} days of computing; at most one day "
                                    "is allowed; take a shorter duration, a slower spin, a looser tolerance or less precision",
                                    steps, to_string(scenario.precision), days));
}

}  // namespace earthtop
