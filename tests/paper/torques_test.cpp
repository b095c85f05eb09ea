// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares the torques of [F] in tensor form with sums over particles, equation by equation.

#include "earthtop/model/torques.hpp"

#include "paper/particles.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Particle;
using test::Particles;
using test::Random;
using test::round_off;

constexpr int kRandomMotions = 25;

TEST(PaperTorques, CoriolisTensorFormEqualsParticleSum) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(101);
    for (int k = 0; k < kRandomMotions; ++k) {
      Particles<T> particles = test::random_particles<T>(random);
      const Vec3<T> w = random.vector<T>(2), w_r = random.vector<T>(2);
      // Any velocities: J is a sum over particles.
      const test::Sum<T> any = test::coriolis_sum(particles, w);
      EXPECT_TRUE(
          close<T>(coriolis_torque(w, test::general_velocity_moment(particles)), any.value, round_off(particles, any.size)));
      // A rigid body's: J from the second moment.
      test::turn_rigidly(particles, w_r);
      const test::Sum<T> rigid = test::coriolis_sum(particles, w);
      const T size = rigid.size + norm(w) * norm(w_r) * test::second_moment(particles).trace();
      EXPECT_TRUE(close<T>(coriolis_torque(w, velocity_moment(test::second_moment(particles), w_r)), rigid.value,
                           round_off(particles, size)));
    }
  });
}

TEST(PaperTorques, CoriolisTensorFormEqualsParticleSumForRigidBody) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(102);
    for (int k = 0; k < kRandomMotions; ++k) {
      Particles<T> particles = test::random_particles<T>(random);
      const Vec3<T> w_r = random.vector<T>(2);
      test::turn_rigidly(particles, w_r);
      const Mat3<T> S = test::second_moment(particles);
      EXPECT_TRUE(close<T>(velocity_moment(S, w_r), test::general_velocity_moment(particles),
                           round_off(particles, S.trace() * norm(w_r))));
    }
  });
}

TEST(PaperTorques, TransverseTensorFormEqualsParticleSum) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(103);
    for (int k = 0; k < kRandomMotions; ++k) {
      const Particles<T> particles = test::random_particles<T>(random);
      const Vec3<T> alpha = random.vector<T>(2);
      const test::Sum<T> sum = test::transverse_sum(particles, alpha);
      const T bound = round_off(particles, sum.size);
      EXPECT_TRUE(close<T>(transverse_torque(alpha, test::second_moment(particles)), sum.value, bound));
      EXPECT_TRUE(close<T>(Vec3<T>(-(test::inertia(particles) * alpha)), sum.value, bound));  // -Theta alpha
    }
  });
}

TEST(PaperTorques, CentrifugalTensorFormEqualsParticleSum) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(104);
    for (int k = 0; k < kRandomMotions; ++k) {
      const Particles<T> particles = test::random_particles<T>(random);
      const Vec3<T> w = random.vector<T>(2);
      const Mat3<T> S = test::second_moment(particles);
      const test::Sum<T> sum = test::centrifugal_sum(particles, w);
      EXPECT_TRUE(close<T>(centrifugal_torque(w, S), sum.value, round_off(particles, sum.size)));
      // [F]'s triple sum, eps_kmj w_j w_n I_mn with I = -S.
      const Mat3<T> I = -S;
      Vec3<T> triple = Vec3<T>::Zero();
      for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 3; ++m) {
          const int j = (m + 1) % 3, other = (m + 2) % 3;  // eps_kmj = +1 for k, m, j cyclic
          triple[other] += w[j] * w[n] * I(m, n);
          triple[j] -= w[other] * w[n] * I(m, n);
        }
      EXPECT_TRUE(close<T>(centrifugal_torque(w, S), triple, round_off(particles, sum.size)));
      // One of the two rates scaled by a power of two scales the torque, exactly.
      EXPECT_TRUE(identical(centrifugal_torque<T>(w, T(1024) * w, S), T(1024) * centrifugal_torque(w, S)));
    }
  });
}

TEST(PaperTorques, JacobiIdentityFormOfCoriolis) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(105);
    for (const Particle<T>& p : test::random_particles<T>(random)) {
      const Vec3<T> w = random.vector<T>(2);
      const Vec3<T> identity =
          -p.m * p.r.cross(w.cross(p.rdot)) - p.m * w.cross(p.r.cross(p.rdot)) - p.m * p.rdot.cross(w.cross(p.r));
      const Mat3<T> J = p.m * p.r * p.rdot.transpose();
      EXPECT_TRUE(
          close<T>(coriolis_torque(w, J), identity, round_off<T>({p}, T(3) * p.m * norm(p.r) * norm(w) * norm(p.rdot))));
    }
  });
}

TEST(PaperTorques, JacobiIdentityFormOfCentrifugal) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(106);
    for (const Particle<T>& p : test::random_particles<T>(random)) {
      const Vec3<T> w = random.vector<T>(2);
      const Vec3<T> identity = p.m * w.cross((w.cross(p.r)).cross(p.r));
      const Mat3<T> S = p.m * p.r * p.r.transpose();
      EXPECT_TRUE(
          close<T>(centrifugal_torque(w, S), identity, round_off<T>({p}, T(2) * p.m * p.r.squaredNorm() * w.squaredNorm())));
    }
  });
}

TEST(PaperTorques, SignsOfTheTensors) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(107);
    for (int k = 0; k < kRandomMotions; ++k) {
      Particles<T> particles = test::exact_particles<T>(random);
      const Body<T> body = make_body<T>(test::body_spec(particles));
      // Everything is exact: [F]'s I_mn = -integral x_m x_n dm is minus the body's second moment ...
      const Mat3<T> I_paper = -test::second_moment(particles);
      EXPECT_TRUE(identical(body.S_BP_B, -I_paper));
      // ... the moments of inertia are I_1 = -(I_22 + I_33) and so on, the products are I_mn itself.
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        EXPECT_TRUE(close<T>(body.I_BP_B(i, i), -(I_paper(j, j) + I_paper(l, l)), T(0)));
        EXPECT_TRUE(close<T>(body.I_BP_B(i, j), I_paper(i, j), T(0)));
      }
      // J = -S [w]x.
      const Vec3<T> w = random.vector<T>(2);
      test::turn_rigidly(particles, w);
      const T bound = round_off(particles, body.S_BP_B.trace() * norm(w));
      EXPECT_TRUE(close<T>(velocity_moment(body.S_BP_B, w), Mat3<T>(I_paper * cross_matrix(w)), bound));
      EXPECT_TRUE(close<T>(velocity_moment(body.S_BP_B, w), test::general_velocity_moment(particles), bound));
    }
  });
}

TEST(PaperTorques, TraceTerms) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(108);
    for (int k = 0; k < kRandomMotions; ++k) {
      Particles<T> particles = test::random_particles<T>(random);
      const Mat3<T> S = test::second_moment(particles);
      const Vec3<T> w = random.vector<T>(2), w_r = random.vector<T>(2);
      // A rigid body's J has no trace.
      EXPECT_TRUE(close<T>(velocity_moment(S, w_r).trace(), T(0), round_off(particles, S.trace() * norm(w_r))));
      // A swelling cloud's is all of the torque that the other term does not give.
      const T rate = T(random.uniform(0.5, 1.5));
      for (Particle<T>& p : particles) p.rdot = rate * p.r;
      const Mat3<T> J = test::general_velocity_moment(particles);
      const test::Sum<T> sum = test::coriolis_sum(particles, w);
      const T bound = round_off(particles, sum.size);
      EXPECT_TRUE(close<T>(coriolis_torque(w, J), sum.value, bound));
      const Vec3<T> without_trace = T(2) * J.transpose() * w;
      EXPECT_TRUE(close<T>(Vec3<T>(without_trace - sum.value), Vec3<T>(T(2) * rate * S.trace() * w), T(2) * bound));
      EXPECT_GT(static_cast<double>(rate * S.trace() * norm(w)), 1e6 * static_cast<double>(bound));
    }
  });
}

TEST(PaperTorques, VelocityMomentVanishesInTheBodyFrame) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(109);
    for (int k = 0; k < kRandomMotions; ++k) {
      const Mat3<T> S = test::second_moment(test::random_particles<T>(random));
      const Mat3<T> J = velocity_moment<T>(S, Vec3<T>::Zero());
      EXPECT_TRUE(identical(J, Mat3<T>::Zero()));
      EXPECT_TRUE(identical(coriolis_torque(random.vector<T>(2), J), Vec3<T>::Zero()));
    }
  });
}

TEST(PaperTorques, SymmetricTopCoriolisIsTheGyroscopicTorque) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(110);
    for (int k = 0; k < kRandomMotions; ++k) {
      const Vec3<T> n = random.unit<T>(), w = random.vector<T>(2);
      const T I1 = T(random.uniform(1, 3)), I3 = T(random.uniform(0.1, 1.9)), spin = T(random.uniform(-9, 9));
      const Mat3<T> nn = n * n.transpose();
      const Mat3<T> theta = I1 * (Mat3<T>::Identity() - nn) + I3 * nn;
      const Mat3<T> S = (theta.trace() / T(2)) * Mat3<T>::Identity() - theta;
      const T bound = T(64) * real::epsilon<T>() * theta.trace() * real::abs(spin) * norm(w);
      EXPECT_TRUE(close<T>(coriolis_torque<T>(w, velocity_moment<T>(S, spin * n)), Vec3<T>((I3 * spin) * n.cross(w)), bound));
    }
    // Spin up in a frame that turns about East, Up toward South: the axis stays behind, toward North.
    const Mat3<T> S = Vec3<T>(T(1), T(1), T(1)).asDiagonal();
    const Vec3<T> tau = coriolis_torque<T>(Vec3<T>::UnitX(), velocity_moment<T>(S, Vec3<T>::UnitZ()));
    EXPECT_TRUE(identical(tau, Vec3<T>(T(0), T(2), T(0))));
  });
}

TEST(PaperTorques, GravityTopplesALeaningTop) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    // Leaning to the East, with gravity down, the torque is about North: it turns Up toward East.
    const Vec3<T> tau = field_torque<T>(Vec3<T>(T(3), T(0), T(4)), Vec3<T>(T(0), T(0), T(-10)));
    EXPECT_TRUE(identical(tau, Vec3<T>(T(0), T(30), T(0))));
    Random random(111);
    const Particles<T> particles = test::random_particles<T>(random);
    const Vec3<T> f = random.vector<T>(10);
    test::Sum<T> sum;
    for (const Particle<T>& p : particles) sum.add(p.r.cross(p.m * f), p.m * norm(p.r) * norm(f));
    EXPECT_TRUE(close<T>(field_torque<T>(test::mass_moment(particles), f), sum.value, round_off(particles, sum.size)));
  });
}

}  // namespace
}  // namespace earthtop
