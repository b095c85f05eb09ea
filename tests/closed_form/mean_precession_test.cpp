// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean rates of a symmetric top, compared with its whole motion and with steady precession.

#include "earthtop/closed_form/mean_precession.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/closed_form/special_cases.hpp"

namespace earthtop::test {
namespace {

const SymmetricTop<double> kTop{5e-4, 8e-4, 0.2}, kHanging{5e-4, 8e-4, -0.2};

/// Azimuth of the axis (rad), counterclockwise about Up from East.
double azimuth(const LagrangeTop<double>& motion, double t_s) {
  const Mat3<double> R = rotation_matrix(motion.at(t_s).q_NB);
  return std::atan2(R(1, 2), R(0, 2));
}

// Over one period the azimuth, followed in small steps, advances by the mean rate times the period.
TEST(MeanPrecession, IsTheAdvanceOfTheAzimuthInAPeriod) {
  for (const SymmetricTop<double>& top : {kTop, kHanging})
    for (const Vec3<double>& w : {Vec3<double>(0, 0, 60), Vec3<double>(3, -8, 60), Vec3<double>(5, 2, -45)}) {
      const Quaternion<double> q{0.9, Vec3<double>(0.3, -0.1, 0.2)};
      const LagrangeTop<double> motion(top, q, w);
      const double period = motion.nutation_period_s();
      double advance = 0, before = azimuth(motion, 0);
      for (int k = 1; k <= 400; ++k) {
        const double now = azimuth(motion, period * k / 400);
        advance += std::remainder(now - before, 2 * std::numbers::pi);
        before = now;
      }
      const auto rates = mean_rates(top_constants(top, q, w));
      ASSERT_TRUE(rates);
      EXPECT_NEAR(rates->nutation_rad_s * period, 2 * std::numbers::pi, 1e-11);
      EXPECT_NEAR(rates->precession_rad_s * period, advance, 1e-10);
    }
}

TEST(MeanPrecession, OfASteadyTopIsItsRate) {
  const double w3 = 80, tilt = 0.7;
  const auto steady = steady_precession_rates(kTop, w3, std::cos(tilt));
  ASSERT_TRUE(steady);
  const Quaternion<double> q{std::cos(tilt / 2), Vec3<double>(std::sin(tilt / 2), 0, 0)};
  for (const double rate : {steady->slow, steady->fast}) {
    const auto rates = mean_rates(top_constants(kTop, q, Vec3<double>(0, rate * std::sin(tilt), w3)));
    ASSERT_TRUE(rates);
    EXPECT_NEAR(rates->precession_rad_s, rate, 1e-11 * rates->nutation_rad_s);
  }
}

// Next to a pole the axis goes in two circles, x + iy = A e^(i a t) + B e^(i b t) with a^2 - (I3 w3/I1) a + m g l/I1 = 0 (below the
// pivot both signs turn), and its azimuth follows the larger circle. What this leaves out is the square of the distance; the constants
// of the motion lose to rounding what the distance's square is smaller than 1.
TEST(MeanPrecession, NextToThePolesIsThatOfTheLargerCircle) {
  for (const SymmetricTop<double>& top : {kTop, kHanging})
    for (const double distance : {1e-3, 1e-4, 1e-5})
      for (const bool below : {false, true}) {
        const double w3 = 80, pole = below ? -1 : 1, half = top.I3 * w3 / top.I1 / 2 * pole;
        const double root = std::sqrt(half * half - pole * top.mgl / top.I1);
        const double slow = half - (half > 0 ? root : -root), fast = half + (half > 0 ? root : -root);
        const double tilt = below ? std::numbers::pi - distance : distance;
        const Quaternion<double> q{std::cos(tilt / 2), Vec3<double>(std::sin(tilt / 2), 0, 0)};
        for (const double part : {0.2, 0.9}) {  // of the fast circle
          const double rate = (1 - part) * slow + part * fast;
          const auto rates = mean_rates(top_constants(top, q, Vec3<double>(0, rate * std::sin(tilt), w3)));
          ASSERT_TRUE(rates) << distance << below;
          constexpr double kRoundings = 16;
          const double square = distance * distance, tolerance = square + kRoundings * 0x1p-52 / square;
          EXPECT_NEAR(rates->precession_rad_s, part < 0.5 ? slow : fast, tolerance * std::abs(fast)) << distance << below;
          EXPECT_NEAR(rates->nutation_rad_s, 2 * root, tolerance * std::abs(fast)) << distance << below;
        }
      }
}

// There is none on the way to the upright position, which takes for ever, and for a top without torque.
TEST(MeanPrecession, OfWhichThereIsNone) {
  EXPECT_FALSE(mean_rates(top_constants(kTop, Quaternion<double>(), Vec3<double>(0, 0, 10))));
  EXPECT_FALSE(
      mean_rates(top_constants({5e-4, 8e-4, 0}, Quaternion<double>{0.9, Vec3<double>(0.3, 0, 0)}, Vec3<double>(1, 0, 60))));
}

}  // namespace
}  // namespace earthtop::test
