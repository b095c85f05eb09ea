// SPDX-License-Identifier: GPL-3.0-or-later
/// What integrations of a run leave for later looks at it: stops from which a motion can go on, so that looks at a few times late in a run
/// do not go all the way again.
#pragma once

#include <any>
#include <map>
#include <optional>
#include <typeindex>
#include <vector>

#include "earthtop/integrate/options.hpp"

namespace earthtop {

class MotionWay {
 public:
  /// The duration of the run in natural units: that of the first integration, which goes to its end.
  double duration_from(double last_time) {
    if (duration_ == 0) duration_ = last_time;
    return duration_;
  }
  /// The options of the first looks, which later ones take over: only so do they find stops.
  std::optional<IntegrationOptions> looked_by;
  /// The times (s) of an integration's rows and looks at which it leaves stops; ascending. Rows must not be among them: what is said of the
  /// whole motion does not depend on them. An integration for looks leaves stops wherever they are far enough apart.
  std::vector<double> leave_at_s;
  double looked_seconds = 0;  ///< time that looks have taken
  /// The stops of one kind of integration, which has a type of its own for them.
  template <class Stops>
  Stops& stops() {
    std::any& kept = stops_[typeid(Stops)];
    if (!kept.has_value()) kept.emplace<Stops>();
    return *std::any_cast<Stops>(&kept);
  }

 private:
  double duration_ = 0;
  std::map<std::type_index, std::any> stops_;
};

}  // namespace earthtop
