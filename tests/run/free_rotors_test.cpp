// SPDX-License-Identifier: GPL-3.0-or-later
/// Torque-free bodies seen from the turning laboratory: the tumbling brick of NASA/NESC (T9) and the rotors of Drake and of van
/// Zon and Schofield (T10). The rotors are computed in three independent ways: by the library's closed form, by Euler's angles
/// below, and by the reference program of tests/headlines, which integrates the same scenes in 113 bits.

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "earthtop/closed_form/free_body.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "support/headlines.hpp"
#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using Real = long double;
using Quat = Quaternion<Real>;
using Vec = Vec3<Real>;

/// Attitude and inertial rate in body axes.
struct FreeMotion {
  Quat q_IB;
  Vec w_IB_B;
};

Quat turn(const Vec& axis, Real angle) { return {std::cos(angle / 2), std::sin(angle / 2) * axis}; }
Vec unit(int i) { return Vec::Unit(i); }

/// A body with two equal moments turns about L at |L| / I1 while it spins about its axis at (1 - I3/I1) w3.
FreeMotion axisymmetric(Real I1, Real I3, const FreeMotion& start, Real t) {
  const Vec& w = start.w_IB_B;
  const Vec L_B(I1 * w[0], I1 * w[1], I3 * w[2]);
  const Vec L_I = rotation_matrix(start.q_IB) * L_B;
  const Real size = std::sqrt(L_B.dot(L_B)), spin = (1 - I3 / I1) * w[2];
  const Real c = std::cos(spin * t), s = std::sin(spin * t);
  return {turn(L_I / size, size / I1 * t) * start.q_IB * turn(unit(2), spin * t),
          Vec(c * w[0] + s * w[1], c * w[1] - s * w[0], w[2])};
}

/// A body with three different moments, I1 < I2 < I3 and L^2 > 2 E I2, so that w3 keeps its sign. The rates are Jacobi's
/// elliptic functions [Landau and Lifshitz, Mechanics, section 37]; the attitude follows from Euler's angles about L, of which
/// the precession is an integral of the third kind:
///   dphi/dt = L (2 E - I3 w3^2) / (L^2 - I3^2 w3^2) = L/I3 + L (I3 - I1) / (I1 I3 (1 - n sn^2)).
FreeMotion euler_poinsot(const Vec& I, const FreeMotion& start, Real t) {
  const Vec L0 = I.cwiseProduct(start.w_IB_B);
  const Real L2 = L0.dot(L0), twice_E = L0.dot(start.w_IB_B), L = std::sqrt(L2);
  const Real a = twice_E * I[2] - L2, b = L2 - twice_E * I[0];  // both positive
  const Vec size(std::sqrt(a / (I[0] * (I[2] - I[0]))), std::sqrt(a / (I[1] * (I[2] - I[1]))),
                 std::sqrt(b / (I[2] * (I[2] - I[0]))));
  const Real frequency = std::sqrt((I[2] - I[1]) * b / (I[0] * I[1] * I[2]));
  const Real k = std::sqrt((I[1] - I[0]) * a / ((I[2] - I[1]) * b));
  const Real n = -I[2] * b * k * k / (I[0] * a);

  const Real amplitude0 = std::atan2(start.w_IB_B[1] / size[1], start.w_IB_B[0] / size[0]);
  const Real tau = boost::math::ellint_1(k, amplitude0) + frequency * t;
  Real cn = 0, dn = 0;
  const Real sn = boost::math::jacobi_elliptic(k, tau, &cn, &dn);
  const Real turns = std::round(tau / (4 * boost::math::ellint_1(k)));
  const Real amplitude = std::remainder(std::atan2(sn, cn), 2 * real::pi<Real>()) + 2 * real::pi<Real>() * turns;
  const Real third_kind = boost::math::ellint_3(k, n, amplitude) - boost::math::ellint_3(k, n, amplitude0);
  const Real phi = L / I[2] * t + L * (I[2] - I[0]) / (I[0] * I[2] * frequency) * third_kind;

  // From axes with the third along L to the body's: Rz(phi) Rx(theta) Rz(psi); L is its third row.
  const auto from_momentum_axes = [](const Vec& L_B, Real precession) {
    return turn(unit(2), precession) * turn(unit(0), std::atan2(std::hypot(L_B[0], L_B[1]), L_B[2])) *
           turn(unit(2), std::atan2(L_B[0], L_B[1]));
  };
  const Vec w(size[0] * cn, size[1] * sn, size[2] * dn);
  return {start.q_IB * from_momentum_axes(L0, 0).conjugate() * from_momentum_axes(I.cwiseProduct(w), phi), w};
}

/// The largest component of the difference, for the better of the two signs of the quaternion.
Real distance(const Quat& p, const Quat& q) {
  const Real s = p.w * q.w + p.v.dot(q.v) < 0 ? -1 : 1;
  return std::max(std::abs(p.w - s * q.w), (p.v - s * q.v).cwiseAbs().maxCoeff());
}

FreeMotion start_of(const Scenario& scenario) {
  const auto release = make_release<Real>(scenario.release, make_body<Real>(scenario.body), scenario.site.gravity_m_s2);
  return {release.q_LB, release.w_XB_B};
}

/// The motion as seen from the turning laboratory. The library's closed form must give the same: both keep 19 digits of some
/// hundred radians.
FreeMotion seen_by_laboratory(const Scenario& scenario, const FreeMotion& start, const FreeMotion& motion, Real t) {
  const Vec W_L = scenario.rotation_rate_rad_s * celestial_axis_L<Real>(scenario.site);
  const Vec moments = make_body<Real>(scenario.body).I_BP_B.diagonal();
  const ClosedFormState<Real> state = FreeBody<Real>(moments, start.q_IB, start.w_IB_B).at(t);
  EXPECT_LT(distance(state.q_NB, motion.q_IB), 2e-16L) << t;
  EXPECT_LT((state.w_NB_B - motion.w_IB_B).cwiseAbs().maxCoeff(), 2e-16L * norm(start.w_IB_B)) << t;
  const LaboratoryState<Real> seen = seen_from_laboratory<Real>(state, W_L, t);
  return {seen.q_LB, seen.w_LB_B};
}

template <class ClosedForm>
void expect_rotor(const Scenario& scenario, const ClosedForm& closed_form) {
  ASSERT_EQ(scenario.release.rates_relative_to, RatesRelativeTo::inertial);
  const FreeMotion start = start_of(scenario);
  const RunResult result = run(scenario);
  ASSERT_EQ(result.status, RunStatus::completed);
  // Rates carry the attitude's error, and that of every step's last digits: 1e-11 of their size is what double leaves.
  const Real scale = std::sqrt(start.w_IB_B.dot(start.w_IB_B));
  for (const DriftRow& row : result.rows) {
    const FreeMotion exact = seen_by_laboratory(scenario, start, closed_form(start, row.t_s), row.t_s);
    const Quat q_LB{row.q_LB[0], Vec(row.q_LB[1], row.q_LB[2], row.q_LB[3])};
    ASSERT_LT(distance(q_LB, exact.q_IB), testing::rounding(100)) << row.t_s;
    const Vec w_LB_B(row.w_LB_B[0], row.w_LB_B[1], row.w_LB_B[2]);
    ASSERT_LT((w_LB_B - exact.w_IB_B).cwiseAbs().maxCoeff(), testing::rounding(200) * scale) << row.t_s;
  }
  // The two derivations agree to what long double leaves of the closed form: 1e-19 of some hundred radians.
  const testing::GeneratedValues generated = testing::generated_values(scenario.name);
  ASSERT_EQ(generated.at_s, scenario.duration_s);
  ASSERT_LT(generated.error, 1e-17L);
  const FreeMotion exact = seen_by_laboratory(scenario, start, closed_form(start, scenario.duration_s), scenario.duration_s);
  const Quat q_LB{generated.at("q_LB_w"), Vec(generated.at("q_LB_x"), generated.at("q_LB_y"), generated.at("q_LB_z"))};
  EXPECT_LT(distance(q_LB, exact.q_IB), 2e-16L);
  const Vec w_LB_B(generated.at("w_LB_B_x_rad_s"), generated.at("w_LB_B_y_rad_s"), generated.at("w_LB_B_z_rad_s"));
  EXPECT_LT((w_LB_B - exact.w_IB_B).cwiseAbs().maxCoeff(), 2e-16L * scale);
}

TEST(FreeRotors, T10DrakesTwoEqualMoments) {
  const Scenario scenario =
      parse_scenario(read_scenario_source(std::string(EARTHTOP_TESTS) + "/headlines/scenes/drake-free-rotor.json"));
  const Real I1 = scenario.body.inertia_kg_m2[0][0], I3 = scenario.body.inertia_kg_m2[2][2];
  expect_rotor(scenario, [&](const FreeMotion& start, Real t) { return axisymmetric(I1, I3, start, t); });
}

TEST(FreeRotors, T10VanZonAndSchofieldsThreeMoments) {
  const Scenario scenario = testing::shipped("free-rotor-benchmark");
  const Vec I(10, 20, 26);
  for (int i = 0; i < 3; ++i)
    ASSERT_EQ(scenario.body.inertia_kg_m2[static_cast<std::size_t>(i)][static_cast<std::size_t>(i)], I[i]);
  expect_rotor(scenario, [&](const FreeMotion& start, Real t) { return euler_poinsot(I, start, t); });
}

// After 30 s: inertial rates in body axes, and the attitude relative to the brick's North, East, Down axes of t = 0 as they
// turn with the Earth. They agree with every digit of an independent 113-bit Taylor integration.
TEST(FreeRotors, T9TumblingBrickOfNasa) {
  Scenario scenario = testing::shipped("nesc-tumbling-brick");
  constexpr double kSlugFoot2 = 1.3558179483314004;  // kg m^2, exact: 1 lbf ft s^2
  const double moments[] = {0.001894220, 0.006211019, 0.007194665};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(scenario.body.inertia_kg_m2[i][i], moments[i] * kSlugFoot2);
  const double degree = real::pi<double>() / 180;
  for (const testing::Equations& equations : testing::kEquations) {
    SCOPED_TRACE(equations);
    equations.take(scenario);
    const RunResult result = run(scenario);
    // The first published rate is relative to the Earth: 10 deg/s less the Earth's own.
    EXPECT_NEAR(result.rows.front().w_LB_B[0] / degree, 9.995821927, 5e-10);
    const DriftRow& last = result.rows.back();
    ASSERT_EQ(last.t_s, 30);
    // R_LN = [[0, 1, 0], [1, 0, 0], [0, 0, -1]]: laboratory axes from North, East, Down.
    const Quaternion<double> q_LN{0, Vec3<double>(std::sqrt(0.5), std::sqrt(0.5), 0)};
    const Quaternion<double> q_LB{last.q_LB[0], Vec3<double>(last.q_LB[1], last.q_LB[2], last.q_LB[3])};
    Quaternion<double> q_NB = q_LN.conjugate() * q_LB;
    if (q_NB.w > 0) q_NB = {-q_NB.w, -q_NB.v};
    // Rounding of a few thousand steps of half a radian at most.
    constexpr double kTolerance = 1e-13;  // tolerances of 1e-14 a step, over some steps
    EXPECT_NEAR(q_NB.w, -0.8806323646749819575, kTolerance);
    EXPECT_NEAR(q_NB.v[0], 0.4711460600328819775, kTolerance);
    EXPECT_NEAR(q_NB.v[1], 0.01178150055430625538, kTolerance);
    EXPECT_NEAR(q_NB.v[2], 0.04867468178766495902, kTolerance);
    const Vec3<double> W_L = scenario.rotation_rate_rad_s * celestial_axis_L<double>(scenario.site);
    const Vec3<double> W_B = rotation_matrix(q_LB).transpose() * W_L;
    EXPECT_NEAR(last.w_LB_B[0] + W_B[0], 12.61839077591421973 * degree, kTolerance);
    EXPECT_NEAR(last.w_LB_B[1] + W_B[1], -17.39747476161139311 * degree, kTolerance);
    EXPECT_NEAR(last.w_LB_B[2] + W_B[2], 31.11958888694434441 * degree, kTolerance);
  }
}

}  // namespace
}  // namespace earthtop
