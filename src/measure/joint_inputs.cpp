// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/joint_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/error.hpp"
#include "input/node.hpp"

namespace earthtop::measure {

namespace {

bool starts_alike(const EstimatedInput& a, const EstimatedInput& b) {
  constexpr double kSame = 1e-12;  // of the scale: rounding
  return std::abs(a.start - b.start) <= kSame * a.scale;
}

}  // namespace

bool is_common(const EstimatedInput& first, const EstimatedInput& other) {
  return !first.pointer.starts_with("/release/") && !first.pointer.starts_with("/instrument/") && starts_alike(first, other);
}

JointInputs::JointInputs(const std::vector<const EstimatedInputs*>& releases, const std::vector<std::size_t>& fitted,
                         const std::vector<std::string>& shared)
    : places_(releases.size()) {
  const auto is_shared = [&](const EstimatedInput& first, const EstimatedInput& other, bool are_fitted) {
    if (!are_fitted) return is_common(first, other);
    if (std::ranges::find(shared, first.name) == shared.end()) return false;
    if (!starts_alike(first, other))
      throw ScenarioError(fmt::format("--shared {}", input::excerpt(first.name, 80)),
                          fmt::format("starts at {:.10g} in one scenario and at {:.10g} in another; give all the same start, "
                                      "or estimate it for each release",
                                      first.start, other.start));
    return true;
  };
  for (const bool are_fitted : {true, false}) {
    const std::size_t first = list_.size();
    for (std::size_t r = 0; r < releases.size(); ++r) {
      const std::vector<EstimatedInput>& of_release = releases[r]->list();
      const std::size_t begin = are_fitted ? 0 : fitted[r], end = are_fitted ? fitted[r] : of_release.size();
      for (std::size_t i = begin; i < end; ++i) {
        const auto same =
            std::find_if(list_.begin() + static_cast<std::ptrdiff_t>(first), list_.end(), [&](const JointInput& known) {
              return known.name == of_release[i].name && is_shared(known, of_release[i], are_fitted);
            });
        places_[r].push_back(static_cast<std::size_t>(same - list_.begin()));
        if (same == list_.end()) list_.push_back({of_release[i], 0});
      }
    }
    if (are_fitted) fitted_ = list_.size();
  }
  if (releases.size() == 1) return;
  // A number that only one release has is its own.
  for (std::size_t j = 0; j < list_.size(); ++j) {
    std::vector<std::size_t> users;
    for (std::size_t r = 0; r < places_.size(); ++r)
      if (std::ranges::find(places_[r], j) != places_[r].end()) users.push_back(r);
    if (users.size() == 1) list_[j].release = users.front() + 1;
  }
}

std::vector<double> JointInputs::values_of(std::size_t release, const std::vector<double>& values) const {
  std::vector<double> own;
  own.reserve(places_[release].size());
  for (const std::size_t place : places_[release]) own.push_back(values[place]);
  return own;
}

}  // namespace earthtop::measure
