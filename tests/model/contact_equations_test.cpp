// SPDX-License-Identifier: GPL-3.0-or-later
/// Three formulations of a top on a table against each other: any body in the laboratory with [F]'s torques, the symmetric top
/// without its spin, and inertial axes, where no Coriolis term appears and the table's plane turns. They share the friction laws
/// and nothing else.
#include <gtest/gtest.h>

#include <tuple>

#include "earthtop/model/inertial_contact.hpp"
#include "support/contact_states.hpp"

namespace earthtop {
namespace {

using testing::ContactCase;
using testing::ContactCases;
using testing::ContactVariety;

/// Accelerations are sums of some tens of terms of sizes up to w^2 r m r / I ~ 1e3, and the matrices' condition is below 1e2.
template <class T>
T tolerance() {
  return T(1e6) * real::epsilon<T>();
}

template <class T>
void expect_near(const Vec3<T>& a, const Vec3<T>& b, const char* what) {
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(static_cast<double>(real::abs(T(a[i] - b[i]))), static_cast<double>(tolerance<T>()))
        << what << ' ' << i << ": " << static_cast<double>(a[i]) << " and " << static_cast<double>(b[i]);
}
template <class T>
void expect_same_reaction(const ContactReaction<T>& a, const ContactReaction<T>& b, const Mat3<T>& R, const char* what) {
  expect_near<T>(Vec3<T>(a.normal_force, T(0), T(0)), Vec3<T>(b.normal_force, T(0), T(0)), what);
  expect_near<T>(times(R, a.friction), b.friction, what);
  expect_near<T>(times(R, a.moment), b.moment, what);
}

/// The case as axes N see it at a time t.
template <class T>
struct SeenFromInertialAxes {
  Mat3<T> R_NH;
  ContactSurroundings<T> around;
  InertialContactState<T> state;
  InertialContactBody<T> body;

  SeenFromInertialAxes(const ContactCase<T>& c, T t) {
    const Vec3<T>& W = c.around.W;
    const T rate = norm(W);
    R_NH = turn_matrix(Vec3<T>(W / rate), T(rate * t));
    around = {times(R_NH, c.around.normal), times(R_NH, c.around.gravity), W, turned_tensor(R_NH, c.around.gradient)};
    const Mat3<T> R_NB = R_NH * c.R_HB;
    const Vec3<T> w_IB = times<T>(R_NH, c.w + W);
    state = {times<T>(R_NH, c.p_O + times(c.R_HB, c.contact.p_OC_B)), times(R_NH, c.v_P), w_IB};
    body = inertial_body(c.contact, R_NB, times(turned_tensor(R_NB, c.contact.I_BC_B), w_IB));
  }
};

template <class T>
void expect_formulations_agree(const ContactCase<T>& c, const ContactVariety& variety) {
  const Vec3<T>& W = c.around.W;
  const GeneralContactRates<T> general = general_rates(c.contact, c.around, c.general());
  const SeenFromInertialAxes<T> seen(c, T(0.7));
  const Mat3<T>&R = seen.R_NH, identity = Mat3<T>::Identity();
  const InertialContactRates<T> inertial = inertial_rates(c.contact, seen.around, seen.body, seen.state);
  expect_near<T>(times<T>(R, general.w_dot + W.cross(Vec3<T>(c.w + W))), inertial.w_IB, "w_IB, inertial");
  expect_near<T>(times<T>(R, general.v_P + W.cross(c.v_P)), inertial.v_P, "slip, inertial");
  const Vec3<T> L_C = times<T>(turned_tensor(c.R_HB, c.contact.I_BC_B), c.w + W),
                d_w = general.w_dot + W.cross(Vec3<T>(c.w + W));
  expect_near<T>(times<T>(R, times(turned_tensor(c.R_HB, c.contact.I_BC_B), d_w) + Vec3<T>(c.w + W).cross(L_C)),
                 inertial.momentum, "L_C, inertial");
  const Vec3<T> r_c = times(c.R_HB, c.contact.p_OC_B);
  expect_near<T>(times<T>(R, general.p_O + c.w.cross(r_c) + W.cross(Vec3<T>(c.p_O + r_c))), inertial.X_C, "V_C, inertial");
  expect_same_reaction<T>(general.reaction, inertial.reaction, R, "reaction, inertial");
  EXPECT_EQ(general.v_P[2], T(0));
  if (!variety.symmetric) return;

  const ReducedContactState<T> x = c.reduced();
  const ReducedContactRates<T> reduced = reduced_rates(c.contact, c.around, x);
  expect_near<T>(c.w.cross(x.n), reduced.n, "n, reduced");
  expect_near<T>(general.w_dot, Vec3<T>(reduced.u + reduced.w3 * x.n + x.w3 * reduced.n), "w, reduced");
  expect_near<T>(general.v_P, reduced.v_P, "slip, reduced");
  expect_near<T>(general.p_O, reduced.p_O, "p_O, reduced");
  expect_same_reaction<T>(general.reaction, reduced.reaction, identity, "reaction, reduced");
  // u stays normal to n: the derivative of u.n is 0.
  EXPECT_LT(static_cast<double>(real::abs(T(inner(reduced.u, x.n) + inner(x.u, reduced.n)))),
            static_cast<double>(tolerance<T>()));
  // The symmetric body of the inertial form is the same body.
  const Vec3<T> n = times(R, x.n), u = times(R, x.u);
  const InertialContactRates<T> of_axis =
      inertial_rates(c.contact, seen.around, inertial_body(c.contact, n, u, x.w3), seen.state);
  expect_near<T>(of_axis.w_IB, inertial.w_IB, "symmetric body in inertial axes");
}

class ContactFormulations : public ::testing::TestWithParam<ContactLaw> {};

TEST_P(ContactFormulations, AgreeAtEarthRatesOfOrderOne) {
  ContactCases cases(2026);
  for (const ContactVariety& variety : testing::varieties(GetParam())) {
    SCOPED_TRACE(::testing::Message() << "moments " << variety.moments << ", weights " << variety.weights << ", gradient "
                                      << variety.gradient << ", symmetric " << variety.symmetric << ", point "
                                      << variety.point_tip);
    for (int i = 0; i < 3; ++i) expect_formulations_agree(cases.make<double>(variety), variety);
    expect_formulations_agree(cases.make<float128>(variety), variety);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ContactFormulations, ::testing::ValuesIn(testing::kLaws));

}  // namespace
}  // namespace earthtop
