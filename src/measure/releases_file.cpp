// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/measure/releases_file.hpp"

#include <filesystem>
#include <string_view>

#include "earthtop/error.hpp"
#include "input/check.hpp"
#include "input/file.hpp"
#include "input/schema.hpp"
#include "input/section.hpp"

namespace earthtop {
namespace measure {
namespace {

using input::Field, input::Node, input::Range, input::Section;
using enum input::FieldKind;

constexpr Range kAny = {};
constexpr bool kNeeded = true;

constexpr Field kReleasesFields[] = {
    {"/$schema", word, "", kAny, "earthtop-release-list-1.json", "\"earthtop-release-list-1.json\"", "version of this format"},
    {"/about", text, "", kAny, "", "\"\"", "what was measured"},
    {"/estimate", anything, "", kAny, "", "[]",
     "names of numbers that are estimated for each release, as --estimate takes them"},
    {"/shared", anything, "", kAny, "", "[]", "names of numbers that are estimated and have one value in all releases"},
    {"/releases", list, "", kAny, "", "", "the releases, at most 64", kNeeded},
    {"/releases/*", object, "", kAny, "", "", "one release"},
    {"/releases/*/scenario", text, "", kAny, "", "", "its scenario: a file, its path relative to this one", kNeeded},
    {"/releases/*/measurement", text, "", kAny, "", "",
     "what was measured: a CSV file, its path relative to this one; not needed for a plan"},
    {"/releases/*/columns", anything, "", kAny, "", "[]",
     "what its columns are, as --columns takes it, e.g. [\"phi=azimuth_deg\"]"},
    {"/releases/*/sigma", anything, "", kAny, "", "[]", "standard errors, as --sigma takes them, e.g. [\"azimuth_deg=0.2\"]"},
    {"/releases/*/time_offset_s",
     number,
     "s",
     {-1e9, 1e9},
     "",
     "0",
     "what its clock shows at the release; rows before it are left out"},
    {"/releases/*/set", changes, "", kAny, "", "[]", "changes to its scenario, e.g. [\"/release/spin_rpm=-2400\"]"},
    {"/releases/*/estimate", anything, "", kAny, "", "[]", "names of numbers that are estimated for this release alone"},
};

const input::FieldTable& releases_fields() {
  static constexpr input::FieldTable table{"release-list", "release list", kReleasesFields};
  return table;
}

/// The strings of an array; anything else is refused.
std::vector<std::string> names_of(const Section& section, std::string_view key) {
  std::vector<std::string> names;
  const Node* node = section.any(key);
  if (!node) return names;
  if (node->kind == input::JsonKind::array)
    for (const Node& child : node->children)
      if (child.kind == input::JsonKind::string && !child.text.empty()) names.push_back(child.text);
  if (node->kind != input::JsonKind::array || names.size() != node->children.size()) {
    section.refuse(key, "must be an array of names, e.g. [\"spin_rad_s\"]");
    names.clear();
  }
  return names;
}

/// The path of a file that is named relative to the list; empty where the key is missing or refused.
std::string path_of(const Section& release, std::string_view key, const std::string& list) {
  const std::string given = release.word(key).value_or("");
  if (release.has(key) && (given.empty() || given == "-")) release.refuse(key, "must be the path of a file");
  if (given.empty()) return "";
  return (std::filesystem::path(list).parent_path() / given).string();
}

}  // namespace
}  // namespace measure

ListedReleases read_releases(const std::string& file) {
  using namespace measure;
  const std::string content = input::read_regular_file(file, file, {"release list", false});
  std::string_view text = content;
  input::Findings findings;
  const Node root_node = input::read_checked(text, file, releases_fields(), findings);
  const Section root(root_node, findings, releases_fields());
  ListedReleases list;
  list.estimates = names_of(root, "estimate");
  list.shared = names_of(root, "shared");
  if (root.require("releases") && root.size("releases") == 0) root.refuse("releases", "must have at least one release");
  for (std::size_t r = 0; r < root.size("releases"); ++r) {
    const Section release = root.element("releases", r);
    ListedRelease& one = list.releases.emplace_back();
    if (release.require("scenario")) one.scenario = path_of(release, "scenario", file);
    one.measurement = path_of(release, "measurement", file);
    one.sets = release.changes("set").value_or(std::vector<std::string>());
    one.estimates = names_of(release, "estimate");
    one.format = {names_of(release, "columns"), names_of(release, "sigma"), release.number("time_offset_s").value_or(0)};
  }
  if (!findings.empty()) throw ScenarioError(findings.errors(text), file);
  return list;
}

std::string releases_schema() {
  return input::schema(measure::releases_fields(), "Releases of a top and their measurements, which one fit evaluates.");
}
std::string releases_reference_markdown() { return input::reference_markdown(measure::releases_fields()); }

}  // namespace earthtop
