/// Every shipped study is computed, and its figures are met: its finding is not an opinion. With EARTHTOP_ALL_STUDIES all of
/// them, otherwise those that take less than five seconds.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "earthtop/study/run_study.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

bool is_left_out(const fs::path& file) {
#ifdef EARTHTOP_ALL_STUDIES
  return file.empty();
#else
  return file.stem() == "gyrocompass" || file.stem() == "gyrocompass-settles";
#endif
}

std::vector<std::string> shipped_studies() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(EARTHTOP_SCENARIOS "/studies"))
    if (entry.path().extension() == ".json" && !is_left_out(entry.path())) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class ShippedStudy : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedStudy, MeetsItsFigures) {
  const testing::TemporaryDirectory dir;
  const Study study = parse_study(read_scenario_source(GetParam()));
  EXPECT_FALSE(study.finding.empty());
  ASSERT_FALSE(study.figures.empty());
  StudyRunOptions options;
  options.dir = dir.path();
  options.jobs = 2;
  const StudyRunReport report = run_study(study, options);
  EXPECT_TRUE(report.complete());
  EXPECT_EQ(report.failed, 0U);
  const Json document = Json::parse(study_json(report.store));
  for (const Json& figure : document.at("figures")) EXPECT_TRUE(figure.at("met").get<bool>()) << figure.dump(1);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedStudy, ::testing::ValuesIn(shipped_studies()), [](const auto& shown) {
  std::string name = fs::path(shown.param).stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace earthtop
