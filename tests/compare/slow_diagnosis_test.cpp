// SPDX-License-Identifier: GPL-3.0-or-later
/// What a comparison says of a hundred right files, and of a hundred with two mistakes.
#include <gtest/gtest.h>

#include "compare/mistaken_files.hpp"

namespace earthtop {
namespace {

TEST(SlowDiagnosis, NamesNothingOfAHundredRightFiles) { mistaken::expect_nothing_of_right_files(100); }
TEST(SlowDiagnosis, NamesBothOfTwoMistakesOrNoneInAHundredFiles) { mistaken::expect_both_of_two_mistakes(100); }

}  // namespace
}  // namespace earthtop
