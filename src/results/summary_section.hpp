/// One member of summary.json, for those who want no more of it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop {

/// The value of a top-level key of summary.json, null where this result does not have it; nothing where there is no such key.
std::optional<nlohmann::ordered_json> summary_section(const RunResult& result, std::string_view name);

}  // namespace earthtop
