// SPDX-License-Identifier: GPL-3.0-or-later
/// A rotation given as a table of angles.
#pragma once

#include <vector>

namespace earthtop {

/// Measured angles at given times.
struct AngleTable {
  std::vector<double> t_s;        ///< strictly ascending; at least four
  std::vector<double> angle_rad;  ///< one for each time
  bool operator==(const AngleTable&) const = default;
};

}  // namespace earthtop
