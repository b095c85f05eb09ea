// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes what an estimate says and rests on into the documents of comparisons and of plans.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "earthtop/measure/exact_input.hpp"
#include "earthtop/measure/rate_finding.hpp"

namespace earthtop::measure {

/// Names the release whose number an entry is, where there are several and it is not that of all.
inline void put_release(nlohmann::ordered_json& entry, std::size_t release) {
  if (release > 0) entry["release"] = release;
}

/// Null for an estimate that is no rate of the Earth.
inline nlohmann::ordered_json finding_json(const std::optional<RateFinding>& finding) {
  if (!finding) return nullptr;
  nlohmann::ordered_json culprits = nlohmann::ordered_json::array();
  for (const InputError& culprit : finding->culprits) {
    culprits.push_back({{"name", culprit.name}, {"unit", culprit.unit}, {"error", culprit.error}});
    put_release(culprits.back(), culprit.release);
  }
  return {{"outcome", std::string(to_string(finding->outcome()))},
          {"limit_sigma", RateFinding::kLimit_sigma},
          {"from_zero_sigma", finding->from_zero_sigma},
          {"from_known_sigma", finding->from_known_sigma},
          {"known", finding->known.value},
          {"known_standard_error", finding->known.standard_error},
          {"known_is_earths", finding->known.is_earths},
          {"had_prior", finding->had_prior},
          {"culprits", culprits}};
}

/// @param standard_error  of the estimate
inline nlohmann::ordered_json exact_json(const std::vector<ExactInput>& inputs, const std::optional<double>& standard_error) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ExactInput& input : inputs) {
    list.push_back({{"name", input.name}, {"unit", input.unit}, {"value", input.value}});
    list.back()["stated"] = input.stated ? nlohmann::ordered_json(*input.stated) : nlohmann::ordered_json(nullptr);
    list.back()["shift"] = input.shift;
    list.back()["misfit"] = input.misfit;
    list.back()["error_of_one_sigma"] =
        standard_error ? nlohmann::ordered_json(input.error_of_one_sigma(*standard_error)) : nlohmann::ordered_json(nullptr);
    put_release(list.back(), input.release);
  }
  return list;
}

}  // namespace earthtop::measure
