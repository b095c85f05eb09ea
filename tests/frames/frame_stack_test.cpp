// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/frame_stack.hpp"

#include "frames/random_cases.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using test::close;
using test::identical;
using test::Random;
using Q = float128;

const std::string kNames = "ABCDEF";

/// A stack of random motions, together with the same attitudes composed by Rodrigues' formula.
struct RandomStack {
  std::vector<PrescribedMotion<Q>> layers;
  FrameStack<Q> stack{'A'};
  Q W = Q(0);  ///< the n-th derivatives of all attitudes stay below W^n for |t| <= 1

  RandomStack(Random& random, int n) {
    for (int i = 0; i < n; ++i) {
      layers.push_back(test::random_motion<Q>(random));
      stack.add(kNames[static_cast<std::size_t>(i) + 1], layers.back());
      W += test::derivative_bound(layers.back());
    }
  }
  int frames() const { return static_cast<int>(layers.size()) + 1; }
  /// The matrix from the layer's coordinates to those of frame A.
  Mat3<Q> outer(int frame, Q t) const {
    Mat3<Q> R = Mat3<Q>::Identity();
    for (int i = 0; i < frame; ++i) {
      const PrescribedMotion<Q>& m = layers[static_cast<std::size_t>(i)];
      const Q angle = m.angle0 + m.rate * t + m.acceleration * t * t / 2 +
                      m.amplitude * real::sin(2 * real::pi<Q>() * m.frequency * t + m.phase);
      R = R * test::rodrigues(m.axis, angle);
    }
    return R;
  }
  Mat3<Q> attitude(int a, int b, Q t) const { return outer(a, t).transpose() * outer(b, t); }
};

/// The vector v for which [v]x is the antisymmetric part of m.
Vec3<Q> axial(const Mat3<Q>& m) { return {(m(2, 1) - m(1, 2)) / 2, (m(0, 2) - m(2, 0)) / 2, (m(1, 0) - m(0, 1)) / 2}; }

constexpr Q kStep = Q(1e-5);
/// The rounding error of an attitude made of `layers` layers: 16 eps each for Rodrigues' formula and the product.
Q round_off(int layers) { return 32 * layers * real::epsilon<Q>(); }

template <class Check>
void for_every_three_frames(std::uint64_t seed, const Check& check) {
  Random random(seed);
  for (int n = 2; n <= 5; ++n)
    for (int k = 0; k < 2; ++k) {
      const RandomStack s(random, n);
      const Q t = Q(random.uniform(-1, 1));
      for (int a = 0; a < s.frames(); ++a)
        for (int b = 0; b < s.frames(); ++b)
          if (a != b) check(s, a, b, t);
    }
}
char name(int frame) { return kNames[static_cast<std::size_t>(frame)]; }

TEST(FrameStack, AttitudesCompose) {
  for_every_three_frames(21, [](const RandomStack& s, int a, int b, Q t) {
    EXPECT_TRUE(close<Q>(s.stack.attitude(name(a), name(b), t).matrix(), s.attitude(a, b, t), round_off(2 * s.frames())));
  });
}

TEST(FrameStack, AngularVelocityEqualsDifferencedAttitude) {
  for_every_three_frames(22, [](const RandomStack& s, int a, int b, Q t) {
    // dR_ab/dt R_ab^T = [w_ab]x in axes of a.
    const Mat3<Q> Rdot = test::first_derivative([&](Q at) { return s.attitude(a, b, at); }, t, kStep);
    const Vec3<Q> w_ab_a = axial(Rdot * s.attitude(a, b, t).transpose());
    const Q Wh = s.W * kStep;
    const Q bound = s.W * Wh * Wh * Wh * Wh * Wh * Wh + round_off(2 * s.frames()) * 8 / kStep;
    ASSERT_LT(static_cast<double>(bound), testing::rounding(0.01));
    for (int c = 0; c < s.frames(); ++c)
      EXPECT_TRUE(
          close<Q>(s.stack.angular_velocity(name(a), name(b), name(c), t), Vec3<Q>(s.attitude(c, a, t) * w_ab_a), bound))
          << name(a) << name(b) << name(c);
  });
}

TEST(FrameStack, AngularAccelerationEqualsDifferencedVelocity) {
  for_every_three_frames(23, [](const RandomStack& s, int a, int b, Q t) {
    // d2R/dt2 R^T = [alpha]x + [w]x^2, and the square is symmetric: alpha, the derivative of w taken in a, is what is left.
    const Mat3<Q> Rdotdot = test::second_derivative([&](Q at) { return s.attitude(a, b, at); }, t, kStep);
    const Vec3<Q> alpha_ab_a = axial(Rdotdot * s.attitude(a, b, t).transpose());
    const Q Wh = s.W * kStep;
    const Q bound = s.W * s.W * Wh * Wh * Wh * Wh * Wh * Wh + round_off(2 * s.frames()) * 64 / (kStep * kStep);
    ASSERT_LT(static_cast<double>(bound), testing::rounding(0.2));
    for (int c = 0; c < s.frames(); ++c)
      EXPECT_TRUE(close<Q>(s.stack.angular_acceleration(name(a), name(b), name(c), t),
                           Vec3<Q>(s.attitude(c, a, t) * alpha_ab_a), bound))
          << name(a) << name(b) << name(c);
  });
}

TEST(FrameStack, SwappedFramesTurnTheOtherWay) {
  for_every_three_frames(24, [](const RandomStack& s, int a, int b, Q t) {
    const Q bound = round_off(2 * s.frames()) * s.W * s.W;
    for (int c = 0; c < s.frames(); ++c) {
      EXPECT_TRUE(close<Q>(s.stack.angular_velocity(name(a), name(b), name(c), t),
                           Vec3<Q>(-s.stack.angular_velocity(name(b), name(a), name(c), t)), bound));
      // w_ab has the same derivative in a and in b.
      EXPECT_TRUE(close<Q>(s.stack.angular_acceleration(name(a), name(b), name(c), t),
                           Vec3<Q>(-s.stack.angular_acceleration(name(b), name(a), name(c), t)), bound));
    }
  });
}

TEST(FrameStack, DoubleAgreesWithExtendedPrecision) {
  Random random(25);
  for (int k = 0; k < 10; ++k) {
    const RandomStack s(random, 4);
    FrameStack<double> stack('A');
    for (int i = 0; i < 4; ++i) {
      const PrescribedMotion<Q>& q = s.layers[static_cast<std::size_t>(i)];
      PrescribedMotion<double> m;
      for (int j = 0; j < 3; ++j) m.axis[j] = static_cast<double>(q.axis[j]);
      m.angle0 = static_cast<double>(q.angle0), m.rate = static_cast<double>(q.rate);
      m.acceleration = static_cast<double>(q.acceleration), m.amplitude = static_cast<double>(q.amplitude);
      m.frequency = static_cast<double>(q.frequency), m.phase = static_cast<double>(q.phase);
      stack.add(name(i + 1), m);
    }
    const double t = random.uniform(-1, 1);
    const Vec3<Q> alpha = s.stack.angular_acceleration('A', 'E', 'C', Q(t));
    const Vec3<double> alpha_double = stack.angular_acceleration('A', 'E', 'C', t);
    // An axis rounded by eps / 2, an angle of up to 8 by 4 eps, and 16 eps a product, for each of 4 layers.
    const double bound = 4 * 32 * real::epsilon<double>() * static_cast<double>(s.W * s.W);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(close<double>(alpha_double[i], static_cast<double>(alpha[i]), bound));
  }
}

TEST(FrameStack, TwoConstantRatesMakeTheCrossTerm) {
  PrescribedMotion<double> outer, inner;
  outer.axis = Vec3<double>::UnitZ(), outer.rate = 2;
  inner.axis = Vec3<double>::UnitX(), inner.rate = 3;
  FrameStack<double> stack('A');
  stack.add('B', outer).add('C', inner);
  // At t = 0 all axes agree: (0,0,2) x (3,0,0) = (0,6,0), and every product is exact.
  EXPECT_TRUE(identical(stack.angular_acceleration('A', 'C', 'A', 0.0), Vec3<double>(0, 6, 0)));
  EXPECT_TRUE(identical(stack.angular_acceleration('A', 'B', 'A', 0.0), Vec3<double>(0, 0, 0)));
  EXPECT_TRUE(identical(stack.angular_acceleration('B', 'C', 'A', 0.0), Vec3<double>(0, 0, 0)));
  EXPECT_TRUE(identical(stack.angular_velocity('A', 'C', 'A', 0.0), Vec3<double>(3, 0, 2)));

  Random random(26);
  for (int k = 0; k < 100; ++k) {
    PrescribedMotion<Q> first, second;
    first.axis = random.unit<Q>(), first.rate = Q(random.uniform(-3, 3));
    second.axis = random.unit<Q>(), second.rate = Q(random.uniform(-3, 3));
    FrameStack<Q> any('A');
    any.add('B', first).add('C', second);
    const Q t = Q(random.uniform(-2, 2));
    const Vec3<Q> w_AB_A = first.rate * first.axis;
    const Vec3<Q> w_BC_A = second.rate * (test::rodrigues(first.axis, Q(first.rate * t)) * second.axis);
    // 64 eps of the product of the rates: a turn by up to 6 rad and a cross product.
    EXPECT_TRUE(
        close<Q>(any.angular_acceleration('A', 'C', 'A', t), Vec3<Q>(w_AB_A.cross(w_BC_A)), 64 * real::epsilon<Q>() * 9));
  }
}

TEST(FrameStack, RefusesNamesItCannotTell) {
  FrameStack<double> stack('A');
  stack.add('B', PrescribedMotion<double>{});
  EXPECT_THROW(stack.add('A', PrescribedMotion<double>{}), std::invalid_argument);
  EXPECT_THROW(stack.add('B', Rotation<double>()), std::invalid_argument);
  EXPECT_THROW(stack.kinematics('A', 'X', 0.0), std::invalid_argument);
  EXPECT_THROW(stack.angular_velocity('A', 'B', 'X', 0.0), std::invalid_argument);
}

TEST(EarthLaboratoryStack, TurnsUniformlyAboutTheCelestialAxis) {
  Random random(27);
  for (int k = 0; k < 50; ++k) {
    const Site site{random.uniform(-90, 90), random.uniform(-180, 180), 0, 9.8};
    const Q rate = Q(k % 2 == 0 ? kEarthRateWgs84 : random.uniform(-2, 2)), t = Q(random.uniform(-3, 3));
    const FrameStack<Q> stack = earth_laboratory_stack<Q>(site, rate);
    const Q bound = 64 * real::epsilon<Q>() * real::abs(rate);  // two rotations of the axis
    EXPECT_TRUE(close<Q>(stack.angular_velocity('I', 'L', 'L', t), Vec3<Q>(rate * celestial_axis_L<Q>(site)), bound));
    EXPECT_TRUE(identical(stack.angular_velocity('I', 'L', 'I', t), Vec3<Q>(Q(0), Q(0), rate)));
    EXPECT_TRUE(identical(stack.angular_velocity('E', 'L', 'L', t), Vec3<Q>::Zero()));
    EXPECT_TRUE(identical(stack.angular_acceleration('I', 'L', 'L', t), Vec3<Q>::Zero()));
    EXPECT_TRUE(identical(stack.attitude('I', 'E', Q(0)).matrix(), Mat3<Q>::Identity()));
    EXPECT_TRUE(close<Q>(stack.attitude('I', 'E', t).matrix(), test::rodrigues<Q>(Vec3<Q>::UnitZ(), rate * t),
                         16 * real::epsilon<Q>()));
  }
}

TEST(EarthLaboratoryStack, CarriesAPlatform) {
  Random random(28);
  const Site site{37, 12, 0, 9.8};
  PrescribedMotion<Q> turn;
  turn.axis = random.unit<Q>();
  turn.rate = Q(2), turn.acceleration = Q(-3);
  const FrameStack<Q> stack = earth_laboratory_stack<Q>(site, Q(1), &turn);
  const Q t = Q(0.3);
  const Vec3<Q> W_L = celestial_axis_L<Q>(site), w_LP_L = (Q(2) - 3 * t) * turn.axis;
  const Q bound = 64 * real::epsilon<Q>() * 9;  // rates of up to 3, two rotations
  EXPECT_TRUE(close<Q>(stack.angular_velocity('I', 'P', 'L', t), Vec3<Q>(W_L + w_LP_L), bound));
  // Taken in I, the platform's rate is carried round by the laboratory.
  EXPECT_TRUE(close<Q>(stack.angular_acceleration('I', 'P', 'L', t), Vec3<Q>(Q(-3) * turn.axis + W_L.cross(w_LP_L)), bound));
}

}  // namespace
}  // namespace earthtop
