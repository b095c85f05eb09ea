// SPDX-License-Identifier: GPL-3.0-or-later
// The estimated work of runs, over many scenes of every kind.
#include <gtest/gtest.h>

#include "work/estimated_work.hpp"

namespace earthtop {
namespace {

TEST(WorkEstimate, HoldsForManyRandomScenes) { testing::expect_work_as_estimated(40); }

}  // namespace
}  // namespace earthtop
