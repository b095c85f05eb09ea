// SPDX-License-Identifier: GPL-3.0-or-later
/// Recorded right-hand sides: their Taylor series against known ones, what is left out of the list, and formulas that branch.
#include "integrate/taylor/recorded.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "integrate/odeint_driver.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {
namespace {

/// Records formulas of the time, and gives their coefficients at t, by order and formula.
template <class T, class Formulas>
std::vector<std::vector<T>> series_of(const Formulas& formulas, T t, int orders) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  const R time(recording, recording.add({.kind = taylor::Kind::time}, t));
  std::vector<int> places;
  for (const R& result : formulas(time)) places.push_back(result.place_in(recording));
  const std::size_t count = places.size();
  taylor::Program<T> program(recording.finish(std::move(places)));
  const std::vector<T> no_state;
  program.start(no_state, t);
  std::vector<std::vector<T>> rows(static_cast<std::size_t>(orders) + 1, std::vector<T>(count));
  for (int k = 0; k <= orders; ++k) program.extend(k, no_state, rows[static_cast<std::size_t>(k)]);
  return rows;
}

/// The coefficients of (1 + t)^p, and of sin(2 t + 0.1) and its cosine.
template <class T>
T power_coefficient(T p, T t, int k) {
  T c = real::pow(T(1) + t, p);
  for (int j = 1; j <= k; ++j) c *= (p - T(j - 1)) / (T(j) * (T(1) + t));
  return c;
}
template <class T>
T sine_coefficient(T t, int k, int shift) {
  const T angle = T(2) * t + T(1) / T(10);
  const T cycle[4] = {real::sin(angle), real::cos(angle), -real::sin(angle), -real::cos(angle)};
  T c = cycle[(k + shift) % 4];
  for (int j = 1; j <= k; ++j) c *= T(2) / T(j);
  return c;
}

template <class T>
void expect_known_series() {
  using R = real::Recorded<T>;
  const T t = T(3) / T(10), tenth = T(1) / T(10), fifth = T(1) / T(5);
  const int orders = taylor::kMostOrder<T>;
  const auto rows = series_of<T>(
      [&](const R& x) {
        const R one_more = R(T(1)) + x, angle = R(T(2)) * x + R(tenth);
        return std::vector<R>{sin(angle), cos(angle), R(T(1)) / one_more, sqrt(one_more), pow(one_more, R(fifth)),
                              one_more * one_more, (x * x) / one_more};
      },
      t, orders);
  for (int k = 0; k <= orders; ++k) {
    const T quotient = power_coefficient(T(-1), t, k);
    const T known[] = {sine_coefficient(t, k, 0),
                       sine_coefficient(t, k, 1),
                       quotient,
                       power_coefficient(T(1) / T(2), t, k),
                       power_coefficient(fifth, t, k),
                       power_coefficient(T(2), t, k),
                       // t^2 / (1 + t) = t - 1 + 1 / (1 + t)
                       quotient + (k == 0 ? t - T(1) : k == 1 ? T(1) : T(0))};
    for (std::size_t i = 0; i < std::size(known); ++i) {
      // Each order adds the rounding of some k products of coefficients below 2.
      const T slack = T(8 * (k + 4)) * real::epsilon<T>();
      EXPECT_LT(real::abs(rows[static_cast<std::size_t>(k)][i] - known[i]), slack) << "order " << k << ", formula " << i;
    }
  }
}

TEST(Recorded, SeriesOfEveryOperationAreTheKnownOnes) {
  expect_known_series<double>();
  expect_known_series<float128>();
}

TEST(Recorded, FunctionsOfTimeBringTheirCoefficients) {
  using R = real::Recorded<double>;
  // 3 + 5 (t' - t)^2, and (t' - t), times t
  const auto rows = series_of<double>(
      [](const R& x) {
        taylor::GivenFunction<double> f;
        f.components = 2;
        f.expand = [](double, std::span<std::array<double, 3>> at) {
          for (std::size_t k = 0; k < at.size(); ++k) at[k] = {k == 0 ? 3.0 : k == 2 ? 5.0 : 0.0, k == 1 ? 1.0 : 0.0, 0};
        };
        const std::array<int, 3> places = x.recording()->given(f, x.value());
        return std::vector<R>{R(*x.recording(), places[0]) * x, R(*x.recording(), places[1]) * x};
      },
      2.0, 4);
  const double first[] = {6, 3, 10, 5, 0}, second[] = {0, 2, 1, 0, 0};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_DOUBLE_EQ(rows[k][0], first[k]) << k;
    EXPECT_DOUBLE_EQ(rows[k][1], second[k]) << k;
  }
}

TEST(Recorded, WhatIsConstantOrRepeatedIsNotListed) {
  using R = real::Recorded<double>;
  taylor::Recording<double> recording;
  const R x(recording, recording.add({.kind = taylor::Kind::state, .a = 0}, 2.0));
  const R y(recording, recording.add({.kind = taylor::Kind::state, .a = 1}, 3.0));
  const R zero(0.0), one(1.0);
  EXPECT_TRUE((zero * x + R(2.0) * R(3.0)).is_number());
  EXPECT_TRUE((x * y) == (y * x));
  EXPECT_TRUE((one * x + zero) == x);
  EXPECT_TRUE((R(2.0) * x) * y == R(2.0) * (x * y));
  EXPECT_TRUE(R(0.5) * (R(2.0) * x) == x);
  EXPECT_FALSE(x == y);
  EXPECT_EQ((x * y - y).value(), 3.0);
  const R unused = sqrt(x) * y, held = conserved(R(x * x));
  const R rate = x * y + held * y + unused * zero;
  taylor::Program<double> program(recording.finish({rate.place_in(recording)}));
  // x, y, x^2 and what is held of it, two products, their sum: no square root, and one product of two series.
  EXPECT_EQ(program.operations(), 7u);
  EXPECT_EQ(program.products(), 1u);
}

/// x' = 1, y' = |x|: the right-hand side has a corner that no series sees coming.
struct Corner {
  using Shape = Corner;
  static constexpr std::size_t kSize = 2;
  using State = std::array<double, 2>;
  using Series = RecordedSeries<double, 2>;
  static constexpr std::array<ComponentGroup, 1> groups() { return {{{0, 2, 1.0}}}; }
  static Series series() {
    return Series([](const State& x, double) {
      using R = real::Recorded<double>;
      taylor::Recording<double> recording;
      const R position(recording, recording.add({.kind = taylor::Kind::state, .a = 0}, x[0]));
      const R size = real::abs(position);
      return recording.finish({R(1.0).place_in(recording), size.place_in(recording)});
    });
  }
};

TEST(Recorded, AStepDoesNotPassTheCornerOfAFormulaThatBranches) {
  GroupScales<double, Corner> scales;
  taylor::TaylorStepper<double, Corner> stepper(1e-12, scales);
  Corner::Series series = Corner::series();
  stepper.initialize({-1, 0}, 0);
  for (int step = 0; step < 1000 && stepper.current_time() < 2; ++step) {
    stepper.limit_step(2 - stepper.current_time());
    stepper.do_step(series);
  }
  // Half of the way down and half of the way up: 1/2 + 1/2. On the first branch alone it would be 1/2 - 1/2.
  EXPECT_NEAR(stepper.current_state()[0], 1, 1e-12);
  EXPECT_NEAR(stepper.current_state()[1], 1, 1e-12);
}

}  // namespace
}  // namespace earthtop
