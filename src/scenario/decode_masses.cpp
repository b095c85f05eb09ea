// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the masses that move in the body.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "earthtop/real.hpp"
#include "scenario/decode.hpp"
#include "scenario/filed_table.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {
namespace {

constexpr std::size_t kMostMasses = 64;

/// Checks that the motion has the keys it needs and no other.
void check_keys_of_motion(const Section& mass, const MassMotionRule& rule) {
  for (const std::string_view key : split_words(kMassMotionKeys)) {
    if (lists(rule.required, key)) mass.require(key);
    if (lists(rule.allowed, key) || !mass.has(key)) continue;
    mass.refuse_key(key, fmt::format("does not belong to the motion \"{}\"; allowed with it: {}", rule.word,
                                     fmt::join(split_words(rule.allowed), ", ")));
  }
}

/// @returns whether the circle has a plane
bool check_circle(const Section& mass, const MovingMassSpec& spec) {
  const auto axis = mass.vector("axis"), start = mass.vector("start_m");
  if (!axis || !start) return false;
  const double length = real::hypot((*axis)[0], (*axis)[1], (*axis)[2]),
               radius = real::hypot((*start)[0], (*start)[1], (*start)[2]);
  // The square of a shorter axis would underflow, and its direction would be lost.
  if (length < 1e-150) {
    mass.refuse("axis", "is the zero vector, or nearly; must have a direction, best with length 1");
    return false;
  }
  if (radius == 0) {
    mass.refuse(
        "start_m",
        "is the zero vector, a circle without a radius; give the way from its centre to the mass, or the motion \"fixed\"");
    return false;
  }
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += spec.start_m[i] / radius * (spec.axis[i] / length);
  constexpr double kAcross = 1e-9;
  if (std::abs(along) <= kAcross) return true;
  mass.refuse("start_m",
              fmt::format("is not perpendicular to axis: the cosine between the two is {:.3g}, and may be {:g} at most; take "
                          "what start_m has along the axis to center_m",
                          along, kAcross));
  return false;
}

/// @returns whether the waypoints make a path
bool check_waypoints(const Section& mass, const MovingMassSpec& spec) {
  if (!mass.numbers("times_s") || !mass.points("points_m")) return false;
  const auto& times = spec.times_s;
  if (times.size() < 2) {
    mass.refuse("times_s", "has one time; a path needs at least two, or take the motion \"fixed\"");
    return false;
  }
  if (spec.points_m.size() != times.size()) {
    mass.refuse("points_m", fmt::format("has {} points, and times_s {} times; give one point for each time",
                                        spec.points_m.size(), times.size()));
    return false;
  }
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1])) {
      mass.refuse("times_s",
                  fmt::format("has {} after {}; the times must ascend, each above the one before", times[i], times[i - 1]));
      return false;
    }
  return true;
}

/// @returns whether the mass is complete
bool decode_mass(const Section& mass, bool has_gimbals, const ScenarioSource& source, double duration_s, MovingMassSpec& spec) {
  Reading codec(mass);
  moving_mass_keys(codec, spec);
  if (!mass.word("motion")) return false;
  check_keys_of_motion(mass, row_of(kMassMotionRules, spec.motion));
  if (spec.carrier == MassCarrier::outer && !has_gimbals)
    mass.refuse("carrier",
                "is \"outer\", and there is no outer gimbal that could carry the mass; must be \"body\", or give /gimbals");
  if (spec.motion == MassMotion::circle && !check_circle(mass, spec)) return false;
  if (spec.motion == MassMotion::waypoints && !check_waypoints(mass, spec)) return false;
  if (spec.motion == MassMotion::table) decode_table(mass, source, duration_s, kTableOfPlaces, spec.coordinates);
  return codec.complete() && (spec.motion != MassMotion::table || spec.coordinates[0].rows);
}

}  // namespace

std::vector<MovingMassSpec> decode_masses(const Section& root, const ScenarioSource& source, double duration_s) {
  constexpr std::string_view kKey = "moving_masses";
  std::vector<MovingMassSpec> masses;
  if (root.size(kKey) > kMostMasses) {
    root.refuse(kKey, fmt::format("has {} masses; at most {} are allowed", root.size(kKey), kMostMasses));
    return masses;
  }
  for (std::size_t i = 0; i < root.size(kKey); ++i) {
    MovingMassSpec spec;
    if (decode_mass(root.element(kKey, i), root.has("gimbals"), source, duration_s, spec)) masses.push_back(std::move(spec));
  }
  return masses;
}

void check_beside_masses(const Section& root, const Scenario& scenario) {
  if (!root.has("moving_masses")) return;
  const AppliedTorquesSpec& applied = scenario.effects.applied;
  const auto refuse = [&](std::string_view key, bool acts, std::string_view why) {
    if (acts)
      root.section("effects").refuse_key(
          key, fmt::format("is not available with /moving_masses: {}; leave one of the two out", why));
  };
  refuse("air_drag", applied.air_drag.has_value(), "it is the drag of a disc that spins about body axis 3 itself");
  refuse("gimbal", applied.gimbal.has_value(), "it holds a rigid wheel");
}

}  // namespace earthtop::scenario
