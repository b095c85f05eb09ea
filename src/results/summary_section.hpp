// SPDX-License-Identifier: GPL-3.0-or-later
/// One member of summary.json, for those who want no more of it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop {

/// The value of a top-level key of summary.json, null where this result does not have it; nothing where there is no such key.
std::optional<nlohmann::ordered_json> summary_section(const RunResult& result, std::string_view name);

/// Why no run's summary.json has a member at this dotted path ("drift.secular.azimuth_rate_rad_s", "theory.0.computed"), with
/// what was probably meant; nothing where a run's may have one. What some runs lack is not at fault.
std::optional<std::string> summary_path_fault(std::string_view path);

}  // namespace earthtop
