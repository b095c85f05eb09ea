// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks that the shipped studies which take minutes meet their figures.
#include "collection/study_figures.hpp"

namespace earthtop {
namespace {

class SlowStudy : public ::testing::TestWithParam<std::string> {};

TEST_P(SlowStudy, MeetsItsFigures) { testing::expect_figures_met(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, SlowStudy, ::testing::ValuesIn(testing::shipped_studies(testing::StudyLength::minutes)),
                         [](const auto& shown) { return testing::test_name(shown.param); });

}  // namespace
}  // namespace earthtop
