// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of two study stores, point by point.
#pragma once

#include <filesystem>

#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// Compares two stores, and fills in all of the report but the names. @throws ScenarioError where one of them is not a store;
/// ReadError
void compare_stores(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                    const CompareOptions& options, PairReport& report);

}  // namespace earthtop::compare
