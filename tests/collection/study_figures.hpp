// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes shipped studies and checks that they meet their figures.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "earthtop/study/run_study.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::testing {

/// How long a study takes on one core. Those not listed here take less than two seconds.
enum class StudyLength { moments, seconds, minutes };

inline StudyLength length_of(const std::string& study) {
  for (const char* name : {"gyrocompass", "gyrocompass-settles"})
    if (study == name) return StudyLength::minutes;
  for (const char* name : {"bearing-friction", "bob-spin", "lecture-gyro-sensitivity", "matching-rule", "platform-resonance",
                           "precession-axis", "torques-apart"})
    if (study == name) return StudyLength::seconds;
  return StudyLength::moments;
}

/// The names of the shipped studies of this length; every study has exactly one.
inline std::vector<std::string> shipped_studies(StudyLength length) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS "/studies")) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".json" && length_of(name) == length) names.push_back(name);
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
  const nlohmann::json document = parse_json(study_json(report.store));
  for (const nlohmann::json& figure : document.at("figures")) EXPECT_TRUE(figure.at("met").get<bool>()) << text_of(figure);
}

}  // namespace earthtop::testing
