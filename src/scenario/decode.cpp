// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/decode.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "input/check.hpp"
#include "input/overrides.hpp"
#include "input/reader.hpp"
#include "scenario/document.hpp"
#include "scenario/fields.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/replaced_units.hpp"

namespace earthtop::scenario {
namespace {

void decode_name(const Section& root, const std::string& file, Scenario& scenario) {
  Reading codec(root);
  description_keys(codec, scenario);
  if (root.has("name")) return;
  if (file.empty() || file == "<stdin>") return;
  const std::string stem = std::filesystem::path(file).stem().string();
  if (input::is_name(stem))
    scenario.name = stem;
  else
    root.missing("name",
                 fmt::format("is missing, and the file's stem \"{}\" cannot replace it; give a name of 1 to 64 of a-z, 0-9 "
                             "and '-', not beginning with '-'",
                             excerpt(stem)));
}

void decode_headline(const Section& root, Scenario& scenario) {
  if (!root.has("headline")) return;
  const Section given = root.section("headline");
  Reading codec(given);
  HeadlineSpec headline;
  headline_keys(codec, headline);
  if (!codec.complete()) return;
  scenario.headline = headline;
  if (headline.quantity == "drift.threshold_time_s" && !root.section("report").has("threshold_rad"))
    given.refuse("quantity", "there is no threshold to pass; give /report/threshold_rad");
  if (!headline.at_s || !(scenario.duration_s > 0)) return;
  if (headline.quantity.find('.') != std::string::npos)
    given.refuse_key("at_s", "belongs to a column of trajectory.csv; a figure of summary.json has no time");
  else if (!is_output_time(*headline.at_s, scenario.duration_s, scenario.output_step_s))
    given.warn(
        "at_s",
        "is not the time of a row, which is a multiple of output_step_s within the duration: the figure cannot be checked");
}

/// Checks that the latitude is given where anything needs it.
void require_latitude(const Section& root) {
  const Section site = root.section("site"), travel = root.section("travel");
  if (site.has("latitude_deg")) return;
  if (root.has("travel")) {
    if (travel.word("path") != "table")
      site.missing("latitude_deg", "is missing; the journey begins there: must be a number from -89.9 to 89.9 (deg)");
    return;
  }
  if (!site.has("gravity_m_s2") || root.section("earth").number("rotation_rate_rad_s") != 0.0)
    site.missing("latitude_deg",
                 "is missing; must be a number from -90 to 90 (deg), unless the rotation rate is 0 and gravity_m_s2 "
                 "is given");
}

/// Computes gravity where it is not given. @returns whether it is known
bool find_gravity(const Section& site, bool place_is_known, Site& place) {
  if (site.has("gravity_m_s2")) return site.number("gravity_m_s2").has_value();
  if (place_is_known) place.gravity_m_s2 = normal_gravity(place.latitude_deg, place.height_m);
  return place_is_known;
}

/// Decodes site and Earth. @returns whether gravity is known
bool decode_site(const Section& root, Scenario& scenario) {
  const Section site = root.section("site"), earth = root.section("earth");
  require_latitude(root);
  Reading earth_codec(earth), codec(site);
  scenario.rotation_rate_rad_s = 0;  // value if the key has been refused
  earth_keys(earth_codec, scenario);
  site_keys(codec, scenario);
  if (site.has("gravity_m_s2") && site.has("gravity_anomaly_m_s2"))
    site.refuse_key("gravity_anomaly_m_s2",
                    "is counted from normal gravity, and gravity_m_s2 is given; leave one of the two out");
  return find_gravity(site, site.number("latitude_deg") && site.number("height_m"), scenario.site);
}

/// Decodes the whole scenario. @returns whether body, release, gravity, contact, gimbals and journey are known
bool decode(const Section& root, const ScenarioSource& source, Scenario& scenario) {
  decode_name(root, source.file, scenario);
  bool gravity = decode_site(root, scenario);
  const auto body =
      root.require("body") ? decode_body(root.section("body"), root.has("rotor") || root.has("gimbals")) : std::nullopt;
  const ReleasedParts parts{root.has("rotor") || root.has("moving_masses"), root.has("gimbals")};
  const auto release = root.require("release") ? decode_release(root.section("release"), parts) : std::nullopt;
  if (body) scenario.body = *body;
  if (release) scenario.release = *release;
  decode_motion(root.section("motion"), scenario);
  if (root.has("travel")) scenario.travel = decode_travel(root, source, scenario.duration_s);
  if (scenario.travel && scenario.travel->path == TravelPath::table) {
    const Section site = root.section("site");
    gravity = find_gravity(site, place_at_start(site, *scenario.travel, scenario.site), scenario.site);
  }
  if (scenario.travel)
    scenario.travel->has_normal_gravity =
        scenario.site.gravity_m_s2 == normal_gravity(scenario.site.latitude_deg, scenario.site.height_m);
  if (root.has("rotor")) scenario.rotor = decode_rotor(root, source, scenario.duration_s);
  if (root.has("gimbals")) scenario.gimbals = decode_gimbals(root);
  if (body && scenario.rotor && !root.has("gimbals")) check_gyrostat(root, *body, *scenario.rotor);
  scenario.moving_masses = decode_masses(root, source, scenario.duration_s);
  if (root.has("platform")) scenario.platform = decode_platform(root.section("platform"), source, scenario.duration_s);
  if (root.has("instrument")) {
    Reading instrument(root.section("instrument"));
    instrument_keys(instrument, scenario.instrument.emplace());
  }
  Reading accuracy(root.section("accuracy")), report(root.section("report"));
  accuracy.key("drift_rad", scenario.accuracy_rad);
  decode_effects(root, source, scenario);
  check_beside_masses(root, scenario);
  check_beside_travel(root, scenario);
  decode_numerics(root.section("numerics"), scenario);
  if (root.has("contact")) scenario.contact = decode_contact(root, scenario);
  decode_headline(root, scenario);
  scenario.criteria = decode_criteria(root);
  report_keys(report, scenario);
  if (root.has("uncertainty")) {
    Reading uncertainty(root.section("uncertainty"));
    uncertainty_keys(uncertainty, scenario.uncertainty.emplace());
    scenario.sensitivities = true;
    for (std::size_t i = 0; i < kInputCount; ++i)
      if ((*scenario.uncertainty)[i] != 0 && !has_input(scenario, i))
        root.section("uncertainty")
            .refuse_key(kInputNames[i],
                        fmt::format("the scenario has no such number: this is the {}; leave it out", kInputs[i].doc));
  }
  return body && release && gravity && (scenario.contact || !root.has("contact")) &&
         (scenario.gimbals || !root.has("gimbals")) && (scenario.travel || !root.has("travel"));
}

/// Removes the numbers that a change in another unit replaces.
template <class Changes, class PointerOf>
void replace_units(input::Node& root, const Changes& changes, const PointerOf& pointer_of) {
  for (const std::string_view pointer : replaced_units(changes, pointer_of)) {
    const std::size_t slash = pointer.rfind('/');
    input::Node* section = root.kind == input::JsonKind::object ? root.find(pointer.substr(1, slash - 1)) : nullptr;
    if (section && section->kind == input::JsonKind::object)
      std::erase_if(section->children, [&](const input::Node& child) { return child.key == pointer.substr(slash + 1); });
  }
}

}  // namespace

Document::Document(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides)
    : source_(std::move(source)) {
  const input::ReadOutcome outcome = input::read_json(text(), "", false, root_, findings_);
  // After a syntax error nothing is decoded, because the rest would be guesswork.
  is_whole_ = outcome != input::ReadOutcome::not_json && outcome != input::ReadOutcome::refused;
  if (!is_whole_ || root_.kind != input::JsonKind::object) return;
  replace_units(root_, overrides, [](const auto& change) -> const std::string& { return change.first; });
  apply_overrides(root_, overrides, findings_);
}

std::string_view Document::text() const {
  std::string_view text = source_.text;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

Decoded Document::decode(const std::vector<input::TreeChange>& changes) const {
  Decoded decoded{text(), root_, findings_, {}, is_whole_, false};
  if (!is_whole_) return decoded;
  if (root_.kind == input::JsonKind::object) {
    replace_units(decoded.root, changes, [](const input::TreeChange& change) -> const std::string& { return change.pointer; });
    input::apply_changes(decoded.root, changes, decoded.findings);
  }
  check_structure(decoded.root, decoded.findings, fields());
  decoded.has_start = scenario::decode(decoded.section(), source_, decoded.scenario);
  return decoded;
}

}  // namespace earthtop::scenario
