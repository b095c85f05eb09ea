// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies in which a rotor turns, against references of 20 digits, in the equations of three observers.
#include <gtest/gtest.h>

#include "earthtop/drift/growth.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/gyrostat_references.hpp"
#include "support/rotor_scenes.hpp"

namespace earthtop {
namespace {

using testing::GyrostatErrors;

class Gyrostat : public ::testing::TestWithParam<Observer> {};

TEST_P(Gyrostat, MeetsItsReferences) {
  for (const nlohmann::json& reference : testing::gyrostat_references().at("cases")) {
    const GyrostatErrors errors = testing::gyrostat_errors<double>(reference, GetParam(), 1e-14);
    // A run in double promises 1e-11 of a motion, 1e-9 of the drift, which is 1e-12 of a thousandth of it.
    EXPECT_LT(errors.motion, 1e-11) << reference.at("name");
    EXPECT_LT(errors.relative_drift, 1e-9) << reference.at("name");  // see above
  }
}

INSTANTIATE_TEST_SUITE_P(Observers, Gyrostat, ::testing::Values(Observer::laboratory, Observer::body, Observer::inertial),
                         [](const auto& chosen) { return std::string(to_string(chosen.param)); });

/// Turning steadily about the axis of its rotor, a gyrostat without torque is disturbed as linear theory says: with the rate w, the
/// momenta D3 = I2 w + h - I3 w and D1 = I1 w - I2 w - h, growth goes at sqrt(D3 D1 / (I1 I3)).
TEST(GyrostatGrowth, IsThatOfLinearTheory) {
  Scenario s = testing::caged_gyroscope();
  s.site.gravity_m_s2 = 0, s.rotation_rate_rad_s = 0;
  s.body.center_of_mass_m = s.rotor->center_m = {0, 0, 0};
  testing::set_principal(s.body, 1e-5, 2.4e-5, 2.2e-5);
  s.rotor->axis = {0, 1, 0};
  const double I1 = 1e-5 + 8.5e-6, I2 = 2.4e-5, I3 = 2.2e-5 + 8.5e-6, C = 1.6e-5, w = 20;
  for (const double h : {8e-5, 2e-5, 1.8e-4}) {
    s.rotor->spin_rad_s = h / C - w;
    s.release.angular_velocity_body_rad_s = {0, w, 0};
    const double square = (I2 * w + h - I3 * w) * (I1 * w - I2 * w - h) / (I1 * I3);
    const GrowthReport report =
        disturbance_growth(Scene(s).problem_without_rows<double>(), MotionKind::reference, 6, kConfirmingGrowthTolerance);
    if (square < 0)
      EXPECT_FALSE(report.exponential_s) << h;
    else
      // A line through log(1 + w0 t), which is taken away, rises by log 2 in the last 3 s. The moments without h differ by a fifth.
      EXPECT_NEAR(*report.late_exponent_1_s, std::sqrt(square) - std::log(2) / 3, 0.03 * std::sqrt(square)) << h;
  }
}

}  // namespace
}  // namespace earthtop
