// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/angle_spline.hpp"

#include "earthtop/frames/prescribed_motion.hpp"
#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::at_most;
using test::close;
using test::Random;
using Q = float128;

/// Times k/64 from about -1 on, 1/64 to 16/64 apart: their powers up to the third are exact doubles.
std::vector<double> uneven_times(Random& random, int n) {
  std::vector<double> times = {-1};
  while (static_cast<int>(times.size()) < n) times.push_back(times.back() + (1 + std::floor(random.uniform(0, 16))) / 64);
  return times;
}

/// c0 + c1 t + c2 t^2 + c3 t^3 and its derivatives.
struct Cubic {
  std::array<double, 4> c;
  template <class T>
  T angle(T t) const {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }
  template <class T>
  T rate(T t) const {
    return c[1] + t * (2 * c[2] + t * 3 * c[3]);
  }
  template <class T>
  T acceleration(T t) const {
    return 2 * c[2] + 6 * t * c[3];
  }
};

TEST(AngleSpline, IsTheCubicPolynomialThatItsAnglesLieOn) {
  Random random(71);
  for (int n = 4; n <= 40; n += n < 8 ? 1 : 16) {
    Cubic cubic;
    for (double& c : cubic.c) c = std::floor(random.uniform(-64, 64)) / 8;
    AngleTable table;
    table.t_s = uneven_times(random, n);
    double largest = 0;
    for (const double t : table.t_s) {
      table.value.push_back(cubic.angle(t));
      largest = std::max(largest, std::abs(table.value.back()));
    }
    test::for_each_scalar([&]<class T>(T) {
      const AngleSpline<T> spline(table);
      // The slope of a chord is in error by eps times the angle, divided by the interval; the elimination adds a few such
      // errors, and each derivative divides by an interval once more.
      const T h = T(1) / 64, angle_error = 64 * real::epsilon<T>() * T(largest);
      for (int k = 0; k < 200; ++k) {
        const T t = T(random.uniform(table.t_s.front(), table.t_s.back()));
        ASSERT_TRUE(close(spline.angle(t), cubic.angle(t), angle_error)) << n;
        ASSERT_TRUE(close(spline.angle_rate(t), cubic.rate(t), angle_error / h)) << n;
        ASSERT_TRUE(close(spline.angle_acceleration(t), cubic.acceleration(t), 6 * angle_error / (h * h))) << n;
      }
      // Beyond the table its end pieces are continued.
      for (const T t : {T(table.t_s.front() - 0.125), T(table.t_s.back() + 0.125)})
        ASSERT_TRUE(close(spline.angle(t), cubic.angle(t), 1024 * angle_error)) << n;
    });
  }
}

// These conditions have exactly one solution.
TEST(AngleSpline, IsPiecewiseCubicWithTheRightJoints) {
  Random random(72);
  for (const int n : {4, 5, 6, 30}) {
    AngleTable table;
    table.t_s = uneven_times(random, n);
    for (int i = 0; i < n; ++i) table.value.push_back(random.uniform(-1, 1));
    const AngleSpline<Q> spline(table);
    const Q near = Q(1e-15);  // nothing here is larger than 1e8
    // The third derivative in the piece that begins at knot i, from its linear acceleration.
    const auto jerk = [&](int i) {
      const Q a = table.t_s[static_cast<std::size_t>(i)], b = table.t_s[static_cast<std::size_t>(i) + 1], d = (b - a) / 4;
      const Q first = spline.angle_acceleration(a + d), middle = spline.angle_acceleration(a + 2 * d);
      EXPECT_TRUE(close(middle - first, spline.angle_acceleration(a + 3 * d) - middle, Q(1e-20)));
      return (middle - first) / d;
    };
    const std::vector<Q> joints = spline.joints();
    ASSERT_EQ(static_cast<int>(joints.size()), n - 4);
    for (std::size_t i = 0; i < joints.size(); ++i) ASSERT_TRUE(joints[i] == Q(table.t_s[i + 2]));
    bool breaks = n == 4;
    for (int i = 0; i < n; ++i) {
      const Q t = table.t_s[static_cast<std::size_t>(i)];
      ASSERT_TRUE(close(spline.angle(t), Q(table.value[static_cast<std::size_t>(i)]), Q(1e-30)));
      for (const Q side : {-near, near}) {
        ASSERT_TRUE(close(spline.angle(t + side), spline.angle(t), Q(1e-7)));
        ASSERT_TRUE(close(spline.angle_rate(t + side), spline.angle_rate(t), Q(1e-7)));
        ASSERT_TRUE(close(spline.angle_acceleration(t + side), spline.angle_acceleration(t), Q(1e-7)));
      }
      if (i == 0 || i == n - 1) continue;
      const Q before = jerk(i - 1), after = jerk(i);
      const bool smooth = i == 1 || i == n - 2;
      ASSERT_TRUE(!smooth || real::abs(before - after) <= Q(1e-20) * (1 + real::abs(after))) << i;
      breaks = breaks || (!smooth && real::abs(before - after) > Q(1));
    }
    EXPECT_TRUE(breaks);            // no single polynomial
    for (int k = 0; k < 50; ++k) {  // and rate and acceleration are the angle's derivatives
      const Q t = random.uniform(table.t_s.front(), table.t_s.back()), d = Q(1e-12);
      const Q rate = (spline.angle(t + d) - spline.angle(t - d)) / (2 * d);
      const Q acceleration = (spline.angle_rate(t + d) - spline.angle_rate(t - d)) / (2 * d);
      ASSERT_TRUE(close(spline.angle_rate(t), rate, Q(1e-10)));
      ASSERT_TRUE(close(spline.angle_acceleration(t), acceleration, Q(1e-6)));
    }
  }
}

TEST(AngleSpline, SampledSineConvergesWithTheFourthThirdAndSecondPower) {
  const auto worst = [](int intervals) {
    AngleTable table;
    for (int i = 0; i <= intervals; ++i) {
      table.t_s.push_back(4.0 * i / intervals);
      table.value.push_back(std::sin(table.t_s.back()));
    }
    const AngleSpline<double> spline(table);
    std::array<double, 3> error = {};
    for (int k = 0; k <= 5000; ++k) {
      const double t = 4.0 * k / 5000;
      error[0] = std::max(error[0], std::abs(spline.angle(t) - std::sin(t)));
      error[1] = std::max(error[1], std::abs(spline.angle_rate(t) - std::cos(t)));
      error[2] = std::max(error[2], std::abs(spline.angle_acceleration(t) + std::sin(t)));
    }
    return error;
  };
  const auto coarse = worst(64), fine = worst(128);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(std::log2(coarse[k] / fine[k]), 4.0 - static_cast<double>(k), 0.15) << k;
  const double h = 4.0 / 128;
  EXPECT_LT(fine[0], std::pow(h, 4));
}

TEST(AngleSpline, KnowsItsLargestRateAndAcceleration) {
  Random random(73);
  AngleTable table;
  table.t_s = uneven_times(random, 20);
  for (std::size_t i = 0; i < 20; ++i) table.value.push_back(random.uniform(-1, 1));
  const AngleSpline<double> spline(table);
  double rate = 0, acceleration = 0;
  constexpr int kPoints = 200'000;
  for (int k = 0; k <= kPoints; ++k) {
    const double t = table.t_s.front() + (table.t_s.back() - table.t_s.front()) * k / kPoints;
    rate = std::max(rate, std::abs(spline.angle_rate(t)));
    acceleration = std::max(acceleration, std::abs(spline.angle_acceleration(t)));
  }
  const double step = (table.t_s.back() - table.t_s.front()) / kPoints;
  EXPECT_GE(spline.largest_rate(), rate * (1 - 1e-14));
  EXPECT_LE(spline.largest_rate(), rate + step * acceleration);
  EXPECT_GE(spline.largest_acceleration(), acceleration * (1 - 1e-14));
  EXPECT_LE(spline.largest_acceleration(), acceleration * (1 + 64 * step));  // linear in a piece of at least 1/64
}

TEST(AngleSpline, OtherUnitsOfTimeChangeNoDigit) {
  Random random(74);
  AngleTable table;
  table.t_s = uneven_times(random, 10);
  for (std::size_t i = 0; i < 10; ++i) table.value.push_back(random.uniform(-1, 1));
  test::for_each_scalar([&]<class T>(T) {
    const AngleSpline<T> spline(table);
    for (const int k : {-13, 0, 7}) {
      const AngleSpline<T> scaled = spline.in_time_units(k);
      for (int i = 0; i < 100; ++i) {
        const T t = T(random.uniform(-1.5, 3)), unit_t = real::scale(t, -k);
        ASSERT_TRUE(scaled.angle(unit_t) == spline.angle(t));
        ASSERT_TRUE(scaled.angle_rate(unit_t) == real::scale(spline.angle_rate(t), k));
        ASSERT_TRUE(scaled.angle_acceleration(unit_t) == real::scale(spline.angle_acceleration(t), 2 * k));
      }
      ASSERT_TRUE(scaled.largest_rate() == real::scale(spline.largest_rate(), k));
    }
  });
}

TEST(AngleSpline, UnsoundTablesAreRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(AngleSpline<double>({{0, 1, 2, 3}, {0, 1, 2, 3}}));
  EXPECT_THROW(AngleSpline<double>({{0, 1, 2}, {0, 1, 2}}), std::invalid_argument);
  EXPECT_THROW(AngleSpline<double>({{0, 1, 2, 3}, {0, 1, 2}}), std::invalid_argument);
  EXPECT_THROW(AngleSpline<double>({{0, 1, 1, 3}, {0, 1, 2, 3}}), std::invalid_argument);
  EXPECT_THROW(AngleSpline<double>({{0, 2, 1, 3}, {0, 1, 2, 3}}), std::invalid_argument);
  EXPECT_THROW(AngleSpline<double>({{0, 1, 2, infinity}, {0, 1, 2, 3}}), std::invalid_argument);
  EXPECT_THROW(AngleSpline<double>({{0, 1, 2, 3}, {0, 1, NAN, 3}}), std::invalid_argument);
}

TEST(PrescribedMotion, ATableAddsToTheOtherTerms) {
  PrescribedMotion<double> motion;
  EXPECT_TRUE(motion.never_turns());
  motion.table = std::make_shared<const AngleSpline<double>>(AngleTable{{0, 1, 2, 3}, {0, 0, 0, 0}});
  EXPECT_TRUE(motion.never_turns());
  motion.table = std::make_shared<const AngleSpline<double>>(AngleTable{{0, 1, 2, 3}, {0, 0, 0, 1}});
  EXPECT_FALSE(motion.never_turns());
  motion.table = std::make_shared<const AngleSpline<double>>(AngleTable{{0, 1, 2, 3}, {0, 1, 8, 27}});  // t^3
  EXPECT_FALSE(motion.never_turns());
  motion.angle0 = 5, motion.rate = 3, motion.acceleration = 2;
  EXPECT_NEAR(motion.angle(1.5), 5 + 3 * 1.5 + 1.5 * 1.5 + 1.5 * 1.5 * 1.5, 1e-13);
  EXPECT_NEAR(motion.angle_rate(1.5), 3 + 2 * 1.5 + 3 * 1.5 * 1.5, 1e-13);
  EXPECT_NEAR(motion.angle_acceleration(1.5), 2 + 6 * 1.5, 1e-13);
}

}  // namespace
}  // namespace earthtop
