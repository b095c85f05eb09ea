// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the effects that act, and checks that they fit the rest of the scene.
#include <fmt/core.h>

#include <array>
#include <cmath>

#include "earthtop/frames/earth_orientation.hpp"
#include "input/suggest.hpp"
#include "scenario/decode.hpp"
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

void decode_effects(const Section& root, Scenario& scenario) {
  const Section effects = root.section("effects"), motion = root.section("motion");
  EffectsSpec& spec = scenario.effects;
  Reading codec(effects);
  torque_keys(codec, spec);
  tide_key(codec, spec.tide);
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
