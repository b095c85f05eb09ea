// SPDX-License-Identifier: GPL-3.0-or-later
/// Tops on a table against reference values of 15 to 20 digits, in the laboratory's equations and in those of inertial axes.
#include "support/contact_references.hpp"

#include <gtest/gtest.h>

namespace earthtop {
namespace {

using testing::ContactReference;
using testing::Errors;
using testing::errors_of;

class ContactReferences : public ::testing::TestWithParam<ContactReference> {};

template <Observer O>
void expect_reference(const ContactReference& reference) {
  const Errors errors = errors_of<double, O>(reference, 1e-14);
  EXPECT_LT(errors.motion, 1e-11);
  EXPECT_LT(errors.motion_in_inversion, 1e-9);
  EXPECT_LT(errors.drift, 1e-9);
  EXPECT_LT(errors.drift_in_inversion, 1e-8);
}
TEST_P(ContactReferences, AreMetInLaboratoryAxes) { expect_reference<Observer::laboratory>(GetParam()); }
TEST_P(ContactReferences, AreMetInInertialAxes) { expect_reference<Observer::inertial>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(K, ContactReferences, ::testing::ValuesIn(testing::contact_references()),
                         [](const auto& chosen) { return std::string(chosen.param.name, 2); });

}  // namespace
}  // namespace earthtop
