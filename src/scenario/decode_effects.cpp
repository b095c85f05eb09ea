// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the effects that act, and checks that they fit the rest of the scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "earthtop/frames/earth_orientation.hpp"
#include "input/suggest.hpp"
#include "scenario/decode.hpp"
#include "scenario/filed_table.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"

namespace earthtop::scenario {
namespace {

/// Requires a date for an effect that is looked up by the date.
void require_start(const Section& effects, std::string_view key, const Section& motion) {
  if (!motion.has("start_utc")) effects.refuse(key, "is looked up by date; give /motion/start_utc, or the values themselves");
}

void check_tide(const Section& effects, const Section& motion) {
  const Section given = effects.section("tide");
  if (given.has("amplitude_m_s2")) {
    given.require("frequency_hz");
    for (const std::string_view key : {"gravimetric_factor", "tilt_factor"})
      if (given.has(key))
        given.refuse_key(key, "belongs to the tide of Moon and Sun, not to one of given amplitude; leave it out");
    return;
  }
  for (const std::string_view key : {"frequency_hz", "phase_deg"})
    if (given.has(key)) given.refuse_key(key, "belongs to a tide of given amplitude; give amplitude_m_s2, or leave it out");
  require_start(effects, "tide", motion);
}

/// Checks that an unequal support is given in one of the two ways, and that what holds the body is at rest in the laboratory.
void check_support(const Section& root, const Section& effects, bool has_gimbal) {
  constexpr std::string_view kKey = "unequal_support";
  if (!effects.has(kKey)) return;
  const Section support = effects.section(kKey);
  const bool has_kappa = support.has("kappa_N_m"), has_periods = support.has("periods_s");
  if (has_kappa && has_periods)
    support.refuse_key("periods_s", "kappa_N_m and periods_s are both given; give exactly one");
  else if (!has_periods)
    support.require("kappa_N_m");
  const auto refuse = [&](bool is_given, std::string_view other, std::string_view why) {
    if (is_given) effects.refuse_key(kKey, fmt::format("is not available with {}: {}; leave one of the two out", other, why));
  };
  refuse(root.has("platform"), "/platform", "its direction is at rest in the laboratory");
  refuse(has_gimbal, "/effects/gimbal", "the gimbal holds the axis level");
}

/// Checks that a given torque's course has the keys it needs and no other, and reads its table.
void decode_given_torque(const Section& given, const ScenarioSource& source, Scenario& scenario) {
  GivenTorqueSpec& spec = *scenario.effects.applied.given_torque;
  if (given.has("course") && !given.word("course")) return;
  const CourseRule& rule = row_of(kTorqueCourses, spec.course);
  for (const std::string_view key : split_words(kCourseKeys)) {
    if (lists(rule.required, key)) given.require(key);
    if (!lists(rule.allowed, key) && given.has(key))
      given.refuse_key(key, fmt::format("does not belong to the course \"{}\"; allowed with it: {}", rule.word,
                                        fmt::join(split_words(rule.allowed), ", ")));
  }
  if (spec.course == TorqueCourse::table) decode_table(given, source, scenario.duration_s, kTableOfTorques, spec.components);
  if (spec.course == TorqueCourse::table && !spec.components[0].rows)
    scenario.effects.applied.given_torque.reset();  // the table has been refused
}

/// Decodes the pole, the length of day and the plumb line.
void decode_orientation(const Section& effects, const Section& motion, Scenario& scenario) {
  Reading codec(effects);
  orientation_keys(codec, scenario);
  if (!effects.is_object("polar_motion") && effects.flag("polar_motion").value_or(false)) {
    require_start(effects, "polar_motion", motion);
    if (scenario.start_utc) scenario.site.pole = secular_pole(julian_epoch_year(*parse_utc(*scenario.start_utc)));
  }
}

}  // namespace

void decode_effects(const Section& root, const ScenarioSource& source, Scenario& scenario) {
  const Section effects = root.section("effects"), motion = root.section("motion");
  EffectsSpec& spec = scenario.effects;
  Reading codec(effects);
  torque_keys(codec, spec);
  tide_key(codec, spec.tide);
  check_support(root, effects, spec.applied.gimbal.has_value());
  if (spec.applied.given_torque) decode_given_torque(effects.section("given_torque"), source, scenario);
  if (effects.has("air_force") && !root.has("contact"))
    effects.refuse_key("air_force",
                       "acts on a top that stands on a table, and there is no /contact; on a fixed pivot give the friction as "
                       "viscous_torque_N_m_s or quadratic_torque_N_m_s2");
  if (spec.applied.air_drag && !(spec.applied.air_drag->disc_radius_m > 0))
    spec.applied.air_drag->disc_radius_m = 1;  // a stand-in: the given radius has been refused
  if (root.is_word("effects")) spec.automatic = true;
  if (spec.automatic && !scenario.accuracy_rad && !root.section("accuracy").has("drift_rad")) {
    constexpr const char* kNeeded = "\"auto\" chooses by the drift error asked for; give /accuracy/drift_rad";
    root.is_word("effects") ? root.refuse("effects", kNeeded) : effects.refuse("select", kNeeded);
  }
  decode_orientation(effects, motion, scenario);
  if (spec.tide) check_tide(effects, motion);
}

}  // namespace earthtop::scenario
