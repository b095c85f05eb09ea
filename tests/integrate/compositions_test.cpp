// SPDX-License-Identifier: GPL-3.0-or-later
/// The order conditions of the composition methods, and the orders that their errors show.
#include "integrate/compositions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "integrate/splitting_stepper.hpp"

namespace earthtop {
namespace {

/// Sum over the kicks of b c^k - 1/(k+1): the error of the quadrature of t^k in the flow of A.
double quadrature_defect(const CompositionTable& table, int k) {
  long double c = 0, sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.stages); ++i) {
    c += table.a[i];
    sum += table.b[i] * std::pow(c, k);
  }
  return static_cast<double>(sum - 1.0L / (k + 1));
}

/// The condition of order eps^2: over pairs of kicks, sum over i < j of b_i b_j (c_j - c_i), minus the double integral 1/6.
double pair_defect(const CompositionTable& table) {
  std::vector<long double> c;
  long double at = 0;
  for (int i = 0; i < table.stages; ++i) c.push_back(at += table.a[static_cast<std::size_t>(i)]);
  long double sum = 0;
  for (std::size_t j = 0; j < c.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) sum += table.b[i] * table.b[j] * (c[j] - c[i]);
  return static_cast<double>(sum - 1.0L / 6);
}

/// The power of h by which the error falls if B is small.
int order_for_small_kicks(Composition name) {
  switch (name) {
    case Composition::aba1064: return 10;
    case Composition::rkn6: return 6;
    default: return 8;
  }
}

TEST(Compositions, CoefficientsMeetTheirConditions) {
  for (const CompositionTable& table : kCompositionTables) {
    SCOPED_TRACE(to_string(table.name));
    const auto stages = static_cast<std::size_t>(table.stages);
    long double a = 0, b = 0;
    for (std::size_t i = 0; i <= stages; ++i) {
      a += table.a[i];
      EXPECT_EQ(table.a[i], table.a[stages - i]);
    }
    for (std::size_t i = 0; i < stages; ++i) {
      b += table.b[i];
      EXPECT_EQ(table.b[i], table.b[stages - 1 - i]);
    }
    // A coefficient is rounded to 1e-16 of it; those of rkn6 are published with 15 digits.
    const double slack = table.name == Composition::rkn6 ? 2e-14 : 1e-15;
    EXPECT_NEAR(static_cast<double>(a), 1, slack);
    EXPECT_NEAR(static_cast<double>(b), 1, slack);
    const int order = order_for_small_kicks(table.name);
    for (int k = 1; k < order; ++k) EXPECT_NEAR(quadrature_defect(table, k), 0, slack) << k;
    EXPECT_GT(std::abs(quadrature_defect(table, order)), 1e-9);
    if (table.order >= 4) {
      EXPECT_NEAR(pair_defect(table), 0, slack);
    } else {
      EXPECT_GT(std::abs(pair_defect(table)), 1e-4);
    }
  }
}

/// H = (p^2 + q^2) / 2 + eps q^4 / 4: A turns the (q, p) plane, B kicks p by -eps q^3 h.
struct Duffing {
  using State = std::array<double, 2>;
  using Kick = int;
  struct End {};
  double eps;
  Kick kick_at(double) const { return 0; }
  End end_of(double) const { return {}; }
  void free(double h, CompensatedState<State>& s) const {
    // cos h - 1 = -2 sin^2(h/2), so that the increments are small and the compensated sums gain their digits.
    const double q = s.x[0], p = s.x[1], sine = std::sin(h), less = -2 * std::sin(h / 2) * std::sin(h / 2);
    s.add(0, less * q + sine * p);
    s.add(1, less * p - sine * q);
  }
  void kick(double h, double, Kick, CompensatedState<State>& s) const { s.add(1, -eps * h * s.x[0] * s.x[0] * s.x[0]); }
  void end(End, CompensatedState<State>&) const {}
};

Duffing::State after_twelve(const CompositionTable& table, double eps, int steps) {
  SplittingStepper stepper(Duffing{eps}, table);
  Duffing::State x{1, 0.3};
  for (int k = 0; k < steps; ++k) stepper.do_step(0, x, 12.0 * k / steps, 12.0 / steps);
  return x;
}

double error_after_twelve(const CompositionTable& table, double eps, int steps) {
  const auto exact = after_twelve(composition_table(Composition::kahan_li8), eps, 1200);
  const auto x = after_twelve(table, eps, steps);
  return std::hypot(x[0] - exact[0], x[1] - exact[1]);
}

/// Each halving of the step must reduce the error by 2^order, down to round-off. A single wrong coefficient fails.
void expect_order(const CompositionTable& table, double eps, int order) {
  constexpr double round_off = 3e-14;
  int seen = 0;
  double before = 0;
  for (int steps = 12; steps <= 384; steps *= 2) {
    const double error = error_after_twelve(table, eps, steps);
    if (before > 100 * round_off && before < (order < 4 ? 1e-2 : 1e-5)) {  // short enough for the leading term
      EXPECT_LT(error, 1.7 * before / std::pow(2.0, order) + round_off) << "eps " << eps << ", " << steps << " steps";
      ++seen;
    }
    before = error;
  }
  EXPECT_GE(seen, 1);
}

TEST(Compositions, OrderSeenByHalvingTheStep) {
  for (const CompositionTable& table : kCompositionTables) {
    SCOPED_TRACE(to_string(table.name));
    expect_order(table, 0.3, table.order);
  }
}

TEST(Compositions, OfSmallKicksTheErrorIsProportionalToThemAndOfTheHigherOrder) {
  for (const CompositionTable& table : kCompositionTables) {
    SCOPED_TRACE(to_string(table.name));
    // The steps are long enough, and the kicks small enough, for eps h^p to outweigh eps^2 h^q.
    const double coarse = error_after_twelve(table, 1e-7, 8), fine = error_after_twelve(table, 1e-7, 16);
    EXPECT_GT(coarse, 3e-13);
    EXPECT_LT(fine, 1.7 * coarse / std::pow(2.0, order_for_small_kicks(table.name)) + 3e-15);
    EXPECT_NEAR(error_after_twelve(table, 1e-6, 8) / coarse, 10, 0.2);
  }
}

}  // namespace
}  // namespace earthtop
