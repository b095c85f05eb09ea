// SPDX-License-Identifier: GPL-3.0-or-later
/// Taylor series: products of series, adaptive order and step, dense output, round-off that does not accumulate.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "integrate/odeint_driver.hpp"
#include "integrate/taylor/packed_products.hpp"

namespace earthtop {
namespace {

/// The products of random series in kLanes lanes, put in by fours: order by order, then lane by lane.
template <class T, int kLanes, int kWidth>
std::vector<T> packed_products(const std::vector<T>& left, const std::vector<T>& right) {
  using Four = taylor::Pack<T, 4>;
  const auto products = std::make_unique<taylor::PackedProducts<T, kLanes>>();
  std::vector<T> all;
  taylor::for_each_order(taylor::kMostOrder<T>, [&]<taylor::Place kPlace>(int k) {
    const std::size_t row = static_cast<std::size_t>(k) * kLanes;
    std::array<Four, kLanes / 4> newest;
    for (std::size_t i = 0; i < newest.size(); ++i) {
      const std::size_t at = row + 4 * i;
      const Four a{left[at], left[at + 1], left[at + 2], left[at + 3]};
      const Four b{right[at], right[at + 1], right[at + 2], right[at + 3]};
      products->template put<kPlace, 4>(k, static_cast<int>(4 * i), a, b, newest[i]);
    }
    products->template convolve<kPlace, kWidth>(k);
    for (std::size_t i = 0; i < newest.size(); ++i) {
      products->template complete<kPlace, 4>(k, static_cast<int>(4 * i), newest[i]);
      for (int l = 0; l < 4; ++l) all.push_back(newest[i][l]);
    }
  });
  return all;
}

template <class T, int kLanes>
void expect_packed_convolution() {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> number(-1, 1);
  const int orders = taylor::kMostOrder<T>;
  std::vector<T> left, right;
  for (int i = 0; i < orders * kLanes; ++i) left.push_back(T(number(random))), right.push_back(T(number(random)));
  const std::vector<T> products = packed_products<T, kLanes, 4>(left, right);
  for (int k = 0; k < orders; ++k)
    for (int l = 0; l < kLanes; ++l) {
      const auto at = [&](int order) { return static_cast<std::size_t>(order * kLanes + l); };
      T sum = T(0);
      for (int j = 0; j <= k; ++j) sum += left[at(j)] * right[at(k - j)];
      const T slack = T(4 * (k + 1)) * real::epsilon<T>();  // sums of k + 1 products below 1
      EXPECT_LT(real::abs(products[at(k)] - sum), slack) << k << " " << l;
    }
  if constexpr (std::is_same_v<T, double>) {  // every digit is the same whatever the width of the vectors
    EXPECT_EQ(products, (packed_products<T, kLanes, 2>(left, right)));
    EXPECT_EQ(products, (packed_products<T, kLanes, 8>(left, right)));
  }
}

TEST(TaylorProducts, ArePackedConvolutionsForEveryWidth) {
  expect_packed_convolution<double, 12>();
  expect_packed_convolution<double, 24>();
  expect_packed_convolution<double, 44>();
  expect_packed_convolution<float128, 12>();
}

TEST(RoughLogarithm, IsGoodEnoughForSteps) {
  for (double x = -700; x < 700; x += 0.37) {
    EXPECT_NEAR(taylor::rough_exponential(x) / std::exp(x), 1, 1e-7) << x;  // the first term left out is below 2e-8
    EXPECT_NEAR(taylor::rough_logarithm(std::exp(x)), x, 1e-7) << x;
  }
  EXPECT_LT(taylor::rough_logarithm(0x1p-1060), -708);
  EXPECT_GT(taylor::rough_logarithm(std::numeric_limits<double>::infinity()), 709);
}

/// x' = y, y' = -x: the series of sine and cosine.
struct Circle {
  using Shape = Circle;
  static constexpr std::size_t kSize = 2;
  using State = std::array<double, 2>;
  static constexpr std::array<ComponentGroup, 1> groups() { return {{{0, 2, 1.0}}}; }
  struct Series {
    void start(const State&) {}
    void extend(int k, const State& x, State& next) const { next = {x[1] / (k + 1), -x[0] / (k + 1)}; }
  };
  Series series() const { return {}; }
  void operator()(const State& x, State& dxdt, double) const { dxdt = {x[1], -x[0]}; }
};

TEST(TaylorStepper, ErrorAndWorkFollowTheTolerance) {
  double before = 1, work_before = 0;
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    GroupScales<double, Circle> scales;
    taylor::TaylorStepper<double, Circle> stepper(tolerance, scales);
    Circle::Series series;
    stepper.initialize({0, 1}, 0);
    double worst = 0;
    Circle::State x;
    for (int step = 0; step < 40; ++step) {
      const auto [t0, t1] = stepper.do_step(series);
      for (const double t : {t0 + 0.3 * (t1 - t0), t0 + 0.9 * (t1 - t0), t1}) {  // dense output is as good as the ends
        stepper.calc_state(t, x);
        worst = std::max(worst, std::hypot(x[0] - std::sin(t), x[1] - std::cos(t)));
      }
    }
    // The last term is 1e-4 of the tolerance, the error of a step less than twice that; 40 of them.
    EXPECT_LT(worst, 80 * std::max(1e-4 * tolerance, 4e-16));
    EXPECT_LT(worst, before);
    const double work = stepper.evaluations() / stepper.current_time_step();
    EXPECT_GT(work, work_before);
    before = worst, work_before = work;
  }
}

TEST(TaylorStepper, DigitsBelowTheStateAreKept) {
  GroupScales<double, Circle> scales;
  taylor::TaylorStepper<double, Circle> stepper(1e-14, scales);
  Circle::Series series;
  // Each step adds less than half an ulp to a cosine near 1: without the remainder that the stepper keeps, nothing would ever
  // change.
  stepper.initialize({0, 1}, 0);
  const double h = 1e-9;
  for (int step = 0; step < 100000; ++step) {
    stepper.limit_step(h);
    stepper.do_step(series);
  }
  EXPECT_NEAR(stepper.current_state()[1] - 1, std::cos(1e-4) - 1, 2e-16);
  EXPECT_NEAR(stepper.current_state()[0], std::sin(1e-4), 1e-18);
}

}  // namespace
}  // namespace earthtop
