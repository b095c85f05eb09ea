// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "study/design.hpp"
#include "study/rank_search.hpp"

namespace earthtop::study {
namespace {

TEST(MomentsOfPoints, KeepDigitsOfALargeMean) {
  Moments m;
  for (int i = 0; i < 1000; ++i) m.include(1e9 + i % 2);
  EXPECT_EQ(m.count, 1000U);
  EXPECT_NEAR(m.mean, 1e9 + 0.5, 1e-6);
  EXPECT_NEAR(*m.standard_deviation(), std::sqrt(0.25 * 1000 / 999), 1e-9);
  EXPECT_EQ(m.least, 1e9);
  EXPECT_EQ(m.most, 1e9 + 1);
}

/// Signs, sizes and repetitions of all kinds: every number must be found where sorting puts it.
TEST(RankSearches, FindWhatSortingFinds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(20261123);
  std::normal_distribution<double> normal;
  std::vector<double> numbers = {0.0, -kInfinity, kInfinity, 5e-324, -5e-324, 1.5, 1.5, 1.5, std::nextafter(1.5, 2)};
  for (int i = 0; i < 300; ++i) numbers.push_back(normal(random));
  for (int i = 0; i < 100; ++i) numbers.push_back(normal(random) * std::exp2(normal(random) * 300));
  std::vector<std::uint64_t> ranks;
  for (std::uint64_t rank = 0; rank < numbers.size(); ++rank) ranks.push_back(rank);
  RankSearch search(ranks);
  for (int pass = 0; pass < RankSearch::kPasses; ++pass) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    for (const double x : numbers) search.include(x);
    search.end_pass();
  }
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(search.found(), numbers);
}

TEST(Lines, AreExactForPointsOnALine) {
  LineFit fit;
  for (int i = 0; i < 1000; ++i) fit.include(0.01 * i, 3 - 2 * 0.01 * i);
  const auto line = fit.line();
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->a, 3, 1e-13);
  EXPECT_NEAR(line->b, -2, 1e-13);
  EXPECT_LT(*line->residual_rms, 1e-13);
}

/// A textbook example by hand: x = 1, 2, 3, 4 and y = 6, 5, 7, 10 give a = 3.5, b = 1.4 and a sum of squared residuals of 4.2.
TEST(Lines, HaveTheStandardErrorsOfTheTextbook) {
  LineFit fit;
  const double y[] = {6, 5, 7, 10};
  for (int i = 0; i < 4; ++i) fit.include(i + 1, y[i]);
  const auto line = fit.line();
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->a, 3.5, 1e-13);
  EXPECT_NEAR(line->b, 1.4, 1e-13);
  EXPECT_NEAR(*line->b_standard_error, std::sqrt(4.2 / 2 / 5), 1e-13);  // Sxx = 5
  EXPECT_NEAR(*line->a_standard_error, std::sqrt(4.2 / 2 * (1.0 / 4 + 2.5 * 2.5 / 5)), 1e-13);
  EXPECT_NEAR(*line->residual_rms, std::sqrt(4.2 / 4), 1e-13);
}

TEST(Lines, StandardErrorsCoverTheTruth) {
  std::mt19937_64 random(20261122);
  std::normal_distribution<double> noise(0, 0.1);
  int covered = 0;
  for (int trial = 0; trial < 400; ++trial) {
    LineFit fit;
    for (int i = 0; i < 300; ++i) fit.include(i * 0.1, 1 + 2 * (i * 0.1) + noise(random));
    const auto line = fit.line();
    covered += std::abs(line->b - 2) < *line->b_standard_error;
  }
  EXPECT_NEAR(covered / 400.0, 0.683, 4 * std::sqrt(0.683 * 0.317 / 400));
}

TEST(Lines, NeedTwoDifferentPlaces) {
  LineFit none, one, same;
  one.include(1, 1);
  same.include(1, 1);
  same.include(1, 2);
  EXPECT_FALSE(none.line());
  EXPECT_FALSE(one.line());
  EXPECT_FALSE(same.line());
}

/// The function of T. Ishigami and T. Homma (1990), f = sin x + 7 sin^2 y + 0.1 z^4 sin x over (-pi, pi)^3, whose indices are
/// known.
TEST(SobolIndices, OfIshigamisFunction) {
  constexpr double kPi = std::numbers::pi, a = 7, b = 0.1;
  Study study;
  for (const char* name : {"x", "y", "z"}) {
    StudyAxis axis{name, {"/x"}, {}, {}};
    axis.range = StudyAxis::Range{{-kPi}, {kPi}, 0, false};
    study.axes.push_back(axis);
  }
  constexpr std::uint64_t kBlocks = 8192;
  study.design = {DesignKind::sobol, kBlocks, 1, true};
  Design design(study);
  const auto f = [&](std::uint64_t number) {
    const PlannedPoint point = design.point(number);
    double x[3];
    for (std::size_t i = 0; i < 3; ++i) x[i] = std::get<double>(axis_value(study.axes[i], point.settings[i]));
    return std::sin(x[0]) + a * std::pow(std::sin(x[1]), 2) + b * std::pow(x[2], 4) * std::sin(x[0]) + 1000;
  };
  SobolSums sums(3, 1000 + a / 2);
  for (std::uint64_t block = 0; block < kBlocks; ++block) {
    const double f_A = f(5 * block), f_B = f(5 * block + 1);
    std::vector<double> f_ABi;
    for (std::uint64_t i = 0; i < 3; ++i) f_ABi.push_back(f(5 * block + 2 + i));
    sums.include(f_A, f_B, f_ABi);
  }
  const double V1 = 0.5 * std::pow(1 + b * std::pow(kPi, 4) / 5, 2), V2 = a * a / 8, V13 = b * b * std::pow(kPi, 8) * 8 / 225;
  const double V = V1 + V2 + V13;
  const double first[] = {V1 / V, V2 / V, 0}, total[] = {(V1 + V13) / V, V2 / V, V13 / V};
  const auto indices = sums.indices();
  ASSERT_EQ(indices.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices[i].first, first[i], 0.01) << i;
    EXPECT_NEAR(indices[i].total, total[i], 0.01) << i;
    EXPECT_NEAR(indices[i].first, first[i], 5 * indices[i].first_standard_error + 1e-3) << i;
    EXPECT_NEAR(indices[i].total, total[i], 5 * indices[i].total_standard_error + 1e-3) << i;
    EXPECT_LT(indices[i].first_standard_error, 0.03) << i;
  }
}

TEST(SobolIndices, OfAConstantAreNone) {
  SobolSums sums(1, 5);
  for (int i = 0; i < 100; ++i) sums.include(5, 5, {5});
  EXPECT_TRUE(sums.indices().empty());
}

}  // namespace
}  // namespace earthtop::study
