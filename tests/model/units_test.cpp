// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/model/equations.hpp"
#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Random;

BodySpec any_body(Random& random) {
  BodySpec spec;
  spec.mass_kg = random.uniform(0.01, 10);
  for (double& c : spec.center_of_mass_m) c = random.uniform(-0.1, 0.1);
  spec.inertia_about = InertiaAbout::center_of_mass;
  for (std::size_t i = 0; i < 3; ++i) spec.inertia_kg_m2[i][i] = random.uniform(1e-4, 1.9e-4);
  spec.inertia_kg_m2[0][1] = spec.inertia_kg_m2[1][0] = random.uniform(-1e-5, 1e-5);
  return spec;
}
PlatformSpec any_platform(Random& random, PlatformMotion motion) {
  PlatformSpec spec;
  spec.motion = motion;
  for (double& c : spec.axis) c = random.uniform(0.1, 1);
  for (double& c : spec.pivot_offset_m) c = random.uniform(-1, 1);
  spec.rate_rad_s = random.uniform(-2, 2), spec.acceleration_rad_s2 = random.uniform(-2, 2);
  spec.amplitude_rad = random.uniform(0.1, 1), spec.frequency_hz = random.uniform(0.1, 3),
  spec.phase_deg = random.uniform(0, 360);
  return spec;
}
Release<double> spinning(const Vec3<double>& w) {
  Release<double> release;
  release.w_XB_B = w;
  return release;
}

TEST(NaturalUnits, PutTheLargestMomentAndTheFastestRateNearOne) {
  Random random(601);
  for (int k = 0; k < 100; ++k) {
    const Body<double> body = make_body<double>(any_body(random));
    const double gravity = k % 5 == 0 ? 0 : random.uniform(0.1, 20), earth = std::pow(10, random.uniform(-8, 3));
    const Vec3<double> w = random.vector<double>(std::pow(10, random.uniform(-6, 4)));
    const NaturalUnits units = natural_units(body, spinning(w), gravity, -earth, nullptr);
    const double moment = body.I_BP_B.diagonal().maxCoeff();
    const double pendulum = std::sqrt(body.mass * gravity * norm(body.p_PBcm_B) / moment);
    const double scaled = std::ldexp(moment, -units.mass_exponent);
    EXPECT_TRUE(scaled >= 0.5 && scaled < 1) << scaled;
    const double fastest = units.rate_from_rad_s(std::max({norm(w), pendulum, earth}));
    EXPECT_TRUE(fastest >= 0.5 && fastest < 1) << fastest;
    EXPECT_EQ(units.rate_to_rad_s(units.rate_from_rad_s(earth)), earth);
    EXPECT_EQ(units.time_from_s(3.0) * units.rate_from_rad_s(earth), 3 * earth);  // angles have no unit
  }
  // Nothing moves: seconds stay seconds.
  BodySpec balanced = any_body(random);
  balanced.center_of_mass_m = {0, 0, 0};
  EXPECT_EQ(natural_units(make_body<double>(balanced), spinning(Vec3<double>::Zero()), 9.8, 0, nullptr).time_exponent, 0);
  // Where next to nothing moves, gravity in natural units is finite.
  for (const double rate : {1e-300, 5e-324}) {
    const NaturalUnits slow = natural_units(make_body<double>(balanced), spinning(Vec3<double>::Zero()), 9.8, rate, nullptr);
    EXPECT_EQ(slow.time_exponent, 299);
    EXPECT_TRUE(std::isfinite(real::scale(9.8, 2 * slow.time_exponent)));
  }
  // A platform's rate counts too.
  Platform<double> table;
  table.turn.rate = -1000;
  const NaturalUnits units = natural_units(make_body<double>(balanced), spinning(Vec3<double>(1, 0, 0)), 0, 0, &table);
  EXPECT_EQ(units.time_exponent, -10);  // 1000 = 0.98 x 2^10
}

/// Every number of `a`, in units of 2^exponent, is that of `b`.
template <class A, class B>
::testing::AssertionResult scaled_exactly(const A& si, const B& natural, int exponent) {
  using T = typename A::Scalar;
  Eigen::Matrix<T, A::RowsAtCompileTime, A::ColsAtCompileTime> expected = si;
  for (int i = 0; i < expected.rows(); ++i)
    for (int j = 0; j < expected.cols(); ++j) expected(i, j) = real::scale(expected(i, j), exponent);
  return identical(natural, expected);
}

TEST(NaturalUnits, ChangeNoDigitOfTheModelNorOfItsEquations) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(602);
    for (const double earth : {7.292115e-5, -0.7, 0.0, 1e-250, 40.0})
      for (const int with_platform : {0, 1, 2, 3}) {
        const BodySpec spec = any_body(random);
        const Body<T> body = make_body<T>(spec);
        const Site site{random.uniform(-90, 90), 0, 0, random.uniform(1, 20)};
        const PlatformSpec table = any_platform(random, static_cast<PlatformMotion>(std::max(0, with_platform - 1)));
        const Platform<T> platform = make_platform<T>(table);
        const Platform<double> platform_double = make_platform<double>(table);
        const Platform<T>* carried = with_platform == 0 ? nullptr : &platform;
        const Vec3<double> spin = random.vector<double>(500);
        const NaturalUnits units = natural_units(make_body<double>(spec), spinning(spin), site.gravity_m_s2, earth,
                                                 with_platform == 0 ? nullptr : &platform_double);
        const TorqueWeights<T> weights;
        const Model<T> si = make_model<T>(body, site, earth, weights, carried),
                       natural = make_model<T>(body, site, earth, weights, carried, units);
        const int mass = units.mass_exponent, time = units.time_exponent;
        ASSERT_NE(mass, 0);
        ASSERT_NE(time, 0);
        EXPECT_TRUE(scaled_exactly(si.I_BP_B, natural.I_BP_B, -mass));
        EXPECT_TRUE(scaled_exactly(si.I_BP_B_inverse, natural.I_BP_B_inverse, mass));
        EXPECT_TRUE(scaled_exactly(si.S_BP_B, natural.S_BP_B, -mass));
        EXPECT_TRUE(scaled_exactly(si.mass_moment_B, natural.mass_moment_B, -mass));
        EXPECT_TRUE(scaled_exactly(si.apparent_gravity_L, natural.apparent_gravity_L, 2 * time));
        EXPECT_TRUE(scaled_exactly(si.W_IL_L, natural.W_IL_L, time));
        EXPECT_TRUE(identical(Vec3<T>(natural.epsilon * natural.W_IL_L_scaled), natural.W_IL_L));
        EXPECT_EQ(natural.kind, with_platform == 0 ? SceneKind::plain : SceneKind::full);
        EXPECT_EQ(si.kind, natural.kind);

        const T t = T(random.uniform(0, 10));
        const PivotField<T> field = pivot_field<SceneKind::full>(si, t),
                            natural_field = pivot_field<SceneKind::full>(natural, units.time_from_s(t));
        EXPECT_TRUE(scaled_exactly(field.rotating_L, natural_field.rotating_L, 2 * time) || real::abs(T(earth)) >= T(1));
        EXPECT_TRUE(scaled_exactly(field.reference_L, natural_field.reference_L, 2 * time));

        Motion<T> x{random.quaternion<T>(1.5), random.vector<T>(200)}, natural_x{x.q, units.rate_from_rad_s(x.m)};
        const Motion<T> rate = body_equation<true, SceneKind::full, T>(si, x, field.reference_L),
                        natural_rate = body_equation<true, SceneKind::full, T>(natural, natural_x, natural_field.reference_L);
        EXPECT_TRUE(scaled_exactly(rate.m, natural_rate.m, 2 * time));
        EXPECT_TRUE(scaled_exactly(rate.q.v, natural_rate.q.v, time));
        if (real::abs(T(earth)) < T(1)) {  // above, epsilon is 1 in one of the two and products round elsewhere
          x.m *= T(1e-4), natural_x.m = x.m;
          for (int i = 0; i < 3; ++i) natural_x.m[i] = real::scale(x.m[i], time - mass);
          EXPECT_TRUE(scaled_exactly(Vec3<T>(non_inertial_torque<SceneKind::full>(si, x)),
                                     Vec3<T>(non_inertial_torque<SceneKind::full>(natural, natural_x)), 2 * time - mass));
        }
      }
  });
}

// Whoever makes a problem gives its release in rad/s, whatever the units of its model are.
TEST(NaturalUnits, ChangeNoMotionOfAProblemMadeByHand) {
  Random random(604);
  const Body<double> body = make_body<double>(any_body(random));
  const Site site{40, 0, 0, 9.8};
  for (const RatesRelativeTo X : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial})
    for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial}) {
      const double earth = 0.3, fastest = 60;
      const auto problem_in = [&](const NaturalUnits& units) {
        MotionProblem<double> problem;
        problem.model = make_model<double>(body, site, earth, {}, nullptr, units);
        problem.release = {Quaternion<double>{0.8, Vec3<double>(0, 0.6, 0)}, Vec3<double>(1, -2, 40), X};
        problem.units = units;
        problem.fastest_rate = units.rate_from_rad_s(fastest);
        problem.times_s = {0, 0.25, 0.5};
        return problem;
      };
      const NaturalUnits units{-7, -5};
      const MotionProblem<double> si = problem_in({}), natural = problem_in(units);
      const NaturalRelease<double> release = natural.natural_release();
      EXPECT_EQ(release.q_LB.w, natural.release.q_LB.w);
      EXPECT_EQ(release.q_LB.v, natural.release.q_LB.v);
      EXPECT_EQ(release.X, X);
      EXPECT_EQ(release.w_XB_B, Vec3<double>(1.0 / 32, -2.0 / 32, 40.0 / 32));
      const Vec3<double> W_B = rotation_matrix(release.q_LB).transpose() * natural.model.W_IL_L;
      const Vec3<double> w_IB_B = release.w_XB_B + (X == RatesRelativeTo::laboratory ? 1.0 : 0.0) * W_B;
      EXPECT_LT(norm(Vec3<double>(release.inertial_rate_B(natural.model.W_IL_L) - w_IB_B)), 1e-15);

      IntegrationOptions options;
      options.method = Method::dopri5, options.observer = observer, options.form = ModelForm::general;
      options.relative_tolerance = 1e-11;
      const MotionTrajectory<double> a = integrate_motion(si, options), b = integrate_motion(natural, options);
      ASSERT_EQ(a.samples.size(), 3u);
      ASSERT_EQ(b.samples.size(), 3u);
      // A hundred times the error of the steps, whose lengths depend a little on the units.
      constexpr double kOfSteps = 1e-8;
      for (std::size_t i = 0; i < 3; ++i) {
        const Quaternion<double> turn = a.samples[i].q_LB.conjugate() * b.samples[i].q_LB;
        EXPECT_LT(norm(turn.v), kOfSteps);
        EXPECT_LT(norm(Vec3<double>(a.samples[i].w_LB_B - b.samples[i].w_LB_B)), kOfSteps * fastest);
      }
    }
}

TEST(MakeModel, EarthRateIsKeptAsSizeTimesDirection) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(603);
    const Body<T> body = make_body<T>(any_body(random));
    const Site site{30, 0, 0, 9.8};
    for (const double rate : {7.292115e-5, -7.292115e-5, 1e-300, 0.0, 1.0, -2.5}) {
      const Model<T> model = make_model<T>(body, site, rate, {}, nullptr);
      const T least = std::abs(rate) < 1 && rate != 0 ? T(std::abs(rate)) : T(1);
      EXPECT_TRUE(close<T>(model.epsilon, least, T(0)));
      EXPECT_TRUE(identical(model.W_IL_L, Vec3<T>(T(rate) * celestial_axis_L<T>(site))));
      EXPECT_TRUE(identical(Vec3<T>(model.epsilon * model.W_IL_L_scaled), model.W_IL_L));
    }
  });
}

TEST(MakeModel, WeightsOrAPlatformMakeASceneFull) {
  Random random(604);
  const Body<double> body = make_body<double>(any_body(random));
  const Site site{30, 0, 0, 9.8};
  const Platform<double> table;
  const auto kind = [&](const TorqueWeights<double>& weights, const Platform<double>* platform) {
    return make_model<double>(body, site, 1, weights, platform).kind;
  };
  EXPECT_EQ(kind({1, 1, 1}, nullptr), SceneKind::plain);
  EXPECT_EQ(kind({0, 1, 1}, nullptr), SceneKind::full);
  EXPECT_EQ(kind({1, 0, 1}, nullptr), SceneKind::full);
  EXPECT_EQ(kind({1, 1, 0}, nullptr), SceneKind::full);
  EXPECT_EQ(kind({1, 1, 1}, &table), SceneKind::full);
  const TorqueWeights<double> others = TorqueWeights<double>{1, 0, 1}.complement();
  EXPECT_EQ(others.coriolis, 0);
  EXPECT_EQ(others.transverse, 1);
  EXPECT_EQ(others.centrifugal, 0);
}

TEST(PivotField, IsGravityLessThePivotsAcceleration) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(605);
    const Body<T> body = make_body<T>(any_body(random));
    for (const double rate : {1.0, 7.292115e-5, -0.25}) {
      const Platform<T> platform = make_platform<T>(any_platform(random, PlatformMotion::harmonic));
      const Model<T> model = make_model<T>(body, Site{30, 0, 0, 9.8}, rate, {}, &platform);
      const T t = T(random.uniform(0, 3));
      const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
      const PivotAcceleration<T> a = pivot_acceleration(platform, model.W_IL_L, model.W_IL_L, t);
      const Vec3<T> g(T(0), T(0), T(-9.8));
      const T bound = T(16) * real::epsilon<T>() * (T(10) + norm(a.of_platform_L) + norm(a.of_earth_rate_L));
      EXPECT_TRUE(close<T>(field.reference_L, Vec3<T>(g - a.of_platform_L), bound));
      EXPECT_TRUE(close<T>(field.rotating_L, Vec3<T>(g - a.of_platform_L - a.of_earth_rate_L), bound));
      // The difference to its own precision, not to that of the two fields.
      EXPECT_TRUE(close<T>(Vec3<T>(model.epsilon * field.difference_L_scaled), Vec3<T>(-a.of_earth_rate_L),
                           T(16) * real::epsilon<T>() * norm(a.of_earth_rate_L)));
    }
    const Model<T> plain = make_model<T>(body, Site{30, 0, 0, 9.8}, 1.0, {}, nullptr);
    EXPECT_TRUE(identical(pivot_field<SceneKind::plain>(plain, T(3)).rotating_L, plain.apparent_gravity_L));
    EXPECT_TRUE(identical(pivot_field<SceneKind::full>(plain, T(3)).rotating_L, plain.apparent_gravity_L));
    EXPECT_TRUE(identical(pivot_field<SceneKind::plain>(plain, T(3)).difference_L_scaled, Vec3<T>::Zero()));
  });
}

}  // namespace
}  // namespace earthtop
