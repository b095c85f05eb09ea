// SPDX-License-Identifier: GPL-3.0-or-later
/// The search for the first passing of a threshold, tested on drifts given by formulas: a trend with one or two oscillations,
/// sampled as rarely as the long steps of some methods sample it.
#include "drift/watch/threshold_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace earthtop {
namespace {

/// A drift that rises by `slope` (1/s), with oscillations at two rates.
struct Wave {
  double slope = 1e-3, size = 0, rate = 1, phase = 0, second = 0, second_rate = 0.3;
  double at(double t) const {
    return 1 + slope * t + size * (std::cos(phase) - std::cos(rate * t + phase)) + second * std::sin(second_rate * t);
  }
  double derivative(double t) const {
    return slope + size * rate * std::sin(rate * t + phase) + second * second_rate * std::cos(second_rate * t);
  }
  AxisDriftSample<double> look(double t) const {
    AxisDriftSample<double> look;
    look.t = t, look.axis = at(t), look.rate = derivative(t);
    look.difference_rate = Vec3<double>(derivative(t), size * rate, second * second_rate);
    return look;
  }
};

ThresholdRecord<double> follow(const Wave& wave, double threshold, double every, double end, int* looks = nullptr) {
  ThresholdWatch<double> watch(threshold, 1.0);
  for (double t = 0; t <= end; t += every)
    watch.follow(wave.look(t), [&](double at) {
      if (looks) ++*looks;
      return wave.look(at);
    });
  return watch.record();
}

/// The first passing, found by short steps and bisection of the step in which it happens.
std::optional<double> first_passing(const Wave& wave, double threshold, double end) {
  constexpr double kStep = 0.015;
  for (double t = 0; t < end; t += kStep) {
    if (wave.at(t + kStep) < threshold) continue;
    double below = t, above = t + kStep;
    for (int i = 0; i < 60; ++i) {
      const double middle = below + (above - below) / 2;
      (wave.at(middle) < threshold ? below : above) = middle;
    }
    return above;
  }
  return std::nullopt;
}

TEST(ThresholdWatch, FindsTheFirstPassingHoweverSeldomItLooks) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  constexpr double kEnd = 300;
  int passed = 0, many = 0;
  for (int i = 0; i < 600; ++i) {
    const Wave wave{uniform(-1e-3, 1e-2), std::pow(10, uniform(-4, 0)),  uniform(0.2, 1),
                    uniform(0, 6.3),      std::pow(10, uniform(-5, -1)), uniform(0.01, 0.5)};
    const double threshold = 1 + std::abs(wave.size) * uniform(0.2, 3) + uniform(0, 1);
    const double every = uniform(0.05, 8);  // from a fraction of a turn to more than one
    SCOPED_TRACE(::testing::Message() << "wave " << i << ", a look every " << every);
    int looks = 0;
    const ThresholdRecord<double> record = follow(wave, threshold, every, kEnd, &looks);
    const std::optional<double> expected = first_passing(wave, threshold, kEnd - every);
    EXPECT_FALSE(record.unresolved);
    if (expected) {
      ASSERT_TRUE(record.passing);
      ++passed;
      // The tolerance: the rounding of the drift divided by its rate, and the rounding of the time.
      const double slack = 8e-16 * threshold / std::max(1e-9, wave.derivative(*expected)) + 4e-16 * *expected;
      ASSERT_NEAR(record.passing->t, *expected, slack);
    } else if (record.passing) {
      // The short steps of the slow search may miss a maximum that just passes the threshold, or the passing is in the last
      // piece.
      ASSERT_GE(wave.at(record.passing->t + 1e-9), threshold - 1e-12);
    }
    many = std::max(many, looks);
  }
  EXPECT_GT(passed, 240);
  EXPECT_LT(many, 2500);
}

TEST(ThresholdWatch, KnowsATopThatTouches) {
  // Without a trend, maxima of 1 + 2 size at (2 k + 1) pi.
  const Wave wave{0, 0.01, 1, 0};
  for (const double every : {0.1, 0.7, 2.0, 5.0}) {
    SCOPED_TRACE(every);
    const ThresholdRecord<double> below = follow(wave, 1.02 + 1e-9, every, 20);
    EXPECT_FALSE(below.passing);
    EXPECT_NEAR(below.turned_back, 1.02, 1e-15);  // the top itself was found
    const ThresholdRecord<double> above = follow(wave, 1.02 - 1e-9, every, 20);
    ASSERT_TRUE(above.passing);
    EXPECT_NEAR(above.passing->t, std::acos(-1 + 1e-7), 1e-9);
    EXPECT_TRUE(above.fell_after);
    EXPECT_NEAR(above.curvature, -0.01, 1e-3);
  }
}

TEST(ThresholdWatch, RemembersWhenTheDriftCameNear) {
  const Wave wave{0.01, 0, 1, 0};
  const ThresholdRecord<double> record = follow(wave, 2, 0.5, 200);
  ASSERT_TRUE(record.passing);
  EXPECT_NEAR(record.passing->t, 100, 1e-12);
  for (std::size_t k = 0; k < 8; ++k) {
    const double part = std::ldexp(2, -static_cast<int>(k));
    ASSERT_TRUE(record.within[k]);
    const double within = std::max(0.0, 100 - 100 * part);
    EXPECT_LE(*record.within[k], within + 1e-9);
    EXPECT_GE(*record.within[k], within - 0.5 - 1e-9);
    if (k == 0) continue;  // twice the threshold is not reached
    ASSERT_TRUE(record.beyond[k]);
    EXPECT_GE(*record.beyond[k], 100 + 100 * part - 1e-9);
    EXPECT_LE(*record.beyond[k], 100 + 100 * part + 0.5 + 1e-9);
  }
}

}  // namespace
}  // namespace earthtop
