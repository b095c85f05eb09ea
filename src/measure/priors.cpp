// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/priors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "earthtop/model/body.hpp"
#include "measure/input_places.hpp"

namespace earthtop::measure {
namespace {

constexpr std::string_view kAxialMoment = "/body/inertia/principal_kg_m2/2", kAxialCenter = "/body/center_of_mass_m/2";

/// The standard error of an estimated input, where it is this input of the block; none where it is not.
std::optional<double> standard_error_of(const EstimatedInput& input, const InputRow& row, double standard_error,
                                        const Scene& scene) {
  for (const InputPlace& place : places_of(row))
    if (place.estimated == input.name || place.estimated == input.pointer) return standard_error * place.per_unit;
  const Body<double>& body = scene.body<double>();
  const bool on_axis = body.p_PBcm_B[0] == 0 && body.p_PBcm_B[1] == 0;
  // I1 stays as it is, so that the ratio changes with I3 alone.
  if (row.kind == InputKind::inertia_ratio && input.pointer == kAxialMoment && on_axis)
    return standard_error * body.I_BP_B(0, 0);
  if (row.kind == InputKind::center_of_mass && input.pointer == kAxialCenter && on_axis) return standard_error;
  return std::nullopt;
}

/// Whether another estimated input than the axial moment changes the ratio of the moments.
bool moves_other_moments(const EstimatedInput& input) {
  return input.pointer.starts_with("/body/") && input.pointer != kAxialMoment;
}

}  // namespace

FoundPriors find_priors(const Scene& scene, const std::vector<EstimatedInput>& inputs) {
  FoundPriors found;
  const Instrument instrument = scene.scenario().instrument.value_or(Instrument());
  for (std::size_t i = 0; i < kInstrumentInputs; ++i) {
    if (!(instrument.standard_error[i] > 0)) continue;
    const std::string name(kInstrument[i].pointer);
    const auto input = std::ranges::find(inputs, name, &EstimatedInput::pointer);
    if (input == inputs.end()) {
      found.unused.push_back({name, fmt::format("it is not estimated; add --estimate {} to use it", name)});
      continue;
    }
    found.used.push_back({name, input->name, input->unit, input->start, instrument.standard_error[i], {}});
    found.of_fit.push_back({static_cast<std::size_t>(input - inputs.begin()), instrument.standard_error[i]});
  }
  const auto& uncertainty = scene.scenario().uncertainty;
  if (!uncertainty && !found.used.empty()) return found;
  if (!uncertainty)
    throw ScenarioError(
        "--priors",
        "the scenario has no uncertainty block; write one with the standard errors of the inputs that are known "
        "beforehand, e.g. \"uncertainty\": {\"tilt_deg\": 0.1}");
  for (std::size_t i = 0; i < kInputs.size(); ++i) {
    const InputRow& row = kInputs[i];
    const std::string_view name = row.name();
    if (!((*uncertainty)[i] > 0)) continue;
    bool used = false;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      const EstimatedInput& input = inputs[j];
      if (row.kind == InputKind::inertia_ratio && input.name != name &&
          std::any_of(inputs.begin(), inputs.end(), moves_other_moments))
        continue;
      const auto standard_error = standard_error_of(input, row, (*uncertainty)[i], scene);
      if (!standard_error) continue;
      found.used.push_back({std::string(name), input.name, input.unit, input.start, *standard_error, {}});
      found.of_fit.push_back({j, *standard_error});
      used = true;
    }
    if (!used)
      found.unused.push_back({std::string(name), fmt::format("it is not estimated; add --estimate {} to use it", name)});
  }
  return found;
}

FoundPriors find_priors(const std::vector<ComparedRelease>& releases, const JointInputs& inputs) {
  FoundPriors all;
  std::size_t without = 0;
  for (std::size_t r = 0; r < releases.size(); ++r) {
    FoundPriors own;
    try {
      own = find_priors(releases[r].scene(), releases[r].inputs().list());
    } catch (const ScenarioError&) {
      if (++without == releases.size()) throw;
      continue;
    }
    const std::vector<FitPrior> of_others = all.of_fit;
    for (std::size_t k = 0; k < own.used.size(); ++k) {
      const std::size_t place = inputs.places(r)[own.of_fit[k].parameter];
      if (std::ranges::find(of_others, place, &FitPrior::parameter) != of_others.end()) continue;
      own.used[k].release = inputs.list()[place].release;
      all.used.push_back(std::move(own.used[k]));
      all.of_fit.push_back({place, own.of_fit[k].standard_error});
    }
    for (UnusedPrior& unused : own.unused)
      if (std::ranges::find(all.unused, unused.name, &UnusedPrior::name) == all.unused.end())
        all.unused.push_back(std::move(unused));
  }
  return all;
}

}  // namespace earthtop::measure
