// SPDX-License-Identifier: GPL-3.0-or-later
#include "trend/trend_tops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "run/trend.hpp"

namespace earthtop::testing {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// The trend from one integration at a loose tolerance, without bounds and verdict.
std::optional<SecularDrift> trend_of(const Scenario& scenario) {
  const Scene scene(scenario);
  const TrendPlan plan = plan_trend(scene);
  if (plan.times_s.empty()) return std::nullopt;
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = plan.times_s;
  IntegrationOptions options;
  options.method = Method::taylor;
  options.relative_tolerance = 1e-12;
  options.observer = Observer::laboratory;
  if (!takes_reduced_form(problem.model, options)) options.observer = Observer::body, options.form = ModelForm::general;
  const DriftTrajectory<double> trajectory = integrate_drift(problem, options);
  RunResult result;
  result.scene = result.modelled = scene;
  result.reached_s = result.verdict.reliable_until_s = scenario.duration_s;
  std::vector<AzimuthSample> azimuths;
  for (const DriftSample<double>& sample : trajectory.samples) {
    azimuths.push_back(azimuth_sample(sample));
    DriftRow row;
    row.t_s = sample.state.t_s;
    row.axis_L = row.ref_axis_L = {1, 0, 0};
    if (sample.measures.azimuth_defined) row.drift_azimuth_rad = sample.azimuth;
    result.looks.push_back(row);
  }
  std::optional<SecularDrift> trend = assess_trend(result, plan, azimuths);
  if (trend && !trend->azimuth_rate_rad_s) trend.reset();
  return trend;
}

template <std::size_t N>
double one_of(Random& random, const std::array<double, N>& values) {
  return values[std::min(static_cast<std::size_t>(random.uniform(0, 1) * N), N - 1)];
}

void set_place(Random& random, Scenario& s) {
  const double latitude = random.uniform(-90, 90), special = one_of(random, std::array{0.0, 90.0, -90.0, 45.0, 48.1, 52.5});
  s.site = {random.uniform(0, 1) < 0.3 ? special : latitude, 0, 0, random.uniform(9.78, 9.83)};
  const double faster = random.log_uniform(0.1, 1e3);
  s.rotation_rate_rad_s = kEarthRateWgs84 * (random.uniform(0, 1) < 0.75 ? 1 : faster);
  s.release.azimuth_deg = random.coin() ? one_of(random, std::array{0.0, 90.0, 180.0, -90.0}) : random.uniform(-180, 180);
  s.release.rates_relative_to = random.uniform(0, 1) < 0.6 ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
}

/// A disc on a stick.
struct Disc {
  double mass, radius, lever;
};
Disc toy_disc(Random& random) {
  return {random.log_uniform(0.02, 0.3), random.uniform(0.015, 0.05), random.uniform(0.015, 0.06)};
}
Disc gyro_disc(Random& random) {
  return {random.log_uniform(0.1, 5), random.uniform(0.02, 0.1), random.log_uniform(0.002, 0.08)};
}

struct Moments {
  double mgl, I1, I3;
  double critical() const { return 2 * std::sqrt(I1 * mgl) / I3; }
  double swing() const { return std::sqrt(mgl / I1); }
};
Moments set_body(Scenario& s, const Disc& disc) {
  const double I3 = disc.mass * disc.radius * disc.radius / 2, I1 = I3 / 2 + disc.mass * disc.lever * disc.lever;
  s.body.mass_kg = disc.mass;
  s.body.center_of_mass_m = {0, 0, disc.lever};
  set_principal(s.body, I1, I1, I3);
  return {disc.mass * s.site.gravity_m_s2 * disc.lever, I1, I3};
}

void set_precession(Random& random, Scenario& s, const Moments& moments) {
  const double kind = random.uniform(0, 1), rate = moments.swing() * random.uniform(-1.5, 1.5);
  if (kind < 0.55) return;
  s.release.precession = kind < 0.75 ? Precession::steady_slow : kind < 0.85 ? Precession::steady_fast : Precession::given;
  if (s.release.precession == Precession::given) s.release.precession_rate_rad_s = rate;
}

/// A duration as people choose it.
double round_duration(Random& random) {
  return one_of(random, std::array{10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 100.0, 120.0, 180.0, 300.0, 600.0});
}

void draw_toy(Random& random, Scenario& s) {
  const Moments moments = set_body(s, toy_disc(random));
  s.release.tilt_deg = random.uniform(2, 80);
  s.release.spin_rad_s = random.sign() * moments.critical() * random.log_uniform(1.1, 8);
  set_precession(random, s, moments);
  s.duration_s = round_duration(random);
}
void draw_gyro(Random& random, Scenario& s) {
  const Moments moments = set_body(s, gyro_disc(random));
  s.release.tilt_deg = random.uniform(5, 150);
  s.release.spin_rad_s = random.sign() * random.log_uniform(10, 1e4);
  set_precession(random, s, moments);
  s.duration_s = round_duration(random);
}
void draw_hanging(Random& random, Scenario& s) {
  const Moments moments = set_body(s, random.coin() ? toy_disc(random) : gyro_disc(random));
  s.release.tilt_deg = random.uniform(95, 178);
  s.release.spin_rad_s = random.sign() * moments.critical() * random.log_uniform(0.05, 5);
  set_precession(random, s, moments);
  s.duration_s = round_duration(random);
}
void draw_pendulum(Random& random, Scenario& s) {
  const double length = random.log_uniform(0.1, 10), mass = random.log_uniform(0.05, 10);
  const Moments moments = set_body(s, {mass, length * random.uniform(0.02, 0.4), length});
  s.release.tilt_deg = random.coin() ? random.uniform(100, 179) : 180 - random.log_uniform(0.5, 20);
  const double spin = random.uniform(-1, 1) * moments.critical();
  s.release.spin_rad_s = random.uniform(0, 1) < 0.3 ? 0 : spin;
  s.release.precession = Precession::given;
  const double cosine = std::cos((180 - s.release.tilt_deg) * kTurn / 360);
  s.release.precession_rate_rad_s = random.sign() * moments.swing() / std::sqrt(cosine) * random.uniform(0.1, 1.5);
  s.duration_s = round_duration(random);
}
void draw_upright(Random& random, Scenario& s) {
  const Moments moments = set_body(s, random.coin() ? toy_disc(random) : gyro_disc(random));
  const double from_vertical = random.log_uniform(0.05, 5);
  s.release.tilt_deg = random.uniform(0, 1) < 0.75 ? from_vertical : 180 - from_vertical;
  s.release.spin_rad_s = random.sign() * moments.critical() * random.log_uniform(1.02, 6);
  set_precession(random, s, moments);
  s.duration_s = round_duration(random);
}
void draw_asymmetric(Random& random, Scenario& s) {
  const Moments moments = set_body(s, random.coin() ? toy_disc(random) : gyro_disc(random));
  const double apart = random.log_uniform(1e-3, 0.5);
  set_principal(s.body, moments.I1 * (1 - apart / 2), moments.I1 * (1 + apart / 2), moments.I3);
  s.release.tilt_deg = random.uniform(5, 170);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.spin_rad_s = random.sign() * moments.critical() * random.log_uniform(1.1, 10);
  if (random.uniform(0, 1) < 0.25) {
    s.release.precession = Precession::given;
    s.release.precession_rate_rad_s = moments.swing() * random.uniform(-1.5, 1.5);
  }
}

/// The bodies of the shipped scenarios, with releases and places near theirs.
void draw_shipped(Random& random, Scenario& s) {
  const double kind = random.uniform(0, 7);
  const auto about = [&](double value) { return random.coin() ? value : value * random.uniform(0.6, 1.6); };
  const auto body = [&](double mass, double lever, double I1, double I3) {
    s.body.mass_kg = mass;
    s.body.center_of_mass_m = {0, 0, lever};
    set_principal(s.body, I1, I1, I3);
  };
  if (kind < 2) {  // the toy top
    body(0.1, 0.03, 1.2e-4, 4e-5);
    s.release.tilt_deg = about(20), s.release.spin_rad_s = about(200), s.duration_s = about(60);
  } else if (kind < 3) {  // the unbalanced gyroscope
    body(0.5, 0.005, 4e-4, 5e-4);
    s.release.tilt_deg = about(60), s.release.spin_rad_s = about(1047.2), s.duration_s = about(600);
  } else if (kind < 4) {  // cusps
    body(0.2, 0.05, 6e-4, 1.6e-4);
    s.release.tilt_deg = about(40), s.release.spin_rad_s = about(110), s.duration_s = about(20);
  } else if (kind < 5) {  // the matching rules
    body(0.2, 0.05, 6e-4, 1.6e-4);
    s.release.tilt_deg = about(30), s.release.spin_rad_s = about(200), s.duration_s = about(240);
    s.release.precession = Precession::given;
    s.release.precession_rate_rad_s = about(3);
  } else if (kind < 6) {  // steady precession
    body(0.2, 0.05, 6e-4, 1.6e-4);
    s.release.tilt_deg = about(50), s.release.spin_rad_s = about(250), s.duration_s = about(60);
    s.release.precession = random.coin() ? Precession::steady_fast : Precession::steady_slow;
  } else {  // steady precession at 90 degrees
    body(2, 0.15, 0.135, 0.18);
    s.release.tilt_deg = random.coin() ? 90 : random.uniform(70, 110), s.release.spin_rad_s = about(30);
    s.duration_s = about(120), s.release.precession = Precession::steady_slow;
  }
}

void draw_effects(Random& random, Scenario& s) {
  random.coin() ? draw_toy(random, s) : draw_gyro(random, s);
  if (random.coin())
    s.effects.applied.gravity_gradient = GravityGradientSpec{random.coin() ? GradientField::radial : GradientField::normal, 0};
  if (random.coin()) s.site.deflection = {random.uniform(-40, 40), random.uniform(-40, 40)};
  if (random.coin()) s.site.pole = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
  if (random.coin()) s.site.height_m = random.uniform(0, 3000);
  const double method = random.uniform(0, 1);
  if (method < 0.3) s.numerics.method = method < 0.1 ? Method::rkf78 : method < 0.2 ? Method::dop853 : Method::long_horizon;
  s.numerics.relative_tolerance = random.coin() ? 1e-12 : random.log_uniform(1e-13, 1e-7);
}

/// Any top, in the turns of precession that are returned.
double draw_any(Random& random, Scenario& s) {
  s.site = {random.uniform(-90, 90), 0, 0, random.uniform(9.76, 9.84)};
  s.rotation_rate_rad_s = kEarthRateWgs84 * (random.coin() ? 1 : random.log_uniform(1, 1e3));
  const bool hangs = random.uniform(0, 1) < 0.25;
  s.release.tilt_deg = hangs ? random.uniform(95, 175) : random.uniform(5, 85);
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.rates_relative_to = random.coin() ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  const double size = random.log_uniform(1e-5, 1e-3), mass = random.log_uniform(0.02, 1), l = random.log_uniform(5e-3, 5e-2);
  const double across = size * random.log_uniform(0.05, 1), along = size * random.log_uniform(0.05, 1);
  double other = across;
  const double kind = random.uniform(0, 1);
  if (kind < 0.1) other *= 1 + random.log_uniform(1e-3, 1e-1);
  if (kind > 0.95) other *= random.uniform(1.1, 2.5);
  s.body.mass_kg = mass;
  set_principal(s.body, other + along, across + along, across + other);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.body.center_of_mass_m = {0, 0, l};
  const double mgl = mass * s.site.gravity_m_s2 * l, I1 = (across + other) / 2 + along + mass * l * l, I3 = across + other;
  const double critical = 2 * std::sqrt(I1 * mgl) / I3;
  const bool slow = random.uniform(0, 1) < 0.25;
  s.release.spin_rad_s =
      (random.coin() ? 1 : -1) * critical * (slow ? random.log_uniform(0.2, 1.2) : random.log_uniform(1.2, 20));
  const double precession = random.uniform(0, 1);
  if (precession > 0.75 || (precession > 0.45 && across != other)) {
    s.release.precession = Precession::given;
    s.release.precession_rate_rad_s = std::sqrt(mgl / I1) * random.uniform(-1.5, 1.5);
  } else if (precession > 0.45) {
    s.release.precession = precession > 0.6 ? Precession::steady_fast : Precession::steady_slow;
  }
  return random.log_uniform(1, 30);
}

/// The same top with equal moments across its axis, of which the rate of precession is known.
Scenario symmetric_twin(const Scenario& s) {
  Scenario twin = s;
  auto& I = twin.body.inertia_kg_m2;
  I[0][0] = I[1][1] = (I[0][0] + I[1][1]) / 2;
  twin.duration_s = twin.output_step_s = 1;
  return twin;
}

}  // namespace

std::optional<Scenario> random_trend_top(std::uint64_t index, double times, double most_seconds) {
  Random random(77'000 + index);
  const std::string_view kind = kTrendKinds[index % kTrendKinds.size()];
  Scenario s;
  s.name = std::string(kind) + "-" + std::to_string(index);
  std::optional<double> turns;
  set_place(random, s);
  if (kind == "any") turns = draw_any(random, s);
  if (kind == "toy") draw_toy(random, s);
  if (kind == "gyro") draw_gyro(random, s);
  if (kind == "hanging") draw_hanging(random, s);
  if (kind == "pendulum") draw_pendulum(random, s);
  if (kind == "upright") draw_upright(random, s);
  if (kind == "one_turn" || kind == "many_turns") {
    const double what = random.uniform(0, 1);
    what < 0.4 ? draw_toy(random, s) : what < 0.8 ? draw_gyro(random, s) : draw_hanging(random, s);
    turns = kind == "one_turn" ? random.uniform(1, 1.5) : random.log_uniform(30, 400);
  }
  if (kind == "asymmetric") draw_asymmetric(random, s), turns = random.log_uniform(1, 30);
  if (kind == "shipped") draw_shipped(random, s);
  if (kind == "effects") draw_effects(random, s);
  const double rows = random.coin() ? 20 : random.log_uniform(3, 1000);
  try {
    const TrendPlan plan = plan_trend(Scene(symmetric_twin(s)));
    if (!plan.frequencies) return std::nullopt;
    const double turn = kTurn / std::abs(plan.frequencies->precession_rad_s);
    if (turns) s.duration_s = *turns * turn;
    if (s.duration_s < turn) return std::nullopt;
    s.output_step_s = s.duration_s / std::ceil(rows);
    Scenario longer = s;
    longer.duration_s *= times, longer.output_step_s *= times;
    const Scene scene(longer);
    if (scene.method_refusal() || scene.costs()[0].seconds > most_seconds) return std::nullopt;
  } catch (const ScenarioError&) {  // a spin too slow for steady precession
    return std::nullopt;
  }
  return s;
}

std::optional<TrendJudged> judge_trend(const Scenario& scenario, double times) {
  const RunResult result = run(scenario);
  if (!result.drift.secular || !result.drift.secular->azimuth_rate_rad_s) return std::nullopt;
  Scenario longer = scenario;
  longer.duration_s *= times;
  longer.output_step_s *= times;
  const Scene scene(longer);
  std::optional<SecularDrift> truth;
  if (scene.symmetry_axis() == 2 && !scene.method_refusal(Method::taylor) &&
      scene.choice().options.method != Method::long_horizon) {
    truth = trend_of(longer);
  } else {
    const RunResult of_longer = run(scene);
    if (of_longer.verdict.verdict != Verdict::reliable) return std::nullopt;
    truth = of_longer.drift.secular;
  }
  if (!truth || !truth->azimuth_rate_rad_s || !(truth->window_s[1] > result.drift.secular->window_s[1])) return std::nullopt;
  TrendJudged judged{*result.drift.secular, {}, *truth->azimuth_rate_rad_s, *truth->azimuth_rate_bound_95_rad_s};
  if (!result.theory.empty()) judged.theory = result.theory.front();
  return judged;
}

}  // namespace earthtop::testing
