// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>

#include "earthtop/real.hpp"
#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "text/number_words.hpp"

namespace earthtop::scenario {
namespace {

constexpr std::string_view kFreeReleaseKeys[] = {
    "tilt_deg",   "azimuth_deg", "spin_angle_deg", "quaternion_LB", "angular_velocity_body_rad_s",
    "spin_rad_s", "spin_rpm",    "precession"};
constexpr std::string_view kGimbalReleaseKeys[] = {"outer_angle_deg", "inner_angle_deg", "outer_rate_rad_s",
                                                   "inner_rate_rad_s"};

bool decode_attitude(const Section& release, ReleaseSpec& spec) {
  const bool tilt = release.has("tilt_deg"), quaternion = release.has("quaternion_LB");
  if (tilt && quaternion) {
    release.refuse_key("quaternion_LB", "tilt_deg and quaternion_LB are both given; give exactly one");
    return false;
  }
  if (!tilt && !quaternion) {
    release.missing("tilt_deg", "neither tilt_deg nor quaternion_LB is given; give exactly one");
    return false;
  }
  Reading codec(release);
  attitude_keys(codec, spec);
  if (tilt) return codec.complete();
  bool alone = true;
  for (const std::string_view key : {"azimuth_deg", "spin_angle_deg"}) {
    if (!release.has(key)) continue;
    release.refuse_key(key, "the attitude is given by quaternion_LB; the angles belong to tilt_deg");
    alone = false;
  }
  if (!codec.complete() || !release.is_object("quaternion_LB")) return false;
  const auto& q = *spec.quaternion_LB;
  const double norm = real::hypot(real::hypot(q[0], q[1]), real::hypot(q[2], q[3]));
  constexpr double kSlack = 1e-6;
  if (std::abs(norm - 1) > kSlack) {
    release.refuse("quaternion_LB", fmt::format("has the norm {}; must be 1 to within {:g} (it is then normalised)",
                                                told_apart(norm, norm < 1 ? 1 - kSlack : 1 + kSlack, 9).first, kSlack));
    return false;
  }
  return alone;
}

/// @param may_rest  whether a rotor turns in the body, which may then be at rest
bool decode_rates(const Section& release, bool may_rest, ReleaseSpec& spec) {
  constexpr std::string_view kWhole = "angular_velocity_body_rad_s";
  const bool whole = release.has(kWhole), radians = release.has("spin_rad_s"), revolutions = release.has("spin_rpm");
  const std::string_view spin = revolutions && !radians ? "spin_rpm" : "spin_rad_s";
  if (radians && revolutions) {
    release.refuse_key("spin_rpm", "spin_rad_s and spin_rpm are both given; give exactly one");
    return false;
  }
  if ((radians || revolutions) && whole) {
    release.refuse_key(kWhole, fmt::format("{} and angular_velocity_body_rad_s are both given; give exactly one", spin));
    return false;
  }
  const bool given = radians || revolutions || whole;
  if (!given && !may_rest) {
    if (!release.expects("spin_rpm"))
      release.missing(
          "spin_rad_s",
          "neither spin_rad_s nor angular_velocity_body_rad_s is given; give exactly one, the spin in spin_rad_s or "
          "spin_rpm");
    return false;
  }
  if (whole && release.has("precession"))
    release.refuse_key("precession", "the rates are given by angular_velocity_body_rad_s; precession belongs to spin_rad_s");
  Reading codec(release);
  if (given)
    rates_keys(codec, spec);
  else
    precession_keys(codec, spec);
  return codec.complete() && !(whole && release.has("precession"));
}

/// With gimbals: their angles and rates, and no other attitude or rate.
bool decode_gimbal_release(const Section& release, GimbalReleaseSpec& spec) {
  bool alone = true;
  for (const std::string_view key : kFreeReleaseKeys) {
    if (!release.has(key)) continue;
    release.refuse_key(key,
                       "belongs to a body on a pivot; with /gimbals give outer_angle_deg and inner_angle_deg, and their rates");
    alone = false;
  }
  for (const std::string_view key : {"outer_angle_deg", "inner_angle_deg"}) alone = release.require(key) && alone;
  Reading codec(release);
  gimbal_release_keys(codec, spec);
  return codec.complete() && alone;
}

}  // namespace

std::optional<ReleaseSpec> decode_release(const Section& release, const ReleasedParts& parts) {
  ReleaseSpec spec;
  if (parts.gimbals) {
    Reading codec(release);
    codec.word("rates_relative_to", spec.rates_relative_to, kRateFrames);
    const bool given = decode_gimbal_release(release, spec.gimbals.emplace());
    return given && codec.complete() ? std::optional(spec) : std::nullopt;
  }
  for (const std::string_view key : kGimbalReleaseKeys)
    if (release.has(key)) release.refuse_key(key, "belongs to /gimbals, which is not given; give tilt_deg and a spin instead");
  const bool attitude = decode_attitude(release, spec);
  Reading codec(release);
  codec.word("rates_relative_to", spec.rates_relative_to, kRateFrames);
  const bool rates = decode_rates(release, parts.moves_inside, spec);
  if (!attitude || !codec.complete() || !rates) return std::nullopt;
  return spec;
}

}  // namespace earthtop::scenario
