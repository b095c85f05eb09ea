// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes for the tests, made in code; the random ones are stratified over bodies, latitudes, matching rules and Earth rates.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>

#include "earthtop/run.hpp"

namespace earthtop::testing {

inline void set_principal(BodySpec& body, double I1, double I2, double I3) {
  body.inertia_kg_m2 = {{{I1, 0, 0}, {0, I2, 0}, {0, 0, I3}}};
}

/// The equations that a run can integrate: those of three observers, and the reduced ones of the laboratory for symmetric tops.
struct Equations {
  Observer observer;
  ModelForm form;
  void take(Scenario& scenario) const {
    scenario.numerics.observer = observer;
    scenario.numerics.form = form;
  }
  friend std::ostream& operator<<(std::ostream& out, const Equations& e) {
    return out << to_string(e.observer) << ", " << to_string(e.form);
  }
};
inline constexpr std::array kEquations{
    Equations{Observer::laboratory, ModelForm::general}, Equations{Observer::laboratory, ModelForm::automatic},
    Equations{Observer::body, ModelForm::general}, Equations{Observer::inertial, ModelForm::general}};

/// The toy top of the shipped scenario.
inline Scenario toy_top() {
  Scenario s;
  s.name = "toy-top";
  s.site = {45, 0, 0, 9.80665};
  s.body.mass_kg = 0.1;
  s.body.center_of_mass_m = {0, 0, 0.03};
  set_principal(s.body, 1.2e-4, 1.2e-4, 4e-5);
  s.release.tilt_deg = 20;
  s.release.azimuth_deg = 90;
  s.release.spin_rad_s = 200;
  s.duration_s = 60;
  s.output_step_s = 0.1;
  return s;
}

/// A top with a heavy flat rotor that precesses slowly; it leans by 0.5 rad toward the South.
inline Scenario heavy_rotor_top() {
  Scenario s = toy_top();
  s.body.mass_kg = 5;
  s.body.center_of_mass_m = {0, 0, 0.004};
  set_principal(s.body, 5e-4, 5e-4, 8e-4);
  s.release.quaternion_LB = {std::cos(0.25), std::sin(0.25), 0, 0};
  s.release.angular_velocity_body_rad_s = {0, 0, 200};
  s.duration_s = 1;
  s.output_step_s = 0.01;
  return s;
}

/// A top with three different moments and its centre of mass on axis 3.
inline Scenario asymmetric_top() {
  Scenario s = toy_top();
  s.name = "asymmetric-top";
  set_principal(s.body, 1.2e-4, 1.05e-4, 4e-5);
  s.release.tilt_deg = 100;
  s.release.spin_rad_s = 60;
  s.duration_s = 10;
  s.output_step_s = 0.02;
  return s;
}

/// The scenario on an Earth at rest.
inline Scenario non_rotating(Scenario s) {
  s.rotation_rate_rad_s = 0;
  return s;
}

/// Uniform random numbers that are the same on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool coin() { return (engine_() & 1) != 0; }
  double sign() { return coin() ? 1 : -1; }

 private:
  std::mt19937_64 engine_;
};

/// A place at a pole, on the equator or anywhere, with some gravity.
inline Site random_site(Random& random) {
  constexpr std::array kSpecial{90.0, -90.0, 0.0};
  const double where = random.uniform(0, 1);
  return {where < 0.3 ? kSpecial[static_cast<std::size_t>(where * 10)] : random.uniform(-90, 90), 0, 0,
          random.uniform(9.76, 9.84)};
}

/// A random top, over `radians` of its fastest rate: symmetric or not, centre of mass on the axis or anywhere, any latitude
/// (poles and equator among them), both matching rules, Earth rates from 1e-6 to 1 rad/s.
inline Scenario random_scene(std::uint64_t seed, double radians) {
  Random random(seed);
  Scenario s;
  s.name = "random-" + std::to_string(seed);
  const std::array<double, 5> special{90, -90, 0, 45, -30};
  const double latitude = seed % 3 == 0 ? special[(seed / 3) % 5] : random.uniform(-90, 90);
  s.site = {latitude, 0, 0, random.uniform(9.7, 9.9)};
  s.rotation_rate_rad_s = random.sign() * (seed % 2 == 0 ? kEarthRateWgs84 : random.log_uniform(1e-6, 1));
  // Inertia from three positive second moments about the centre of mass: always a physical body.
  const double size = random.log_uniform(1e-5, 1e-3);
  double s1 = size * random.uniform(0.1, 1);
  double s2 = size * random.uniform(0.1, 1), s3 = size * random.uniform(0.05, 1);
  const bool symmetric = seed % 2 == 1;
  if (symmetric) s2 = s1;
  s.body.mass_kg = random.log_uniform(0.02, 2);
  set_principal(s.body, s2 + s3, s1 + s3, s1 + s2);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  const double l = random.log_uniform(0.003, 0.05);
  s.body.center_of_mass_m = {0, 0, random.coin() ? l : -l};
  if (!symmetric && random.coin()) s.body.center_of_mass_m = {l * random.uniform(-1, 1), l * random.uniform(-1, 1), l};
  s.release.tilt_deg = random.uniform(5, 175);
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.rates_relative_to = (seed / 2) % 2 == 0 ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  const double spin = random.log_uniform(20, 600) * (random.coin() ? 1 : -1);
  if (random.coin()) {
    s.release.spin_rad_s = spin;
  } else {
    s.release.angular_velocity_body_rad_s = {spin * random.uniform(-0.2, 0.2), spin * random.uniform(-0.2, 0.2), spin};
  }
  s.duration_s = radians / std::abs(spin);
  s.output_step_s = s.duration_s / 100;
  return s;
}

}  // namespace earthtop::testing
