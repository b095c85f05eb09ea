// SPDX-License-Identifier: GPL-3.0-or-later
/// Motions on a table with closed forms or reference values of their own: steady precession, a rolling ball, lift-off, slip that
/// stops, and a body without symmetry.
#include <gtest/gtest.h>

#include "drift/table/contact_slip_clock.hpp"
#include "support/contact_references.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::contact_rows;
using testing::ContactProblem;
using testing::ContactScene;
using testing::Form;

ContactSpec under(ContactLaw law, double tip_radius_m, ContactStart start = ContactStart::tip_at_rest) {
  ContactSpec spec;
  spec.law = law, spec.tip_radius_m = tip_radius_m, spec.start = start;
  return spec;
}

/// Steady precession, without the Earth: the rates from their quadratic equation, and the motions that they start.
TEST(ContactSteadyPrecession, GoesOnAsItStarts) {
  for (const bool rolls : {false, true}) {
    ContactScene scene = testing::toy_on_table(under(rolls ? ContactLaw::rolling : ContactLaw::frictionless, 0.002,
                                                     rolls ? ContactStart::rolling : ContactStart::center_of_mass_at_rest));
    scene.earth_rate_rad_s = 0;
    const double tilt = 20 * real::pi<double>() / 180, sine = std::sin(tilt), cosine = std::cos(tilt);
    const ContactProblem<double> problem(scene);
    const auto rate = [&](Precession which) {
      const auto& units = problem.units;
      const double gravity = real::scale(9.80665, 2 * units.time_exponent);
      return units.rate_to_rad_s(
          *steady_precession_on_table(problem.contact, gravity, cosine, units.rate_from_rad_s(200.0), which));
    };
    const double V = rate(Precession::steady_slow);
    // The constants of the body about C are rounded once more when they are taken there from O.
    EXPECT_NEAR(V, rolls ? 3.3465228640411654360 : 3.7264267985134958930, 1e-13);
    if (!rolls) {
      EXPECT_NEAR(rate(Precession::steady_fast), 280.05431252839642435, 1e-11);
    }
    scene.transverse_rad_s = {-V * sine, 0};
    // The given rate along the axis is that of the inertial body; without the Earth it is the one relative to the laboratory.
    const auto rows = contact_rows<double, Observer::laboratory>(scene, {0.3, 1}, 1e-14);
    for (const auto& row : rows) EXPECT_NEAR(row.contact.axis_L[2].ref, cosine, 1e-12);
    const auto& at_end = rows[1].contact;
    EXPECT_NEAR(std::atan2(at_end.axis_L[1].ref, at_end.axis_L[0].ref), std::remainder(V, 2 * real::pi<double>()), 1e-12);
    if (!rolls) {
      // C is at rest and the tip circles below it.
      EXPECT_NEAR(at_end.tip_L[0].ref, 0.03 * sine * (1 - std::cos(V)), 1e-13);
      EXPECT_NEAR(at_end.tip_L[1].ref, -0.03 * sine * std::sin(V), 1e-13);
    } else {
      EXPECT_NEAR(at_end.tip_L[0].ref, 0.079633771323731519517, 1e-13);
      EXPECT_NEAR(at_end.tip_L[1].ref, 0.0081883596324861995421, 1e-13);
      const auto& F = at_end.reaction;
      EXPECT_NEAR(std::hypot(F.friction[0].ref, F.friction[1].ref) / F.normal_force.ref, 0.0342341022234385278, 1e-11);
    }
  }
}

/// A homogeneous ball that rolls on the Earth: linear equations with constant coefficients, by their matrix exponential.
TEST(ContactBall, RollsAsItsClosedForm) {
  ContactScene ball{0.1, 0, 1.6e-5, 1.6e-5, 9.80665, 200, 0, under(ContactLaw::rolling, 0.02, ContactStart::rolling)};
  ball.transverse_rad_s = {5, 0};
  const auto rolling = [](const ContactScene& scene) {
    return contact_rows<double, Observer::laboratory>(scene, {20}, 1e-14)[0];
  };
  const auto row = rolling(ball);
  const ContactProblem<double> problem(ball);
  const Vec3<double> w = problem.units.rate_to_rad_s(1.0) * times(rotation_matrix(row.state.q_LB), row.state.w_LB_B);
  const double known[3] = {4.9410642020250720103, -0.0087872868324975269104, 200.00512591601715562};
  // The rounding of some thousand steps, in the last place of 200 rad/s each.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(w[i], known[i], 1e-10);
  EXPECT_NEAR(row.contact.tip_L[0].rot, -0.0017609301823493557716, 2e-12);
  EXPECT_NEAR(row.contact.tip_L[1].rot, -1.9882132827161829577, 2e-11);

  ball.transverse_rad_s = {0, 0};
  const auto upright = rolling(ball);  // it rolls to the North by itself
  EXPECT_NEAR(upright.contact.tip_L[0].rot, 6.945293562979295885e-6, 1e-15);
  EXPECT_NEAR(upright.contact.tip_L[1].rot, 0.01178582741749423346, 1e-13);
  EXPECT_NEAR(upright.epsilon * upright.contact.tip_L[1].diff, 0.01178582741749423346, 1e-13);

  // A ball that is its own turntable: at a pole a table turns at any rate W, and the ball runs a circle at 2/7 W.
  ball.latitude_deg = 90, ball.earth_rate_rad_s = 1, ball.spin_rad_s = 0, ball.transverse_rad_s = {5, 0};
  const auto period = contact_rows<double, Observer::inertial>(ball, {7 * real::pi<double>()}, 1e-14)[0];
  // In inertial axes the circle closes after 7 pi s; the table's own axes are half a turn further then.
  EXPECT_NEAR(period.contact.tip_L[0].rot, 0, 1e-10);
  EXPECT_NEAR(period.contact.tip_L[1].rot, 0, 1e-10);
}

/// The normal force goes through 0 at the reference times, within 1e-11 of them.
TEST(ContactLiftOff, HappensAtItsTimes) {
  struct Case {
    std::array<double, 2> transverse;
    double spin, t_without, t_with;
  };
  for (const Case& known : {Case{{0, -22}, 0, 0.011612370196280499907, 0.011612370196216116821},
                            Case{{-3, -15}, 50, 0.0070863810694653000743, 0.0070864527085555633182}}) {
    ContactScene scene = testing::toy_on_table(under(ContactLaw::frictionless, 0.002, ContactStart::center_of_mass_at_rest));
    scene.tilt_deg = 60, scene.spin_rad_s = known.spin, scene.transverse_rad_s = known.transverse;
    for (const auto& [t, member] :
         {std::pair(known.t_without, &Paired<double>::ref), std::pair(known.t_with, &Paired<double>::rot)}) {
      const auto rows = contact_rows<double, Observer::laboratory>(scene, {t * (1 - 1e-11), t * (1 + 1e-11)}, 1e-14);
      EXPECT_GT(rows[0].contact.reaction.normal_force.*member, 0);
      EXPECT_LT(rows[1].contact.reaction.normal_force.*member, 0);
      if (known.spin == 0) {
        EXPECT_NEAR(std::acos(rows[0].contact.axis_L[2].ref) * 180 / real::pi<double>(), 45.53806847841750086, 1e-8);
      }
    }
  }
}

/// A body without symmetry under viscous friction, in both sets of axes.
TEST(ContactGeneralBody, MeetsItsReference) {
  ContactScene scene = testing::toy_on_table(under(ContactLaw::viscous, 0.002));
  scene.contact.sliding_viscosity_N_s_m = 0.05, scene.I2_kg_m2 = 2.5e-5;
  const double q_E[4] = {0.97917941475118700504, -0.15025292332659708793, 0.088988703023767011377, -0.10350238399902891751};
  const double q_N[4] = {0.97917860859715925057, -0.15025700970558480243, 0.088992749316580442127, -0.10350059936610644542};
  const double p_E[2] = {0.0045416035444387337686, -0.0096276164094632913356};
  const double p_N[2] = {0.0045414018921375772744, -0.0096278381331083031041};
  const auto expect = [&](const auto& row) {
    const auto near = [](const Quaternion<double>& q, const double* known) {
      EXPECT_NEAR(q.w, known[0], 1e-12);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(q.v[i], known[i + 1], 1e-12);
    };
    near(row.state.q_LB, q_E), near(row.state.ref_q_LB, q_N);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(row.contact.tip_L[i].rot, p_E[i], 1e-13);
      EXPECT_NEAR(row.contact.tip_L[i].ref, p_N[i], 1e-13);
      EXPECT_NEAR(row.epsilon * row.contact.tip_L[i].diff, p_E[i] - p_N[i], 1e-15);
    }
  };
  expect(contact_rows<double, Observer::laboratory, Form::general>(scene, {0.25}, 1e-14)[0]);
  expect(contact_rows<double, Observer::inertial, Form::general>(scene, {0.25}, 1e-14)[0]);
}

/// Both motions at the stops of their slips.
struct Stop {
  Paired<double> time_s;
  Vec3<Paired<double>> tip;
  std::array<double, ContactReducedShape<Observer::laboratory>::kSize> state;
};
/// Slides to the stop by the slip clock.
template <class Drift>
Stop slide_to_stop(const ContactProblem<double>& problem, const Drift& drift) {
  const ContactSlipClock<double> clock(drift.equations());
  using Shape = ContactSlipClockShape;
  auto x = clock.started(drift.initial_state(), 0);
  const double slip_at_start = clock.slip(drift.initial_state()).ref;
  double sigma = 0, step = 0.01;
  for (double slip = slip_at_start; slip > 1e-17 * slip_at_start;) {
    // The sizes that errors are measured against are kept for one power of ten of the slip.
    GroupScales<double, Shape> scales;
    scales.include(x), scales.include(clock.started(drift.typical_state(), 1));
    Extrapolation<double, Shape> stepper(1e-14, scales);
    const double next = slip / 10;
    for (; slip > next; slip = clock.slip(clock.sliding_state(x)).ref) stepper.try_step(clock, x, sigma, step);
  }
  const Paired<double> t = clock.stop_time(x);
  const auto in_s = [&](double time) { return real::scale(time, problem.units.time_exponent); };
  return {{in_s(t.ref), in_s(t.rot), t.diff}, drift.equations().top(clock.stopped(x), 0).state.p_O, clock.stopped(x)};
}

TEST(ContactSlipStop, OfABallIsAtItsClosedForm) {
  ContactSpec contact = under(ContactLaw::coulomb, 0.02, ContactStart::tip_velocity);
  contact.friction_coefficient = 0.2, contact.tip_velocity_m_s = {1, 0};
  const ContactScene ball{0.1, 0, 1.6e-5, 1.6e-5, 9.80665, 200, 0, contact};
  const ContactProblem<double> problem(ball);
  const auto drift = problem.system<Observer::laboratory>();
  const Stop stop = slide_to_stop(problem, drift);
  EXPECT_NEAR(stop.time_s.ref, 0.1456737447111326, testing::rounding(20));
  EXPECT_NEAR(stop.time_s.rot, 0.1456750579911984475, testing::rounding(20));
  EXPECT_NEAR(stop.tip[0].ref, 0.1248632097523994, 1e-12);
  EXPECT_NEAR(stop.tip[0].rot, 0.1248643458192840170, 1e-12);
  EXPECT_NEAR(stop.tip[1].rot, -5.545597999252320e-7, 1e-15);
}

TEST(ContactSlipStop, OfATopOnItsWayIsAtItsReference) {
  ContactSpec contact = under(ContactLaw::coulomb, 0.002);
  contact.friction_coefficient = 0.2;
  const ContactProblem<double> toy(testing::toy_on_table(contact));
  const Stop stop = slide_to_stop(toy, toy.system<Observer::laboratory>());
  EXPECT_NEAR(stop.time_s.ref / 0.041675440557094284672, 1, 1e-11);
  EXPECT_NEAR(stop.time_s.rot / 0.041675219113489381289, 1, 1e-11);
}

/// The tippe top stops slipping and rolls on: the drift after a second, from the stops of both motions, at the Earth's rate and at
/// the smallest.
TEST(ContactSlipStop, LeavesADriftThatDoesNotDependOnTheEarthRate) {
  ContactSpec contact = under(ContactLaw::coulomb, 0.015);
  contact.friction_coefficient = 0.3;
  for (const double rate : {kEarthRateWgs84, 1e-300}) {
    ContactScene scene = testing::leine_glocker_top(contact);
    scene.earth_rate_rad_s = rate;
    const ContactProblem<double> problem(scene);
    const auto drift = problem.system<Observer::laboratory>();
    const Stop stop = slide_to_stop(problem, drift);
    EXPECT_NEAR(stop.time_s.ref / 0.036144921891384602188, 1, 1e-11);
    const double seconds = real::scale(1.0, problem.units.time_exponent);
    // From a fast Earth to the smallest rate the difference of the times changes by its second order.
    const double scale = kEarthRateWgs84 / rate * problem.model.epsilon, tolerance = rate == kEarthRateWgs84 ? 1e-10 : 1e-3;
    EXPECT_NEAR(scale * stop.time_s.diff * seconds / -7.9683137625358639e-7, 1, tolerance);

    auto rolling = drift.equations();
    rolling.set_law(ContactLaw::rolling);
    using Shape = ContactReducedShape<Observer::laboratory>;
    GroupScales<double, Shape> scales;
    auto x = stop.state;
    scales.include(x), scales.include(drift.typical_state());
    Extrapolation<double, Shape> stepper(1e-14, scales);
    const double end = problem.units.time_from_s(1.0);
    double t = problem.units.time_from_s(stop.time_s.ref), step = 0.1;
    while (t < end) {
      step = std::min(step, end - t);
      const bool lands = t + step >= end;
      if (stepper.try_step(rolling, x, t, step) == boost::numeric::odeint::success && lands) break;
      scales.include(x);
    }
    const auto at_end = rolling.top(at_reference_time(rolling, x, end, stop.time_s.diff), end).state;
    const double p[2] = {9.453646349557655e-7, 2.801364679312270e-5}, n[2] = {-2.017236267302578e-5, 3.454428095376827e-6};
    const double p_size = std::hypot(p[0], p[1]), n_size = std::hypot(n[0], n[1]);
    const double row_tolerance = rate == kEarthRateWgs84 ? 1e-9 : 1e-3;
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(scale * at_end.p_O[i].diff, p[i], row_tolerance * p_size);
      EXPECT_NEAR(scale * at_end.n[i].diff, n[i], row_tolerance * n_size);
    }
  }
}

}  // namespace
}  // namespace earthtop
