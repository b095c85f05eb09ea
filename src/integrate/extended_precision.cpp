// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/integrate/options.hpp"

namespace earthtop {

std::optional<std::string> precision_refusal(Precision) { return std::nullopt; }

}  // namespace earthtop
