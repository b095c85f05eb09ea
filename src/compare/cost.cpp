// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/cost.hpp"

#include <fmt/core.h>

namespace earthtop::compare {
namespace {

std::optional<double> sum_of(const Comparand& comparand, std::initializer_list<const char*> pointers) {
  double sum = 0;
  for (const char* pointer : pointers) {
    const auto part = comparand.number(pointer);
    if (!part) return std::nullopt;
    sum += *part;
  }
  return sum;
}

}  // namespace

std::vector<CostRatio> compare_cost(const Comparand& reference, const Comparand& candidate, const Tolerances& tolerances,
                                    std::vector<CompareFinding>& findings) {
  std::vector<CostRatio> ratios;
  const auto add = [&](const char* name, const std::optional<double>& before, const std::optional<double>& now,
                       const std::optional<double>& limit) {
    if (before && now)
      ratios.push_back({name, *before, *now, limit});
    else if (limit)
      findings.push_back({"cost", fmt::format("a limit was set, but {} are not known for both results", name)});
  };
  const auto steps = {"/solution/steps_accepted", "/solution/steps_rejected", "/certificate/steps_accepted",
                      "/certificate/steps_rejected"};
  const auto evaluations = {"/solution/right_hand_side_evaluations", "/certificate/right_hand_side_evaluations"};
  add("steps", sum_of(reference, steps), sum_of(candidate, steps), tolerances.steps_ratio);
  add("evaluations", sum_of(reference, evaluations), sum_of(candidate, evaluations), tolerances.steps_ratio);
  add("seconds", reference.seconds(), candidate.seconds(), tolerances.seconds_ratio);
  return ratios;
}

}  // namespace earthtop::compare
