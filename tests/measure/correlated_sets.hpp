// SPDX-License-Identifier: GPL-3.0-or-later
/// A thousand seeded measurements whose errors are correlated in time, and what must be true of the fits to them.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "measure/made_up_measurements.hpp"

namespace earthtop::test {

inline constexpr std::uint64_t kCorrelatedSeed = 20261123;
inline constexpr int kSets = 1000, kCorrelatedRows = 42;
inline constexpr double kTau_s = 5;

/// Times at distances from 0.1 to 2 correlation times, the same for every set.
inline std::vector<double> uneven_times() {
  std::mt19937_64 bits(7);
  std::vector<double> times = {0};
  while (times.size() < kCorrelatedRows)
    times.push_back(times.back() + kTau_s * (0.1 + 1.9 * static_cast<double>(bits() >> 11) * 0x1p-53));
  return times;
}
/// Standard errors of two sizes (rad).
inline double error_of_row(std::size_t row) { return row % 3 == 0 ? 2e-5 : 1e-5; }

/// The errors of one set (rad): an Ornstein-Uhlenbeck process in units of the standard errors.
inline std::vector<double> correlated_errors(const std::vector<double>& times, Normal& normal) {
  std::vector<double> errors;
  double e = normal();
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) {
      const double rho = std::exp(-(times[k] - times[k - 1]) / kTau_s);
      e = rho * e + std::sqrt(1 - rho * rho) * normal();
    }
    errors.push_back(e * error_of_row(k));
  }
  return errors;
}

/// The estimates' errors in their standard errors, and the chances of chi-squared.
struct Scores {
  std::vector<double> pulls, chances;

  double share_within(double sigmas) const {
    const auto inside = std::count_if(pulls.begin(), pulls.end(), [&](double pull) { return std::abs(pull) <= sigmas; });
    return static_cast<double>(inside) / static_cast<double>(pulls.size());
  }
  /// The largest distance of the chances' distribution from the uniform one, in units of the size that 1 % of uniform samples
  /// exceed [Kolmogorov; 1.628 / sqrt(n)].
  double kolmogorov() const {
    std::vector<double> sorted = chances;
    std::sort(sorted.begin(), sorted.end());
    const auto n = static_cast<double>(sorted.size());
    double largest = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i)
      largest = std::max({largest, sorted[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - sorted[i]});
    return largest * std::sqrt(n) / 1.628;
  }
};

/// Three standard errors of a thousand draws' shares within one and, rounded, two standard errors.
inline constexpr double kWithinOne = 0.683, kOneSlack = 0.045, kWithinTwo = 0.954, kTwoSlack = 0.02;

inline void show(const Scores& scores) {
  fmt::print("{:.1f} and {:.1f} % within one and two standard errors; Kolmogorov {:.2f} of the limit\n",
             100 * scores.share_within(1), 100 * scores.share_within(2), scores.kolmogorov());
}
inline void expect_errors_as_stated(const Scores& scores) {
  show(scores);
  EXPECT_NEAR(scores.share_within(1), kWithinOne, kOneSlack);
  EXPECT_NEAR(scores.share_within(2), kWithinTwo, kTwoSlack);
  EXPECT_LT(scores.kolmogorov(), 1);
}
inline void expect_errors_too_small(const Scores& scores) {
  show(scores);
  EXPECT_LT(scores.share_within(1), kWithinOne - kOneSlack);
  EXPECT_LT(scores.share_within(2), kWithinTwo - kTwoSlack);
  EXPECT_GT(scores.kolmogorov(), 1);
}

}  // namespace earthtop::test
