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

/// A body for a carried scene: symmetric or not, with its centre of mass on axis 3, off it, or in the pivot.
void any_body(Scenario& s, Random& random) {
  const double size = random.log_uniform(1e-5, 1e-3), l = random.log_uniform(0.003, 0.05), kind = random.uniform(0, 1);
  const double across = size * random.uniform(0.1, 1), other = kind < 0.4 ? across : size * random.uniform(0.1, 1);
  const double along = size * random.uniform(0.05, 1);
  s.body = {};
  s.body.mass_kg = random.log_uniform(0.02, 2);
  set_principal(s.body, other + along, across + along, across + other);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  const double place = random.uniform(0, 1);
  if (place < 0.4) s.body.center_of_mass_m = {0, 0, random.sign() * l};
  if (place > 0.6) s.body.center_of_mass_m = {l * random.uniform(-1, 1), l * random.uniform(-1, 1), l * random.uniform(-1, 1)};
}
/// Friction of any kind in half of the scenes, from hardly any to what brings the motion to rest many times over.
void any_friction(Scenario& s, Random& random) {
  const double kind = random.uniform(0, 1), times = random.log_uniform(1e-2, 30);
  if (kind > 0.5) return;
  const double I = least_moment(s);
  if (kind < 0.25)
    s.effects.applied.viscous_N_m_s = times * I / s.duration_s;
  else if (kind < 0.4)
    s.effects.applied.quadratic_N_m_s2 = times * I / (s.duration_s * std::max(release_rate(s), 1.0));
  else
    s.effects.applied.air_drag = AirDragSpec{random.log_uniform(0.01, 0.1)};
}
/// How far a scene turns by its fastest rate (rad): from short to long.
double phase(Random& random) { return random.log_uniform(30, 2e4); }

/// Any body in a gimbal, fast or slow, with its axis at rest or turning about Up, at any latitude, damped or not.
void body_in_gimbal(Scenario& s, Random& random) {
  any_body(s, random);
  s.site = random_site(random);
  s.release = {};
  s.release.tilt_deg = 90;
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.spin_rad_s = random.sign() * random.log_uniform(1, 3e3);
  if (random.coin()) s.release.precession = Precession::given, s.release.precession_rate_rad_s = random.log_uniform(0.01, 30);
  s.effects = {};
  s.effects.applied.gimbal = GimbalSpec{};
  s.duration_s = 1;
  s.duration_s = phase(random) / Scene(s).fastest_rate_rad_s();
  if (random.coin()) s.effects.applied.gimbal->damping_N_m_s = random.log_uniform(1e-2, 30) * least_moment(s) / s.duration_s;
  any_friction(s, random);
  s.output_step_s = s.duration_s / 12;
}
/// Any body on a platform, fast or slow against it, with its pivot on the axis or off it.
void body_on_platform(Scenario& s, Random& random) {
  any_body(s, random);
  s.site = random_site(random);
  s.release = {};
  s.release.tilt_deg = random.uniform(1, 179);
  s.release.azimuth_deg = random.uniform(-180, 180);
  const double spin = random.log_uniform(1, 3e3);
  if (random.coin())
    s.release.spin_rad_s = random.sign() * spin;
  else
    s.release.angular_velocity_body_rad_s = {spin * random.uniform(-1, 1), spin * random.uniform(-1, 1),
                                             spin * random.uniform(-1, 1)};
  s.release.rates_relative_to = random.coin() ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  s.effects = {};
  s.platform.reset();
  s.duration_s = 1;
  const double body_rate = Scene(s).fastest_rate_rad_s(), radians = phase(random);
  s.duration_s = radians / body_rate;
  PlatformSpec p;
  constexpr std::array kMotions{PlatformMotion::constant, PlatformMotion::ramp, PlatformMotion::harmonic,
                                PlatformMotion::table};
  p.motion = kMotions[static_cast<std::size_t>(random.uniform(0, 4))];
  p.axis = {random.uniform(-1, 1), random.uniform(-1, 1), 1};
  const double rate = std::min(30.0, body_rate * random.log_uniform(1e-3, 1));
  p.rate_rad_s = p.motion == PlatformMotion::constant || p.motion == PlatformMotion::ramp ? random.sign() * rate : 0;
  if (p.motion == PlatformMotion::ramp)
    p.rate_rad_s *= random.uniform(0, 1), p.acceleration_rad_s2 = random.sign() * rate / s.duration_s;
  if (p.motion == PlatformMotion::harmonic)
    p.frequency_hz = rate / 6, p.amplitude_rad = random.log_uniform(1e-3, 1), p.phase_deg = random.uniform(0, 360);
  if (p.motion == PlatformMotion::table) {
    auto table = std::make_shared<AngleTable>();
    const int rows = 5 + static_cast<int>(random.uniform(0, 60));
    double angle = 0;
    for (int i = 0; i < rows; ++i) {
      table->t_s.push_back(s.duration_s * i / (rows - 1.0));
      table->value.push_back(angle);
      angle += rate * s.duration_s / rows * random.uniform(-1, 1);
    }
    p.table.rows = table;
  }
  if (random.uniform(0, 1) < 0.8)
    p.pivot_offset_m = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
  s.platform = p;
  any_friction(s, random);
  s.output_step_s = s.duration_s / 12;
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
    {"body in gimbal", body_in_gimbal},
    {"body on platform", body_on_platform},
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
