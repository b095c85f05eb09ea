// SPDX-License-Identifier: GPL-3.0-or-later
/// The meaning of the columns of another program's CSV file.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "input/csv_reader.hpp"

namespace earthtop::compare {

using input::CsvFormat;

/// A right-handed frame's axes as signed axes of ours: the file's axis i is sign[i] times our axis index[i].
struct AxisTurn {
  std::array<std::size_t, 3> index = {0, 1, 2};
  std::array<double, 3> sign = {1, 1, 1};
};

struct Mapping {
  std::string file;
  CsvFormat format;
  std::string time_column;
  double time_unit_s = 1;
  double time_offset_s = 0;                              ///< added to the file's times, in seconds
  std::optional<std::array<std::string, 4>> quaternion;  ///< columns of w, x, y, z
  bool body_to_world = true;
  std::optional<std::array<std::string, 3>> rates;  ///< of the body relative to the laboratory
  double rate_unit_rad_s = 1;
  bool rates_in_world_axes = false;
  std::optional<std::array<std::string, 3>> axis;  ///< direction of body axis 3, world axes
  AxisTurn world;                                  ///< in laboratory axes East, North, Up
  AxisTurn body;                                   ///< in body axes 1, 2, 3
  std::optional<double> attitude_error_rad;        ///< as the file's author states it
};

/// @throws ScenarioError with all errors of the file; ReadError
Mapping read_mapping(const std::string& file);

}  // namespace earthtop::compare
