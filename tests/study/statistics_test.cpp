// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "study/design.hpp"
#include "study/influence.hpp"
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

/// A function of numbers between 0 and 1, with its variance and indices in closed form.
struct TestFunction {
  std::function<double(const std::vector<double>&)> f;
  double mean, variance;
  std::vector<double> first, total;
};

/// The function of T. Ishigami and T. Homma (1990), f = sin x + 7 sin^2 y + 0.1 z^4 sin x over (-pi, pi)^3, plus an offset.
constexpr double kPi = std::numbers::pi, kA = 7, kB = 0.1;
double angle(double u) { return kPi * (2 * u - 1); }
TestFunction ishigami() {
  const double V1 = 0.5 * std::pow(1 + kB * std::pow(kPi, 4) / 5, 2), V2 = kA * kA / 8,
               V13 = kB * kB * std::pow(kPi, 8) * 8 / 225, V = V1 + V2 + V13;
  return {[](const std::vector<double>& u) {
            const double x = angle(u[0]), y = angle(u[1]), z = angle(u[2]);
            return std::sin(x) + kA * std::pow(std::sin(y), 2) + kB * std::pow(z, 4) * std::sin(x) + 1000;
          },
          1000 + kA / 2,
          V,
          {V1 / V, V2 / V, 0},
          {(V1 + V13) / V, V2 / V, V13 / V}};
}

/// Sobol's g-function: the product of (|4 u - 2| + a)/(1 + a).
TestFunction g_function(const std::vector<double>& a) {
  TestFunction g{[a](const std::vector<double>& u) {
                   double product = 1;
                   for (std::size_t i = 0; i < a.size(); ++i) product *= (std::abs(4 * u[i] - 2) + a[i]) / (1 + a[i]);
                   return product;
                 },
                 1,
                 0,
                 {},
                 {}};
  double all = 1;
  for (const double x : a) all *= 1 + 1 / (3 * (1 + x) * (1 + x));
  g.variance = all - 1;
  for (const double x : a) {
    const double own = 1 / (3 * (1 + x) * (1 + x));
    g.first.push_back(own / g.variance);
    g.total.push_back(own * all / (1 + own) / g.variance);
  }
  return g;
}

Study indices_study(DesignKind kind, std::size_t inputs, std::uint64_t base_points, std::uint64_t seed) {
  Study study;
  for (std::size_t i = 0; i < inputs; ++i) {
    StudyAxis axis{"x" + std::to_string(i), {"/x"}, {}, {}};
    axis.range = StudyAxis::Range{{0}, {1}, 0, false};
    study.axes.push_back(axis);
  }
  study.design = {kind, base_points, seed, true};
  return study;
}

std::vector<double> place_of(const Study& study, Design& design, std::uint64_t number) {
  std::vector<double> u;
  const PlannedPoint point = design.point(number);
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    u.push_back(std::get<double>(axis_value(study.axes[i], point.settings[i])));
  return u;
}

/// The indices of a function from the points of a study's design.
std::vector<SobolIndex> indices_of(const TestFunction& function, DesignKind kind, std::uint64_t base_points,
                                   std::uint64_t seed) {
  const std::size_t inputs = function.first.size();
  const Study study = indices_study(kind, inputs, base_points, seed);
  Design design(study);
  SobolSums sums(inputs, function.mean);
  const auto f = [&](std::uint64_t number) { return function.f(place_of(study, design, number)); };
  for (std::uint64_t block = 0; block < base_points; ++block) {
    const double f_A = f((inputs + 2) * block), f_B = f((inputs + 2) * block + 1);
    std::vector<double> f_ABi;
    for (std::uint64_t i = 0; i < inputs; ++i) f_ABi.push_back(f((inputs + 2) * block + 2 + i));
    sums.include(f_A, f_B, f_ABi);
  }
  return sums.indices();
}

TEST(SobolIndices, OfIshigamisFunction) {
  const TestFunction function = ishigami();
  const auto indices = indices_of(function, DesignKind::sobol, 8192, 1);
  ASSERT_EQ(indices.size(), 3U);
  constexpr double kNear = 0.01, kErrors = 5, kRest = 1e-3;  // the errors at 8192 points of a Sobol sequence are below 1e-3
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices[i].first, function.first[i], kNear) << i;
    EXPECT_NEAR(indices[i].total, function.total[i], kNear) << i;
    EXPECT_NEAR(indices[i].first, function.first[i], kErrors * indices[i].first_standard_error + kRest) << i;
    EXPECT_NEAR(indices[i].total, function.total[i], kErrors * indices[i].total_standard_error + kRest) << i;
    EXPECT_LT(indices[i].first_standard_error, 0.03) << i;
  }
}

constexpr int kSeeds = 200;
/// The bounds on the share of errors within two standard errors: 95.4 % of a normal distribution, less what so few seeds scatter.
constexpr double kLeastShare = 0.93, kMostShare = 0.97;

/// The share of all indices of all seeds that are within two of their standard errors of the truth.
double share_within_two_errors(const TestFunction& function, DesignKind kind, std::uint64_t base_points) {
  int within = 0, all = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto indices = indices_of(function, kind, base_points, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < indices.size(); ++i) {
      within += std::abs(indices[i].first - function.first[i]) <= 2 * indices[i].first_standard_error;
      within += std::abs(indices[i].total - function.total[i]) <= 2 * indices[i].total_standard_error;
      all += 2;
    }
  }
  const double share = static_cast<double>(within) / all;
  ::testing::Test::RecordProperty(
      std::to_string(function.first.size()) + "_inputs_" + std::string(to_string(kind)) + "_" + std::to_string(base_points),
      std::to_string(share));
  return share;
}

TEST(SobolIndices, TwoStandardErrorsHoldNineteenOfTwentyOfIndependentPoints) {
  for (const std::uint64_t base_points : {64U, 256U, 1000U}) {
    for (const auto& [name, function] : {std::pair("Ishigami", ishigami()), std::pair("g", g_function({0, 1, 4.5, 9}))}) {
      const double share = share_within_two_errors(function, DesignKind::random, base_points);
      EXPECT_GE(share, kLeastShare) << name << " from " << base_points;
      EXPECT_LE(share, kMostShare) << name << " from " << base_points;
    }
  }
}

/// A Sobol sequence errs less than independent points do, so that the same standard errors hold more of its errors.
TEST(SobolIndices, TwoStandardErrorsHoldThoseOfASobolSequence) {
  for (const std::uint64_t base_points : {64U, 256U, 1000U})
    for (const auto& [name, function] : {std::pair("Ishigami", ishigami()), std::pair("g", g_function({0, 1, 4.5, 9}))})
      EXPECT_GE(share_within_two_errors(function, DesignKind::sobol, base_points), kLeastShare)
          << name << " from " << base_points;
}

/// Of 200 sentences fewer than one in twenty names an input as the first or the second that is not.
TEST(SobolIndices, SentencesNameNoWrongOrder) {
  int told = 0, wrong = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    std::vector<InputIndex> inputs;
    const auto indices = indices_of(ishigami(), DesignKind::random, 1000, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < indices.size(); ++i) inputs.push_back({std::string(1, "xyz"[i]), indices[i]});
    const std::string sentence = influence_sentence("f", inputs, {1000, 1000, 1000, 5000, 0});
    const auto says = [&](const char* words) { return sentence.find(words) != std::string::npos; };
    told += says("matters most for f (") || says("decides f");
    wrong += says("y matters most for f (") || says("z matters most for f (") || says("y decides") || says("z decides") ||
             says("second is x") || says("second is z") || says("no other input");
  }
  EXPECT_GT(told, kSeeds / 10);
  EXPECT_LT(wrong, kSeeds / 20);
}

TEST(SobolIndices, NeedThirtyTwoBasePoints) {
  EXPECT_TRUE(indices_of(ishigami(), DesignKind::sobol, kFewestBasePoints - 1, 1).empty());
  EXPECT_EQ(indices_of(ishigami(), DesignKind::sobol, kFewestBasePoints, 1).size(), 3U);
}

/// A function that differs in one block only has no error that could be told.
TEST(SobolIndices, OfASingleBlockAreNone) {
  SobolSums sums(1, 5);
  for (int i = 0; i < 100; ++i) sums.include(i == 50 ? 6 : 5, 5, {5});
  EXPECT_TRUE(sums.indices().empty());
}

TEST(JackknifeError, IsTheTextbooksForAMean) {
  std::vector<double> without;
  const double x[] = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const double one : x) without.push_back((36 - one) / 7);
  // The standard deviation is sqrt(6). Evenly spaced numbers count as normal ones: as many degrees of freedom as numbers.
  const double plain = std::sqrt(6.0 / 8), widened = jackknife_error(without);
  EXPECT_GT(widened, plain);
  constexpr double kStudent8 = 2.306, kNormal = 1.96, kSeries = 4e-3;  // the first terms of a series
  EXPECT_NEAR(widened / plain, kStudent8 / kNormal, kSeries);
  EXPECT_EQ(jackknife_error({3, 3, 3}), 0);
}

/// Mean squared derivatives of Ishigami's function in closed form, by numbers between -pi and pi.
TEST(DerivativeIndices, OfIshigamisFunctionAreThoseOfTheClosedForm) {
  const TestFunction function = ishigami();
  const double squares[] = {0.5 * (1 + 2 * kB * std::pow(kPi, 4) / 5 + kB * kB * std::pow(kPi, 8) / 9), kA * kA / 2,
                            8 * kB * kB * std::pow(kPi, 6) / 7};
  int within = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Study study = indices_study(DesignKind::random, 3, 256, static_cast<std::uint64_t>(seed));
    study.design.indices = false;
    Design design(study);
    std::vector<DerivativeSums> sums(3, DerivativeSums(function.mean));
    for (std::uint64_t number = 0; number < study.design.points; ++number) {
      const auto u = place_of(study, design, number);
      const double x = angle(u[0]), y = angle(u[1]), z = angle(u[2]), f = function.f(u);
      const double derivatives[] = {std::cos(x) * (1 + kB * std::pow(z, 4)), kA * std::sin(2 * y),
                                    4 * kB * std::pow(z, 3) * std::sin(x)};
      for (std::size_t i = 0; i < 3; ++i) sums[i].include(f, derivatives[i], 2 * kPi * derivatives[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto index = sums[i].index();
      ASSERT_TRUE(index);
      EXPECT_EQ(index->points, 256U);
      const double bound = 4 * squares[i] / function.variance;  // (2 pi / pi)^2
      EXPECT_GE(bound, function.total[i]);
      within += std::abs(index->mean_square - squares[i]) <= 2 * index->mean_square_standard_error;
      within += std::abs(index->total_bound - bound) <= 2 * index->total_bound_standard_error;
    }
  }
  EXPECT_GE(within, kLeastShare * 6 * kSeeds);
  EXPECT_LE(within, kMostShare * 6 * kSeeds);
}

/// The bound is the total index itself where f is half a period of a cosine of each input.
TEST(DerivativeIndices, BoundIsReachedByACosine) {
  DerivativeSums sums(0);
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    const double u = (i + 0.5) / kPoints;
    sums.include(std::cos(kPi * u), -kPi * std::sin(kPi * u), -kPi * std::sin(kPi * u));
  }
  constexpr double kRule = 1e-8;  // the midpoint rule over half a period is exact; sums of 20,000 numbers round
  EXPECT_NEAR(sums.index()->total_bound, 1, kRule);
}

TEST(DerivativeIndices, OfAConstantAreNone) {
  DerivativeSums sums(5);
  EXPECT_FALSE(sums.index());
  for (int i = 0; i < 100; ++i) sums.include(5, 0, 0);
  EXPECT_FALSE(sums.index());
}

TEST(SobolIndices, OfAConstantAreNone) {
  SobolSums sums(1, 5);
  for (int i = 0; i < 100; ++i) sums.include(5, 5, {5});
  EXPECT_TRUE(sums.indices().empty());
}

}  // namespace
}  // namespace earthtop::study
