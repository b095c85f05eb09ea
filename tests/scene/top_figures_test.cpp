// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a top: against sums over particles, against integrated motions, against limits, and where they do not apply.
#include "earthtop/scene/top_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "earthtop/results/results.hpp"
#include "earthtop/results/top_lines.hpp"
#include "earthtop/run.hpp"
#include "earthtop/vectors.hpp"
#include "results/figures.hpp"
#include "support/changed_scene.hpp"
#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::toy_top;

constexpr double kTwoPi = 2 * testing::kPi;

TopFigures figures_of(const Scenario& scenario) { return resolve(scenario).top(); }

/// Mass, first moment and moments of a solid of revolution as a sum over rings.
struct Sum {
  double mass = 0, first = 0, across = 0, along = 0;

  /// Adds a solid between two radii that depend on z, by midpoints: each of 400 x 400 rings counts as a thin circle, which leaves
  /// less than 1/400^2 of each moment.
  template <class Radius>
  void add(double density, double z0, double z1, double inner, const Radius& outer) {
    constexpr int kRings = 400;
    const double dz = (z1 - z0) / kRings;
    for (int i = 0; i < kRings; ++i) {
      const double z = z0 + (i + 0.5) * dz, dr = (outer(z) - inner) / kRings;
      for (int j = 0; j < kRings; ++j) {
        const double r = inner + (j + 0.5) * dr, m = density * kTwoPi * r * dr * dz;
        mass += m, first += m * z, along += m * r * r, across += m * (r * r / 2 + z * z);
      }
    }
  }
};

TEST(TopFigures, OfSolidsAreThoseOfTheirParticles) {
  Scenario s = toy_top();
  s.body = {};
  s.body.solids = {{SolidShape::cone, 0.03, 0, 0.04, std::nullopt, 2700, 0.03},  // its tip is at the pivot
                   {SolidShape::cylinder, 0.004, 0, 0.02, std::nullopt, 7800, 0.05},
                   {SolidShape::ring, 0.035, 0.02, 0.006, std::nullopt, 8500, 0.043},
                   {SolidShape::sphere, 0.006, 0, 0, std::nullopt, 1200, 0.066}};
  Sum sum;
  sum.add(2700, 0, 0.04, 0, [](double z) { return 0.03 * z / 0.04; });
  sum.add(7800, 0.04, 0.06, 0, [](double) { return 0.004; });
  sum.add(8500, 0.04, 0.046, 0.02, [](double) { return 0.035; });
  sum.add(1200, 0.06, 0.072, 0, [](double z) { return std::sqrt(0.006 * 0.006 - (z - 0.066) * (z - 0.066)); });
  const TopFigures top = figures_of(s);
  constexpr double kSum = 2e-5;
  const double center = sum.first / sum.mass;
  EXPECT_NEAR(top.mass_kg, sum.mass, kSum * sum.mass);
  EXPECT_EQ(top.center_of_mass_m[0], 0);
  EXPECT_NEAR(top.center_of_mass_m[2], center, kSum * center);
  for (const std::size_t i : {0, 1}) {
    EXPECT_NEAR(top.moments_about_pivot_kg_m2[i], sum.across, kSum * sum.across);
    EXPECT_NEAR(top.moments_about_center_kg_m2[i], sum.across - sum.mass * center * center, 2 * kSum * sum.across);
  }
  EXPECT_NEAR(top.moments_about_pivot_kg_m2[2], sum.along, kSum * sum.along);
  EXPECT_EQ(top.moments_about_center_kg_m2[2], top.moments_about_pivot_kg_m2[2]);
  // The largest speed of points of the widest circle, relative to its centre, in all directions of the rate.
  EXPECT_NEAR(top.rim_speed_m_s.value(), 0.035 * 200, 1e-12);
  s.release.angular_velocity_body_rad_s = {30, -40, 120};
  double fastest = 0;
  for (int i = 0; i < 3600; ++i) {
    const double angle = kTwoPi * i / 3600;
    const Vec3<double> point(0.035 * std::cos(angle), 0.035 * std::sin(angle), 0);
    fastest = std::max(fastest, Vec3<double>(30, -40, 120).cross(point).norm());
  }
  EXPECT_NEAR(figures_of(s).rim_speed_m_s.value(), fastest, 1e-6 * fastest);  // the nearest point is within 9e-4 rad
}

TEST(TopFigures, MomentsGivenAboutTheCentreComeBackAndKeepTheirPlaces) {
  Scenario s = toy_top();
  s.body.inertia_about = InertiaAbout::center_of_mass;
  testing::set_principal(s.body, 3e-5, 2e-5, 4e-5);
  const TopFigures straight = figures_of(s);
  EXPECT_EQ(straight.moments_about_center_kg_m2, (std::array{3e-5, 2e-5, 4e-5}));
  const double steiner = 0.1 * 0.03 * 0.03;
  EXPECT_NEAR(straight.moments_about_pivot_kg_m2[0], 3e-5 + steiner, 1e-19);
  EXPECT_NEAR(straight.moments_about_pivot_kg_m2[1], 2e-5 + steiner, 1e-19);
  EXPECT_EQ(straight.moments_about_pivot_kg_m2[2], 4e-5);
  // The same body in axes turned by 0.3 rad about axis 1: each moment stays in the place of the nearest axis.
  const double c = std::cos(0.3), si = std::sin(0.3);
  Mat3<double> turn;
  turn << 1, 0, 0, 0, c, -si, 0, si, c;
  const Mat3<double> tensor = turn * Vec3<double>(3e-5, 2e-5, 4e-5).asDiagonal() * turn.transpose();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) s.body.inertia_kg_m2[i][j] = tensor(static_cast<int>(i), static_cast<int>(j));
  const TopFigures turned = figures_of(s);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(turned.moments_about_center_kg_m2[i], straight.moments_about_center_kg_m2[i], 1e-19);
  // A point at the end of a string has no moment about its centre.
  testing::set_principal(s.body, 0.1 * 0.03 * 0.03, 0.1 * 0.03 * 0.03, 1e-12);
  s.body.inertia_about = InertiaAbout::pivot;
  EXPECT_GE(figures_of(s).moments_about_center_kg_m2[0], 0);
}

/// The tilt's period and the azimuth's rate of a motion integrated in the general form, which knows no symmetry and no closed form.
struct Measured {
  double nutation_period_s = 0, precession_rad_s = 0;
};

constexpr int kMeasuredRows = 4000;
/// What the parabolas below leave of the period: through rows h apart, (h w)^2/12 of the phase between row and maximum, at
/// both ends of a span of at least half the motion.
double left_by_parabolas(double phase) { return std::pow(phase / kMeasuredRows, 2) / 3 / kMeasuredRows; }

Measured measured(Scenario s, double duration_s) {
  s = testing::non_rotating(s);
  s.numerics.method = Method::dopri5;
  s.numerics.form = ModelForm::general;
  s.duration_s = duration_s;
  s.output_step_s = duration_s / kMeasuredRows;
  const RunResult result = run(resolve(s));
  std::vector<double> highest;  // times of the largest height of the axis, each from a parabola through three rows
  const auto& rows = result.rows;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const double a = rows[i - 1].axis_L[2], b = rows[i].axis_L[2], c = rows[i + 1].axis_L[2];
    if (b >= a && b > c) highest.push_back(rows[i].t_s + s.output_step_s * (a - c) / (2 * (a - 2 * b + c)));
  }
  Measured m;
  if (highest.size() > 1) m.nutation_period_s = (highest.back() - highest.front()) / static_cast<double>(highest.size() - 1);
  double azimuth = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto &p = rows[i - 1].axis_L, &q = rows[i].axis_L;
    azimuth += std::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
  }
  m.precession_rad_s = azimuth / duration_s;
  return m;
}

TEST(TopFigures, SteadyPrecessionsAreThoseOfIntegratedMotions) {
  for (const double tilt : {20.0, 75.0, 120.0}) {
    for (const double spin : {200.0, -150.0}) {
      Scenario s = toy_top();
      s.release.tilt_deg = tilt;
      s.release.spin_rad_s = spin;
      const TopFigures top = figures_of(s);
      ASSERT_TRUE(top.slow_precession_rad_s && top.fast_precession_rad_s);
      for (const double rate : {*top.slow_precession_rad_s, *top.fast_precession_rad_s}) {
        s.release.precession = Precession::given;
        s.release.precession_rate_rad_s = rate;
        EXPECT_NEAR(measured(s, 1).precession_rad_s / rate, 1, testing::truncation(s.numerics.relative_tolerance, 10))
            << tilt << " " << spin;
      }
    }
  }
}

/// The azimuth's mean is taken over whole nutations, so that nothing of them is left in it. The release at rest precesses at
/// another rate than the steady one at its tilt; one that is pushed backwards loops.
TEST(TopFigures, TheMeanPrecessionIsThatOfAnIntegratedMotion) {
  for (const double rate : {0.0, -20.0, 12.0, 40.0})
    for (const double tilt : {20.0, 100.0, 3.0}) {
      Scenario s = toy_top();
      s.release.tilt_deg = tilt;
      s.release.precession = Precession::given;
      s.release.precession_rate_rad_s = rate;
      const TopFigures top = figures_of(s);
      ASSERT_TRUE(top.mean_precession_rad_s && top.nutation_rad_s);
      const double mean = measured(s, 5 * kTwoPi / *top.nutation_rad_s).precession_rad_s;
      EXPECT_NEAR(*top.mean_precession_rad_s, mean, testing::truncation(s.numerics.relative_tolerance) * *top.nutation_rad_s)
          << rate << " " << tilt;
      if (rate == 0 && tilt == 20) {
        EXPECT_GT(std::abs(mean / *top.slow_precession_rad_s - 1), 1e-3);
      }
    }
}

TEST(TopFigures, TheNutationIsThatOfAnIntegratedMotion) {
  struct Case {
    double tilt, spin, duration_s;
    bool is_large;  ///< whether the frequency of small amplitudes is off by more than 3 %
  };
  for (const Case& c : {Case{20, 200, 1, false}, {60, 90, 2, true}, {100, 15, 2, true}, {150, -40, 2, false}}) {
    Scenario s = toy_top();
    s.release.tilt_deg = c.tilt;
    s.release.spin_rad_s = c.spin;
    const TopFigures top = figures_of(s);
    ASSERT_TRUE(top.nutation_rad_s) << c.tilt;
    EXPECT_EQ(top.nutation_kind, NutationKind::of_release);
    const double period = kTwoPi / *top.nutation_rad_s;
    EXPECT_NEAR(measured(s, c.duration_s).nutation_period_s / period, 1, left_by_parabolas(*top.nutation_rad_s * c.duration_s))
        << c.tilt;
    const double small = 4e-5 * std::abs(c.spin) / 1.2e-4;
    if (c.is_large) {
      EXPECT_GT(std::abs(*top.nutation_rad_s / small - 1), 0.03) << c.tilt;
    }
  }
}

/// A steady precession has the frequency of small nutations about it [e.g. Landau and Lifshitz, Mechanics, section 35, from the
/// effective potential], which a slightly disturbed one keeps.
TEST(TopFigures, ASteadyPrecessionHasTheFrequencyOfSmallAmplitudes) {
  for (const Precession which : {Precession::steady_slow, Precession::steady_fast}) {
    Scenario s = toy_top();
    s.release.precession = which;
    const TopFigures top = figures_of(s);
    EXPECT_EQ(top.nutation_kind, NutationKind::small_amplitude);
    const double I1 = 1.2e-4, mgl = 0.1 * 9.80665 * 0.03, c = std::cos(20 * kTwoPi / 360);
    const double x = which == Precession::steady_slow ? *top.slow_precession_rad_s : *top.fast_precession_rad_s;
    const double square = (I1 * I1 * x * x * x * x - 2 * I1 * mgl * x * x * c + mgl * mgl) / (I1 * I1 * x * x);
    EXPECT_NEAR(*top.nutation_rad_s / std::sqrt(square), 1, testing::rounding(40));
    s.release.precession = Precession::given;
    s.release.precession_rate_rad_s = x * (1 + 1e-4);
    const TopFigures disturbed = figures_of(s);
    EXPECT_EQ(disturbed.nutation_kind, NutationKind::of_release);
    EXPECT_NEAR(*disturbed.nutation_rad_s / std::sqrt(square), 1, 1e-3);
  }
}

TEST(TopFigures, AnUprightTopSleepsAboveTheCriticalSpinOnly) {
  Scenario s = toy_top();
  s.release.tilt_deg = 0;
  const double critical = 2 * std::sqrt(1.2e-4 * 0.1 * 9.80665 * 0.03) / 4e-5;
  const TopFigures sleeping = figures_of(s);
  EXPECT_NEAR(*sleeping.critical_spin_rad_s, critical, 1e-12 * critical);
  EXPECT_NEAR(*sleeping.spin_over_critical, 200 / critical, 1e-12);
  EXPECT_EQ(sleeping.nutation_kind, NutationKind::small_amplitude);
  EXPECT_NEAR(*sleeping.nutation_rad_s, *sleeping.fast_precession_rad_s - *sleeping.slow_precession_rad_s,
              testing::rounding(10) * critical);
  s.release.tilt_deg = 0.5;
  EXPECT_NEAR(measured(s, 1).nutation_period_s * *sleeping.nutation_rad_s / kTwoPi, 1, 1e-4);  // (0.5 deg)^2
  s.release.tilt_deg = 0;
  s.release.spin_rad_s = -0.99 * critical;
  const TopFigures falling = figures_of(s);
  EXPECT_NEAR(*falling.spin_over_critical, 0.99, 1e-12);
  EXPECT_FALSE(falling.nutation_rad_s);
  EXPECT_FALSE(falling.slow_precession_rad_s);
  EXPECT_EQ(falling.left_out.size(), 2u);
}

bool says(const std::vector<std::string>& sentences, const std::string& part) {
  for (const std::string& sentence : sentences)
    if (sentence.find(part) != std::string::npos) return true;
  return false;
}

TEST(TopFigures, WhatDoesNotApplyIsLeftOutWithTheReason) {
  const auto expect_body_only = [](const Scenario& s, const std::string& why) {
    const TopFigures top = figures_of(s);
    EXPECT_GT(top.mass_kg, 0);
    EXPECT_FALSE(top.slow_precession_rad_s || top.fast_precession_rad_s || top.nutation_rad_s || top.critical_spin_rad_s)
        << why;
    EXPECT_TRUE(says(top.left_out, why)) << why << (top.left_out.empty() ? "" : top.left_out.front());
  };
  Scenario s = testing::asymmetric_top();
  expect_body_only(s, "I1 and I2 about the pivot are not equal");
  s = toy_top();
  s.body.center_of_mass_m = {0.001, 0, 0.03};
  expect_body_only(s, "the centre of mass is off axis 3");
  s = toy_top();
  s.contact = ContactSpec{};
  s.contact->law = ContactLaw::viscous;
  expect_body_only(s, "the tip moves on the table");
  expect_body_only(testing::gyrocompass(45, 1, 0), "the gimbal holds the axis level");
  s = toy_top();
  s.platform = PlatformSpec{};
  s.platform->pivot_offset_m = {0.3, 0, 0};
  expect_body_only(s, "the platform carries the pivot round");

  // Below the spin of a steady precession at this tilt; by energy and momentum the top nutates all the same.
  s = toy_top();
  s.release.spin_rad_s = 70;
  const TopFigures slow = figures_of(s);
  const double least = 2 * std::sqrt(1.2e-4 * 0.1 * 9.80665 * 0.03 * std::cos(20 * kTwoPi / 360)) / 4e-5;
  EXPECT_GT(least, 70);
  EXPECT_FALSE(slow.slow_precession_rad_s);
  EXPECT_TRUE(says(slow.left_out, "at least"));
  EXPECT_TRUE(slow.nutation_rad_s && slow.critical_spin_rad_s);

  s = toy_top();
  s.release.tilt_deg = 90;
  const TopFigures level = figures_of(s);
  EXPECT_NEAR(*level.slow_precession_rad_s, 0.1 * 9.80665 * 0.03 / (4e-5 * 200), testing::rounding(20) * 4);
  EXPECT_FALSE(level.fast_precession_rad_s);
  EXPECT_TRUE(says(level.left_out, "90 degrees"));

  s.release.tilt_deg = 160;
  const TopFigures hanging = figures_of(s);
  EXPECT_FALSE(hanging.critical_spin_rad_s || hanging.spin_over_critical);
  EXPECT_TRUE(says(hanging.left_out, "hangs below"));
  EXPECT_TRUE(hanging.slow_precession_rad_s && hanging.nutation_rad_s);
  EXPECT_FALSE(figures_of(toy_top()).rim_speed_m_s);
}

/// On a table the steady release of each law precesses at its rate; sliding friction lets none be steady.
TEST(TopFigures, OnATableTheSteadyPrecessionsAreThoseOfIntegratedMotions) {
  for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::rolling}) {
    Scenario s = toy_top();
    s.contact.emplace().tip_radius_m = 0.002;
    s.contact->law = law;
    if (law == ContactLaw::rolling) s.contact->start = ContactStart::rolling;
    for (const Precession which : {Precession::steady_slow, Precession::steady_fast}) {
      s.release.precession = which;
      const TopFigures top = figures_of(s);
      EXPECT_FALSE(top.nutation_rad_s || top.critical_spin_rad_s);
      EXPECT_TRUE(says(top.left_out, "nutation and critical spin"));
      const auto& rate = which == Precession::steady_slow ? top.slow_precession_rad_s : top.fast_precession_rad_s;
      ASSERT_TRUE(rate);
      Scenario still = testing::non_rotating(s);
      still.duration_s = 1;
      still.output_step_s = 0.01;
      const RunResult result = run(resolve(still));
      double azimuth = 0;
      for (std::size_t i = 1; i < result.rows.size(); ++i) {
        const auto &p = result.rows[i - 1].axis_L, &q = result.rows[i].axis_L;
        azimuth += std::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
      }
      EXPECT_NEAR(azimuth / *rate, 1, testing::rounding(5000));
    }
  }
  Scenario s = toy_top();
  s.contact.emplace().law = ContactLaw::viscous;
  EXPECT_TRUE(says(figures_of(s).left_out, "precession, nutation and critical spin"));
}

TEST(TopFigures, ABalancedGyroscopeHasTheRateOfItsCone) {
  Scenario s = toy_top();
  s.body.center_of_mass_m = {0, 0, 0};
  TopFigures top = figures_of(s);
  EXPECT_FALSE(top.slow_precession_rad_s || top.fast_precession_rad_s || top.critical_spin_rad_s);
  EXPECT_NEAR(*top.nutation_rad_s, 4e-5 * 200 / 1.2e-4, 1e-12);
  EXPECT_EQ(top.nutation_kind, NutationKind::small_amplitude);
  s.release.angular_velocity_body_rad_s = {50, 0, 200};
  top = figures_of(s);
  EXPECT_EQ(top.nutation_kind, NutationKind::of_release);
  EXPECT_NEAR(*top.nutation_rad_s * measured(s, 1).nutation_period_s / kTwoPi, 1, left_by_parabolas(*top.nutation_rad_s));
  // Without gravity every body is free.
  s = toy_top();
  s.site.gravity_m_s2 = 0;
  EXPECT_TRUE(says(figures_of(s).left_out, "no torque about the pivot"));
  s.body.center_of_mass_m = {0.001, 0, 0.03};  // wherever its centre of mass is
  EXPECT_NEAR(*figures_of(s).nutation_rad_s, 4e-5 * 200 / 1.2e-4, 1e-12);
  testing::set_principal(s.body, 1.2e-4, 3e-4, 2e-4);
  EXPECT_TRUE(says(figures_of(s).notes, "middle moment"));
}

TEST(TopFigures, APendulumSwingsAtHalfTheRateOfItsTilt) {
  Scenario s = toy_top();
  s.release.tilt_deg = 179;
  s.release.spin_rad_s = 0;
  const TopFigures top = figures_of(s);
  const double small = std::sqrt(0.1 * 9.80665 * 0.03 / 1.2e-4);
  EXPECT_NEAR(*top.nutation_rad_s / (2 * small), 1, 3e-5);  // 1/16 of the amplitude squared
  EXPECT_TRUE(says(top.notes, "pendulum"));
}

/// Every number of the summary is finite or null, also at the ends of the ranges.
TEST(TopFigures, NothingIsNotANumber) {
  std::size_t numbers = 0;
  for (const double tilt : {0.0, 1e-13, 1e-9, 20.0, 90.0, 179.999999, 180.0})
    for (const double spin : {0.0, 1e-300, 60.0, -200.0, 1e9})
      for (const double height : {0.0, 1e-12, 0.03, -0.03})
        for (const double gravity : {0.0, 9.80665}) {
          Scenario s = toy_top();
          s.release.tilt_deg = tilt;
          s.release.spin_rad_s = spin;
          s.body.center_of_mass_m = {0, 0, height};
          s.site.gravity_m_s2 = gravity;
          RunResult result;
          result.scene = resolve(s);
          const auto json = summary_part(result, "top");
          for (const auto& [key, value] : json.items())
            if (value.is_number()) {
              EXPECT_TRUE(std::isfinite(value.get<double>())) << key << " " << tilt << " " << spin << " " << height;
              ++numbers;
            }
          for (const auto& [label, line] : top_lines(result.scene.top())) {
            EXPECT_EQ(line.find("nan"), std::string::npos) << line;
            EXPECT_EQ(line.find("inf"), std::string::npos) << line;
          }
        }
  EXPECT_GT(numbers, 1000u);
}

TEST(TopFigures, TheSummaryHasThemUnderTheirNames) {
  RunResult result;
  result.scene = resolve(toy_top());
  const TopFigures& top = result.scene.top();
  const auto json = summary_part(result, "top");
  EXPECT_EQ(json.at("mass_kg"), top.mass_kg);
  EXPECT_EQ(json.at("moments_about_center_kg_m2").at(0), top.moments_about_center_kg_m2[0]);
  EXPECT_EQ(json.at("slow_precession_rad_s"), *top.slow_precession_rad_s);
  EXPECT_EQ(json.at("slow_precession_period_s"), kTwoPi / *top.slow_precession_rad_s);
  EXPECT_EQ(json.at("nutation_period_s"), kTwoPi / *top.nutation_rad_s);
  EXPECT_EQ(json.at("spin_over_critical"), *top.spin_over_critical);
  EXPECT_TRUE(json.at("rim_speed_m_s").is_null());
  EXPECT_EQ(nlohmann::ordered_json::parse(top_json(result.scene)), json);
  EXPECT_FALSE(summary_path_fault("top.nutation_period_s"));
}

}  // namespace
}  // namespace earthtop
