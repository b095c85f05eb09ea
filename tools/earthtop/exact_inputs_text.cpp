// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_inputs_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "wrapped.hpp"

namespace earthtop::tool {

std::string exact_inputs_text(const std::vector<ExactInput>& inputs, const std::string& estimate, double standard_error,
                              const Screen& screen) {
  if (inputs.empty()) return "";
  std::size_t width = 0;
  for (const ExactInput& input : inputs) width = std::max(width, name_in_release(input.name, input.release).size());
  std::string text =
      '\n' + wrapped(fmt::format("Taken as exact: errors that would move {} by one sigma", estimate), screen.width, 2) + '\n';
  for (const ExactInput& input : inputs) {
    std::string line = fmt::format("{:.2g}", input.error_of_one_sigma(standard_error));
    if (!input.unit.empty()) line += ' ' + input.unit;
    if (input.value != 0) line += fmt::format(" of {:.7g}", input.value);
    if (input.stated)
      line += fmt::format("; it is stated to ± {:.2g}, {:.2g} sigma", *input.stated,
                          *input.stated / input.error_of_one_sigma(standard_error));
    text += wrapped_entry("  " + name_in_release(input.name, input.release), line, screen.width, width + 4);
  }
  return text;
}

}  // namespace earthtop::tool
