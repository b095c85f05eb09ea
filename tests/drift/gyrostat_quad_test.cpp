// SPDX-License-Identifier: GPL-3.0-or-later
/// The same in 113 bits, to the digits that the references are printed with.
#include <gtest/gtest.h>

#include "support/gyrostat_references.hpp"

namespace earthtop {
namespace {

class GyrostatInQuad : public ::testing::TestWithParam<Observer> {};

TEST_P(GyrostatInQuad, MeetsItsReferences) {
  for (const nlohmann::json& reference : testing::gyrostat_references().at("cases")) {
    const testing::GyrostatErrors errors = testing::gyrostat_errors<float128>(reference, GetParam(), 1e-27);
    EXPECT_LT(errors.motion, 1e-22) << reference.at("name");  // 22 digits are printed
    EXPECT_LT(errors.drift, 1e-23) << reference.at("name");   // of 20 digits of some 1e-4
  }
}

INSTANTIATE_TEST_SUITE_P(Observers, GyrostatInQuad, ::testing::Values(Observer::laboratory, Observer::body, Observer::inertial),
                         [](const auto& chosen) { return std::string(to_string(chosen.param)); });

}  // namespace
}  // namespace earthtop
