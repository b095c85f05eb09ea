// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario's text, read and decoded: what it gives, and what is wrong with it so far. The scene has more to say of it
/// (scene/examine.cpp), and says it at places in the same text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "earthtop/scenario/scenario.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"
#include "input/section.hpp"
#include "scenario/fields.hpp"

namespace earthtop::scenario {

struct Reading {
  std::string_view text;  ///< of the source, without a byte order mark
  input::Node root;
  input::Findings findings;
  Scenario scenario;
  bool is_whole = false;   ///< whether the text is JSON; after a syntax error the rest would be guesswork
  bool has_start = false;  ///< whether body, release and gravity are known

  /// To complain about a key.
  input::Section section() { return {root, findings, fields()}; }
  std::vector<Diagnostic> errors() const { return findings.errors(text); }
};

/// @param source  must outlive the reading   @param overrides  `--set` pairs
Reading read_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides = {});

}  // namespace earthtop::scenario
