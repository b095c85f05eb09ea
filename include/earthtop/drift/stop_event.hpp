// SPDX-License-Identifier: GPL-3.0-or-later
/// When dry friction brings a motion to rest.
#pragma once

#include <optional>

namespace earthtop {

/// One of the two predictions.
enum class Prediction { reference, rotating };
/// A motion came to rest in dry friction.
struct StopEvent {
  Prediction prediction = Prediction::reference;
  double t_s = 0;
  double slowing_rad_s2 = 0;        ///< how fast its rate fell at the end
  std::optional<double> bound_s{};  ///< on the error of the time; none where the second integration knows of no such stop
};

}  // namespace earthtop
