// SPDX-License-Identifier: GPL-3.0-or-later
// The torque of an unequal support against the gradient of its energy, taken by differences in 113 bits, and against a spring
// at the end of the axis; friction of body axes and given torques against sums of their own; the forces of the air on a table
// against its moments.
#include <gtest/gtest.h>

#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/contact_forces.hpp"
#include "paper/particles.hpp"
#include "scene/parts.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

using test::Random;

AppliedTorques<float128> with_support(double kappa_N_m, double azimuth_deg) {
  AppliedTorquesSpec spec;
  spec.unequal_support = UnequalSupportSpec{.kappa_N_m = kappa_N_m, .azimuth_deg = azimuth_deg};
  return make_applied_torques<float128>(spec, {}, 0, 0, 0);
}
Vec3<float128> torque_at(const AppliedTorques<float128>& applied, const Mat3<float128>& R_LB) {
  SeenFromBody<float128> seen;
  seen.east_B = R_LB.row(0).transpose(), seen.north_B = R_LB.row(1).transpose();
  const Mat3<float128> one = Mat3<float128>::Identity();
  return applied_torque(applied, one, one, seen);
}

TEST(UnequalSupport, TorqueIsMinusTheGradientOfTheEnergy) {
  Random random(811);
  const double kappa = 0.7, azimuth = 35 * 3.14159265358979323846 / 180;
  const AppliedTorques<float128> applied = with_support(kappa, 35);
  // kappa (n.e)^2 / 2 of the body axis 3 and the direction 35 degrees east of North
  const float128 e_east = real::sin(float128(azimuth)), e_north = real::cos(float128(azimuth));
  const auto energy = [&](const Mat3<float128>& R_LB) {
    const float128 along = R_LB(0, 2) * e_east + R_LB(1, 2) * e_north;
    return float128(kappa) * along * along / 2;
  };
  for (int k = 0; k < 10; ++k) {
    const Mat3<float128> R_LB = rotation_matrix(random.quaternion<float128>());
    const Vec3<float128> torque = torque_at(applied, R_LB);
    const float128 h = 1e-10;
    for (int i = 0; i < 3; ++i) {
      const auto turned = [&](float128 angle) {
        return Mat3<float128>(R_LB * Rotation<float128>::about(Vec3<float128>::Unit(i), angle).matrix());
      };
      const float128 by_difference = -(energy(turned(h)) - energy(turned(-h))) / (2 * h);
      EXPECT_NEAR(static_cast<double>(torque[i]), static_cast<double>(by_difference), 1e-14);  // 35 degrees are a double here
    }
    EXPECT_EQ(torque[2], float128(0));
    EXPECT_NEAR(static_cast<double>(support_energy(applied.support, float128(R_LB(0, 2)), float128(R_LB(1, 2)))),
                // 35 degrees are a double here
                static_cast<double>(energy(R_LB)), 1e-15);
  }
}

// A spring of stiffness kappa that pulls the end of a unit axis toward the plane across e.
TEST(UnequalSupport, TorqueIsThatOfASpringAtTheEndOfTheAxis) {
  Random random(812);
  for (const double azimuth_deg : {0.0, 90.0, -30.0}) {
    const AppliedTorques<float128> applied = with_support(-0.4, azimuth_deg);
    const Mat3<float128> R_LB = rotation_matrix(random.quaternion<float128>());
    const double angle = azimuth_deg * 3.14159265358979323846 / 180;
    const Vec3<float128> n = R_LB.col(2), e(std::sin(angle), std::cos(angle), 0), force = float128(0.4) * n.dot(e) * e;
    const Vec3<float128> torque = R_LB.transpose() * Vec3<float128>(n.cross(force));
    // sine and cosine are doubles here
    EXPECT_LT(static_cast<double>(norm(Vec3<float128>(torque_at(applied, R_LB) - torque))), 1e-15);
  }
}

// Small swings have the squares of their rates in the ratio of m g l + kappa to m g l.
TEST(UnequalSupport, PeriodsGiveItsStiffness) {
  UnequalSupportSpec spec;
  spec.periods_s = {1.5, 2};
  const SupportStiffness<double> K = support_of_periods(spec, -3.0);
  EXPECT_DOUBLE_EQ((3 + K.north) / 3, 4 / 2.25);
  EXPECT_EQ(K.east, 0);
}

TEST(ViscousByAxis, EachBodyAxisHasItsOwn) {
  AppliedTorquesSpec spec;
  spec.viscous_by_axis_N_m_s = {1, 20, 300};
  const auto applied = make_applied_torques<double>(spec, {}, 0, 0, 0);
  EXPECT_EQ(friction_torque(applied, Vec3<double>(2, -3, 5)), Vec3<double>(-2, 60, -1500));
  EXPECT_TRUE(applied.friction());
  EXPECT_FALSE(applied.has_corner());
  EXPECT_FALSE(applied.is_symmetric_about(2));
}

// The torque about C is what the particles of a disc feel whose drag is proportional to their velocity, and the force what all
// of them feel together: with k of each of two particles on axes 1 and 2 on either side at the distance a.
TEST(AirOnTable, TorqueAndForceAreThoseOfDraggedParticles) {
  constexpr double kDrag = 0.3, kArm = 0.5;
  Contact<double> contact;
  contact.mass = 2;
  contact.air.turns = contact.air.has_axes = contact.air.pulls = true;
  contact.air.viscous_1 = contact.air.viscous_2 = 2 * kDrag * kArm * kArm, contact.air.viscous_3 = 4 * kDrag * kArm * kArm;
  contact.air.force = 4 * kDrag;
  Random random(813);
  const Mat3<double> R = rotation_matrix(random.quaternion<double>());
  const Vec3<double> w(1, -2, 3), v_C(0.3, 0.4, -0.2);
  Vec3<double> torque = Vec3<double>::Zero(), force = Vec3<double>::Zero();
  for (const Vec3<double>& arm_B :
       {Vec3<double>(kArm, 0, 0), Vec3<double>(-kArm, 0, 0), Vec3<double>(0, kArm, 0), Vec3<double>(0, -kArm, 0)}) {
    const Vec3<double> arm = R * arm_B, drag = -kDrag * Vec3<double>(v_C + w.cross(arm));
    torque += arm.cross(drag), force += drag;
  }
  // some ten operations on numbers of 1
  EXPECT_LT(norm(Vec3<double>(R * air_torque_B<double>(contact.air, Vec3<double>(R.transpose() * w)) - torque)), 1e-15);
  // the same
  EXPECT_LT(norm(Vec3<double>(air_torque_beside_axis<double>(contact.air, w, Vec3<double>(R.col(2))) - torque)), 1e-15);
  // the same
  EXPECT_LT(norm(Vec3<double>(contact.mass * air_acceleration(contact, v_C) - force)), 1e-15);
}

// At an ordinary rate the torque on a table is that about a pivot; where the rate is below the floor it is linear.
TEST(AirOnTable, TorqueIsThatAboutAPivotAboveTheFloor) {
  AppliedTorquesSpec spec;
  spec.viscous_N_m_s = 1e-5, spec.quadratic_N_m_s2 = 2e-7, spec.air_drag.emplace().disc_radius_m = 0.05;
  const Vec3<double> w(3, -20, 150);
  const Vec3<double> pivot = friction_torque(make_applied_torques<double>(spec, {}, 150, 0, 0), w);
  const AirOnTable<double> air = make_air_on_table<double>(spec, {}, 150);
  // the floor of the rate, 0.01 rad/s, is seen with its square over that of 150 rad/s: 4e-9
  EXPECT_LT(norm(Vec3<double>(air_torque_B(air, w) - pivot)), 1e-8 * norm(pivot));
  const Vec3<double> slow(0, 0, 1e-6);
  // the rate is 1e-4 of the floor, and its square 1e-8
  EXPECT_NEAR(air_torque_B(air, Vec3<double>(2 * slow))[2], 2 * air_torque_B(air, slow)[2],
              1e-8 * std::abs(air_torque_B(air, slow)[2]));
}

}  // namespace
}  // namespace earthtop
