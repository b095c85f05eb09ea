// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the contact with a table, and checks that its law has its coefficients and that the other sections allow a contact.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>

#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {
namespace {

/// Returns the laws that a coefficient belongs to, in quotes: "coulomb" or "contensou".
std::string laws_with(std::string_view key) {
  std::string laws;
  for (const ContactLawRule& rule : kContactLaws)
    if (lists(rule.allowed, key)) laws += fmt::format("{}\"{}\"", laws.empty() ? "" : " or ", rule.word);
  return laws;
}

/// Checks that the law has the coefficients it needs and no other. @returns whether that is so
bool check_coefficients(const Section& contact, const ContactLawRule& rule) {
  bool good = true;
  for (const std::string_view key : split_words(kContactLawKeys)) {
    if (lists(rule.required, key)) good = contact.require(key) && good;
    if (lists(rule.allowed, key) || !contact.has(key)) continue;
    const auto allowed = split_words(rule.allowed);
    contact.refuse_key(
        key, fmt::format("belongs to the law {}, not to \"{}\", which takes {}; leave it out, or take that law", laws_with(key),
                         rule.word, allowed.empty() ? "no coefficient" : fmt::format("{}", fmt::join(allowed, ", "))));
    good = false;
  }
  return good;
}

/// Checks spinning friction and rolling resistance, which need a rate below which they are proportional to it: where a top
/// stops to turn, their exact laws have no direction.
bool check_moments(const Section& contact, const ContactSpec& spec) {
  constexpr std::string_view kRate = "regularisation_rad_s";
  const bool given = contact.has("spinning_friction_m") || contact.has("rolling_resistance_m");
  if (!given && contact.has(kRate)) {
    contact.refuse_key(kRate, "belongs to spinning_friction_m and rolling_resistance_m, and neither is given; leave it out");
    return false;
  }
  if ((spec.spinning_friction_m == 0 && spec.rolling_resistance_m == 0) || contact.has(kRate)) return true;
  contact.missing(kRate,
                  "is missing; spinning_friction_m and rolling_resistance_m need the rate below which they are proportional to "
                  "it, a number above 0 (rad/s), e.g. a thousandth of the spin");
  return false;
}

bool check_start(const Section& contact, const ContactSpec& spec) {
  if (contact.has("start") && contact.has("tip_velocity_m_s")) {
    contact.refuse_key("tip_velocity_m_s", "start and tip_velocity_m_s are both given; give at most one");
    return false;
  }
  if (spec.law != ContactLaw::rolling || spec.start == ContactStart::rolling) return true;
  if (contact.has("tip_velocity_m_s"))
    contact.refuse_key("tip_velocity_m_s",
                       "the law \"rolling\" starts without slip, at the velocity that the rates give the tip; leave it out, or "
                       "take a law of friction");
  else
    contact.refuse("start", "the law \"rolling\" starts without slip; must be \"rolling\", or leave it out");
  return false;
}

/// Refuses what the sections beside the contact hold and no motion on a table can have. Each of these acts on a body about a
/// fixed point: what it does to a tip that moves is not modelled.
void check_beside(const Section& root, const Scenario& scenario) {
  constexpr const char* kLeave = "leave one of the two out";
  const Section effects = root.section("effects");
  const AppliedTorquesSpec& applied = scenario.effects.applied;
  const auto refuse_effect = [&](std::string_view key, bool acts, std::string_view what) {
    if (acts) effects.refuse_key(key, fmt::format("is not available with /contact: {}; {}", what, kLeave));
  };
  refuse_effect(
      "coulomb_torque_N_m", applied.coulomb_N_m != 0,
      "it is friction of a fixed pivot, a torque without a force; a tip's friction is /contact/law, spinning_friction_m "
      "and rolling_resistance_m");
  refuse_effect("unequal_support", applied.unequal_support.has_value(), "it is the stiffness of a pivot");
  refuse_effect("given_torque", applied.given_torque.has_value(), "it acts on a body about a pivot, and a tip is free");
  refuse_effect("gimbal", applied.gimbal.has_value(),
                "it holds the axis of a body that a pivot carries, and a tip on a table is free");
  if (root.has("rotor"))
    root.refuse_key("rotor", fmt::format("is not available with /contact: a gyrostat on a table is not modelled; {}", kLeave));
  if (root.has("gimbals"))
    root.refuse_key("gimbals", fmt::format("is not available with /contact: gimbals need a fixed support; {}", kLeave));
  if (root.has("moving_masses"))
    root.refuse_key(
        "moving_masses",
        fmt::format("is not available with /contact: masses that move in a top on a table are not modelled; {}", kLeave));
  if (root.has("platform"))
    root.refuse_key("platform",
                    fmt::format("is not available with /contact: a table that turns or swings is not modelled; {}", kLeave));
  const Section numerics = root.section("numerics");
  if (numerics.has("observer") && numerics.word("observer") == "body")
    numerics.refuse("observer",
                    "is \"body\", and the tip's path on a table cannot be given in body axes; must be \"laboratory\" or "
                    "\"inertial\" with /contact");
}

/// Checks that the release says what it means on this table.
void check_release(const Section& release, const Section& contact, const ContactSpec& spec) {
  if (spec.table_tilt_deg != 0 && release.has("quaternion_LB"))
    release.refuse_key("quaternion_LB",
                       "is an attitude relative to the laboratory, and a release on a tilted table is relative to the "
                       "table; give tilt_deg, azimuth_deg and spin_angle_deg about its normal");
  const auto precession = release.is_word("precession") ? release.word("precession") : std::nullopt;
  if (!precession || !precession->starts_with("steady")) return;
  if (!contact.word("law")) return;
  if (spec.law != ContactLaw::frictionless && spec.law != ContactLaw::rolling)
    release.refuse("precession",
                   fmt::format("is \"{}\", and with sliding friction no precession is steady; with /contact/law \"{}\" "
                               "give {{\"rate_rad_s\": ...}} or \"none\", or take \"frictionless\" or \"rolling\"",
                               *precession, row_of(kContactLaws, spec.law).word));
  else if (spec.table_tilt_deg != 0)
    release.refuse("precession",
                   fmt::format("is \"{}\", and on a tilted table no precession is steady; give {{\"rate_rad_s\": ...}} "
                               "or \"none\"",
                               *precession));
}

}  // namespace

std::optional<ContactSpec> decode_contact(const Section& root, const Scenario& scenario) {
  check_beside(root, scenario);
  if (!root.is_object("contact")) return std::nullopt;
  const Section contact = root.section("contact");
  ContactSpec spec;
  Reading codec(contact);
  contact_keys(codec, spec);
  bool good = codec.complete();
  if (contact.word("law")) {
    good = check_coefficients(contact, row_of(kContactLaws, spec.law)) && good;
    good = check_start(contact, spec) && good;
  }
  good = check_moments(contact, spec) && good;
  check_release(root.section("release"), contact, spec);
  if (!good) return std::nullopt;
  // Without the moments their rate means nothing, and the canonical text has none of the three.
  if (spec.spinning_friction_m == 0 && spec.rolling_resistance_m == 0) spec.regularisation_rad_s = 0;
  return spec;
}

}  // namespace earthtop::scenario
