// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift of tops on a table: laboratory against inertial axes and the form for any body against that for symmetric ones at a
/// fast Earth; its smallest rates, its start, and its Taylor series.
#include <gtest/gtest.h>

#include <random>

#include "drift/derivatives/contact_derivatives.hpp"
#include "integrate/taylor/taylor_stepper.hpp"
#include "support/contact_references.hpp"
#include "support/contact_series.hpp"

namespace earthtop {
namespace {

using testing::ContactProblem;
using testing::ContactRow;
using testing::ContactScene;

double size_of(const Vec3<Paired<double>>& v, double Paired<double>::*member) {
  return norm(Vec3<double>(v[0].*member, v[1].*member, v[2].*member));
}
/// The difference of two pairs of vectors, relative to the larger of the vectors and `floor`.
double difference(const Vec3<Paired<double>>& a, const Vec3<Paired<double>>& b, double floor) {
  const Vec3<Paired<double>> d = a - b;
  double worst = 0;
  for (const auto member : {&Paired<double>::ref, &Paired<double>::rot, &Paired<double>::diff})
    worst = std::max(worst, size_of(d, member) / std::max({size_of(a, member), size_of(b, member), floor}));
  return worst;
}
/// The same of a number.
double difference(const Paired<double>& a, const Paired<double>& b, double floor) {
  const Paired<double> zero(0.0);
  return difference(Vec3<Paired<double>>(a, zero, zero), Vec3<Paired<double>>(b, zero, zero), floor);
}

/// The largest relative difference of anything that two rows show.
double difference(const ContactRow<double>& a, const ContactRow<double>& b) {
  const auto& x = a.contact;
  const auto& y = b.contact;
  const double force = 0.1 * std::abs(x.reaction.normal_force.ref);
  // Slip can be far below the rates that it is made of.
  double worst = std::max(
      {difference(x.axis_L, y.axis_L, 0), difference(x.tip_L, y.tip_L, 1e-4), difference(x.slip_L, y.slip_L, 1e-3),
       difference(x.spin, y.spin, 1e-3), difference(x.relative_spin, y.relative_spin, 1e-3),
       difference(x.reaction.normal_force, y.reaction.normal_force, force),
       difference(x.reaction.friction, y.reaction.friction, force), difference(x.reaction.moment, y.reaction.moment, force)});
  const auto &s = a.state, &o = b.state;
  const double sign = s.e_w * o.e_w + s.epsilon * s.epsilon * s.e_v_scaled.dot(o.e_v_scaled) < 0 ? -1 : 1;
  worst = std::max({worst, norm(Vec3<double>(s.e_v_scaled - sign * o.e_v_scaled)) / norm(s.e_v_scaled),
                    std::abs(s.e_w - sign * o.e_w), norm(Vec3<double>(s.w_LB_B - o.w_LB_B)),
                    norm(Vec3<double>(s.ref_w_LB_B - o.ref_w_LB_B))});
  for (const auto& [q, p] : {std::pair(s.q_LB, o.q_LB), std::pair(s.ref_q_LB, o.ref_q_LB)})
    worst = std::max(worst, 1 - std::abs(q.w * p.w + q.v.dot(p.v)));
  return worst;
}

/// A random top under a law, with slip rates of 1 to 100 per second.
ContactScene random_scene(ContactLaw law, std::mt19937& engine) {
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); };
  ContactScene scene{};
  scene.mass_kg = number(0.02, 0.2), scene.center_m = number(-0.01, 0.02);
  scene.I1_kg_m2 = scene.mass_kg * number(1, 2) * 1e-4, scene.I3_kg_m2 = scene.mass_kg * number(1, 2) * 1e-4;
  scene.gravity_m_s2 = 9.8, scene.spin_rad_s = number(100, 200), scene.tilt_deg = number(5, 40);
  scene.transverse_rad_s = {number(-5, 5), number(-5, 5)};
  scene.latitude_deg = number(-90, 90);
  scene.gradient = number(0, 1) < 0.3;
  scene.rates = number(0, 1) < 0.5 ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  ContactSpec& c = scene.contact;
  c.law = law, c.tip_radius_m = number(0, 1) < 0.2 && law != ContactLaw::contensou ? 0 : number(0.002, 0.02);
  c.sliding_viscosity_N_s_m = scene.mass_kg * number(0.5, 5), c.sliding_viscosity_s_m = number(0.05, 0.5);
  c.friction_coefficient = number(0.1, 0.3), c.regularisation_m_s = number(0.02, 0.1), c.patch_radius_m = number(5e-4, 1e-3);
  if (number(0, 1) < 0.4) c.spinning_friction_m = 1e-4, c.rolling_resistance_m = 2e-5, c.regularisation_rad_s = 3;
  if (number(0, 1) < 0.4) c.table_tilt_deg = number(0, 5), c.table_tilt_azimuth_deg = number(0, 360);
  constexpr std::array kStarts{ContactStart::tip_at_rest, ContactStart::rolling, ContactStart::center_of_mass_at_rest,
                               ContactStart::tip_velocity};
  c.start = law == ContactLaw::rolling ? ContactStart::rolling : kStarts[static_cast<std::size_t>(number(0, 3.999))];
  c.tip_velocity_m_s = {0.1, -0.05};
  return scene;
}

class ContactDrift : public ::testing::TestWithParam<ContactLaw> {};

/// Over a third of a turn of the Earth about its axis, at half a radian per second.
TEST_P(ContactDrift, IsTheSameInLaboratoryAndInertialAxes) {
  std::mt19937 engine(5);
  for (int i = 0; i < 6; ++i) {
    ContactScene scene = random_scene(GetParam(), engine);
    scene.earth_rate_rad_s = 0.5;
    const std::vector<double> times{0, 0.01, 1};
    const auto laboratory = testing::contact_rows<double, Observer::laboratory>(scene, times, 1e-14);
    const auto inertial = testing::contact_rows<double, Observer::inertial>(scene, times, 1e-14);
    for (std::size_t row = 1; row < times.size(); ++row) {
      const double worst = difference(laboratory[row], inertial[row]);
      // The tolerance of some 100 steps each, by at most a hundredfold growth.
      EXPECT_LT(worst, 1e-9) << "scene " << i << " at " << times[row] << " s";
    }
  }
}

/// A symmetric body in the equations for any body, and another one, which only these can follow.
TEST_P(ContactDrift, IsTheSameInTheEquationsForAnyBody) {
  using testing::Form;
  std::mt19937 engine(9);
  for (int i = 0; i < 3; ++i) {
    ContactScene scene = random_scene(GetParam(), engine);
    scene.earth_rate_rad_s = 0.5;
    const std::vector<double> times{0.2};
    const auto reduced = testing::contact_rows<double, Observer::laboratory>(scene, times, 1e-14);
    const auto general = testing::contact_rows<double, Observer::laboratory, Form::general>(scene, times, 1e-14);
    // The least exact is the difference of the normal forces, which go with the phases of the fast spins.
    EXPECT_LT(difference(reduced[0], general[0]), 3e-9) << "scene " << i;
    scene.I2_kg_m2 = 1.1 * scene.I1_kg_m2, scene.center_across_m = 0.001;
    const auto laboratory = testing::contact_rows<double, Observer::laboratory, Form::general>(scene, times, 1e-14);
    const auto inertial = testing::contact_rows<double, Observer::inertial, Form::general>(scene, times, 1e-14);
    EXPECT_LT(difference(laboratory[0], inertial[0]), 3e-9) << "scene " << i;
    EXPECT_GT(difference(laboratory[0], general[0]), 1e-3);
  }
}

/// Differences over epsilon do not depend on epsilon while they are small: at 1e-300 rad/s nothing underflows.
TEST_P(ContactDrift, IsTheSameAtTheSmallestEarthRates) {
  std::mt19937 engine(6);
  for (int i = 0; i < 2; ++i) {
    ContactScene scene = random_scene(GetParam(), engine);
    scene.earth_rate_rad_s = 1e-14;
    const auto small = testing::contact_rows<double, Observer::laboratory>(scene, {0.5}, 1e-13);
    scene.earth_rate_rad_s = 1e-300;
    const auto smallest = testing::contact_rows<double, Observer::laboratory>(scene, {0.5}, 1e-13);
    EXPECT_LT(difference(small[0], smallest[0]), 1e-9);
    EXPECT_GT(smallest[0].measures.axis, 0);
    const auto inertial = testing::contact_rows<double, Observer::inertial>(scene, {0.5}, 1e-13);
    EXPECT_LT(difference(inertial[0], smallest[0]), 1e-9);
  }
}

template <Observer O, testing::Form F = testing::Form::reduced>
void expect_series_agree(const ContactScene& scene) {
  const ContactProblem<double> problem(scene);
  auto system = problem.template system<O, F>();
  using System = decltype(system);
  constexpr double kEnd = F == testing::Form::reduced ? 0.5 : 0.1;
  const double end = problem.units.time_from_s(kEnd);
  auto x = system.initial_state();
  GroupScales<double, typename System::Shape> scales;
  scales.include(x), scales.include(system.typical_state());
  taylor::TaylorStepper<double, System> stepper(1e-14, scales);
  auto series = system.series();
  stepper.initialize(x, 0);
  int steps = 0;
  do {
    stepper.limit_step(end - stepper.current_time());
    stepper.do_step(series);
    x = stepper.current_state();
    scales.include(x);
    if constexpr (F == testing::Form::reduced) system.follow(x, stepper.current_time());
    ASSERT_LT(++steps, 10000);
  } while (end - stepper.current_time() > 1e-13 * end);
  const ContactRow<double> row = testing::contact_row(problem, system, x, end);
  const auto known = testing::contact_rows<double, O, F>(scene, {kEnd}, 1e-14);
  EXPECT_LT(difference(row, known[0]), 1e-10);
}
TEST_P(ContactDrift, HasATaylorSeries) {
  std::mt19937 engine(7);
  for (int i = 0; i < 2; ++i) {
    const ContactScene scene = random_scene(GetParam(), engine);
    expect_series_agree<Observer::laboratory>(scene);
    expect_series_agree<Observer::inertial>(scene);
    expect_series_agree<Observer::laboratory, testing::Form::general>(scene);
    expect_series_agree<Observer::inertial, testing::Form::general>(scene);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ContactDrift, ::testing::ValuesIn(testing::kAllLaws));

/// At release both motions share the attitude, the position, the rates of the kind that the release names, and the velocity that
/// the start names.
TEST(ContactStart, SharesWhatItNames) {
  std::mt19937 engine(8);
  for (const ContactStart start :
       {ContactStart::tip_at_rest, ContactStart::rolling, ContactStart::center_of_mass_at_rest, ContactStart::tip_velocity})
    for (const RatesRelativeTo rates : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
      ContactScene scene = random_scene(ContactLaw::viscous, engine);
      scene.contact.start = start, scene.rates = rates, scene.earth_rate_rad_s = 0.5;
      const ContactProblem<double> problem(scene);
      const auto system = problem.system<Observer::laboratory>();
      const auto top = system.equations().top(system.initial_state(), 0);
      const auto& s = top.state;
      const auto earth = [&](double Paired<double>::*member) {
        return member == &Paired<double>::rot ? system.equations().model().W_IL_L : Vec3<double>(Vec3<double>::Zero());
      };
      Vec3<double> w[2], v_O[2], v_C[2];
      int i = 0;
      for (const auto member : {&Paired<double>::ref, &Paired<double>::rot}) {
        const auto part = [&](const Vec3<Paired<double>>& v) { return Vec3<double>(v[0].*member, v[1].*member, v[2].*member); };
        const Vec3<double> n = part(s.n), w_IB = part(s.u) + s.w3.*member * n, w_LB = w_IB - earth(member);
        w[i] = rates == RatesRelativeTo::laboratory ? w_LB : w_IB;
        v_O[i] = part(s.v_P) + problem.contact.tip_radius * w_LB.cross(Vec3<double>::UnitZ());
        v_C[i] = v_O[i] + problem.contact.height_of_center * w_LB.cross(n);
        v_C[i][2] = 0;
        const Vec3<double> named = start == ContactStart::rolling                  ? part(s.v_P)
                                   : start == ContactStart::center_of_mass_at_rest ? v_C[i]
                                                                                   : Vec3<double>(v_O[i] - problem.start.v_O);
        EXPECT_LT(norm(named), 1e-15);
        EXPECT_EQ(s.v_P[2].*member, 0);
        ++i;
      }
      EXPECT_LT(norm(Vec3<double>(w[1] - w[0])), 1e-15);
      EXPECT_EQ(size_of(s.n, &Paired<double>::diff) + size_of(s.p_O, &Paired<double>::diff), 0);
    }
}

/// The derivatives of the non-rotating prediction with a coefficient and with the tilt of the table, against differences of two
/// predictions; and their sizes for the toy top under the law of a contact patch, at 1 % and 1 arcsecond.
TEST(ContactDerivatives, GiveTheDerivativesOfThePrediction) {
  const ContactScene scene = testing::toy_on_table(
      {.tip_radius_m = 0.002, .law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 3e-5});
  const ContactProblem<double> problem(scene);
  ProblemDerivative friction;
  friction.table.contact.coefficient = 1;
  const auto down_to_the_east = table_tilt_change(problem.model, problem.start, SinCos<double>{1, 0});
  constexpr double kArcsecond = 4.848136811095360e-6;
  const auto at = [&](double time_s) {
    return contact_derivatives(testing::drift_problem(problem), {friction, down_to_the_east}, time_s, 1e-12).each;
  };
  const auto early = at(0.2), late = at(5);
  // The references have two digits, and one.
  constexpr double kReference = 1e-6;
  EXPECT_NEAR(0.002 * norm(late[0].axis_L), 6.6e-5, kReference);
  EXPECT_NEAR(0.002 * norm(late[0].tip_L_m), 1.3e-5, kReference);
  EXPECT_NEAR(kArcsecond * norm(late[1].axis_L), 9e-6, kReference);
  EXPECT_NEAR(kArcsecond * norm(late[1].tip_L_m), 1.0e-5, kReference);

  const auto central = [&](auto&& changed, double step, const auto& derivative) {
    ContactScene more = scene, less = scene;
    changed(more.contact, step), changed(less.contact, -step);
    const ContactProblem<double> m(more), l(less);
    // In the axes of the table: the release is the same there.
    const auto in_table = [&](const ContactProblem<double>& p) {
      auto row = testing::rows_of(p, p.system<Observer::laboratory>(), {0.2}, 1e-14)[0];
      const Mat3<double> R_LH = rotation_matrix(p.start.q_LH);
      return std::pair(
          transposed_times(R_LH, Vec3<double>(row.contact.axis_L[0].ref, row.contact.axis_L[1].ref, row.contact.axis_L[2].ref)),
          transposed_times(R_LH, Vec3<double>(row.contact.tip_L[0].ref, row.contact.tip_L[1].ref, row.contact.tip_L[2].ref)));
    };
    const auto [n_more, p_more] = in_table(m);
    const auto [n_less, p_less] = in_table(l);
    const double unit = step == 0.1 ? 0.1 * real::pi<double>() / 180 : step;
    const auto compare = [&](const Vec3<double>& known, const Vec3<double>& a, const Vec3<double>& b) {
      const Vec3<double> difference = (a - b) / (2 * unit);
      constexpr double kTruncation = 1e-3;  // second order of the step: some 1e-4 of the derivative
      EXPECT_LT(norm(Vec3<double>(difference - known)), kTruncation * norm(difference));
    };
    compare(derivative.axis_L, n_more, n_less), compare(derivative.tip_L_m, p_more, p_less);
  };
  central([](ContactSpec& c, double step) { c.friction_coefficient += step; }, 1e-3, early[0]);
  central(
      [](ContactSpec& c, double step) { c.table_tilt_deg = std::abs(step), c.table_tilt_azimuth_deg = step > 0 ? 90 : 270; },
      0.1, early[1]);
}

/// The model's units change nothing.
TEST(ContactUnits, ChangeNoMotion) {
  std::mt19937 engine(10);
  for (const ContactLaw law : testing::kAllLaws) {
    ContactScene scene = random_scene(law, engine);
    scene.gradient = true, scene.earth_rate_rad_s = 0.01;
    scene.contact.spinning_friction_m = 1e-4, scene.contact.rolling_resistance_m = 2e-5, scene.contact.regularisation_rad_s = 3;
    const ContactProblem<double> natural(scene), other(scene, NaturalUnits{-3, -5});
    const auto a = testing::rows_of(natural, natural.system<Observer::laboratory>(), {0.3}, 1e-14)[0];
    const auto b = testing::rows_of(other, other.system<Observer::laboratory>(), {0.3}, 1e-14)[0];
    const double size = norm(Vec3<double>(a.epsilon * a.state.e_v_scaled));
    EXPECT_LT(norm(Vec3<double>(a.epsilon * a.state.e_v_scaled - b.epsilon * b.state.e_v_scaled)), 1e-9 * size);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(a.contact.axis_L[i].rot, b.contact.axis_L[i].rot, 1e-11);
      EXPECT_NEAR(a.contact.tip_L[i].rot, b.contact.tip_L[i].rot, 1e-12);
    }
    EXPECT_NEAR(a.spin_rad_s.rot, b.spin_rad_s.rot, 1e-9);
    const auto in_newton = [](const ContactProblem<double>& p, double force) {
      return real::scale(force, p.units.mass_exponent - 2 * p.units.time_exponent);
    };
    const double N = in_newton(natural, a.contact.reaction.normal_force.rot);
    EXPECT_NEAR(N, in_newton(other, b.contact.reaction.normal_force.rot), 1e-9 * scene.mass_kg * 9.8);
    EXPECT_GT(N, 0);
  }
}

}  // namespace
}  // namespace earthtop
