// SPDX-License-Identifier: GPL-3.0-or-later
// What runs are promised to take, over many scenes of every kind.
#include <gtest/gtest.h>

#include "work/promises.hpp"

namespace earthtop {
namespace {

TEST(WorkEstimate, HoldsForManyRandomScenes) { testing::expect_promises_kept(40); }

}  // namespace
}  // namespace earthtop
