// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenario's numbers that are to be estimated from a measurement: finds them by name, and makes the scenario with other
/// values of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "input/node.hpp"
#include "scenario/document.hpp"

namespace earthtop::measure {

/// An input that is not a number of the scenario's text, but changes several of them together.
enum class CombinedInput {
  none,
  vertical_rate,   ///< the vertical component of the Earth's rate; the northward one and apparent gravity stay
  northward_rate,  ///< the northward component; the vertical one and apparent gravity stay
  inertia_ratio,   ///< I3/I1 about the pivot; I1, I2 and the centre of mass stay
  center_of_mass,  ///< the distance of the centre of mass from the pivot; the inertia about the pivot stays
};

struct EstimatedInput {
  std::string name;     ///< as the user gave it
  std::string pointer;  ///< JSON pointer; empty for a combined input
  std::string unit;
  double start = 0;  ///< the scenario's value, in `unit`
  double scale =
      1;  ///< typical size, in `unit`: |start|, or 1 if that is 0; a radian for an angle; at least the Earth's for its rate
  CombinedInput combined = CombinedInput::none;
};

/// Whether a JSON pointer leads to a number of the scenario on which the motion, or an instrument's readings of it, depend.
bool is_estimable(std::string_view pointer);

/// The number at a pointer of a document's tree; none where there is no number.
std::optional<double> number_in(const input::Node& root, std::string_view pointer);

class EstimatedInputs {
 public:
  /// @param base  the scene that source and overrides make
  /// @param most  largest number of names
  /// @throws ScenarioError for unknown or repeated names, too many names, names that stand for the same numbers, and pointers at
  /// which the scenario has no number
  EstimatedInputs(ScenarioSource source, const std::vector<std::pair<std::string, std::string>>& overrides, const Scene& base,
                  const std::vector<std::string>& names, std::size_t most = 8);

  const std::vector<EstimatedInput>& list() const { return list_; }
  /// The scene with the scenario's own values.
  const Scene& base() const { return base_; }

  /// The scene with these values, in the order of the list; none where a value is out of its range.
  std::optional<Scene> scene(const std::vector<double>& values) const;

 private:
  void add(const std::string& name);
  void add_combined(CombinedInput combined, const std::string& name);
  void refuse_conflicts() const;
  void turn(Scenario& scenario, const std::vector<double>& values) const;
  bool reshape(Scenario& scenario, const Scene& scene, const std::vector<double>& values) const;
  std::optional<double> value_of(CombinedInput combined, const std::vector<double>& values) const;
  double number_at(const std::string& pointer, const std::string& name) const;

  scenario::Document document_;
  Scene base_;
  double vertical_rate_rad_s_ = 0, northward_rate_rad_s_ = 0;
  std::vector<EstimatedInput> list_;
};

}  // namespace earthtop::measure
