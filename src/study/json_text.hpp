// SPDX-License-Identifier: GPL-3.0-or-later
/// A node of a study file as JSON text again: what `--set` would be given.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "input/node.hpp"

namespace earthtop::study {

using Json = nlohmann::ordered_json;

std::string json_text(const input::Node& node);
/// The shortest digits that read back to the same bits.
std::string json_text(double number);

}  // namespace earthtop::study
