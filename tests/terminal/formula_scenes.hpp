// SPDX-License-Identifier: GPL-3.0-or-later
/// Random scenes whose summaries have formulas, and the values of the formulas' symbols.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "earthtop/frames/earth.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/run.hpp"
#include "terminal/formula_reader.hpp"

namespace earthtop::formulas {

inline Symbols symbols_of(const RunResult& result, double t_s) {
  const Scenario& s = result.scene.scenario();
  const Body<double>& body = result.scene.body<double>();
  const long double degree = kPi / 180, Omega = s.rotation_rate_rad_s, phi = s.site.latitude_deg * degree;
  const Vec3<double> pole = celestial_axis_L<double>(s.site);
  const long double tilt = s.release.tilt_deg * degree, azimuth = s.release.azimuth_deg * degree;
  const long double n[3] = {std::sin(tilt) * std::sin(azimuth), std::sin(tilt) * std::cos(azimuth), std::cos(tilt)};
  const long double c[3] = {pole[0], s.site.follows_ellipsoid() ? std::cos(phi) : pole[1],
                            s.site.follows_ellipsoid() ? std::sin(phi) : pole[2]};
  const long double along = n[0] * c[0] + n[1] * c[1] + n[2] * c[2];
  const long double across = std::hypot(n[1] * c[2] - n[2] * c[1], n[2] * c[0] - n[0] * c[2], n[0] * c[1] - n[1] * c[0]);
  const long double spin = s.release.spin_rad_s, I3 = body.I_BP_B(2, 2);
  const long double mgl = static_cast<long double>(body.mass) * s.site.gravity_m_s2 * body.p_PBcm_B[2];
  return {{"Ω", Omega},
          {"Omega", Omega},
          {"Ω_up", Omega * c[2]},
          {"Omega_up", Omega * c[2]},
          {"Ω_north", Omega * (s.effects.applied.gimbal ? std::hypot(c[0], c[1]) : c[1])},
          {"Omega_north", Omega * c[1]},
          {"latitude", phi},
          {"π", kPi},
          {"α", std::atan2(across, along)},
          {"angle from the celestial axis", std::atan2(across, along)},
          {"t", t_s},
          {"I", I3},
          {"I1", body.I_BP_B(0, 0)},
          {"I2", body.I_BP_B(1, 1)},
          {"I3", I3},
          {"m", body.mass},
          {"g", s.site.gravity_m_s2},
          {"l", body.p_PBcm_B[2]},
          {"r", s.contact ? s.contact->tip_radius_m : 0},
          {"ω", spin},
          {"ω3", spin},
          {"w3", spin},
          {"its lean", std::abs(I3 * spin * Omega * c[1] / mgl)}};
}

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double a, double b) { return std::uniform_real_distribution(a, b)(random_); }
  double log_between(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  double sign() { return between(-1, 1) < 0 ? -1 : 1; }
  bool one_in(int n) { return between(0, n) < 1; }

  /// A symmetric top at a site, let go at rest but for its spin. @param most_earth  times the Earth's rate
  Scenario top(double most_earth) {
    Scenario s;
    s.name = "drawn";
    s.site = {between(-80, 80), 0, 0, between(9.78, 9.83)};
    if (one_in(4)) s.site.deflection = {between(-30, 30), between(-30, 30)};
    if (one_in(8)) s.site.pole = {between(-0.5, 0.5), between(-0.5, 0.5)};
    s.rotation_rate_rad_s *= sign() * log_between(1, most_earth);
    const double mass = log_between(0.01, 2), radius = log_between(0.01, 0.1), length = radius * between(0.1, 2);
    s.body.mass_kg = mass;
    s.body.inertia_about = InertiaAbout::center_of_mass;
    const double across = mass * (3 * radius * radius + length * length) / 12, along = mass * radius * radius / 2;
    s.body.inertia_kg_m2 = {{{across, 0, 0}, {0, across, 0}, {0, 0, along}}};
    s.body.center_of_mass_m = {0, 0, radius * between(0.3, 1.5)};
    s.release.tilt_deg = between(2, 150);
    s.release.azimuth_deg = between(-180, 180);
    s.release.spin_angle_deg = between(0, 360);
    s.release.spin_rad_s = sign() * log_between(50, 1000);
    return s;
  }
  static void last(Scenario& s, double duration_s) { s.duration_s = duration_s, s.output_step_s = duration_s / 8; }

  Scenario compass() {
    Scenario s = top(5000);
    s.body.center_of_mass_m = {0, 0, 0};
    s.effects.applied.gimbal = GimbalSpec{};
    s.release.tilt_deg = 90;
    const double north = s.rotation_rate_rad_s * s.release.spin_rad_s > 0 ? 0 : 180;
    s.release.azimuth_deg = north + sign() * between(0.2, 28);
    const auto& I = s.body.inertia_kg_m2;
    const double rate = std::sqrt(std::abs(I[2][2] * s.release.spin_rad_s * s.rotation_rate_rad_s *
                                           std::cos(s.site.latitude_deg * std::numbers::pi / 180) / I[0][0]));
    last(s, between(5, 25) / rate);
    return s;
  }
  Scenario precessing() {
    Scenario s = top(one_in(3) ? 100 : 1);
    const double mgl = s.body.mass_kg * s.site.gravity_m_s2 * s.body.center_of_mass_m[2];
    const double I3 = s.body.inertia_kg_m2[2][2];
    const double I1 = s.body.inertia_kg_m2[0][0] + mgl * s.body.center_of_mass_m[2] / s.site.gravity_m_s2;
    s.release.spin_rad_s = sign() * between(1.1, 6) * 2 * std::sqrt(I1 * mgl) / I3;
    const double slow = mgl / (I3 * s.release.spin_rad_s);
    if (one_in(3)) s.release.precession = Precession::given, s.release.precession_rate_rad_s = slow * between(-3, 5);
    if (one_in(3)) s.release.rates_relative_to = RatesRelativeTo::inertial;
    last(s, between(1.2, 4) * 2 * std::numbers::pi / std::abs(slow));
    return s;
  }
  Scenario free_gyro() {
    Scenario s = top(1000);
    s.body.center_of_mass_m = {0, 0, 0};
    if (!one_in(3)) s.release.rates_relative_to = RatesRelativeTo::inertial;
    last(s, between(1, 20));
    return s;
  }
  Scenario sleeping() {
    Scenario s = precessing();
    s.release = {.tilt_deg = 0, .rates_relative_to = s.release.rates_relative_to, .spin_rad_s = s.release.spin_rad_s};
    s.duration_s *= 3;
    return s;
  }
  Scenario pendulum() {
    Scenario s = top(1);
    const double length = log_between(0.3, 3);
    s.body.center_of_mass_m = {0, 0, -length};
    s.release.tilt_deg = between(0.05, 1), s.release.spin_rad_s = 0;
    last(s, between(20, 60) * 2 * std::sqrt(length));
    return s;
  }
  /// A ball, or a sleeping top, that rolls on a table.
  Scenario rolling(bool ball) {
    Scenario s = top(1);
    s.release = {.spin_rad_s = sign() * between(150, 350)};
    s.site.deflection = {}, s.site.pole = {};
    const double radius = between(0.01, 0.04), moment = 0.4 * 0.2 * radius * radius;
    s.body.mass_kg = 0.2;
    s.body.center_of_mass_m = {0, 0, ball ? 0 : 0.025};
    s.body.inertia_kg_m2 = {{{moment, 0, 0}, {0, moment, 0}, {0, 0, moment}}};
    if (!ball)
      s.body.inertia_kg_m2 = {{{5e-5, 0, 0}, {0, 5e-5, 0}, {0, 0, 6e-5}}}, s.release.spin_rad_s = sign() * between(230, 400);
    s.contact.emplace().tip_radius_m = ball ? radius : between(0.001, 0.004);
    s.contact->law = ContactLaw::rolling;
    last(s, ball ? 8 : 40);
    return s;
  }
  /// A top on which something else acts, or one that is not symmetric.
  Scenario other() {
    Scenario s = top(1);
    last(s, 1);
    s.release.spin_rad_s = sign() * between(20, 100);
    if (one_in(2)) s.effects.applied.viscous_N_m_s = log_between(1e-8, 1e-5);
    if (one_in(4)) s.effects.applied.coulomb_N_m = log_between(1e-6, 1e-4);
    if (one_in(3)) s.body.inertia_kg_m2[1][1] *= 1.1;
    if (one_in(6)) s.effects.coriolis = false;
    if (one_in(6)) s.platform.emplace().rate_rad_s = 0.1;
    if (one_in(3)) s.body.center_of_mass_m = {0, 0, 0};
    if (one_in(6)) s.rotation_rate_rad_s = 0;
    return s;
  }

 private:
  std::mt19937 random_;
};

struct Drawn {
  std::string kind;
  Scenario scenario;
};
inline std::vector<Drawn> drawn_scenes() {
  Draw draw(20261126);
  std::vector<Drawn> scenes;
  const auto add = [&](int count, const char* kind, const auto& make) {
    for (int i = 0; i < count; ++i) scenes.push_back({fmt::format("{} {}", kind, i), make()});
  };
  add(45, "compass", [&] { return draw.compass(); });
  add(45, "precessing", [&] { return draw.precessing(); });
  add(25, "free gyroscope", [&] { return draw.free_gyro(); });
  add(15, "sleeping", [&] { return draw.sleeping(); });
  add(20, "pendulum", [&] { return draw.pendulum(); });
  add(12, "ball", [&] { return draw.rolling(true); });
  add(12, "walker", [&] { return draw.rolling(false); });
  add(26, "other", [&] { return draw.other(); });
  return scenes;
}

}  // namespace earthtop::formulas
