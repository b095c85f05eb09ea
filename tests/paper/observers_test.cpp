// SPDX-License-Identifier: GPL-3.0-or-later
/// The theorem of [F]: a rotating observer's torques, added to the physical ones, give the same motion as Euler's equation.

#include "earthtop/frames/frame_stack.hpp"
#include "earthtop/model/equations.hpp"
#include "paper/particles.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Particle;
using test::Particles;
using test::Random;
using test::round_off;
using Q = float128;

constexpr int kObserverCases = 20;

/// Particles in mirrored octets: the coordinate planes are symmetry planes, and products of inertia cancel exactly.
template <class T>
Particles<T> principal_particles(Random& random) {
  Particles<T> particles;
  for (int k = 0; k < 4; ++k) {
    const T m = T(random.uniform(0.1, 2));
    const Vec3<T> r = random.vector<T>();
    for (int octant = 0; octant < 8; ++octant)
      particles.push_back(
          {m, Vec3<T>(octant & 1 ? -r[0] : r[0], octant & 2 ? -r[1] : r[1], octant & 4 ? -r[2] : r[2]), Vec3<T>::Zero()});
  }
  return particles;
}

/// The physical torque, sum r x m a in inertial space, that the particles need to stay at rest in a frame with rates w and
/// wdot.
template <class T>
test::Sum<T> inertial_rate(const Particles<T>& particles, const Vec3<T>& w, const Vec3<T>& wdot) {
  test::Sum<T> sum;
  for (const Particle<T>& p : particles)
    sum.add(p.m * p.r.cross(wdot.cross(p.r) + w.cross(w.cross(p.r))), p.m * p.r.squaredNorm() * (norm(wdot) + w.squaredNorm()));
  return sum;
}

TEST(PaperTorques, EulerEquationComponentByComponent) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(201);
    for (int k = 0; k < kObserverCases; ++k) {
      const Particles<T> particles = principal_particles<T>(random);
      const Mat3<T> S = test::second_moment(particles), theta = test::inertia(particles);
      const Vec3<T> I = theta.diagonal(), w = random.vector<T>(2), wdot = random.vector<T>(2);
      const test::Sum<T> physical = inertial_rate(particles, w, wdot);
      const T bound = round_off(particles, physical.size);

      const Vec3<T> cor = coriolis_torque(w, velocity_moment<T>(S, Vec3<T>::Zero()));
      const Vec3<T> trans = transverse_torque(wdot, S), cent = centrifugal_torque(w, S);
      EXPECT_TRUE(identical(cor, Vec3<T>::Zero()));
      EXPECT_TRUE(close<T>(trans, Vec3<T>(-I[0] * wdot[0], -I[1] * wdot[1], -I[2] * wdot[2]), bound));
      EXPECT_TRUE(close<T>(
          cent, Vec3<T>(-w[1] * w[2] * (I[2] - I[1]), -w[2] * w[0] * (I[0] - I[2]), -w[0] * w[1] * (I[1] - I[0])), bound));
      // dL'/dt = 0 = tau_non-inertial + tau_phys, which is Euler's equation.
      EXPECT_TRUE(close<T>(Vec3<T>(cor + trans + cent + physical.value), Vec3<T>::Zero(), T(2) * bound));
      EXPECT_TRUE(close<T>(physical.value,
                           Vec3<T>(I[0] * wdot[0] + w[1] * w[2] * (I[2] - I[1]), I[1] * wdot[1] + w[2] * w[0] * (I[0] - I[2]),
                                   I[2] * wdot[2] + w[0] * w[1] * (I[1] - I[0])),
                           bound));
    }
    for (int k = 0; k < kObserverCases; ++k) {  // any axes
      const Particles<T> particles = test::random_particles<T>(random);
      const Mat3<T> S = test::second_moment(particles), theta = test::inertia(particles);
      const Vec3<T> w = random.vector<T>(2), wdot = random.vector<T>(2);
      const test::Sum<T> physical = inertial_rate(particles, w, wdot);
      const T bound = round_off(particles, physical.size);
      const Vec3<T> other_side = transverse_torque(wdot, S) + centrifugal_torque(w, S);
      EXPECT_TRUE(close<T>(Vec3<T>(-other_side), physical.value, bound));
      EXPECT_TRUE(close<T>(Vec3<T>(theta * wdot + w.cross(theta * w)), physical.value, bound));
    }
  });
}

constexpr Q kObserverStep = Q(1e-5);
/// The error of second differences with step kObserverStep of a position of size `reach` that is carried by `layers` turns, whose
/// derivatives W bounds: W^2 (W h)^6, and 32 eps per turn amplified by 64 / h^2 (second differences, extrapolated twice).
Q difference_bound(Q W, int layers, Q reach) {
  const Q Wh = W * kObserverStep;
  return reach *
         (W * W * Wh * Wh * Wh * Wh * Wh * Wh + Q(32 * 64 * layers) * real::epsilon<Q>() / (kObserverStep * kObserverStep));
}
/// Sum of m |r|^2 and m |r|, by which the acceleration's error is multiplied.
Q lever(const Particles<Q>& particles, Q reach) {
  Q sum = Q(0);
  for (const Particle<Q>& p : particles) sum += p.m * norm(p.r) * reach;
  return sum;
}

TEST(PaperTorques, TotalNonInertialTorqueIsMinusTheInertialRate) {
  Random random(202);
  for (int k = 0; k < 6; ++k) {
    const PrescribedMotion<Q> first = test::random_motion<Q>(random), second = test::random_motion<Q>(random);
    FrameStack<Q> stack('I');
    stack.add('E', first).add('A', second);
    const Q t = Q(random.uniform(-1, 1));
    // Each particle moves in A on its own parabola r + v (t' - t) + a (t' - t)^2 / 2.
    const Particles<Q> particles = test::random_particles<Q>(random);
    Vec3<Q> dL_inertial_I = Vec3<Q>::Zero(), dL_A = Vec3<Q>::Zero();
    const auto attitude = [&](Q at) {
      return Mat3<Q>(test::rodrigues(first.axis, first.angle(at)) * test::rodrigues(second.axis, second.angle(at)));
    };
    const Mat3<Q> R_IA = attitude(t);
    for (const Particle<Q>& p : particles) {
      const Vec3<Q> a = random.vector<Q>(3);
      const auto position_I = [&](Q at) {
        return Vec3<Q>(attitude(at) * (p.r + (at - t) * p.rdot + (at - t) * (at - t) / 2 * a));
      };
      dL_inertial_I += p.m * Vec3<Q>(R_IA * p.r).cross(test::second_derivative(position_I, t, kObserverStep));
      dL_A += p.m * p.r.cross(a);
    }
    const FrameKinematics<Q> seen = stack.kinematics('I', 'A', t);
    const Vec3<Q> w_IA_A = R_IA.transpose() * seen.w_AB_A, alpha_IA_A = R_IA.transpose() * seen.alpha_AB_A;
    const Mat3<Q> S = test::second_moment(particles);
    const Vec3<Q> total = coriolis_torque(w_IA_A, test::general_velocity_moment(particles)) + transverse_torque(alpha_IA_A, S) +
                          centrifugal_torque(w_IA_A, S);
    // The parabola stays within 1.8 and has derivatives of at most (3 sqrt 3)^n.
    const Q W = test::derivative_bound(first) + test::derivative_bound(second) + Q(5.2);
    const Q bound = lever(particles, Q(1)) * difference_bound(W, 2, Q(1.8));
    ASSERT_LT(static_cast<double>(bound), testing::rounding(1));
    EXPECT_TRUE(close<Q>(total, Vec3<Q>(dL_A - R_IA.transpose() * dL_inertial_I), bound));
  }
}

TEST(PaperTorques, AnyObservingFrame) {
  // A top on a platform that turns unevenly, with the pivot off its centre, on an Earth with 1 rad/s. The top's motion in P is
  // prescribed, and the torque that it needs is computed from inertial positions alone.
  Random random(203);
  for (int k = 0; k < 6; ++k) {
    const Site site{random.uniform(-80, 80), random.uniform(-180, 180), 0, 0};
    const Q rate = Q(1);
    Platform<Q> platform{test::random_motion<Q>(random), random.vector<Q>(0.5)};
    const PrescribedMotion<Q> top = test::random_motion<Q>(random);
    FrameStack<Q> stack = earth_laboratory_stack<Q>(site, rate, &platform.turn);
    const Particles<Q> particles = test::random_particles<Q>(random);
    const Q t = Q(random.uniform(-1, 1));

    const Mat3<Q> R_EL = laboratory_attitude<Q>(site).matrix();
    const auto R_IP = [&](Q at) {
      return Mat3<Q>(test::rodrigues<Q>(Vec3<Q>::UnitZ(), rate * at) * R_EL *
                     test::rodrigues(platform.turn.axis, platform.turn.angle(at)));
    };
    const auto R_PB = [&](Q at) { return test::rodrigues(top.axis, top.angle(at)); };
    const Mat3<Q> R_IP_t = R_IP(t), R_PB_t = R_PB(t);
    Vec3<Q> torque_P = Vec3<Q>::Zero(), dL_P = Vec3<Q>::Zero();
    Particles<Q> seen_in_P = particles;
    for (Particle<Q>& p : seen_in_P) {
      const Vec3<Q> r_B = p.r;
      const auto position_I = [&](Q at) { return Vec3<Q>(R_IP(at) * (platform.pivot_offset_P + R_PB(at) * r_B)); };
      const auto position_P = [&](Q at) { return Vec3<Q>(R_PB(at) * r_B); };
      p.r = R_PB_t * r_B;
      torque_P += p.m * p.r.cross(R_IP_t.transpose() * test::second_derivative(position_I, t, kObserverStep));
      dL_P += p.m * p.r.cross(test::second_derivative(position_P, t, kObserverStep));
    }

    const FrameKinematics<Q> IP = stack.kinematics('I', 'P', t);
    const Vec3<Q> w_IP_P = R_IP_t.transpose() * IP.w_AB_A, alpha_IP_P = R_IP_t.transpose() * IP.alpha_AB_A;
    const Vec3<Q> w_PB_P = top.angle_rate(t) * top.axis;
    const Mat3<Q> S_P = turned_tensor<Q>(R_PB_t, test::second_moment(particles));
    const Vec3<Q> cor = coriolis_torque(w_IP_P, velocity_moment(S_P, w_PB_P)), trans = transverse_torque(alpha_IP_P, S_P),
                  cent = centrifugal_torque(w_IP_P, S_P);
    const Vec3<Q> W_L = rate * celestial_axis_L<Q>(site);
    const PivotAcceleration<Q> a = pivot_acceleration(platform, W_L, W_L, t);
    const Mat3<Q> R_LP = test::rodrigues(platform.turn.axis, platform.turn.angle(t));
    const Vec3<Q> a_P = R_LP.transpose() * (a.of_platform_L + a.of_earth_rate_L);
    const Vec3<Q> driven_pivot = -field_torque<Q>(test::mass_moment(seen_in_P), a_P);

    const Q W = rate + test::derivative_bound(platform.turn) + test::derivative_bound(top);
    const Q bound = lever(particles, Q(1)) * difference_bound(W, 4, Q(3));
    ASSERT_LT(static_cast<double>(bound), testing::rounding(1));
    EXPECT_TRUE(close<Q>(Vec3<Q>(cor + trans + cent + torque_P + driven_pivot), dL_P, bound));
    // Every part counts: a sign flip of any could not pass.
    for (const Vec3<Q>& part : {cor, trans, cent, driven_pivot}) EXPECT_GT(static_cast<double>(norm(part)), 0.01);
  }
}

TEST(PaperTorques, PivotAccelerationAgainstDifferentiation) {
  Random random(204);
  for (const PlatformMotion motion : {PlatformMotion::constant, PlatformMotion::ramp, PlatformMotion::harmonic})
    for (int k = 0; k < 5; ++k) {
      PlatformSpec spec;
      spec.motion = motion;
      for (double& component : spec.axis) component = random.uniform(-3, 3);
      for (double& component : spec.pivot_offset_m) component = random.uniform(-1, 1);
      spec.rate_rad_s = random.uniform(-2, 2), spec.acceleration_rad_s2 = random.uniform(-2, 2);
      spec.amplitude_rad = random.uniform(0.2, 0.5), spec.frequency_hz = random.uniform(0.1, 0.5);
      spec.phase_deg = random.uniform(-180, 180);
      const Platform<Q> platform = make_platform<Q>(spec);
      const Q t = Q(random.uniform(-1, 1));
      const Vec3<Q> W_L = random.vector<Q>();

      // The motion of the scenario's definition, written out here.
      Vec3<Q> axis, offset;
      for (int i = 0; i < 3; ++i) {
        axis[i] = Q(spec.axis[static_cast<std::size_t>(i)]);
        offset[i] = Q(spec.pivot_offset_m[static_cast<std::size_t>(i)]);
      }
      axis /= real::sqrt(axis.dot(axis));
      const auto angle = [&](Q at) -> Q {
        switch (motion) {
          case PlatformMotion::constant: return spec.rate_rad_s * at;
          case PlatformMotion::ramp: return spec.rate_rad_s * at + spec.acceleration_rad_s2 * at * at / 2;
          default:
            return spec.amplitude_rad *
                   real::sin(2 * real::pi<Q>() * spec.frequency_hz * at + real::pi<Q>() * spec.phase_deg / 180);
        }
      };
      const Q rate = norm(W_L);
      const auto position_L = [&](Q at) { return Vec3<Q>(test::rodrigues<Q>(axis, angle(at)) * offset); };
      // Inertial axes that agree with the laboratory's at t.
      const auto position_I = [&](Q at) { return Vec3<Q>(test::rodrigues<Q>(W_L / rate, rate * (at - t)) * position_L(at)); };
      const PivotAcceleration<Q> a = pivot_acceleration(platform, W_L, W_L, t);
      const Vec3<Q> of_platform_L = test::second_derivative(position_L, t, kObserverStep);
      const Q bound = difference_bound(rate + Q(8), 2, Q(2));
      ASSERT_LT(static_cast<double>(bound), testing::rounding(0.01));
      EXPECT_TRUE(close<Q>(a.of_platform_L, of_platform_L, bound));
      EXPECT_TRUE(close<Q>(a.of_earth_rate_L, Vec3<Q>(test::second_derivative(position_I, t, kObserverStep) - of_platform_L),
                           Q(2) * bound));
      // Linear in the scaled rate: 2^-300 of it keeps every digit.
      const Vec3<Q> scaled = pivot_acceleration<Q>(platform, W_L, Q(0x1p-300) * W_L, t).of_earth_rate_L;
      EXPECT_TRUE(identical(scaled, Q(0x1p-300) * a.of_earth_rate_L));
    }
}

/// One random state of a body, and the rate that each observer's equation gives for it.
template <class T>
struct State {
  Particles<T> particles;  ///< in body axes
  Body<T> body;
  Quaternion<T> q_LB, q_NL;
  Mat3<T> R_LB, R_NL;
  Vec3<T> w_LB_B, field_L;
  T size;       ///< size of the torques
  T condition;  ///< condition number of the inertia tensor

  explicit State(Random& random) : particles(test::exact_particles<T>(random)), body(make_body<T>(test::body_spec(particles))) {
    q_LB = random.quaternion<T>(1.25);  // the norm must not matter
    q_NL = random.quaternion<T>(0.75);
    R_LB = rotation_matrix(q_LB), R_NL = rotation_matrix(q_NL);
    w_LB_B = random.vector<T>(2);
    field_L = random.vector<T>(10);
  }
  void measure(const Model<T>& model) {
    const T rate = norm(w_LB_B) + norm(model.W_IL_L);
    size = body.S_BP_B.trace() * rate * rate + norm(model.mass_moment_B) * norm(field_L);
    condition = body.I_BP_B.cwiseAbs().maxCoeff() * body.I_BP_B_inverse.cwiseAbs().maxCoeff() * T(9);
  }
  Vec3<T> W_B(const Model<T>& model) const { return R_LB.transpose() * model.W_IL_L; }

  // The implied derivative, in body axes, of w_IB.
  Vec3<T> rate_of_laboratory(const Model<T>& model, bool full) const {
    const Motion<T> x{q_LB, R_LB * (body.I_BP_B * w_LB_B)};
    const Vec3<T> torque_L =
        full ? non_inertial_torque<SceneKind::full>(model, x) : non_inertial_torque<SceneKind::plain>(model, x);
    const Motion<T> xdot = laboratory_equation<T>(model, x, field_L, torque_L);
    // (dL'/dt)_L = (dL'/dt)_B + w_LB x L', and w_IB = w_LB + W with W at rest in L.
    const Vec3<T> wdot_LB_B = body.I_BP_B_inverse * (R_LB.transpose() * xdot.m - w_LB_B.cross(body.I_BP_B * w_LB_B));
    return wdot_LB_B + W_B(model).cross(w_LB_B);
  }
  template <SceneKind K>
  Vec3<T> rate_of_body(const Model<T>& model) const {
    return body_equation<true, K, T>(model, {q_LB, w_LB_B + W_B(model)}, field_L).m;
  }
  template <SceneKind K>
  Vec3<T> rate_of_inertial(const Model<T>& model) const {
    const Vec3<T> w_IB_B = w_LB_B + W_B(model), L_B = body.I_BP_B * w_IB_B;
    const Mat3<T> R_NB = R_NL * R_LB;
    const Motion<T> xdot = inertial_equation<true, K, T>(model, {q_NL * q_LB, R_NB * L_B}, field_L, R_NL);
    return body.I_BP_B_inverse * (R_NB.transpose() * xdot.m - w_IB_B.cross(L_B));
  }
  /// Bound on a rate's derivative: 128 for some 40 operations in three components on each path, times the condition of the
  /// inverse.
  T bound() const { return T(128) * real::epsilon<T>() * condition * size / body.I_BP_B.cwiseAbs().maxCoeff(); }
};

template <class T>
Model<T> model_of(const State<T>& s, Random& random, double rate, const TorqueWeights<T>& weights = {}) {
  return make_model<T>(s.body, Site{random.uniform(-90, 90), 0, 0, 9.8}, rate, weights, nullptr);
}

TEST(PaperTorques, BothRightHandSidesAgree) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(205);
    for (int k = 0; k < 2 * kObserverCases; ++k) {
      State<T> s(random);
      const Model<T> model = model_of(s, random, k % 4 == 0 ? -0.25 : k % 4 == 1 ? 3.0 : 1.0);
      s.measure(model);
      const Vec3<T> laboratory = s.rate_of_laboratory(model, false), body = s.template rate_of_body<SceneKind::plain>(model),
                    inertial = s.template rate_of_inertial<SceneKind::plain>(model);
      EXPECT_TRUE(close<T>(laboratory, body, s.bound()));
      EXPECT_TRUE(close<T>(inertial, body, s.bound()));
      // And they are right: every particle's inertial acceleration times its mass is its force, moment about the pivot.
      const Vec3<T> w = s.w_LB_B + s.W_B(model);
      const Vec3<T> needed = inertial_rate(s.particles, w, body).value;
      const Vec3<T> applied = test::mass_moment(s.particles).cross(s.R_LB.transpose() * s.field_L);
      EXPECT_TRUE(close<T>(needed, applied, s.bound() * s.body.S_BP_B.trace() + round_off(s.particles, s.size)));
      // The Earth's torques are far above the bound.
      const Vec3<T> W = s.W_B(model);
      const Vec3<T> cor = coriolis_torque(W, velocity_moment(s.body.S_BP_B, s.w_LB_B)),
                    cent = centrifugal_torque(W, s.body.S_BP_B);
      EXPECT_GT(static_cast<double>(norm(cor)), 1e3 * static_cast<double>(s.bound()));
      EXPECT_GT(static_cast<double>(norm(cent)), 1e3 * static_cast<double>(s.bound()));
    }
  });
}

TEST(PaperTorques, SwitchedOffTorquesAreLeftOutForEveryObserver) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(206);
    for (int mask = 0; mask < 8; ++mask)
      for (int k = 0; k < 5; ++k) {
        State<T> s(random);
        const TorqueWeights<T> weights{T(mask & 1 ? 1 : 0), T(mask & 2 ? 1 : 0), T(mask & 4 ? 1 : 0)};
        const Model<T> model = model_of(s, random, 1.0, weights);
        s.measure(model);
        EXPECT_EQ(model.kind, mask == 7 ? SceneKind::plain : SceneKind::full);
        const Vec3<T> laboratory = s.rate_of_laboratory(model, true);
        EXPECT_TRUE(close<T>(s.template rate_of_body<SceneKind::full>(model), laboratory, s.bound())) << mask;
        EXPECT_TRUE(close<T>(s.template rate_of_inertial<SceneKind::full>(model), laboratory, s.bound())) << mask;
        // dL'/dt in the laboratory is what is left, summed over particles that move in L.
        Particles<T> particles = s.particles;
        test::turn_rigidly(particles, s.w_LB_B);
        const Vec3<T> W_B = s.W_B(model);
        Vec3<T> torque_B = test::mass_moment(particles).cross(s.R_LB.transpose() * s.field_L);
        if (mask & 1) torque_B += test::coriolis_sum(particles, W_B).value;
        if (mask & 4) torque_B += test::centrifugal_sum(particles, W_B).value;
        const Vec3<T> wdot_LB_B = laboratory - W_B.cross(s.w_LB_B);
        const Vec3<T> dL_B = s.body.I_BP_B * wdot_LB_B + s.w_LB_B.cross(s.body.I_BP_B * s.w_LB_B);
        EXPECT_TRUE(close<T>(dL_B, torque_B, s.bound() * s.body.S_BP_B.trace() + round_off(particles, s.size))) << mask;
      }
  });
}

}  // namespace
}  // namespace earthtop
