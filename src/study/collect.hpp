// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes from a run the quantities that a study collects.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/run_batch.hpp"
#include "earthtop/study/study.hpp"
#include "scenario/document.hpp"
#include "study/value.hpp"

namespace earthtop::study {

/// One point's row in the store.
struct PointResult {
  std::uint64_t number = 0;
  std::vector<Value> axis_values;  ///< value at each axis's first pointer; empty where the axis leaves the base as it is
  std::string status;              ///< the run's RunStatus, "refused" or "accuracy_not_reached"
  std::string reason;              ///< why it failed; empty if it did not
  std::string scenario_sha256;     ///< empty if there is no scenario
  std::vector<Value> values;       ///< one for each quantity
  bool failed() const { return status != "completed"; }
};

/// The first error of a refused scenario in one line, and the number of further errors.
std::string first_message(const ScenarioReport& report);

/// Makes the scenes of a study's points from the base, which is read once, and collects the values of their runs.
class Collector {
 public:
  explicit Collector(const Study& study);

  /// The scenario of a point, or all errors in it.
  ScenarioReport examine(const std::vector<input::TreeChange>& changes) const;

  /// The scenario of a point. If it is refused, nothing is returned, and `refusal` receives the reason.
  std::optional<Scene> scene(const std::vector<input::TreeChange>& changes, std::string& refusal) const;

  /// Whether a quantity comes from the motion between the rows.
  bool looks_between() const { return between_; }
  /// Whether the scenarios of points, as they are run, are made by the same rules as another collector's.
  bool asks_like(const Collector& other) const {
    return ends_only_ == other.ends_only_ && sensitivities_ == other.sensitivities_;
  }
  /// Fills in the point's status, reason and values.
  void collect(const BatchOutcome& outcome, PointResult& point) const;

 private:
  const Study& study_;
  scenario::Document base_;
  bool between_;        ///< a quantity comes from the motion between the rows
  bool ends_only_;      ///< no output rows between release and end are needed
  bool sensitivities_;  ///< the drift's derivatives are needed, if the base asks for them
};

}  // namespace earthtop::study
