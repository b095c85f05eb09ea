// SPDX-License-Identifier: GPL-3.0-or-later
// The spin that is left, the times at which spin and tilt come to given values, and a pendulum's swing, against closed forms and motions in
// 113 bits: each within its bound.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/closed_form/swing.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/run_batch.hpp"
#include "results/figures.hpp"
#include "run/pendulums.hpp"

namespace earthtop {
namespace {

constexpr double kDegree = std::numbers::pi / 180, kOmega = 7.292115e-5;

/// Bounds are no wider than this, so that they say something: some hundred times the rounding of numbers of the order of 1, more over
/// minutes; of rates over a minute; of the release.
constexpr double kNarrow = 1e-9, kNarrowRate = 1e-11, kNarrowRelease = 1e-12;

using testing::Pendulum, testing::run_of;

SymmetricTop<float128> exact_of(const Pendulum& body) {
  return {float128(body.I1), float128(body.I3), float128(body.mass_kg) * float128(9.8) * float128(body.center_m)};
}

void expect_within(const BoundedNumber& told, double exact, double most) {
  EXPECT_LE(std::abs(told.value - exact), told.bound) << told.value << " " << exact;
  EXPECT_LT(told.bound, most);
}

/// Viscous friction about the axis alone: w = w0 exp(-k t / I3).
TEST(MotionReport, SpinDown) {
  const double k = 2e-5, I3 = 4e-4;
  const RunResult result = run_of({5e-4, I3, 0}, R"("tilt_deg": 0, "spin_rad_s": 120)", 40,
                                  R"(, "effects": {"viscous_torque_N_m_s": 2e-5}, "report": {"until_spin_rad_s": 50})");
  ASSERT_TRUE(result.motion);
  expect_within(result.motion->spin_end_rad_s.rotating, 120 * std::exp(-k * 40 / I3), kNarrow);
  const auto& spin = *result.motion->spin;
  expect_within({*spin.rotating_s, *spin.rotating_bound_s}, I3 / k * std::log(120.0 / 50), kNarrow);
  EXPECT_FALSE(result.motion->tilt);
  EXPECT_FALSE(result.motion->swing);
  EXPECT_EQ(summary_part(result, "motion.spin_reached_s"), *spin.rotating_s);
  EXPECT_TRUE(summary_part(result, "motion.tilt_reached_s").is_null());
}

/// A spin that is not reached, and one that the release has.
TEST(MotionReport, WhatIsNotReachedHasNoTime) {
  const RunResult result = run_of({5e-4, 4e-4, 0}, R"("tilt_deg": 10, "spin_rad_s": 120)", 4,
                                  R"(, "report": {"until_spin_rad_s": 50, "until_tilt_deg": 10})");
  EXPECT_FALSE(result.motion->spin->rotating_s);
  EXPECT_EQ(*result.motion->tilt->rotating_s, 0);
}

/// A rod that falls from near the vertical: the time until a tilt, by the closed form in 113 bits.
TEST(MotionReport, TimeOfFalling) {
  for (const double spin : {0.0, 20.0}) {
    const Pendulum body{5e-3, 1e-3, 0.06};
    const RunResult result = run_of(body, fmt::format(R"("tilt_deg": 2, "azimuth_deg": 33, "spin_rad_s": {})", spin), 2,
                                    R"(, "report": {"until_tilt_deg": 60})");
    ASSERT_TRUE(result.motion->tilt->rotating_s) << spin;
    const double t_s = *result.motion->tilt->rotating_s, bound_s = *result.motion->tilt->rotating_bound_s;
    EXPECT_LT(bound_s, kNarrow);
    EXPECT_EQ(t_s, *result.motion->tilt->reference_s);
    const Release<float128>& release = result.scene.release<float128>();
    const LagrangeTop<float128> exact(exact_of(body), release.q_LB, release.w_XB_B);
    const auto tilt_at = [&](double at_s) {
      const Vec3<float128> n = rotation_matrix(exact.at(float128(at_s)).q_NB).col(2);
      return static_cast<double>(real::atan2(real::sqrt(n[0] * n[0] + n[1] * n[1]), n[2]));
    };
    // It is passed within the bound, and not before: the tilt grows until then.
    EXPECT_LT(tilt_at(t_s - bound_s), 60 * kDegree);
    EXPECT_GT(tilt_at(t_s + bound_s), 60 * kDegree);
    for (int k = 0; k < 100; ++k) EXPECT_LT(tilt_at(0.999 * t_s * k / 100), 60 * kDegree);
  }
}

/// Without the Earth the plane turns at the apsidal rate, which for any ellipse is the mean rate of the azimuth less half that of the tilt, by
/// sums over a period. The Airy rate 3/8 a b w / l^2 is its limit.
TEST(MotionReport, AiryAndBeyond) {
  const Pendulum body{9.05, 0.1, -3};
  for (const double amplitude_deg : {3.8226, 25.0, 60.0}) {
    const RunResult result = run_of(
        body, fmt::format(R"("tilt_deg": {}, "spin_rad_s": 0, "precession": {{"rate_rad_s": 0.0904}})", amplitude_deg), 60);
    ASSERT_TRUE(result.motion->swing);
    const auto& swing = *result.motion->swing;
    const Release<float128>& release = result.scene.release<float128>();
    const auto rates = mean_rates(top_constants(exact_of(body), release.q_LB, release.w_XB_B));
    ASSERT_TRUE(rates);
    const double apsidal = -(rates->precession_rad_s - rates->nutation_rad_s / 2);
    expect_within(swing.plane_rate_rad_s.rotating, apsidal, kNarrowRate);
    expect_within(swing.plane_rate_rad_s.reference, apsidal, kNarrowRate);
    expect_within(swing.major_start_rad.rotating, amplitude_deg * kDegree, kNarrowRelease);
    expect_within(swing.major_end_rad.rotating, amplitude_deg * kDegree, kNarrow);
    expect_within(swing.minor_end_rad.rotating, swing.minor_start_rad.rotating.value, kNarrow);
    EXPECT_LT(swing.minor_end_rad.rotating.value, 0);  // released counterclockwise
    if (amplitude_deg < 4) {
      const double a = amplitude_deg * kDegree, b = -swing.minor_end_rad.rotating.value;
      EXPECT_NEAR(apsidal, -0.375 * a * b * std::sqrt(3 * 9.8 / 9.05),
                  0.01 * std::abs(apsidal));  // its own next order is a^2 of it
    }
  }
}

/// A small swing of a body with a moment about its axis: relative to axes that do not turn about Up, it spins with the laboratory, and its
/// plane turns with it by I3 / (2 I1) of that. In the laboratory Omega sin(latitude) (1 - I3 / (2 I1)) is left.
TEST(MotionReport, FoucaultWithAnAxialMoment) {
  const Pendulum body{12, 4.5, -3};
  const RunResult result = run_of(body, R"("tilt_deg": 0.01, "azimuth_deg": 20, "spin_rad_s": 0)", 600, "", "");
  ASSERT_TRUE(result.motion->swing);
  const double expected = kOmega * std::sin(50 * kDegree) * (1 - 4.5 / (2 * 12));
  const BoundedNumber& rate = result.motion->swing->plane_rate_rad_s.rotating;
  EXPECT_NEAR(rate.value, expected,
              2e-4 * expected);            // at the ends of 600 s the azimuth is off by Omega over the rate of the swing
  EXPECT_LT(rate.bound, 1e-6 * expected);  // of what is sought
  EXPECT_LE(std::abs(result.motion->swing->plane_rate_rad_s.reference.value),
            result.motion->swing->plane_rate_rad_s.reference.bound);
}

/// A damped swing falls as exp(-k t / (2 I1)), to first order in the amplitude's square and in the damping.
TEST(MotionReport, ADampedSwingFallsExponentially) {
  const Pendulum body{9.05, 0.1, -3};
  const RunResult result = run_of(body, R"("tilt_deg": 0.5, "spin_rad_s": 0, "precession": {"rate_rad_s": 0.05})", 600,
                                  R"(, "effects": {"viscous_torque_N_m_s": 0.02})");
  ASSERT_TRUE(result.motion->swing);
  const auto& swing = *result.motion->swing;
  const double fallen = std::exp(-0.02 * 600 / (2 * 9.05));
  EXPECT_NEAR(swing.major_end_rad.rotating.value / swing.major_start_rad.rotating.value, fallen,
              1e-3);  // k / (I1 w), squared amplitude
  EXPECT_NEAR(swing.minor_end_rad.rotating.value / swing.minor_start_rad.rotating.value, fallen, 1e-3);  // likewise
}

/// Points of a study are computed side by side, and their second integration has no rates: the bounds hold there, too, and are as narrow.
TEST(MotionReport, PointsSideBySideHaveTheSameFigures) {
  std::vector<Scene> scenes;
  for (int k = 0; k < 8; ++k)
    scenes.push_back(
        run_of({9.05, 0.1, -3},
               fmt::format(R"("tilt_deg": {}, "spin_rad_s": 0, "precession": {{"rate_rad_s": 0.09}})", 3 + 0.1 * k), 0.1, "",
               "")
            .scene);
  const std::vector<BatchOutcome> points = run_batch(scenes, {}, false);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    ASSERT_TRUE(points[k].result);
    const RunResult &point = *points[k].result, alone = run(scenes[k]);
    ASSERT_TRUE(point.motion->swing && alone.motion->swing);
    const BoundedNumber &here = point.motion->swing->plane_rate_rad_s.rotating,
                        &there = alone.motion->swing->plane_rate_rad_s.rotating;
    EXPECT_LE(std::abs(here.value - there.value), here.bound + there.bound);
    EXPECT_LT(here.bound, 1e-7);                                   // rad/s, after 0.1 s
    EXPECT_LT(point.motion->spin_end_rad_s.rotating.bound, 1e-9);  // likewise
  }
}

/// The time of falling of a point of a study, which looks at few times, is that of a run by itself.
TEST(MotionReport, APointThatLooksAtFewTimesTellsWhenItFalls) {
  const Pendulum body{5e-3, 1e-3, 0.06};
  const RunResult alone =
      run_of(body, R"("tilt_deg": 2, "azimuth_deg": 33, "spin_rad_s": 20)", 2, R"(, "report": {"until_tilt_deg": 60})");
  const std::vector<BatchOutcome> points = run_batch({&alone.scene, 1}, {}, false);
  ASSERT_TRUE(points[0].result && points[0].result->motion->tilt->rotating_bound_s);
  const MotionReport::Reached &here = *points[0].result->motion->tilt, &there = *alone.motion->tilt;
  EXPECT_TRUE(here.rotating_is_sure);
  EXPECT_LE(std::abs(*here.rotating_s - *there.rotating_s), *here.rotating_bound_s + *there.rotating_bound_s);
}

/// The ellipse of a state is the same at all times of an undisturbed motion, and its azimuth goes evenly: in 113 bits.
TEST(Swing, IsConstantAlongTheClosedForm) {
  const SymmetricTop<float128> pendulum{float128(2), float128(0.3), float128(-7)};
  const Quaternion<float128> q0 =
      Quaternion<float128>{float128(0.9), {float128(0.4), float128(0.1), float128(0.02)}}.normalized();
  const Vec3<float128> w0(float128(0.3), float128(-0.2), float128(0.8));
  const LagrangeTop<float128> motion(pendulum, q0, w0);
  std::optional<Swing<float128>> first;
  for (int k = 0; k < 40; ++k) {
    const float128 t = float128(k) * float128(0.173);
    const auto state = motion.at(t);
    const Mat3<float128> R = rotation_matrix(state.q_NB);
    const Vec3<float128> n = R.col(2), rate = R * Vec3<float128>(state.w_NB_B[1], -state.w_NB_B[0], float128(0));
    const auto swing = swing_of(pendulum, n, rate, state.w_NB_B[2], float128(0));
    ASSERT_TRUE(swing && swing->azimuth_rad);
    if (!first) first = swing;
    constexpr double kExact = 1e-28;  // of angles of the order of 1, in 113 bits
    EXPECT_LT(std::abs(static_cast<double>(swing->major_rad - first->major_rad)), kExact);
    EXPECT_LT(std::abs(static_cast<double>(swing->minor_rad - first->minor_rad)), kExact);
    EXPECT_LT(std::abs(static_cast<double>(swing->apsidal_rate_rad_s - first->apsidal_rate_rad_s)), kExact);
    const float128 turned = *swing->azimuth_rad - *first->azimuth_rad - t * first->apsidal_rate_rad_s,
                   half = real::pi<float128>();
    EXPECT_LT(std::abs(static_cast<double>(turned - half * real::round(turned / half))), kExact) << k;
  }
}

/// A top that stays up has no swing.
TEST(Swing, IsNoneOfATopThatStaysUp) {
  const SymmetricTop<double> top{1e-3, 5e-4, 0.05};
  EXPECT_FALSE(swing_of(top, Vec3<double>(0.5, 0, std::sqrt(0.75)), Vec3<double>(0, 0.1, 0), 200.0, 0.0));
  EXPECT_FALSE(swing_of({1e-3, 5e-4, 0}, Vec3<double>(0.5, 0, std::sqrt(0.75)), Vec3<double>(0, 0.1, 0), 2.0, 0.0));
  const auto circle = swing_of({1.0, 1e-9, -1.0}, Vec3<double>(std::sin(0.5), 0, std::cos(0.5)),
                               Vec3<double>(0, std::sin(0.5) / std::sqrt(std::cos(0.5)), 0), 0.0, 0.0);
  ASSERT_TRUE(circle);                         // conical: w^2 = m g l / (I1 cos(inclination))
  EXPECT_NEAR(circle->major_rad, 0.5, 1e-7);   // a square root of the rounding
  EXPECT_NEAR(circle->minor_rad, -0.5, 1e-7);  // a square root of the rounding
}

}  // namespace
}  // namespace earthtop
