// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of random motions in double against those of the same scenarios in 113 bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "run/pendulums.hpp"

namespace earthtop {
namespace {

using testing::Pendulum, testing::run_of;

/// Figures of random pendulums, damped and elliptic ones, spinning ones, on the rotating Earth: in double within their bounds of those of the
/// same scenario in 113 bits.
TEST(MotionReport, FiguresAreWithinTheirBoundsOfThoseIn113Bits) {
  std::mt19937_64 bits(53);
  const auto from = [&](double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; };
  for (int scene = 0; scene < 3; ++scene) {
    const Pendulum body{from(0.5, 2), from(0.05, 0.5), -from(0.5, 1)};
    const std::string release =
        fmt::format(R"("tilt_deg": {}, "azimuth_deg": {}, "spin_rad_s": {}, "precession": {{"rate_rad_s": {}}})", from(2, 50),
                    from(0, 360), from(-0.5, 0.5), from(-0.6, 0.6));
    const std::string damped =
        scene % 2 == 0 ? fmt::format(R"("effects": {{"viscous_torque_N_m_s": {}}}, )", from(1e-3, 1e-2)) : "";
    const std::string asked = R"("report": {"until_tilt_deg": 1.9, "until_spin_rad_s": 0.01})";
    const RunResult found = run_of(body, release, 6, ", " + damped + asked, ""),
                    exact = run_of(body, release, 6, ", " + damped + asked + R"(, "numerics": {"precision": "float128"})", "");
    ASSERT_TRUE(found.motion && exact.motion);
    const auto expect = [&](const BoundedNumber& told, const BoundedNumber& right, const char* what) {
      EXPECT_LE(std::abs(told.value - right.value), told.bound + right.bound) << what << " of scene " << scene;
      EXPECT_LT(told.bound, 1e-6) << what << " of scene " << scene;  // and not for nothing: of numbers of the order of 1
    };
    expect(found.motion->spin_end_rad_s.rotating, exact.motion->spin_end_rad_s.rotating, "spin");
    const auto expect_times = [&](const MotionReport::Reached& told, const MotionReport::Reached& right, const char* what) {
      ASSERT_EQ(told.rotating_s.has_value(), right.rotating_s.has_value()) << what << " of scene " << scene;
      if (told.rotating_s && told.rotating_bound_s)
        EXPECT_LE(std::abs(*told.rotating_s - *right.rotating_s), *told.rotating_bound_s) << what << " of scene " << scene;
    };
    expect_times(*found.motion->tilt, *exact.motion->tilt, "tilt");
    expect_times(*found.motion->spin, *exact.motion->spin, "spin");
    ASSERT_EQ(found.motion->swing.has_value(), exact.motion->swing.has_value());
    if (!found.motion->swing) continue;
    const auto &swing = *found.motion->swing, &right = *exact.motion->swing;
    expect(swing.major_end_rad.rotating, right.major_end_rad.rotating, "major");
    expect(swing.minor_end_rad.rotating, right.minor_end_rad.rotating, "minor");
    expect(swing.plane_rate_rad_s.rotating, right.plane_rate_rad_s.rotating, "plane");
    expect(swing.plane_rate_rad_s.reference, right.plane_rate_rad_s.reference, "apsides");
  }
}

}  // namespace
}  // namespace earthtop
