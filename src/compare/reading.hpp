// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads a file's numbers otherwise than its mapping says.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "compare/evidence.hpp"
#include "compare/mapping.hpp"

namespace earthtop::compare {

enum class ScalarPart { as_mapped, last, first };  ///< `last`: the file has it last, where the mapping says first

/// A way to read a file.
struct Reading {
  ScalarPart scalar = ScalarPart::as_mapped;
  bool world_to_body = false;
  AxisTurn world, body;
  bool axis_reversed = false;
  bool inertial_attitude = false, inertial_rates = false, world_rates = false;
  double rate_factor = 1;  ///< the file's rates are so many times as large as they should be
  int later = 0;           ///< the file's row is that of the reference so many rows later
  bool operator==(const Reading&) const = default;
};

/// A file with its mapping, and the Earth's rate as a vector in the laboratory (rad/s).
class Reader {
 public:
  Reader(const Evidence& evidence, const Mapping& mapping, const Eigen::Vector3d& rate_IL_L);
  /// As the mapping says.
  const Reading& mapped() const { return mapped_; }
  /// The top of a sample in our conventions, its quaternion of unit norm.
  SeenTop read(std::size_t sample, const Reading& reading) const;
  /// In words, after "if": what differs from the mapping, one phrase for each.
  std::vector<std::string> words(const Reading& reading) const;

 private:
  Eigen::Quaterniond attitude(const SeenTop& file, const Reading& reading) const;

  const Evidence& evidence_;
  const Mapping& mapping_;
  Eigen::Matrix3d R_LF_, R_BF_;  // the mapping's axes
  Eigen::Vector3d rate_IL_L_;
  Reading mapped_;
};

}  // namespace earthtop::compare
