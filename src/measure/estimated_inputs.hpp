// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenario's numbers that are to be estimated from a measurement: finds them by name, and makes the scenario with other
/// values of them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "scenario/document.hpp"

namespace earthtop::measure {

struct EstimatedInput {
  std::string name;     ///< as the user gave it
  std::string pointer;  ///< JSON pointer; empty for omega_sin_latitude_rad_s
  std::string unit;
  double start = 0;  ///< the scenario's value, in `unit`
  double scale =
      1;  ///< typical size, in `unit`: |start|, or 1 if that is 0; a radian for an angle; at least the Earth's for its rate
};

class EstimatedInputs {
 public:
  /// @param base  the scene that source and overrides make
  /// @throws ScenarioError for unknown or repeated names, more than 8 names, and pointers at which the scenario has no number
  EstimatedInputs(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides, const Scene& base,
                  const std::vector<std::string>& names);

  const std::vector<EstimatedInput>& list() const { return list_; }

  /// The scene with these values, in the order of the list; none where a value is out of its range.
  std::optional<Scene> scene(const std::vector<double>& values) const;

 private:
  void add(const std::string& name);
  void add_vertical_rate();
  double number_at(const std::string& pointer, const std::string& name) const;

  scenario::Document document_;
  Scene base_;
  double northward_rate_rad_s_ = 0;
  std::vector<EstimatedInput> list_;
};

}  // namespace earthtop::measure
