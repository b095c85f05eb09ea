// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenarios that must be refused, each with a place and a remedy.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "earthtop/scenario/scenario.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

struct Refusal {
  Overrides changes;
  const char* pointer;  ///< of one of the findings
  const char* words;    ///< in its message
};

/// Expects that a scenario with these changes is refused, at this place and with these words.
inline void expect_refused(const ScenarioSource& scenario, const Refusal& refusal) {
  SCOPED_TRACE(fmt::format("{} {}", refusal.changes.front().first, refusal.changes.front().second));
  try {
    const Scene scene = parse_scene(scenario, refusal.changes);
    scene.require_integrable();
    ADD_FAILURE() << "is taken";
  } catch (const ScenarioError& error) {
    bool found = false;
    std::string said;
    for (const Diagnostic& one : error.diagnostics()) {
      said += one.pointer + ": " + one.message + '\n';
      found = found || (one.pointer == refusal.pointer && one.message.find(refusal.words) != std::string::npos);
    }
    EXPECT_TRUE(found) << said;
  }
}

}  // namespace earthtop::testing
