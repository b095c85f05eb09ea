// SPDX-License-Identifier: GPL-3.0-or-later
/// The columns of trajectory.csv, from two motions by plain subtraction: 113 bits have digits to spare.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion.hpp"

namespace headlines {

using Columns = std::vector<std::pair<std::string, std::optional<Real>>>;

/// Follows the angles that count beyond pi from step to step; the other columns are functions of the two states.
class DriftMeasures {
 public:
  /// To be called after every step: an angle that jumps by more than a radian in one step is lost from then on.
  void follow(const Motion& rotating, const Motion& reference);

  /// All columns but the bounds and those of slip and normal force; an angle that is lost or undefined has no value.
  Columns columns(const Motion& rotating, const Motion& reference) const;

 private:
  /// An angle known up to whole turns, made continuous in time.
  class Counted {
   public:
    void include(std::optional<Real> angle);
    std::optional<Real> value() const { return lost_ ? std::nullopt : value_; }

   private:
    std::optional<Real> value_;
    bool lost_ = false;
  };
  Counted azimuth_, half_spin_;
};

}  // namespace headlines
