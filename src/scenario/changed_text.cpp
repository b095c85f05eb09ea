// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scenario/scenario.hpp"
#include "input/text_edit.hpp"
#include "scenario/replaced_units.hpp"

namespace earthtop {

std::string changed_text(std::string text, const Overrides& overrides) {
  const auto pointer_of = [](const auto& change) -> const std::string& { return change.first; };
  for (const std::string_view pointer : replaced_units(overrides, pointer_of)) text = input::without_member(text, pointer);
  for (const auto& [pointer, value] : overrides) text = input::with_value(text, pointer, value);
  return text;
}

}  // namespace earthtop
