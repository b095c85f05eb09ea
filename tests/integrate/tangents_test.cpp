// SPDX-License-Identifier: GPL-3.0-or-later
/// Tangents of recorded right-hand sides, against differences of the right-hand sides themselves in 113 bits.
#include "integrate/taylor/tangents.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "integrate/taylor/program.hpp"
#include "integrate/taylor/recorded.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using T = float128;
using R = real::Recorded<T>;
using Rates = std::array<R, 2>;
/// dx/dt of a state of two numbers, with two parameters.
using Formula = std::function<Rates(const R& x, const R& y, const R& p, const R& q, const R& t)>;

constexpr int kDirections = 3, kOrders = 8;
/// What a direction changes: the two numbers of the state at the beginning, and the two parameters.
constexpr double kChanges[kDirections][4] = {{1, 0, 0, 0}, {0.25, -1, 0, 0.5}, {0, 0, 1, -0.75}};
/// Central differences with a step of 1e-9 are wrong by its square times a third derivative, and in 113 bits by rounding over it.
constexpr double kStep = 1e-9, kDifferences = 1e-14;
constexpr double kRounding = testing::rounding<T>(100);
constexpr double kStart[4] = {0.7, 1.3, 0.4, -0.9};
const T kTime = T(3) / T(10);

taylor::Operations<T> record(const Formula& formula, const std::array<T, 4>& at) {
  taylor::Recording<T> recording;
  const auto state = [&](int i) {
    return R(recording, recording.add({.kind = taylor::Kind::state, .a = i}, at[static_cast<std::size_t>(i)]));
  };
  const auto parameter = [&](std::size_t i) { return R(recording, recording.parameter(at[i])); };
  const R x = state(0), y = state(1), p = parameter(2), q = parameter(3);
  const R time(recording, recording.add({.kind = taylor::Kind::time}, kTime));
  std::vector<int> places;
  for (const R& rate : formula(x, y, p, q, time)) places.push_back(rate.place_in(recording));
  return recording.finish(places);
}

/// The coefficients of the solution, by order, of a state of `size` numbers.
std::vector<T> coefficients(const taylor::Operations<T>& operations, const std::vector<T>& x) {
  taylor::Program<T> program(operations);
  std::vector<T> series((kOrders + 1) * x.size(), T(0));
  std::ranges::copy(x, series.begin());
  program.start(x, kTime);
  program.expand(series.data(), kOrders);
  return series;
}

std::array<T, 4> moved(int direction, T step) {
  std::array<T, 4> at{};
  for (std::size_t i = 0; i < 4; ++i) at[i] = T(kStart[i]) + step * T(kChanges[direction][i]);
  return at;
}

/// Compares the series of the tangents with central differences of the series at starts and parameters that are moved.
void expect_tangents(const Formula& formula) {
  const std::array<T, 4> start = moved(0, T(0));
  std::vector<T> x = {start[0], start[1]}, by_parameter;
  for (const auto& change : kChanges) x.push_back(T(change[0])), x.push_back(T(change[1]));
  for (const int p : {2, 3})
    for (const auto& change : kChanges) by_parameter.push_back(T(change[p]));
  const std::vector<T> series =
      coefficients(taylor::with_tangents<T>(record(formula, start), kDirections, by_parameter, x, kTime), x);
  const std::vector<T> plain = coefficients(record(formula, start), {start[0], start[1]});
  const T step = T(kStep);
  for (int d = 0; d < kDirections; ++d) {
    const std::array<T, 4> up = moved(d, step), down = moved(d, -step);
    const std::vector<T> high = coefficients(record(formula, up), {up[0], up[1]});
    const std::vector<T> low = coefficients(record(formula, down), {down[0], down[1]});
    for (std::size_t k = 0; k <= kOrders; ++k)
      for (std::size_t i = 0; i < 2; ++i) {
        const T difference = (high[2 * k + i] - low[2 * k + i]) / (T(2) * step);
        const T tangent = series[k * x.size() + 2 * (static_cast<std::size_t>(d) + 1) + i];
        EXPECT_NEAR(static_cast<double>(tangent - difference), 0,
                    kDifferences * static_cast<double>(real::abs(difference) + T(1)))
            << "direction " << d << ", order " << k << ", component " << i;
      }
  }
  for (std::size_t k = 0; k <= kOrders; ++k)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(static_cast<double>(series[k * x.size() + i] - plain[2 * k + i]), 0, kRounding)
          << "the state itself, order " << k;
}

TEST(Tangents, OfEachKindOfOperationAgreeWithDifferences) {
  const std::pair<const char*, Formula> kinds[] = {
      {"constant",
       [](const R&, const R&, const R&, const R&, const R&) {
         return Rates{R(T(3)), R(T(-2))};
       }},
      {"parameter",
       [](const R&, const R&, const R& p, const R& q, const R&) {
         return Rates{p, q};
       }},
      {"state",
       [](const R& x, const R& y, const R&, const R&, const R&) {
         return Rates{y, x};
       }},
      {"time",
       [](const R& x, const R&, const R& p, const R&, const R& t) {
         return Rates{t * p, t * x};
       }},
      {"linear",
       [](const R& x, const R& y, const R& p, const R&, const R&) {
         return Rates{R(T(2)) * x - y, R(T(1)) - p - y};
       }},
      {"product", [](const R& x, const R& y, const R& p, const R& q, const R&) { return Rates{x * y, p * q * y * y}; }},
      {"quotient",
       [](const R& x, const R& y, const R& p, const R& q, const R&) { return Rates{x / y, (p * y + q) / (x * x)}; }},
      {"square root", [](const R& x, const R& y, const R& p, const R&, const R&) { return Rates{sqrt(y), sqrt(p + x * y)}; }},
      {"power", [](const R& x, const R& y, const R& p, const R&,
                   const R&) { return Rates{pow(y, R(T(7) / T(3))), pow(p + x, R(T(-1) / T(5)))}; }},
      {"sine", [](const R& x, const R& y, const R& p, const R&, const R&) { return Rates{sin(y), sin(p * x)}; }},
      {"cosine", [](const R& x, const R& y, const R&, const R& q, const R&) {
         return Rates{cos(y), cos(q * x * x)};
       }}};
  for (const auto& [name, formula] : kinds) {
    SCOPED_TRACE(name);
    expect_tangents(formula);
  }
}

// A result that is held has no order but 0, and neither have its tangents. x^2 + y^2 is constant along this motion.
TEST(Tangents, OfAHeldResultAreHeld) {
  using real::conserved;
  const auto circle = [](bool holds) {
    return [holds](const R& x, const R& y, const R& p, const R&, const R&) {
      const R square = R(x * x) + R(y * y), size = holds ? conserved(square) : square;
      return Rates{p * size * y, -(p * size * x)};
    };
  };
  expect_tangents(circle(false));
  expect_tangents(circle(true));
  // Where rounding has left the exact motion, what is held is not quite constant, and its tangents are held all the same: here it is
  // not constant at all.
  expect_tangents([](const R& x, const R& y, const R& p, const R&, const R&) {
    const R size = conserved(R(x * y));
    return Rates{p * size * y, size * x};
  });
}

TEST(Tangents, OfAGivenFunctionAreZeroAndOfABranchThatOfTheBranch) {
  taylor::GivenFunction<T> swing;
  swing.components = 2;
  swing.expand = [](T t, std::span<std::array<T, 3>> rows) {
    for (auto& row : rows) row = {T(0), T(0), T(0)};
    rows[0] = {T(1) + t, T(2) * t, T(0)};
    if (rows.size() > 1) rows[1] = {T(1), T(2), T(0)};
  };
  expect_tangents([&](const R& x, const R& y, const R& p, const R&, const R& t) {
    const std::array<int, 3> places = t.recording()->given(swing, t.value());
    const R first(*t.recording(), places[0]), second(*t.recording(), places[1]);
    return Rates{second * x, x < y ? first * y * p : x};
  });
}

TEST(Tangents, KeepTheGuardsOfTheList) {
  const Formula formula = [](const R& x, const R& y, const R&, const R&, const R&) { return Rates{x < y ? y : x, x}; };
  const std::vector<T> x = {T(1), T(2), T(1), T(0)};
  const taylor::Operations<T> operations =
      taylor::with_tangents<T>(record(formula, {T(1), T(2), T(0), T(0)}), 1, std::vector<T>{T(0), T(0)}, x, kTime);
  taylor::Program<T> program(operations);
  program.start(x, kTime);
  EXPECT_TRUE(program.guards_hold());
  program.start(std::vector<T>{T(2), T(1), T(1), T(0)}, kTime);
  EXPECT_FALSE(program.guards_hold());
}

// A friction along the rate, of which only the product with the root of its square is smooth: at rest the root has no tangent, and the
// product's is zero. Away from rest the list does not hold.
TEST(Tangents, OfAProductWithARootAtRestAreThoseWithoutTheRoot) {
  const Formula square_root = [](const R& x, const R&, const R& p, const R&, const R&) {
    return Rates{R(p - sqrt(R(x * x)) * x), x};
  };
  const Formula power = [](const R& x, const R&, const R& p, const R&, const R&) {
    return Rates{R(p - pow(R(x * x), R(T(3) / T(4))) * x), x};
  };
  for (const Formula& formula : {square_root, power}) {
    // One direction changes x by 2, y by 3 and p by 5.
    const std::vector<T> x = {T(0), T(1), T(2), T(3)}, by_parameter = {T(5), T(0)};
    const taylor::Operations<T> plain = record(formula, {T(0), T(1), T(7), T(0)});
    taylor::Program<T> program(taylor::with_tangents<T>(plain, 1, by_parameter, x, kTime));
    std::vector<T> series(2 * x.size(), T(0));
    std::ranges::copy(x, series.begin());
    program.start(x, kTime);
    program.expand(series.data(), 1);
    EXPECT_EQ(std::vector<T>(series.begin() + 4, series.end()), (std::vector<T>{T(7), T(0), T(5), T(2)}));
    EXPECT_TRUE(program.guards_hold());
    EXPECT_FALSE(taylor::Program<T>(plain).has_guards());
    program.start(std::vector<T>{T(1), T(1), T(2), T(3)}, kTime);
    EXPECT_FALSE(program.guards_hold());
  }
}

TEST(Tangents, BeyondThoseThatAreFollowedStayAsTheyAre) {
  const Formula formula = [](const R& x, const R& y, const R& p, const R&, const R&) { return Rates{x * y, p * x}; };
  const std::array<T, 4> start = moved(0, T(0));
  const std::vector<T> x = {start[0], start[1], T(1), T(2), T(3), T(4)}, by_parameter(4, T(1));
  const std::vector<T> series = coefficients(taylor::with_tangents<T>(record(formula, start), 1, by_parameter, x, kTime), x);
  EXPECT_NE(series[x.size() + 2], T(0));
  for (std::size_t k = 1; k <= kOrders; ++k)
    for (const std::size_t i : {4U, 5U}) EXPECT_EQ(series[k * x.size() + i], T(0)) << "order " << k;
}

// Each product of the motion brings two for each direction, and nothing else.
TEST(Tangents, GrowByTwoProductsADirection) {
  const Formula formula = [](const R& x, const R& y, const R&, const R&, const R&) { return Rates{x * y, (x * y) * x}; };
  const taylor::Operations<T> plain = record(formula, moved(0, T(0)));
  for (const std::size_t directions : {1U, 2U, 5U}) {
    const std::vector<T> x((directions + 1) * 2, T(1)), none(2 * directions, T(0));
    std::vector<T> at = x;
    at[0] = T(kStart[0]), at[1] = T(kStart[1]);
    const taylor::Program<T> program(taylor::with_tangents<T>(plain, directions, none, at, kTime));
    EXPECT_EQ(program.products(), taylor::Program<T>(plain).products() * (1 + 2 * directions));
  }
}

}  // namespace
}  // namespace earthtop
