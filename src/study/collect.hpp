// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes from a run the quantities that a study collects.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/run_batch.hpp"
#include "earthtop/study/study.hpp"
#include "study/value.hpp"

namespace earthtop::study {

/// One point's row in the store.
struct PointResult {
  std::uint64_t number = 0;
  std::vector<Value> axis_values;  ///< of each axis's first pointer; nothing at the base
  std::string status;              ///< a RunStatus, "refused", or "accuracy_not_reached"
  std::string reason;              ///< of a failure; empty where there is none
  std::string scenario_sha256;     ///< empty where there is no scenario
  std::vector<Value> values;       ///< one for each quantity
  bool failed() const { return status != "completed"; }
};

/// The first of a refused scenario's faults in one line, and how many there are beside it.
std::string first_message(const ScenarioReport& report);

/// The scenarios of points, each with the overrides that make it.
class Collector {
 public:
  explicit Collector(const Study& study);

  /// The scenario of a point, or all that is wrong with it.
  ScenarioReport examine(const std::vector<std::pair<std::string, std::string>>& overrides) const;

  /// The scenario of a point; nothing, with the reason in `refusal`, where it is refused.
  std::optional<Scenario> scenario(const std::vector<std::pair<std::string, std::string>>& overrides,
                                   std::string& refusal) const;

  /// Fills in status, reason and values.
  void collect(const BatchOutcome& outcome, PointResult& point) const;

 private:
  const Study& study_;
  bool ends_only_;      ///< no rows between release and end are needed
  bool sensitivities_;  ///< the drift's derivatives are, where the base asks for them
};

}  // namespace earthtop::study
