/// The shipped studies for which a release suite has no time.
#include "collection/study_figures.hpp"

namespace earthtop {
namespace {

class LongerStudy : public ::testing::TestWithParam<std::string> {};

TEST_P(LongerStudy, MeetsItsFigures) { testing::expect_figures_met(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, LongerStudy, ::testing::ValuesIn(testing::shipped_studies(true)),
                         [](const auto& shown) { return testing::test_name(shown.param); });

}  // namespace
}  // namespace earthtop
