// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/strata.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "earthtop/model/body.hpp"
#include "earthtop/scene/scene.hpp"
#include "scenario/rules.hpp"
#include "support/travel_scenes.hpp"

namespace earthtop::testing {
namespace {

double spin_rate(Random& random) { return random.sign() * random.log_uniform(1, 1e5); }

/// A scene with random place, Earth, attitude and matching rule.
Scenario somewhere(Random& random) {
  Scenario s;
  s.site = random_site(random);
  const double rate = random.uniform(0, 1);
  if (rate < 0.1) s.rotation_rate_rad_s = random.log_uniform(1e-12, 1e-5);
  if (rate > 0.9) s.rotation_rate_rad_s = random.sign() * random.log_uniform(1e-3, 1);
  s.release.tilt_deg = random.uniform(1, 179);
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.rates_relative_to = random.coin() ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  return s;
}

/// Moments about the centre of mass from three second moments, which always belong to a physical body.
void set_body(Scenario& s, double s1, double s2, double s3, double mass, const std::array<double, 3>& center) {
  s.body.mass_kg = mass;
  set_principal(s.body, s2 + s3, s1 + s3, s1 + s2);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.body.center_of_mass_m = center;
}

Scenario symmetric_top(Random& random) {
  Scenario s = somewhere(random);
  const double size = random.log_uniform(1e-5, 1e-3), across = size * random.log_uniform(0.05, 1);
  set_body(s, across, across, size * random.log_uniform(0.02, 1), random.log_uniform(0.02, 2),
           {0, 0, random.log_uniform(0.003, 0.05)});
  return s;
}

Scenario asymmetric_body(Random& random) {
  Scenario s = somewhere(random);
  const double size = random.log_uniform(1e-5, 1e-3), l = random.log_uniform(0.003, 0.05);
  set_body(s, size * random.uniform(0.1, 1), size * random.uniform(0.1, 1), size * random.uniform(0.05, 1),
           random.log_uniform(0.02, 2), {l * random.uniform(-1, 1), l * random.uniform(-1, 1), l * random.uniform(-1, 1)});
  return s;
}

struct TopNumbers {
  double I1, I3, mgl;
  double falling_rate() const { return std::sqrt(std::abs(mgl) / I1); }
  double critical_spin() const { return 2 * std::sqrt(I1 * std::abs(mgl)) / I3; }
};
TopNumbers numbers(const Scenario& s) {
  const auto body = make_body<double>(s.body);
  return {body.I_BP_B(0, 0), body.I_BP_B(2, 2), body.mass * s.site.gravity_m_s2 * body.p_PBcm_B[2]};
}

Scenario any_spin(Random& random) {
  Scenario s = symmetric_top(random);
  s.release.spin_rad_s = spin_rate(random);
  return s;
}
Scenario fast_top(Random& random) {
  Scenario s = symmetric_top(random);
  s.release.spin_rad_s = random.sign() * std::min(1e5, numbers(s).critical_spin() * random.log_uniform(2, 1e3));
  return s;
}
Scenario slow_top(Random& random) {
  Scenario s = symmetric_top(random);
  s.release.spin_rad_s = random.sign() * numbers(s).critical_spin() * random.log_uniform(0.01, 1);
  return s;
}
Scenario precessing_top(Random& random) {
  Scenario s = any_spin(random);
  s.release.precession = Precession::given;
  s.release.precession_rate_rad_s = numbers(s).falling_rate() * random.uniform(-2, 2);
  return s;
}
Scenario steady_top(Random& random) {
  Scenario s = fast_top(random);
  s.release.tilt_deg = random.uniform(5, 85);
  s.release.precession = random.coin() ? Precession::steady_slow : Precession::steady_fast;
  return s;
}
Scenario sleeping_top(Random& random) {
  Scenario s = symmetric_top(random);
  s.release.tilt_deg = random.coin() ? 0 : random.log_uniform(1e-12, 1e-2);
  s.release.spin_rad_s = random.sign() * numbers(s).critical_spin() * (1 + random.log_uniform(1e-2, 10));
  return s;
}
Scenario falling_sleeper(Random& random) {
  Scenario s = sleeping_top(random);
  s.release.spin_rad_s = random.sign() * numbers(s).critical_spin() * random.uniform(0.05, 0.99);
  return s;
}
Scenario critical_sleeper(Random& random) {
  Scenario s = sleeping_top(random);
  s.release.spin_rad_s = random.sign() * numbers(s).critical_spin() * (1 + random.sign() * random.log_uniform(1e-6, 1e-1));
  return s;
}
Scenario pendulum(Random& random) {
  Scenario s = symmetric_top(random);
  s.body.center_of_mass_m[2] *= -1;
  s.release.tilt_deg = random.log_uniform(1e-3, 90);
  s.release.spin_rad_s = random.coin() ? 0 : spin_rate(random) / 100;
  return s;
}
Scenario homoclinic_top(Random& random) {
  Scenario s = symmetric_top(random);
  const TopNumbers top = numbers(s);
  s.release.tilt_deg = 60;
  s.release.precession = Precession::given;
  s.release.precession_rate_rad_s = 2 * top.falling_rate() / std::sqrt(3.0);
  s.release.spin_rad_s =
      std::sqrt(3.0) * top.falling_rate() * top.I1 / top.I3 * (1 + random.sign() * random.log_uniform(1e-12, 1e-2));
  return s;
}
Scenario needle_or_disc(Random& random) {
  Scenario s = any_spin(random);
  const double size = random.log_uniform(1e-5, 1e-3), small = size * random.log_uniform(1e-9, 1e-3);
  const bool needle = random.coin();
  set_body(s, needle ? small : size, needle ? small : size, needle ? size : 0, s.body.mass_kg, s.body.center_of_mass_m);
  s.release.spin_rad_s = random.sign() * random.log_uniform(1, 1e3);
  return s;
}
Scenario nearly_symmetric(Random& random) {
  Scenario s = any_spin(random);
  auto& moments = s.body.inertia_kg_m2;
  moments[1][1] = moments[0][0] * (1 + random.log_uniform(1e-15, 1e-3));
  s.release.spin_rad_s = random.sign() * random.log_uniform(1, 1e3);
  return s;
}
Scenario balanced_gyro(Random& random) {
  Scenario s = any_spin(random);
  s.body.center_of_mass_m = {0, 0, 0};
  return s;
}
Scenario free_body(Random& random) {
  Scenario s = asymmetric_body(random);
  s.body.center_of_mass_m = {0, 0, 0};
  const double rate = random.log_uniform(1, 1e4);
  s.release.angular_velocity_body_rad_s = {rate * random.uniform(-1, 1), rate * random.uniform(-1, 1),
                                           rate * random.uniform(-1, 1)};
  return s;
}
Scenario middle_axis(Random& random) {
  Scenario s = somewhere(random);
  set_principal(s.body, 1, 1 + random.uniform(0.2, 0.8), 2);
  s.body.mass_kg = 10;
  const double rate = random.log_uniform(1, 1e3), seed = rate * random.log_uniform(1e-12, 1e-1);
  s.release.angular_velocity_body_rad_s = {seed, rate, -seed};
  return s;
}
Scenario asymmetric_fast(Random& random) {
  Scenario s = asymmetric_body(random);
  const TopNumbers top = numbers(s);
  const double rate = random.sign() * std::max(top.falling_rate(), 20.0) * random.log_uniform(5, 300);
  s.release.angular_velocity_body_rad_s = {rate * random.uniform(-0.2, 0.2), rate * random.uniform(-0.2, 0.2), rate};
  return s;
}
Scenario asymmetric_slow(Random& random) {
  Scenario s = asymmetric_body(random);
  const double rate = 10 * random.log_uniform(0.01, 3);
  s.release.angular_velocity_body_rad_s = {rate * random.uniform(-1, 1), rate * random.uniform(-1, 1),
                                           rate * random.uniform(-1, 1)};
  return s;
}
Scenario on_platform(Random& random) {
  Scenario s = random.coin() ? any_spin(random) : asymmetric_fast(random);
  if (!s.release.angular_velocity_body_rad_s) s.release.spin_rad_s = random.sign() * random.log_uniform(10, 1e3);
  constexpr std::array kMotions{PlatformMotion::constant, PlatformMotion::ramp, PlatformMotion::harmonic};
  s.platform = PlatformSpec{kMotions[static_cast<std::size_t>(random.uniform(0, 3))],
                            {random.uniform(-1, 1), random.uniform(-1, 1), 1},
                            random.uniform(-3, 3),
                            random.uniform(-1, 1),
                            random.uniform(0, 0.3),
                            random.log_uniform(0.05, 2),
                            random.uniform(-180, 180),
                            {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)}};
  return s;
}
Scenario journey(Random& random) {
  Scenario s = random.coin() ? any_spin(random) : asymmetric_fast(random);
  if (!s.release.angular_velocity_body_rad_s) s.release.spin_rad_s = random.sign() * random.log_uniform(10, 1e3);
  s.duration_s = 1;
  s.duration_s = 20 / Scene(s).fastest_rate_rad_s();  // so that its legs end in most of the runs
  send_on_journey(s, random, s.duration_s);
  return s;
}
Scenario torque_left_out(Random& random) {
  Scenario s = random.coin() ? fast_top(random) : asymmetric_fast(random);
  (random.coin() ? s.effects.coriolis : s.effects.centrifugal) = false;
  return s;
}
Scenario long_horizon(Random& random) {
  Scenario s = fast_top(random);
  s.release.spin_rad_s = random.sign() * std::min(1e5, numbers(s).critical_spin() * random.log_uniform(3, 300));
  s.numerics.method = Method::long_horizon;  // in minutes where auto takes it from half an hour on
  return s;
}

/// Ratios of precession to nutation from 1e-5 to 0.5, tilts to a tenth of a degree from either vertical, let go or thrown sidewards. Those that
/// have no Fourier sums are passed over.
Scenario fourier_sums(Random& random) {
  for (;;) {
    Scenario s = symmetric_top(random);
    if (random.coin()) s.rotation_rate_rad_s = random.log_uniform(1e-8, 1e-3);
    const double tilt = random.log_uniform(0.1, 90);
    s.release.tilt_deg = random.coin() ? tilt : 180 - tilt;
    const double spin = random.sign() * std::min(1e5, numbers(s).critical_spin() * random.log_uniform(0.7, 150));
    const double sidewards = random.coin() ? numbers(s).falling_rate() * random.log_uniform(1e-3, 1) : 0;
    s.release.angular_velocity_body_rad_s = {sidewards * random.uniform(-1, 1), sidewards * random.uniform(-1, 1), spin};
    s.numerics.method = Method::fourier;
    if (!Scene(s).method_refusal()) return s;
  }
}

Scenario in_long_double(Random& random) {
  Scenario s = random.coin() ? any_spin(random) : asymmetric_fast(random);
  if (!s.release.angular_velocity_body_rad_s) s.release.spin_rad_s = random.sign() * random.log_uniform(10, 1e3);
  s.precision = Precision::bits64;
  s.numerics.relative_tolerance = default_tolerance(s.precision);
  return s;
}
Scenario other_observer(Random& random) {
  Scenario s = random.coin() ? precessing_top(random) : asymmetric_body(random);
  if (!s.release.angular_velocity_body_rad_s) s.release.spin_rad_s = random.sign() * random.log_uniform(1, 1e3);
  s.numerics.observer = random.coin() ? Observer::inertial : Observer::body;
  return s;
}

Scenario with_effects(Random& random) {
  Scenario s = random.coin() ? symmetric_top(random) : asymmetric_body(random);
  const double rate = random.sign() * random.log_uniform(3, 1e3);
  s.release.angular_velocity_body_rad_s = {rate * random.uniform(-0.2, 0.2), rate * random.uniform(-0.2, 0.2), rate};
  AppliedTorquesSpec& applied = s.effects.applied;
  const double I3 = numbers(s).I3;
  if (random.coin()) applied.viscous_N_m_s = I3 * random.log_uniform(1e-4, 3);
  if (random.coin()) applied.quadratic_N_m_s2 = I3 * random.log_uniform(1e-4, 3) / std::abs(rate);
  if (random.uniform(0, 1) < 0.2) applied.coulomb_N_m = I3 * std::abs(rate) * random.log_uniform(1e-4, 3);
  if (random.coin()) applied.air_drag = AirDragSpec{random.uniform(0.01, 0.1)};
  if (random.coin()) applied.gravity_gradient = GravityGradientSpec{GradientField::given, random.log_uniform(1e-6, 1)};
  if (random.coin())
    s.effects.tide = TideSpec{true, {}, {random.uniform(-1, 1), random.uniform(-1, 1), 0.1}, random.log_uniform(0.01, 10), 30};
  return s;
}
/// A support from a thousandth of gravity's torque to three times it: on hanging pendulums on their ellipses, and on any other
/// body.
Scenario unequal_support(Random& random) {
  Scenario s = random.coin() ? pendulum(random) : random.coin() ? symmetric_top(random) : asymmetric_body(random);
  if (!s.release.angular_velocity_body_rad_s && s.release.spin_rad_s == 0 && random.coin())
    s.release.spin_rad_s = random.sign() * random.log_uniform(3, 1e3);
  UnequalSupportSpec& support = s.effects.applied.unequal_support.emplace();
  const double weight = s.body.mass_kg * s.site.gravity_m_s2 * norm(make_body<double>(s.body).p_PBcm_B);
  support.kappa_N_m = random.sign() * weight * random.log_uniform(1e-3, 3);
  support.azimuth_deg = random.uniform(-180, 180);
  return s;
}
/// A torque from a thousandth of gravity's to three times it, in either axes, constant or harmonic.
Scenario given_torque(Random& random) {
  Scenario s = random.coin() ? symmetric_top(random) : asymmetric_body(random);
  s.release.spin_rad_s = random.sign() * random.log_uniform(3, 1e3);
  GivenTorqueSpec& given = s.effects.applied.given_torque.emplace();
  given.axes = random.coin() ? TorqueAxes::body : TorqueAxes::laboratory;
  const double size =
      s.body.mass_kg * s.site.gravity_m_s2 * norm(make_body<double>(s.body).p_PBcm_B) * random.log_uniform(1e-3, 3);
  const bool along_axis = random.coin();
  for (double& part : given.torque_N_m) part = along_axis ? 0 : size * random.uniform(-1, 1);
  if (along_axis) given.torque_N_m[2] = size;
  if (random.coin()) {
    given.course = TorqueCourse::harmonic;
    given.frequency_hz = random.log_uniform(0.01, 30), given.phase_deg = random.uniform(-180, 180);
  }
  return s;
}
Scenario friction_by_axes(Random& random) {
  Scenario s = random.coin() ? symmetric_top(random) : asymmetric_body(random);
  const double rate = random.sign() * random.log_uniform(3, 1e3), I3 = numbers(s).I3;
  s.release.angular_velocity_body_rad_s = {rate * random.uniform(-0.2, 0.2), rate * random.uniform(-0.2, 0.2), rate};
  std::array<double, 3>& k = s.effects.applied.viscous_by_axis_N_m_s.emplace();
  for (double& one : k) one = I3 * random.log_uniform(1e-4, 3);
  if (random.coin()) k[1] = k[0];
  return s;
}
/// A gyrocompass in motion, not a settled one: its spin is fast compared with the effect of its damping.
Scenario level_gimbal(Random& random) {
  Scenario s = any_spin(random);
  s.release.spin_rad_s = random.sign() * random.log_uniform(30, 3e3);
  s.release.tilt_deg = 90;
  s.release.rates_relative_to = RatesRelativeTo::laboratory;
  if (random.coin()) s.body.center_of_mass_m = {0, 0, 0};
  s.effects.applied.gimbal = GimbalSpec{random.coin() ? 0 : numbers(s).I1 * random.log_uniform(1e-4, 1)};
  return s;
}

/// Dry friction that takes the spin in a phase of 5 to 2,000 rad: so some of the scenes come to rest, others do not.
/// @param held  whether friction can hold the body against gravity, so that both motions end at rest
Scenario dry_friction(Random& random, bool symmetric, bool held) {
  Scenario s = symmetric ? symmetric_top(random) : asymmetric_body(random);
  if (!symmetric && random.coin()) s.body.center_of_mass_m[0] = s.body.center_of_mass_m[1] = 0;
  const double rate = random.sign() * random.log_uniform(3, 1e3);
  if (symmetric && random.coin())
    s.release.spin_rad_s = rate;
  else
    s.release.angular_velocity_body_rad_s = {rate * random.uniform(-0.5, 0.5), rate * random.uniform(-0.5, 0.5), rate};
  const double least_phase = 5;
  const double phase = held ? random.log_uniform(least_phase, 200) : random.log_uniform(100, 1e5);
  const double torque = numbers(s).I3 * rate * rate / phase;
  s.effects.applied.coulomb_N_m = torque;
  if (!held) return s;
  // The body leans so little, or its centre of mass is so near the pivot, that gravity cannot move it from rest.
  const double most = random.log_uniform(1e-3, 0.9) * torque, weight = s.body.mass_kg * s.site.gravity_m_s2;
  auto& center = s.body.center_of_mass_m;
  const double lever = std::hypot(center[0], center[1], center[2]);
  if (center[0] == 0 && random.coin()) {
    if (const double sine = most / (weight * lever); sine < 1) s.release.tilt_deg = std::asin(sine) * 180 / std::numbers::pi;
  } else if (weight * lever > most) {
    for (double& part : center) part *= most / (weight * lever);
  }
  return s;
}
Scenario dry_symmetric_held(Random& random) { return dry_friction(random, true, true); }
Scenario dry_symmetric(Random& random) { return dry_friction(random, true, false); }
Scenario dry_asymmetric_held(Random& random) { return dry_friction(random, false, true); }
Scenario dry_asymmetric(Random& random) { return dry_friction(random, false, false); }

/// Any of the seven ways to leave out one, two or all of [F]'s torques, with spins up to 1e4 rad/s.
Scenario torques_left_out(Random& random) {
  Scenario s = random.coin() ? symmetric_top(random) : asymmetric_body(random);
  const double rate = random.sign() * random.log_uniform(3, 1e4);
  if (random.coin())
    s.release.spin_rad_s = rate;
  else
    s.release.angular_velocity_body_rad_s = {rate * random.uniform(-0.5, 0.5), rate * random.uniform(-0.5, 0.5), rate};
  const int kept = static_cast<int>(random.uniform(0, 7));
  s.effects.coriolis = (kept & 1) != 0, s.effects.centrifugal = (kept & 2) != 0, s.effects.transverse = (kept & 4) != 0;
  if (random.coin()) {
    // The transverse torque acts only where the laboratory's rate changes.
    s.platform = PlatformSpec{PlatformMotion::harmonic,  {random.uniform(-1, 1), random.uniform(-1, 1), 1},
                              random.uniform(-3, 3),     0,
                              random.uniform(0, 0.3),    random.log_uniform(0.05, 2),
                              random.uniform(-180, 180), {0, 0, 0}};
  }
  return s;
}

constexpr Stratum kStrata[] = {
    {"any spin, let go at rest", any_spin},
    {"fast top", fast_top},
    {"slow top", slow_top},
    {"given precession", precessing_top},
    {"steady precession", steady_top},
    {"sleeping", sleeping_top},
    {"falling sleeper", falling_sleeper},
    {"near the critical spin", critical_sleeper},
    {"pendulum", pendulum},
    {"near the homoclinic", homoclinic_top},
    {"needle or disc", needle_or_disc},
    {"nearly symmetric", nearly_symmetric},
    {"balanced gyroscope", balanced_gyro},
    {"free body", free_body},
    {"about the middle axis", middle_axis},
    {"asymmetric, fast", asymmetric_fast},
    {"asymmetric, slow", asymmetric_slow},
    {"on a platform", on_platform},
    {"a torque left out", torque_left_out},
    {"another observer's equations", other_observer},
    {"in long double", in_long_double},
    {"long horizon", long_horizon},
    {"with friction, air, a gradient, a tide", with_effects, true},
    {"in a gimbal that holds it level", level_gimbal, true},
    {"dry friction, symmetric, held at rest", dry_symmetric_held, true},
    {"dry friction, symmetric", dry_symmetric, true},
    {"dry friction, asymmetric, held at rest", dry_asymmetric_held, true},
    {"dry friction, asymmetric", dry_asymmetric, true},
    {"torques left out", torques_left_out, true},
    {"Fourier sums", fourier_sums},
    {"unequal support", unequal_support, true},
    {"given torque", given_torque, true},
    {"friction of body axes apart", friction_by_axes, true},
    {"on a journey", journey},
};

/// A random one of the methods that a user may name for this scene.
Method any_method(const Scenario& scenario, Random& random) {
  std::array<Method, kMethodCount> allowed;
  std::size_t count = 0;
  const Scene scene(scenario);
  for (const MethodRow& row : kMethodRows)
    if (row.method != Method::automatic && is_built(row.method, scenario.precision) && !scene.method_refusal(row.method))
      allowed[count++] = row.method;
  return allowed.at(static_cast<std::size_t>(random.uniform(0, static_cast<double>(count))));
}

}  // namespace

std::span<const Stratum> strata() { return kStrata; }

Scenario random_scene_by_hand(const Stratum& stratum, std::uint64_t index, double least_phase, double largest_phase) {
  Scenario s = random_scene_of(stratum, index, least_phase, largest_phase);
  s.name = "by-hand" + s.name.substr(s.name.find('-'));
  Random random(index * 1009 + static_cast<std::uint64_t>(&stratum - kStrata));
  s.numerics = {};
  s.numerics.method = any_method(s, random);
  do {
    constexpr std::array kObservers{Observer::laboratory, Observer::body, Observer::inertial};
    s.numerics.observer = kObservers[static_cast<std::size_t>(random.uniform(0, 3))];
    s.numerics.form = random.coin() ? ModelForm::automatic : ModelForm::general;
  } while (Scene(s).method_refusal(s.numerics.method));
  if (s.numerics.method == Method::splitting)
    s.numerics.composition =
        scenario::kCompositions.at(static_cast<std::size_t>(random.uniform(0, double{scenario::kCompositions.size()})));
  const auto rule = row_of(s.numerics.method);
  if (rule.step_s == Need::required || (rule.step_s == Need::optional && random.coin()))
    s.numerics.step_s = random.log_uniform(0.01, 0.15) / Scene(s).fastest_rate_rad_s();
  const double least = s.precision == Precision::bits53 ? 1e-13 : 10 * least_tolerance(s.precision);
  s.numerics.relative_tolerance = s.numerics.step_s ? default_tolerance(s.precision) : random.log_uniform(least, 1e-6);
  return s;
}

Scenario random_survey_scene(const Stratum& stratum, std::uint64_t index, double least_phase, double largest_phase) {
  Scenario s = random_scene_of(stratum, index, least_phase, largest_phase);
  s.name = "survey" + s.name.substr(s.name.find('-'));
  Random random(index * 2003 + static_cast<std::uint64_t>(&stratum - kStrata) * 7'000'003);
  constexpr double kMostRows = 60, kWide = 0.2, kOtherTolerance = 0.4;
  const double rows = std::floor(random.log_uniform(2, kMostRows));
  s.duration_s *= random.uniform(0.2, 1);
  s.output_step_s = s.duration_s / rows;
  if (random.uniform(0, 1) < kWide && s.numerics.method == Method::automatic) s.precision = Precision::bits64;
  s.numerics.relative_tolerance = default_tolerance(s.precision);
  if (random.uniform(0, 1) < kOtherTolerance)
    s.numerics.relative_tolerance = random.log_uniform(s.precision == Precision::bits53 ? 1e-13 : 1e-17, 1e-8);
  return s;
}

Scenario random_scene_of(const Stratum& stratum, std::uint64_t index, double least_phase, double largest_phase) {
  const auto number = static_cast<std::uint64_t>(&stratum - kStrata);
  Random random(number * 1'000'003 + index);
  Scenario s = stratum.make(random);
  s.name = "random-" + std::to_string(number) + "-" + std::to_string(index);
  s.duration_s = 1;  // for a platform that spins up
  s.duration_s = random.log_uniform(least_phase, largest_phase) / Scene(s).fastest_rate_rad_s();
  s.output_step_s = s.duration_s / 12;
  return s;
}

}  // namespace earthtop::testing
