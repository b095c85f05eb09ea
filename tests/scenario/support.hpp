// SPDX-License-Identifier: GPL-3.0-or-later
/// A valid scenario that tests change, and the diagnostics for the changed one.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"

namespace earthtop::scenario_test {

using Overrides = std::vector<std::pair<std::string, std::string>>;

/// The least that a scenario needs, with one line per section, so that every value has a known place.
inline const std::string kMinimal =
    "{\"site\": {\"latitude_deg\": 45},\n"
    " \"body\": {\"mass_kg\": 0.1, \"center_of_mass_m\": [0, 0, 0.03], \"inertia\": {\"principal_kg_m2\": [2e-4, 2e-4, "
    "4e-5]}},\n"
    " \"release\": {\"tilt_deg\": 20, \"spin_rad_s\": 200},\n"
    " \"motion\": {\"duration_s\": 60}}\n";

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

inline Scenario parse(const std::string& text, const Overrides& overrides = {}) {
  return parse_scenario({"dir/minimal.json", text}, overrides);
}

/// "line:column pointer" of every diagnostic, and the messages separately.
struct Found {
  std::vector<std::string> places;
  std::vector<std::string> messages;
  bool says(std::size_t i, const std::string& part) const {
    return i < messages.size() && messages[i].find(part) != std::string::npos;
  }
};

inline Found found_in(const std::string& text, const Overrides& overrides = {}) {
  Found found;
  try {
    parse(text, overrides);
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.file(), "dir/minimal.json");
    for (const Diagnostic& d : error.diagnostics()) {
      found.places.push_back(std::to_string(d.line) + ":" + std::to_string(d.column) + " " + d.pointer);
      found.messages.push_back(d.message);
    }
  }
  return found;
}

/// Expects exactly one diagnostic, at this place, whose message contains the part.
inline void expect_one(const std::string& text, const std::string& place, const std::string& part,
                       const Overrides& overrides = {}) {
  const Found found = found_in(text, overrides);
  EXPECT_EQ(found.places, std::vector<std::string>{place}) << text.substr(0, 400) << "\n"
                                                           << (found.messages.empty() ? "" : found.messages[0]);
  EXPECT_TRUE(found.says(0, part)) << (found.messages.empty() ? "accepted" : found.messages[0]) << "\nlacks: " << part;
}

/// Expects that a value set in the minimal scenario is refused with one diagnostic at the pointer.
inline void expect_set(const Overrides& overrides, const std::string& pointer, const std::string& part) {
  expect_one(kMinimal, "0:0 " + pointer, part, overrides);
}

}  // namespace earthtop::scenario_test
