// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift at a small rate, interpolated between four larger ones: its error is that of the known drift, and within what is stated.
#include "drift/long_horizon/rate_interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earthtop {
namespace {

/// A drift at the rate epsilon of the Earth after a given time: turns about two axes, one after the other.
SpinlessPair<double> turned(double about_z, double about_x, double epsilon) {
  const auto turn = [&](double angle, const Vec3<double>& axis) {
    return Quaternion<double>{std::cos(angle * epsilon / 2), Vec3<double>(std::sin(angle * epsilon / 2) * axis)};
  };
  const Quaternion<double> e = turn(about_z, Vec3<double>::UnitZ()) * turn(about_x, Vec3<double>::UnitX());
  SpinlessPair<double> pair;
  pair.e_w = e.w, pair.y = e.v / epsilon;
  return pair;
}

struct Turns {
  double about_z, about_x;
};

TEST(RateInterpolation, ErrorOfTheCubicIsWithinWhatIsStated) {
  // One turn alone has terms of even order only; two of them have all.
  for (const Turns& c : {Turns{1, 0}, {1, 1}, {1, -0.3}, {0.2, 1}}) {
    InterpolationError<double> stated;
    for (const double node : {0.02, 0.05, 0.1, 0.2}) {
      const double epsilon = 1e-7;
      const JoinedPair<double> there =
          joined<double>({turned(c.about_z, c.about_x, node), turned(c.about_z, c.about_x, node / 2),
                          turned(c.about_z, c.about_x, -node / 2), turned(c.about_z, c.about_x, -node)},
                         epsilon, node);
      // To first order the turns add up, to second order half their cross product joins them; the next terms are below 1e-14.
      const Vec3<double> known(c.about_x / 2, epsilon * c.about_z * c.about_x / 4, c.about_z / 2);
      const double error = norm(Vec3<double>(there.pair.y - known));
      stated.include(norm(there.pair.y), norm(there.second_order_term), norm(there.third_order_term));
      // Rounding adds some units of each of the four.
      EXPECT_LE(error, stated.fourth_order() + 1e-15) << "turns " << c.about_z << ", " << c.about_x << ", node " << node;
      // A statement a hundred times as large as the error is worth little.
      if (node > 0.05) {
        EXPECT_GE(error, stated.fourth_order() / 100) << c.about_x << ", node " << node;
      }
    }
  }
}

}  // namespace
}  // namespace earthtop
