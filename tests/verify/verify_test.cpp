// SPDX-License-Identifier: GPL-3.0-or-later
/// Criteria: for each kind, a correct result passes and a wrong one fails.
#include "earthtop/verify/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support/changed_scene.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"
#include "verify/formulas.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

Json hard_case(const std::string& name) {
  return testing::parse_ordered_json(testing::read_file(EARTHTOP_SCENARIOS "/hard/" + name + ".json"));
}

/// The rows of a hard case whose criteria are replaced by these.
std::vector<VerificationRow> rows_of(Json scene, const Json& criteria, const VerificationOptions& options = {}) {
  scene["criteria"] = criteria;
  std::vector<VerificationRow> rows;
  verify({"test.json", testing::text_of(scene)}, options, [&](const VerificationRow& row) { rows.push_back(row); });
  return rows;
}
VerificationRow judged(const Json& scene, Json criterion) {
  criterion["why"] = "test";
  return rows_of(scene, Json::array({criterion})).at(0);
}
bool passes(const Json& scene, const Json& criterion) {
  return judged(scene, criterion).outcome == VerificationOutcome::passed;
}
bool case_passes(const std::string& name, const Json& criterion) { return passes(hard_case(name), criterion); }

TEST(Criteria, AValueMayBeOffByItsTolerance) {
  const Json known = hard_case("t05-goryachev-chaplygin").at("criteria").at(0);
  ASSERT_EQ(known.at("quantity"), "w_LB_B_z_rad_s");
  const double value = known.at("values").at(0), tolerance = 1e-9;
  for (const auto& [off, expected] :
       {std::pair(0.5, true), std::pair(-0.5, true), std::pair(2.0, false), std::pair(-2.0, false)}) {
    const auto row = judged(
        hard_case("t05-goryachev-chaplygin"),
        {{"kind", "value"}, {"quantity", "w_LB_B_z_rad_s"}, {"values", {value + off * tolerance}}, {"tolerance", tolerance}});
    EXPECT_EQ(row.outcome == VerificationOutcome::passed, expected) << off;
    EXPECT_NEAR(row.error, std::abs(off) * tolerance, testing::rounding(100) * std::abs(value));
    EXPECT_EQ(row.bound, tolerance);
  }
}

// Both signs of a quaternion are the same attitude; the error is the angle between attitudes.
TEST(Criteria, AnAttitudeIsComparedAsAnAngle) {
  const Json scene = hard_case("t01-heavy-top");
  const Json known = scene.at("criteria").at(1);
  ASSERT_EQ(known.at("quantity"), "q_LB");
  Json criterion = {{"kind", "value"}, {"quantity", "q_LB"}, {"at_s", known.at("at_s")}, {"tolerance", 1e-9}};
  std::vector<double> q = known.at("values");
  for (double& component : q) component = -component;
  criterion["values"] = q;
  EXPECT_TRUE(passes(scene, criterion));
  q[3] += 1e-8;
  criterion["values"] = q;
  const auto row = judged(scene, criterion);
  EXPECT_EQ(row.outcome, VerificationOutcome::failed);
  EXPECT_LT(row.error, 2.01e-8);  // twice the half angle
}

TEST(Criteria, AnInvariantOfAnotherBodyIsNone) {
  const Json kovalevskaya = {{"kind", "invariant"}, {"quantity", "kovalevskaya"}, {"tolerance", 1e-6}};
  Json scene = hard_case("h13-kovalevskaya");
  EXPECT_TRUE(passes(scene, kovalevskaya));
  scene["body"]["inertia"]["principal_kg_m2"] = {2, 2, 1.0001};
  EXPECT_FALSE(passes(scene, kovalevskaya));
  const Json goryachev = {{"kind", "invariant"}, {"quantity", "goryachev_chaplygin"}, {"tolerance", 1e-6}};
  scene = hard_case("h14-goryachev-chaplygin");
  EXPECT_TRUE(passes(scene, goryachev));
  scene["release"]["angular_velocity_body_rad_s"][2] = 4.4;  // now it has angular momentum about Up
  EXPECT_FALSE(passes(scene, goryachev));
  scene["body"]["inertia"]["principal_kg_m2"] = {4, 3.9, 1};
  const auto row = judged(scene, {{"kind", "invariant"}, {"quantity", "inertial_spin"}, {"tolerance", 1}});
  EXPECT_EQ(row.outcome, VerificationOutcome::failed);
  EXPECT_TRUE(std::isinf(row.error));
  EXPECT_FALSE(row.remark.empty());
}

// At a pole gravity has no moment about the vertical of inertial space, on a turning Earth either, so the rotating motion is
// judged.
TEST(Criteria, VerticalMomentumIsThatOfTheMotionThatConservesIt) {
  Json scene = hard_case("h04-pole");
  scene["earth"]["rotation_rate_rad_s"] = 0.01;
  const Json vertical = {{"kind", "invariant"}, {"quantity", "vertical_momentum"}, {"tolerance", 1e-9}};
  EXPECT_TRUE(passes(scene, vertical));
  scene["effects"] = {{"coriolis", false}};
  EXPECT_FALSE(passes(scene, vertical));
}

TEST(Criteria, AnotherMirrorIsNone) {
  const auto mirrored = [](const Json& changes) {
    return case_passes("h23-metamorphic-auto",
                       {{"kind", "equivalence"}, {"quantity", "mirrored_north_south"}, {"tolerance", 0}, {"set", changes}});
  };
  EXPECT_TRUE(mirrored({"/site/latitude_deg=-45", "/release/azimuth_deg=110", "/release/spin_rad_s=-60"}));
  EXPECT_FALSE(mirrored({"/site/latitude_deg=-45", "/release/azimuth_deg=110"}));
  EXPECT_FALSE(mirrored({"/site/latitude_deg=-45", "/release/spin_rad_s=-60"}));
  EXPECT_FALSE(mirrored({"/release/azimuth_deg=110", "/release/spin_rad_s=-60"}));
}

TEST(Criteria, ToleranceZeroMeansEveryBit) {
  const auto same = [](const std::string& gravity) {
    return judged(hard_case("h23-metamorphic-auto"),
                  {{"kind", "equivalence"},
                   {"quantity", "same"},
                   {"tolerance", 0},
                   {"set",
                    {"/motion/duration_s=0.5", "/motion/output_step_s=0.005", "/earth/rotation_rate_rad_s=0.04",
                     "/release/spin_rad_s=240", "/site/gravity_m_s2=" + gravity}}});
  };
  EXPECT_EQ(same("156.9064").outcome, VerificationOutcome::passed);
  const auto row = same("156.90640000000002");  // the next double
  EXPECT_EQ(row.outcome, VerificationOutcome::failed);
  EXPECT_LT(row.error, testing::rounding(500));
}

TEST(Criteria, EquivalencesHoldOnlyWhereTheyAreTrue) {
  const auto equivalent = [](const std::string& name, const char* relation, double tolerance, const Json& changes) {
    return case_passes(name, {{"kind", "equivalence"}, {"quantity", relation}, {"tolerance", tolerance}, {"set", changes}});
  };
  EXPECT_FALSE(equivalent("h04-pole", "reference_turned", 1e-6, {"/site/latitude_deg=89.9"}));
  EXPECT_FALSE(equivalent("h04-pole", "reference_turned", 1e-6, {"/release/rates_relative_to=laboratory"}));
  EXPECT_FALSE(equivalent("h05-free-body", "reference_turned", 1e-6, {"/body/center_of_mass_m=[0,0,1e-6]"}));
  EXPECT_FALSE(equivalent("h02-tiny-earth-rate", "proportional_to_earth_rate", 1e-9, {"/earth/rotation_rate_rad_s=1e-5"}));
  EXPECT_FALSE(
      equivalent("h23-irrelevant-angles", "same_drift", 1e-6, {"/site/latitude_deg=89.9", "/release/azimuth_deg=-33"}));
  EXPECT_FALSE(equivalent("h20-a-million-rad-s", "same_axis", 1e-9, {"/release/spin_rad_s=1.000001e6"}));
  EXPECT_FALSE(equivalent("h22-time-reversal", "reversed_in_time", 1e-9,
                          {"/platform/motion=ramp", "/platform/acceleration_rad_s2=1", "/platform/pivot_offset_m=[0.1,0,0]",
                           "/motion/duration_s=5"}));
  EXPECT_FALSE(equivalent("h17-vertical", "same", 1e-6, {"/motion/output_step_s=0.04"}));  // other rows
}

TEST(Criteria, ZeroIsZero) {
  const auto zero = [](const std::string& name, const char* quantity, const char* change) {
    return case_passes(name, {{"kind", "exactly_zero"}, {"quantity", quantity}, {"set", {change}}});
  };
  EXPECT_TRUE(zero("h03-no-earth-rate", "drift", "/motion/duration_s=0.1"));
  EXPECT_FALSE(zero("h03-no-earth-rate", "drift", "/earth/rotation_rate_rad_s=1e-300"));
  EXPECT_FALSE(zero("h24-poles", "axis_drift", "/site/latitude_deg=89.99999999999999"));
  EXPECT_FALSE(zero("h17-vertical", "reference_tilt", "/release/tilt_deg=1e-12"));
}

TEST(Criteria, AnOrderThatIsNotAndAResonance) {
  const Json scene = hard_case("h26-step-resonance");
  const auto order = [](double value) {
    return Json{{"kind", "order"}, {"quantity", "convergence"}, {"values", {value}}, {"tolerance", 0.3}};
  };
  EXPECT_TRUE(passes(scene, order(6)));
  EXPECT_FALSE(passes(scene, order(5)));
  EXPECT_FALSE(passes(scene, order(7)));
  // A whole nutation is 0.094 s.
  const Json smooth = {{"kind", "order"}, {"quantity", "step_resonance"}, {"tolerance", 2}, {"set", {"/numerics/step_s=0.12"}}};
  EXPECT_FALSE(passes(scene, smooth));
}

TEST(Criteria, VerdictsHaveATime) {
  const auto verdict = [](const char* word, const Json& times) {
    Json criterion = {{"kind", "verdict"}, {"quantity", word}, {"set", {"/motion/duration_s=40"}}};
    if (!times.empty()) criterion["values"] = times;
    return case_passes("h09-homoclinic", criterion);
  };
  EXPECT_TRUE(verdict("unstable", Json::array()));
  EXPECT_TRUE(verdict("unstable", {18, 23}));
  EXPECT_FALSE(verdict("unstable", {21, 23}));
  EXPECT_FALSE(verdict("unstable", {1, 18}));
  EXPECT_FALSE(verdict("chaotic", {18, 23}));
}

TEST(Criteria, WhatIsNotRefusedFails) {
  EXPECT_TRUE(case_passes("h24-poles", {{"kind", "refused"}, {"set", {"/site/latitude_deg=91"}}}));
  EXPECT_FALSE(case_passes("h24-poles", {{"kind", "refused"}, {"set", {"/site/latitude_deg=90"}}}));
}

TEST(Criteria, AFormulaForAnotherSceneJudgesNothing) {
  for (const char* formula : {"motion", "motion_axis", "steady_precession", "homoclinic_tilt", "separatrix_rates"}) {
    const auto row = judged(hard_case("h12-regular"), {{"kind", "closed_form"}, {"quantity", formula}, {"tolerance", 1e9}});
    EXPECT_EQ(row.outcome, VerificationOutcome::failed) << formula;
    EXPECT_FALSE(row.remark.empty());
  }
}

TEST(Criteria, SlowOnesWait) {
  const Json slow = {{{"kind", "refused"}, {"set", {"/site/latitude_deg=91"}}, {"why", ""}, {"slow", true}}};
  EXPECT_EQ(rows_of(hard_case("h24-poles"), slow).at(0).outcome, VerificationOutcome::skipped);
  EXPECT_EQ(rows_of(hard_case("h24-poles"), slow, {.slow = true, .watch = {}}).at(0).outcome, VerificationOutcome::passed);
}

TEST(Criteria, AnUnsoundSceneIsRefusedBeforeAnythingRuns) {
  const Json criteria = {{{"kind", "refused"}, {"set", {"/site/latitude_deg=91"}}, {"why", ""}},
                         {{"kind", "exactly_zero"}, {"quantity", "drift"}, {"set", {"/site/latitude_deg=91"}}, {"why", ""}}};
  int rows = 0;
  Json scene = hard_case("h24-poles");
  scene["criteria"] = criteria;
  try {
    verify({"test.json", testing::text_of(scene)}, {}, [&](const VerificationRow&) { ++rows; });
    FAIL() << "not refused";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.diagnostics().at(0).pointer, "/criteria/1/set");
    EXPECT_NE(error.diagnostics().at(0).message.find("/site/latitude_deg"), std::string::npos);
  }
  EXPECT_EQ(rows, 0);
}

/// A hard case's first closed form of this name, and the run that it judges.
struct FormulaRun {
  double tolerance;
  RunResult result;
};
FormulaRun run_for(const std::string& name, const std::string& formula) {
  const Json scene = hard_case(name);
  for (const Json& criterion : scene.at("criteria")) {
    if (criterion.value("quantity", "") != formula) continue;
    verify_detail::Runs runs({name + ".json", testing::text_of(scene)});
    return {criterion.at("tolerance"), runs.run(criterion.value("set", std::vector<std::string>{}))};
  }
  throw std::runtime_error(name + " has no " + formula);
}

// A motion that runs too fast by a thousandth does not satisfy the formula.
TEST(Formulas, NoticeAThousandth) {
  using namespace verify_detail;
  const struct {
    const char *name, *formula;
    std::function<double(const RunResult&)> error;
  } cases[] = {{"h06-foucault", "foucault_rate", foucault_rate_error},
               {"h16-steady-precession", "steady_precession", steady_precession_error},
               {"t07-balanced-gyroscope", "balanced_axis", balanced_axis_error},
               {"h09-homoclinic", "homoclinic_tilt", [](const RunResult& r) { return homoclinic_tilt_error(r, 15); }},
               {"h10-dzhanibekov", "separatrix_rates", [](const RunResult& r) { return separatrix_rates_error(r, 20); }}};
  for (const auto& c : cases) {
    auto [tolerance, result] = run_for(c.name, c.formula);
    EXPECT_LE(c.error(result), tolerance) << c.formula;
    for (DriftRow& row : result.rows) row.t_s *= 1.001;
    EXPECT_GT(c.error(result), tolerance) << c.formula;
  }
}

TEST(Formulas, NoticeATiltThatIsAThousandthOff) {
  using namespace verify_detail;
  const struct {
    const char *name, *formula;
    double (*error)(const RunResult&);
  } cases[] = {{"h07-sleeping-lean", "resting_axis", resting_axis_error},
               {"h07-sleeping-lean", "mean_lean", mean_lean_error},
               {"h15-cusp", "cusp_tilts", cusp_tilts_error}};
  for (const auto& c : cases) {
    auto [tolerance, result] = run_for(c.name, c.formula);
    EXPECT_LE(c.error(result), tolerance) << c.formula;
    const double start = result.rows.front().ref_axis_L[2];
    for (DriftRow& row : result.rows) {
      row.axis_L[0] *= 1.001, row.axis_L[1] *= 1.001;
      row.ref_axis_L[2] = start + 1.001 * (row.ref_axis_L[2] - start);
    }
    EXPECT_GT(c.error(result), tolerance) << c.formula;
  }
  auto [tolerance, result] = run_for("h08-sleeping-below-critical", "growth_rate");
  EXPECT_LE(growth_rate_error(result), tolerance);
  result.scene = testing::changed(result.scene, [](Scenario& s) { s.output_step_s *= 1.001; });
  EXPECT_GT(growth_rate_error(result), tolerance);
}

}  // namespace
}  // namespace earthtop
