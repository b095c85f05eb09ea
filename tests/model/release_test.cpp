// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/release.hpp"

#include "earthtop/model/equations.hpp"
#include "frames/random_cases.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Random;

/// A symmetric top whose numbers are exact doubles.
BodySpec top(double I1 = 1.25, double I3 = 0.5, double height = 0.75) {
  BodySpec spec;
  spec.mass_kg = 2;
  spec.center_of_mass_m = {0, 0, height};
  spec.inertia_kg_m2 = {{{I1, 0, 0}, {0, I1, 0}, {0, 0, I3}}};
  return spec;
}
template <class T>
Vec3<T> axis(const Quaternion<T>& q) {
  return rotation_matrix(q).col(2);
}

TEST(ReleaseAttitude, TheAxisLeansTowardTheCompassAzimuth) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const T eps = T(8) * real::epsilon<T>(), half = T(0.5), root = real::sqrt(T(3)) / T(2);
    EXPECT_TRUE(close<T>(axis(release_attitude<T>(30, 0, 12)), Vec3<T>(T(0), half, root), eps));     // North
    EXPECT_TRUE(close<T>(axis(release_attitude<T>(30, 90, 12)), Vec3<T>(half, T(0), root), eps));    // East
    EXPECT_TRUE(close<T>(axis(release_attitude<T>(30, 180, 12)), Vec3<T>(T(0), -half, root), eps));  // South
    EXPECT_TRUE(close<T>(axis(release_attitude<T>(30, 270, 12)), Vec3<T>(-half, T(0), root), eps));  // West
    EXPECT_TRUE(close<T>(axis(release_attitude<T>(120, 90, 12)), Vec3<T>(root, T(0), -half), eps));  // hanging
    Random random(401);
    for (int k = 0; k < 100; ++k) {
      const double tilt = random.uniform(0, 180), azimuth = random.uniform(-360, 360), spin = random.uniform(-360, 360);
      const auto turn = [](int which, T degrees) {
        return test::rodrigues<T>(Vec3<T>::Unit(which), degrees * real::pi<T>() / T(180));
      };
      // The angles are rounded here by 1.5 eps of up to 8 rad each.
      const Mat3<T> R_LB = turn(2, T(90) - T(azimuth)) * turn(1, T(tilt)) * turn(2, T(spin));
      EXPECT_TRUE(close<T>(rotation_matrix(release_attitude<T>(tilt, azimuth, spin)), R_LB, T(48) * real::epsilon<T>()));
    }
  });
}

TEST(ReleaseAttitude, SpinAngleTurnsTheBodyCounterclockwiseAboutItsAxis) {
  const Mat3<double> R_LB = rotation_matrix(release_attitude<double>(0, 90, 30));
  EXPECT_TRUE(close<double>(Vec3<double>(R_LB.col(0)), Vec3<double>(std::sqrt(0.75), 0.5, 0), 8 * real::epsilon<double>()));
}

TEST(ReleaseAttitude, IsExactInRightAngles) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    EXPECT_TRUE(identical(rotation_matrix(release_attitude<T>(0, 90, 0)), Mat3<T>::Identity()));
    for (const double azimuth : {0.0, 33.0, 90.0, 180.0, 270.0})
      for (const double spin : {0.0, 71.0, 90.0, 180.0}) {
        // Upright and hanging down: not a trace of a horizontal component.
        EXPECT_TRUE(identical(axis(release_attitude<T>(0, azimuth, spin)), Vec3<T>(T(0), T(0), T(1))));
        const Vec3<T> down = axis(release_attitude<T>(180, azimuth, spin));
        EXPECT_TRUE(identical(Vec3<T>(down[0], down[1], T(0)), Vec3<T>::Zero()));
        EXPECT_TRUE(close<T>(down[2], T(-1), T(4) * real::epsilon<T>()));
        // Horizontal: sine and cosine of 45 deg, squared, to round-off.
        EXPECT_TRUE(close<T>(axis(release_attitude<T>(90, azimuth, spin))[2], T(0), T(8) * real::epsilon<T>()));
      }
  });
}

TEST(MakeRelease, SpinIsTheWholeComponentAlongTheAxis) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const Body<T> body = make_body<T>(top());
    Random random(402);
    for (const Precession precession : {Precession::none, Precession::given, Precession::steady_slow, Precession::steady_fast})
      for (int k = 0; k < 20; ++k) {
        ReleaseSpec spec;
        spec.tilt_deg = random.uniform(5, 85), spec.azimuth_deg = random.uniform(0, 360),
        spec.spin_angle_deg = random.uniform(0, 360);
        spec.spin_rad_s = random.uniform(30, 60), spec.precession = precession;
        spec.precession_rate_rad_s = random.uniform(-5, 5);
        spec.rates_relative_to = k % 2 == 0 ? RatesRelativeTo::inertial : RatesRelativeTo::laboratory;
        const Release<T> release = make_release<T>(spec, body, T(10));
        EXPECT_TRUE(close<T>(release.w_XB_B[2], T(spec.spin_rad_s), T(0)));
        EXPECT_EQ(release.X, spec.rates_relative_to);
        EXPECT_TRUE(release.q_LB.w >= T(0));
        const Mat3<T> R_LB = rotation_matrix(release.q_LB);
        EXPECT_TRUE(
            close<T>(R_LB, rotation_matrix(release_attitude<T>(spec.tilt_deg, spec.azimuth_deg, spec.spin_angle_deg)), T(0)));
        // The axis moves as if carried round Up.
        T rate = T(0);
        if (precession == Precession::given) rate = T(spec.precession_rate_rad_s);
        if (precession == Precession::steady_slow || precession == Precession::steady_fast)
          rate = steady_precession_rate<T>(body, release.q_LB, T(10), T(spec.spin_rad_s), precession);
        const Vec3<T> n = R_LB.col(2), velocity = (R_LB * release.w_XB_B).cross(n);
        const T bound = T(16) * real::epsilon<T>() * (T(60) + real::abs(rate));
        EXPECT_TRUE(close<T>(velocity, Vec3<T>(rate * Vec3<T>::UnitZ().cross(n)), bound));
        if (precession == Precession::none) {
          EXPECT_TRUE(identical(release.w_XB_B, Vec3<T>(T(0), T(0), T(spec.spin_rad_s))));
        }
      }
  });
}

TEST(MakeRelease, PrecessionIsCounterclockwiseSeenFromAbove) {
  ReleaseSpec spec;
  spec.tilt_deg = 40, spec.azimuth_deg = 90, spec.spin_rad_s = 7, spec.precession = Precession::given,
  spec.precession_rate_rad_s = 2;
  const Release<double> release = make_release<double>(spec, make_body<double>(top()), 10);
  const Mat3<double> R_LB = rotation_matrix(release.q_LB);
  const Vec3<double> velocity = (R_LB * release.w_XB_B).cross(Vec3<double>(R_LB.col(2)));
  // From East it moves to North.
  EXPECT_TRUE(close<double>(velocity, Vec3<double>(0, 2 * std::sin(40 * real::pi<double>() / 180), 0),
                            32 * 7 * real::epsilon<double>()));
}

TEST(MakeRelease, TakesQuaternionsAndBodyRatesAsGiven) {
  ReleaseSpec spec;
  spec.quaternion_LB = {-0.5, 0.5, -0.5, 0.5};
  spec.angular_velocity_body_rad_s = {1, -2, 3};
  spec.precession = Precession::steady_fast;  // not read beside body rates
  const Release<double> release = make_release<double>(spec, make_body<double>(top()), 10);
  EXPECT_EQ(release.q_LB.w, 0.5);
  EXPECT_TRUE(identical(release.q_LB.v, Vec3<double>(-0.5, 0.5, -0.5)));
  EXPECT_TRUE(identical(release.w_XB_B, Vec3<double>(1, -2, 3)));
  spec.quaternion_LB = {3, 0, 4, 0};
  const Quaternion<double> q = make_release<double>(spec, make_body<double>(top()), 10).q_LB;
  EXPECT_TRUE(close<double>(q.w, 0.6, real::epsilon<double>()));
  EXPECT_TRUE(close<double>(q.v, Vec3<double>(0, 0.8, 0), real::epsilon<double>()));
}

struct SteadyCase {
  double tilt_deg, spin_rad_s, height_m;
};
const std::vector<SteadyCase> kSteadyCases = {
    {20, 40, 0.75}, {60, 13, 0.75}, {60, -13, 0.75}, {89, 9, 0.75},      {91, 9, 0.75},   {120, 9, 0.75}, {150, -3, 0.75},
    {120, 0, 0.75}, {60, 0, -0.75}, {60, 8, -0.75},  {90.0001, 9, 0.75}, {45, 1e4, 0.75}, {45, 9, 0},     {1e-3, 40, 0.75}};

TEST(SteadyPrecession, RatesAreTheRootsOfTheQuadratic) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    for (const SteadyCase& c : kSteadyCases) {
      const Body<T> body = make_body<T>(top(1.25, 0.5, c.height_m));
      const Quaternion<T> q = release_attitude<T>(c.tilt_deg, 25, 0);
      const T a = T(1.25) * axis(q)[2], b = T(0.5) * T(c.spin_rad_s), mgl = T(2) * T(10) * T(c.height_m);
      const T slow = steady_precession_rate<T>(body, q, T(10), T(c.spin_rad_s), Precession::steady_slow);
      const T fast = steady_precession_rate<T>(body, q, T(10), T(c.spin_rad_s), Precession::steady_fast);
      for (const T v : {slow, fast}) {
        // 16 eps of the terms: a root formula without cancellation has a residual of that size (discriminants here are not
        // small against their terms).
        const T terms = real::abs(a * v * v) + real::abs(b * v) + real::abs(mgl);
        EXPECT_TRUE(close<T>(a * v * v - b * v + mgl, T(0), T(16) * real::epsilon<T>() * terms))
            << c.tilt_deg << " " << c.spin_rad_s;
      }
      EXPECT_TRUE(real::abs(slow) <= real::abs(fast) * (T(1) + T(4) * real::epsilon<T>()));  // equal without spin
      // Vieta: both roots, not one of them twice.
      EXPECT_TRUE(close<T>(a * (slow + fast), b, T(32) * real::epsilon<T>() * (real::abs(b) + real::abs(a * fast))));
    }
  });
}

TEST(SteadyPrecession, StaysSteady) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    for (const SteadyCase& c : kSteadyCases)
      for (const Precession precession : {Precession::steady_slow, Precession::steady_fast}) {
        const Body<T> body = make_body<T>(top(1.25, 0.5, c.height_m));
        ReleaseSpec spec;
        spec.tilt_deg = c.tilt_deg, spec.azimuth_deg = 25, spec.spin_angle_deg = 70, spec.spin_rad_s = c.spin_rad_s,
        spec.precession = precession;
        const Release<T> release = make_release<T>(spec, body, T(10));
        const T rate = steady_precession_rate<T>(body, release.q_LB, T(10), T(c.spin_rad_s), precession);
        const Model<T> model = make_model<T>(body, Site{45, 0, 0, 10}, 0.0, {}, nullptr);
        const Motion<T> xdot =
            body_equation<false, SceneKind::plain, T>(model, {release.q_LB, release.w_XB_B}, model.apparent_gravity_L);
        // The axis's acceleration is that of a uniform turn about Up: none in tilt, none in rate.
        const Mat3<T> R_LB = rotation_matrix(release.q_LB);
        const Vec3<T> n = R_LB.col(2), z = Vec3<T>::UnitZ(), w = R_LB * release.w_XB_B, wdot = R_LB * xdot.m;
        const Vec3<T> acceleration = wdot.cross(n) + w.cross(w.cross(n));
        const T size = w.squaredNorm() + rate * rate + T(15) / T(1.25);
        EXPECT_TRUE(close<T>(acceleration, Vec3<T>(rate * rate * z.cross(z.cross(n))), T(64) * real::epsilon<T>() * size))
            << c.tilt_deg << " " << c.spin_rad_s;
        EXPECT_TRUE(close<T>(xdot.m[2], T(0), T(2) * real::epsilon<T>() * T(1.25) / T(0.5) * release.w_XB_B.squaredNorm()));
      }
  });
}

TEST(SteadyPrecession, HorizontalAxisHasOneRate) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const Body<T> body = make_body<T>(top());
    Random random(403);
    for (int k = 0; k < 100; ++k) {
      const double azimuth = k == 0 ? 0 : random.uniform(-360, 360), spin_angle = k < 2 ? 0 : random.uniform(-360, 360);
      const Quaternion<T> q = release_attitude<T>(90, azimuth, spin_angle);
      for (const double spin : {8.0, -8.0, 0.3}) {
        const T expected = T(15) / (T(0.5) * T(spin));
        EXPECT_TRUE(close<T>(steady_precession_rate<T>(body, q, T(10), T(spin), Precession::steady_slow), expected,
                             real::epsilon<T>() * real::abs(expected)));
        EXPECT_THROW(steady_precession_rate<T>(body, q, T(10), T(spin), Precession::steady_fast), ScenarioError);
      }
    }
  });
}

TEST(SteadyPrecession, TurnsTheOtherWayWithTheSpin) {
  const Body<double> body = make_body<double>(top());
  for (const double tilt : {30.0, 90.0, 130.0})
    for (const Precession precession : {Precession::steady_slow, Precession::steady_fast}) {
      if (tilt == 90 && precession == Precession::steady_fast) continue;
      const Quaternion<double> q = release_attitude<double>(tilt, 0, 0);
      EXPECT_EQ(steady_precession_rate<double>(body, q, 10, 30, precession),
                -steady_precession_rate<double>(body, q, 10, -30, precession));
    }
  // Above the pivot the slow precession has the sense of the spin.
  EXPECT_GT(steady_precession_rate<double>(body, release_attitude<double>(30, 0, 0), 10, 30, Precession::steady_slow), 0);
}

TEST(SteadyPrecession, KnownConeOfKinonAndBetsch) {
  BodySpec cone;
  cone.solids = {{SolidShape::cone, 0.05, 0, 0.1, {}, 2700.0, 0.075}};
  for_each_scalar([&](auto scalar) {
    using T = decltype(scalar);
    const Body<T> body = make_body<T>(cone);
    const T eps = T(real::epsilon<double>());  // the scene's numbers are given as doubles
    // Their 113-bit values, printed here to a double's digits.
    EXPECT_TRUE(close<T>(body.mass, T(0.70685834705770347865), 8 * eps));
    EXPECT_TRUE(close<T>(body.I_BP_B(2, 2), T(5.3014376029327760899e-4), T(5e-4) * 8 * eps));
    EXPECT_TRUE(close<T>(body.I_BP_B(0, 0), T(4.5062219624928596764e-3), T(4.5e-3) * 8 * eps));
    const T rate = steady_precession_rate<T>(body, release_attitude<T>(60, 0, 0), T(9.81), T(140.6), Precession::steady_slow);
    // Differentiating the quadratic: relative errors of the five numbers are magnified by at most
    // (m g l + I3 w3 v + I1 cos v^2) / |I3 w3 v - 2 I1 cos v^2| = (0.52 + 0.75 + 0.23) / 0.29 = 5.
    EXPECT_TRUE(close<T>(rate, T(10), T(10) * 5 * 2 * eps));
  });
}

::testing::AssertionResult refused(const BodySpec& body, double tilt, double spin, double gravity, Precession precession,
                                   const std::string& reason) {
  ReleaseSpec spec;
  spec.tilt_deg = tilt, spec.azimuth_deg = 77, spec.spin_angle_deg = 10, spec.spin_rad_s = spin, spec.precession = precession;
  try {
    make_release<double>(spec, make_body<double>(body), gravity);
  } catch (const ScenarioError& error) {
    const Diagnostic& first = error.diagnostics().at(0);
    if (first.pointer == "/release/precession" && first.message.find(reason) != std::string::npos)
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << first.pointer << ": " << first.message;
  }
  return ::testing::AssertionFailure() << "accepted";
}

TEST(SteadyPrecession, RefusesWithTheReason) {
  for (const Precession either : {Precession::steady_slow, Precession::steady_fast}) {
    EXPECT_TRUE(refused(top(), 0, 30, 10, either, "vertical"));
    EXPECT_TRUE(refused(top(), 180, 30, 10, either, "vertical"));
    EXPECT_TRUE(refused(top(), 30, 1, 10, either, "too slow"));
    EXPECT_TRUE(refused(top(), 30, 0, 10, either, "too slow"));
    EXPECT_TRUE(refused(top(), 90, 0, 10, Precession::steady_slow, "without spin"));
    EXPECT_TRUE(refused(top(), 30, 0, 0, either, "without spin"));
    BodySpec unequal = top();
    unequal.inertia_kg_m2[1][1] = 1.5;
    EXPECT_TRUE(refused(unequal, 30, 30, 10, either, "not equal"));
    BodySpec off_axis = top();
    off_axis.center_of_mass_m[1] = 0.01;
    EXPECT_TRUE(refused(off_axis, 30, 30, 10, either, "off body axis 3"));
  }
  EXPECT_TRUE(refused(top(), 90, 30, 10, Precession::steady_fast, "90"));
  // w3^2 >= 4 I1 m g l cos(tilt) / I3^2: half a part in 1e12 either side.
  const double least = std::sqrt(4 * 1.25 * 15 * std::cos(30 * real::pi<double>() / 180)) / 0.5;
  EXPECT_TRUE(refused(top(), 30, least * (1 - 1e-12), 10, Precession::steady_slow, "too slow"));
  ReleaseSpec spec;
  spec.tilt_deg = 30, spec.spin_rad_s = least * (1 + 1e-12), spec.precession = Precession::steady_slow;
  EXPECT_NO_THROW(make_release<double>(spec, make_body<double>(top()), 10));
}

}  // namespace
}  // namespace earthtop
