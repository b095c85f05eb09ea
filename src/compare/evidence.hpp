// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of another program's file beside those of the reference, kept to find out why the two differ.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "compare/comparand.hpp"
#include "compare/survey.hpp"

namespace earthtop::compare {

/// A top at one time, as far as a file tells it: attitude and axis relative to world axes, rates along body axes (rad/s).
struct SeenTop {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), rates = Eigen::Vector3d::Zero();
};

/// The angle between two directions, and that of the turn between two attitudes (rad).
double angle_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
double turn_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

/// Numbers that belong to attitude, axis and rates (rad, 1, rad/s).
struct ByMeasure {
  double attitude = 0, axis = 0, rates = 0;
};

struct Evidence {
  bool attitude = false, axis = false, rates = false;  ///< which of them both have
  std::vector<double> t_s;
  std::vector<SeenTop> file;       ///< as the mapping takes the file's numbers; the quaternions as they are, not of unit norm
  std::vector<SeenTop> reference;  ///< at the same times
  std::size_t in_a_row = 0;        ///< number of samples at the beginning between which no row was left out
  double last_s = 0;               ///< the file's last time, wherever it lies
  std::uint64_t rows = 0, zeros = 0;  ///< rows at times that both have; those of them whose quaternion is zero
  double first_zero_s = 0;
  double least_norm = HUGE_VAL, largest_norm = 0;  ///< of the quaternions that are not zero; so without any
  ByMeasure rounding;       ///< errors by which the file's numbers may have been rounded when they were printed
  int digits = 0;           ///< significant digits of the file's numbers
  ByMeasure effect;         ///< largest differences between the reference's motion and its prediction
  double largest_rate = 0;  ///< of the reference (rad/s)
  std::size_t size() const { return t_s.size(); }
};

/// Reads both and keeps some of their rows: those at the beginning, and others all over the time.
/// @param time_factor  the file's times are multiplied by it   @param until_s  later rows are not looked at
Evidence gather(const Comparand& reference, const Comparand& candidate, const Survey& known, const Mapping& mapping,
                double time_factor, std::optional<double> until_s, const Watch& watch);

}  // namespace earthtop::compare
