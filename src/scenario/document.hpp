// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario's text read once, to be decoded with as many changes of its values as one likes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "earthtop/scenario/scenario.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"
#include "input/overrides.hpp"
#include "input/section.hpp"
#include "scenario/fields.hpp"

namespace earthtop::scenario {

/// A scenario decoded from a text: what it gives, and what is wrong with it so far. Its scene is checked later
/// (scene/examine.cpp), with messages at places in the same text.
struct Decoded {
  std::string_view text;  ///< of the document, which must outlive this; without a byte order mark
  input::Node root;
  input::Findings findings;
  Scenario scenario;
  bool is_whole = false;   ///< whether the text is JSON: otherwise nothing was decoded
  bool has_start = false;  ///< whether body, release and gravity are known

  /// The whole text, to place messages in it.
  input::Section section() { return {root, findings, fields()}; }
  std::vector<Diagnostic> errors() const { return findings.errors(text); }
};

class Document {
 public:
  /// @param overrides  as for `examine_scenario`; they hold for every decoding
  explicit Document(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides = {});

  /// Decodes the scenario with the changes made after the overrides.
  Decoded decode(const std::vector<input::TreeChange>& changes = {}) const;

  /// The tree, the overrides in it; its structure is not checked.
  const input::Node& root() const { return root_; }
  const std::string& file() const { return source_.file; }

 private:
  std::string_view text() const;  // without a byte order mark, as positions are counted

  ScenarioSource source_;
  input::Node root_;
  input::Findings findings_;  // of reading and of the overrides
  bool is_whole_ = false;     // whether reading came to the text's end
};

}  // namespace earthtop::scenario
