// SPDX-License-Identifier: GPL-3.0-or-later
/// Points side by side in lanes: each agrees with the scalar series, and its bits do not depend on the other points.

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "lanes/driven_tops.hpp"
#include "lanes/lane_bits.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

using testing::bits_of;

/// The relative tolerance of the integrations that are compared.
constexpr double kTolerance = 1e-13;
/// Lanes take the steps of the scalar series and round its sums elsewhere. Over the tens of radians of these scenes attitudes differ by
/// 1.3e-13 at most, as measured (rad), rates relative to their size likewise, and drifts by 8e-13 of the largest one; the bounds are some ten
/// times that.
constexpr double kRounding = 1e-12, kOfDrift = 1e-11;

IntegrationOptions reduced(Method method, Observer observer, double tolerance = kTolerance) {
  IntegrationOptions options;
  options.method = method;
  options.observer = observer;
  options.form = ModelForm::reduced;
  options.relative_tolerance = tolerance;
  return options;
}

/// Symmetric tops of every kind: fast and slow, both matching rules, any latitude, Earth rates from 1e-6 to 1 rad/s, a
/// pendulum, a top about body axis 1, and one without Earth rotation. Their durations differ, so that lanes are refilled at
/// different times.
std::vector<Scenario> tops(std::size_t count) {
  std::vector<Scenario> scenes;
  scenes.reserve(count);
  for (std::uint64_t i = 0; scenes.size() < count; ++i) {
    Scenario scene = testing::random_scene(2 * i + 1, 20.0 + 10.0 * static_cast<double>(i % 7));
    if (i % 8 == 3) {
      scene = testing::toy_top();
      scene.release.spin_rad_s = 0;
      scene.body.center_of_mass_m = {0, 0, -0.03};
      scene.duration_s = 3;
    }
    if (i % 8 == 5) {
      scene = testing::toy_top();
      scene.body.center_of_mass_m = {0.03, 0, 0};
      testing::set_principal(scene.body, 4e-5, 1.2e-4, 1.2e-4);
      scene.release.angular_velocity_body_rad_s = {150, 3, -2};
      scene.duration_s = 1;
      scene.output_step_s = 0.01;
    }
    if (i % 8 == 7) scene.rotation_rate_rad_s = 0;
    if (i % 8 == 1) scene.threshold_rad = 1e-6;
    scenes.push_back(scene);
  }
  return scenes;
}
template <class Problem>
std::vector<Problem> problems_of(const std::vector<Scenario>& scenes) {
  std::vector<Problem> problems;
  problems.reserve(scenes.size());
  for (const Scenario& scene : scenes) problems.push_back(Scene(scene).problem<double>());
  return problems;
}

/// Angle between two axes, and between two attitudes (rad).
double angle(const Vec3<double>& a, const Vec3<double>& b) { return std::atan2(norm(Vec3<double>(a.cross(b))), a.dot(b)); }
double angle(const Quaternion<double>& p, const Quaternion<double>& q) {
  const Quaternion<double> d = p.conjugate() * q;
  return 2 * std::atan2(norm(d.v), std::abs(d.w));
}

TEST(MotionLanes, AreTheScalarSeries) {
  const std::vector<Scenario> scenes = tops(40);
  const auto problems = problems_of<MotionProblem<double>>(scenes);
  const IntegrationOptions options = reduced(Method::taylor, Observer::laboratory);
  const auto attitudes = integrate_motion_in_lanes(problems, options);
  const auto axes = integrate_motion_in_lanes(problems, options, MotionSought::symmetry_axis);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    SCOPED_TRACE(i);
    const auto scalar = integrate_motion(problems[i], options);
    const int axis = reduced_top(problems[i].model).axis;
    ASSERT_EQ(attitudes[i].status, RunStatus::completed);
    ASSERT_EQ(attitudes[i].samples.size(), scalar.samples.size());
    ASSERT_EQ(axes[i].samples.size(), scalar.samples.size());
    for (std::size_t row = 0; row < scalar.samples.size(); ++row) {
      const auto &expected = scalar.samples[row], &got = attitudes[i].samples[row];
      ASSERT_EQ(got.t_s, expected.t_s);
      ASSERT_LT(angle(got.q_LB, expected.q_LB), kRounding);
      ASSERT_LT(norm(Vec3<double>(got.w_LB_B - expected.w_LB_B)), kRounding * (norm(expected.w_LB_B) + 10));
      ASSERT_LT(angle(rotation_matrix(axes[i].samples[row].q_LB).col(axis), rotation_matrix(expected.q_LB).col(axis)),
                kRounding);
    }
  }
}

#if defined(__GLIBC__)
/// Lanes without a point compute with numbers that are none. A host that traps exceptions does not see them, nor are its traps
/// and flags others afterwards.
TEST(Lanes, RaiseNoTraps) {
  const std::vector<Scenario> scenes = tops(11);
  const auto motions = problems_of<MotionProblem<double>>(scenes);
  const auto drifts = problems_of<DriftProblem<double>>(scenes);
  const IntegrationOptions options = reduced(Method::taylor, Observer::laboratory);
  IntegrationOptions general = reduced(Method::taylor, Observer::body);
  general.form = ModelForm::general;
  constexpr int kTraps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
  for (const InstructionSet set : instruction_sets()) {
    const auto numbers = [&] {
      std::vector<std::vector<std::uint64_t>> bits;
      for (const MotionSought sought : {MotionSought::attitude, MotionSought::symmetry_axis})
        for (const auto& one : integrate_motion_in_lanes(motions, options, sought, {}, set)) bits.push_back(bits_of(one));
      for (const auto& one : integrate_drift_in_lanes(drifts, options, {}, set)) bits.push_back(bits_of(one));
      for (const auto& one : integrate_drift_in_lanes(drifts, general, {}, set)) bits.push_back(bits_of(one));
      return bits;
    };
    const auto expected = numbers();
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(kTraps);
    const int before = fegetexcept();
    const auto got = numbers();
    const int after = fegetexcept(), raised = std::fetestexcept(kTraps);
    fedisableexcept(kTraps);
    EXPECT_EQ(got, expected);
    EXPECT_EQ(after, before);
    EXPECT_EQ(raised, 0);
  }
}
#endif

TEST(MotionLanes, OfAnyToleranceMeetIt) {
  const auto problems = problems_of<MotionProblem<double>>(tops(16));
  const auto fine = integrate_motion_in_lanes(problems, reduced(Method::taylor, Observer::laboratory, 1e-14));
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto coarse = integrate_motion_in_lanes(problems, reduced(Method::taylor, Observer::laboratory, tolerance));
    for (std::size_t i = 0; i < problems.size(); ++i) {
      EXPECT_LT(angle(coarse[i].samples.back().q_LB, fine[i].samples.back().q_LB), tolerance) << i;
      EXPECT_LT(coarse[i].counters.evaluations, fine[i].counters.evaluations);
    }
  }
}

/// Compares with the scalar series, and with another method in other equations.
TEST(DriftLanes, AreTheScalarSeriesInBothAxes) {
  const std::vector<Scenario> scenes = tops(40);
  const auto problems = problems_of<DriftProblem<double>>(scenes);
  const auto laboratory = integrate_drift_in_lanes(problems, reduced(Method::taylor, Observer::laboratory));
  const auto inertial = integrate_drift_in_lanes(problems, reduced(Method::taylor, Observer::inertial));
  for (std::size_t i = 0; i < problems.size(); ++i) {
    SCOPED_TRACE(i);
    const auto scalar = integrate_drift(problems[i], reduced(Method::taylor, Observer::laboratory));
    IntegrationOptions general = reduced(Method::extrapolation, Observer::body);
    general.form = ModelForm::general;
    const auto other = integrate_drift(problems[i], general);
    const double largest = std::max_element(scalar.samples.begin(), scalar.samples.end(), [](const auto& a, const auto& b) {
                             return a.measures.attitude < b.measures.attitude;
                           })->measures.attitude;
    const double slack = kOfDrift * largest;
    for (const auto* lanes : {&laboratory[i], &inertial[i]}) {
      ASSERT_EQ(lanes->status, RunStatus::completed);
      ASSERT_EQ(lanes->samples.size(), scalar.samples.size());
      ASSERT_EQ(lanes->threshold.has_value(), scalar.threshold.has_value());
      if (scalar.threshold) {
        const auto &passing = lanes->threshold->passing, &expected = scalar.threshold->passing;
        ASSERT_EQ(passing.has_value(), expected.has_value());
        // The drifts' slack, as time; and the rounding of the time.
        if (expected) {
          EXPECT_NEAR(passing->t, expected->t, slack / expected->rate + kTolerance * expected->t);
        }
      }
      for (std::size_t row = 0; row < scalar.samples.size(); ++row) {
        const auto &got = lanes->samples[row], &expected = scalar.samples[row];
        ASSERT_EQ(got.state.t_s, expected.state.t_s);
        ASSERT_NEAR(got.measures.axis, expected.measures.axis, slack) << row;
        ASSERT_NEAR(got.measures.attitude, expected.measures.attitude, slack) << row;
        ASSERT_NEAR(got.spin, expected.spin, slack) << row;
        ASSERT_LT(angle(got.state.q_LB, expected.state.q_LB), kRounding);
        ASSERT_LT(angle(got.state.ref_q_LB, expected.state.ref_q_LB), kRounding);
        ASSERT_NEAR(got.measures.axis, other.samples[row].measures.axis, slack + kTolerance) << row;
        if (expected.measures.azimuth_defined) {
          ASSERT_NEAR(got.azimuth, expected.azimuth, 10 * kRounding);  // tilts of a tenth and more
        }
      }
    }
  }
}

/// Angles that go round are counted between rows, however few: the steps in between are looked at only now and then.
TEST(DriftLanes, CountTurnsBetweenRows) {
  std::vector<Scenario> scenes = tops(40);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scenes[i].threshold_rad.reset();
    if (i % 8 == 2) {
      scenes[i] = testing::toy_top();
      scenes[i].rotation_rate_rad_s = 2;  // the azimuth goes round in 4 s
      scenes[i].duration_s = 5 + static_cast<double>(i) / 8;
    }
  }
  const auto problems = problems_of<DriftProblem<double>>(scenes);
  auto few = problems;
  for (DriftProblem<double>& problem : few) problem.times_s = {0, problem.times_s.back()};
  const IntegrationOptions options = reduced(Method::taylor, Observer::laboratory);
  const auto all_rows = integrate_drift_in_lanes(problems, options), two_rows = integrate_drift_in_lanes(few, options);
  int rounds = 0;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const auto &expected = all_rows[i].samples.back(), &got = two_rows[i].samples.back();
    EXPECT_EQ(got.spin, expected.spin) << i;
    EXPECT_EQ(got.azimuth, expected.azimuth) << i;
    if (std::abs(got.spin) > 4 || std::abs(got.azimuth) > 4) ++rounds;
  }
  EXPECT_GT(rounds, 0);  // else nothing was counted
}

/// The values that a bound compares do not depend on whether the rest of a row is sought too.
TEST(DriftLanes, GiveTheSameDistancesAlone) {
  const auto problems = problems_of<DriftProblem<double>>(tops(16));
  auto lean = problems;
  for (DriftProblem<double>& problem : lean) problem.sought = DriftSought::distances;
  for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
    const IntegrationOptions options = reduced(Method::taylor, observer);
    const auto rows = integrate_drift_in_lanes(problems, options), distances = integrate_drift_in_lanes(lean, options);
    for (std::size_t i = 0; i < problems.size(); ++i) {
      ASSERT_EQ(distances[i].samples.size(), rows[i].samples.size());
      for (std::size_t row = 0; row < rows[i].samples.size(); ++row) {
        const auto &expected = rows[i].samples[row], &got = distances[i].samples[row];
        ASSERT_EQ(got.measures.axis, expected.measures.axis);
        ASSERT_EQ(got.measures.attitude, expected.measures.attitude);
        ASSERT_EQ(got.measures.axis_difference_L_scaled, expected.measures.axis_difference_L_scaled);
        ASSERT_EQ(got.measures.attitude_vector_L_scaled, expected.measures.attitude_vector_L_scaled);
        ASSERT_EQ(got.state.q_LB.v, expected.state.q_LB.v);
      }
    }
  }
}

/// Bodies with any inertia, along the body axes or not.
std::vector<DriftProblem<double>> any_bodies(std::size_t count) {
  std::vector<Scenario> scenes;
  scenes.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    scenes.push_back(testing::random_scene(i, 10.0 + 5.0 * static_cast<double>(i % 7)));
    if (i % 9 == 4) {
      scenes.back() = testing::asymmetric_top();
      scenes.back().body.inertia_kg_m2 = {{{1.2e-4, 1e-5, -4e-6}, {1e-5, 1.05e-4, 3e-6}, {-4e-6, 3e-6, 4e-5}}};
      scenes.back().body.center_of_mass_m = {0.004, -0.003, 0.03};
      scenes.back().rotation_rate_rad_s = 0.3;
      scenes.back().duration_s = 0.5;
    }
  }
  return problems_of<DriftProblem<double>>(scenes);
}
IntegrationOptions general(Method method, Observer observer, double tolerance = kTolerance) {
  IntegrationOptions options = reduced(method, observer, tolerance);
  options.form = ModelForm::general;
  return options;
}

TEST(GeneralDriftLanes, AreTheScalarSeriesSeenFromBoth) {
  const auto problems = any_bodies(60);
  const auto body = integrate_drift_in_lanes(problems, general(Method::taylor, Observer::body));
  const auto inertial = integrate_drift_in_lanes(problems, general(Method::taylor, Observer::inertial));
  for (std::size_t i = 0; i < problems.size(); ++i) {
    SCOPED_TRACE(i);
    const auto scalar = integrate_drift(problems[i], general(Method::taylor, Observer::body));
    const auto other = integrate_drift(problems[i], general(Method::extrapolation, Observer::laboratory));
    const double largest = std::max_element(scalar.samples.begin(), scalar.samples.end(), [](const auto& a, const auto& b) {
                             return a.measures.attitude < b.measures.attitude;
                           })->measures.attitude;
    const double slack = kOfDrift * largest;
    for (const auto* lanes : {&body[i], &inertial[i]}) {
      ASSERT_EQ(lanes->status, RunStatus::completed);
      ASSERT_EQ(lanes->samples.size(), scalar.samples.size());
      for (std::size_t row = 0; row < scalar.samples.size(); ++row) {
        const auto &got = lanes->samples[row], &expected = scalar.samples[row];
        ASSERT_EQ(got.state.t_s, expected.state.t_s);
        ASSERT_NEAR(got.measures.axis, expected.measures.axis, slack) << row;
        ASSERT_NEAR(got.measures.attitude, expected.measures.attitude, slack) << row;
        ASSERT_NEAR(got.spin, expected.spin, slack) << row;
        ASSERT_LT(angle(got.state.q_LB, expected.state.q_LB), kRounding);
        ASSERT_LT(angle(got.state.ref_q_LB, expected.state.ref_q_LB), kRounding);
        ASSERT_LT(norm(Vec3<double>(got.state.w_LB_B - expected.state.w_LB_B)), kRounding * (norm(expected.state.w_LB_B) + 10));
        ASSERT_NEAR(got.measures.axis, other.samples[row].measures.axis, slack + kTolerance) << row;
      }
    }
  }
}

/// The bits of a point do not depend on its neighbours, its place, the number of points, or the instruction set.
template <class Integrate>
void expect_own_bits(std::size_t count, const Integrate& integrate) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  const auto expected = integrate(all, InstructionSet::baseline);
  for (const InstructionSet set : instruction_sets()) {
    SCOPED_TRACE(to_string(set));
    EXPECT_EQ(integrate(all, set), expected);
    for (const std::size_t some : {std::size_t{1}, std::size_t{3}, std::size_t{8}, std::size_t{9}}) {
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0; i < some; ++i) chosen.push_back((i * 37 + 11 * some) % count);
      const auto got = integrate(chosen, set);
      for (std::size_t i = 0; i < some; ++i) EXPECT_EQ(got[i], expected[chosen[i]]) << some << " " << i;
    }
    std::vector<std::size_t> backwards(all.rbegin(), all.rend());
    auto got = integrate(backwards, set);
    std::reverse(got.begin(), got.end());
    EXPECT_EQ(got, expected);
  }
}

TEST(MotionLanes, HaveBitsOfTheirOwn) {
  const auto problems = problems_of<MotionProblem<double>>(tops(100));
  for (const MotionSought sought : {MotionSought::symmetry_axis, MotionSought::attitude})
    expect_own_bits(problems.size(), [&](const std::vector<std::size_t>& chosen, InstructionSet set) {
      std::vector<MotionProblem<double>> some;
      for (const std::size_t i : chosen) some.push_back(problems[i]);
      std::vector<std::vector<std::uint64_t>> bits;
      for (const auto& trajectory :
           integrate_motion_in_lanes(some, reduced(Method::taylor, Observer::laboratory, 1e-10), sought, nullptr, set))
        bits.push_back(bits_of(trajectory));
      return bits;
    });
}

void expect_own_drift_bits(const std::vector<DriftProblem<double>>& problems, const IntegrationOptions& options) {
  expect_own_bits(problems.size(), [&](const std::vector<std::size_t>& chosen, InstructionSet set) {
    std::vector<DriftProblem<double>> some;
    for (const std::size_t i : chosen) some.push_back(problems[i]);
    std::vector<std::vector<std::uint64_t>> bits;
    for (const auto& trajectory : integrate_drift_in_lanes(some, options, nullptr, set)) bits.push_back(bits_of(trajectory));
    return bits;
  });
}

TEST(DriftLanes, HaveBitsOfTheirOwn) {
  const auto problems = problems_of<DriftProblem<double>>(tops(100));
  for (const Observer observer : {Observer::laboratory, Observer::inertial})
    expect_own_drift_bits(problems, reduced(Method::taylor, observer, 1e-10));
}

TEST(GeneralDriftLanes, HaveBitsOfTheirOwn) {
  const auto problems = any_bodies(60);
  for (const Observer observer : {Observer::body, Observer::inertial})
    expect_own_drift_bits(problems, general(Method::taylor, observer, 1e-10));
}

/// A point that overflows, one whose release is not a number, and one beyond its step limit fail alone.
TEST(DriftLanes, LeaveTroubleWhereItIs) {
  const auto sound = problems_of<DriftProblem<double>>(tops(20));
  IntegrationOptions options = reduced(Method::taylor, Observer::laboratory, 1e-10);
  options.step_limit = 2000;
  const auto expected = integrate_drift_in_lanes(sound, options);
  auto problems = sound;
  problems[2].model.apparent_gravity_L[2] = std::numeric_limits<double>::infinity();
  problems[6].release.w_XB_B[0] = std::numeric_limits<double>::quiet_NaN();
  problems[11].model.mass_moment_B *= 1e200;
  Scenario longer = testing::toy_top();
  longer.duration_s = 100;
  problems[13] = Scene(longer).problem<double>();
  for (const InstructionSet set : instruction_sets()) {
    const auto got = integrate_drift_in_lanes(problems, options, nullptr, set);
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const RunStatus status = got[i].status;
      if (i == 2 || i == 6)
        EXPECT_EQ(status, RunStatus::not_finite) << i;
      else if (i == 11)
        EXPECT_NE(status, RunStatus::completed);
      else if (i == 13)
        EXPECT_EQ(status, RunStatus::step_limit);
      else
        EXPECT_EQ(bits_of(got[i]), bits_of(expected[i])) << i;
    }
    EXPECT_TRUE(got[6].samples.empty());
    EXPECT_EQ(got[13].counters.accepted, options.step_limit);
    EXPECT_GT(got[13].samples.size(), 10U);
  }
}

TEST(RecordedLanes, HaveBitsOfTheirOwn) {
  for (const auto& [problems, options] : testing::driven_drifts(48, kTolerance)) expect_own_drift_bits(problems, options);
}

TEST(DriftLanes, StopWhenAsked) {
  const auto problems = problems_of<DriftProblem<double>>(tops(10));
  const std::atomic<bool> stop = true;
  for (const auto& trajectory : integrate_drift_in_lanes(problems, reduced(Method::taylor, Observer::laboratory), &stop)) {
    EXPECT_EQ(trajectory.status, RunStatus::interrupted);
    EXPECT_EQ(trajectory.samples.size(), 1U);
  }
}

TEST(DriftLanes, RefuseWhatDoesNotHaveTheForm) {
  const std::vector<DriftProblem<double>> asymmetric{Scene(testing::asymmetric_top()).problem<double>()};
  EXPECT_THROW(integrate_drift_in_lanes(asymmetric, reduced(Method::taylor, Observer::laboratory)), std::logic_error);
  EXPECT_THROW(integrate_drift_in_lanes(asymmetric, general(Method::taylor, Observer::laboratory)), std::logic_error);
  const auto symmetric = problems_of<DriftProblem<double>>(tops(1));
  EXPECT_THROW(integrate_drift_in_lanes(symmetric, reduced(Method::taylor, Observer::body)), std::logic_error);
  EXPECT_TRUE(integrate_drift_in_lanes({}, reduced(Method::taylor, Observer::laboratory)).empty());
}

}  // namespace
}  // namespace earthtop
