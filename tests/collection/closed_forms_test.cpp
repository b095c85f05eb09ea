// SPDX-License-Identifier: GPL-3.0-or-later
/// The closed forms behind headline figures, evaluated for the scenarios themselves: the figure stated in each file equals its
/// formula, to the last digit stated.

#include <gtest/gtest.h>

#include <complex>

#include "collection/shipped.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/frames/earth.hpp"
#include "earthtop/model/body.hpp"

namespace earthtop {
namespace {

using Real = long double;
using Complex = std::complex<Real>;

struct ClosedForm {
  Scenario scenario;
  explicit ClosedForm(const char* name)
      : scenario(testing::parse_file(std::filesystem::path(EARTHTOP_SCENARIOS) / (std::string(name) + ".json"))) {}

  Real t() const { return scenario.headline->at_s.value_or(scenario.duration_s); }
  Real earth() const { return scenario.rotation_rate_rad_s; }
  SinCos<Real> latitude() const { return sin_cos_degrees<Real>(scenario.site.latitude_deg); }
  Body<Real> body() const { return make_body<Real>(scenario.body); }
  Real mgl() const { return body().mass * scenario.site.gravity_m_s2 * body().p_PBcm_B[2]; }

  /// The figure is stated to a hundredth of its tolerance or better.
  void expect_stated(Real value) const {
    EXPECT_LE(std::abs(scenario.headline->value - value), scenario.headline->tolerance / 100) << static_cast<double>(value);
  }
};

TEST(ClosedForms, FreeGyroAndPoleDriftByTheEarthsTurn) {
  for (const char* name : {"free-gyro", "north-pole"}) {
    const ClosedForm form(name);
    form.expect_stated(form.earth() * form.t());
  }
}

// The plane of swing turns at the mean of the two frequencies that the linear pendulum has on a turning floor; at a turning
// point both component motions are at their full amplitude.
TEST(ClosedForms, FoucaultPendulum) {
  const ClosedForm form("foucault-pendulum");
  const SymmetricTop<Real> top{form.body().I_BP_B(0, 0), form.body().I_BP_B(2, 2), form.mgl()};
  const Real periods = form.t() * std::sqrt(-top.mgl / top.I1) / (2 * real::pi<Real>());
  EXPECT_NEAR(static_cast<double>(periods), 300, 1e-4);
  const Real amplitude = sin_cos_degrees<Real>(form.scenario.release.tilt_deg).sin;
  const Vec3<Real> W_L = form.earth() * celestial_axis_L<Real>(form.scenario.site);
  const Real turned = -foucault_rate<Real>(top, amplitude, W_L).value * form.t();
  form.expect_stated(2 * std::asin(amplitude * std::sin(turned / 2)));
}

// With z the axis' horizontal components: I1 z" - i (p - 2 I1 s) z' - (m g l + I1 s^2 - p s) z = i c (p - I1 s), from rest at z
// = 0.
TEST(ClosedForms, SleepingTop) {
  const ClosedForm form("sleeping-top-above-critical");
  const Real I1 = form.body().I_BP_B(0, 0), I3 = form.body().I_BP_B(2, 2);
  const Real s = form.earth() * form.latitude().sin, c = form.earth() * form.latitude().cos;
  const Real p = I3 * (form.scenario.release.spin_rad_s + s);
  const Real stiffness = form.mgl() + I1 * s * s - p * s;
  const Complex i(0, 1), lean = -i * (c * (p - I1 * s) / stiffness);
  const Real b = p - 2 * I1 * s, root = std::sqrt(b * b - 4 * I1 * stiffness);
  const Real fast = (b + root) / (2 * I1), slow = (b - root) / (2 * I1);
  const Complex z =
      lean * (Real(1) + (slow * std::exp(i * fast * form.t()) - fast * std::exp(i * slow * form.t())) / (fast - slow));
  form.expect_stated(std::asin(std::abs(z)));
}

}  // namespace
}  // namespace earthtop
