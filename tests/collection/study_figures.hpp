/// Shipped studies and whether what they compute meets their figures: a study's finding is not an opinion.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "earthtop/study/run_study.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::testing {

/// The names of the shipped studies, all in all: those that take less than five seconds, and those that take longer.
inline std::vector<std::string> shipped_studies(bool longer) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS "/studies")) {
    const std::string name = entry.path().stem().string();
    const bool takes_longer = name == "gyrocompass" || name == "gyrocompass-settles";
    if (entry.path().extension() == ".json" && takes_longer == longer) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

inline std::string test_name(std::string study) {
  std::replace(study.begin(), study.end(), '-', '_');
  return study;
}

inline void expect_figures_met(const std::string& name) {
  const TemporaryDirectory dir;
  const Study study = parse_study(read_scenario_source(EARTHTOP_SCENARIOS "/studies/" + name + ".json"));
  EXPECT_FALSE(study.finding.empty());
  ASSERT_FALSE(study.figures.empty());
  StudyRunOptions options;
  options.dir = dir.path();
  options.jobs = 2;
  const StudyRunReport report = run_study(study, options);
  EXPECT_TRUE(report.complete());
  EXPECT_EQ(report.failed, 0U);
  const nlohmann::json document = nlohmann::json::parse(study_json(report.store));
  for (const nlohmann::json& figure : document.at("figures")) EXPECT_TRUE(figure.at("met").get<bool>()) << figure.dump(1);
}

}  // namespace earthtop::testing
