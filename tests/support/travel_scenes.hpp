// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes on a journey, for the tests, and their reference values (tests/data/travel/references.json).
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "earthtop/frames/journey.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/contact_references.hpp"
#include "support/json.hpp"
#include "support/scenes.hpp"

namespace earthtop::testing {

inline const nlohmann::json& travel_references() {
  static const nlohmann::json made = parse_json(read_file(EARTHTOP_TESTS "/data/travel/references.json"));
  return made;
}
inline const nlohmann::json& travel_case(const std::string& name) {
  const auto& cases = travel_references().at("cases");
  return *std::ranges::find_if(cases, [&](const nlohmann::json& one) { return one.at("name") == name; });
}
inline Scenario travel_scenario(const nlohmann::json& reference, const Overrides& changes = {}) {
  return parse_scenario({"travel.json", text_of(reference.at("scenario"))}, changes);
}

/// A number to all of its printed digits.
template <class T>
T printed(const nlohmann::json& text) {
  return parsed<T>(text.get<std::string>());
}

inline TravelSpec sailing(TravelPath path, double course_deg, double speed_m_s) {
  TravelSpec spec;
  spec.path = path, spec.course_deg = course_deg, spec.speed_m_s = speed_m_s;
  return spec;
}

/// Gives a scene some journey over the time that it takes: either path, with speeds up to an aircraft's, legs that accelerate by up to
/// 1 m/s^2, turn and climb, either reference, any of the rules for the plumb line, either figure, given or normal gravity.
inline void send_on_journey(Scenario& s, Random& random, double duration_s) {
  constexpr double kSteepest = 70;  // deg
  s.site.latitude_deg = random.uniform(-kSteepest, kSteepest), s.site.longitude_deg = random.uniform(-180, 180);
  s.site.height_m = random.coin() ? 0 : random.uniform(-100, 12000);
  TravelSpec& travel = s.travel.emplace();
  travel.path = random.coin() ? TravelPath::rhumb : TravelPath::geodesic;
  travel.course_deg = random.uniform(-180, 180), travel.speed_m_s = random.log_uniform(0.5, 300);
  travel.reference = random.coin() ? TravelReference::same_path : TravelReference::at_rest;
  constexpr std::array kRules{TravelEotvos::rotating, TravelEotvos::off, TravelEotvos::both};
  travel.eotvos = kRules[static_cast<std::size_t>(random.uniform(0, travel.reference == TravelReference::at_rest ? 2 : 3))];
  if (random.coin()) travel.figure = TravelFigure::sphere;
  if (random.coin()) {
    travel.has_normal_gravity = true;
    s.site.gravity_m_s2 = normal_gravity(s.site.latitude_deg, s.site.height_m);
  }
  const auto legs = static_cast<int>(random.uniform(0, 4));
  double speed = travel.speed_m_s;
  for (int i = 0; i < legs; ++i) {
    TravelLeg& leg = travel.legs.emplace_back();
    leg.duration_s = duration_s * random.uniform(0.1, 0.4);
    if (random.coin()) leg.speed_m_s = speed = std::abs(speed + random.uniform(-1, 1) * leg.duration_s);
    if (random.coin())
      leg.turn_deg = random.uniform(-1, 1) * std::min(90.0, leg.duration_s / std::max(1.0, speed) * 180 / std::numbers::pi);
    if (random.coin()) leg.climb_m = random.uniform(-1, 1) * leg.duration_s * leg.duration_s;
  }
}

/// A random top or free body on a journey, over `radians` of its fastest rate; a third of them with viscous friction.
inline Scenario random_journey(std::uint64_t seed, double radians) {
  Scenario s = random_scene(seed, radians);
  Random random(seed + 77'000);
  if (random.uniform(0, 1) < 0.25) s.body.center_of_mass_m = {0, 0, 0}, s.body.inertia_about = InertiaAbout::pivot;
  if (random.uniform(0, 1) < 0.33) s.effects.applied.viscous_N_m_s = s.body.inertia_kg_m2[2][2] * random.log_uniform(1e-3, 1);
  s.output_step_s = s.duration_s / 5;
  send_on_journey(s, random, s.duration_s);
  s.name = "journey-" + std::to_string(seed);
  return s;
}

/// A table of places on smooth curves, at equal steps from 0 to the end.
inline TravelSpec by_table(const Site& from, double duration_s, int steps, const std::array<double, 3>& rates) {
  TravelSpec spec;
  spec.path = TravelPath::table;
  const std::array<double, 3> start{from.latitude_deg, from.longitude_deg, from.height_m};
  for (std::size_t column = 0; column < 3; ++column) {
    AngleTable rows;
    for (int i = 0; i <= steps; ++i) {
      const double t = duration_s * i / steps;
      rows.t_s.push_back(t);
      rows.value.push_back(start[column] +
                           rates[column] * (t + 0.2 * duration_s * std::sin(3 * t / duration_s + static_cast<double>(column)) -
                                            0.2 * duration_s * std::sin(static_cast<double>(column))));
    }
    spec.table[column].rows = std::make_shared<const AngleTable>(std::move(rows));
  }
  return spec;
}

}  // namespace earthtop::testing
