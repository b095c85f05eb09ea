// SPDX-License-Identifier: GPL-3.0-or-later
/// The weighted series: its weights against what they promise, and a motion that follows a fast relaxation.
#include "integrate/taylor/stabilised_taylor.hpp"

#include <gtest/gtest.h>

#include "support/tolerances.hpp"

namespace earthtop {
namespace {

/// R(z) = sum_k w_k z^k/k!, what a step multiplies a relaxation by.
double factor_of_step(double z) {
  double sum = 0;
  for (int k = taylor::kStabilisedDegree; k >= 1; --k) sum = (sum + taylor::stabilising_weight(k)) * z / k;
  return 1 + sum;
}

TEST(StabilisedTaylor, DampsEveryRelaxationUpToItsLimit) {
  // The weights have 12 digits; terms at the end of the interval are up to 24^12/12! w_12 = 2e5.
  for (double z = 0.05; z <= taylor::kStableRelaxation; z += 0.01) EXPECT_LT(std::abs(factor_of_step(-z)), 0.952) << z;
  // The first terms are those of the exponential: the first one changed is 0.09 z^7/7!.
  for (const double z : {-0.1, -0.01, 0.1}) EXPECT_NEAR(factor_of_step(z), std::exp(z), 0.1 * std::pow(std::abs(z), 7) / 5040);
}

/// x relaxes to sin t at the rate kRate: x' = kRate (s - x) + c, s' = c, c' = -s.
struct Relaxing {
  static constexpr double kRate = 1000;
  static constexpr std::size_t kSize = 3;
  struct Shape {
    static constexpr std::size_t kSize = 3;
    static constexpr auto groups() { return std::array<ComponentGroup, 2>{{{0, 1, 1.0}, {1, 2, 1.0}}}; }
  };
  using State = std::array<double, kSize>;
  struct Series {
    void start(const State&, double) {}
    void expand(State* x, int order) {
      for (int k = 0; k < order; ++k) {
        const auto [a, s, c] = x[k];
        x[k + 1] = {(kRate * (s - a) + c) / (k + 1), c / (k + 1), -s / (k + 1)};
      }
    }
  };
};

TEST(StabilisedTaylor, FollowsAFastRelaxationInFewSteps) {
  const GroupScales<double, Relaxing::Shape> scales;
  taylor::StabilisedTaylor<Relaxing> stepper(1e-7, scales);
  Relaxing::Series series;
  Relaxing::State x = {0.5, 0, 1};  // half a unit off the motion that it relaxes to
  const double end = 3;
  int steps = 0;
  for (double t = 0; t < end && steps < 10000; ++steps) t += stepper.step(series, x, t, end - t);
  EXPECT_NEAR(x[0], std::sin(end), testing::rounding(1000));
  // Plain terms of the same degree are stable up to a step of 5.7/kRate and would take 520.
  EXPECT_LT(steps, 260);
}

}  // namespace
}  // namespace earthtop
