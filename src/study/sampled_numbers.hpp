// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of points that stand for a whole study.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "earthtop/study/study.hpp"
#include "study/permutation.hpp"

namespace earthtop::study {

/// Numbers of points at equal distances over a study, the first and the last among them.
inline std::vector<std::uint64_t> spread(std::uint64_t count, std::uint64_t wanted) {
  std::vector<std::uint64_t> numbers;
  const std::uint64_t n = std::min(count, wanted);
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto share = n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0.0;
    numbers.push_back(std::min(count - 1, static_cast<std::uint64_t>(share * static_cast<double>(count - 1))));
  }
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// Numbers of points scattered over a study: the first, the last, and one from each of equal parts between them. The place
/// within each part is random, because equal distances could meet the same few values of an axis again and again.
/// @param drawing  each number gives other places
inline std::vector<std::uint64_t> scattered(std::uint64_t count, std::uint64_t wanted, std::uint64_t drawing = 0) {
  if (count <= wanted) return spread(count, wanted);
  std::vector<std::uint64_t> numbers = {0};
  const std::uint64_t parts = wanted - 2, between = count - 2;
  for (std::uint64_t i = 0; i < parts; ++i) {
    const std::uint64_t begin = 1 + i * between / parts, end = 1 + (i + 1) * between / parts;
    numbers.push_back(begin + mixed(i + (drawing << 32U)) % (end - begin));
  }
  numbers.push_back(count - 1);
  return numbers;
}

/// The number of points from which a selection is made. A Sobol sequence has to run through all points before the one asked
/// for; of a very long one, only the beginning is used.
inline std::uint64_t reach(const Study& study, std::uint64_t count, std::uint64_t quick = 1'000'000) {
  return study.design.kind == DesignKind::sobol ? std::min(count, quick) : count;
}

/// Seconds that a rule gives the run of a point. @param between  whether its motion is looked at between the rows
inline double seconds_by_rule(const Scene& scene, bool between) {
  const RunSeconds run = scene.estimate().seconds;
  return run.all() - (between ? 0 : run.largest);
}

/// Processor time besides the runs: of a point, to store it and to write its results, and of the whole, for what is done once (s).
inline constexpr double kStoring_s = 3e-5, kStart_s = 0.05;

}  // namespace earthtop::study
