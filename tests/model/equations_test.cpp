// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/equations.hpp"

#include "earthtop/model/invariants.hpp"
#include "frames/random_cases.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Random;

/// An asymmetric body with products of inertia, and its centre of mass off every axis.
BodySpec asymmetric() {
  BodySpec spec;
  spec.mass_kg = 0.5;
  spec.center_of_mass_m = {0.25, -0.125, 0.75};
  spec.inertia_kg_m2 = {{{1.5, 0.125, -0.0625}, {0.125, 1.75, 0.25}, {-0.0625, 0.25, 1.0}}};
  return spec;
}
template <class T>
Model<T> model_of(const BodySpec& spec, double latitude_deg, double earth_rate) {
  return make_model<T>(make_body<T>(spec), Site{latitude_deg, 0, 0, 9.75}, earth_rate, {}, nullptr);
}

/// Fourth-order Runge-Kutta from t = 0 in n equal steps.
template <class F>
Motion<float128> integrated(const F& f, Motion<float128> x, float128 duration, int n) {
  const auto moved = [](const Motion<float128>& from, float128 h, const Motion<float128>& by) {
    return Motion<float128>{{from.q.w + h * by.q.w, from.q.v + h * by.q.v}, from.m + h * by.m};
  };
  const float128 h = duration / n;
  for (int k = 0; k < n; ++k) {
    const float128 t = k * h;
    const Motion<float128> a = f(t, x), b = f(t + h / 2, moved(x, h / 2, a)), c = f(t + h / 2, moved(x, h / 2, b)),
                           d = f(t + h, moved(x, h, c));
    x = moved(moved(moved(moved(x, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
  return x;
}

TEST(Equations, ObserversAgree) {
  // Omega = 1 rad/s at latitude 50 deg, for 0.5 s: three integrations of three different variables.
  const Model<float128> model = model_of<float128>(asymmetric(), 50, 1);
  Random random(501);
  const Quaternion<float128> q = random.quaternion<float128>(1.5);
  const Vec3<float128> w_LB_B = random.vector<float128>(3), W_B = rotation_matrix(q).transpose() * model.W_IL_L;
  const Mat3<float128> R = rotation_matrix(q);
  const Vec3<float128> g = model.apparent_gravity_L;
  const float128 duration = float128(0.5);
  const auto in_laboratory = [&](float128, const Motion<float128>& x) {
    return laboratory_equation<float128>(model, x, g, non_inertial_torque<SceneKind::plain>(model, x));
  };
  const auto in_body = [&](float128, const Motion<float128>& x) {
    return body_equation<true, SceneKind::plain, float128>(model, x, g);
  };
  const auto in_space = [&](float128 t, const Motion<float128>& x) {
    return inertial_equation<true, SceneKind::plain, float128>(
        model, x, g, rotation_matrix(laboratory_turn(model, t).quaternion(model.epsilon)));
  };
  const Mat3<float128> R_NL = test::rodrigues<float128>(model.W_IL_L / norm(model.W_IL_L), duration * norm(model.W_IL_L));
  float128 C = 0;
  for (int n = 32; n <= 256; n *= 2) {
    const Motion<float128> laboratory = integrated(in_laboratory, {q, R * (model.I_BP_B * w_LB_B)}, duration, n);
    const Motion<float128> body = integrated(in_body, {q, w_LB_B + W_B}, duration, n);
    const Motion<float128> space = integrated(in_space, {q, R * (model.I_BP_B * (w_LB_B + W_B))}, duration, n);
    const Mat3<float128> R_LB = rotation_matrix(laboratory.q), R_LB_body = rotation_matrix(body.q),
                         R_LB_space = R_NL.transpose() * rotation_matrix(space.q);
    // Rates relative to the laboratory, in laboratory axes.
    const Vec3<float128> w = rate_from_momentum<float128>(model, R_LB, laboratory.m),
                         w_body = R_LB_body * body.m - model.W_IL_L,
                         w_space = R_NL.transpose() * rate_from_momentum<float128>(model, rotation_matrix(space.q), space.m) -
                                   model.W_IL_L;
    // Order 4: C from the first number of steps, and every halving divides the difference by 16, nearly.
    const float128 steps = float128(n) * n * n * n;
    float128 largest = 0;
    for (const Mat3<float128>& difference : {Mat3<float128>(R_LB - R_LB_body), Mat3<float128>(R_LB - R_LB_space)})
      largest = std::max(largest, difference.cwiseAbs().maxCoeff());
    for (const Vec3<float128>& difference : {Vec3<float128>(w - w_body), Vec3<float128>(w - w_space)})
      largest = std::max(largest, difference.cwiseAbs().maxCoeff());
    if (n == 32) C = largest * steps;
    EXPECT_LE(static_cast<double>(largest), static_cast<double>(float128(1.25) * C / steps)) << n;
    if (n == 256) {
      EXPECT_LE(static_cast<double>(largest), 1e-9);  // 2.4e-11 is what order 4 leaves in so many steps
      // The effect of the Earth's rate on this motion is far larger.
      const auto at_rest = [&](float128, const Motion<float128>& x) {
        return laboratory_equation<float128>(model, x, g, Vec3<float128>::Zero());
      };
      const Motion<float128> reference = integrated(at_rest, {q, R * (model.I_BP_B * w_LB_B)}, duration, n);
      EXPECT_GT(static_cast<double>((rotation_matrix(reference.q) - R_LB).cwiseAbs().maxCoeff()), 0.1);
    }
  }
}

TEST(Equations, AttitudeRatesAreHalfTheProduct) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(502);
    for (int k = 0; k < 50; ++k) {
      const Quaternion<T> q = random.quaternion<T>(1.5);
      const Vec3<T> w_B = random.vector<T>(3);
      const T bound = T(32) * real::epsilon<T>() * T(3 * 1.5);
      const Quaternion<T> product = q * Quaternion<T>{T(0), w_B / T(2)};
      for (const Quaternion<T>& rate :
           {attitude_rate_from_body(q, w_B), attitude_rate_from_outer(q, Vec3<T>(rotation_matrix(q) * w_B))}) {
        EXPECT_TRUE(close<T>(rate.w, product.w, bound));
        EXPECT_TRUE(close<T>(rate.v, product.v, bound));
      }
    }
  });
  // dR/dt = R [w_B]x, by differentiation along the flow.
  Random random(503);
  for (int k = 0; k < 10; ++k) {
    const Quaternion<float128> q = random.quaternion<float128>(1.5);
    const Vec3<float128> w_B = random.vector<float128>(3);
    const Quaternion<float128> rate = attitude_rate_from_body(q, w_B);
    const float128 h = float128(1e-5), W = 6;
    const Mat3<float128> Rdot = test::first_derivative(
        [&](float128 at) {
          return rotation_matrix(Quaternion<float128>{q.w + at * rate.w, q.v + at * rate.v});
        },
        float128(0), h);
    const float128 Wh = W * h;
    EXPECT_TRUE(close<float128>(Rdot, Mat3<float128>(rotation_matrix(q) * cross_matrix(w_B)),
                                W * Wh * Wh * Wh * Wh * Wh * Wh + 256 * real::epsilon<float128>() / h));
  }
}

TEST(Equations, WithoutTheEarthAllAreTheReference) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const Model<T> model = model_of<T>(asymmetric(), 50, 0);
    Random random(504);
    const Motion<T> x{random.quaternion<T>(), random.vector<T>(3)};
    const Vec3<T> g = model.apparent_gravity_L;
    const Motion<T> with = body_equation<true, SceneKind::plain, T>(model, x, g),
                    without = body_equation<false, SceneKind::plain, T>(model, x, g);
    EXPECT_TRUE(identical(with.m, without.m));
    EXPECT_TRUE(identical(with.q.v, without.q.v));
    EXPECT_TRUE(identical(non_inertial_torque<SceneKind::plain>(model, x), Vec3<T>::Zero()));
    const LaboratoryTurn<T> turn = laboratory_turn(model, T(1e6));
    EXPECT_TRUE(identical(rotation_matrix(turn.quaternion(model.epsilon)), Mat3<T>::Identity()));
  });
}

TEST(Equations, EulersComponentsInPrincipalAxes) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    BodySpec spec;
    spec.mass_kg = 2;
    spec.inertia_kg_m2 = {{{2, 0, 0}, {0, 4, 0}, {0, 0, 5}}};
    const Model<T> model = model_of<T>(spec, 0, 0);
    // Free: wdot = ((4-5) w2 w3 / 2, (5-2) w3 w1 / 4, (2-4) w1 w2 / 5), exact numbers.
    const Motion<T> xdot = body_equation<false, SceneKind::plain, T>(model, {Quaternion<T>{}, Vec3<T>(T(2), T(4), T(10))},
                                                                     model.apparent_gravity_L);
    EXPECT_TRUE(close<T>(xdot.m, Vec3<T>(T(-20), T(15), T(-16) / T(5)), T(8) * real::epsilon<T>() * T(20)));
  });
}

TEST(Equations, LaboratoryTurnIsARotationByWt) {
  for (const double rate : {1.0, -3.0, 7.292115e-5}) {
    const Model<float128> model = model_of<float128>(asymmetric(), -35, rate);
    for (const float128 t : {float128(0), float128(0.7), float128(1000)})
      EXPECT_TRUE(close<float128>(rotation_matrix(laboratory_turn(model, t).quaternion(model.epsilon)),
                                  Rotation<float128>::exp(t * model.W_IL_L).matrix(),
                                  16 * real::epsilon<float128>() * (1 + std::abs(rate) * t)));
  }
  // 1e-300 rad/s: half the angle over epsilon keeps its digits where the angle's square is no longer a number.
  const Model<double> slow = model_of<double>(asymmetric(), 45, 1e-300);
  EXPECT_TRUE(close<double>(laboratory_turn(slow, 60.0).v_scaled,
                            Vec3<double>(30 * celestial_axis_L<double>(Site{45, 0, 0, 0})), 30 * 8 * real::epsilon<double>()));
}

TEST(Equations, InertialSpinOfASymmetricTopDoesNotChange) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    BodySpec spec;
    spec.mass_kg = 0.1;
    spec.center_of_mass_m = {0, 0, 0.03};
    spec.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, 4e-5}}};
    const Model<T> model = model_of<T>(spec, 45, 1);
    Random random(505);
    for (int k = 0; k < 20; ++k) {
      const Motion<T> x{random.quaternion<T>(), random.vector<T>(200)};
      // (I1 w1) w2 - (I1 w2) w1 is zero but for the rounding of its four products.
      const T bound = T(2) * real::epsilon<T>() * real::abs(x.m[0] * x.m[1]) * T(1.2e-4) / T(4e-5);
      EXPECT_TRUE(close<T>(body_equation<true, SceneKind::plain, T>(model, x, model.apparent_gravity_L).m[2], T(0), bound));
    }
  });
}

/// The derivative of f along the flow of the body equation at t = 0.
template <class F>
float128 along_the_flow(const Model<float128>& model, const Motion<float128>& x, float128 h, const F& f) {
  const Motion<float128> rate = body_equation<true, SceneKind::plain, float128>(model, x, model.apparent_gravity_L);
  return test::first_derivative(
      [&](float128 at) {
        return f(Motion<float128>{{x.q.w + at * rate.q.w, x.q.v + at * rate.q.v}, x.m + at * rate.m});
      },
      float128(0), h);
}

TEST(Invariants, JacobiIntegralIsConservedAndEnergyIsNot) {
  const Model<float128> model = model_of<float128>(asymmetric(), 50, 1);
  Random random(506);
  int energies_that_change = 0;
  for (int k = 0; k < 20; ++k) {
    const Motion<float128> x{random.quaternion<float128>(), random.vector<float128>(3)};
    const auto integral = [&](const Motion<float128>& at) {
      const Vec3<float128> w_LB_B = at.m - rotation_matrix(at.q).transpose() * model.W_IL_L;
      return jacobi_integral<float128>(model.I_BP_B, model.mass_moment_B, model.apparent_gravity_L, model.W_IL_L, at.q, w_LB_B);
    };
    const auto energy = [&](const Motion<float128>& at) {  // T(w_IB) + V
      return jacobi_integral<float128>(model.I_BP_B, model.mass_moment_B, model.apparent_gravity_L, Vec3<float128>::Zero(),
                                       at.q, at.m)
          .value;
    };
    // Rates and their derivatives over rates stay below W; the integral is of the size of its terms.
    const float128 h = float128(1e-5), W = 30, Wh = W * h, scale = integral(x).scale;
    const float128 bound = scale * (W * Wh * Wh * Wh * Wh * Wh * Wh + 512 * real::epsilon<float128>() / h);
    ASSERT_LT(static_cast<double>(bound), testing::rounding(0.1));
    EXPECT_TRUE(close<float128>(along_the_flow(model, x, h, [&](const Motion<float128>& at) { return integral(at).value; }),
                                float128(0), bound));
    if (real::abs(along_the_flow(model, x, h, energy)) > float128(0.1)) ++energies_that_change;

    // Its terms, written out.
    const Mat3<float128> R_LB = rotation_matrix(x.q);
    const Vec3<float128> L_L = R_LB * (model.I_BP_B * x.m);
    const float128 kinetic = x.m.dot(model.I_BP_B * x.m) / 2, potential = float128(9.75) * (R_LB * model.mass_moment_B)[2],
                   turning = L_L.dot(model.W_IL_L);
    EXPECT_TRUE(close<float128>(integral(x).value, kinetic + potential - turning, 64 * real::epsilon<float128>() * scale));
    EXPECT_TRUE(close<float128>(scale, kinetic + float128(9.75) * norm(model.mass_moment_B) + real::abs(turning),
                                64 * real::epsilon<float128>() * scale));
  }
  EXPECT_GT(energies_that_change, 10);
}

}  // namespace
}  // namespace earthtop
