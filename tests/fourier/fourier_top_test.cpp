// SPDX-License-Identifier: GPL-3.0-or-later
/// The Fourier sums of a symmetric top's motions against known digits, against the equations that other methods integrate, and
/// against what the theory says of them.
#include "integrate/fourier/fourier_top.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drift/long_horizon/followed_nutation.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "fourier/fourier_cases.hpp"
#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::axis_drift;
using testing::FourierCase;
using testing::FourierProblem;

const FourierCase& toy_top() { return testing::fourier_cases()[0]; }
const FourierCase& unbalanced() { return testing::fourier_cases()[2]; }

TEST(FourierTop, HasTheKnownDigits) {
  const auto rate = testing::parsed<double>(testing::kEarthRate);
  for (const FourierCase& c : testing::fourier_cases()) {
    SCOPED_TRACE(c.name);
    const FourierProblem<double> p = testing::problem_of<double>(c, rate);
    for (const TorusAxes axes : {TorusAxes::effective_vertical, TorusAxes::laboratory}) {
      const FourierTop<double> top(p.model, p.release, axes);
      ASSERT_EQ(top.refusal(), "");
      for (const FourierCase::At& at : c.drifts) {
        const auto known = testing::parsed<double>(at.drift_rad);
        // The inputs are rounded to double, which moves the phase of the precession: by half a unit of a thousand radians, and so on.
        const double turned = std::abs(top.plain().precession()) * at.t_s;
        EXPECT_NEAR(axis_drift(top.at(at.t_s), rate), known, testing::rounding(600 + turned) * known) << at.t_s;
      }
    }
  }
}

/// However small the Earth's rate is, the drift over it keeps its digits: from runs at four rates in 113 bits.
TEST(FourierTop, KeepsTheDigitsOfADriftAtAnyRate) {
  const auto drift_a_rate = [](const FourierCase& c, double t_s, double rate) {
    const FourierProblem<double> p = testing::problem_of<double>(c, rate);
    const Vec3<double> y = FourierTop<double>(p.model, p.release).at(t_s).y;
    return 2 * real::hypot(y[0], y[1]);
  };
  for (const double rate : {1e-18, 1e-100, 1e-300}) {
    EXPECT_NEAR(drift_a_rate(toy_top(), 60, rate) / 15.63663581382978725, 1, testing::rounding(400)) << rate;
    EXPECT_NEAR(drift_a_rate(unbalanced(), 3600, rate) / 1941.51181555440277, 1, testing::rounding(4000)) << rate;
  }
}

/// Each pass makes the error smaller by one order in the Earth's rate: what the second, third and fourth change goes with its
/// first, second and third power, over four decades.
TEST(FourierTop, GainsAnOrderInTheEarthsRateWithEachPass) {
  const auto changes = [](double rate) {
    const FourierProblem<double> p = testing::problem_of<double>(toy_top(), rate);
    return FourierTop<double>(p.model, p.release).torus()->changes();
  };
  for (std::size_t order = 1; order <= 3; ++order) {
    constexpr double kLargest = 1e-3, kLeastSeen = 1e-13;
    int seen = 0;
    for (double rate = kLargest; rate > 1e-8; rate /= 10) {
      const double now = changes(rate)[order], before = changes(10 * rate)[order];
      if (now < kLeastSeen) break;
      // A power of 1.9 or 2.1 would not be one: at a tenth of the precession's rate the next order still shows.
      EXPECT_NEAR(std::log10(before / now), static_cast<double>(order), 0.1) << order << ", " << rate;
      ++seen;
    }
    EXPECT_GE(seen, 4 - static_cast<int>(order)) << order;
  }
}

/// Whatever sums are found, they must satisfy the equations of motion: a series of the laboratory's equations goes on from any of their
/// states, through one nutation, and meets them again. (At far smaller rates a state's rates do not hold the digits of their difference.)
TEST(FourierTop, SatisfiesTheLaboratorysEquations) {
  const auto rate = testing::parsed<double>(testing::kEarthRate);
  for (const double share : {1.0, 10.0, 30.0})
    for (const FourierCase& c : testing::fourier_cases()) {
      SCOPED_TRACE(c.name);
      const FourierProblem<double> p = testing::problem_of<double>(c, share * rate);
      const FourierTop<double> top(p.model, p.release);
      ASSERT_EQ(top.refusal(), "");
      for (const double t : {0.0, 7.3, 59.0}) {
        FollowedNutation followed(p.model, p.release, top.plain().period());
        followed.begin(t, top.at(t));
        for (const double part : {0.3, 1.0}) {
          const double later = t + part * top.plain().period();
          const SpinlessPair<double> went = followed.at(later), is = top.at(later);
          const double size = 1 + norm(is.y), tolerance = testing::rounding(10'000) * size;
          EXPECT_LT(norm(Vec3<double>(went.y - is.y)), tolerance) << share << ", " << t;
          EXPECT_NEAR(went.e_w, is.e_w, tolerance);
          EXPECT_NEAR(went.across.re, is.across.re, tolerance * top.fast_rate());
          EXPECT_NEAR(went.across.im, is.across.im, tolerance * top.fast_rate());
          EXPECT_NEAR(went.spin_excess, is.spin_excess, tolerance * share * rate);
        }
      }
    }
}

/// The secular rate is that of the azimuth in the long run: in a hundred thousand minutes its swings, of hundredths of a radian, are
/// averaged out by weights that fall smoothly to zero.
TEST(FourierTop, KnowsTheMeanRateOfTheAzimuth) {
  for (const char* name : {"toy-top", "southern-hemisphere", "steady-precession-slow", "fast-gyro"}) {
    Scenario s = testing::shipped(name);
    s.numerics = {};
    s.numerics.method = Method::fourier;
    ASSERT_TRUE(Scene(s).fourier_outlook().has_azimuth_rate);
    s.duration_s = 6e6;
    s.output_step_s = 1500;
    const auto long_run = integrate_drift(Scene(s).problem<double>(), s.numerics);
    ASSERT_EQ(long_run.status, RunStatus::completed);
    double sum = 0, weights = 0;
    for (std::size_t i = 1; i < long_run.samples.size(); ++i) {
      const double x = (static_cast<double>(i) - 0.5) / static_cast<double>(long_run.samples.size() - 1);
      const double weight = std::exp(-1 / (x * (1 - x)));
      sum += weight * (long_run.samples[i].azimuth - long_run.samples[i - 1].azimuth), weights += weight * s.output_step_s;
    }
    const double rate = Scene(s).fourier_outlook().azimuth_rate_rad_s;
    // A secular term of the second order is 1e-5 of the rate and more; what the weights leave of the swings is less than 1e-7.
    EXPECT_NEAR(sum / weights / rate, 1, 1e-7) << name;
  }
}

TEST(FourierTop, RefusesWithTheReason) {
  const auto refusal = [](auto&& change) {
    Scenario s = testing::toy_top();
    s.numerics.method = Method::fourier;
    change(s);
    return Scene(s).method_refusal().value_or("none");
  };
  EXPECT_EQ(refusal([](Scenario&) {}), "none");
  EXPECT_NE(refusal([](Scenario& s) { s.body.center_of_mass_m = {0, 0, 0}; }).find("no precession"), std::string::npos);
  EXPECT_NE(refusal([](Scenario& s) { s.rotation_rate_rad_s = 3; }).find("not much faster than the Earth's"),
            std::string::npos);
  EXPECT_NE(refusal([](Scenario& s) { s.release.tilt_deg = 0; }).find("stays vertical"), std::string::npos);
  EXPECT_NE(refusal([](Scenario& s) { s.release.tilt_deg = 175, s.release.spin_rad_s = 0; }).find("swings in a plane"),
            std::string::npos);
  // Thrown upward with just the energy to stand: next to a separatrix.
  EXPECT_NE(refusal([](Scenario& s) { s.release.tilt_deg = 0.01, s.release.spin_rad_s = 90; }).find("finds no Fourier sums"),
            std::string::npos);
  EXPECT_NE(
      refusal([](Scenario& s) { testing::set_principal(s.body, 1.2e-4, 1.3e-4, 4e-5); }).find("symmetric about body axis 3"),
      std::string::npos);
  EXPECT_NE(refusal([](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-8; }).find("only with gravity"), std::string::npos);
  EXPECT_NE(refusal([](Scenario& s) { s.numerics.observer = Observer::body; }).find("own variables"), std::string::npos);
}

}  // namespace
}  // namespace earthtop
