// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies in which a rotor turns, against references of 20 digits, in the equations of three observers.
#include <gtest/gtest.h>

#include "support/gyrostat_references.hpp"

namespace earthtop {
namespace {

using testing::GyrostatErrors;

class Gyrostat : public ::testing::TestWithParam<Observer> {};

TEST_P(Gyrostat, MeetsItsReferences) {
  for (const nlohmann::json& reference : testing::gyrostat_references().at("cases")) {
    const GyrostatErrors errors = testing::gyrostat_errors<double>(reference, GetParam(), 1e-14);
    // What a run in double promises: 1e-11 of a motion, 1e-9 of the drift, which is 1e-12 of a thousandth of it.
    EXPECT_LT(errors.motion, 1e-11) << reference.at("name");
    EXPECT_LT(errors.relative_drift, 1e-9) << reference.at("name");  // see above
  }
}

INSTANTIATE_TEST_SUITE_P(Observers, Gyrostat, ::testing::Values(Observer::laboratory, Observer::body, Observer::inertial),
                         [](const auto& chosen) { return std::string(to_string(chosen.param)); });

}  // namespace
}  // namespace earthtop
