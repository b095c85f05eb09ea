// SPDX-License-Identifier: GPL-3.0-or-later
/// The Fourier sums in 113 bits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fourier/fourier_cases.hpp"
#include "integrate/fourier/fourier_top.hpp"

namespace earthtop {
namespace {

using T = float128;

TEST(FourierTopInFloat128, HasAllKnownDigits) {
  const T rate = testing::parsed<T>(testing::kEarthRate);
  for (const testing::FourierCase& c : testing::fourier_cases()) {
    SCOPED_TRACE(c.name);
    const testing::FourierProblem<T> p = testing::problem_of<T>(c, rate);
    const FourierTop<T> top(p.model, p.release);
    ASSERT_EQ(top.refusal(), "");
    for (const testing::FourierCase::At& at : c.drifts) {
      const T known = testing::parsed<T>(at.drift_rad), drift = testing::axis_drift(top.at(T(at.t_s)), rate);
      // Half a unit of the last digit given: 22 to 25 digits.
      const std::string text = at.drift_rad;
      const auto digits = static_cast<double>(text.find('e') - text.find('.') - 1);
      EXPECT_LT(static_cast<double>(real::abs(drift - known) / known), 2 * std::pow(10.0, -digits)) << at.t_s;
    }
  }
}

}  // namespace
}  // namespace earthtop
