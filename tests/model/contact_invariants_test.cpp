// SPDX-License-Identifier: GPL-3.0-or-later
/// The balances of the Jacobi integral, Jellett's and Routh's, and of the ledger about the tip: the derivative of each quantity along the equations of motion,
/// found by pairs, against its rate in closed form. The Earth's rate is of order 1 and gravity does not lie along the normal,
/// except where a statement needs it.
#include "earthtop/model/contact_invariants.hpp"

#include <gtest/gtest.h>

#include "earthtop/model/contact_ledger.hpp"
#include "support/contact_states.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::ContactCase;
using testing::ContactCases;
using testing::ContactVariety;

/// A value with its derivative in time: both predictions have the same value, and differ by the derivative per epsilon.
template <class T>
Vec3<Paired<T>> moving(const Vec3<T>& x, const Vec3<T>& rate) {
  Vec3<Paired<T>> made;
  for (int i = 0; i < 3; ++i) made[i] = {x[i], x[i], rate[i]};
  return made;
}
template <class T>
Vec3<Paired<T>> fixed(const Vec3<T>& x) {
  return moving<T>(x, Vec3<T>::Zero());
}
template <class T>
ContactSurroundings<Paired<T>> fixed(const ContactSurroundings<T>& around) {
  ContactSurroundings<Paired<T>> made{fixed(around.normal), fixed(around.gravity), fixed(around.W), {}};
  for (int j = 0; j < 3; ++j) made.gradient.col(j) = fixed<T>(around.gradient.col(j));
  return made;
}
template <class T>
ReducedContactState<Paired<T>> moving(const ReducedContactState<T>& x, const ReducedContactRates<T>& rates) {
  return {
      moving(x.n, rates.n), moving(x.u, rates.u), {x.w3, x.w3, rates.w3}, moving(x.v_P, rates.v_P), moving(x.p_O, rates.p_O)};
}
template <class T>
GeneralContactState<Paired<T>> moving(const GeneralContactState<T>& x, const GeneralContactRates<T>& rates) {
  GeneralContactState<Paired<T>> made{
      {}, moving(x.momentum, rates.momentum), moving(x.v_P, rates.v_P), moving(x.p_O, rates.p_O)};
  for (int j = 0; j < 3; ++j) made.R_HB.col(j) = moving<T>(x.R_HB.col(j), rates.w.cross(Vec3<T>(x.R_HB.col(j))));
  return made;
}

/// Rates are sums of terms up to m g v ~ 1e3 and I w^3 ~ 1e4; the round-off of the accelerations enters times w.
template <class T>
void expect_equal(T a, T b, T size, const char* what) {
  EXPECT_LT(static_cast<double>(real::abs(T(a - b)) / size), 1e4 * static_cast<double>(real::epsilon<T>()))
      << what << ": " << static_cast<double>(a) << " and " << static_cast<double>(b);
}

template <class T>
void expect_balances(const ContactCase<T>& c, const ContactVariety& variety) {
  const auto both = paired(c.contact);
  const auto around = fixed(c.around);
  const GeneralContactState<T> g = c.general();
  const GeneralContactRates<T> general = general_rates(c.contact, c.around, g);
  const ContactJacobi<Paired<T>> J = contact_jacobi(both, around, moving(g, general));
  const T size = (J.kinetic.ref + real::abs(J.potential.ref)) * T(20);
  expect_equal(J.value.diff, jacobi_rate(general.reaction, c.v_P, c.w), size, "J of any body");
  if (!variety.symmetric) return;

  const ReducedContactState<T> x = c.reduced();
  const ReducedContactRates<T> reduced = reduced_rates(c.contact, c.around, x);
  const ReducedContactState<Paired<T>> on_its_way = moving(x, reduced);
  const ContactJacobi<Paired<T>> J_top = contact_jacobi(both, around, on_its_way);
  expect_equal(J_top.value.ref, J.value.ref, size, "J in both forms");
  expect_equal(J_top.value.diff, jacobi_rate(reduced.reaction, c.v_P, c.w), size, "J of a top");
  expect_equal(jellett(both, around, on_its_way).diff, jellett_rate(c.contact, c.around, x, reduced.reaction), size, "lambda");
  const bool has_moment = variety.moments || variety.law == ContactLaw::contensou;
  if (variety.point_tip && !has_moment) expect_equal(reduced.w3, T(0), T(1), "spin on a point");
}

/// The ledger's torques about the moving tip sum up to the derivative of the momentum about it, with any weights and gradient.
template <class T>
void expect_ledger_is_complete(const ContactCase<T>& c) {
  const GeneralContactState<T> g = c.general();
  const GeneralContactRates<T> rates = general_rates(c.contact, c.around, g);
  const GeneralContactState<Paired<T>> on_its_way = moving(g, rates);
  const Vec3<Paired<T>> L_O = momentum_about_tip(paired(c.contact), on_its_way.R_HB, moving(rates.w, rates.w_dot));
  const Vec3<T> sum = contact_ledger(c.contact, c.around, g, rates).sum();
  for (int i = 0; i < 3; ++i) expect_equal(L_O[i].diff, sum[i], T(1e3), "momentum about the tip");
}

class ContactBalancesOfLaws : public ::testing::TestWithParam<ContactLaw> {};

TEST_P(ContactBalancesOfLaws, HoldOnTheRotatingEarth) {
  ContactCases cases(7);
  for (ContactVariety variety : testing::varieties(GetParam())) {
    if (variety.weights || variety.gradient) continue;  // they belong to no conserved quantity
    for (int i = 0; i < 5; ++i) expect_balances(cases.make<double>(variety), variety);
    expect_balances(cases.make<float128>(variety), variety);
  }
}
TEST_P(ContactBalancesOfLaws, OfTheLedgerIsComplete) {
  ContactCases cases(8);
  for (const ContactVariety& variety : testing::varieties(GetParam())) {
    for (int i = 0; i < 5; ++i) expect_ledger_is_complete(cases.make<double>(variety));
    expect_ledger_is_complete(cases.make<float128>(variety));
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, ContactBalancesOfLaws, ::testing::ValuesIn(testing::kLaws));

/// Jellett's rate has a part from the Earth and one from friction's moment: each is seen.
TEST(ContactInvariants, JellettMovesByTheEarthAndByMomentsOnly) {
  ContactCases cases(11);
  ContactCase<double> c = cases.make<double>({ContactLaw::coulomb});
  const auto rate = [&] {
    const auto x = c.reduced();
    const auto rates = reduced_rates(c.contact, c.around, x);
    return jellett(paired(c.contact), fixed(c.around), moving(x, rates)).diff;
  };
  EXPECT_GT(std::abs(rate()), 1e-3);
  c.around.W.setZero();
  EXPECT_NEAR(rate(), 0, testing::rounding(200));
  c.contact.has_spinning_friction = true;
  EXPECT_GT(std::abs(rate()), 1e-3);
}

/// Routh's integral belongs to rolling alone, on a level table, without the Earth and without moments.
TEST(ContactInvariants, RouthIsConstantForPureRollingOnly) {
  ContactCases cases(13);
  const auto rate = [](const auto& c) {
    const auto x = c.reduced();
    return routh(paired(c.contact), fixed(c.around), moving(x, reduced_rates(c.contact, c.around, x)));
  };
  for (int i = 0; i < 20; ++i) {
    ContactCase<double> c = cases.make<double>({ContactLaw::rolling});
    EXPECT_GT(std::abs(rate(c).diff), 1e-4) << "with the Earth";
    c.around.W.setZero();
    EXPECT_GT(std::abs(rate(c).diff), 1e-4) << "on a slope";
    c.around.gravity = Vec3<double>(0, 0, -5);
    const auto integral = rate(c);
    EXPECT_LT(std::abs(integral.diff), testing::rounding(500) * std::abs(integral.ref));
    c.contact.has_rolling_resistance = true;
    EXPECT_GT(std::abs(rate(c).diff), 1e-6) << "with a moment";
  }
  ContactCase<double> sliding = cases.make<double>({ContactLaw::viscous});
  sliding.around.W.setZero();
  sliding.around.gravity = Vec3<double>(0, 0, -5);
  EXPECT_GT(std::abs(rate(sliding).diff), 1e-4);
}

}  // namespace
}  // namespace earthtop
