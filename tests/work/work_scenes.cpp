// SPDX-License-Identifier: GPL-3.0-or-later
#include "work/work_scenes.hpp"

#include <ctime>

#include "bounds/strata.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {
namespace {

double least_moment(const Scenario& s) {
  const auto body = make_body<double>(s.body);
  return body.I_BP_B.diagonal().minCoeff();
}
double release_rate(const Scenario& s) {
  return norm(make_release<double>(s.release, make_body<double>(s.body), s.site.gravity_m_s2).w_XB_B);
}
/// How many times friction could bring the motion to rest within the duration: from hardly at all to stiff.
double brakings(Random& random) { return random.log_uniform(1e-2, 1e5); }

void nothing(Scenario&, Random&) {}
void viscous(Scenario& s, Random& random) {
  s.effects.applied.viscous_N_m_s = brakings(random) * least_moment(s) / s.duration_s;
}
void quadratic(Scenario& s, Random& random) {
  s.effects.applied.quadratic_N_m_s2 = brakings(random) * least_moment(s) / (s.duration_s * std::max(release_rate(s), 1.0));
}
void coulomb(Scenario& s, Random& random) {
  s.effects.applied.coulomb_N_m =
      random.log_uniform(1e-3, 1e2) * least_moment(s) * std::max(release_rate(s), 1.0) / s.duration_s;
}
void disc(Scenario& s, Random& random) { s.effects.applied.air_drag = AirDragSpec{random.log_uniform(0.01, 3)}; }
void gradient(Scenario& s, Random& random) {
  const double rate = random.log_uniform(0.1, 3e3) / s.duration_s;
  s.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::given, rate * rate / 3};
}
void gimbal(Scenario& s, Random& random) {
  s.site.latitude_deg =
      random.uniform(-80, 80);  // at a pole its drift is all rounding, of which an error control makes much work
  s.release = {};
  s.release.tilt_deg = 90;
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_rad_s = random.log_uniform(10, 3e3);
  s.body.center_of_mass_m = {0, 0, 0};
  s.duration_s = random.log_uniform(100, 3e3) / s.release.spin_rad_s;
  s.output_step_s = s.duration_s / 12;
  s.effects.applied.gimbal = GimbalSpec{};
}
void damped_gimbal(Scenario& s, Random& random) {
  gimbal(s, random);
  s.effects.applied.gimbal->damping_N_m_s = brakings(random) * least_moment(s) / s.duration_s;
}
void platform(Scenario& s, Random& random) {
  constexpr std::array kMotions{PlatformMotion::constant, PlatformMotion::ramp, PlatformMotion::harmonic};
  PlatformSpec p;
  p.motion = kMotions[static_cast<std::size_t>(random.uniform(0, 3))];
  p.axis = {random.uniform(-1, 1), random.uniform(-1, 1), 1};
  const double rate = random.log_uniform(0.1, 3e3) / s.duration_s;
  if (p.motion != PlatformMotion::harmonic) p.rate_rad_s = rate;
  if (p.motion == PlatformMotion::ramp) p.acceleration_rad_s2 = rate / s.duration_s;
  if (p.motion == PlatformMotion::harmonic) p.frequency_hz = rate / 6, p.amplitude_rad = random.log_uniform(1e-6, 1);
  p.pivot_offset_m = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0};
  s.platform = p;
}
void viscous_platform(Scenario& s, Random& random) {
  platform(s, random);
  viscous(s, random);
}
template <Method M>
void by(Scenario& s, Random& random) {
  s.numerics.method = M;
  s.numerics.relative_tolerance = random.log_uniform(1e-12, 1e-6);
  if (M == Method::splitting || M == Method::gauss) s.numerics.relative_tolerance = random.log_uniform(1e-12, 1e-9);
}
template <Method M>
void stiff_by(Scenario& s, Random& random) {
  by<M>(s, random);
  viscous(s, random);
}
void in_float128(Scenario& s, Random& random) {
  s.precision = Precision::bits113;
  s.numerics.relative_tolerance = 1e-24;
  s.duration_s = random.log_uniform(3, 30) / Scene(s).fastest_rate_rad_s();
  s.output_step_s = s.duration_s / 12;
  if (random.coin()) viscous(s, random), s.effects.applied.viscous_N_m_s *= 1e-3;
}
void in_long_double(Scenario& s, Random& random) {
  s.precision = Precision::bits64;
  s.numerics.relative_tolerance = 1e-16;
  if (random.coin()) viscous(s, random);
}
void by_long_horizon(Scenario& s, Random& random) {
  s = random_scene_of(strata()[1], static_cast<std::uint64_t>(random.uniform(0, 1e6)), 1e3, 1e5);
  if (!Scene(s).method_refusal(Method::long_horizon)) s.numerics.method = Method::long_horizon;
}

constexpr WorkKind kKinds[] = {
    {"plain", nothing},
    {"viscous", viscous},
    {"quadratic", quadratic},
    {"coulomb", coulomb},
    {"disc", disc},
    {"gradient", gradient},
    {"gimbal", gimbal},
    {"damped gimbal", damped_gimbal},
    {"platform", platform},
    {"viscous, platform", viscous_platform},
    {"dopri5", by<Method::dopri5>},
    {"rkf78", by<Method::rkf78>},
    {"bulirsch_stoer", by<Method::bulirsch_stoer>},
    {"extrapolation", by<Method::extrapolation>},
    {"dop853", by<Method::dop853>},
    {"gauss", by<Method::gauss>},
    {"taylor", by<Method::taylor>},
    {"viscous, dopri5", stiff_by<Method::dopri5>},
    {"viscous, rkf78", stiff_by<Method::rkf78>},
    {"viscous, bulirsch_stoer", stiff_by<Method::bulirsch_stoer>},
    {"viscous, extrapolation", stiff_by<Method::extrapolation>},
    {"viscous, dop853", stiff_by<Method::dop853>},
    {"viscous, gauss", stiff_by<Method::gauss>},
    {"float128", in_float128},
    {"long double", in_long_double},
    {"long_horizon", by_long_horizon},
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

std::span<const WorkKind> work_kinds() { return kKinds; }

Scenario work_scene(const WorkKind& kind, std::uint64_t index) {
  const auto number = static_cast<std::uint64_t>(&kind - kKinds);
  Random random(77'000'003 * (number + 1) + index);
  // Tops of all kinds and free bodies: the strata that neither choose a method nor switch effects off.
  constexpr std::uint64_t kBodies = 17;
  Scenario s = random_scene_of(strata()[index % kBodies], number * 100'000 + index, 10, 3e3);
  kind.add(s, random);
  s.name = "work-" + std::to_string(number) + "-" + std::to_string(index);
  return s;
}

WorkDone work_done(const Scenario& scenario) {
  WorkDone done;
  const RunEstimate estimate = Scene(scenario).estimate();
  done.promised[0] = estimate.solution, done.promised[1] = estimate.certificate, done.promised[2] = estimate.growth;
  done.promised_s = estimate.seconds.all();
  const double start = processor_seconds();
  const RunResult result = run(scenario);
  done.used_s = processor_seconds() - start;
  const auto used = [](const StepCounters& c) {
    return Work{static_cast<double>(c.accepted + c.rejected), static_cast<double>(c.evaluations)};
  };
  done.used[0] = used(result.solution.counters), done.used[1] = used(result.certificate.counters);
  done.status[0] = result.solution.status, done.status[1] = result.certificate.status;
  if (estimate.growth.steps == 0) return done;
  const auto problem = Scene(scenario).problem<double>();
  const std::optional<double> tolerance = growth_tolerance(problem, result.reached_s);
  if (!tolerance) return done;
  const double until_s = result.stops.empty() ? result.reached_s : 0.99 * result.stops.front().t_s;
  for (const MotionKind kind : {MotionKind::reference, MotionKind::rotating}) {
    if (kind == MotionKind::rotating && scenario.rotation_rate_rad_s == 0) break;
    const GrowthReport growth = disturbance_growth(problem, kind, until_s, *tolerance);
    done.growth_completed = done.growth_completed && growth.completed;
    const Work work = used(growth.counters);
    done.used[2] = {done.used[2].steps + work.steps, done.used[2].evaluations + work.evaluations};
  }
  return done;
}

}  // namespace earthtop::testing
