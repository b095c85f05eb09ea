// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks that the shipped studies which take seconds meet their figures.
#include "collection/study_figures.hpp"

namespace earthtop {
namespace {

class LongerStudy : public ::testing::TestWithParam<std::string> {};

TEST_P(LongerStudy, MeetsItsFigures) { testing::expect_figures_met(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, LongerStudy, ::testing::ValuesIn(testing::shipped_studies(testing::StudyLength::seconds)),
                         [](const auto& shown) { return testing::test_name(shown.param); });

}  // namespace
}  // namespace earthtop
