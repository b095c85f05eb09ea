// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds the kinds of text of JSONTestSuite to the decoder. What is not JSON must be refused, with its place and a remedy; what
// is JSON may be the value of a comment.
#include <gtest/gtest.h>

#include <algorithm>

#include "earthtop/scene/scene.hpp"
#include "hostile/kinds.hpp"

namespace earthtop::hostile_test {
namespace {

Scenario parse(const std::string& text) { return parse_scenario({"text.json", text}); }

/// Lines and columns are 1-based and inside the text (or just behind it).
void expect_place_in(std::string_view text, const Diagnostic& diagnostic, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  ASSERT_GE(diagnostic.line, 1) << name;
  ASSERT_GE(diagnostic.column, 1) << name;
  for (int i = 1; i < diagnostic.line; ++i) {
    const auto newline = text.find('\n');
    ASSERT_NE(newline, std::string_view::npos) << name;
    text.remove_prefix(newline + 1);
  }
  EXPECT_LE(static_cast<std::size_t>(diagnostic.column), std::min(text.find('\n'), text.size()) + 1) << name;
}

/// A remedy follows a semicolon, or the message says what "must" be there.
bool has_remedy(const std::string& message) {
  return message.find("; ") != std::string::npos || message.find(" must ") != std::string::npos;
}

void expect_refused(const std::string& name, const std::string& text) {
  try {
    parse(text);
    ADD_FAILURE() << name << " is accepted: " << text.substr(0, 200);
  } catch (const ScenarioError& error) {
    // NaN and the like are not JSON, but the rest of the text is checked too, which adds an error if it is an array: that is no
    // scenario.
    EXPECT_LE(error.diagnostics().size(), 2u) << name << ": " << error.what();
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      expect_place_in(text, diagnostic, name);
      EXPECT_TRUE(has_remedy(diagnostic.message)) << name << ": " << diagnostic.message;
      const std::string line = format_diagnostic(error.file(), diagnostic);
      EXPECT_EQ(line, printable(line)) << name;
      EXPECT_LT(line.size(), 500u) << name;
    }
  }
}

TEST(JsonKinds, AllAreThere) {
  EXPECT_EQ(refused_kinds().size(), 188u);
  EXPECT_EQ(accepted_kinds().size(), 95u);
  EXPECT_EQ(either_kinds().size(), 35u);
}

TEST(JsonKinds, WhatIsNoJsonIsRefusedAsTheWholeText) {
  for (const Kind& kind : refused_kinds()) expect_refused(kind.name, kind.text);
}

TEST(JsonKinds, WhatIsNoJsonIsRefusedInsideAScenario) {
  for (const Kind& kind : refused_kinds()) {
    expect_refused(kind.name, as_member(kind.text));
    expect_refused(kind.name, as_last_member(kind.text));
  }
}

TEST(JsonKinds, WhatIsJsonMayBeAComment) {
  const std::string plain = canonical_json(parse(as_member("0")));
  for (const Kind& kind : accepted_kinds()) {
    try {
      EXPECT_EQ(canonical_json(parse(as_member(kind.text))), plain) << kind.name;
      EXPECT_EQ(canonical_json(parse(as_last_member(kind.text))), plain) << kind.name;
    } catch (const ScenarioError& error) {
      ADD_FAILURE() << kind.name << ": " << error.what();
    }
  }
}

TEST(JsonKinds, WhatMayBeEitherHasItsStatedOutcome) {
  for (const Kind& kind : either_kinds()) {
    std::string said = "accepted";
    try {
      parse(as_member(kind.text));
    } catch (const ScenarioError& error) {
      said = error.what();
    }
    std::string outcome = kind.outcome;
    std::replace(outcome.begin(), outcome.end(), '_', ' ');
    EXPECT_NE(said.find(outcome), std::string::npos) << kind.name << ": " << said;
  }
}

}  // namespace
}  // namespace earthtop::hostile_test
