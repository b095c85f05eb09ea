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

namespace earthtop::scenario {

class Document {
 public:
  /// @param overrides  as for `examine_scenario`; they hold for every decoding
  explicit Document(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides = {});

  /// Decodes and validates the scenario, the changes made after the overrides. Messages are those of `examine_scenario` with
  /// the same values as overrides.
  ScenarioReport examine(const std::vector<input::TreeChange>& changes = {}) const;

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
