// SPDX-License-Identifier: GPL-3.0-or-later
/// Shows the inputs on which a result rests, for the terminal.
#pragma once

#include <string>
#include <vector>

#include "earthtop/measure/exact_input.hpp"
#include "screen.hpp"

namespace earthtop::tool {

/// The inputs that were taken as exact, each with the error that would shift an estimate by its standard error. Empty without any.
std::string exact_inputs_text(const std::vector<ExactInput>& inputs, const std::string& estimate, double standard_error,
                              const Screen& screen);

}  // namespace earthtop::tool
