// How much work a scenario asks for, before any of it is done.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

double fastest_rate_rad_s(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> moments(body.I_BP_B, Eigen::EigenvaluesOnly);
  const double least_moment = moments.eigenvalues()[0];
  const double mgl = body.mass * scenario.site.gravity_m_s2 * norm(body.p_PBcm_B);
  double rate = norm(Vec3<double>(body.I_BP_B * release.w_XB_B)) / least_moment + 2 * std::sqrt(mgl / least_moment) +
                std::abs(scenario.rotation_rate_rad_s);
  if (scenario.platform) {
    const PlatformSpec& p = *scenario.platform;
    rate += std::abs(p.rate_rad_s) + std::abs(p.acceleration_rad_s2) * scenario.duration_s + 6.3 * std::abs(p.frequency_hz);
  }
  return std::max(rate, 1 / scenario.duration_s);
}

double estimated_steps(const Scenario& scenario) {
  constexpr double kRadiansAStep = 0.2;
  const double step_s = scenario.numerics.step_s.value_or(kRadiansAStep / fastest_rate_rad_s(scenario));
  return scenario.duration_s / step_s;
}

void require_affordable(const Scenario& scenario) {
  constexpr double kSecondsAStep = 4e-6;  // both integrations, on a machine of 2023
  const double steps = std::min(estimated_steps(scenario), 1e300);
  const auto limit = static_cast<double>(scenario.numerics.step_limit);
  if (!(steps <= limit))
    throw ScenarioError("/motion/duration_s",
                        fmt::format("this scene needs about {:.1e} steps, some {:.1g} days of computing; at most {:.1e} are "
                                    "allowed; take a shorter duration, a slower spin or a longer step",
                                    steps, steps * kSecondsAStep / 86400, limit));
}

}  // namespace earthtop
