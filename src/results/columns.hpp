// SPDX-License-Identifier: GPL-3.0-or-later
/// The columns of trajectory.csv: their names and where their numbers stand in a row. What writes them and what looks one up
/// by its name share this table.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "earthtop/drift/drift.hpp"

namespace earthtop {

struct Column {
  std::string_view name;                            ///< with its unit
  std::optional<double> (*value)(const DriftRow&);  ///< none where the row has none
  std::optional<float128> (*extended_value)(const ExtendedDriftRow&);
};

/// All columns, in the file's order; the time is the first.
std::span<const Column> trajectory_columns();

}  // namespace earthtop
