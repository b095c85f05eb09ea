// SPDX-License-Identifier: GPL-3.0-or-later
// Compares every applied torque with a formula of its own: sums over particles, formulas derived by hand, the wall stress of a
// boundary layer, and the dynamics under a constraint.
#include "earthtop/model/applied_torques.hpp"

#include <functional>

#include "earthtop/frames/gravity_gradient.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "paper/particles.hpp"
#include "scene/parts.hpp"
#include "support/scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using test::at_most;
using test::close;
using test::identical;
using test::Particle;
using test::Particles;
using test::Random;

constexpr int kMotions = 10;

/// A scene with any inertia tensor, on a platform that turns and swings about a leaning axis.
Scenario scene_with(const AppliedTorquesSpec& applied, Random& random, bool on_platform) {
  Scenario scenario = testing::toy_top();
  scenario.body = test::body_spec(test::exact_particles<double>(random));
  scenario.site = {random.uniform(-90, 90), 0, random.uniform(0, 3000), 9.8};
  scenario.effects.applied = applied;
  if (on_platform) {
    PlatformSpec& platform = scenario.platform.emplace();
    platform.motion = PlatformMotion::harmonic;
    platform.axis = {0.1, -0.2, 1};
    platform.amplitude_rad = 0.3;
    platform.frequency_hz = 0.25;
    platform.phase_deg = 20;
  }
  return scenario;
}

/// The applied torque on the rotating motion (N m).
Vec3<double> torque(const Scenario& scenario, double t, const Quaternion<double>& q_LB, const Vec3<double>& w_LB_B) {
  return applied_torque_B(Scene(scenario).model<double>(), t, q_LB, w_LB_B, true);
}

TEST(AppliedTorques, NormalGravityGradientIsTheSumOverParticles) {
  Random random(201);
  for (int k = 0; k < kMotions; ++k) {
    const Particles<double> particles = test::exact_particles<double>(random);
    AppliedTorquesSpec applied;
    applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
    Scenario scenario = scene_with(applied, random, false);
    scenario.body = test::body_spec(particles);
    const Quaternion<double> q_LB = random.quaternion<double>();
    const Mat3<double> R_LB = rotation_matrix(q_LB);
    const Mat3<double> gradient_L = normal_gravity_gradient_L(scenario.site.latitude_deg, scenario.site.height_m);
    test::Sum<double> sum;
    for (const Particle<double>& p : particles) {
      const Vec3<double> r_L = R_LB * p.r, pull = gradient_L * r_L;
      sum.add(p.m * R_LB.transpose() * r_L.cross(pull), p.m * norm(r_L) * norm(pull));
    }
    const auto w = random.vector<double>(9);
    EXPECT_TRUE(close<double>(torque(scenario, 0, q_LB, w), sum.value, test::round_off(particles, sum.size)));
  }
}

TEST(AppliedTorques, RadialGravityGradientIsAPointEarthsPull) {
  using T = float128;
  constexpr int kSize = -20;  // a body of a micrometre: what the gradient leaves out of the pull is 1e-13 of it
  Random random(202);
  for (int k = 0; k < kMotions; ++k) {
    const Particles<T> particles = test::exact_particles<T>(random);
    AppliedTorquesSpec applied;
    applied.gravity_gradient = GravityGradientSpec{};
    Scenario scenario = scene_with(applied, random, false);
    scenario.body = test::body_spec(particles);
    for (auto& row : scenario.body.inertia_kg_m2)
      for (double& moment : row) moment = std::ldexp(moment, 2 * kSize);
    for (double& component : scenario.body.center_of_mass_m) component = std::ldexp(component, kSize);
    // The position of the pivot from the Earth's centre, in axes East, North, Up along the ellipsoid's normal.
    const T pi = real::pi<T>(), phi = T(scenario.site.latitude_deg) * pi / T(180), h = T(scenario.site.height_m);
    const T s = real::sin(phi), c = real::cos(phi), f = T(1) / T(kInverseFlatteningWgs84), square = f * (T(2) - f);
    const T N = T(kEquatorialRadiusWgs84) / real::sqrt(T(1) - square * s * s);
    const T across = (N + h) * c, along = (N * (T(1) - square) + h) * s;
    const Vec3<T> pivot_L(T(0), -across * s + along * c, across * c + along * s);
    const auto pull = [](const Vec3<T>& r) {
      const T distance = norm(r);
      return Vec3<T>(-T(kGravitationalConstantWgs84) / (distance * distance * distance) * r);
    };
    const Quaternion<T> q_LB = random.quaternion<T>();
    const Mat3<T> R_LB = rotation_matrix(q_LB);
    Vec3<T> sum = Vec3<T>::Zero();
    for (const Particle<T>& p : particles) {
      const Vec3<T> r_L = real::scale(T(1), kSize) * R_LB * p.r;
      sum += p.m * R_LB.transpose() * r_L.cross(Vec3<T>(pull(Vec3<T>(pivot_L + r_L)) - pull(pivot_L)));
    }
    const Vec3<T> computed = applied_torque_B(Scene(scenario).model<T>(), T(0), q_LB, random.vector<T>(9), true);
    // Strength and direction are doubles.
    EXPECT_TRUE(close<T>(computed, sum, T(1e-12) * norm(sum)));
    EXPECT_GT(norm(sum), T(0));
  }
}

TEST(AppliedTorques, FrictionByHand) {
  Random random(203);
  AppliedTorquesSpec applied;
  applied.viscous_N_m_s = 0.3;
  applied.quadratic_N_m_s2 = 0.07;
  applied.coulomb_N_m = 2;
  for (int k = 0; k < kMotions; ++k) {
    const Scenario scenario = scene_with(applied, random, true);
    const double t = random.uniform(-3, 3);
    const Quaternion<double> q_LB = random.quaternion<double>(1.5);
    const auto w_LB_B = random.vector<double>(5);
    // The platform's rate: of 0.3 sin(2 pi t / 4 + 20 deg).
    const double pi = real::pi<double>();
    const Vec3<double> w_LP_L = 0.3 * pi / 2 * std::cos(pi / 2 * t + pi / 9) * Vec3<double>(0.1, -0.2, 1) / std::sqrt(1.05);
    const Vec3<double> w = w_LB_B - rotation_matrix(q_LB).transpose() * w_LP_L;
    const double rate = w.norm();
    const Vec3<double> expected = -0.3 * w - 0.07 * rate * w - 2 / rate * w;
    EXPECT_TRUE(close<double>(torque(scenario, t, q_LB, w_LB_B), expected, 1e-14 * expected.norm()));
  }
  // A body at rest is not turned.
  const Scenario scenario = scene_with(applied, random, false);
  EXPECT_TRUE(identical(torque(scenario, 1, random.quaternion<double>(), Vec3<double>(0, 0, 0)), Vec3<double>(0, 0, 0)));
}

/// Integrates von Karman's equations F'' = F^2 - G^2 + H F', G'' = 2 F G + H G', H' = -2 F from the disc (F = H = 0, G = 1,
/// given slopes) by the classical Runge-Kutta method. Returns F and G at `end`, where they must vanish because the flow is
/// straight up.
std::array<double, 2> flow_far_above_a_disc(double radial_slope, double tangential_slope, double end) {
  using State = Eigen::Matrix<double, 5, 1>;  // F, F', G, G', H
  const auto rate = [](const State& x) {
    State d;
    d << x[1], x[0] * x[0] - x[2] * x[2] + x[4] * x[1], x[3], 2 * x[0] * x[2] + x[4] * x[3], -2 * x[0];
    return d;
  };
  State x;
  x << 0, radial_slope, 1, tangential_slope, 0;
  constexpr int kSteps = 2000;
  const double h = end / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const State a = rate(x), b = rate(x + h / 2 * a), c = rate(x + h / 2 * b), d = rate(x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return {x[0], x[2]};
}

TEST(AppliedTorques, TheDiscsAirIsTheWallStressIntegrated) {
  constexpr double kTangentialSlope = 0.615922, kRadialSlope = 0.510233;
  for (const double left : flow_far_above_a_disc(kRadialSlope, -kTangentialSlope, 10)) EXPECT_NEAR(left, 0, 1e-3);
  const AirDragSpec air{0.11, 1.2, 1.5e-5, DiscFlow::laminar};
  const double R = air.disc_radius_m, rho = air.density_kg_m3, nu = air.kinematic_viscosity_m2_s, w = 40;
  /// Both sides' moment of a wall stress over the radius, by Gauss' two points on short pieces.
  const auto moment = [&](const std::function<double(double)>& stress) {
    constexpr int kPieces = 2000;
    double sum = 0;
    for (int i = 0; i < kPieces; ++i)
      for (const double side : {-0.5, 0.5}) {
        const double r = (i + 0.5 + side / std::sqrt(3.0)) * R / kPieces;
        sum += 2 * real::pi<double>() * r * r * stress(r) * R / kPieces / 2;
      }
    return 2 * sum;
  };
  const double laminar = moment([&](double r) { return kTangentialSlope * rho * r * w * std::sqrt(nu * w); });
  // Von Karman's turbulent layer: Blasius' stress of the velocity at the wall, which leans outwards by 0.162, in a layer of
  // thickness 0.526 r^(3/5) (nu / w)^(1/5).
  const double turbulent = moment([&](double r) {
    const double thickness = 0.526 * std::pow(r, 0.6) * std::pow(nu / w, 0.2);
    return 0.0225 * rho * std::pow(r * w, 1.75) * std::pow(nu / thickness, 0.25) * std::pow(1 + 0.162 * 0.162, 0.375);
  });
  Random random(204);
  AppliedTorquesSpec applied;
  for (const DiscFlow flow : {DiscFlow::laminar, DiscFlow::turbulent}) {
    applied.air_drag = air;
    applied.air_drag->flow = flow;
    const Scenario scenario = scene_with(applied, random, false);
    const bool is_laminar = flow == DiscFlow::laminar;
    const double expected = is_laminar ? laminar : turbulent;
    for (const double sign : {1.0, -1.0}) {
      const Vec3<double> at_w = torque(scenario, 0, random.quaternion<double>(), Vec3<double>(3, -2, sign * w));
      EXPECT_EQ(at_w[0], 0);
      EXPECT_EQ(at_w[1], 0);
      EXPECT_NEAR(at_w[2], -sign * expected, (is_laminar ? 1e-4 : 3e-3) * expected);  // 3.87 of 3.8699, 0.146 of 0.1458
      const Vec3<double> at_9w = torque(scenario, 0, random.quaternion<double>(), Vec3<double>(0, 0, sign * 9 * w));
      EXPECT_NEAR(at_9w[2] / at_w[2], std::pow(9, is_laminar ? 1.5 : 1.8), 1e-12);
    }
  }
}

TEST(AppliedTorques, ADiscsFlowTurnsTurbulentAtAReynoldsNumberOf300000) {
  AirDragSpec air{0.1, 1.2, 2e-5, DiscFlow::automatic};
  EXPECT_NEAR(disc_reynolds_number(air, -600), 3e5, 1e-9);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(is_turbulent(air, sign * 599.9));
    EXPECT_TRUE(is_turbulent(air, sign * 600.1));
  }
  AppliedTorquesSpec spec;
  for (const double spin : {-599.9, 600.1}) {
    spec.air_drag = air;
    const auto automatic = make_applied_torques<double>(spec, {}, spin, 0, 0);
    spec.air_drag->flow = spin > 0 ? DiscFlow::turbulent : DiscFlow::laminar;
    const auto chosen = make_applied_torques<double>(spec, {}, 1, 0, 0);
    EXPECT_EQ(automatic.disc_laminar, chosen.disc_laminar);
    EXPECT_EQ(automatic.disc_turbulent, chosen.disc_turbulent);
    EXPECT_EQ(automatic.disc_laminar > 0, spin < 0);
    EXPECT_EQ(automatic.disc_turbulent > 0, spin > 0);
  }
  air.flow = DiscFlow::laminar;
  EXPECT_FALSE(is_turbulent(air, 1e9));
  air.flow = DiscFlow::turbulent;
  EXPECT_TRUE(is_turbulent(air, 0));
}

TEST(AppliedTorques, InNaturalUnitsTheyAreTheSameTorques) {
  Random random(205);
  AppliedTorquesSpec exact, disc;
  exact.viscous_N_m_s = 0.3;
  exact.quadratic_N_m_s2 = 0.07;
  exact.coulomb_N_m = 2;
  exact.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  for (const DiscFlow flow : {DiscFlow::automatic, DiscFlow::laminar, DiscFlow::turbulent}) {
    const bool is_exact = flow == DiscFlow::automatic;
    if (!is_exact) disc.air_drag = AirDragSpec{0.1, 1.2, 1.5e-5, flow};
    for (const NaturalUnits units : {NaturalUnits{5, -7}, NaturalUnits{-12, 3}, NaturalUnits{1, 1}}) {
      const Scenario scenario = scene_with(is_exact ? exact : disc, random, true);
      const auto q_LB = random.quaternion<double>();
      const auto w_LB_B = random.vector<double>(5);
      const double t = random.uniform(-3, 3);
      const Vec3<double> in_SI = torque(scenario, t, q_LB, w_LB_B);
      const Vec3<double> computed =
          applied_torque_B(model_of<double>(scenario, units), units.time_from_s(t), q_LB, units.rate_from_rad_s(w_LB_B), true);
      const double scale = std::ldexp(1.0, 2 * units.time_exponent - units.mass_exponent);
      EXPECT_TRUE(close<double>(computed, Vec3<double>(scale * in_SI), is_exact ? 0 : 4e-15 * scale * norm(in_SI)));
    }
  }
}

TEST(AppliedTorques, AGimbalHoldsTheAxisLevelAndDoesNothingElse) {
  using T = double;
  Random random(206);
  for (int k = 0; k < 2 * kMotions; ++k) {
    AppliedTorquesSpec applied;
    applied.gimbal = GimbalSpec{0.4};
    applied.viscous_N_m_s = 0.3;
    applied.gravity_gradient = GravityGradientSpec{GradientField::given, 0.01};
    Scenario scenario = scene_with(applied, random, k % 2 == 1);
    scenario.rotation_rate_rad_s = random.uniform(-1, 1);
    scenario.effects.coriolis = k % 4 < 2;  // what is left out acts as an applied torque, which the gimbal holds as well
    TideSpec& tide = scenario.effects.tide.emplace();
    tide.given = true, tide.amplitude_m_s2 = {0.3, -0.2, 0.1}, tide.frequency_hz = 0.2;
    const Model<T> model = Scene(scenario).model<T>();
    Scenario freed = scenario;
    freed.effects.applied.gimbal.reset();
    const Model<T> free = Scene(freed).model<T>();
    const T t = random.uniform(-3, 3);
    const Mat3<T> R_LP = k % 2 == 1 ? Rotation<T>::about(model.platform.turn.axis, model.platform.turn.angle(t)).matrix()
                                    : Mat3<T>(Mat3<T>::Identity());
    const Vec3<T> w_LP_L = model.platform.turn.angle_rate(t) * model.platform.turn.axis;
    const Vec3<T> alpha_LP_L = model.platform.turn.angle_acceleration(t) * model.platform.turn.axis;
    // A level axis, and a rate of which the part along z x n is the platform's. Everything in L axes.
    const Vec3<T> z = R_LP.col(2), any = random.unit<T>(), n = z.cross(any).normalized();
    Mat3<T> R_LB;
    R_LB << z.cross(n), z, n;  // x, y and n
    const T roll = random.uniform(-3, 3);
    R_LB = R_LB * test::rodrigues<T>(Vec3<T>::UnitZ(), roll);
    const Eigen::Quaternion<T> q(R_LB);
    const Quaternion<T> q_LB{q.w(), q.vec()};
    const Vec3<T> W = model.W_IL_L, w_IP = W + w_LP_L;
    const Vec3<T> w_IB = w_IP + random.uniform(-5, 5) * n + random.uniform(-1, 1) * z;
    const Vec3<T> w_LB_B = R_LB.transpose() * (w_IB - W);
    const Vec3<T> held = R_LB * applied_torque_B(model, t, q_LB, w_LB_B, true);
    const Vec3<T> without = R_LB * applied_torque_B(free, t, q_LB, w_LB_B, true);
    // Damping of the turn about z, and a torque about z x n: nothing about n, nothing more about z.
    const Vec3<T> added = held - without, w_PB = w_IB - w_IP;
    const T size = norm(held) + norm(without);
    EXPECT_NEAR(added.dot(n), 0, testing::rounding(40) * size);
    EXPECT_NEAR(added.dot(z), -0.4 * w_PB.dot(z), testing::rounding(40) * size);
    // Euler's equation in inertial space, with all torques; then the second derivative of n.z.
    const Vec3<T> w_IB_B = R_LB.transpose() * w_IB;
    const Motion<T> rate =
        body_equation<true, SceneKind::full>(model, Motion<T>{q_LB, w_IB_B}, pivot_field<SceneKind::full>(model, t).rotating_L);
    const Vec3<T> dw = R_LB * (rate.m + model.I_BP_B_inverse * (R_LB.transpose() * held));
    const Vec3<T> dw_IP = alpha_LP_L + W.cross(w_LP_L);
    const Vec3<T> dn = w_IB.cross(n), dz = w_IP.cross(z);
    const Vec3<T> ddn = dw.cross(n) + w_IB.cross(dn), ddz = dw_IP.cross(z) + w_IP.cross(dz);
    const T scale = norm(ddn) + norm(ddz) + norm(dn) * norm(dz);
    EXPECT_NEAR(dn.dot(z) + n.dot(dz), 0, testing::rounding(40) * (norm(dn) + norm(dz)));
    EXPECT_NEAR(ddn.dot(z) + 2 * dn.dot(dz) + n.dot(ddz), 0, testing::rounding(500) * scale);
  }
}

TEST(AppliedTorques, ALevelRotorTurnsAsLagrangeHasIt) {
  // With phi the axis' angle from North towards West and w3 its conserved inertial spin, from the kinetic energy
  //   I1 [(phi' + W sin(lat))^2 + W^2 cos^2(lat) sin^2 phi] / 2 + I3 w3^2 / 2 ,  w3 = psi' + W cos(lat) cos phi :
  //   I1 phi'' = -I3 w3 W cos(lat) sin phi + I1 W^2 cos^2(lat) sin phi cos phi .
  Random random(207);
  for (int k = 0; k < kMotions; ++k) {
    AppliedTorquesSpec applied;
    applied.gimbal.emplace();
    Scenario scenario = testing::toy_top();
    scenario.body.center_of_mass_m = {0, 0, 0};
    testing::set_principal(scenario.body, 1e-4, 1e-4, 1.7e-4);
    scenario.effects.applied = applied;
    scenario.rotation_rate_rad_s = 0.5;
    scenario.site.latitude_deg = random.uniform(-80, 80);
    const double lat = scenario.site.latitude_deg * real::pi<double>() / 180, W = 0.5;
    const double phi = random.uniform(-3, 3), phi_rate = random.uniform(-1, 1), spin = random.uniform(-9, 9);
    const Vec3<double> n(-std::sin(phi), std::cos(phi), 0), z = Vec3<double>::UnitZ();
    Mat3<double> R_LB;
    R_LB << z.cross(n), z, n;
    const Eigen::Quaternion<double> q(R_LB);
    const Quaternion<double> q_LB{q.w(), q.vec()};
    const Vec3<double> w_LB_B(0, phi_rate, spin), W_L(0, W * std::cos(lat), W * std::sin(lat));
    const Model<double> model = Scene(scenario).model<double>();
    const Vec3<double> w_IB_B = w_LB_B + R_LB.transpose() * W_L;
    const Vec3<double> L_B = model.I_BP_B * w_IB_B;
    const Vec3<double> dw_IB_B = model.I_BP_B_inverse * (L_B.cross(w_IB_B) + torque(scenario, 0, q_LB, w_LB_B));
    // About Up: d(w_IB.z)/dt with z turning at W is phi''.
    const double computed = dw_IB_B[1] + w_IB_B.dot(R_LB.transpose() * W_L.cross(z));
    const double c = W * std::cos(lat), w3 = spin + c * std::cos(phi);
    const double expected = -1.7 * w3 * c * std::sin(phi) + c * c * std::sin(phi) * std::cos(phi);
    EXPECT_NEAR(computed, expected, testing::rounding(40) * (1.7 * std::abs(w3 * c) + c * c + W * std::abs(phi_rate))) << k;
    EXPECT_NEAR(dw_IB_B[2], 0, testing::rounding(20) * std::abs(w3 * c)) << k;  // the spin is conserved
  }
}

}  // namespace
}  // namespace earthtop
