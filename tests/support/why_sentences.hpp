// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of a run that say why its drift is what it is: found by name, with the numbers that they state.
#pragma once

#include <cmath>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop::testing {

inline const WhySentence* find(const RunResult& result, std::string_view name) {
  for (const WhySentence& sentence : result.why)
    if (sentence.name == name) return &sentence;
  return nullptr;
}
inline bool says(const WhySentence& sentence, std::string_view words) { return sentence.text.find(words) != std::string::npos; }
inline bool says(const RunResult& result, std::string_view name, std::string_view words) {
  const WhySentence* found = find(result, name);
  return found && says(*found, words);
}
inline double number(const RunResult& result, std::string_view sentence, std::string_view name) {
  if (const WhySentence* found = find(result, sentence))
    for (const auto& [what, value] : found->numbers)
      if (what == name) return value;
  return NAN;
}

}  // namespace earthtop::testing
