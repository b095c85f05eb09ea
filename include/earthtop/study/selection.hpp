// SPDX-License-Identifier: GPL-3.0-or-later
/// Single points of a study's store: those that meet conditions, and those with the largest values of a quantity.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "earthtop/watch.hpp"

namespace earthtop {

/// What is asked of the points.
struct PointSelection {
  /// Conditions that all hold, each a column, one of < > <= >= = != and a value: "tilt_deg>=20", "drift.verdict=reliable",
  /// "status=refused". Columns are the axes, the quantities, `status` and `point` (the number). < and > compare numbers; numbers
  /// that differ by rounding only are equal.
  std::vector<std::string> where;
  /// If given: a quantity, of which the ten points with the largest absolute values are taken, largest first; of an error bound
  /// those with the largest bounds. Only completed points count, unless a condition asks for another status.
  std::optional<std::string> worst;
};

/// The points of a store that are asked for, as one JSON document: `matching` (their number), `listed`, and `points`, each with its
/// number, axis values, quantities (with `worst` only that one), status and, where it failed, reason. At most 10,000 are listed.
/// Damaged points are left out.
/// @throws ScenarioError for a condition or a quantity that the store cannot answer
std::string selected_points_json(const std::filesystem::path& store, const PointSelection& selection, const Watch& watch = {});

}  // namespace earthtop
