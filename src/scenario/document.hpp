// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario's text that is read once and can be decoded many times with changed values.
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

/// A scenario decoded from a text, with the errors found so far. Its scene is checked later (scene/examine.cpp), with messages
/// placed in the same text.
struct Decoded {
  std::string_view text;  ///< text of the document, without byte order mark; the document must outlive this
  input::Node root;
  input::Findings findings;
  Scenario scenario;
  bool is_whole = false;   ///< whether the text is valid JSON; otherwise nothing was decoded
  bool has_start = false;  ///< whether body, release, gravity and contact are known

  /// Returns the section of the whole text, in which messages can be placed.
  input::Section section() { return {root, findings, fields()}; }
  std::vector<Diagnostic> errors() const { return findings.errors(text); }
};

class Document {
 public:
  /// @param overrides  as for `examine_scenario`; they apply to every decoding
  explicit Document(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides = {});

  /// Decodes the scenario; the changes are applied after the overrides.
  Decoded decode(const std::vector<input::TreeChange>& changes = {}) const;

  /// Returns the tree with the overrides applied; its structure has not been checked.
  const input::Node& root() const { return root_; }
  const std::string& file() const { return source_.file; }

 private:
  std::string_view text() const;  // without byte order mark: positions are counted in this text

  ScenarioSource source_;
  input::Node root_;
  input::Findings findings_;  // findings of reading and of the overrides
  bool is_whole_ = false;     // whether the text was read to its end
};

}  // namespace earthtop::scenario
