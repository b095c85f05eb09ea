// SPDX-License-Identifier: GPL-3.0-or-later
/// Friction laws against their limits, Painleve's paradox, and motions on slopes that need no integration.
#include "earthtop/model/contact_forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/model/contact_release.hpp"
#include "support/contact_states.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::ContactCases;
using V = Vec3<double>;

const V kUp(0, 0, 1);

Contact<double> contensou(double mu, double patch) {
  Contact<double> c = ContactCases(1).make<double>({ContactLaw::contensou}).contact;
  c.coefficient = mu, c.patch_radius = patch;
  return c;
}

/// Force and moment of a patch under Hertz pressure, over mu N and mu N R, for d = slip / (R |w_z|), in closed form.
std::pair<double, double> hertz(double d) {
  const double pi = std::numbers::pi;
  if (d <= 1) return {3 * pi / 8 * (d - d * d * d / 4), 3 * pi / 16 * (1 - d * d + 3 * d * d * d * d / 8)};
  const double q = std::sqrt(d * d - 1), a = std::asin(1 / d);
  return {0.75 * ((d - d * d * d / 4) * a + (3 * q + q * q * q) / (4 * d)),
          0.375 * ((1 - d * d + 3 * d * d * d * d / 8) * a + q * (0.75 - 3 * d * d / 8))};
}

TEST(ContactFriction, ContensouHasBothLimitsOfAHertzPatchAndStaysNearItBetween) {
  const Contact<double> c = contensou(0.3, 0.01);
  double worst_force = 0, worst_moment = 0;
  for (double d = 1e-4; d < 40; d *= 1.1) {
    const double slip = d * 0.01 * 7;
    const Friction<double> f = friction(c, V(0, slip, 0), V(3, -2, -7), kUp);
    EXPECT_EQ(f.force_per_normal[0], 0);
    const auto [force, moment] = hertz(d);
    const double F = -f.force_per_normal[1] / 0.3, M = f.moment_per_normal[2] / (0.3 * 0.01);
    EXPECT_GT(F, 0) << "friction is against the slip";
    EXPECT_GT(M, 0) << "its moment is against the spin, which is negative";
    worst_force = std::max(worst_force, std::abs(F / force - 1)),
    worst_moment = std::max(worst_moment, std::abs(M / moment - 1));
    if (d < 1e-3) {
      EXPECT_NEAR(F / force, 1, 10 * d * d);   // of second order in d
      EXPECT_NEAR(M / moment, 1, 10 * d * d);  // as is the force
    }
  }
  const Friction<double> fast = friction(c, V(1e5, 0, 0), V(0, 0, 7), kUp);
  EXPECT_NEAR(fast.force_per_normal[0], -0.3, std::pow(0.01 * 7 / 1e5, 2));  // of second order in spin over slip
  EXPECT_LT(worst_force, 0.14);
  EXPECT_LT(worst_moment, 0.29);
}

TEST(ContactFriction, OfEveryLawIsItsFormula) {
  Contact<double> c = contensou(0.25, 0.01);
  c.viscosity = 3, c.slip_floor = 0.5;
  const V slip(0.3, -0.4, 0), w(1, 2, -3);
  const auto of = [&](ContactLaw law) {
    c.law = law;
    return friction(c, slip, w, kUp);
  };
  EXPECT_EQ(of(ContactLaw::frictionless).force, V(0, 0, 0));
  EXPECT_EQ(of(ContactLaw::viscous).force, V(-3 * slip));
  EXPECT_EQ(of(ContactLaw::viscous).force_per_normal, V(0, 0, 0));
  EXPECT_EQ(of(ContactLaw::viscous_load).force_per_normal, V(-3 * slip));
  EXPECT_LT(norm(V(of(ContactLaw::coulomb).force_per_normal + 0.25 / std::sqrt(0.5) * slip)), 0.25 * testing::rounding(4));
  c.slip_floor = 0;
  EXPECT_NEAR(norm(of(ContactLaw::coulomb).force_per_normal), 0.25, 0.25 * testing::rounding(4));
  EXPECT_EQ(friction(c, V(0, 0, 0), w, kUp).force_per_normal, V(0, 0, 0)) << "no number without slip";
  c.has_spinning_friction = c.has_rolling_resistance = true;
  c.spinning_length = 2, c.rolling_length = 5, c.rate_floor = 4;
  const V moment = of(ContactLaw::rolling).moment_per_normal;
  EXPECT_LT(norm(V(moment - V(-5 / std::sqrt(21.0), -10 / std::sqrt(21.0), 2 * 3 / 5.0))), 5 * testing::rounding(4));
}

/// A uniform rod that slides on its end: no unique force from a friction coefficient of 4/3 on, at the angle of the textbooks.
TEST(ContactPainleve, OfARodBeginsAtFourThirds) {
  Contact<double> c;
  c.law = ContactLaw::coulomb;
  c.mass = 1, c.tip_radius = 0, c.height_of_center = 0.5, c.I1 = 1.0 / 12, c.I3 = 1e-9;
  c.gradient_H.setZero();
  const ContactSurroundings<double> around{kUp, V(0, 0, -9.81), V(0, 0, 0), Mat3<double>::Zero()};
  constexpr double step = 1e-3;  // from one angle to the next
  const auto least_denominator = [&](double mu) {
    c.coefficient = mu;
    double least = 1e9;
    for (double angle = 0; angle < 1.57; angle += step)
      for (const double direction : {-1.0, 1.0}) {
        const ReducedContactState<double> x{V(std::sin(angle), 0, std::cos(angle)), V(0, 0, 0), 0, V(direction, 0, 0),
                                            V(0, 0, 0)};
        least = std::min(least, reduced_rates(c, around, x).reaction.denominator);
      }
    return least;
  };
  EXPECT_GT(least_denominator(4.0 / 3 - 1e-3), 0);
  EXPECT_LT(least_denominator(4.0 / 3 + 1e-3), 0);
  EXPECT_LT(std::abs(least_denominator(4.0 / 3)), 10 * step * step);  // the least lies between two angles
}

/// The table's axes: level is exactly L's own, and down is where the compass direction says.
TEST(ContactTable, DescendsTowardItsAzimuth) {
  for (const double azimuth : {0.0, 30.0, 90.0, 200.0}) {
    const Quaternion<double> level = table_attitude<double>(0, azimuth);
    EXPECT_EQ(level.w, 1);
    EXPECT_EQ(norm(level.v), 0);
    const Quaternion<double> q = table_attitude<double>(10, azimuth);
    const Mat3<double> R_LH = rotation_matrix(q);
    const double tilt = 10 * std::numbers::pi / 180, a = azimuth * std::numbers::pi / 180;
    const V normal = R_LH.col(2), descent = -(kUp - normal.dot(kUp) * normal).normalized();
    EXPECT_NEAR(normal[2], std::cos(tilt), testing::rounding(8));
    EXPECT_NEAR(descent[0], std::sin(a) * std::cos(tilt), testing::rounding(8));
    EXPECT_NEAR(descent[1], std::cos(a) * std::cos(tilt), testing::rounding(8));
    EXPECT_NEAR(descent[2], -std::sin(tilt), testing::rounding(8));
  }
}

/// On a slope a ball without friction slides at g sin, and one that rolls without slip at 5/7 of it.
TEST(ContactTable, ABallRunsDownIt) {
  Contact<double> c;
  c.mass = 0.1, c.tip_radius = 0.02, c.I1 = c.I3 = 1.6e-5;
  c.gradient_H.setZero();
  const double tilt = 0.3;
  const ContactSurroundings<double> around{kUp, V(9.8 * std::sin(tilt), 0, -9.8 * std::cos(tilt)), V(0, 0, 0),
                                           Mat3<double>::Zero()};
  const ReducedContactState<double> rest{V(0, 0, 1), V(0, 0, 0), 0, V(0, 0, 0), V(0, 0, 0.02)};
  c.law = ContactLaw::frictionless;
  const auto slides = reduced_rates(c, around, rest);
  EXPECT_NEAR(slides.v_P[0], 9.8 * std::sin(tilt), 9.8 * testing::rounding(4));
  EXPECT_NEAR(slides.reaction.normal_force, 0.98 * std::cos(tilt), 0.98 * testing::rounding(4));
  c.law = ContactLaw::rolling;
  const auto rolls = reduced_rates(c, around, rest);
  EXPECT_NEAR(0.02 * rolls.u[1], 5.0 / 7 * 9.8 * std::sin(tilt), 9.8 * testing::rounding(4));
  EXPECT_NEAR(rolls.reaction.friction[0], -2.0 / 7 * 0.98 * std::sin(tilt), 0.98 * testing::rounding(4));
}

}  // namespace
}  // namespace earthtop
