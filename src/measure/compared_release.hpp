// SPDX-License-Identifier: GPL-3.0-or-later
/// A release in a comparison: its scenario as far as the last measured row, and the numbers of it that are estimated.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "measure/estimated_inputs.hpp"

namespace earthtop::measure {

class ComparedRelease {
 public:
  /// @param given  must live as long as this   @param options  `estimates` and `shared` are those of all releases
  /// @throws ScenarioError for a scenario that no measurement is compared with, and for names that cannot be estimated
  ComparedRelease(const MeasuredRelease& given, const MeasurementOptions& options);

  const Measurement& measurement() const { return given_->measurement; }
  const Scene& scene() const { return scene_; }
  /// Names of the numbers that are estimated for it, and the numbers.
  const std::vector<std::string>& names() const { return names_; }
  const EstimatedInputs& inputs() const { return inputs_; }
  /// Inputs of the same scenario with other names. @throws ScenarioError for one that cannot be estimated
  EstimatedInputs inputs_of(const std::vector<std::string>& names, std::size_t most) const;

  /// The report of the scenario and the measurement as they are given.
  MeasurementReport begun_report() const;

 private:
  ComparedRelease(const MeasuredRelease& given, const Scene& as_given, const MeasurementOptions& options);

  const MeasuredRelease* given_;
  std::string name_, sha256_;  // of the scenario as given
  std::vector<std::pair<std::string, std::string>> overrides_;
  Scene scene_;
  std::vector<std::string> names_;
  EstimatedInputs inputs_;
};

}  // namespace earthtop::measure
