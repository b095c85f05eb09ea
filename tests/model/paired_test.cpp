// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the difference that paired numbers carry with a subtraction in 113 bits.
#include "earthtop/model/paired.hpp"

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "earthtop/scene/scene.hpp"
#include "frames/random_cases.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

using test::at_most;
using test::close;
using test::Random;

constexpr double kEpsilons[] = {1e-3, 1e-6, 1e-9, 1e-12};

/// A number in both predictions: its exact values, and the pair that carries it.
struct Both {
  float128 ref, rot;
  Paired<double> carried;
  Both(double at, double difference, double epsilon)
      : ref(at), rot(ref + float128(epsilon) * float128(difference)), carried(at, static_cast<double>(rot), difference) {}
};

/// @param conditioning factor by which an operation's own terms cancel
::testing::AssertionResult carried(const Paired<double>& result, float128 ref, float128 rot, double epsilon,
                                   double conditioning = 1) {
  const float128 difference = (rot - ref) / float128(epsilon);
  const float128 bound = float128(16 * 2.3e-16 * conditioning);
  if (auto r = close(float128(result.ref), ref, bound * real::abs(ref)); !r) return r << " of the reference";
  if (auto r = close(float128(result.rot), rot, bound * real::abs(rot)); !r) return r << " of the rotating motion";
  return close(float128(result.diff), difference, bound * real::abs(difference)) << " of the difference";
}

TEST(Paired, EveryOperationCarriesItsDifference) {
  using real::abs, real::fifth_root, real::sqrt;
  Random random(301);
  for (const double epsilon : kEpsilons)
    for (int k = 0; k < 20; ++k) {
      const double sign = random.integer(0, 1) == 0 ? 1 : -1;
      // The numbers have one sign, so that no operation's terms cancel by more than half.
      const Both x(random.uniform(1, 3), random.uniform(4, 5), epsilon), y(sign * random.uniform(1, 3), sign, epsilon);
      const auto p = x.carried, q = y.carried;
      constexpr double kTerms = 8;  // both terms of a sum, over the least of the sum
      EXPECT_TRUE(carried(p + q, x.ref + y.ref, x.rot + y.rot, epsilon, 1e3));
      EXPECT_TRUE(carried(p - q, x.ref - y.ref, x.rot - y.rot, epsilon, 1e3));
      EXPECT_TRUE(carried(-p, -x.ref, -x.rot, epsilon));
      EXPECT_TRUE(carried(p * q, x.ref * y.ref, x.rot * y.rot, epsilon));
      EXPECT_TRUE(carried(p / q, x.ref / y.ref, x.rot / y.rot, epsilon, kTerms));
      EXPECT_TRUE(carried(sqrt(p), sqrt(x.ref), sqrt(x.rot), epsilon));
      EXPECT_TRUE(carried(abs(q), abs(y.ref), abs(y.rot), epsilon));
      EXPECT_TRUE(carried(fifth_root(p), fifth_root(x.ref), fifth_root(x.rot), epsilon));
      Paired<double> changed = p;
      changed += q, changed *= p, changed -= p;
      EXPECT_TRUE(carried(changed, (x.ref + y.ref) * x.ref - x.ref, (x.rot + y.rot) * x.rot - x.rot, epsilon, 1e3));
    }
}

TEST(Paired, APairOfUnlikeSignsHasItsSizesDifference) {
  for (const double epsilon : kEpsilons) {
    const Both x(-0.25 * epsilon, 2, epsilon), y(0.25 * epsilon, -2, epsilon);
    EXPECT_TRUE(carried(real::abs(x.carried), -x.ref, x.rot, epsilon));
    EXPECT_TRUE(carried(real::abs(y.carried), y.ref, -y.rot, epsilon));
  }
  EXPECT_EQ(real::abs(Paired<double>(0, 0, 0)).diff, 0);
  EXPECT_EQ(real::abs(Paired<double>(0, -1e-3, -1)).diff, 1);
  EXPECT_EQ(real::sqrt(Paired<double>(0, 0, 0)).diff, 0);
  EXPECT_EQ(real::fifth_root(Paired<double>(0, 0, 0)).diff, 0);
  EXPECT_NEAR(real::fifth_root(Paired<double>(0, 32, 64)).diff, 4, 1e-14);  // 2 over 1/2
  EXPECT_FALSE(is_above_zero(Paired<double>(0, 1, 1)));
  EXPECT_FALSE(is_above_zero(Paired<double>(1, 0, -1)));
}

TEST(Paired, EqualValuesGiveTheDerivative) {
  const Paired<double> x(2, 2, 1);
  EXPECT_NEAR(real::sqrt(x).diff, 0.5 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(real::fifth_root(x).diff, 0.2 * std::pow(2, -0.8), 1e-15);
  EXPECT_EQ((x * x * x).diff, 12);
  EXPECT_EQ((Paired<double>(1) / x).diff, -0.25);
}

/// A scene with all applied torques, or with those that a gimbal allows.
Scenario all_torques(Random& random, bool gimbal, bool turbulent) {
  Scenario scenario = testing::asymmetric_top();
  scenario.body.center_of_mass_m = {0.001, 0.002, 0.03};
  scenario.body.inertia_kg_m2 = {{{1.2e-4, 3e-6, 0}, {3e-6, 1.05e-4, -2e-6}, {0, -2e-6, 4e-5}}};
  scenario.site.latitude_deg = random.uniform(-90, 90);
  AppliedTorquesSpec& applied = scenario.effects.applied;
  applied.viscous_N_m_s = 1e-6;
  applied.quadratic_N_m_s2 = 1e-6;
  applied.gravity_gradient = GravityGradientSpec{GradientField::given, 0.1};
  applied.air_drag = AirDragSpec{0.1, 1.2, 1.5e-5, turbulent ? DiscFlow::turbulent : DiscFlow::laminar};
  if (gimbal) {
    applied.gimbal = GimbalSpec{1e-5};
    scenario.effects.coriolis = false;
  } else {
    applied.coulomb_N_m = 1e-5;
  }
  PlatformSpec& platform = scenario.platform.emplace();
  platform.motion = PlatformMotion::harmonic;
  platform.axis = {0.1, -0.2, 1};
  platform.amplitude_rad = 0.3;
  platform.frequency_hz = 0.25;
  platform.pivot_offset_m = {0.1, 0, 0.05};
  return scenario;
}

template <class T, class S>
Vec3<T> cast(const Vec3<S>& v) {
  return Vec3<T>(T(v[0]), T(v[1]), T(v[2]));
}

TEST(Paired, TheTorquesDifferenceIsThatOfTheTorques) {
  using Q = float128;
  Random random(302);
  for (const double epsilon : {1e-3, 1e-5, 1e-7, 1e-9, 1e-12})
    for (const int kind : {0, 1, 2, 3}) {
      Scenario scenario = all_torques(random, kind >= 2, kind % 2 == 1);
      scenario.rotation_rate_rad_s = epsilon;  // below 1, so that it is the model's epsilon
      const auto model = resolve(scenario).model<double>();
      const auto exact = resolve(scenario).model<Q>();
      ASSERT_EQ(model.epsilon, epsilon);
      const double t = random.uniform(0, 4);
      const auto ref_q = random.quaternion<double>();
      const auto ref_w = random.vector<double>(60), y = random.vector<double>(), Dw = random.vector<double>(3);
      const Vec3<Q> e_v = Q(epsilon) * cast<Q>(y);
      const Q e_w = real::sqrt(Q(1) - e_v.dot(e_v));
      const Vec3<Paired<double>> torques = applied_torques_B(model, t, ref_q, ref_w, static_cast<double>(e_w), y, Dw);
      const Quaternion<Q> q_ref{Q(ref_q.w), cast<Q>(ref_q.v)}, q_rot = q_ref * Quaternion<Q>{e_w, e_v};
      const Vec3<Q> W_B = transposed_times(rotation_matrix(q_rot), exact.W_IL_L);
      const Vec3<Q> w_LB_rot = cast<Q>(ref_w) + Q(epsilon) * cast<Q>(Dw) - W_B;
      const Vec3<Q> on_ref = applied_torque_B(exact, Q(t), q_ref, cast<Q>(ref_w), false);
      const Vec3<Q> on_rot = applied_torque_B(exact, Q(t), q_rot, w_LB_rot, true);
      const Vec3<Q> difference = (on_rot - on_ref) / Q(epsilon);
      const Vec3<Q> ref = cast<Q>(parts(torques, &Paired<double>::ref)), rot = cast<Q>(parts(torques, &Paired<double>::rot));
      const Vec3<Q> carried = cast<Q>(parts(torques, &Paired<double>::diff));
      EXPECT_TRUE(close<Q>(ref, on_ref, Q(1e-13) * norm(on_ref))) << epsilon << " " << kind;
      EXPECT_TRUE(close<Q>(rot, on_rot, Q(1e-13) * norm(on_rot))) << epsilon << " " << kind;
      EXPECT_TRUE(close<Q>(carried, difference, Q(1e-12) * norm(difference))) << epsilon << " " << kind;
    }
}

}  // namespace
}  // namespace earthtop
