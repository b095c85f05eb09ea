// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene for each effect of the catalogue (budget/effects.hpp), and for each branch of its formula. Every effect is so strong that
/// it changes the motion of `fast_earth_top` by much more than the error of two runs.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "support/effect_scenes.hpp"

namespace earthtop::testing {

struct EffectCase {
  std::string effect;  ///< its name in the catalogue
  std::string name;    ///< of the branch
  std::function<void(Scenario&)> add;
  std::function<void(Scenario&)> leave_out;  ///< takes the effect, and nothing else, out of a scene to which it was added
};

/// An Earth that turns once in a minute and a half: its drift is large, and its square counts.
inline Scenario fast_earth_top() {
  Scenario s = toy_top();
  s.rotation_rate_rad_s = 0.07;
  s.duration_s = 2;
  s.output_step_s = 0.25;
  return s;
}

/// A platform whose angle is a table of a slow swing.
inline PlatformSpec swinging_table() {
  AngleTable table;
  for (int i = 0; i <= 10; ++i) table.t_s.push_back(0.3 * i), table.value.push_back(0.2 * std::sin(0.9 * i));
  PlatformSpec platform{PlatformMotion::table, {0.1, 0.2, 1}, 0, 0, 0, 0, 0, {0.1, 0.02, 0.05}};
  platform.table.rows = std::make_shared<const AngleTable>(std::move(table));
  return platform;
}

/// Torques, fields and platforms that drive any top, or brake it.
inline std::vector<EffectCase> driving_cases() {
  const auto applied = [](std::string effect, std::string name, auto change) {
    return EffectCase{std::move(effect), std::move(name), [change](Scenario& s) { change(s.effects.applied); },
                      [](Scenario& s) { s.effects.applied = {}; }};
  };
  using Applied = AppliedTorquesSpec;
  std::vector<EffectCase> cases = {
      applied("viscous_torque", "viscous", [](Applied& a) { a.viscous_N_m_s = 1e-5; }),
      applied("quadratic_torque", "quadratic", [](Applied& a) { a.quadratic_N_m_s2 = 1e-7; }),
      applied("coulomb_torque", "dry", [](Applied& a) { a.coulomb_N_m = 1e-3; }),
      applied("air_drag", "laminar", [](Applied& a) { a.air_drag.emplace().disc_radius_m = 0.1; }),
      applied("air_drag", "turbulent",
              [](Applied& a) { a.air_drag = AirDragSpec{.disc_radius_m = 0.1, .flow = DiscFlow::turbulent}; }),
      applied("viscous_torque", "viscous across and along",
              [](Applied& a) {
                a.viscous_by_axis_N_m_s = {6e-7, 6e-7, 2e-7};
              }),
      applied("unequal_support", "support",
              [](Applied& a) { a.unequal_support = UnequalSupportSpec{.kappa_N_m = 4e-3, .azimuth_deg = 35}; }),
      applied("given_torque", "torque along the axis",
              [](Applied& a) {
                a.given_torque = GivenTorqueSpec{.torque_N_m = {0, 0, -1.5e-3}};
              }),
      applied("given_torque", "torque of the laboratory",
              [](Applied& a) {
                a.given_torque = GivenTorqueSpec{.course = TorqueCourse::harmonic,
                                                 .axes = TorqueAxes::laboratory,
                                                 .torque_N_m = {1e-4, -8e-5, 6e-5},
                                                 .frequency_hz = 0.8,
                                                 .phase_deg = 40};
              }),
      applied("gravity_gradient", "gradient",
              [](Applied& a) {
                a.gravity_gradient = GravityGradientSpec{GradientField::given, 50};
              }),
      {"eotvos", "plumb line aboard", [](Scenario& s) { s.travel = TravelSpec{.course_deg = 60, .speed_m_s = 20}; },
       [](Scenario& s) { s.travel->eotvos = TravelEotvos::off; }},
      {"ballistic", "change of speed, course and height",
       [](Scenario& s) {
         s.travel = TravelSpec{.course_deg = 60, .speed_m_s = 5, .legs = {{1, 4.0, 40, 0.1}}};
       },
       [](Scenario& s) { s.travel.reset(); }},
      {"transport", "way over the Earth",
       [](Scenario& s) {
         s.travel = TravelSpec{.path = TravelPath::geodesic, .course_deg = -60, .speed_m_s = 20};
         s.travel->eotvos = TravelEotvos::both;
         s.travel->figure = TravelFigure::sphere, s.travel->radius_m = 2000;  // a planet on which the way turns the laboratory
       },
       [](Scenario& s) { s.travel.reset(); }},
      {"tide", "tide",
       [](Scenario& s) {
         TideSpec& tide = s.effects.tide.emplace();
         tide.given = true, tide.amplitude_m_s2 = {0.3, 0.2, -0.1}, tide.frequency_hz = 0.7, tide.phase_deg = 20;
       },
       [](Scenario& s) { s.effects.tide.reset(); }},
      {"platform_motion", "platform",
       [](Scenario& s) {
         s.platform = PlatformSpec{PlatformMotion::harmonic, {0.2, 0.1, 1}, 0, 0, 0.3, 0.8, 30, {0.1, 0.02, 0.05}};
         s.effects.applied.viscous_N_m_s = 1e-5;  // which rubs on the platform
       },
       [](Scenario& s) { s.platform.reset(); }},
      {"platform_motion", "ramp",
       [](Scenario& s) {
         s.platform = PlatformSpec{PlatformMotion::ramp, {0, 0, 1}, 0.05, 0.75, 0, 0, 0, {0.3, 0.1, 0}};
       },
       [](Scenario& s) { s.platform.reset(); }}};
  return cases;
}

/// A torque of the laboratory that a table gives.
inline GivenTorqueSpec torque_by_table() {
  GivenTorqueSpec given{.course = TorqueCourse::table, .axes = TorqueAxes::laboratory};
  for (std::size_t k = 0; k < 3; ++k) {
    AngleTable table;
    for (int i = 0; i <= 10; ++i)
      table.t_s.push_back(0.3 * i), table.value.push_back(3e-3 * std::sin(0.9 * i + 2 * static_cast<double>(k)));
    given.components[k].rows = std::make_shared<const AngleTable>(std::move(table));
  }
  return given;
}

/// All cases: those above, a platform whose angle has jumps in its third derivative, and what changes the Earth's rotation, its
/// torques, the release or the constraint.
inline std::vector<EffectCase> effect_cases() {
  std::vector<EffectCase> cases = driving_cases();
  cases.push_back({"platform_motion", "table", [](Scenario& s) { s.platform = swinging_table(); },
                   [](Scenario& s) { s.platform.reset(); }});
  const auto applied = [&](std::string effect, std::string name, auto change) {
    cases.push_back({std::move(effect), std::move(name), [change](Scenario& s) { change(s.effects.applied); },
                     [](Scenario& s) { s.effects.applied = {}; }});
  };
  using Applied = AppliedTorquesSpec;
  applied("viscous_torque", "viscous by axis", [](Applied& a) { a.viscous_by_axis_N_m_s = {3e-5, 1e-5, 2e-5}; });
  applied("given_torque", "torque of the body", [](Applied& a) {
    a.given_torque = GivenTorqueSpec{.torque_N_m = {2e-3, -1e-3, 1e-3}};
  });
  applied("given_torque", "torque by table", [](Applied& a) { a.given_torque = torque_by_table(); });
  cases.push_back({"air_force", "force of the air",
                   [](Scenario& s) {
                     s.contact = ContactSpec{.tip_radius_m = 0.002, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.5};
                     s.effects.applied.air_force = AirForceSpec{.linear_N_s_m = 0.05, .quadratic_N_s2_m2 = 0.1};
                   },
                   [](Scenario& s) { s.effects.applied.air_force.reset(); }});
  const auto flag = [&](std::string effect, bool EffectsSpec::*member) {
    cases.push_back({effect, effect, [member](Scenario& s) { s.effects.*member = true; },
                     [member](Scenario& s) { s.effects.*member = false; }});
  };
  flag("coriolis", &EffectsSpec::coriolis);
  flag("centrifugal", &EffectsSpec::centrifugal);
  flag("transverse", &EffectsSpec::transverse);
  cases.push_back({"release_matching", "inertial rates",
                   [](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::inertial; },
                   [](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::laboratory; }});
  cases.push_back({"polar_motion", "pole",
                   [](Scenario& s) {
                     s.site.pole = {50, -80};
                   },
                   [](Scenario& s) { s.site.pole = {}; }});
  cases.push_back({"length_of_day", "longer day",
                   [](Scenario& s) { s.rotation_rate_rad_s = 0.5, s.excess_length_of_day_ms = 900; },
                   [](Scenario& s) { s.excess_length_of_day_ms = 0; }});
  cases.push_back({"deflection_of_vertical", "plumb line",
                   [](Scenario& s) {
                     s.site.deflection = {60, 45};
                   },
                   [](Scenario& s) { s.site.deflection = {}; }});
  const auto hold = [](Scenario& s) {
    s = gyrocompass(40, 25, 2e-4);
    s.rotation_rate_rad_s = 0.02, s.release.spin_rad_s = 150;
    s.duration_s = 2, s.output_step_s = 0.25;
  };
  const auto put_rotor = [](Scenario& s) {
    RotorSpec& rotor = s.rotor.emplace();
    rotor.mass_kg = 0.05, rotor.axial_kg_m2 = 2e-5, rotor.transverse_kg_m2 = 1.2e-5;
    rotor.axis = {1, 0, 2}, rotor.center_m = {0, 0, 0.03}, rotor.spin_rad_s = 100;
  };
  cases.push_back({"rotor_bearing", "friction of a rotor's bearing",
                   [put_rotor](Scenario& s) { put_rotor(s), s.rotor->viscous_torque_N_m_s = 1e-5; },
                   [](Scenario& s) { s.rotor->viscous_torque_N_m_s = 0; }});
  cases.push_back({"gimbal", "gimbal", hold, [](Scenario& s) { s.effects.applied.gimbal.reset(); }});
  cases.push_back({"gimbal", "damping of a gimbal", hold, [](Scenario& s) { s.effects.applied.gimbal->damping_N_m_s = 0; }});
  return cases;
}

}  // namespace earthtop::testing
