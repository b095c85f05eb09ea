// SPDX-License-Identifier: GPL-3.0-or-later
/// Tops on a table in 113 bits against all printed digits of their references but the last two: two tops, or with the slow tests
/// all.
#include <gtest/gtest.h>

#include "support/contact_references.hpp"

namespace earthtop {
namespace {

using testing::ContactReference;
using testing::Errors;

class ContactReferencesInQuad : public ::testing::TestWithParam<ContactReference> {};

TEST_P(ContactReferencesInQuad, AreMetToThePrintedDigits) {
  const Errors errors = testing::errors_of<float128, Observer::laboratory>(GetParam(), 1e-25);
  EXPECT_LT(std::max(errors.motion, errors.motion_in_inversion), 1e-18);  // 20 digits are printed
  EXPECT_LT(std::max(errors.drift, errors.drift_in_inversion), 1e-15);    // 17
}

std::vector<ContactReference> chosen_references() {
  std::vector<ContactReference> all = testing::contact_references();
#ifndef EARTHTOP_EVERY_SCALAR
  std::erase_if(all, [](const ContactReference& r) { return r.name[1] != '6' && r.name[1] != '8'; });
#endif
  return all;
}
INSTANTIATE_TEST_SUITE_P(K, ContactReferencesInQuad, ::testing::ValuesIn(chosen_references()),
                         [](const auto& chosen) { return std::string(chosen.param.name, 2); });

}  // namespace
}  // namespace earthtop
