// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a node of a study file as JSON text, in the form that `--set` takes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "input/node.hpp"

namespace earthtop::study {

using Json = nlohmann::ordered_json;

std::string json_text(const input::Node& node);
/// The shortest decimal form that reads back as the same double.
std::string json_text(double number);

}  // namespace earthtop::study
