// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/reference.hpp"
#include "earthtop/study/study.hpp"
#include "results/figures.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

const std::string kToyTop = std::string(EARTHTOP_SCENARIOS) + "/toy-top.json";

std::string file(const std::string& members) { return "{\"base\": \"" + kToyTop + "\", " + members + "}"; }
const std::string kAxis = R"("axes": [{"pointer": "/site/latitude_deg", "values": [0, 45]}])";

std::vector<Diagnostic> errors(const std::string& text) {
  try {
    parse_study({"study.json", text});
  } catch (const ScenarioError& error) {
    return error.diagnostics();
  }
  return {};
}

TEST(StudyFile, DefaultsAreThoseOfTheTable) {
  const Study study = parse_study({"dir/some-study.json", file(kAxis)});
  EXPECT_EQ(study.name, "some-study");
  EXPECT_EQ(study.design.kind, DesignKind::grid);
  ASSERT_EQ(study.axes.size(), 1U);
  EXPECT_EQ(study.axes[0].name, "latitude_deg");
  EXPECT_EQ(study.axes[0].levels, (std::vector<std::vector<std::string>>{{"0.0"}, {"45.0"}}));
  EXPECT_EQ(study.quantities.size(), 5U);
  EXPECT_EQ(study.quantities[0].path, "drift.axis_final_rad");
  EXPECT_EQ(study.limits.points, 10'000'000U);
  EXPECT_TRUE(study.needed_rows_only);
}

TEST(StudyFile, TakesAScenarioInPlaceOfAFile) {
  const Study study = parse_study({"study.json", R"({"base": {"name": "inside", "body": {}}, )" + kAxis + "}"});
  EXPECT_EQ(study.base.text, R"({"name":"inside","body":{}})");
}

struct Fault {
  const char* members;
  const char* pointer;
  const char* says;
};
class StudyFaults : public ::testing::TestWithParam<Fault> {};

TEST_P(StudyFaults, AreRefusedWithPlaceAndRemedy) {
  const Fault& fault = GetParam();
  const auto found = errors(file(fault.members));
  const auto hit = std::find_if(found.begin(), found.end(), [&](const Diagnostic& d) {
    return d.pointer == fault.pointer && d.message.find(fault.says) != std::string::npos;
  });
  EXPECT_NE(hit, found.end()) << fault.members
                              << (found.empty() ? " accepted" : ": " + found.front().pointer + " " + found.front().message);
  if (hit == found.end()) return;
  EXPECT_GT(hit->line, 0);
}

#define AXES "\"axes\": [{\"pointer\": \"/site/latitude_deg\", \"values\": [0, 45]}]"
INSTANTIATE_TEST_SUITE_P(
    All, StudyFaults,
    ::testing::Values(
        Fault{R"("axis": [])", "/axis", "did you mean \"axes\""}, Fault{R"("name": "x")", "/axes", "is missing"},
        Fault{R"("axes": [])", "/axes", "at least one"}, Fault{R"("axes": [{"values": [1]}])", "/axes/0/pointer", "pointer"},
        Fault{R"("axes": [{"pointer": "latitude", "values": [1]}])", "/axes/0/pointer", "not a JSON pointer"},
        Fault{R"("axes": [{"pointer": "/a"}])", "/axes/0/values", "one of values"},
        Fault{R"("axes": [{"pointer": "/a", "values": [1], "range": {"from": 1, "to": 2, "points": 3}}])", "/axes/0/values",
              "one of"},
        Fault{R"("axes": [{"pointer": "/a", "values": []}])", "/axes/0/values", "array of values"},
        Fault{R"("axes": [{"pointer": "/a", "values": 3}])", "/axes/0/values", "array of values"},
        Fault{R"("axes": [{"pointers": ["/a", "/b"], "values": [[1]]}])", "/axes/0/values/0", "one for each pointer"},
        Fault{R"("axes": [{"pointer": "/a", "range": {"from": 1, "to": 2}}])", "/axes/0/range/points", "is missing"},
        Fault{R"("axes": [{"pointer": "/a", "range": {"from": 1, "to": 2, "points": 2.5}}])", "/axes/0/range/points", "whole"},
        Fault{R"("axes": [{"pointer": "/a", "range": {"from": 1, "to": 2, "points": -1}}])", "/axes/0/range/points",
              "out of range"},
        Fault{R"("axes": [{"pointer": "/a", "range": {"from": "x", "to": 2, "points": 2}}])", "/axes/0/range/from",
              "must be a number"},
        Fault{R"("axes": [{"pointer": "/a", "log_range": {"from": -1, "to": 2, "points": 2}}])", "/axes/0/log_range/from",
              "one sign"},
        Fault{R"("axes": [{"pointer": "/a", "log_range": {"from": 0, "to": 2, "points": 2}}])", "/axes/0/log_range/from",
              "one sign"},
        Fault{R"("axes": [{"pointer": "/a", "values": [1]}, {"pointer": "/a", "name": "b", "values": [2]}])", "/axes/1/pointer",
              "twice"},
        Fault{R"("axes": [{"pointer": "/a/x", "values": [1]}, {"pointer": "/b/x", "values": [2]}])", "/axes/1/pointer",
              "column"},
        Fault{R"("axes": [{"pointer": "/a", "name": "status", "values": [1]}])", "/axes/0/name", "column"},
        Fault{R"("axes": [{"pointer": "/a", "name": "A B", "values": [1]}])", "/axes/0/name", "column"},
        Fault{AXES R"(, "design": {"kind": "random"})", "/design/points", "is missing"},
        Fault{AXES R"(, "design": {"kind": "grids"})", "/design/kind", "did you mean \"grid\""},
        Fault{AXES R"(, "design": {"points": 3})", "/design/points", "drawn design"},
        Fault{AXES R"(, "design": {"kind": "latin_hypercube", "points": 3, "indices": true})", "/design/indices", "sobol"},
        Fault{AXES R"(, "design": {"kind": "sobol", "points": 1073741824})", "/design/points",
              "a Sobol sequence has 1073741823 points"},
        Fault{AXES R"(, "collect": [])", "/collect", "array of paths"},
        Fault{AXES R"(, "collect": "drift")", "/collect", "array"},
        Fault{AXES R"(, "collect": [3])", "/collect/0", "must be a path"},
        Fault{AXES R"(, "collect": ["drift.verdict", "drift.verdict"])", "/collect/1", "there is already a column"},
        Fault{AXES R"(, "collect": [{"name": "latitude_deg", "path": "drift.verdict"}])", "/collect/0",
              "there is already a column"},
        Fault{AXES R"(, "fits": [{"kind": "linear", "axis": "x", "quantity": "drift.axis_final_rad"}])", "/fits/0/axis",
              "no axis"},
        Fault{AXES R"(, "fits": [{"kind": "linear", "axis": "latitude_deg", "quantity": "x"}])", "/fits/0/quantity",
              "not collected"},
        Fault{AXES R"(, "set": [])", "/set", "must be an object"},
        Fault{AXES R"(, "set": {"x": 1})", "/set/x", "not a JSON pointer"},
        Fault{AXES R"(, "figures": [{"figure": "/fits/0/b", "value": 1, "tolerance": 0, "origin": ""}])",
              "/figures/0/tolerance", "out of range"},
        Fault{AXES R"(, "limits": {"points": 0})", "/limits/points", "out of range"}));

#define COLLECT(path) AXES ", \"collect\": [{\"name\": \"q\", \"path\": \"" path "\"}]"
#define POINTER(pointer) "\"axes\": [{\"pointer\": \"" pointer "\", \"name\": \"x\", \"values\": [1]}]"
INSTANTIATE_TEST_SUITE_P(
    PointersAndPaths, StudyFaults,
    ::testing::Values(Fault{POINTER("/site/lattitude_deg"), "/axes/0/pointer", "did you mean \"latitude_deg\""},
                      Fault{POINTER("/spin_rad_s"), "/axes/0/pointer", "did you mean \"/release/spin_rad_s\""},
                      Fault{POINTER("/site/latitude_deg/x"), "/axes/0/pointer", "/site/latitude_deg has no members"},
                      Fault{POINTER("/body/center_of_mass_m/3"), "/axes/0/pointer", "0 to 2"},
                      Fault{POINTER("/body/inertia/matrix_kg_m2/0/3"), "/axes/0/pointer", "0 to 2"},
                      Fault{POINTER("/body/solids/first/mass_kg"), "/axes/0/pointer", "not an index"},
                      Fault{POINTER("/body/solids/0/mass"), "/axes/0/pointer", "did you mean \"mass_kg\""},
                      Fault{POINTER("/effects/corolis"), "/axes/0/pointer", "did you mean \"coriolis\""},
                      Fault{POINTER("/site/~2"), "/axes/0/pointer", "not a JSON pointer"},
                      Fault{POINTER("/_note"), "/axes/0/pointer", "comment"},
                      Fault{AXES R"(, "set": {"/motion/duration": 2})", "/set/~1motion~1duration",
                            "did you mean \"duration_s\""},
                      Fault{COLLECT("drift.axis_final"), "/collect/0", "did you mean \"drift.axis_final_rad\""},
                      Fault{COLLECT("method"), "/collect/0", "say which: solution.method, certificate.method"},
                      Fault{COLLECT("drifts.axis_final_rad"), "/collect/0", "did you mean \"drift\""},
                      Fault{COLLECT("drift.verdict.x"), "/collect/0", "drift.verdict has no members"},
                      Fault{COLLECT("motion.axis_final_L.3"), "/collect/0", "0 to 2"},
                      Fault{COLLECT("theory.first.computed"), "/collect/0", "theory is a list"},
                      Fault{COLLECT("drift."), "/collect/0", "in drift"},
                      Fault{COLLECT("scenario.site.latitude"), "/collect/0", "did you mean \"scenario.site.latitude_deg\""}));

TEST(StudyFile, PointersAndPathsThatSomeScenesHaveAreAccepted) {
  for (const char* pointer : {"/body/center_of_mass_m/2", "/body/inertia/matrix_kg_m2/2/2", "/body/solids/7/mass_kg",
                              "/effects/gravity_gradient/gm_over_r3_s2", "/effects", "/release/precession/rate_rad_s",
                              "/platform/pivot_offset_m/0", "/report/threshold_rad", "/criteria/0/values/3", "/title"})
    EXPECT_TRUE(errors(file(std::string(R"("axes": [{"name": "x", "values": [1], "pointer": ")") + pointer + "\"}]")).empty())
        << pointer;
  for (const char* path : {"drift.threshold_time_s",
                           "drift.secular.azimuth_rate_rad_s",
                           "drift.digits.axis_final_rad",
                           "drift",
                           "theory.3.computed",
                           "invariants.0.largest_change",
                           "stops.1.t_s",
                           "ledger.residual_max_N_m",
                           "sensitivities.inputs.6.d_axis_rad",
                           "sensitivities.unavailable",
                           "uncertainty.from_inputs_rad",
                           "selection.switched_on.0",
                           "accuracy.reached_rad",
                           "headline.difference",
                           "motion.axis_final_L.2",
                           "scenario.body.solids.2.mass_kg",
                           "scenario.body.inertia.matrix_kg_m2.2.0",
                           "effects.modelled.4",
                           "scenario.platform.frequency_hz",
                           "scenario.platform.acceleration_rad_s2",
                           "scenario.release.quaternion_LB.w",
                           "scenario.release.tilt_deg",
                           "scenario.effects.tide.tilt_factor",
                           "scenario.numerics.step_s",
                           "scenario.numerics.relative_tolerance",
                           "provenance.constants.1.value"})
    EXPECT_TRUE(errors(file(kAxis + R"(, "collect": [{"name": "q", "path": ")" + path + "\"}]")).empty()) << path;
}

/// Visits every path to a value within a member of a document.
void for_each_path(const nlohmann::json& at, const std::string& path, const std::function<void(const std::string&)>& visit) {
  if (!at.is_structured()) return visit(path);
  std::size_t index = 0;
  for (const auto& item : at.items()) {
    const std::string step = at.is_array() ? std::to_string(index++) : item.key();
    for_each_path(item.value(), path.empty() ? step : path + "." + step, visit);
  }
}

TEST(SummaryPaths, EveryMemberOfAnySummaryIsAccepted) {
  using Sets = std::vector<std::pair<std::string, std::string>>;
  const std::pair<const char*, Sets> scenes[] = {
      {"toy-top", {{"/numerics/precision", "float128"}, {"/numerics/ledger", "body"}, {"/report/threshold_rad", "1e-6"}}},
      {"toy-top", {{"/report/sensitivities", "true"}, {"/release/tilt_deg", "0"}}},
      {"toy-top", {{"/uncertainty/latitude_deg", "0.1"}, {"/accuracy/drift_rad", "1e-6"}, {"/effects", "\"auto\""}}},
      {"turntable",
       {{"/effects/gravity_gradient", "true"},
        {"/effects/polar_motion/x_arcsec", "1"},
        {"/effects/polar_motion/y_arcsec", "0"}}},
      {"free-gyro", {{"/effects/coulomb_torque_N_m", "1e-3"}, {"/effects/air_drag/disc_radius_m", "0.01"}}},
      {"asymmetric-top",
       {{"/effects/tide", R"({"amplitude_m_s2": [0, 0, 1e-6], "frequency_hz": 1})"},
        {"/effects/deflection_of_vertical/north_arcsec", "3"}}},
      {"dzhanibekov", {{"/numerics/method", "closed_form"}}},
      {"foucault-pendulum", {}},
      {"nesc-tumbling-brick", {{"/numerics/method", "rkf78"}, {"/effects/gimbal", "false"}}}};
  for (const auto& [name, sets] : scenes) {
    Sets all = sets;
    all.emplace_back("/motion/duration_s", "0.5");
    const auto scenario = parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS "/") + name + ".json"), all);
    const auto summary = testing::parse_json(summary_json(run(scenario)));
    int paths = 0;
    for_each_path(summary, "", [&, scene = name](const std::string& path) {
      if (path.find("libraries") != std::string::npos) return;  // one of them may have a dot in its name
      ++paths;
      EXPECT_EQ(summary_path_fault(path).value_or(""), "") << scene << " " << path;
    });
    EXPECT_GT(paths, 80) << name;
  }
}

TEST(StudyFile, AllFaultsAreToldAtOnce) {
  EXPECT_EQ(errors(R"({"axes": [{"pointer": "a", "values": [1]}], "design": {"kind": "x"}, "name": "A"})").size(), 4U);
}

TEST(StudyFile, ABaseThatCannotBeReadIsRefused) {
  const auto found = errors(R"({"base": "no-such-file.json", )" + kAxis + "}");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].pointer, "/base");
  EXPECT_NE(found[0].message.find("no such file"), std::string::npos);
}

TEST(StudyFile, DuplicateKeysAndNaNAreRefused) {
  EXPECT_EQ(errors(file(kAxis + "," + kAxis)).size(), 1U);
  EXPECT_FALSE(errors(file(R"("axes": [{"pointer": "/a", "values": [NaN]}])")).empty());
}

TEST(StudyLimits, CountBeforeAnythingIsBuilt) {
  const auto refusal = [](const std::string& members) -> std::string {
    try {
      require_affordable(parse_study({"study.json", file(members)}));
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "";
  };
  const std::string huge = R"("range": {"from": 0, "to": 1, "points": 1000000000})";
  EXPECT_NE(
      refusal(R"("axes": [{"pointer": "/site/latitude_deg", )" + huge + R"(}, {"pointer": "/site/height_m", )" + huge + "}]")
          .find("more than 9e15 points"),
      std::string::npos);
  EXPECT_NE(refusal(kAxis + R"(, "limits": {"points": 1})").find("2 points"), std::string::npos);
  EXPECT_NE(
      refusal(kAxis + R"(, "set": {"/motion/duration_s": 600}, "limits": {"core_hours": 1e-6})").find("hours on one core"),
      std::string::npos);
  EXPECT_NE(refusal(kAxis + R"(, "limits": {"disk_gb": 1e-9})").find("GB"), std::string::npos);
  EXPECT_EQ(refusal(kAxis), "");
}

TEST(StudyIdentity, IsOfWhatIsComputed) {
  const auto identity = [](const std::string& members) { return study_sha256(parse_study({"study.json", file(members)})); };
  const std::string plain = identity(kAxis);
  EXPECT_EQ(plain, identity(kAxis + R"(, "title": "another", "_note": 1, "limits": {"points": 7})"));
  EXPECT_EQ(plain, identity(kAxis + R"(, "set": {"/site/longitude_deg": 0})"));  // which it is anyway
  EXPECT_NE(plain, identity(kAxis + R"(, "set": {"/release/spin_rad_s": 201})"));
  EXPECT_NE(plain, identity(kAxis + R"(, "collect": ["drift.verdict"])"));
  EXPECT_NE(plain, identity(kAxis + R"(, "rows": "all")"));
  EXPECT_NE(plain, identity(R"("axes": [{"pointer": "/site/latitude_deg", "values": [0, 46]}])"));
}

TEST(StudyReference, NamesEveryKey) {
  const std::string table = study_reference_markdown();
  for (const char* key : {"`base`", "`axes/*/log_range/from`", "`design/indices`", "`limits/core_hours`"})
    EXPECT_NE(table.find(key), std::string::npos) << key;
  EXPECT_NE(study_schema().find("latin_hypercube"), std::string::npos);
}

}  // namespace
}  // namespace earthtop
