// SPDX-License-Identifier: GPL-3.0-or-later
/// The ledger of one state: its two sides compared with each other, with sums over particles, and with known torques.

#include "earthtop/model/ledger.hpp"

#include <cmath>

#include "earthtop/frames/frame_stack.hpp"
#include "model/ledger_sizes.hpp"
#include "paper/particles.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::kLedgerObservers;
using test::kLedgerRounding;
using test::ledger_size;
using test::Particle;
using test::Particles;
using test::Random;
using test::round_off;

constexpr double kLatitudes[] = {50, -90, 0, 90, -35};

/// A body of particles, its state, and a platform that turns unevenly, with the pivot off its centre.
template <class T>
struct LedgerScene {
  Particles<T> particles;  ///< in body axes
  Platform<T> platform;
  Site site;
  Model<T> model;
  T t;
  Quaternion<T> q_LB;
  Vec3<T> w_LB_B;

  LedgerScene(Random& random, double earth_rate, const TorqueWeights<T>& weights = {}, bool on_platform = true)
      : particles(test::exact_particles<T>(random)) {
    platform.turn = test::random_motion<T>(random);
    platform.pivot_offset_P = random.vector<T>(0.5);
    site = {kLatitudes[random.integer(0, 4)], random.uniform(-180, 180), 0, 9.75};
    model =
        make_model<T>(make_body<T>(test::body_spec(particles)), site, earth_rate, weights, on_platform ? &platform : nullptr);
    t = T(random.uniform(0, 2));
    q_LB = random.quaternion<T>(1.25);  // the norm must not matter
    w_LB_B = random.vector<T>(4);
  }
  LedgerEntry<T> entry(LedgerObserver observer) const { return ledger_entry(observer, model, t, q_LB, w_LB_B); }
  T size(LedgerObserver observer) const { return ledger_size(observer, model, t, w_LB_B); }
  T bound(LedgerObserver observer) const { return T(kLedgerRounding) * real::epsilon<T>() * size(observer); }
};

template <class T>
TorqueWeights<T> weights_of(int mask) {
  return {T(mask & 1 ? 1 : 0), T(mask & 2 ? 1 : 0), T(mask & 4 ? 1 : 0)};
}

TEST(Ledger, ResidualIsRoundOff) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(601);
    T largest = T(0);
    for (const double rate : {kEarthRateWgs84, 1.0, -3.0, 0.0})
      for (int mask = 0; mask < 8; ++mask)
        for (int k = 0; k < 8; ++k) {
          const LedgerScene<T> s(random, rate, weights_of<T>(mask), k % 4 != 0);
          for (const LedgerObserver observer : kLedgerObservers) {
            const LedgerEntry<T> entry = s.entry(observer);
            EXPECT_TRUE(close<T>(entry.residual_A, Vec3<T>::Zero(), s.bound(observer)))
                << to_string(observer) << ", rate " << rate << ", mask " << mask;
            largest = std::max(largest, norm(entry.residual_A) / (real::epsilon<T>() * s.size(observer)));
          }
        }
    // A bound that no round-off comes near would hide a wrong torque.
    EXPECT_GT(static_cast<double>(largest), 0.05 * kLedgerRounding);
  });
}

/// Frame A as computed by the frame stack, and the particles' positions and velocities in it.
template <class T>
struct Seen {
  Vec3<T> w_IA_A, alpha_IA_A;
  Particles<T> particles;
  Vec3<T> field_A;  ///< apparent gravity less the pivot's acceleration
};
template <class T>
Seen<T> seen_from(const LedgerScene<T>& s, char A, const Vec3<T>& alpha_LB_L) {
  FrameStack<T> stack = earth_laboratory_stack<T>(s.site, s.model.W_IL_L.dot(celestial_axis_L<T>(s.site)), &s.platform.turn);
  const Mat3<T> R_LB = rotation_matrix(s.q_LB);
  const FrameKinematics<T> LB{Rotation<T>(s.q_LB), R_LB * s.w_LB_B, alpha_LB_L};
  stack.add('B', [&](T at) { return compose(inverse(stack.kinematics('L', 'P', at)), LB); });
  const FrameKinematics<T> IA = stack.kinematics('I', A, s.t), AB = stack.kinematics(A, 'B', s.t);
  const Mat3<T> R_IA = IA.R_AB.matrix(), R_AB = AB.R_AB.matrix();
  Seen<T> seen{R_IA.transpose() * IA.w_AB_A, R_IA.transpose() * IA.alpha_AB_A, s.particles, {}};
  for (Particle<T>& p : seen.particles) p.r = R_AB * p.r;
  test::turn_rigidly(seen.particles, AB.w_AB_A);
  seen.field_A = stack.attitude(A, 'L', s.t).matrix() * pivot_field<SceneKind::full>(s.model, s.t).rotating_L;
  return seen;
}

TEST(Ledger, TorquesAreSumsOverParticles) {
  // With Omega = 1 rad/s the sign of every torque matters. The frames' rates come from the frame stack.
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(602);
    for (int k = 0; k < 20; ++k) {
      const LedgerScene<T> s(random, k % 2 == 0 ? 1.0 : -1.0);
      for (const LedgerObserver observer : {LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
        const LedgerEntry<T> entry = s.entry(observer);
        const char A = observer == LedgerObserver::laboratory ? 'L' : observer == LedgerObserver::platform ? 'P' : 'B';
        Vec3<T> alpha_LB_L = Vec3<T>::Zero();
        if (observer == LedgerObserver::body) {
          // The force that each particle needs to follow the body must be the force on it; the acceleration follows from this.
          const Mat3<T> R_LB = rotation_matrix(s.q_LB), theta = test::inertia(s.particles);
          const Vec3<T> w_IB_B = s.w_LB_B + R_LB.transpose() * s.model.W_IL_L;
          const Vec3<T> field_B = R_LB.transpose() * pivot_field<SceneKind::full>(s.model, s.t).rotating_L;
          const Vec3<T> needed_B =
              test::mass_moment(s.particles).cross(field_B) + test::centrifugal_sum(s.particles, w_IB_B).value;
          const Vec3<T> alpha_IB_L = R_LB * (theta.inverse() * needed_B);
          alpha_LB_L = alpha_IB_L - s.model.W_IL_L.cross(R_LB * s.w_LB_B);
        }
        const Seen<T> seen = seen_from(s, A, alpha_LB_L);
        const auto cor = test::coriolis_sum(seen.particles, seen.w_IA_A);
        const auto trans = test::transverse_sum(seen.particles, seen.alpha_IA_A);
        const auto cent = test::centrifugal_sum(seen.particles, seen.w_IA_A);
        const T bound = s.bound(observer) + round_off(seen.particles, cor.size + trans.size + cent.size);
        ASSERT_LT(static_cast<double>(bound), static_cast<double>(T(1e4) * real::epsilon<T>() * s.size(observer)));
        EXPECT_TRUE(close<T>(entry.tau_cor_A, cor.value, bound)) << A;
        EXPECT_TRUE(close<T>(entry.tau_trans_A, trans.value, bound)) << A;
        EXPECT_TRUE(close<T>(entry.tau_cent_A, cent.value, bound)) << A;
        EXPECT_TRUE(close<T>(entry.tau_phys_A, test::mass_moment(seen.particles).cross(seen.field_A), bound)) << A;
        const double visible = 1e3 * static_cast<double>(bound);
        EXPECT_GT(static_cast<double>(norm(entry.tau_phys_A)), visible);
        EXPECT_GT(static_cast<double>(norm(entry.tau_cent_A)), visible);
        EXPECT_GT(static_cast<double>(norm(A == 'B' ? entry.tau_trans_A : entry.tau_cor_A)), visible);
        EXPECT_GT(static_cast<double>(norm(A == 'L' ? entry.tau_cor_A : entry.tau_trans_A)), visible);
      }
      // The inertial observer's axes: those of the laboratory at t = 0, which has turned by W t since.
      const LedgerEntry<T> entry = s.entry(LedgerObserver::inertial);
      const Mat3<T> R_NL = test::rodrigues<T>(s.model.W_IL_L / norm(s.model.W_IL_L), norm(s.model.W_IL_L) * s.t);
      const Seen<T> seen = seen_from(s, 'L', Vec3<T>(Vec3<T>::Zero()));
      EXPECT_TRUE(close<T>(entry.tau_phys_A, R_NL * test::mass_moment(seen.particles).cross(seen.field_A),
                           s.bound(LedgerObserver::inertial)));
    }
  });
}

TEST(Ledger, KnownTorquesOfASpinningTop) {
  // A symmetric top with its axis to the East, Omega = 1 rad/s at 30 degrees North: every torque by hand.
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    BodySpec body;
    body.mass_kg = 2;
    body.center_of_mass_m = {0, 0, 0.25};
    body.inertia_kg_m2 = {{{3, 0, 0}, {0, 3, 0}, {0, 0, 2}}};
    Platform<T> platform;
    platform.turn.acceleration = T(0.5);  // about Up, from rest
    const Model<T> model = make_model<T>(make_body<T>(body), Site{30, 0, 0, 8}, 1.0, {}, &platform);
    const T h = real::sqrt(T(0.5)), spin = T(10);
    const Quaternion<T> q_LB{h, Vec3<T>(T(0), h, T(0))};  // body axes 1, 2, 3 point down, North, East
    const T north = real::sqrt(T(0.75)), up = T(0.5);     // the Earth's rate
    const T bound = T(kLedgerRounding) * real::epsilon<T>() * T(100);
    for (const LedgerObserver observer : {LedgerObserver::laboratory, LedgerObserver::platform}) {
      const LedgerEntry<T> entry = ledger_entry(observer, model, T(0), q_LB, Vec3<T>(T(0), T(0), spin));
      EXPECT_TRUE(close<T>(entry.tau_phys_A, Vec3<T>(T(0), T(4), T(0)), bound));  // gravity tips it about North: m g l
      EXPECT_TRUE(close<T>(entry.tau_cor_A, Vec3<T>(T(0), -T(20) * up, T(20) * north), bound));  // (I3 s) n x W
      // -W x Theta W with moments 2 about East, 3 about North and Up.
      EXPECT_TRUE(close<T>(entry.tau_cent_A, Vec3<T>::Zero(), bound));
      const bool on_platform = observer == LedgerObserver::platform;
      EXPECT_TRUE(close<T>(entry.tau_trans_A, Vec3<T>(T(0), T(0), on_platform ? T(-1.5) : T(0)), bound));  // -Theta alpha
    }
    // Tipped by 45 degrees to the North about East: -W x Theta W = (I1 - I3) (W.n) W x n.
    const Vec3<T> W(T(0), north, up), n(T(0), h, h);
    const T c = real::cos(real::pi<T>() / T(8)), s = real::sin(real::pi<T>() / T(8));
    const Quaternion<T> tipped{c, Vec3<T>(-s, T(0), T(0))};
    const LedgerEntry<T> entry = ledger_entry<T>(LedgerObserver::laboratory, model, T(0), tipped, Vec3<T>::Zero());
    EXPECT_TRUE(close<T>(entry.tau_cent_A, W.dot(n) * W.cross(n), bound));
    EXPECT_GT(static_cast<double>(norm(entry.tau_cent_A)), 0.2);
    EXPECT_TRUE(identical(entry.tau_cor_A, Vec3<T>::Zero()));
  });
}

TEST(Ledger, WhatAnObserverDoesNotCountIsZero) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(603);
    const Vec3<T> zero = Vec3<T>::Zero();
    for (int k = 0; k < 10; ++k) {
      const LedgerScene<T> s(random, 1.0);
      const LedgerEntry<T> inertial = s.entry(LedgerObserver::inertial);
      EXPECT_TRUE(identical(inertial.tau_cor_A, zero));
      EXPECT_TRUE(identical(inertial.tau_trans_A, zero));
      EXPECT_TRUE(identical(inertial.tau_cent_A, zero));
      EXPECT_TRUE(identical(s.entry(LedgerObserver::laboratory).tau_trans_A, zero));
      const LedgerEntry<T> body = s.entry(LedgerObserver::body);
      EXPECT_TRUE(identical(body.tau_cor_A, zero));
      EXPECT_TRUE(identical(body.dL_dt_A, zero));
    }
  });
  Random random(604);
  const LedgerScene<double> s(random, 1.0);
  for (const LedgerObserver observer : kLedgerObservers) {
    const LedgerEntry<double> entry = s.entry(observer);
    for (const Vec3<double>& column : {entry.tau_phys_A, entry.tau_cor_A, entry.tau_trans_A, entry.tau_cent_A, entry.dL_dt_A})
      for (int i = 0; i < 3; ++i) EXPECT_FALSE(column[i] == 0 && std::signbit(column[i])) << to_string(observer);
  }
}

template <class T>
void expect_same(const LedgerEntry<T>& a, const LedgerEntry<T>& b) {
  EXPECT_TRUE(identical(a.tau_phys_A, b.tau_phys_A));
  EXPECT_TRUE(identical(a.tau_cor_A, b.tau_cor_A));
  EXPECT_TRUE(identical(a.tau_trans_A, b.tau_trans_A));
  EXPECT_TRUE(identical(a.tau_cent_A, b.tau_cent_A));
  EXPECT_TRUE(identical(a.dL_dt_A, b.dL_dt_A));
  EXPECT_TRUE(identical(a.residual_A, b.residual_A));
}

TEST(Ledger, WithoutAPlatformItsObserverIsTheLaboratorys) {
  Random random(605);
  for (int mask = 0; mask < 8; ++mask) {
    const LedgerScene<double> s(random, 1.0, weights_of<double>(mask), false);
    expect_same(s.entry(LedgerObserver::platform), s.entry(LedgerObserver::laboratory));
  }
}

TEST(Ledger, SwitchedOffTorqueIsAppliedWithTheOtherSign) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(606);
    for (int mask = 0; mask < 8; ++mask) {
      LedgerScene<T> s(random, 1.0);
      const LedgerEntry<T> whole_L = s.entry(LedgerObserver::laboratory);
      LedgerScene<T> part = s;
      part.model = make_model<T>(make_body<T>(test::body_spec(s.particles)), s.site, 1.0, weights_of<T>(mask), &s.platform);
      const LedgerEntry<T> entry_L = part.entry(LedgerObserver::laboratory);
      const bool coriolis = (mask & 1) != 0, centrifugal = (mask & 4) != 0;
      EXPECT_TRUE(identical(entry_L.tau_cor_A, coriolis ? whole_L.tau_cor_A : Vec3<T>(Vec3<T>::Zero())));
      EXPECT_TRUE(identical(entry_L.tau_cent_A, centrifugal ? whole_L.tau_cent_A : Vec3<T>(Vec3<T>::Zero())));
      EXPECT_TRUE(identical(entry_L.tau_phys_A, whole_L.tau_phys_A));
      Vec3<T> missing_L = Vec3<T>::Zero();
      if (!coriolis) missing_L += whole_L.tau_cor_A;
      if (!centrifugal) missing_L += whole_L.tau_cent_A;
      for (const LedgerObserver observer : {LedgerObserver::inertial, LedgerObserver::platform, LedgerObserver::body}) {
        const Mat3<T> R_LB = rotation_matrix(s.q_LB);
        const PrescribedMotion<T>& turn = s.platform.turn;
        const Vec3<T>& W = s.model.W_IL_L;
        const Mat3<T> R_LA = observer == LedgerObserver::inertial   ? test::rodrigues<T>(-W / norm(W), norm(W) * s.t)
                             : observer == LedgerObserver::platform ? test::rodrigues(turn.axis, turn.angle(s.t))
                                                                    : R_LB;
        const LedgerEntry<T> whole = s.entry(observer), entry = part.entry(observer);
        EXPECT_TRUE(close<T>(entry.tau_phys_A, whole.tau_phys_A - R_LA.transpose() * missing_L, part.bound(observer)))
            << to_string(observer) << " " << mask;
        EXPECT_TRUE(identical(entry.tau_cor_A, whole.tau_cor_A));
        EXPECT_TRUE(identical(entry.tau_cent_A, whole.tau_cent_A));
      }
    }
  });
}

TEST(Ledger, NothingTurnsNothingIsCounted) {
  // A free body at rest on an Earth at rest, and one under gravity alone.
  BodySpec body;
  body.mass_kg = 1;
  body.inertia_kg_m2 = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const double arm : {0.0, 0.5}) {
    body.center_of_mass_m = {0, 0, arm};
    const auto model = make_model<double>(make_body<double>(body), Site{45, 0, 0, 9.75}, 0.0, {}, nullptr);
    const Quaternion<double> q_LB{std::sqrt(0.5), Vec3<double>(std::sqrt(0.5), 0, 0)};
    LedgerLargest largest;
    for (const LedgerObserver observer : kLedgerObservers) {
      const auto entry = ledger_entry<double>(observer, model, 100.0, q_LB, Vec3<double>::Zero());
      largest.include(ledger_row(entry));
      EXPECT_NEAR(norm(entry.tau_phys_A), arm * 9.75, 1e-14);
      EXPECT_EQ(norm(entry.tau_cor_A), 0);
      EXPECT_EQ(norm(entry.tau_cent_A), 0);
    }
    EXPECT_LE(largest.residual, arm * 128 * real::epsilon<double>() * 9.75);
    EXPECT_EQ(largest.tau_cor, 0);
    EXPECT_FALSE(std::isnan(largest.relative_residual()));
  }
}

TEST(Ledger, ASlowEarthsTorquesKeepTheirDigits) {
  // 1e-300 rad/s: the Coriolis torque is that of 1 rad/s times 1e-300; the centrifugal one is below every number.
  Random random(607);
  LedgerScene<double> s(random, 1.0, {}, false);
  const LedgerEntry<double> fast = s.entry(LedgerObserver::laboratory);
  s.model = make_model<double>(make_body<double>(test::body_spec(s.particles)), s.site, 1e-300, {}, nullptr);
  const LedgerEntry<double> slow = s.entry(LedgerObserver::laboratory);
  EXPECT_TRUE(close<double>(slow.tau_cor_A * 1e300, fast.tau_cor_A, 8 * real::epsilon<double>() * norm(fast.tau_cor_A)));
  EXPECT_EQ(norm(slow.tau_cent_A), 0);
  for (const LedgerObserver observer : kLedgerObservers)
    EXPECT_TRUE(close<double>(s.entry(observer).residual_A, Vec3<double>::Zero(), s.bound(observer)));
}

TEST(Ledger, LargestAreNormsAndWhatIsNoNumberIsSeen) {
  LedgerRow<double> entry;
  entry.tau_phys_A = {3, 4, 0};
  entry.tau_cor_A = {0, 0, -2};
  entry.residual_A = {0, 1, 0};
  LedgerLargest largest;
  largest.include(entry);
  largest.include(LedgerRow<double>());
  EXPECT_EQ(largest.tau_phys, 5);
  EXPECT_EQ(largest.tau_cor, 2);
  EXPECT_EQ(largest.tau_trans, 0);
  EXPECT_EQ(largest.relative_residual(), 0.2);
  entry.residual_A[0] = NAN;
  largest.include(entry);
  largest.include(LedgerRow<double>());
  EXPECT_TRUE(std::isnan(largest.residual));
  EXPECT_TRUE(std::isnan(largest.relative_residual()));
  EXPECT_EQ(LedgerLargest().relative_residual(), 0);
}

}  // namespace
}  // namespace earthtop
