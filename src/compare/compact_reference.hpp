// SPDX-License-Identifier: GPL-3.0-or-later
/// A reference small enough to be kept with the sources: a run's figures and eleven of its rows in one JSON file.
#pragma once

#include "compare/comparand.hpp"

namespace earthtop::compare {

inline constexpr const char* kReferenceSchema = "earthtop-reference-1.json";

/// Opens a compact reference. @throws ScenarioError where the file is not one
Comparand open_compact_reference(const fs::path& file);

/// A reference's history with one more entry, which states the reason for the change and the program that made it. An update that
/// is given again, for instance after it was killed, adds no second one.
Json with_reason(Json history, const std::string& reason);

/// The compact form of a run's results, with a final newline. @param history  that of the reference which it
/// replaces: a JSON array   @param reason  reason for the new reference; added to the history
std::string compact_reference(const Comparand& results, Json history, const std::string& reason);

}  // namespace earthtop::compare
