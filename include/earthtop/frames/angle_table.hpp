// SPDX-License-Identifier: GPL-3.0-or-later
/// A turn as a table gives it.
#pragma once

#include <vector>

namespace earthtop {

/// Angles at times, as measured.
struct AngleTable {
  std::vector<double> t_s;        ///< strictly ascending, at least four
  std::vector<double> angle_rad;  ///< one for each time
  bool operator==(const AngleTable&) const = default;
};

}  // namespace earthtop
