// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes a Cardan suspension.
#include <fmt/core.h>

#include "earthtop/model/body.hpp"
#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"

namespace earthtop::scenario {
namespace {

/// The outer gimbal's mass and moments, which are given together or not at all. @returns whether they are complete
bool decode_ring(const Section& outer, std::optional<BodySpec>& ring) {
  if (!outer.has("mass_kg") && !outer.has("center_of_mass_m") && !outer.has("inertia")) return true;
  const bool given = static_cast<int>(outer.require("mass_kg")) + static_cast<int>(outer.require("inertia")) == 2;
  BodySpec spec;
  Reading codec(outer);
  body_keys(codec, spec);
  if (!outer.has("inertia") || !complete_inertia(outer.section("inertia"), spec) || !codec.complete() || !given) return false;
  // A gimbal need not have moments about all axes.
  const auto violations = body_violations(spec, true);
  for (const Diagnostic& violation : violations)
    outer.refuse(violation.pointer.starts_with("/body/inertia") ? "inertia" : "mass_kg", violation.message);
  if (!violations.empty()) return false;
  ring = spec;
  return true;
}

/// An axis needs to be free for a torque to act on it, and dry friction needs its regularisation. A key that belongs to a coefficient of
/// 0 is forgotten.
void check_bearing(const Section& axis, BearingSpec& bearing) {
  constexpr std::string_view kRate = "regularisation_rad_s";
  if (bearing.locked) {
    for (const std::string_view key : {std::string_view("viscous_torque_N_m_s"), std::string_view("coulomb_torque_N_m"), kRate,
                                       std::string_view("torsion_N_m_rad"), std::string_view("torsion_rest_deg")})
      if (axis.has(key)) axis.refuse_key(key, "acts on no locked axis; leave it out, or set locked to false");
    return;
  }
  if (bearing.coulomb_torque_N_m != 0 && !axis.has(kRate))
    axis.missing(
        kRate,
        "is missing; coulomb_torque_N_m needs the rate below which the torque is proportional to it: give one above 0, "
        "such as 0.01 rad/s");
  if (!axis.has("coulomb_torque_N_m") && axis.has(kRate))
    axis.refuse_key(kRate, "belongs to coulomb_torque_N_m, which is not given; leave it out");
  if (!axis.has("torsion_N_m_rad") && axis.has("torsion_rest_deg"))
    axis.refuse_key("torsion_rest_deg", "belongs to torsion_N_m_rad, which is not given; leave it out");
  if (bearing.coulomb_torque_N_m == 0) bearing.regularisation_rad_s = {};
  if (bearing.torsion_N_m_rad == 0) bearing.torsion_rest_deg = 0;
}

/// A locked gimbal has no rate.
void check_rates(const Section& release, const char* key, bool locked) {
  if (locked && release.number(key).value_or(0) != 0)
    release.refuse(key, "is the rate of a locked gimbal; must be 0, or left out");
}

}  // namespace

std::optional<GimbalsSpec> decode_gimbals(const Section& root) {
  if (!root.is_object("gimbals")) return std::nullopt;
  const Section gimbals = root.section("gimbals"), outer = gimbals.section("outer"), inner = gimbals.section("inner");
  GimbalsSpec spec;
  const bool ring = decode_ring(outer, spec.ring);
  Reading codec(gimbals);
  gimbals_keys(codec, spec);
  check_bearing(outer, spec.outer), check_bearing(inner, spec.inner);
  if (spec.outer.locked && spec.inner.locked)
    inner.refuse("locked", "both gimbals are locked, and nothing moves but the rotor; set one of the two to false");
  const Section release = root.section("release");
  check_rates(release, "outer_rate_rad_s", spec.outer.locked), check_rates(release, "inner_rate_rad_s", spec.inner.locked);
  if (!ring || !codec.complete()) return std::nullopt;
  return spec;
}

}  // namespace earthtop::scenario
