// How much work a scenario asks for, before any of it is done.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/real.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "scenario/closed_form_fit.hpp"

namespace earthtop {

namespace {

/// How fast a platform turns, and how it accelerates the pivot, at most.
struct PlatformDemand {
  double rate_rad_s = 0;
  double acceleration_m_s2 = 0;
};

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

/// The phase of the fastest motion that a step covers (rad), as measured on a fast top; a method of order p takes steps that
/// grow with the p-th root of its tolerance. The order of `extrapolation` follows its tolerance.
double radians_a_step(Method method, double tolerance) {
  switch (method) {
    case Method::dopri5: return 0.25 * real::pow(tolerance / 1e-8, 1.0 / 5);
    case Method::rkf78: return 0.22 * real::pow(tolerance / 1e-14, 1.0 / 8);
    case Method::bulirsch_stoer: return 2 * real::pow(tolerance / 1e-12, 1.0 / 16);
    case Method::extrapolation: return 4 * real::pow(tolerance / 1e-12, 1.0 / 35);
    case Method::taylor: return 1.8;
    case Method::dop853: return 0.35 * real::pow(tolerance / 1e-12, 1.0 / 8);
    case Method::gauss: return std::min(2.0, 1.0 * real::pow(tolerance / 1e-12, 1.0 / 13));
    case Method::splitting: return std::min(2.0, 0.8 * real::pow(tolerance / 1e-12, 1.0 / 7));
    case Method::automatic:
    case Method::abm8:  // its step is given
    case Method::long_horizon:
    case Method::closed_form: break;
  }
  return 0.04;
}

/// Right-hand sides for each of those steps, rejected ones included.
double evaluations_a_step(Method method, double tolerance) {
  switch (method) {
    case Method::dopri5: return 6;
    case Method::bulirsch_stoer: return 53;
    case Method::extrapolation: return 80 * real::pow(tolerance / 1e-12, -1.0 / 60);
    case Method::abm8: return 1;
    case Method::taylor: return 8 - 0.7 * real::log(tolerance);
    case Method::gauss: return 60;
    case Method::splitting: return 14;
    case Method::dop853: return 12;
    case Method::rkf78:
    case Method::automatic:
    case Method::long_horizon:
    case Method::closed_form: break;
  }
  return 13;
}

/// One right-hand side of both predictions and the deviation between them, with its share of the stepper.
double seconds_an_evaluation(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return 1.2e-6;
    case Precision::bits113: return 17e-6;
  }
  return 1.5e-7;
}

/// The rate that steps follow (rad/s): a symmetric top is integrated without its spin, but for one that spins about another
/// axis than body axis 3, whose angles have to be seen going round.
double step_rate_rad_s(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const bool reduced = scenario.numerics.form == ModelForm::automatic && scenario.numerics.observer == Observer::laboratory &&
                       is_plain(scenario) && symmetry_axis(body) == 2;
  if (!reduced) return fastest_rate_rad_s(scenario);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const double I1 = body.I_BP_B(0, 0), torque = body.mass * scenario.site.gravity_m_s2 * norm(body.p_PBcm_B);
  const double rate = norm(Vec3<double>(body.I_BP_B * release.w_XB_B)) / I1 + 2 * std::sqrt(torque / I1) +
                      std::abs(scenario.rotation_rate_rad_s);
  return std::max(rate, 1 / scenario.duration_s);
}

struct Work {
  double steps = 0, evaluations = 0;
};

/// A closed form is looked at once a row, with two or three evaluations in 113 bits, and in double as often as it takes to see
/// angles go round in between.
Work work_of_closed_form(const Scenario& scenario) {
  constexpr double kSecondsARow = 1e-4, kSecondsALook = 5e-7;
  const double rows = scenario.duration_s / scenario.output_step_s;
  const double looks =
      has_closed_form(closed_form_kind(scenario)) ? scenario.duration_s * closed_form_turn_rate_rad_s(scenario) : 0;
  return {rows + looks, (kSecondsARow * rows + kSecondsALook * looks) / seconds_an_evaluation(scenario.precision)};
}

/// Of the long-horizon method: steps of some 3 rad of the precession, or of 4 rad of the nutation where that is not far faster;
/// 12 kicks or 6 in each, and 19 at each row, of the work of 20 right-hand sides. The trial of steps about as much again.
Work long_horizon_work(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const double momentum = std::abs(body.I_BP_B(2, 2) * release.w_XB_B[2]);
  const double torque =
      body.mass * scenario.site.gravity_m_s2 * norm(body.p_PBcm_B) + momentum * std::abs(scenario.rotation_rate_rad_s);
  const double nutation = momentum / body.I_BP_B(0, 0);
  const bool averages = torque < 0.02 * nutation * momentum;
  const double steps =
      averages ? scenario.duration_s * torque / momentum / 3 : scenario.duration_s * step_rate_rad_s(scenario) / 4;
  const double rows = scenario.duration_s / scenario.output_step_s;
  constexpr double kWork = 20;
  return {steps + rows, kWork * (2 * steps * (averages ? 12 : 6) + rows * 19)};
}

/// Of the first integration.
Work work_of(const Scenario& scenario) {
  const IntegrationOptions options = method_choice(scenario).options;
  const Method method = options.method;
  if (method == Method::closed_form) return work_of_closed_form(scenario);
  if (method == Method::long_horizon && !method_refusal(method, scenario)) return long_horizon_work(scenario);
  const double tolerance = options.relative_tolerance;
  const double step_s = options.step_s.value_or(radians_a_step(method, tolerance) / step_rate_rad_s(scenario));
  // Steps end where the pieces of a table's spline meet.
  const bool tabulated = scenario.platform && scenario.platform->table;
  const double joints = tabulated ? static_cast<double>(scenario.platform->table->t_s.size()) : 0;
  const double steps = scenario.duration_s / step_s + joints;
  // Each row ends a step, for which `extrapolation` needs fewer columns than for a long one; but `taylor` steps past it.
  const double rows = scenario.duration_s / scenario.output_step_s;
  const double row_evaluations = method == Method::taylor ? 1 : method == Method::extrapolation ? 40 : 13;
  return {steps, steps * evaluations_a_step(method, tolerance) + rows * row_evaluations};
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

double estimated_steps(const Scenario& scenario) { return work_of(scenario).steps; }

double estimated_seconds(const Scenario& scenario) {
  constexpr double kBothIntegrations = 2;
  return kBothIntegrations * seconds_an_evaluation(scenario.precision) * work_of(scenario).evaluations;
}

void require_affordable(const Scenario& scenario) {
  constexpr double kSecondsAStep = 4e-6;  // both integrations: toy-top and fast-gyro take 3 to 4 microseconds
  const double steps = std::min(estimated_steps(scenario), 1e300);
  const auto limit = static_cast<double>(scenario.numerics.step_limit);
  if (!(steps <= limit))
    throw ScenarioError("/motion/duration_s",
                        fmt::format("this scene needs about {:.1e} steps, some {:.1g} days of computing; at most {:.1e} are "
                                    "allowed; take a shorter duration, a slower spin or a longer step",
                                    steps, steps * kSecondsAStep / 86400, limit));
  const double days = std::min(estimated_seconds(scenario), 1e300) / 86400;
  if (scenario.precision != Precision::bits53 && !(days <= 1))
    throw ScenarioError("/motion/duration_s",
                        fmt::format("this scene needs about {:.1e} steps in {}, some {:.1g} days of computing; at most one day "
                                    "is allowed; take a shorter duration, a slower spin, a looser tolerance or less precision",
                                    steps, to_string(scenario.precision), days));
}

}  // namespace earthtop
