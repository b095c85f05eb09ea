// SPDX-License-Identifier: GPL-3.0-or-later
/// The times at which dry friction brings a motion to rest.
#pragma once

#include <optional>

namespace earthtop {

/// One of the two motions of a run: the non-rotating prediction, or the motion on the rotating Earth.
enum class Prediction { reference, rotating };
/// Dry friction has brought a motion to rest.
struct StopEvent {
  Prediction prediction = Prediction::reference;
  double t_s = 0;
  double slowing_rad_s2 = 0;        ///< how fast the size of its rate fell at the end
  std::optional<double> bound_s{};  ///< bound on the error of `t_s`; none where a second integration has no such stop
};

}  // namespace earthtop
