// SPDX-License-Identifier: GPL-3.0-or-later
// The responses of spread kicks and of the ripple's kicks to the frequencies of a nutating and precessing top.
#include "integrate/kick_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using Filter = KickFilter<double>;

/// The response of a spread kick. @param frequency  in nutations
double kick_response(const Filter& f, double frequency) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.parts); ++i)
    sum += f.weight[i] * std::cos(2 * real::pi<double>() * frequency * f.at[i] / f.period);
  return sum;
}
/// The response of the ripple's kicks, which are odd in time, times i; in periods.
double ripple_response(const Filter& f, double frequency) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.ripples); ++i)
    sum -= 2 * f.ripple_weight[i] * std::sin(2 * real::pi<double>() * frequency * f.ripple_at[i] / f.period);
  return sum / f.period;
}

// The weights solve equations whose conditions grow as the inverse square of the ratio, in long double.
constexpr double kSlack = testing::rounding(200);

TEST(KickFilter, FineOnePassesThePrecessionAndStopsTheNutation) {
  for (const double ratio : {1e-3, 0.0073, 0.019})
    for (const int spacing : {1, 2}) {
      const Filter f = kick_filters::fine(0.042, ratio, spacing);
      EXPECT_NEAR(kick_response(f, 0), 1, kSlack);
      EXPECT_NEAR(kick_response(f, ratio), 1, kSlack);
      for (int harmonic = 1; harmonic <= 4; ++harmonic)
        for (int side = -1; side <= 1; ++side)
          EXPECT_NEAR(kick_response(f, harmonic + side * ratio), 0, kSlack) << ratio << ' ' << harmonic << ' ' << side;
      EXPECT_TRUE(f.returns);
    }
}

TEST(KickFilter, FineRippleIsTheIntegralOfTheNutation) {
  for (const double ratio : {1e-3, 0.0073, 0.019}) {
    const Filter f = kick_filters::fine(0.042, ratio);
    EXPECT_NEAR(ripple_response(f, ratio), 0, testing::rounding(20));
    for (int harmonic = 1; harmonic <= 2; ++harmonic)
      for (int side = -1; side <= 1; ++side) {
        const double frequency = harmonic + side * ratio;
        EXPECT_NEAR(ripple_response(f, frequency), 1 / (2 * real::pi<double>() * frequency), testing::rounding(20)) << ratio;
      }
    EXPECT_NEAR(ripple_response(f, 3), 1 / (6 * real::pi<double>()), testing::rounding(20));
  }
}

// The two effects of second order by direct sums over ordered pairs of parts: the secular one, which d has to make up to the
// integral of a sine over a whole number of periods, and the resonant one, which has to vanish.
TEST(KickFilter, FineOneHasTheRightEffectsOfSecondOrder) {
  for (const int spacing : {1, 2}) {
    const Filter f = kick_filters::fine(1.0, 0.0073, spacing);
    const double n = 2 * real::pi<double>();
    double secular = 0, resonant = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(f.parts); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        secular += f.weight[i] * f.weight[j] * std::sin(n * (f.at[i] - f.at[j]));
        resonant += f.weight[i] * f.weight[j] * (std::sin(n * f.at[i]) - std::sin(n * f.at[j]));
      }
    EXPECT_NEAR(f.second_order * secular, 1 / n, testing::rounding(20));
    EXPECT_NEAR(resonant, 0, testing::rounding(20));
  }
}

TEST(KickFilter, CoarseOneStopsTwoHarmonics) {
  for (const int spacing : {1, 2}) {
    const Filter f = kick_filters::coarse(3.0, spacing);
    EXPECT_NEAR(kick_response(f, 0), 1, 1e-15);
    for (const double harmonic : {1.0, 2.0}) {
      EXPECT_NEAR(kick_response(f, harmonic), 0, 1e-14);
      EXPECT_NEAR(kick_response(f, harmonic * (1 + 1e-4)), 0, 1e-6);  // the zero is double
    }
    for (const double harmonic : {1.0, 2.0, 3.0})
      EXPECT_NEAR(ripple_response(f, harmonic), 1 / (2 * real::pi<double>() * harmonic), 1e-14);
  }
}

}  // namespace
}  // namespace earthtop
