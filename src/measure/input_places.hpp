// SPDX-License-Identifier: GPL-3.0-or-later
/// Which estimable inputs the inputs of a scenario's `uncertainty` block are.
#pragma once

#include <string_view>
#include <vector>

#include "earthtop/scenario/inputs.hpp"

namespace earthtop::measure {

struct InputPlace {
  std::string_view estimated;  ///< name or JSON pointer of an estimable input
  double per_unit = 1;         ///< its change for one unit of the block's input
};

/// The places of an input, the usual one first: a scenario has at most one of them.
std::vector<InputPlace> places_of(const InputRow& input);

}  // namespace earthtop::measure
