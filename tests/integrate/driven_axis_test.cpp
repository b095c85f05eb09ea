// SPDX-License-Identifier: GPL-3.0-or-later
/// The axis of a driven symmetric top by its own equations, against the general form in body axes, whose torques are written apart, by
/// another method.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {
namespace {

struct DrivenCase {
  const char* name;
  Overrides set;
};

/// An Earth that turns fast, so that each of its terms is seen.
const Overrides kFast = {{"/earth/rotation_rate_rad_s", "0.3"}, {"/motion/duration_s", "4"}, {"/motion/output_step_s", "0.25"}};

const DrivenCase kCases[] = {
    {"viscous", {{"/effects/viscous_torque_N_m_s", "2e-6"}}},
    {"quadratic and viscous", {{"/effects/viscous_torque_N_m_s", "1e-6"}, {"/effects/quadratic_torque_N_m_s2", "1e-8"}}},
    {"air drag", {{"/effects/air_drag", "{\"disc_radius_m\": 0.04}"}}},
    {"gradient", {{"/effects/gravity_gradient", "{\"gm_over_r3_s2\": 2.0}"}}},
    {"viscous by axis", {{"/effects/viscous_torque_N_m_s", "[4e-6, 4e-6, 1e-6]"}}},
    {"unequal support", {{"/effects/unequal_support", "{\"kappa_N_m\": 0.01, \"azimuth_deg\": 35}"}}},
    {"torque along the axis", {{"/effects/given_torque", "{\"axes\": \"body\", \"torque_N_m\": [0, 0, 1e-3]}"}}},
    {"torque of the laboratory",
     {{"/effects/given_torque",
       "{\"axes\": \"laboratory\", \"course\": \"harmonic\", \"torque_N_m\": [4e-3, -3e-3, 2e-3], \"frequency_hz\": 0.8}"}}},
    {"tide", {{"/effects/tide", "{\"amplitude_m_s2\": [0.1, 0.2, -0.3], \"frequency_hz\": 0.7}"}}},
    {"turntable with friction",
     {{"/platform",
       "{\"motion\": \"constant\", \"rate_rad_s\": 0.5, \"axis\": [0.1, -0.2, 1], \"pivot_offset_m\": [0.2, 0.1, 0.05]}"},
      {"/effects/viscous_torque_N_m_s", "2e-6"}}},
    {"inertial rates", {{"/effects/viscous_torque_N_m_s", "2e-6"}, {"/release/rates_relative_to", "inertial"}}},
    {"downward", {{"/effects/viscous_torque_N_m_s", "2e-6"}, {"/release/tilt_deg", "179.9999"}}},
};

TEST(DrivenAxis, IsThatOfTheGeneralForm) {
  for (const DrivenCase& c : kCases) {
    SCOPED_TRACE(c.name);
    Overrides set = kFast;
    set.insert(set.end(), c.set.begin(), c.set.end());
    const Scene scene = parse_scene(read_scenario_source(EARTHTOP_SCENARIOS "/toy-top.json"), set);
    const DriftProblem<double> problem = scene.problem<double>();
    IntegrationOptions options = scene.choice().options;
    options.method = Method::taylor;
    ASSERT_TRUE(has_axis_motion(problem.model, options));
    const auto axes = integrate_motion(problem, options, MotionSought::symmetry_axis);
    options.form = ModelForm::general;
    options.observer = Observer::body;
    options.method = Method::rkf78;
    options.relative_tolerance = 1e-13;
    const auto whole = integrate_motion(problem, options);
    ASSERT_EQ(axes.status, RunStatus::completed);
    ASSERT_EQ(axes.samples.size(), whole.samples.size());
    double apart = 0, rates_apart = 0;
    for (std::size_t k = 0; k < axes.samples.size(); ++k) {
      const Mat3<double> R = rotation_matrix(axes.samples[k].q_LB), R_whole = rotation_matrix(whole.samples[k].q_LB);
      apart = std::max(apart, norm(Vec3<double>(R.col(2) - R_whole.col(2))));
      // Rates in laboratory axes: those in body axes are up to a turn about the axis.
      rates_apart =
          std::max(rates_apart, norm(Vec3<double>(times(R, axes.samples[k].w_LB_B) - times(R_whole, whole.samples[k].w_LB_B))));
    }
    EXPECT_LT(apart, 1e-10);       // the method of the general form: 4e3 rad of turns at 1e-13 each
    EXPECT_LT(rates_apart, 3e-8);  // 200 rad/s times that, and as much for the spin
  }
}

}  // namespace
}  // namespace earthtop
