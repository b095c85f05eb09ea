// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/priors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string_view>

#include "earthtop/model/body.hpp"

namespace earthtop::measure {
namespace {

/// The scenario's numbers that are the inputs of the `uncertainty` block, and a number's change for a unit of the input's.
struct InputPlace {
  std::string_view name, pointer;
  double per_unit;
};
constexpr InputPlace kPlaces[] = {{"latitude_deg", "/site/latitude_deg", 1},
                                  {"gravity_m_s2", "/site/gravity_m_s2", 1},
                                  {"spin_rad_s", "/release/spin_rad_s", 1},
                                  {"spin_rad_s", "/release/spin_rpm", 30 / std::numbers::pi},
                                  {"spin_rad_s", "/release/angular_velocity_body_rad_s/2", 1},
                                  {"tilt_deg", "/release/tilt_deg", 1},
                                  {"rotation_rate_rad_s", "/earth/rotation_rate_rad_s", 1}};
constexpr std::string_view kAxialMoment = "/body/inertia/principal_kg_m2/2", kAxialCenter = "/body/center_of_mass_m/2";

/// The standard error of an estimated input, where it is the input of this name; none where it is not.
std::optional<double> standard_error_of(const EstimatedInput& input, std::string_view name, double standard_error,
                                        const Scene& scene) {
  if (input.name == name) return standard_error;
  const std::string& pointer = input.pointer;
  for (const InputPlace& place : kPlaces)
    if (place.name == name && place.pointer == pointer) return standard_error * place.per_unit;
  const Body<double>& body = scene.body<double>();
  const bool on_axis = body.p_PBcm_B[0] == 0 && body.p_PBcm_B[1] == 0;
  // I1 stays as it is, so that the ratio changes with I3 alone.
  if (name == "inertia_ratio" && pointer == kAxialMoment && on_axis) return standard_error * body.I_BP_B(0, 0);
  if (name == "center_of_mass_m" && pointer == kAxialCenter && on_axis) return standard_error;
  return std::nullopt;
}

/// Whether another estimated input than the axial moment changes the ratio of the moments.
bool moves_other_moments(const EstimatedInput& input) {
  return input.pointer.starts_with("/body/") && input.pointer != kAxialMoment;
}

}  // namespace

FoundPriors find_priors(const Scene& scene, const std::vector<EstimatedInput>& inputs) {
  const auto& uncertainty = scene.scenario().uncertainty;
  if (!uncertainty)
    throw ScenarioError(
        "--priors",
        "the scenario has no uncertainty block; write one with the standard errors of the inputs that are known "
        "beforehand, e.g. \"uncertainty\": {\"tilt_deg\": 0.1}");
  FoundPriors found;
  for (std::size_t i = 0; i < kInputNames.size(); ++i) {
    const std::string_view name = kInputNames[i];
    if (!((*uncertainty)[i] > 0)) continue;
    bool used = false;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      const EstimatedInput& input = inputs[j];
      if (name == "inertia_ratio" && input.name != name && std::any_of(inputs.begin(), inputs.end(), moves_other_moments))
        continue;
      const auto standard_error = standard_error_of(input, name, (*uncertainty)[i], scene);
      if (!standard_error) continue;
      found.used.push_back({std::string(name), input.name, input.unit, input.start, *standard_error, {}});
      found.of_fit.push_back({j, *standard_error});
      used = true;
    }
    if (!used)
      found.unused.push_back({std::string(name), fmt::format("it is not estimated; --estimate {} lets it enter", name)});
  }
  return found;
}

}  // namespace earthtop::measure
