// SPDX-License-Identifier: GPL-3.0-or-later
// Computes a study of four points on the given scenario, in the given directory.
#include <cstdio>
#include <earthtop/study/run_study.hpp>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string text = R"({ "$schema": "earthtop-study-1.json", "name": "latitudes",
    "base": ")" + std::string(argv[1]) +
                           R"(", "set": { "/motion/duration_s": 0.1 },
    "axes": [ { "name": "latitude_deg", "pointer": "/site/latitude_deg", "values": [-90, 0, 45, 90] } ],
    "collect": ["drift.axis_final_rad"] })";
  const auto study = earthtop::parse_study({"latitudes.json", text});
  earthtop::StudyRunOptions options;
  options.dir = argv[2];
  const earthtop::StudyRunReport report = earthtop::run_study(study, options);
  std::printf("%s: %llu points\n", study.name.c_str(), static_cast<unsigned long long>(report.progress.done));
  return report.progress.done == 4 && report.failed == 0 ? 0 : 1;
}
