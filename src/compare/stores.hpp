// SPDX-License-Identifier: GPL-3.0-or-later
/// Two study stores, held against each other point by point.
#pragma once

#include <filesystem>

#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// Fills in everything but the names. @throws ScenarioError where one of them is no store; ReadError
void compare_stores(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                    const CompareOptions& options, PairReport& report);

}  // namespace earthtop::compare
