// SPDX-License-Identifier: GPL-3.0-or-later
/// More random scenes compared with 113-bit arithmetic than the release suite has time for.

#include <gtest/gtest.h>

#include "support/soundness.hpp"

namespace earthtop {
namespace {

class OtherRandomScene : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(OtherRandomScene, DriftAndBoundAgainstExtendedPrecision) { testing::expect_random_scene_sound(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Seeds, OtherRandomScene, ::testing::Range<std::uint64_t>(1008, 1024));

}  // namespace
}  // namespace earthtop
