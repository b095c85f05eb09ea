// SPDX-License-Identifier: GPL-3.0-or-later
// The effects that act, and the rules by which they fit the rest of the scene.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "earthtop/frames/earth_orientation.hpp"
#include "earthtop/model/release.hpp"
#include "input/suggest.hpp"
#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"

namespace earthtop::scenario {
namespace {

/// An effect that is looked up by the date needs a date.
void require_start(const Section& effects, std::string_view key, const Section& motion) {
  if (!motion.has("start_utc"))
    effects.refuse(key, "is looked up by the date; give /motion/start_utc, or the values themselves");
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

/// Pole, length of day and plumb line: what they make of the Earth's rate in laboratory axes.
void decode_orientation(const Section& effects, const Section& motion, Scenario& scenario) {
  Reading codec(effects);
  orientation_keys(codec, scenario);
  if (!effects.is_object("polar_motion") && effects.flag("polar_motion").value_or(false)) {
    require_start(effects, "polar_motion", motion);
    if (scenario.start_utc) scenario.site.pole = secular_pole(julian_epoch_year(*parse_utc(*scenario.start_utc)));
  }
  const double excess_s = scenario.excess_length_of_day_ms * 1e-3;
  if (excess_s != 0) scenario.rotation_rate_rad_s = earth_rate_with_length_of_day(scenario.nominal_rate_rad_s, excess_s);
}

/// A gimbal that holds the axis level cannot take one that is not, nor a rate at which it would leave the level.
void check_gimbal(const Section& effects, const Scenario& scenario) {
  constexpr double kLevel = 1e-12;
  const auto release = make_release<double>(scenario.release, make_body<double>(scenario.body), scenario.site.gravity_m_s2);
  const Mat3<double> R_LB = rotation_matrix(release.q_LB);
  const Vec3<double> up_B = R_LB.row(2).transpose();
  if (scenario.platform) return effects.refuse_key("gimbal", "is not available on a platform; leave one of the two out");
  if (scenario.effects.applied.coulomb_N_m != 0)
    return effects.refuse_key("coulomb_torque_N_m", "is not available with a gimbal; give the gimbal a damping instead");
  if (std::abs(up_B[2]) > kLevel)
    return effects.refuse("gimbal", fmt::format("holds body axis 3 level, and the release tilts it by {:.6g} deg; give "
                                                "/release/tilt_deg 90, or leave the gimbal out",
                                                real::atan2(real::hypot(up_B[0], up_B[1]), up_B[2]) * 180 / std::numbers::pi));
  if (scenario.release.rates_relative_to == RatesRelativeTo::inertial)
    return effects.refuse(
        "gimbal",
        "holds body axis 3 level in the laboratory, and rates that are the same in inertial space would let it "
        "leave the level; give /release/rates_relative_to \"laboratory\"");
  const double leaving = release.w_XB_B.dot(up_B.cross(Vec3<double>::UnitZ()));
  if (std::abs(leaving) > kLevel * norm(release.w_XB_B))
    effects.refuse("gimbal", fmt::format("holds body axis 3 level, and the release turns it out of the level at {:.6g} rad/s; "
                                         "give rates about axis 3 and Up only",
                                         std::abs(leaving)));
}

}  // namespace

void decode_effects(const Section& root, Scenario& scenario) {
  const Section effects = root.section("effects"), motion = root.section("motion");
  EffectsSpec& spec = scenario.effects;
  Reading codec(effects);
  torque_keys(codec, spec);
  tide_key(codec, spec.tide);
  if (spec.applied.air_drag && !(spec.applied.air_drag->disc_radius_m > 0))
    spec.applied.air_drag->disc_radius_m = 1;  // refused
  if (root.is_word("effects")) spec.automatic = true;
  if (spec.automatic && !scenario.accuracy_rad && !root.section("accuracy").has("drift_rad")) {
    constexpr const char* kNeeded = "\"auto\" chooses by the drift error asked for; give /accuracy/drift_rad";
    root.is_word("effects") ? root.refuse("effects", kNeeded) : effects.refuse("select", kNeeded);
  }
  decode_orientation(effects, motion, scenario);
  if (spec.tide) check_tide(effects, motion);
}

void check_effects(const Section& effects, const Scenario& scenario) {
  const AppliedTorquesSpec& applied = scenario.effects.applied;
  if (applied.gimbal) check_gimbal(effects, scenario);
  constexpr double kLongestTide_s = 3.2e7;  // a second or two for its series
  if (scenario.effects.tide && !scenario.effects.tide->given && scenario.duration_s > kLongestTide_s)
    effects.refuse("tide",
                   "of Moon and Sun is computed for at most 3.2e7 s, a year; take a shorter duration, or a given amplitude");
  if (applied.coulomb_N_m != 0 && scenario.platform)
    effects.refuse_key("coulomb_torque_N_m", "is not available on a platform; leave one of the two out");
}

}  // namespace earthtop::scenario
