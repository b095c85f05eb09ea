// SPDX-License-Identifier: GPL-3.0-or-later
/// The same in 113 bits, to the digits that the references are printed with.
#include <gtest/gtest.h>

#include "support/gimbal_references.hpp"

namespace earthtop {
namespace {

TEST(SuspensionInQuad, MeetsItsReferences) {
  for (const nlohmann::json& reference : testing::gimbal_references().at("cases")) {
    const testing::GimbalErrors errors = testing::gimbal_errors<float128>(reference, Observer::laboratory, 1e-27);
    EXPECT_LT(errors.motion, 1e-22) << reference.at("name");  // 22 digits are printed
    EXPECT_LT(errors.drift, 1e-21) << reference.at("name");   // of 20 digits of 0.1 rad; of the others 1e-24
  }
}

}  // namespace
}  // namespace earthtop
