// SPDX-License-Identifier: GPL-3.0-or-later
/// The meaning of the columns of another program's CSV file.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/csv_reader.hpp"

namespace earthtop::compare {

using input::CsvFormat;

/// The axes of a right-handed frame in terms of earthtop's axes: the file's axis i is sign[i] times our axis index[i].
struct AxisTurn {
  std::array<std::size_t, 3> index = {0, 1, 2};
  std::array<double, 3> sign = {1, 1, 1};
  bool operator==(const AxisTurn&) const = default;
};

/// The matrix whose columns are the file's axes; it turns components in the file's frame into components in earthtop's.
Eigen::Matrix3d matrix_of(const AxisTurn& turn);
/// The 24 right-handed frames along our axes; the first one is ours.
const std::vector<AxisTurn>& all_turns();
/// A frame of world or of body axes as a mapping file says it: North, East, Down ("NED").
std::string world_words(const AxisTurn& turn);
std::string body_words(const AxisTurn& turn);
/// A unit that a mapping file may name, and its size (s, or rad/s).
struct NamedUnit {
  std::string_view word;
  double value;
};
/// The unit in which numbers that were read in one unit are `ratio` times as small; none where there is no such unit.
std::optional<NamedUnit> time_unit_for(double unit_s, double ratio);
std::optional<NamedUnit> rate_unit_for(double unit_rad_s, double ratio);

enum class RepeatedTime { refused, first, last };  ///< which of several rows at one time counts

struct Mapping {
  std::string file;
  CsvFormat format;
  std::string time_column;
  double time_unit_s = 1;
  double time_offset_s = 0;  ///< added to the file's times, in seconds
  RepeatedTime repeated = RepeatedTime::refused;
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
