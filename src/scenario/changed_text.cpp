// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scenario/scenario.hpp"
#include "input/text_edit.hpp"
#include "scenario/replaced_spin.hpp"

namespace earthtop {

std::string changed_text(std::string text, const Overrides& overrides) {
  const std::string_view spin = replaced_spin(overrides, [](const auto& change) -> const std::string& { return change.first; });
  if (!spin.empty()) text = input::without_member(text, spin);
  for (const auto& [pointer, value] : overrides) text = input::with_value(text, pointer, value);
  return text;
}

}  // namespace earthtop
