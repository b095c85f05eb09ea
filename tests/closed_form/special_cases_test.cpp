// SPDX-License-Identifier: GPL-3.0-or-later
/// Closed forms in elementary functions, compared with the equations of motion; and their transformation to the turning
/// laboratory, compared with the equations that contain the Earth's rate.

#include "earthtop/closed_form/special_cases.hpp"

#include <gtest/gtest.h>

#include <random>

#include "closed_form/error_table.hpp"
#include "earthtop/closed_form/free_body.hpp"
#include "earthtop/frames/earth.hpp"
#include "support/free_motion.hpp"
#include "support/tolerances.hpp"

namespace earthtop::test {
namespace {

using Wide = float128;
using State = std::array<Wide, 7>;

/// What the reference leaves in so many steps: each is 210 evaluations of some hundred operations, and motions part.
double left_by(int steps) { return testing::rounding<Wide>(1e5 * steps); }
double difference(const Vec3<Wide>& a, const Vec3<Wide>& b) { return static_cast<double>(norm<Wide>(a - b)); }

/// A rigid body with moments I along its axes and mass moment m g r (N m), in axes that turn at W_L: Euler's equations for the
/// inertial rate, and dq/dt for the rate relative to those axes; gravity acts along their -z.
struct Equations {
  Vec3<Wide> I, mgr_B = Vec3<Wide>::Zero(), W_L = Vec3<Wide>::Zero();

  State operator()(const State& x) const {
    const Quaternion<Wide> q{x[0], Vec3<Wide>(x[1], x[2], x[3])};
    const Mat3<Wide> R = rotation_matrix(q);
    const Vec3<Wide> w(x[4], x[5], x[6]), L = I.cwiseProduct(w);
    const Vec3<Wide> relative = w - transposed_times(R, W_L), up = R.row(2).transpose();
    const Vec3<Wide> moment = L.cross(w) - mgr_B.cross(up);
    const Quaternion<Wide> rate = q * Quaternion<Wide>{Wide(0), relative};
    return {rate.w / 2, rate.v[0] / 2, rate.v[1] / 2, rate.v[2] / 2, moment[0] / I[0], moment[1] / I[1], moment[2] / I[2]};
  }
};
Equations equations(const SymmetricTop<Wide>& top, const Vec3<Wide>& W_L = Vec3<Wide>::Zero()) {
  return {Vec3<Wide>(top.I1, top.I1, top.I3), Vec3<Wide>(Wide(0), Wide(0), top.mgl), W_L};
}
State state(const Quaternion<Wide>& q, const Vec3<Wide>& w) { return {q.w, q.v[0], q.v[1], q.v[2], w[0], w[1], w[2]}; }
Quaternion<Wide> attitude(const State& x) { return {x[0], Vec3<Wide>(x[1], x[2], x[3])}; }
Vec3<Wide> rate(const State& x) { return {x[4], x[5], x[6]}; }

Vec3<Wide> earth(double latitude_deg, Wide Omega = Wide(7.292115e-5)) {
  return Omega * celestial_axis_L<Wide>({latitude_deg, 0, 0, 0});
}

// T3: the metal cone on a table, as published: both roots satisfy the equations of motion.
TEST(SteadyPrecession, ConeOfKinonAndBetsch) {
  const Wide g = Wide(981) / 100, J3 = Wide(5.3014376029327760899e-4L), J1 = Wide(4.5062219624928596764e-3L);
  const SymmetricTop<Wide> top{J1, J3, Wide(0.70685834705770347865L) * g * 3 / 40};
  const auto rates = steady_precession_rates<Wide>(top, Wide(1406) / 10, Wide(1) / 2);
  ASSERT_TRUE(rates);
  EXPECT_NEAR(static_cast<double>(rates->slow), 10, 10 * testing::rounding(2));
  for (const Wide precession : {rates->slow, rates->fast}) {
    const Quaternion<Wide> q0{real::cos(real::pi<Wide>() / 6), Vec3<Wide>(real::sin(real::pi<Wide>() / 6), Wide(0), Wide(0))};
    const auto at_0 = steady_precession<Wide>(q0, precession, Wide(1406) / 10, Wide(0));
    const Wide t = Wide(3) / 10;
    const auto exact = steady_precession<Wide>(q0, precession, Wide(1406) / 10, t);
    const State truth = testing::extrapolated(state(at_0.q_NB, at_0.w_NB_B), t, 300, equations(top));
    EXPECT_LT(angle_between(exact.q_NB, attitude(truth)), left_by(300));
    EXPECT_LT(difference(exact.w_NB_B, rate(truth)), left_by(300));
  }
}

TEST(SteadyPrecession, RootsAtEveryTilt) {
  const SymmetricTop<double> top{5e-4, 8e-4, 0.196133};
  for (const double w3 : {200.0, -200.0, 25.0, 1e9})
    for (const double cos_tilt : {1.0, 0.5, 1e-3, 1e-18, -1e-18, -0.3, -1.0}) {
      const auto rates = steady_precession_rates(top, w3, cos_tilt);
      ASSERT_TRUE(rates);
      for (const double x : {rates->slow, rates->fast}) {
        const double a = top.I1 * cos_tilt * x * x, b = top.I3 * w3 * x;
        EXPECT_NEAR(a - b + top.mgl, 0, 8 * real::epsilon<double>() * (std::abs(a) + std::abs(b) + top.mgl));
      }
    }
  const auto level = steady_precession_rates(top, 200.0, 0.0);
  EXPECT_DOUBLE_EQ(level->slow, top.mgl / (top.I3 * 200));
  EXPECT_FALSE(std::isfinite(level->fast));
  EXPECT_FALSE(steady_precession_rates(top, 1.0, 0.5));
  const auto conical = steady_precession_rates(top, 0.0, -0.5);  // a conical pendulum turns either way
  EXPECT_DOUBLE_EQ(conical->slow, -conical->fast);
  const auto free = steady_precession_rates(SymmetricTop<double>{1, 2, 0}, 3.0, 0.5);
  EXPECT_EQ(free->slow, 0);
  EXPECT_DOUBLE_EQ(free->fast, 12);
}

// A free symmetric body is the special case mgl = 0 with L along z, where two closed forms must agree.
TEST(SteadyPrecession, FreeSymmetricBody) {
  const Wide w3 = 3, I1 = 1, I3 = 2, tilt = Wide(7) / 10;
  const Quaternion<Wide> q0{real::cos(tilt / 2), Vec3<Wide>(Wide(0), real::sin(tilt / 2), Wide(0))};
  const Wide precession = I3 * w3 / (I1 * real::cos(tilt));
  const auto start = steady_precession<Wide>(q0, precession, w3, Wide(0));
  for (const double t : {-100.0, 0.5, 20.0}) {
    const auto steady = steady_precession<Wide>(q0, precession, w3, Wide(t));
    const auto free = FreeBody<Wide>(Vec3<Wide>(I1, I1, I3), q0, start.w_NB_B).at(Wide(t));
    EXPECT_LT(angle_between(steady.q_NB, free.q_NB), testing::rounding<Wide>(10 * 800));  // of phases of up to 800 rad
    EXPECT_LT(difference(steady.w_NB_B, free.w_NB_B), testing::rounding<Wide>(10 * 800));
  }
}

// H9: 1/cos(tilt) = 1 + sech(g' t), with a largest tilt of 60 deg.
TEST(Homoclinic, WoodhousesTop) {
  const SymmetricTop<double> top{5e-4, 8e-4, 0.196133};
  const double g = std::sqrt(top.mgl / top.I1), w3 = std::sqrt(0.75) * critical_spin(top);
  for (const double gt : {0.0, 1.0, -5.0, 20.0, 100.0}) {
    const auto x = homoclinic_top(top, w3, gt / g);
    EXPECT_NEAR(1 / rotation_matrix(x.q_NB)(2, 2), 1 + 1 / std::cosh(gt), 8 * real::epsilon<double>());
  }
  const auto start = homoclinic_top(top, w3, 0.0);  // theta' = 0, phi' = 2 g'/sqrt(3), psi' = (3 I1 - I3) g'/(I3 sqrt(3))
  const double azimuth_rate = 2 * g / std::sqrt(3.0), spin_rate = (3 * top.I1 - top.I3) * g / (top.I3 * std::sqrt(3.0));
  EXPECT_NEAR(start.w_NB_B[0], 0, w3 * testing::rounding(8));
  EXPECT_NEAR(start.w_NB_B[1], azimuth_rate * std::sin(real::pi<double>() / 3), w3 * testing::rounding(8));
  EXPECT_NEAR(start.w_NB_B[2], spin_rate + azimuth_rate / 2, w3 * testing::rounding(8));
}

TEST(Homoclinic, SolvesTheEquationsOfMotion) {
  for (const double spin : {0.0, 0.3, 0.9, -0.6, 0.999})
    for (const double shape : {0.1, 1.6}) {
      const SymmetricTop<Wide> top{Wide(1) / 2, Wide(shape) / 2, Wide(2)};
      const Wide w3 = Wide(spin) * critical_spin(top);
      const auto start = homoclinic_top<Wide>(top, w3, Wide(-2)), end = homoclinic_top<Wide>(top, w3, Wide(1));
      const int steps = 60 + static_cast<int>(12 * std::abs(static_cast<double>(w3)));
      const State truth = testing::extrapolated(state(start.q_NB, start.w_NB_B), Wide(3), steps, equations(top));
      EXPECT_LT(angle_between(end.q_NB, attitude(truth)),
                std::exp(2.0 * 2) * left_by(steps));  // from the vertical motions part as exp(2 t)
      EXPECT_LT(difference(end.w_NB_B, rate(truth)), std::exp(2.0 * 2) * left_by(steps));
    }
}

TEST(Separatrix, FreeBodySolvesEulersEquations) {
  const Vec3<Wide> I(Wide(1), Wide(2), Wide(3));
  const auto start = separatrix_free_body<Wide>(I, Wide(1), Wide(-2)), end = separatrix_free_body<Wide>(I, Wide(1), Wide(4));
  const auto truth = testing::integrated_free_body<Wide>(I, start.q_NB, start.w_NB_B, Wide(6), 40);
  EXPECT_LT(angle_between(end.q_NB, truth.q_NB), left_by(40));
  EXPECT_LT(difference(end.w_NB_B, truth.w_NB_B), left_by(40));
  // H10: w2 = tanh(s t), w1 = sech, w3 = sech/sqrt(3), s = 1/sqrt(3).
  const double s = std::sqrt(1.0 / 3);
  const auto x = separatrix_free_body(Vec3<double>(1, 2, 3), 1.0, 2.0);
  EXPECT_NEAR(x.w_NB_B[0], 1 / std::cosh(2 * s), testing::rounding(4));
  EXPECT_NEAR(x.w_NB_B[1], std::tanh(2 * s), testing::rounding(4));
  EXPECT_NEAR(x.w_NB_B[2], s / std::cosh(2 * s), testing::rounding(4));
}

/// The error of a closed form in double, and its stated error, judged by the same closed form in float128.
template <class ClosedForm>
void expect_statement(const ClosedForm& form) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double tightest = 0;
  for (int k = 0; k < 500; ++k) {
    const double a = uniform(engine), b = uniform(engine), t = uniform(engine) * std::pow(10, 4 * uniform(engine));
    const ClosedFormState<double> state = form.template operator()<double>(a, b, t);
    const ClosedFormState<Wide> exact = form.template operator()<Wide>(a, b, t);
    const double error = angle_between(wide(state.q_NB), exact.q_NB);
    ASSERT_LE(error, state.attitude_error) << a << " " << b << " " << t;
    ASSERT_LE(difference(wide(state.w_NB_B), exact.w_NB_B), state.rate_error) << a << " " << b << " " << t;
    ASSERT_LE(state.attitude_error, 1000 * std::max(error, real::epsilon<double>() / 2));
    tightest = std::max(tightest, error / state.attitude_error);
  }
  EXPECT_GT(tightest, 0.05);
}

TEST(SpecialCases, StatementsOfError) {
  expect_statement([]<class T>(double a, double b, double t) {
    return steady_precession<T>(Quaternion<T>{T(1), Vec3<T>(T(a), T(b), T(0.3))}, T(5 * a), T(40 * b), T(t));
  });
  expect_statement([]<class T>(double a, double b, double t) {
    const double I3 = 0.6 + b / 2, w3 = 2 / I3 * a;
    return homoclinic_top<T>({T(0.5), T(I3), T(2)}, T(w3), T(t));
  });
  expect_statement([]<class T>(double a, double b, double t) {
    return separatrix_free_body<T>(Vec3<T>(T(1), T(2 + a / 2), T(3 + b / 4)), T(2 + b), T(t));
  });
}

// At the poles, any heavy body on the turning Earth moves as it would on an Earth at rest, seen from the turning laboratory.
TEST(TurningLaboratory, PolesForAnyBody) {
  for (const double latitude : {90.0, -90.0}) {
    const Vec3<Wide> W = earth(latitude, Wide(1) / 4);
    Equations still{Vec3<Wide>(Wide(2), Wide(3), Wide(4)), Vec3<Wide>(Wide(0.5), Wide(-1), Wide(2))}, turning = still;
    turning.W_L = W;
    const State start =
        state(Quaternion<Wide>{Wide(0.6), Vec3<Wide>(Wide(0), Wide(0.8), Wide(0))}, Vec3<Wide>(Wide(1), Wide(2), Wide(-1)));
    const State in_space = testing::extrapolated(start, Wide(3), 40, still),
                seen = testing::extrapolated(start, Wide(3), 40, turning);
    const ClosedFormState<Wide> motion{attitude(in_space).normalized(), rate(in_space), Wide(0), Wide(0)};
    const auto laboratory = seen_from_laboratory<Wide>(motion, W, Wide(3));
    EXPECT_LT(angle_between(laboratory.q_LB, attitude(seen)), left_by(40));
    const Vec3<Wide> relative = rate(seen) - transposed_times(rotation_matrix(attitude(seen)), W);
    EXPECT_LT(difference(laboratory.w_LB_B, relative), left_by(40));
  }
}

TEST(TurningLaboratory, FreeBodiesAtAnyLatitude) {
  for (const double latitude : {-33.0, 0.0, 51.0}) {
    const Vec3<Wide> W = earth(latitude, Wide(1) / 4), I(Wide(2), Wide(3), Wide(4)), w(Wide(1), Wide(2), Wide(-1));
    const Quaternion<Wide> q0{Wide(0.6), Vec3<Wide>(Wide(0), Wide(0.8), Wide(0))};
    const State seen = testing::extrapolated(state(q0, w), Wide(3), 40, Equations{I, Vec3<Wide>::Zero(), W});
    const auto laboratory = seen_from_laboratory<Wide>(FreeBody<Wide>(I, q0, w).at(Wide(3)), W, Wide(3));
    EXPECT_LT(angle_between(laboratory.q_LB, attitude(seen).normalized()), left_by(40));
    const Vec3<Wide> relative = rate(seen) - transposed_times(rotation_matrix(attitude(seen)), W);
    EXPECT_LT(difference(laboratory.w_LB_B, relative), left_by(40));
  }
}

TEST(TurningLaboratory, ResolvesTheSlowestTurn) {
  const Vec3<double> W(0, 0, 1e-300);
  const ClosedFormState<double> still;
  const auto x = seen_from_laboratory(still, W, 10.0);
  EXPECT_DOUBLE_EQ(x.q_LB.v[2], -5e-300);
  EXPECT_EQ(x.w_LB_B[2], -1e-300);
  EXPECT_EQ(seen_from_laboratory(still, Vec3<double>(Vec3<double>::Zero()), 10.0).q_LB.w, 1);
}

// T7: latitude 45 deg, the axis pointing East, 60 s.
TEST(BalancedGyroscope, FoucaultsGyroscope) {
  const double c = 7.292115e-5 * std::sqrt(0.5);
  const Vec3<double> axis = balanced_gyroscope_axis_L(Vec3<double>(1, 0, 0), Vec3<double>(0, c, c), 60.0);
  EXPECT_NEAR(axis[0], 0.99999042852585771135, testing::rounding(2));  // cos(Omega t)
  EXPECT_NEAR(axis[1], -0.0030937725087229706379, c * 60 * testing::rounding(6));
  EXPECT_NEAR(axis[2], 0.0030937725087229706379, c * 60 * testing::rounding(6));
  EXPECT_NEAR(balanced_gyroscope_drift(1.0, 7.292115e-5, 60.0), 7.292115e-5 * 60, c * 60 * testing::rounding(4));
}

// T6, and the growth rates of H8.
TEST(SleepingTop, CriticalSpinAndGrowth) {
  const SymmetricTop<double> ladder{6e-4, 1.6e-4, 0.2 * 9.80665 * 0.05}, toy{5e-4, 8e-4, 5 * 0.004 * 9.80665};
  EXPECT_NEAR(critical_spin(ladder), 95.88396307516706, testing::reference(16, 10) + 100 * testing::rounding(2));
  EXPECT_NEAR(critical_spin(toy), 24.757, testing::reference(5, 10));
  const double omega = std::sqrt(toy.mgl / toy.I1);
  EXPECT_NEAR(upright_growth_rate(toy, 0.6 * critical_spin(toy)), 0.8 * omega, omega * testing::rounding(16));
  EXPECT_NEAR(upright_growth_rate(toy, 0.0), omega, omega * testing::rounding(2));
  EXPECT_EQ(upright_growth_rate(toy, 1.0001 * critical_spin(toy)), 0);
}

// H7; and the exact equilibrium of the axis satisfies the equations of motion.
TEST(SleepingTop, LeansToTheSouth) {
  const SymmetricTop<Wide> top{Wide(5e-4), Wide(8e-4), Wide(0.196133)};
  for (const double latitude : {45.0, -45.0})
    for (const auto& [w3, lean] : {std::pair{200.0, 4.21e-5}, {400.0, 8.41e-5}, {800.0, 1.683e-4}}) {
      const Vec3<Wide> W = earth(latitude), n = resting_axis_L<Wide>(top, Wide(w3), W);
      const auto first = sleeping_top_lean_south<Wide>(top, Wide(w3), W);
      EXPECT_NEAR(static_cast<double>(first.value), lean, testing::reference(3, 1e-5));
      const double exact = static_cast<double>(-n[1] / n[2]);
      EXPECT_LT(std::abs(exact - static_cast<double>(first.value)), static_cast<double>(first.left_out));
      EXPECT_GT(std::abs(exact - static_cast<double>(first.value)), 1e-3 * static_cast<double>(first.left_out));
    }
  const Vec3<Wide> W = earth(45.0, Wide(1)), n = resting_axis_L<Wide>(top, Wide(30), W);
  const Wide tilt = real::atan2(-n[1], n[2]);  // South: a turn about East
  const Quaternion<Wide> q{real::cos(tilt / 2), Vec3<Wide>(real::sin(tilt / 2), Wide(0), Wide(0))};
  Vec3<Wide> w = transposed_times(rotation_matrix(q), W);
  w[2] = 30;
  const State moved = equations(top, W)(state(q, w));
  const Vec3<Wide> turning(moved[4], moved[5], moved[6]), relative = w - transposed_times(rotation_matrix(q), W);
  // The axis is at rest, and the rate changes only because the body turns under it: dw/dt = w x relative.
  EXPECT_LT(norm<Wide>(turning - w.cross(relative)), testing::rounding<Wide>(30) * 30);
}

// H6: a pendulum released at rest in the laboratory, and its plane of swing after some periods.
TEST(FoucaultPendulum, PlaneTurnsAsStated) {
  for (const double share : {1e-4, 0.5})
    for (const double latitude : {90.0, 45.0, -30.0, 0.0})
      for (const double amplitude : {1e-3, 0.03, 0.2}) {
        SCOPED_TRACE(::testing::Message() << share << " " << latitude << " " << amplitude);
        const SymmetricTop<Wide> top{Wide(1), Wide(share), Wide(-40)};
        const Vec3<Wide> W = earth(latitude, Wide(1e-3));
        const auto stated = foucault_rate<Wide>(top, Wide(amplitude), W);
        // The pendulum hangs along -z of the body's third axis, which leans to the South; it is at rest in the laboratory.
        const Wide half = Wide(amplitude) / 2;
        const Quaternion<Wide> q0{real::cos(half), Vec3<Wide>(real::sin(half), Wide(0), Wide(0))};
        const SymmetricTop<Wide> hanging{top.I1, top.I3, top.mgl};
        State x = state(q0, transposed_times(rotation_matrix(q0), W));
        const Equations law = equations(hanging, W);
        // Ten swings of the linear pendulum, corrected for the amplitude, then the turning point itself by Newton's method.
        const double period = 2 * 3.14159265358979 / std::sqrt(40.0) * (1 + amplitude * amplitude / 16);
        x = testing::extrapolated(x, Wide(10 * period), 40, law);
        double t = 10 * period;
        const auto axis_and_rate = [&](const State& s, double& position, double& speed, double& azimuth) {
          const Mat3<Wide> R = rotation_matrix(attitude(s));
          const Vec3<Wide> n = R.col(2), relative = R * rate(s) - W, moving = relative.cross(n);
          position = static_cast<double>(n[0] * n[0] + n[1] * n[1]);
          speed = static_cast<double>(n[0] * moving[0] + n[1] * moving[1]);
          azimuth = static_cast<double>(real::atan2(n[0], -n[1]));  // from South to East: counterclockwise about Up
        };
        double position, speed, azimuth;
        for (int k = 0; k < 4; ++k) {
          axis_and_rate(x, position, speed, azimuth);
          const double step = speed / (position * 40);
          x = testing::extrapolated(x, Wide(step), 1, law);
          t += step;
        }
        axis_and_rate(x, position, speed, azimuth);
        EXPECT_LT(std::abs(azimuth / t - static_cast<double>(stated.value)), static_cast<double>(stated.left_out));
      }
}

}  // namespace
}  // namespace earthtop::test
