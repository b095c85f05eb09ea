// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "study/permutation.hpp"

namespace earthtop::study {
namespace {

StudyAxis range_axis(const std::string& name, double from, double to, std::uint64_t points, bool logarithmic = false) {
  StudyAxis axis{name, {"/" + name}, {}, {}};
  axis.range = StudyAxis::Range{{from}, {to}, points, logarithmic};
  return axis;
}
StudyAxis list_axis(const std::string& name, std::vector<std::string> values) {
  StudyAxis axis{name, {"/" + name}, {}, {}};
  for (std::string& value : values) axis.levels.push_back({std::move(value)});
  return axis;
}
Study study_of(DesignKind kind, std::vector<StudyAxis> axes, std::uint64_t points = 0, std::uint64_t seed = 1) {
  Study study;
  study.axes = std::move(axes);
  study.design = {kind, points, seed, false};
  return study;
}
std::vector<double> values(const Study& study, Design& design, std::uint64_t number) {
  std::vector<double> list;
  const PlannedPoint point = design.point(number);
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const Value value = axis_value(study.axes[a], point.settings[a]);
    list.push_back(std::holds_alternative<double>(value) ? std::get<double>(value) : NAN);
  }
  return list;
}

TEST(Grid, FirstAxisIsSlowestAndEndsAreExact) {
  const Study study = study_of(
      DesignKind::grid, {range_axis("x", -0.1, 0.7, 3), list_axis("y", {"10", "20"}), range_axis("z", 1e-3, 1e3, 7, true)});
  ASSERT_EQ(point_count(study), 42U);
  Design design(study);
  EXPECT_EQ(values(study, design, 0), (std::vector<double>{-0.1, 10, 1e-3}));
  EXPECT_EQ(values(study, design, 6), (std::vector<double>{-0.1, 10, 1e3}));
  EXPECT_EQ(values(study, design, 7), (std::vector<double>{-0.1, 20, 1e-3}));
  EXPECT_EQ(values(study, design, 41), (std::vector<double>{0.7, 20, 1e3}));
  EXPECT_NEAR(values(study, design, 3)[2], 1, 4e-15);                      // the middle of the ratios
  EXPECT_EQ(values(study, design, 14 + 7)[0], -0.1 + 0.5 * (0.7 - -0.1));  // the middle of the steps
}

TEST(Grid, NegativeRatiosAndSinglePoints) {
  const Study study = study_of(DesignKind::grid, {range_axis("x", -1, -100, 3, true), range_axis("y", 5, 9, 1)});
  Design design(study);
  EXPECT_EQ(point_count(study), 3U);
  EXPECT_NEAR(values(study, design, 1)[0], -10, 4e-14);
  EXPECT_EQ(values(study, design, 2), (std::vector<double>{-100, 5}));
}

TEST(Counting, OverflowsAreNoNumbers) {
  const auto axis = [](const char* name) { return range_axis(name, 0, 1, 1'000'000'000); };
  EXPECT_EQ(point_count(study_of(DesignKind::grid, {axis("x")})), 1'000'000'000U);
  EXPECT_FALSE(point_count(study_of(DesignKind::grid, {axis("x"), axis("y"), axis("z")})));
  EXPECT_EQ(point_count(study_of(DesignKind::one_at_a_time, {axis("x"), axis("y")})), 2'000'000'001U);
  Study sobol = study_of(DesignKind::sobol, {axis("x"), axis("y")}, std::uint64_t{1} << 52U);
  EXPECT_EQ(point_count(sobol), std::uint64_t{1} << 52U);
  sobol.design.indices = true;
  EXPECT_FALSE(point_count(sobol));
}

TEST(OneAtATime, OthersStayAtTheBase) {
  const Study study = study_of(DesignKind::one_at_a_time, {list_axis("x", {"1", "2"}), range_axis("y", 3, 4, 2)});
  Design design(study);
  ASSERT_EQ(point_count(study), 5U);
  EXPECT_TRUE(point_changes(study, design.point(0)).empty());
  using Changes = std::vector<input::TreeChange>;
  EXPECT_EQ(point_changes(study, design.point(2)), (Changes{{"/x", "2"}}));
  EXPECT_EQ(point_changes(study, design.point(4)), (Changes{{"/y", 4.0}}));
}

TEST(TiedPointers, ChangeTogether) {
  StudyAxis axis{"pair", {"/a", "/b"}, {}, {}};
  axis.range = StudyAxis::Range{{0, 10}, {1, 30}, 3, false};
  Study study = study_of(DesignKind::grid, {axis});
  Design design(study);
  using Changes = std::vector<input::TreeChange>;
  EXPECT_EQ(point_changes(study, design.point(1)), (Changes{{"/a", 0.5}, {"/b", 20.0}}));
}

TEST(Permutation, IsOneForEverySize) {
  for (const std::uint64_t size : {1ULL, 2ULL, 3ULL, 7ULL, 64ULL, 65ULL, 1000ULL}) {
    std::set<std::uint64_t> images;
    for (std::uint64_t i = 0; i < size; ++i) images.insert(permuted(i, size, 42, 3));
    EXPECT_EQ(images.size(), size);
    EXPECT_EQ(*images.rbegin(), size - 1);
  }
  int moved = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) moved += permuted(i, 1000, 42, 3) != permuted(i, 1000, 43, 3);
  EXPECT_GT(moved, 980);  // another seed, another permutation
}

TEST(LatinHypercube, HasOnePointInEachOfAsManySlices) {
  constexpr std::uint64_t kPoints = 250;
  const Study study = study_of(DesignKind::latin_hypercube, {range_axis("x", 0, 1, 0), range_axis("y", 0, 1, 0)}, kPoints, 7);
  Design design(study);
  std::array<std::set<int>, 2> slices;
  double product = 0;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const auto x = values(study, design, i);
    for (std::size_t a = 0; a < 2; ++a) slices[a].insert(static_cast<int>(x[a] * kPoints));
    product += (x[0] - 0.5) * (x[1] - 0.5) * 12 / kPoints;
  }
  EXPECT_EQ(slices[0].size(), kPoints);
  EXPECT_EQ(slices[1].size(), kPoints);
  EXPECT_LT(std::abs(product), 4 / std::sqrt(kPoints));  // the axes are drawn independently
}

TEST(Random, IsUniformAndAnyPointCanBeHadFirst) {
  const Study study = study_of(DesignKind::random, {range_axis("x", 0, 1, 0), range_axis("y", 0, 1, 0)}, 10000);
  Design forward(study), backward(study);
  double sum = 0, squares = 0, product = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const auto x = values(study, forward, i);
    sum += x[0];
    squares += x[0] * x[0];
    product += (x[0] - 0.5) * (x[1] - 0.5);
  }
  EXPECT_NEAR(sum / 10000, 0.5, 4 * 0.2887 / 100);
  EXPECT_NEAR(squares / 10000, 1.0 / 3, 4 * 0.298 / 100);
  EXPECT_NEAR(product / 10000, 0, 4.0 / 12 / 100);
  for (std::uint64_t i = 100; i-- > 0;) EXPECT_EQ(values(study, backward, i), values(study, forward, i));
}

/// The error of the integral of x y over the unit square: about 1/N for a Sobol sequence of N points, 1/sqrt(N) for random
/// points.
double integral_error(DesignKind kind, std::uint64_t seed) {
  constexpr std::uint64_t kPoints = 4096;
  const Study study = study_of(kind, {range_axis("x", 0, 1, 0), range_axis("y", 0, 1, 0)}, kPoints, seed);
  Design design(study);
  double sum = 0;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const auto x = values(study, design, i);
    sum += x[0] * x[1];
  }
  return std::abs(sum / kPoints - 0.25);
}

TEST(Sobol, IsMoreEvenThanChanceForEverySeed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) EXPECT_LT(integral_error(DesignKind::sobol, seed), 1e-3);
  double chance = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) chance = std::max(chance, integral_error(DesignKind::random, seed));
  EXPECT_GT(chance, 2e-3);
}

TEST(Sobol, SkipsPointsOfOtherShardsButNotBack) {
  const Study study = study_of(DesignKind::sobol, {range_axis("x", 0, 1, 0)}, 100);
  Design all(study), some(study);
  std::map<std::uint64_t, std::vector<double>> known;
  for (std::uint64_t i = 0; i < 100; ++i) known[i] = values(study, all, i);
  for (std::uint64_t i = 1; i < 100; i += 3) EXPECT_EQ(values(study, some, i), known[i]);
  EXPECT_THROW(some.point(0), std::logic_error);
}

TEST(Sobol, IndicesTakeOneColumnOfTheSecondMatrixEach) {
  Study study = study_of(DesignKind::sobol, {range_axis("x", 0, 1, 0), range_axis("y", 0, 1, 0), range_axis("z", 0, 1, 0)}, 8);
  study.design.indices = true;
  ASSERT_EQ(point_count(study), 40U);
  Design design(study);
  for (std::uint64_t draw = 0; draw < 8; ++draw) {
    const auto A = values(study, design, 5 * draw), B = values(study, design, 5 * draw + 1);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto mixed_point = values(study, design, 5 * draw + 2 + i);
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_EQ(mixed_point[a], a == i ? B[a] : A[a]);
        EXPECT_NE(A[a], B[a]);
      }
    }
  }
}

TEST(DrawnLists, TakeEveryLevelAboutAsOften) {
  const Study study = study_of(DesignKind::sobol, {list_axis("x", {"1", "2", "3"}), range_axis("y", 0, 1, 0)}, 300);
  Design design(study);
  std::map<double, int> counts;
  for (std::uint64_t i = 0; i < 300; ++i) ++counts[values(study, design, i)[0]];
  for (const double level : {1.0, 2.0, 3.0}) EXPECT_NEAR(counts[level], 100, 5);
}

}  // namespace
}  // namespace earthtop::study
