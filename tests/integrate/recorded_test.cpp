// SPDX-License-Identifier: GPL-3.0-or-later
/// Recorded right-hand sides: their Taylor series against known ones, what is left out of the list, and formulas that branch.
#include "integrate/taylor/recorded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "integrate/odeint_driver.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {
namespace {

/// Records formulas of the time, and gives their coefficients at t, by order and formula.
/// @param width  of the vectors; 0: as the processor has them
template <class T, class Formulas>
std::vector<std::vector<T>> series_of(const Formulas& formulas, T t, int orders, int width = 0) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  const R time(recording, recording.add({.kind = taylor::Kind::time}, t));
  std::vector<int> places;
  for (const R& result : formulas(time)) places.push_back(result.place_in(recording));
  const std::size_t count = places.size();
  taylor::Program<T> program(recording.finish(places), width > 0 ? width : taylor::width_of_processor());
  // The formulas are the derivatives of a state, whose coefficients are found.
  std::vector<T> x((static_cast<std::size_t>(orders) + 2) * count, T(0));
  // A second step must not be disturbed by what the first has left.
  for (const T at : {t + T(1), t}) {
    program.start(std::span(x).first(count), at);
    program.expand(x.data(), orders + 1);
  }
  std::vector<std::vector<T>> rows(static_cast<std::size_t>(orders) + 1, std::vector<T>(count));
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t i = 0; i < count; ++i) rows[k][i] = x[(k + 1) * count + i] * static_cast<T>(k + 1);
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
        return std::vector<R>{
            sin(angle),          cos(angle),        R(T(1)) / one_more, sqrt(one_more), pow(one_more, R(fifth)),
            one_more * one_more, (x * x) / one_more};
      },
      t, orders);
  for (int k = 0; k <= orders; ++k) {
    const T quotient = power_coefficient(T(-1), t, k);
    const T known[] = {sine_coefficient(t, k, 0), sine_coefficient(t, k, 1), quotient, power_coefficient(T(1) / T(2), t, k),
                       power_coefficient(fifth, t, k), power_coefficient(T(2), t, k),
                       // t^2 / (1 + t) = t - 1 + 1 / (1 + t)
                       quotient + (k == 0   ? t - T(1)
                                   : k == 1 ? T(1)
                                            : T(0))};
    for (std::size_t i = 0; i < std::size(known); ++i) {
      // Each order adds the rounding of some k products of coefficients below 2.
      const T slack = T(8 * (k + 4)) * real::epsilon<T>();
      EXPECT_LT(real::abs(rows[static_cast<std::size_t>(k)][i] - known[i]), slack) << "order " << k << ", formula " << i;
    }
  }
}

TEST(Recorded, SeriesOfEveryOperationAreTheKnownOnes) {
  expect_known_series<double>();
  expect_known_series<float80>();
  expect_known_series<float128>();
}

/// A coefficient of the state's series is one of its rate's, divided by the order: the rounding of an inverse would be the same at
/// every step and add up to a phase error. The solution of x' = x shows it, since its rate has no rounding of its own.
template <class T>
void expect_quotients() {
  const int orders = taylor::kMostOrder<T>;
  for (const T at : {T(1), T(3) / T(7), T(-11) / T(13)}) {
    taylor::Recording<T> recording;
    const int state = recording.add({.kind = taylor::Kind::state, .a = 0}, at);
    taylor::Program<T> program(recording.finish({state}));
    std::vector<T> x(static_cast<std::size_t>(orders) + 1, at);
    program.start(std::span(x).first(1), T(0));
    program.expand(x.data(), orders);
    for (std::size_t k = 1; k < x.size(); ++k) EXPECT_TRUE(x[k] == x[k - 1] / static_cast<T>(k)) << "order " << k;
  }
}

TEST(Recorded, CoefficientsAreRatesDividedByTheirOrders) {
  expect_quotients<double>();
  expect_quotients<float80>();
  expect_quotients<float128>();
}

/// A power series with the plainest arithmetic.
template <class T>
struct PlainSeries {
  static constexpr std::size_t kOrders = 12;
  std::array<T, kOrders> c{};
  PlainSeries(T number = T(0)) : c{number} {}  // NOLINT(google-explicit-constructor): numbers in formulas are constants

  friend PlainSeries operator+(const PlainSeries& a, const PlainSeries& b) {
    PlainSeries r;
    for (std::size_t k = 0; k < kOrders; ++k) r.c[k] = a.c[k] + b.c[k];
    return r;
  }
  friend PlainSeries operator-(const PlainSeries& a, const PlainSeries& b) { return a + PlainSeries(T(-1)) * b; }
  friend PlainSeries operator*(const PlainSeries& a, const PlainSeries& b) {
    PlainSeries r;
    for (std::size_t k = 0; k < kOrders; ++k)
      for (std::size_t j = 0; j <= k; ++j) r.c[k] += a.c[j] * b.c[k - j];
    return r;
  }
  friend PlainSeries operator/(const PlainSeries& a, const PlainSeries& b) {
    PlainSeries r;
    for (std::size_t k = 0; k < kOrders; ++k) {
      r.c[k] = a.c[k];
      for (std::size_t j = 0; j < k; ++j) r.c[k] = r.c[k] - r.c[j] * b.c[k - j];
      r.c[k] = r.c[k] / b.c[0];
    }
    return r;
  }
  friend PlainSeries conserved(const PlainSeries& a) { return a.c[0]; }
};

/// Formulas that a program puts together in many ways: sums of 1 to 11 terms, sums that are used once and twice, factors that
/// are held, numbers times held factors, divisions by what is held, results without any order but 0.
template <class S, class T>
std::vector<S> formulas_of_all_kinds(const S& x) {
  const auto n = [](double number) { return S(static_cast<T>(number)); };
  const S h = conserved(S(x * x + n(2))), g = conserved(S(x + n(1)));
  const S a = x * x - n(3) * x, b = n(1) + x * a, used_twice = a + n(2) * b;
  std::vector<S> f = {a * b,
                      h,
                      n(5),
                      h * (a * b - n(2) * b) * g + n(4) * h * g,
                      (a * b + b) / h + a / n(3),
                      (h + x) / (n(1) + x * x),
                      used_twice * used_twice - n(0.5) * used_twice * b,
                      (n(2) * x + a) - (x + n(0.5) * a),
                      n(7) * x + n(1),
                      g * (n(2) + h * (x * b + g)),
                      h * g - x};
  S sum = n(0);
  for (int i = 1; i <= 11; ++i) {
    sum = sum + n(1.0 / i) * ((x + n(i)) * (a - n(2 * i)));
    f.push_back(sum);
  }
  return f;
}

template <class T>
void expect_plain_series(std::size_t formulas, int width) {
  const T t = T(3) / T(10);
  PlainSeries<T> time(t);
  time.c[1] = T(1);
  const std::vector<PlainSeries<T>> plain = formulas_of_all_kinds<PlainSeries<T>, T>(time);
  using R = real::Recorded<T>;
  const int orders = static_cast<int>(PlainSeries<T>::kOrders) - 1;
  const auto some = [&](const R& x) {
    std::vector<R> all = formulas_of_all_kinds<R, T>(x);
    all.resize(formulas);
    return all;
  };
  const auto rows = series_of<T>(some, t, orders, width);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t i = 0; i < formulas; ++i) {
      T scale = T(1);
      for (const T c : plain[i].c) scale = std::max(scale, real::abs(c));
      // Some 100 operations, each with a rounding of at most a few times the largest coefficient.
      EXPECT_LT(real::abs(rows[k][i] - plain[i].c[k]), T(400) * real::epsilon<T>() * scale)
          << "order " << k << ", formula " << i << " of " << formulas << ", width " << width;
    }
  if (width != 2) {
    EXPECT_EQ(rows, series_of<T>(some, t, orders, 2)) << "width " << width;
  }
}

TEST(Recorded, SumsAndProductsAreThoseOfPlainSeriesForEveryNumberOfThemAndEveryWidth) {
  const std::size_t count = formulas_of_all_kinds<PlainSeries<double>, double>({}).size();
  for (std::size_t formulas = 1; formulas <= count; ++formulas) {
    for (int width = 2; width <= taylor::width_of_processor(); width *= 2) expect_plain_series<double>(formulas, width);
    expect_plain_series<float80>(formulas, 2);
    expect_plain_series<float128>(formulas, 2);
  }
}

TEST(Recorded, SeriesAreTheSameForEveryWidth) {
  using R = real::Recorded<double>;
  const auto formulas = [](const R& x) {
    const R y = R(1.0) + x * x;
    return std::vector<R>{sin(x * y), cos(y), sqrt(y), pow(y, R(0.2)), x / y, sin(x) * sqrt(y) - pow(x, R(1.5)) / y};
  };
  const auto pairs = series_of<double>(formulas, 0.3, taylor::kMostOrder<double>, 2);
  for (int width = 4; width <= taylor::width_of_processor(); width *= 2)
    EXPECT_EQ(series_of<double>(formulas, 0.3, taylor::kMostOrder<double>, width), pairs) << width;
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
  taylor::Program<double> program(recording.finish({rate.place_in(recording), y.place_in(recording)}));
  // 1, x, y, x^2 and what is held of it, a product, the sum of it and of the held multiple of y: no square root, and one
  // product of two series.
  EXPECT_EQ(program.operations(), 7u);
  EXPECT_EQ(program.products(), 1u);
}

TEST(Recorded, NeitherTheOrderOfRecordingNorOfFactorsChangesTheDigits) {
  using R = real::Recorded<double>;
  const auto series = [](bool swap) {
    return series_of<double>(
        [&](const R& t) {
          // A compiler may compute the arguments of a sum from the right or from the left.
          R u, v;
          const auto make_u = [&] { u = sin(R(0.7) * t) / (R(1.0) + t * t); };
          const auto make_v = [&] { v = sqrt(R(3.0) + t) - cos(t); };
          swap ? (make_v(), make_u()) : (make_u(), make_v());
          const R product = swap ? v * u : u * v;
          return std::vector<R>{product, R(2.0) * (u * v) + t};
        },
        0.3, 20);
  };
  EXPECT_EQ(series(false), series(true));
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
