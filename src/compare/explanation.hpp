// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares a file, read in some way, with a motion.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "compare/evidence.hpp"
#include "compare/reading.hpp"

namespace earthtop::compare {

using Tops = std::vector<SeenTop>;

struct Explanation {
  Reading reading;
  ByMeasure left;           ///< the largest differences
  double ratio = HUGE_VAL;  ///< the same in parts of what another program may differ by
};

/// Two mistakes leave differences within this factor where a file does not tell them apart.
inline constexpr double kAlike = 3;
/// A mistake leaves at most this part of what there was, if it does not leave less than another program may differ by.
inline constexpr double kExplainsMost = 1e-3;

class Explainer {
 public:
  /// @param tolerance  what another program may differ by   @param rate_IL_L  the Earth's rate in the laboratory (rad/s)
  Explainer(const Evidence& evidence, const Mapping& mapping, const ByMeasure& tolerance, const Eigen::Vector3d& rate_IL_L);

  const Evidence& evidence() const { return evidence_; }
  const ByMeasure& tolerance() const { return tolerance_; }
  const Reader& reader() const { return reader_; }

  double ratio(const ByMeasure& apart) const;
  /// @param expected  a motion at the samples' times; it may end before them
  Explanation explained(const Reading& reading, const Tops& expected) const;
  /// Tries further meanings of attitudes and rates: relative to space, along other axes, in another unit.
  Explanation best_reading(const Reading& reading, const Tops& expected) const;
  /// The ways to read the file, other than its mapping says, in which its first row is that of the reference; first the one with which its
  /// next rows agree best.
  std::vector<Reading> likely_readings() const;

  /// "2e-09 rad".
  std::string left_words(const ByMeasure& left) const;
  /// "its world axes are taken as ... and ..." after `before`; empty for a file that is read as mapped.
  std::string if_words(const Reading& reading, std::string_view before) const;

 private:
  ByMeasure apart(const Reading& reading, const Tops& expected) const;
  double rate_factor(const Reading& reading) const;

  const Evidence& evidence_;
  ByMeasure tolerance_;
  Reader reader_;
  double rate_unit_;
};

}  // namespace earthtop::compare
