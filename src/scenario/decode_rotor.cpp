// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the rotor in the body.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "earthtop/real.hpp"
#include "scenario/decode.hpp"
#include "scenario/filed_table.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {
namespace {

/// Checks that the drive has the keys it needs and no other.
void check_rotor_drive(const Section& rotor, const RotorSpec& spec) {
  if (rotor.has("drive") && !rotor.word("drive")) return;
  const DriveRule& rule = row_of(kDriveRules, spec.drive);
  for (const std::string_view key : split_words(kDriveKeys)) {
    if (lists(rule.required, key)) rotor.require(key);
    if (lists(rule.allowed, key) || !rotor.has(key)) continue;
    const auto allowed = split_words(rule.allowed);
    rotor.refuse_key(
        key, fmt::format("does not belong to the drive \"{}\"; allowed with it: {}", rule.word, fmt::join(allowed, ", ")));
  }
}

void check_rotor_friction(const Section& rotor, RotorSpec& spec) {
  constexpr std::string_view kRate = "regularisation_rad_s";
  if (spec.coulomb_torque_N_m != 0 && !rotor.has(kRate))
    rotor.missing(
        kRate,
        "is missing; coulomb_torque_N_m needs the rate below which the torque is proportional to it: give one above 0, such "
        "as 1 rad/s");
  if (!rotor.has("coulomb_torque_N_m") && rotor.has(kRate) && spec.drive == RotorDrive::none)
    rotor.refuse_key(kRate, "belongs to coulomb_torque_N_m, which is not given; leave it out");
  if (spec.coulomb_torque_N_m == 0) spec.regularisation_rad_s = 0;  // so that a study may begin at 0
}

void check_rotor_moments(const Section& rotor, const RotorSpec& spec) {
  constexpr double kRoundOff = 32 * 0x1p-52;
  if (spec.transverse_kg_m2 * 2 < spec.axial_kg_m2 * (1 - kRoundOff))
    rotor.refuse("transverse_kg_m2",
                 fmt::format("is {}, less than half of axial_kg_m2 {}, and no body is flatter than a disc; must be at least {}",
                             spec.transverse_kg_m2, spec.axial_kg_m2, spec.axial_kg_m2 / 2));
}

}  // namespace

std::optional<RotorSpec> decode_rotor(const Section& root, const ScenarioSource& source, double duration_s) {
  if (!root.is_object("rotor")) return std::nullopt;
  const Section rotor = root.section("rotor");
  RotorSpec spec;
  Reading codec(rotor);
  rotor_keys(codec, spec);
  if (rotor.has("spin_rad_s") && rotor.has("spin_rpm"))
    rotor.refuse_key("spin_rpm", "spin_rad_s and spin_rpm are both given; give exactly one");
  else if (!rotor.has("spin_rpm") && spec.drive != RotorDrive::table)
    rotor.require("spin_rad_s");
  check_rotor_drive(rotor, spec);
  check_rotor_friction(rotor, spec);
  if (rotor.number("transverse_kg_m2") && rotor.number("axial_kg_m2")) check_rotor_moments(rotor, spec);
  const auto axis = rotor.vector("axis");
  // The square of a shorter axis would underflow, and its direction would be lost.
  const bool has_no_direction = axis && real::hypot((*axis)[0], (*axis)[1], (*axis)[2]) < 1e-150;
  if (has_no_direction) rotor.refuse("axis", "is the zero vector, or nearly; must have a direction, best with length 1");
  if (spec.drive == RotorDrive::table) decode_table(rotor, source, duration_s, kTableOfRates, spec.table);
  if (!codec.complete() || has_no_direction || (spec.drive == RotorDrive::table && !spec.table.rows)) return std::nullopt;
  return spec;
}

}  // namespace earthtop::scenario
