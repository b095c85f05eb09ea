// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests whether round-off makes a random walk, by the Jacobi integral along a motion integrated by Taylor series in the
/// general model.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

/// The Jacobi integral T + V - L.W of a sample divided by T + |V|, in long double so that only the motion's own error shows.
struct Jacobi {
  Model<float80> model;
  struct Value {
    long double integral, scale;
  };
  Value of(const MotionSample<double>& sample) const {
    using T = long double;
    const Vec3<double>& v = sample.q_LB.v;
    const Mat3<T> R_LB = rotation_matrix(Quaternion<T>{sample.q_LB.w, Vec3<T>(v[0], v[1], v[2])});
    const Vec3<T> W_B = transposed_times(R_LB, model.W_IL_L);
    const Vec3<T> w_IB_B = Vec3<T>(sample.w_LB_B[0], sample.w_LB_B[1], sample.w_LB_B[2]) + W_B;
    const Vec3<T> L_B = model.I_BP_B * w_IB_B;
    const T kinetic = L_B.dot(w_IB_B) / 2;
    const T potential = -model.mass_moment_B.dot(transposed_times(R_LB, model.apparent_gravity_L));
    return {kinetic + potential - L_B.dot(W_B), kinetic + std::abs(potential)};
  }
};

// Expects round-off to stay within 3 eps sqrt(N) of the energies after N steps, at every N up to the last.
inline void expect_random_walk(Scenario scene, double duration_s, double least_steps) {
  scene.duration_s = scene.output_step_s = duration_s;  // the rows are those below
  auto problem = Scene(scene).problem<double>();
  problem.times_s = {0};
  for (int k = 1; k <= 40; ++k) problem.times_s.push_back(duration_s * std::pow(10.0, (k - 40) / 20.0));
  IntegrationOptions options;
  options.method = Method::taylor;
  options.form = ModelForm::general;
  options.observer = Observer::body;
  options.relative_tolerance = 1e-14;
  options.step_limit = 1'000'000'000;
  const auto motion = integrate_motion(problem, options);
  ASSERT_EQ(motion.status, RunStatus::completed);
  const auto steps = static_cast<double>(motion.counters.accepted);
  EXPECT_GT(steps, least_steps);
  const Jacobi jacobi{Scene(scene).model<float80>()};
  const auto start = jacobi.of(motion.samples.front());
  double worst = 0;
  for (const auto& sample : motion.samples) {
    if (sample.t_s == 0) continue;
    const auto now = jacobi.of(sample);
    const double made = steps * sample.t_s / duration_s;
    worst = std::max(worst, static_cast<double>(std::abs(now.integral - start.integral) / start.scale) / std::sqrt(made));
  }
  std::printf("%.3g steps: worst %.3f eps sqrt(N)\n", steps, worst / 2.22e-16);
  EXPECT_LT(worst, 3 * 2.22e-16);
  EXPECT_GT(worst, 0);
}

}  // namespace earthtop::testing
