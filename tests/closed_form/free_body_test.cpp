// SPDX-License-Identifier: GPL-3.0-or-later
/// The free body's closed form: in double compared with 113 bits in every regime; in 113 bits compared with an independent
/// integration, and with the closed forms of its special cases.

#include "earthtop/closed_form/free_body.hpp"

#include <gtest/gtest.h>

#include "closed_form/free_body_cases.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "support/extended_integration.hpp"
#include "support/free_motion.hpp"
#include "support/tolerances.hpp"

namespace earthtop::test {
namespace {

using Wide = float128;

Vec3<Wide> wide_vector(double x, double y, double z) { return {Wide(x), Wide(y), Wide(z)}; }
const Quaternion<Wide> kStart{Wide(0.5), {Wide(0.1), Wide(-0.7), Wide(0.3)}};

double apart(const Vec3<Wide>& a, const Vec3<Wide>& b) { return static_cast<double>(norm<Wide>(a - b)); }

class FreeBodyRegimes : public ::testing::TestWithParam<FreeBodyGenerator> {};

// The error in double stays below 1e-13 + 4 eps phase + 4 eps kappa; the stated error is above it, but not needlessly large.
TEST_P(FreeBodyRegimes, DoubleKeepsItsPromises) {
  std::mt19937_64 engine(1);
  double largest_error = 0;
  for (int k = 0; k < 1500; ++k) {
    const FreeBodyCase c = GetParam().draw(engine);
    const Measure m = measure(c);
    ASSERT_LE(used_part(m), 1) << to_string(c);
    ASSERT_LE(m.error, m.statement) << to_string(c);
    ASSERT_LE(m.rate_error, m.rate_statement) << to_string(c);
    // A single error can vanish by chance, so the stated error is also allowed to exceed half an eps and the phase's share of
    // it. For a tensor with products of inertia, the stated error covers the worst case of its rounding, and is not tested.
    if (GetParam().name != "any axes") {
      ASSERT_LE(m.statement, 1000 * std::max(m.error, real::epsilon<double>() / 2 * (1 + m.phase / 1000))) << to_string(c);
    }
    largest_error = std::max(largest_error, m.error / m.statement);
  }
  EXPECT_GT(largest_error, GetParam().name == "at rest" ? 0.02 : 0.05);
}

TEST_P(FreeBodyRegimes, LongDoubleKeepsItsStatement) {
  std::mt19937_64 engine(2);
  for (int k = 0; k < 50; ++k) {
    const FreeBodyCase c = GetParam().draw(engine);
    const auto state = free_body<float80>(c).at(c.t_s);
    const auto exact = free_body<Wide>(c).at(c.t_s);
    ASSERT_LE(angle_between(wide(state.q_NB), exact.q_NB), state.attitude_error) << to_string(c);
    ASSERT_LE(apart(wide(state.w_NB_B), exact.w_NB_B), state.rate_error) << to_string(c);
  }
}

// There is no wider scalar type to check 113 bits by. Instead, the motion is started anew on its way and must arrive where the
// uninterrupted one does, within the stated errors of all three and the rounding of the second start; near the separatrix that
// rounding is magnified.
TEST_P(FreeBodyRegimes, Float128ContinuesItself) {
  std::mt19937_64 engine(3);
  for (int k = 0; k < 50; ++k) {
    const FreeBodyCase c = GetParam().draw(engine);
    const Vec3<Wide> moments = wide(c.moments), products = wide(c.products);
    const auto body = free_body<Wide>(c);
    const Wide half_t = Wide(c.t_s) / 2;
    const auto half = body.at(half_t), whole = body.at(Wide(c.t_s));
    const auto again = free_body<Wide>(moments, products, half.q_NB, half.w_NB_B).at(half_t);
    // Moving the second start's rates by their stated error shows how much the motion magnifies it.
    double growth = 0;
    for (int i = 0; i < 3; ++i) {
      Vec3<Wide> w = half.w_NB_B;
      w[i] += half.rate_error;
      growth += angle_between(free_body<Wide>(moments, products, half.q_NB, w).at(half_t).q_NB, again.q_NB);
    }
    ASSERT_LE(angle_between(whole.q_NB, again.q_NB),
              static_cast<double>(whole.attitude_error + half.attitude_error + again.attitude_error) + growth)
        << to_string(c);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FreeBodyRegimes, ::testing::ValuesIn(free_body_generators()), [](const auto& instance) {
  std::string name = instance.param.name;
  std::erase(name, ' ');
  return name;
});

struct Scene {
  const char* name;
  FreeBodyRegime regime;
  double I[3], w[3], t_s;
};

// Compares with an integration of Euler's equations in 113 bits, whose own error is about 1e-27, as a change of its step shows.
TEST(FreeBody, IsWhatIntegrationGives) {
  using enum FreeBodyRegime;
  const Scene scenes[] = {{"rest", at_rest, {1, 2, 3}, {0, 0, 0}, 3},
                          {"sphere", spherical, {2, 2, 2}, {1, 0.3, -1}, 5},
                          {"largest axis", principal_axis, {1, 2, 3}, {0, 0, -2}, 5},
                          {"middle axis", principal_axis, {1, 2, 3}, {0, 1.5, 0}, -5},
                          {"oblate", symmetric, {1, 1, 3}, {1, 0.3, 1}, 5},
                          {"prolate", symmetric, {3, 1, 3}, {1, 0.3, -1}, 5},
                          {"axis 1", symmetric, {3, 1, 1}, {1, 0.3, -1}, -5},
                          {"equator", symmetric, {1, 1, 3}, {1, 0.3, 0}, 5},
                          {"largest", around_largest, {10, 20, 26}, {0.2, 0.5, -1}, 10},
                          {"smallest", around_smallest, {1, 2, 3}, {1.3, 0.2, 0.1}, 7},
                          {"reordered", around_smallest, {3, 1, 2}, {0.1, -1.3, -0.2}, -7},
                          {"separatrix", separatrix, {2, 5, 6}, {1, 0.3, 1}, 5},
                          {"other branch", separatrix, {2, 5, 6}, {-1, 0.3, 1}, -5},
                          {"near separatrix", around_largest, {2, 5, 6}, {1, 0.3, 1 + 1e-6}, 15},
                          {"inside", around_smallest, {2, 5, 6}, {1, 0.3, 1 - 1e-6}, 15},
                          {"unstable axis", around_largest, {1, 2, 3}, {1e-9, 1, 1e-9}, 30},
                          {"stable axis", around_largest, {1, 2, 3}, {1e-9, 1e-10, 1}, 10},
                          {"nearly symmetric", around_largest, {1, 1 + 1e-12, 3}, {1, 0.3, 1}, 10},
                          {"nearly spherical", around_smallest, {1, 1 + 1e-12, 1 + 3e-12}, {1, 0.3, 0.1}, 10},
                          {"needle", around_smallest, {1, 1 + 1e-10, 1e-9}, {1, 0.3, 2}, 5},
                          {"needle's axis", around_smallest, {1, 1.0625, 1e-3}, {0.01, 0.3, 20}, 2},
                          {"flat", around_largest, {1, 2, 3}, {0.5, 0.5, 1}, 8}};
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    const Vec3<Wide> I = wide_vector(scene.I[0], scene.I[1], scene.I[2]), w = wide_vector(scene.w[0], scene.w[1], scene.w[2]);
    const FreeBody<Wide> body(I, kStart, w);
    EXPECT_EQ(body.regime(), scene.regime);
    const auto exact = body.at(Wide(scene.t_s));
    const int steps = static_cast<int>(4 * std::abs(scene.t_s) * static_cast<double>(norm(w))) + 1;
    const auto truth = testing::integrated_free_body<Wide>(I, kStart, w, Wide(scene.t_s), steps);
    EXPECT_LT(angle_between(exact.q_NB, truth.q_NB), 1e-25);
    EXPECT_LT(apart(exact.w_NB_B, truth.w_NB_B), 1e-25);
  }
}

// The result in one regime must be the limit of the results in its neighbours.
TEST(FreeBody, ContinuousAcrossRegimes) {
  const Wide t = 7, tiny = 1e-30;  // a change of the moments by 1e-30 moves the result by 1e-28 at most
  const auto expect_neighbours = [&](const Vec3<Wide>& I, const Vec3<Wide>& w, FreeBodyRegime regime) {
    const FreeBody<Wide> body(I, kStart, w);
    EXPECT_EQ(body.regime(), regime);
    const auto exact = body.at(t);
    for (int i = 0; i < 3; ++i)
      for (const int sign : {-1, 1}) {
        Vec3<Wide> moved = I;
        moved[i] += sign * tiny;
        EXPECT_LT(angle_between(FreeBody<Wide>(moved, kStart, w).at(t).q_NB, exact.q_NB), 1e-27);
        moved = w;
        moved[i] += sign * tiny;
        EXPECT_LT(angle_between(FreeBody<Wide>(I, kStart, moved).at(t).q_NB, exact.q_NB), 1e-27);
      }
  };
  expect_neighbours(wide_vector(1, 1, 3), wide_vector(1, 0.3, 1), FreeBodyRegime::symmetric);
  expect_neighbours(wide_vector(1, 3, 3), wide_vector(1, 0.3, 1), FreeBodyRegime::symmetric);
  expect_neighbours(wide_vector(1, 1, 3), wide_vector(1, 0.3, 0), FreeBodyRegime::symmetric);
  expect_neighbours(wide_vector(2, 2, 2), wide_vector(1, 0.3, 1), FreeBodyRegime::spherical);
  expect_neighbours(wide_vector(2, 5, 6), wide_vector(1, 0.3, 1), FreeBodyRegime::separatrix);
  expect_neighbours(wide_vector(1, 2, 3), wide_vector(0, 0, 1), FreeBodyRegime::principal_axis);
  expect_neighbours(wide_vector(1, 2, 3), wide_vector(1, 0, 0), FreeBodyRegime::principal_axis);
  expect_neighbours(wide_vector(1, 2, 3), wide_vector(0, 1, 0), FreeBodyRegime::principal_axis);
}

// In exact arithmetic, rotation about the middle axis lasts for ever; the closed form is exact.
TEST(FreeBody, UnstableAxisStays) {
  const FreeBody<double> body(Vec3<double>(1, 2, 3), Quaternion<double>{}, Vec3<double>(0, 1, 0));
  const auto state = body.at(1e6);
  EXPECT_EQ(state.w_NB_B, Vec3<double>(0, 1, 0));
  EXPECT_NEAR(std::abs(state.q_NB.w), std::abs(std::cos(5e5)), state.attitude_error);
  EXPECT_EQ(state.q_NB.v[0], 0);
  EXPECT_EQ(state.q_NB.v[2], 0);
}

TEST(FreeBody, WhatIsNoBodyGivesNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, -1.0})
    for (int i = 0; i < 3; ++i) {
      Vec3<double> I(1, 2, 3), w(1, 2, 0.5);
      I[i] = bad;
      EXPECT_FALSE(std::isfinite(FreeBody<double>(I, Quaternion<double>{}, w).at(1).q_NB.w)) << bad << " " << i;
      if (bad == -1) continue;
      w[i] = bad;
      EXPECT_FALSE(std::isfinite(FreeBody<double>(Vec3<double>(1, 2, 3), Quaternion<double>{}, w).at(1).q_NB.w)) << bad;
    }
  EXPECT_FALSE(
      std::isfinite(FreeBody<double>(Vec3<double>(1, 2, 3), Quaternion<double>{}, Vec3<double>(1, 1, 1)).at(nan).q_NB.w));
}

// Rates of any size, including the smallest and the largest numbers.
TEST(FreeBody, EveryScaleOfRates) {
  const Vec3<double> I(1, 2, 3), w(0.5, 1, -0.25);
  const Quaternion<double> q0{0.5, Vec3<double>(0.5, 0.5, -0.5)};
  const auto expected = FreeBody<double>(I, q0, w).at(3);
  for (const int exponent : {-1020, -600, 600, 1020}) {
    const double scale = std::ldexp(1.0, exponent);
    const auto scaled = FreeBody<double>(I, q0, Vec3<double>(scale * w)).at(3 / scale);
    EXPECT_LT((scaled.q_NB.v - expected.q_NB.v).norm(), 4 * real::epsilon<double>());
    EXPECT_LT((scaled.w_NB_B / scale - expected.w_NB_B).norm(), 8 * real::epsilon<double>());
    const auto heavy = FreeBody<double>(Vec3<double>(std::ldexp(1.0, exponent) * I), q0, w).at(3);
    EXPECT_LT((heavy.q_NB.v - expected.q_NB.v).norm(), 4 * real::epsilon<double>());
  }
}

// H10: with initial rates of relative size e about the other two axes, the body flips after about ln(1/e)/s.
TEST(FreeBody, DzhanibekovFlips) {
  for (const auto& [seed, flip_s] : {std::pair{1e-16, 66.8}, {1e-12, 50.8}, {1e-8, 34.9}, {1e-4, 18.9}}) {
    const FreeBody<double> body(Vec3<double>(1, 2, 3), Quaternion<double>{}, Vec3<double>(seed, 1, seed));
    EXPECT_GT(body.at(flip_s - 0.15).w_NB_B[1], 0);
    EXPECT_LT(body.at(flip_s + 0.15).w_NB_B[1], 0);
  }
}

TEST(FreeBody, SeparatrixInElementaryFunctions) {
  const Vec3<Wide> I = wide_vector(2, 5, 6);
  const auto at_0 = separatrix_free_body<Wide>(I, Wide(1.25), Wide(0));
  for (const double t : {-30.0, -2.0, 0.3, 5.0, 30.0}) {
    const auto elementary = separatrix_free_body<Wide>(I, Wide(1.25), Wide(t));
    // The initial rate is irrational, so the elliptic solution starts within 1e-34 of the separatrix and leaves it as exp(p t).
    const auto elliptic = FreeBody<Wide>(I, at_0.q_NB, at_0.w_NB_B).at(Wide(t));
    const double growth = std::exp(1.25 * std::sqrt(0.25) * std::abs(t));
    EXPECT_LT(angle_between(elementary.q_NB, elliptic.q_NB), testing::rounding<Wide>(2) * (30 + growth)) << t;
    EXPECT_LT(apart(elementary.w_NB_B, elliptic.w_NB_B), 1e-33 * (30 + growth)) << t;
  }
}

TEST(FreeBody, TensorInAnyAxes) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    const Quaternion<Wide> q_BP =
        Quaternion<Wide>{Wide(normal(engine)), wide_vector(normal(engine), normal(engine), normal(engine))}.normalized();
    const Mat3<Wide> R_BP = rotation_matrix(q_BP);
    const Vec3<Wide> I = wide_vector(1, k % 3 ? 2 : 1, 2.5), w = wide_vector(normal(engine), normal(engine), normal(engine));
    const Mat3<Wide> tensor = turned_tensor<Wide>(R_BP, Mat3<Wide>(I.asDiagonal()));
    const FreeBody<Wide> turned(tensor, kStart * q_BP.conjugate(), Vec3<Wide>(R_BP * w));
    const auto straight = FreeBody<Wide>(I, kStart, w).at(Wide(5)), other = turned.at(Wide(5));
    ASSERT_LT(angle_between(other.q_NB * q_BP, straight.q_NB), testing::rounding<Wide>(2e4));
    ASSERT_LT(apart(other.w_NB_B, R_BP * straight.w_NB_B), testing::rounding<Wide>(2e4));
  }
  const Mat3<double> diagonal = Vec3<double>(1, 2, 3).asDiagonal();
  const auto given = FreeBody<double>(Vec3<double>(1, 2, 3), Quaternion<double>{}, Vec3<double>(1, 2, -1)).at(4);
  EXPECT_EQ(FreeBody<double>(diagonal, Quaternion<double>{}, Vec3<double>(1, 2, -1)).at(4).w_NB_B, given.w_NB_B);
}

// T9: the tumbling brick of NASA/NESC after 30 s: inertial rates, and the attitude relative to the North, East, Down axes of t
// = 0, which turn with the Earth about their x axis.
TEST(FreeBody, TumblingBrickOfNasa) {
  const Wide degree = real::pi<Wide>() / 180;
  const Vec3<Wide> I(1894220, 6211019, 7194665), W_N(Wide(729211302386770) / Wide(1e19), Wide(0), Wide(0));
  const auto state = FreeBody<Wide>(I, Quaternion<Wide>{}, Vec3<Wide>(10 * degree, 20 * degree, 30 * degree)).at(Wide(30));
  EXPECT_NEAR(static_cast<double>(state.w_NB_B[0] / degree), 12.61839077591421973, 1e-14);
  EXPECT_NEAR(static_cast<double>(state.w_NB_B[1] / degree), -17.39747476161139311, 1e-14);
  EXPECT_NEAR(static_cast<double>(state.w_NB_B[2] / degree), 31.11958888694434441, 1e-14);
  const auto seen = seen_from_laboratory<Wide>(state, W_N, Wide(30));
  const Quaternion<Wide> published{
      Wide(-0.8806323646749819575L),
      {Wide(0.4711460600328819775L), Wide(0.01178150055430625538L), Wide(0.04867468178766495902L)}};
  EXPECT_LT(angle_between(seen.q_LB, published), 2 * testing::reference(18));
}

}  // namespace
}  // namespace earthtop::test
