// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>

#include "earthtop/real.hpp"
#include "scenario/decode.hpp"

namespace earthtop::scenario {
namespace {

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
  if (tilt) {
    const auto tilt_deg = release.number("tilt_deg"), azimuth_deg = release.number("azimuth_deg"),
               spin_angle_deg = release.number("spin_angle_deg");
    if (!tilt_deg || !azimuth_deg || !spin_angle_deg) return false;
    spec.tilt_deg = *tilt_deg;
    spec.azimuth_deg = *azimuth_deg;
    spec.spin_angle_deg = *spin_angle_deg;
    return true;
  }
  bool alone = true;
  for (const std::string_view key : {"azimuth_deg", "spin_angle_deg"}) {
    if (!release.has(key)) continue;
    release.refuse_key(key, "the attitude is given by quaternion_LB; the angles belong to tilt_deg");
    alone = false;
  }
  const Section parts = release.section("quaternion_LB");
  std::array<double, 4> q = {};
  bool complete = parts.present();
  for (std::size_t i = 0; i < 4; ++i) {
    constexpr std::string_view kKeys[] = {"w", "x", "y", "z"};
    parts.require(kKeys[i]);
    const auto part = parts.number(kKeys[i]);
    if (part)
      q[i] = *part;
    else
      complete = false;
  }
  if (!complete) return false;
  const double norm = real::hypot(real::hypot(q[0], q[1]), real::hypot(q[2], q[3]));
  if (std::abs(norm - 1) > 1e-6) {
    release.refuse("quaternion_LB", fmt::format("has the norm {:.9g}; must be 1 to 1e-6 (it is normalised then)", norm));
    return false;
  }
  spec.quaternion_LB = q;
  return alone;
}

bool decode_precession(const Section& release, ReleaseSpec& spec) {
  if (release.is_object("precession")) {
    const Section given = release.section("precession");
    given.require("rate_rad_s");
    const auto rate = given.number("rate_rad_s");
    spec.precession = Precession::given;
    spec.precession_rate_rad_s = rate.value_or(0);
    return rate.has_value();
  }
  const auto word = release.word("precession");
  if (!word) return false;
  spec.precession = *word == "steady_slow"   ? Precession::steady_slow
                    : *word == "steady_fast" ? Precession::steady_fast
                                             : Precession::none;
  return true;
}

bool decode_rates(const Section& release, ReleaseSpec& spec) {
  constexpr std::string_view kWhole = "angular_velocity_body_rad_s";
  const bool spin = release.has("spin_rad_s"), whole = release.has(kWhole);
  if (spin && whole) {
    release.refuse_key(kWhole, "spin_rad_s and angular_velocity_body_rad_s are both given; give exactly one");
    return false;
  }
  if (!spin && !whole) {
    release.missing("spin_rad_s", "neither spin_rad_s nor angular_velocity_body_rad_s is given; give exactly one");
    return false;
  }
  if (whole) {
    spec.angular_velocity_body_rad_s = release.vector(kWhole);
    if (release.has("precession"))
      release.refuse_key("precession", "the rates are given by angular_velocity_body_rad_s; precession belongs to spin_rad_s");
    return spec.angular_velocity_body_rad_s && !release.has("precession");
  }
  const auto spin_rad_s = release.number("spin_rad_s");
  spec.spin_rad_s = spin_rad_s.value_or(0);
  return decode_precession(release, spec) && spin_rad_s;
}

}  // namespace

std::optional<ReleaseSpec> decode_release(const Section& release) {
  ReleaseSpec spec;
  const bool attitude = decode_attitude(release, spec);
  const auto relative_to = release.word("rates_relative_to");
  const bool rates = decode_rates(release, spec);
  if (!attitude || !relative_to || !rates) return std::nullopt;
  spec.rates_relative_to = *relative_to == "inertial" ? RatesRelativeTo::inertial : RatesRelativeTo::laboratory;
  return spec;
}

}  // namespace earthtop::scenario
