// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks the files of the shipped scenarios: they are complete, and agree with the values of tests/headlines and with the
/// table in scenarios/README.md.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "collection/shipped.hpp"
#include "support/headlines.hpp"

namespace earthtop {
namespace {

using testing::parse_file;
using testing::shipped_files;

TEST(Collection, EveryScenarioSaysWhatItIsForAndWhatItIsHeldTo) {
  EXPECT_GE(shipped_files().size(), 35U);
  for (const auto& file : shipped_files()) {
    SCOPED_TRACE(file.filename().string());
    const Scenario scenario = parse_file(file);
    EXPECT_EQ(scenario.name, file.stem().string());
    EXPECT_FALSE(scenario.title.empty());
    EXPECT_FALSE(scenario.purpose.empty());
    ASSERT_TRUE(scenario.headline);
    EXPECT_TRUE(scenario.headline->origin.starts_with("closed form: ") ||
                scenario.headline->origin.starts_with("extended precision: "))
        << scenario.headline->origin;
    // A figure's tolerance may be at most 1e-5 of what the Earth's rotation does. For a drift that is the figure itself; for
    // angles and quaternions it is of order Omega t.
    const double earth =
        std::max(std::abs(scenario.headline->value), scenario.headline->quantity.starts_with("drift") ? 0 : 1e-3);
    EXPECT_LE(scenario.headline->tolerance, 1e-5 * earth);
  }
}

// The reference program has integrated every scene. A figure of origin "extended precision" is its number to the last bit, and
// a closed form agrees with it.
TEST(Collection, HeadlinesAreTheGeneratedValues) {
  const std::string text = testing::generated_document().dump();
  EXPECT_TRUE(testing::generated_document().contains("generator") && testing::generated_document().contains("precision") &&
              testing::generated_document().contains("digits"));
  for (const auto& file : shipped_files()) {
    SCOPED_TRACE(file.filename().string());
    const Scenario scenario = parse_file(file);
    const HeadlineSpec& headline = scenario.headline.value();
    const testing::GeneratedValues generated = testing::generated_values(scenario.name);
    EXPECT_EQ(generated.at_s, headline.at_s.value_or(scenario.duration_s));
    EXPECT_LT(generated.error, 1e-3L * static_cast<long double>(headline.tolerance));
    const long double value = generated.at(headline.quantity);
    if (headline.origin.starts_with("extended precision"))
      EXPECT_EQ(headline.value, static_cast<double>(value));
    else
      EXPECT_LE(std::abs(headline.value - value), headline.tolerance) << static_cast<double>(value);
  }
}

/// The line for a scenario in the manual of scenarios.
std::string table_line(const Scenario& scenario) {
  const HeadlineSpec& headline = scenario.headline.value();
  const std::string time = fmt::format(" at {} s", headline.at_s.value_or(scenario.duration_s));
  return fmt::format("| [`{0}`]({0}.json) | {1} | `{2}`{3} | {4:.10g} ± {5:.0e} | {6} |", scenario.name, scenario.title,
                     headline.quantity, headline.quantity.find('.') == std::string::npos ? time : "", headline.value,
                     headline.tolerance, headline.origin.substr(0, headline.origin.find(':')));
}

TEST(Collection, ManualTableIsTrue) {
  std::ifstream file(std::string(EARTHTOP_TESTS) + "/../scenarios/README.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::string table;
  for (const auto& scenario : shipped_files()) table += table_line(parse_file(scenario)) + "\n";
  EXPECT_NE(readme.find("\n" + table + "\n"), std::string::npos) << "The table of scenarios in scenarios/README.md should be\n"
                                                                 << table;
}

}  // namespace
}  // namespace earthtop
