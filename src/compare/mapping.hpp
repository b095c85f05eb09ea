// SPDX-License-Identifier: GPL-3.0-or-later
/// The meaning of the columns of another program's CSV file.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "input/csv_reader.hpp"

namespace earthtop::compare {

using input::CsvFormat;

/// The axes of a right-handed frame in terms of earthtop's axes: the file's axis i is sign[i] times our axis index[i].
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
  std::optional<std::array<std::string, 3>> rates;  ///< columns of the angular rate of the body relative to the laboratory
  double rate_unit_rad_s = 1;
  bool rates_in_world_axes = false;
  std::optional<std::array<std::string, 3>> axis;  ///< columns of the direction of body axis 3, in world axes
  AxisTurn world;                                  ///< the file's world axes in laboratory axes East, North, Up
  AxisTurn body;                                   ///< the file's body axes in earthtop's body axes 1, 2, 3
  std::optional<double> attitude_error_rad;        ///< as the file's author states it
};

/// Reads a mapping file. @throws ScenarioError with all errors of the file; ReadError
Mapping read_mapping(const std::string& file);

}  // namespace earthtop::compare
