// SPDX-License-Identifier: GPL-3.0-or-later
/// Decodes a table that a scenario names by its file.
#pragma once

#include <array>

#include "scenario/angle_table.hpp"
#include "scenario/decode.hpp"

namespace earthtop::scenario {

/// Reads the table that the keys `file` and `file_sha256` of a section name.   @param duration_s  which it must reach (s)
void decode_table(const Section& section, const ScenarioSource& source, double duration_s, const TableKind& kind,
                  FiledTable& table);

/// Reads a table of three coordinates, or of a vector's three components, from one file; each of them becomes a table of its
/// own.
void decode_table(const Section& section, const ScenarioSource& source, double duration_s, const TableKind& kind,
                  std::array<FiledTable, 3>& coordinates);

}  // namespace earthtop::scenario
