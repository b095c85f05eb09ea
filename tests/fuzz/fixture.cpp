// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/fixture.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "earthtop/bench/bench.hpp"
#include "earthtop/bench/comparison.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/plan/plan.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/study/run_study.hpp"
#include "fuzz/properties.hpp"
#include "hostile/kinds.hpp"
#include "results/seal.hpp"
#include "study/design.hpp"
#include "study/store.hpp"
#include "text/checksum.hpp"
#include "text/json.hpp"

namespace earthtop::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScenario = R"({"name": "top", "title": "A top", "site": {"latitude_deg": 45},
 "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": {"principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
 "release": {"tilt_deg": 20, "azimuth_deg": 90, "spin_rad_s": 200}, "motion": {"duration_s": 0.5, "output_step_s": 0.1},
 "uncertainty": {"spin_rad_s": 0.1}, "numerics": {"ledger": "laboratory"}})";

constexpr const char* kMoreOfTheStudy = R"(, "name": "few", "title": "A study", "finding": "It is one",
 "collect": ["drift.axis_final_rad", "drift.verdict"],
 "axes": [{"name": "tilt", "pointer": "/release/tilt_deg", "values": [10, 20, 30, 200]}],
 "fits": [{"kind": "linear", "axis": "tilt", "quantity": "drift.axis_final_rad"}],
 "figures": [{"figure": "/points_failed", "value": 1, "tolerance": 0.5, "origin": "counted"}]})";

ResultFiles files_in(const fs::path& results) {
  return {unsealed(content_of(results / "summary.json")), content_of(results / "trajectory.csv"),
          content_of(results / "torques.csv"), unsealed(content_of(results / "timing.json"))};
}

std::string study_text() { return std::string(R"({"base": )") + kScenario + kMoreOfTheStudy; }

constexpr const char* kMeasured =
    "t_s,azimuth_deg,azimuth_se_deg,tilt_deg,tilt_se_deg\n0.1,89.9,0.1,20.1,0.1\n0.3,89.5,0.1,,\n0.5,88.8,0.1,20.0,0.1\n";

}  // namespace

const Fixture& Fixture::get() {
  static const Fixture fixture;
  return fixture;
}

Fixture::Fixture() {
  write_results(run(parse_scenario(scenario())), results(), false);
  StudyRunOptions options;
  options.dir = directory_.path() / "study";
  options.jobs = 1;
  run_study(study(), options);
}

ScenarioSource Fixture::scenario() const { return {"top.json", kScenario, false}; }
Study Fixture::study() const { return parse_study({"few.json", study_text()}); }
fs::path Fixture::store() const { return study_store(directory_.path() / "study"); }
std::string Fixture::content(const fs::path& name) const { return content_of(directory_.path() / name); }

ResultFiles Fixture::result_files() const { return files_in(results()); }

std::string Fixture::reference() const {
  const fs::path file = directory_.path() / "reference.json";
  update_reference(file, results(), "a seed");
  return unsealed(content_of(file));
}

std::string Fixture::comparison() const {
  const testing::TemporaryDirectory other;
  write_results(run(parse_scenario(scenario(), {{"/site/latitude_deg", "45.1"}})), other.path() / "new", false);
  CompareOptions options;
  options.with_curves = true;
  CompareReport report = compare_results(results(), other.path() / "new", options);
  constexpr std::size_t kFew = 6;
  for (PairReport& pair : report.pairs) pair.quantities.resize(std::min(pair.quantities.size(), kFew));
  return comparison_json(report);
}

std::string Fixture::bench() const {
  BenchReport report;
  report.scenario = "top";
  report.title = "A top";
  report.duration_s = 1;
  report.reference = {{}, "long_double", "another method", {1e-17, 1e-17, 1e-18}};
  report.largest_drift = 1e-5;
  for (int k = 0; k < 3; ++k) {
    BenchEntry entry;
    entry.contender.options.relative_tolerance = k == 0 ? 1e-6 : 1e-12;
    entry.status = k == 2 ? RunStatus::interrupted : RunStatus::completed;
    entry.errors = {1e-9 / (k + 1), 2e-9, 3e-12};
    entry.seconds = entry.seconds_least = entry.seconds_most = 1e-3 * (k + 1);
    entry.repetitions = 3;
    report.entries.push_back(entry);
  }
  return bench_json(std::vector<BenchReport>{report});
}

std::string Fixture::measurement() const {
  MeasurementOptions options;
  options.estimates = {"spin_rad_s", "tilt_deg"};
  options.priors = true;
  options.curve_points = 5;
  return measurement_json(compare_with_measurement(scenario(), {}, parse_measurement("m.csv", kMeasured), options));
}

std::string Fixture::releases() const {
  MeasurementOptions options;
  options.estimates = {"spin_rad_s"};
  options.shared = {"tilt_deg"};
  options.curve_points = 5;
  const MeasuredRelease release{scenario(), {}, parse_measurement("m.csv", kMeasured)};
  return releases_json(compare_releases({release, release}, options));
}

std::string Fixture::plan() const {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("azimuth_deg", 0.1)};
  plan.every_s = 0.1;
  plan.until_s = 0.5;
  plan.estimates = {"spin_rad_s"};
  return plan_json(plan_measurement(scenario(), {}, plan));
}

std::string input_of(const ResultFiles& files) {
  return joined({files.summary, files.trajectory, files.torques, files.timing});
}

ResultFiles result_files_in(std::string_view input) {
  auto parts = parts_of(input);
  parts.resize(4);
  return {parts[0], parts[1], parts[2], parts[3]};
}

void put(const ResultFiles& files, const fs::path& directory) {
  fs::create_directories(directory);
  const auto write = [&](const char* name, const std::string& text) {
    if (!text.empty()) std::ofstream(directory / name, std::ios::binary) << text;
  };
  write("summary.json", files.summary), write("trajectory.csv", files.trajectory);
  write("torques.csv", files.torques), write("timing.json", files.timing);
}

ResultFiles with_checksums(ResultFiles files) {
  const auto can_have_one = [](const std::string& document) { return document.ends_with("\n}\n"); };
  FileChecksums checksums;
  for (const auto& [name, text] : {std::pair("trajectory.csv", &files.trajectory), std::pair("torques.csv", &files.torques)})
    if (!text->empty()) checksums.emplace_back(name, checksum_text(checksum_of(*text)));
  if (can_have_one(files.summary)) files.summary = sealed(unsealed(files.summary), checksums);
  if (can_have_one(files.timing)) files.timing = sealed(unsealed(files.timing));
  return files;
}

ResultFiles results_of(const ScenarioSource& scenario, const Sets& sets) {
  const testing::TemporaryDirectory directory;
  write_results(run(parse_scenario(scenario, sets)), directory.path() / "results", false);
  return files_in(directory.path() / "results");
}

std::vector<ResultFiles> results_of_many_kinds() {
  const std::vector<std::pair<std::string, Sets>> runs = {
      {"hard/k12-toy-top-stops.json", {}},
      {"hard/k12-tippe-top-stops.json", {}},
      {"dzhanibekov.json", {{"/motion/output_step_s", "10"}}},
      {"hard/h09-homoclinic.json", {{"/report/threshold_rad", "1e-6"}}},
      {"ship-gyrocompass-turns.json", {{"/motion/duration_s", "20"}}},
      {"toy-top.json",
       {{"/motion/duration_s", "0.02"}, {"/motion/output_step_s", "0.01"}, {"/numerics/precision", "float128"}}}};
  std::vector<ResultFiles> kinds;
  for (const auto& [file, sets] : runs) kinds.push_back(results_of({file, shipped(file), false}, sets));
  return kinds;
}

std::vector<std::string> stores_of_many_kinds() {
  // Axes over words, several pointers and ranges; every design and kind of fit; and, last, more points than a page shows singly.
  const std::vector<std::string> studies = {
      R"("axes": [{"name": "rates", "pointer": "/release/rates_relative_to", "values": ["laboratory", "inertial"]},
 {"name": "spin", "pointer": "/release/spin_rad_s", "log_range": {"from": 50, "to": 800, "points": 3}}])",
      R"("axes": [{"name": "two", "pointers": ["/release/tilt_deg", "/release/azimuth_deg"], "values": [[1, 2], [3, 4], 5]}],
 "design": {"kind": "one_at_a_time"}, "fits": [{"kind": "power_law", "axis": "two", "quantity": "a"}])",
      R"("axes": [{"name": "latitude", "pointer": "/site/latitude_deg", "range": {"from": -90, "to": 90, "points": 5}}], "fits":
 [{"kind": "sin_latitude", "axis": "latitude", "quantity": "a"}, {"kind": "cos_latitude", "axis": "latitude", "quantity": "a"}])",
      R"("axes": [{"name": "spin", "pointer": "/release/spin_rad_s", "log_range": {"from": 50, "to": 800}}], "design":
 {"kind": "random", "points": 8}, "fits": [{"kind": "logarithmic", "axis": "spin", "quantity": "a"}])",
      R"("axes": [{"name": "spin", "pointer": "/release/spin_rad_s", "range": {"from": 50, "to": 800}}, {"name": "tilt",
 "pointer": "/release/tilt_deg", "values": [10, 20, 30]}], "design": {"kind": "latin_hypercube", "points": 8, "seed": 3})",
      R"("axes": [{"name": "spin", "pointer": "/release/spin_rad_s", "range": {"from": 50, "to": 800}}, {"name": "tilt",
 "pointer": "/release/tilt_deg", "range": {"from": 1, "to": 30}}], "design": {"kind": "sobol", "points": 4, "indices": true})",
      R"("axes": [{"name": "spin", "pointer": "/release/spin_rad_s", "range": {"from": 50, "to": 800, "points": 501}}, {"name": "tilt",
 "pointer": "/release/tilt_deg", "values": [1, 2]}])"};
  std::vector<std::string> stores;
  for (const std::string& part : studies) {
    const Study study =
        parse_study({"many.json", std::string(R"({"base": )") + kScenario +
                                      R"(, "title": "A study", "collect": [{"name": "a", "path": "drift.axis_final_rad"},
 {"name": "bound", "path": "drift.axis_bound_rad"}, {"name": "verdict", "path": "drift.verdict"}], )" +
                                      part + "}"});
    const testing::TemporaryDirectory directory;
    const fs::path file = directory.path() / "study.sqlite";
    study::Store store = study::Store::create(file, study, {});
    study::Design design(study);
    store.begin();
    for (std::uint64_t number = 0; number < *point_count(study); ++number) {
      study::PointResult point{number, {}, "completed", "", "", {1e-6 * static_cast<double>(number + 1), 1e-12, "trusted"}};
      const study::PlannedPoint planned = design.point(number);
      for (std::size_t i = 0; i < study.axes.size(); ++i)
        point.axis_values.push_back(axis_value(study.axes[i], planned.settings[i]));
      store.insert(point);
    }
    store.commit();
    store.finish();
    stores.push_back(content_of(file));
  }
  return stores;
}

std::string shipped(const std::string& path) { return content_of(fs::path(EARTHTOP_SCENARIOS) / path); }

std::vector<std::string> shipped_in(const std::string& directory) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(EARTHTOP_SCENARIOS) / directory))
    if (entry.path().extension() == ".json") paths.push_back((fs::path(directory) / entry.path().filename()).string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> hostile_texts() {
  std::vector<std::string> texts;
  constexpr std::size_t kLargest = 4096;  // the larger ones are about limits of size
  for (const auto& kinds : {hostile_test::refused_kinds(), hostile_test::accepted_kinds(), hostile_test::either_kinds()})
    for (const hostile_test::Kind& kind : kinds)
      if (kind.text.size() <= kLargest) texts.push_back(kind.text);
  return texts;
}

}  // namespace earthtop::fuzz
