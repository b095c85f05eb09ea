// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenario's numbers that a measurement is to estimate, by name: what they are, and the scenario with them changed.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"

namespace earthtop::compare {

struct EstimatedInput {
  std::string name;     ///< as it was asked for
  std::string pointer;  ///< empty of omega_sin_latitude_rad_s
  std::string unit;
  double start = 0;  ///< the scenario's, in `unit`
  double scale =
      1;  ///< the size against which a change is small: its own, a radian of an angle, the Earth's of its rate; 1 of what is 0
};

class EstimatedInputs {
 public:
  /// @param base  the scenario of source and overrides
  /// @throws ScenarioError for unknown or equal names, more than 8, and pointers where the scenario has no number
  EstimatedInputs(ScenarioSource source, std::vector<std::pair<std::string, std::string>> overrides, const Scene& base,
                  const std::vector<std::string>& names);

  const std::vector<EstimatedInput>& list() const { return list_; }

  /// The scenario with these values, in the order of the list; nothing where one is out of its range.
  std::optional<Scene> scene(const std::vector<double>& values) const;

 private:
  void add(const std::string& name);
  void add_vertical_rate();
  double number_at(const std::string& pointer, const std::string& name) const;

  ScenarioSource source_;
  std::vector<std::pair<std::string, std::string>> overrides_;
  Scene base_;
  double northward_rate_rad_s_ = 0;
  std::vector<EstimatedInput> list_;
};

}  // namespace earthtop::compare
