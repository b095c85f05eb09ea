// SPDX-License-Identifier: GPL-3.0-or-later
/// The unit of time that suits a picture's time axis.
#pragma once

namespace earthtop {

struct TimeUnit {
  const char* name;
  double per_s;  ///< number of these units in a second
};

inline TimeUnit time_unit(double duration_s) {
  if (duration_s <= 600) return {"s", 1};
  if (duration_s <= 3 * 3600.0) return {"min", 1 / 60.0};
  if (duration_s <= 3 * 86400.0) return {"h", 1 / 3600.0};
  return {"d", 1 / 86400.0};
}

}  // namespace earthtop
