// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "earthtop/real.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// Records the change of one conserved quantity over the rows.
template <class T>
class InvariantFollower {
 public:
  InvariantFollower(std::string name, std::string unit) { report_.name = std::move(name), report_.unit = std::move(unit); }
  void include(T value, T scale) {
    if (first_) initial_ = value;
    first_ = false;
    const T change = real::abs(value - initial_);
    if (!(change <= largest_change_)) largest_change_ = change;  // also where it is no number
    scale_ = std::max(scale_, scale);
  }
  InvariantReport report() const {
    InvariantReport report = report_;
    report.initial = static_cast<double>(initial_);
    report.largest_change = static_cast<double>(largest_change_);
    report.scale = static_cast<double>(scale_);
    return report;
  }

 private:
  InvariantReport report_;
  T initial_ = T(0), largest_change_ = T(0), scale_ = T(0);
  bool first_ = true;
};

}  // namespace earthtop
