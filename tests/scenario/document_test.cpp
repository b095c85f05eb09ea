// SPDX-License-Identifier: GPL-3.0-or-later
// A text read once and decoded with many values gives what reading it anew with each of them gives.
#include <fmt/core.h>

#include <limits>

#include "scene/examine.hpp"
#include "support.hpp"

namespace earthtop::scenario_test {
namespace {

std::vector<std::string> printed(const ScenarioReport& report) {
  std::vector<std::string> lines;
  for (const Diagnostic& d : report.errors) lines.push_back(fmt::format("{}:{} {} {}", d.line, d.column, d.pointer, d.message));
  return lines;
}

TEST(ScenarioDocument, NumbersArePutInAsTheirDigitsWouldBeRead) {
  const ScenarioSource source{"minimal.json", kMinimal};
  const scenario::Document document(source);
  for (const char* pointer : {"/site/latitude_deg", "/body/center_of_mass_m/2", "/motion/duration_s", "/release/tilt_deg",
                              "/release/nothing", "/body/center_of_mass_m/7", "/effects/coriolis", "site"})
    for (const double value : {0.1 + 0.2, -0.0, 91.0, -1e-3, 5e-324, 1e300}) {
      SCOPED_TRACE(fmt::format("{}={}", pointer, value));
      const ScenarioReport by_number = earthtop::examine(document, {{pointer, value}});
      const ScenarioReport by_text = examine_scenario(source, {{pointer, fmt::format("{}", value)}});
      std::vector<std::string> expected = printed(by_text);
      for (std::string& message : expected)  // nobody gave the option
        if (message.ends_with(" (from --set)")) message.resize(message.rfind(" (from --set)"));
      EXPECT_EQ(printed(by_number), expected);
      ASSERT_EQ(by_number.scenario.has_value(), by_text.scenario.has_value());
      if (by_number.scenario) {
        EXPECT_TRUE(*by_number.scenario == *by_text.scenario);
      }
    }
  EXPECT_FALSE(earthtop::examine(document, {{"/site/latitude_deg", std::numeric_limits<double>::quiet_NaN()}}).scenario);
}

TEST(ScenarioDocument, ChangesOfOneDecodingAreNotSeenByTheNext) {
  const scenario::Document document({"minimal.json", kMinimal}, {{"/site/latitude_deg", "10"}});
  EXPECT_EQ(earthtop::examine(document, {{"/site/latitude_deg", 20.0}}).scenario->site.latitude_deg, 20);
  EXPECT_FALSE(earthtop::examine(document, {{"/site/latitude_deg", 200.0}}).scenario);
  EXPECT_EQ(earthtop::examine(document, {{"/release/precession", "steady_slow"}}).scenario->release.precession,
            Precession::steady_slow);
  EXPECT_EQ(earthtop::examine(document).scenario->site.latitude_deg, 10);
  EXPECT_EQ(earthtop::examine(document).scenario->release.precession, Precession::none);
}

}  // namespace
}  // namespace earthtop::scenario_test
