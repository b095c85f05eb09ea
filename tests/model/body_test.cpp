// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/body.hpp"

#include <functional>

#include "paper/particles.hpp"

namespace earthtop {
namespace {

using test::close;
using test::for_each_scalar;
using test::identical;
using test::Particle;
using test::Particles;
using test::Random;

BodySpec with_principal(double mass, std::array<double, 3> center, std::array<double, 3> moments,
                        InertiaAbout about = InertiaAbout::pivot) {
  BodySpec spec;
  spec.mass_kg = mass;
  spec.center_of_mass_m = center;
  spec.inertia_about = about;
  for (std::size_t i = 0; i < 3; ++i) spec.inertia_kg_m2[i][i] = moments[i];
  return spec;
}
BodySpec of_solids(std::vector<Solid> solids) {
  BodySpec spec;
  spec.solids = std::move(solids);
  return spec;
}
bool accepted(const BodySpec& spec) { return body_violations(spec).empty(); }
::testing::AssertionResult refused(const BodySpec& spec, const std::string& reason) {
  const std::vector<Diagnostic> violations = body_violations(spec);
  for (const Diagnostic& violation : violations)
    if (violation.message.find(reason) != std::string::npos) return ::testing::AssertionSuccess();
  ::testing::AssertionResult failure = ::testing::AssertionFailure()
                                       << violations.size() << " violations, none says: " << reason;
  for (const Diagnostic& violation : violations) failure << "; " << violation.message;
  return failure;
}

TEST(Body, ParticlesGiveTheSameTensorsAboutThePivotFromEitherPoint) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    Random random(301);
    for (int k = 0; k < 25; ++k) {
      const Particles<T> particles = test::exact_particles<T>(random);
      const BodySpec about_pivot = test::body_spec(particles);
      const Body<T> body = make_body<T>(about_pivot);
      EXPECT_TRUE(identical(body.I_BP_B, test::inertia(particles)));
      EXPECT_TRUE(identical(body.S_BP_B, test::second_moment(particles)));
      EXPECT_TRUE(identical(Vec3<T>(body.mass * body.p_PBcm_B), test::mass_moment(particles)));
      const T size = body.I_BP_B.trace(), condition = size * body.I_BP_B_inverse.cwiseAbs().maxCoeff();
      EXPECT_TRUE(
          close<T>(Mat3<T>(body.I_BP_B * body.I_BP_B_inverse), Mat3<T>::Identity(), T(32) * real::epsilon<T>() * condition));

      // Moments about the centre of mass, summed there.
      Particles<T> moved = particles;
      const Vec3<T> center = test::mass_moment(particles) / T(128);
      for (Particle<T>& p : moved) p.r -= center;
      const Mat3<T> at_center = test::inertia(moved);
      // Dyadic sums rounded at most 32 times in the last place of the largest.
      EXPECT_TRUE(close<T>(body.I_BBcm_B(), at_center, T(32) * real::epsilon<T>() * size));
      BodySpec about_center = about_pivot;
      about_center.inertia_about = InertiaAbout::center_of_mass;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          about_center.inertia_kg_m2[i][j] = static_cast<double>(at_center(static_cast<int>(i), static_cast<int>(j)));
      EXPECT_TRUE(close<T>(make_body<T>(about_center).I_BP_B, body.I_BP_B, T(32) * T(real::epsilon<double>()) * size));
      EXPECT_TRUE(accepted(about_pivot));
      EXPECT_TRUE(accepted(about_center));
    }
  });
}

TEST(Body, MomentAboutThePivotIsAddedNotSubtracted) {
  const Body<double> body = make_body<double>(with_principal(2, {0, 0, 3}, {1, 1, 1}, InertiaAbout::center_of_mass));
  EXPECT_TRUE(identical(body.I_BP_B, Mat3<double>(Vec3<double>(19, 19, 1).asDiagonal())));
  EXPECT_TRUE(identical(body.I_BP_B_inverse, Mat3<double>(Vec3<double>(1.0 / 19, 1.0 / 19, 1).asDiagonal())));
  EXPECT_TRUE(identical(make_body<double>(with_principal(2, {0, 0, 3}, {19, 19, 1})).I_BBcm_B(), Mat3<double>::Identity()));
}

/// Mass, first moment and second moments about z = 0 of a solid of revolution of unit density, summed over slices by Gauss's
/// rule with three nodes. It is exact here, since no integrand has a degree above five (for a sphere, on either half).
struct Revolution {
  long double mass = 0, first = 0, along = 0, across = 0;
  void add(long double from, long double to, const std::function<long double(long double)>& radius_squared,
           long double sign = 1) {
    const long double middle = (from + to) / 2, half = (to - from) / 2, node = std::sqrt(0.6L), pi = real::pi<float80>();
    for (const auto& [x, weight] : {std::pair{-node, 5.0L / 9}, std::pair{0.0L, 8.0L / 9}, std::pair{node, 5.0L / 9}}) {
      const long double z = middle + half * x, r2 = radius_squared(z), dm = sign * weight * half * pi * r2;
      mass += dm;
      first += dm * z;
      along += dm * r2 / 2;
      across += dm * (r2 / 4 + z * z);
    }
  }
};
void expect_same(const Solid& solid, const Revolution& r) {
  // 64 eps: sums of differences of nearly equal volumes stay below 10 in relative size in these cases.
  const float80 eps = 64 * real::epsilon<float80>();
  const long double density = *solid.density_kg_m3;
  const Body<float80> body = make_body<float80>(of_solids({solid}));
  EXPECT_TRUE(close<long double>(body.mass, density * r.mass, eps * density * r.mass));
  EXPECT_TRUE(close<long double>(body.p_PBcm_B[2], r.first / r.mass, eps * (1 + std::abs(r.first / r.mass))));
  EXPECT_TRUE(identical(body.p_PBcm_B.head<2>().eval(), Eigen::Matrix<float80, 2, 1>::Zero()));
  const Vec3<float80> moments = Vec3<long double>(density * Vec3<long double>(r.across, r.across, r.along)).cast<float80>();
  EXPECT_TRUE(close<float80>(body.I_BP_B, Mat3<float80>(moments.asDiagonal()), float80(eps * moments.maxCoeff())));
  // The same body by its mass.
  Solid by_mass = solid;
  by_mass.density_kg_m3.reset();
  by_mass.mass_kg = static_cast<double>(body.mass);
  const Body<float80> again = make_body<float80>(of_solids({by_mass}));
  EXPECT_TRUE(close<float80>(again.I_BP_B, body.I_BP_B, float80(2 * real::epsilon<double>() * moments.maxCoeff())));
}

TEST(Solids, MomentsAreThoseOfTheirSlices) {
  const double R = 0.7, r = 0.4, h = 1.3, at = 0.9;
  const auto constant = [](long double radius) { return [radius](long double) { return radius * radius; }; };
  const long double low = at - static_cast<long double>(h) / 2, high = low + h;
  for (const SolidShape shape : {SolidShape::disc, SolidShape::cylinder, SolidShape::rod}) {
    Revolution full;
    full.add(low, high, constant(R));
    expect_same({shape, R, 0, h, {}, 2.5, at}, full);
  }
  Revolution annular;
  annular.add(low, high, constant(R));
  annular.add(low, high, constant(r), -1);
  expect_same({SolidShape::ring, R, r, h, {}, 2.5, at}, annular);

  Revolution cone;  // tip down; the centre of mass is 3/4 of the length above the tip
  const long double tip = at - 0.75L * h;
  cone.add(tip, tip + h, [&](long double z) { return std::pow(R * (z - tip) / h, 2.0L); });
  expect_same({SolidShape::cone, R, 0, h, {}, 2.5, at}, cone);

  const auto ball = [&](long double radius) {
    return [radius, at](long double z) { return radius * radius - (z - at) * (z - at); };
  };
  Revolution sphere, shell;
  for (Revolution* s : {&sphere, &shell}) {
    s->add(at - static_cast<long double>(R), at, ball(R));
    s->add(at, at + static_cast<long double>(R), ball(R));
  }
  expect_same({SolidShape::sphere, R, 0, 0, {}, 2.5, at}, sphere);
  shell.add(at - static_cast<long double>(r), at, ball(r), -1);
  shell.add(at, at + static_cast<long double>(r), ball(r), -1);
  expect_same({SolidShape::sphere, R, r, 0, {}, 2.5, at}, shell);
}

TEST(Solids, ThinLimits) {
  const auto moments = [](const Solid& solid) { return Vec3<double>(make_body<double>(of_solids({solid})).I_BP_B.diagonal()); };
  // Values small enough to be exact: m = 3, R = 2, L = 4.
  EXPECT_TRUE(identical(moments({SolidShape::disc, 2, 0, 0, 3.0, {}, 0}), Vec3<double>(3, 3, 6)));
  EXPECT_TRUE(identical(moments({SolidShape::ring, 2, 2, 0, 3.0, {}, 0}), Vec3<double>(6, 6, 12)));  // a hoop
  EXPECT_TRUE(
      close<double>(moments({SolidShape::rod, 0, 0, 4, 3.0, {}, 0}), Vec3<double>(4, 4, 0), 4 * 2 * real::epsilon<double>()));
  EXPECT_TRUE(identical(moments({SolidShape::sphere, 2, 2, 0, 3.0, {}, 0}), Vec3<double>(8, 8, 8)));  // 2/3 m R^2
  // A shell of relative thickness 1e-9: 2/3 m R^2 less 1e-9 of it, and its mass from the density without cancellation.
  const double inner = 2 * (1 - 1e-9);
  const Body<double> shell = make_body<double>(of_solids({{SolidShape::sphere, 2, inner, 0, {}, 5.0, 0}}));
  EXPECT_TRUE(close<double>(shell.mass, 5 * 4 * real::pi<double>() * 4 * (2 - inner) * (1 - 1e-9), 1e-15 * shell.mass));
  EXPECT_TRUE(close<double>(shell.I_BP_B(2, 2) / shell.mass, 8.0 / 3 * (1 - 1e-9), 8 * 3 * real::epsilon<double>()));
}

TEST(Solids, ListsAddUp) {
  for_each_scalar([](auto scalar) {
    using T = decltype(scalar);
    const Solid disc{SolidShape::disc, 0.05, 0, 0.01, 0.2, {}, 0.06}, rod{SolidShape::rod, 0, 0, 0.1, 0.03, {}, 0.05},
        ball{SolidShape::sphere, 0.01, 0, 0, {}, 7800.0, -0.02};
    const Body<T> all = make_body<T>(of_solids({disc, rod, ball}));
    T mass = T(0), moment = T(0);
    Mat3<T> I = Mat3<T>::Zero();
    for (const Solid& solid : {disc, rod, ball}) {
      const Body<T> one = make_body<T>(of_solids({solid}));
      mass += one.mass, moment += one.mass * one.p_PBcm_B[2], I += one.I_BP_B;
    }
    const T eps = T(16) * real::epsilon<T>();
    EXPECT_TRUE(close<T>(all.mass, mass, eps * mass));
    EXPECT_TRUE(close<T>(all.p_PBcm_B, Vec3<T>(T(0), T(0), moment / mass), eps * T(0.06)));
    EXPECT_TRUE(close<T>(all.I_BP_B, I, eps * I(0, 0)));
    EXPECT_EQ(symmetry_axis(all), 2);
  });
  EXPECT_TRUE(accepted(of_solids({{SolidShape::disc, 0.05, 0, 0, 0.2, {}, 0.03}})));
  EXPECT_TRUE(refused(of_solids({{SolidShape::rod, 0, 0, 0.1, 0.03, {}, 0.05}}), "not positive definite (I3 is 0)"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {0, 1e-4, 1e-4}, InertiaAbout::pivot), "not positive definite (I1 is 0)"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {1e-4, 0, 1e-4}, InertiaAbout::pivot), "not positive definite (I2 is 0)"));
}

TEST(BodyValidity, AcceptsEveryCloudOfParticlesInAnyAxes) {
  Random random(302);
  for (int k = 0; k < 200; ++k) {
    // Three to five particles: a flat body, or one barely thicker, whose moments reach equality in the triangle inequality.
    // Mass and centre are rounded to double like the moments, for which the slack of 32 eps is there.
    const int n = random.integer(3, 5);
    Particles<float128> particles;
    for (int i = 0; i < n; ++i) {
      const float128 m = random.uniform(0.1, 2);
      const Vec3<float128> r = random.vector<float128>(0.1) + Vec3<float128>(0, 0, random.uniform(-0.2, 0.2));
      particles.push_back({m, r, Vec3<float128>::Zero()});
    }
    float128 mass = 0;
    for (const Particle<float128>& p : particles) mass += p.m;
    const Mat3<float128> I = test::inertia(particles);
    BodySpec spec;
    spec.mass_kg = static_cast<double>(mass);
    for (std::size_t i = 0; i < 3; ++i) {
      spec.center_of_mass_m[i] = static_cast<double>(test::mass_moment(particles)[static_cast<int>(i)] / mass);
      for (std::size_t j = 0; j < 3; ++j)
        spec.inertia_kg_m2[i][j] = static_cast<double>(I(static_cast<int>(i), static_cast<int>(j)));
    }
    EXPECT_TRUE(accepted(spec)) << k << ": " << (accepted(spec) ? "" : body_violations(spec)[0].message);
  }
}

TEST(BodyValidity, TheSameVerdictInTurnedAxes) {
  Random random(303);
  struct Case {
    Vec3<double> center, moments;  // principal axes; moments about the centre of mass, mass 1
  };
  const std::vector<Case> cases = {
      {{0, 0, 0.3}, {1, 1, 2}},        {{0.4, 0, 1}, {1, 2, 3}},      {{0, 2, 0}, {0, 1, 1}},          // equalities
      {{0, 0, 1}, {1, 1.5, 2}},        {{0.3, -0.2, 0.7}, {1, 1, 1}},                                  // well inside
      {{0, 0, 0.3}, {1, 1, 2.000001}}, {{0.4, 0, 1}, {1, 2, 3.1}},    {{0, 0, 1}, {-1e-6, 0.5, 0.5}},  // outside
  };
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (int k = 0; k < 30; ++k) {
      using F = float128;
      const Mat3<F> R = k == 0 ? Mat3<F>(Mat3<F>::Identity()) : rotation_matrix(random.quaternion<F>());
      Mat3<F> I = Mat3<F>::Zero();
      Vec3<F> center;
      for (int i = 0; i < 3; ++i) I(i, i) = cases[c].moments[i], center[i] = cases[c].center[i];
      I = turned_tensor<F>(R, I + point_mass_inertia<F>(1, center));
      center = R * center;
      BodySpec spec;
      spec.mass_kg = 1;
      for (std::size_t i = 0; i < 3; ++i) {
        spec.center_of_mass_m[i] = static_cast<double>(center[static_cast<int>(i)]);
        for (std::size_t j = 0; j < 3; ++j)
          spec.inertia_kg_m2[i][j] = static_cast<double>(
              (I(static_cast<int>(i), static_cast<int>(j)) + I(static_cast<int>(j), static_cast<int>(i))) / 2);
      }
      EXPECT_EQ(accepted(spec), c < 5) << c << " " << k;
    }
}

TEST(BodyValidity, JudgesTheKnownBodies) {
  // The asymmetric body of earlier comparisons; its moments about the centre of mass are 3e-5, 0 and 4e-5.
  EXPECT_TRUE(refused(with_principal(0.1, {0, 0, 0.03}, {1.2e-4, 9e-5, 4e-5}), "triangle"));
  EXPECT_TRUE(accepted(with_principal(0.1, {0, 0, 0.03}, {1.2e-4, 1.05e-4, 4e-5})));
  EXPECT_TRUE(accepted(with_principal(0.1, {0, 0, 0.03}, {1.2e-4, 1.2e-4, 4e-5})));
  EXPECT_TRUE(accepted(with_principal(15, {0, 1, 0}, {0.234375, 0.46875, 0.234375}, InertiaAbout::center_of_mass)));
  EXPECT_TRUE(accepted(with_principal(15, {0, 1, 0}, {15.234375, 0.46875, 15.234375})));
  EXPECT_TRUE(accepted(with_principal(2, {0, 0, 1}, {5, 5, 1})));             // Simo and Wong
  EXPECT_TRUE(accepted(with_principal(0.1, {1, 0, 0}, {2, 2, 1})));           // Kovalevskaya
  EXPECT_TRUE(accepted(with_principal(0.1, {1, 0, 0}, {4, 4, 1})));           // Goryachev-Chaplygin
  EXPECT_TRUE(refused(with_principal(1, {1, 0, 0}, {2, 2, 1}), "triangle"));  // the same with all of m g = 1 in the mass
  EXPECT_TRUE(refused(with_principal(20, {0, 0, 1}, {5, 5, 1}), "negative"));
}

TEST(BodyValidity, AcceptsFlatAndThinBodies) {
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 0}, {1, 1, 2})));  // a flat disc on its centre
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 2}, {1, 1, 2}, InertiaAbout::center_of_mass)));
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 2}, {0, 3, 3}, InertiaAbout::center_of_mass)));  // a crosswise rod
  // A point mass has no inertia about the line to the pivot; neither has a rod along it.
  EXPECT_TRUE(
      refused(with_principal(1, {0, 0, 2}, {0, 0, 0}, InertiaAbout::center_of_mass), "not positive definite (I3 is 0)"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 2}, {3, 3, 0}, InertiaAbout::center_of_mass), "not positive definite"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {1, 1, -1}), "positive"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {0, 0, 0}), "positive"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {1, 1, std::numeric_limits<double>::quiet_NaN()}), "positive and finite"));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {1, 1, std::numeric_limits<double>::infinity()}), "positive and finite"));
}

TEST(BodyValidity, SlackIs32EpsOfTheLargestPivotMoment) {
  const double eps = real::epsilon<double>();
  // Largest pivot moment 2: the slack is 64 eps.
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 0}, {1, 1, 2 + 62 * eps})));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 0}, {1, 1, 2 + 68 * eps}), "triangle"));
  // The slack is that of the pivot's moments, not of the centre's: 2 about the centre, 8 about the pivot 2.45 m away.
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 2}, {1 + 4, 1 + 4, 2 + 158 * eps})));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 2}, {1 + 4, 1 + 4, 2 + 164 * eps}), "triangle"));
  // A negative moment about the centre of mass; largest pivot moment 1.5: 48 eps.
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 1}, {1 - 20 * eps, 1.5, 0.5})));
  EXPECT_TRUE(accepted(with_principal(1, {0, 0, 1}, {1 - 47 * eps, 1.5, 0.5})));
  EXPECT_TRUE(refused(with_principal(1, {0, 0, 1}, {1 - 49 * eps, 1.5, 0.5}), "negative"));
}

TEST(BodyValidity, FaultsSayWhereTheyAre) {
  const auto place = [](const BodySpec& spec) {
    const std::vector<Diagnostic> violations = body_violations(spec);
    return violations.empty() ? std::string() : violations[0].pointer;
  };
  EXPECT_EQ(place(with_principal(1, {0, 0, 0}, {1, 1, 3})), "/body/inertia");
  EXPECT_EQ(place(of_solids({{SolidShape::rod, 0, 0, 0.1, 0.03, {}, 0.05}})), "/body/solids");
}

TEST(Body, SymmetryAxisIsExact) {
  const auto axis = [](const BodySpec& spec) { return symmetry_axis(make_body<double>(spec)); };
  EXPECT_EQ(axis(with_principal(1, {0, 0, 0.5}, {2, 2, 1})), 2);
  EXPECT_EQ(axis(with_principal(1, {0, -0.5, 0}, {2, 1, 2})), 1);
  EXPECT_EQ(axis(with_principal(1, {0.5, 0, 0}, {1, 2, 2})), 0);
  EXPECT_EQ(axis(with_principal(1, {0, 0, 0}, {1, 1, 1})), 2);    // a sphere on its centre: axis 3 first
  EXPECT_EQ(axis(with_principal(1, {0.5, 0, 0}, {1, 1, 1})), 0);  // a sphere whose centre of mass picks the axis
  EXPECT_EQ(axis(with_principal(1, {0, 0, 0}, {1, 2, 1})), 1);
  EXPECT_EQ(axis(with_principal(1, {0, 0, 0.5}, {2, 2 + 1e-15, 1})), -1);
  EXPECT_EQ(axis(with_principal(1, {0, 0, 0.5}, {1, 2, 2})), -1);  // equal moments, centre of mass off that axis
  EXPECT_EQ(axis(with_principal(1, {1e-300, 0, 0.5}, {2, 2, 1})), -1);
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    BodySpec spec = with_principal(1, {0, 0, 0.5}, {2, 2, 1});
    spec.inertia_kg_m2[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = 1e-300;
    spec.inertia_kg_m2[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = 1e-300;
    EXPECT_EQ(axis(spec), -1);
  }
  EXPECT_EQ(axis(with_principal(15, {0, 1, 0}, {0.234375, 0.46875, 0.234375}, InertiaAbout::center_of_mass)), 1);
}

}  // namespace
}  // namespace earthtop
