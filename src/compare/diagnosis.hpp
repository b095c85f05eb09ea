// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds out which mistake another program's file was made with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/comparand.hpp"
#include "compare/rows.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::compare {

/// The scene of a result, as its summary states it; none without one.
std::optional<Scene> scene_of(const Comparand& result);

/// Sentences that name what explains the differences between a file and its reference: how the file's numbers are meant, a mistake in
/// physics, a number that was another one, rounding; or that no single mistake does. Empty where the differences are as small as those
/// of another program may be.
/// @param mapping  of the file's columns   @param rows  their comparison
std::vector<std::string> diagnose(const Comparand& reference, const Comparand& candidate, const Mapping& mapping,
                                  const RowsComparison& rows, const CompareOptions& options);

/// A sentence if the file's last time says that its times are in another unit; else none.
std::vector<std::string> other_time_unit(const Comparand& reference, const Comparand& candidate, const Mapping& mapping,
                                         const CompareOptions& options);

}  // namespace earthtop::compare
