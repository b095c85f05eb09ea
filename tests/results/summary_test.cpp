// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"
#include "support/json.hpp"
#include "text/sha256.hpp"

namespace earthtop {
namespace {

using nlohmann::json;
using test::made_up_run;

json summary_of(const RunResult& result) { return testing::parse_json(summary_json(result)); }

TEST(Sha256, KnownVectors) {  // FIPS 180-4 examples
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Summary, HasTheContractsKeys) {
  const RunResult result = made_up_run();
  const json summary = summary_of(result);
  const json& drift = summary.at("drift");
  EXPECT_EQ(drift.at("axis_final_rad").get<double>(), result.drift.axis_final_rad);
  EXPECT_EQ(drift.at("axis_max_rad").get<double>(), result.drift.axis_max_rad);
  EXPECT_EQ(drift.at("axis_bound_rad").get<double>(), result.drift.axis_bound_rad);
  EXPECT_EQ(drift.at("attitude_final_rad").get<double>(), result.drift.attitude_final_rad);
  EXPECT_EQ(drift.at("attitude_bound_rad").get<double>(), result.drift.attitude_bound_rad);
  EXPECT_EQ(drift.at("verdict"), "reliable");
}

TEST(Summary, HoldsTheRestOfTheResult) {
  const RunResult result = made_up_run();
  const json summary = summary_of(result);
  const json& drift = summary.at("drift");
  EXPECT_EQ(drift.at("spin_final_rad").get<double>(), result.drift.spin_final_rad);
  EXPECT_EQ(drift.at("azimuth_final_rad").get<double>(), *result.drift.azimuth_final_rad);
  EXPECT_EQ(drift.at("tilt_final_rad").get<double>(), result.drift.tilt_final_rad);
  EXPECT_EQ(drift.at("axis_final_over_earth_angle").get<double>(), *result.drift.axis_final_over_earth_angle);
  EXPECT_EQ(drift.at("/secular/azimuth_rate_rad_s"_json_pointer).get<double>(), 5.15e-5);
  EXPECT_EQ(drift.at("/secular/azimuth_rate_bound_95_rad_s"_json_pointer).get<double>(), 3e-7);
  EXPECT_EQ(drift.at("/secular/turns_seen"_json_pointer).get<double>(), 18.5);
  EXPECT_EQ(drift.at("/secular/window_s"_json_pointer), json::parse("[0.0, 60.0]"));
  EXPECT_EQ(drift.at("/secular/mean_of_window"_json_pointer), false);
  EXPECT_FALSE(drift.at("secular").contains("azimuth_rate_standard_error_rad_s"));
  EXPECT_EQ(drift.at("/secular/mean_precession_rate_change_rad_s"_json_pointer).get<double>(), -5.15e-5);
  EXPECT_EQ(drift.at("/oscillation/azimuth_rad"_json_pointer).get<double>(), 2e-4);
  EXPECT_TRUE(drift.at("threshold_rad").is_null());
  EXPECT_TRUE(drift.at("threshold_time_s").is_null());
  EXPECT_TRUE(drift.at("threshold_time_bound_s").is_null());
  EXPECT_TRUE(drift.at("threshold_crossing").is_null());
  EXPECT_EQ(summary.at("/outcome/status"_json_pointer), "completed");
  EXPECT_EQ(summary.at("/outcome/reached_s"_json_pointer), 60.0);
  EXPECT_EQ(summary.at("/outcome/rows"_json_pointer), 201);
  EXPECT_EQ(summary.at("/matching_rule/rates_relative_to"_json_pointer), "laboratory");
  EXPECT_EQ(summary.at("/solution/right_hand_side_evaluations"_json_pointer), 161196);
  EXPECT_EQ(summary.at("/solution/steps_accepted"_json_pointer), 12345);
  EXPECT_EQ(summary.at("/solution/steps_rejected"_json_pointer), 67);
  EXPECT_EQ(summary.at("/certificate/observer"_json_pointer), "inertial");
  EXPECT_EQ(summary.at("/invariants/0/largest_change"_json_pointer).get<double>(), 1e-14);
  EXPECT_EQ(summary.at("/theory/0/predicted"_json_pointer).get<double>(), -5.156e-5);
  EXPECT_EQ(summary.at("/theory/0/computed"_json_pointer).get<double>(), -5.15e-5);
  EXPECT_EQ(summary.at("/theory/0/predicted_error"_json_pointer).get<double>(), 4e-8);
  EXPECT_EQ(summary.at("/theory/0/computed_error"_json_pointer).get<double>(), 3e-7);
  EXPECT_EQ(summary.at("/theory/0/applies"_json_pointer), true);
  EXPECT_EQ(summary.at("/notes/0"_json_pointer), "made up");
}

TEST(Summary, SaysWhyWhereThereIsSomethingToSay) {
  RunResult result = made_up_run();
  EXPECT_EQ(summary_of(result).at("why"), json::parse(R"([
    {"name": "earth_turns", "text": "In the 60 s of this run the Earth turns by 902.46″.",
     "numbers": {"earth_angle_rad": 0.004375269}},
    {"name": "laboratory_turns", "text": "About <its> vertical & so on.", "numbers": {}}])"));
  result.why.clear();
  EXPECT_FALSE(summary_of(result).contains("why"));
}

TEST(Summary, TimesOfEventsHaveTheirBounds) {
  RunResult result = made_up_run();
  result.scene = testing::changed(result.scene, [&](Scenario& s) { s.threshold_rad = 1e-3; });
  result.drift.threshold_time_s = 12.5;
  result.drift.threshold_time_bound_s = 3e-9;
  result.drift.threshold_crossing = ThresholdCrossing::clear;
  result.stops = {{Prediction::rotating, 40.0, 2.0, 1e-8}, {Prediction::reference, 41.0, 2.0, std::nullopt}};
  const json summary = summary_of(result);
  EXPECT_EQ(summary.at("/drift/threshold_time_s"_json_pointer), 12.5);
  EXPECT_EQ(summary.at("/drift/threshold_time_bound_s"_json_pointer), 3e-9);
  EXPECT_EQ(summary.at("/drift/threshold_crossing"_json_pointer), "clear");
  EXPECT_EQ(summary.at("/stops/0/bound_s"_json_pointer), 1e-8);
  EXPECT_TRUE(summary.at("/stops/1/bound_s"_json_pointer).is_null());
  result.drift.threshold_crossing = ThresholdCrossing::tangential;
  EXPECT_EQ(summary_of(result).at("/drift/threshold_crossing"_json_pointer), "tangential");
}

TEST(Summary, HasTheBalancesOfTheContact) {
  RunResult result = test::made_up_contact_run();
  result.contact->rotating = {ContactBalance{1, 3, 1.5, 0.5, 4}, ContactBalance{10, 7, -2, -1, 8}};
  result.contact->reference = {ContactBalance{1, 2, 0.5, 0.5, 2}, ContactBalance{10, 8, -1, -1, 16}};
  const json contact = summary_of(result).at("contact");
  EXPECT_EQ(contact.at("jellett").at("rotating"),
            json::parse(R"({"first_kg_m3_s": 1.0, "last_kg_m3_s": 3.0, "integral_kg_m3_s": 1.5, "balance_kg_m3_s": 0.5,
                            "balance_over_size": 0.125})"));
  EXPECT_EQ(contact.at("work").at("reference"),
            json::parse(R"({"slip_work_J": -1.0, "jacobi_first_J": 10.0, "jacobi_last_J": 8.0, "balance_J": -1.0,
                            "balance_over_size": -0.0625})"));
  EXPECT_EQ(contact.at("work").at("rotating").at("slip_work_J"), -2.0);
  result.contact->rotating.jellett.reset(), result.contact->reference.jellett.reset();
  EXPECT_FALSE(summary_of(result).at("contact").contains("jellett"));
}

TEST(Summary, HasTheContactOfATopOnATableOnly) {
  const RunResult result = test::made_up_contact_run();
  const json summary = summary_of(result), without = summary_of(made_up_run());
  EXPECT_EQ(summary.at("/drift/tip_final_m"_json_pointer), *result.drift.tip_final_m);
  EXPECT_EQ(summary.at("/drift/tip_max_m"_json_pointer), 1.25e-4);
  EXPECT_EQ(summary.at("/drift/tip_bound_m"_json_pointer), 3.601e-12);
  EXPECT_EQ(summary.at("contact"), json::parse(R"({"events": [
    {"event": "slip_stopped", "t_s": 29.75, "bound_s": 1e-9, "prediction": "reference", "time_difference_s": -8e-7},
    {"event": "inverted", "t_s": 50.5, "bound_s": 1e-8, "prediction": "rotating", "time_difference_s": 3e-6}],
  "prediction_changes": [
    {"input": "friction_coefficient", "step": "1 %", "axis_rad": 8e-3, "tip_m": 8.8e-4, "at_s": 60.0},
    {"input": "table_tilt", "step": "1 arcsec", "axis_rad": 8e-6, "tip_m": 4e-5, "at_s": 60.0}]})"));
  EXPECT_FALSE(without.contains("contact"));
  EXPECT_EQ(summary.at("/drift/tip_final_x_m"_json_pointer), result.rows.back().contact->drift_tip_xy_m[0]);
  EXPECT_EQ(summary.at("/drift/tip_final_y_m"_json_pointer), result.rows.back().contact->drift_tip_xy_m[1]);
  for (const char* key : {"tip_final_m", "tip_final_x_m", "tip_max_m", "tip_bound_m"})
    EXPECT_FALSE(without.at("drift").contains(key)) << key;
}

TEST(Summary, OfRowsWithAContactHasTheTipsDrift) {
  const RunResult result = test::made_up_contact_run();
  const DriftSummary drift = summarize_drift(result.rows, kEarthRateWgs84);
  EXPECT_EQ(drift.tip_final_m, result.rows.back().contact->drift_tip_m);
  EXPECT_EQ(drift.tip_bound_m, result.rows.back().contact->drift_tip_bound_m);
  EXPECT_GE(*drift.tip_max_m, *drift.tip_final_m);
  EXPECT_FALSE(summarize_drift(made_up_run().rows, kEarthRateWgs84).tip_final_m);
}

TEST(Summary, AbsentValuesAreNull) {
  RunResult result = made_up_run();
  result.drift.secular.reset();
  result.drift.azimuth_final_rad.reset();
  result.drift.axis_final_over_earth_angle.reset();
  result.drift.axis_bound_rad = std::numeric_limits<double>::infinity();
  const json drift = summary_of(result).at("drift");
  for (const char* key : {"secular", "oscillation", "azimuth_final_rad", "axis_final_over_earth_angle", "axis_bound_rad"})
    EXPECT_TRUE(drift.at(key).is_null()) << key;
}

TEST(Summary, ATrendThatIsNotDeterminedIsNullWithTheReason) {
  RunResult result = made_up_run();
  result.drift.secular = SecularDrift{{}, {}, 0.4, {0, 60}, {}, false, "the run sees 0.4 turns"};
  result.theory[0].computed.reset();
  const json summary = summary_of(result), secular = summary.at("/drift/secular"_json_pointer);
  for (const char* key : {"azimuth_rate_rad_s", "azimuth_rate_bound_95_rad_s", "mean_precession_rate_change_rad_s"})
    EXPECT_TRUE(secular.at(key).is_null()) << key;
  EXPECT_EQ(secular.at("turns_seen").get<double>(), 0.4);
  EXPECT_EQ(secular.at("reason"), "the run sees 0.4 turns");
  EXPECT_TRUE(summary.at("/drift/oscillation/azimuth_rad"_json_pointer).is_null());
  EXPECT_TRUE(summary.at("/theory/0/computed"_json_pointer).is_null());
}

TEST(Summary, MatchingRuleIsSaidInWords) {
  RunResult result = made_up_run();
  EXPECT_NE(matching_rule(result.scene.scenario()).find("laboratory"), std::string::npos);
  result.scene = testing::changed(result.scene, [&](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::inertial; });
  EXPECT_NE(matching_rule(result.scene.scenario()).find("inertial"), std::string::npos);
  EXPECT_EQ(summary_of(result).at("/matching_rule/rates_relative_to"_json_pointer), "inertial");
}

TEST(Summary, EffectSwitchedOffIsLeftOut) {
  RunResult result = made_up_run();
  result.modelled = testing::changed(result.modelled, [](Scenario& s) { s.effects.centrifugal = false; });
  const json effects = summary_of(result).at("effects");
  const auto has = [&](const char* list, const char* effect) {
    const json& names = effects.at(list);
    return std::find(names.begin(), names.end(), effect) != names.end();
  };
  EXPECT_TRUE(has("modelled", "coriolis"));
  EXPECT_FALSE(has("modelled", "centrifugal"));
  EXPECT_TRUE(has("left_out", "centrifugal"));
}

TEST(Summary, LedgerOnlyWhereThereIsOne) {
  EXPECT_FALSE(summary_of(made_up_run()).contains("ledger"));
  RunResult result = test::made_up_run_with_ledger();
  json ledger = summary_of(result).at("ledger");
  EXPECT_EQ(ledger.at("observer"), "platform");
  EXPECT_EQ(ledger.at("tau_phys_max_N_m"), 1);
  EXPECT_EQ(ledger.at("tau_cor_max_N_m"), 2);
  EXPECT_EQ(ledger.at("tau_trans_max_N_m"), 3);
  EXPECT_EQ(ledger.at("tau_cent_max_N_m"), 4);
  EXPECT_EQ(ledger.at("dL_dt_max_N_m"), 5);
  EXPECT_EQ(ledger.at("residual_max_N_m"), 0.5);
  EXPECT_EQ(ledger.at("residual_over_largest_torque"), 0.125);
  result.ledger->largest.residual = std::numeric_limits<double>::quiet_NaN();
  ledger = summary_of(result).at("ledger");
  EXPECT_TRUE(ledger.at("residual_max_N_m").is_null());
  EXPECT_TRUE(ledger.at("residual_over_largest_torque").is_null());
}

TEST(Summary, ScenarioIsTheCanonicalOneAndItsHash) {
  const RunResult result = made_up_run();
  const json summary = summary_of(result);
  EXPECT_EQ(summary.at("scenario"), testing::parse_json(canonical_json(result.scene.scenario())));
  EXPECT_EQ(summary.at("/provenance/scenario_sha256"_json_pointer), sha256_hex(identity_json(result.scene.scenario())));
}

TEST(Summary, ProvenanceNamesBuildLibrariesAndConstants) {
  const json provenance = summary_of(made_up_run()).at("provenance");
  for (const char* key : {"version", "commit", "compiler", "flags"})
    EXPECT_FALSE(provenance.at(key).get<std::string>().empty()) << key;
  for (const char* library : {"Boost", "Eigen", "GSL", "nlohmann-json", "fmt", "GeographicLib", "ERFA", "SLEEF", "libmd"})
    EXPECT_FALSE(provenance.at("libraries").at(library).get<std::string>().empty()) << library;
  EXPECT_EQ(provenance.at("/constants/0/value"_json_pointer).get<double>(), 7.292115e-5);
  EXPECT_EQ(provenance.at("/constants/1/source"_json_pointer), "scenario");
}

TEST(Summary, ConstantsNameTheEllipsoidOnlyWhereItWasUsed) {
  Scenario scenario = made_up_run().scene.scenario();
  EXPECT_EQ(constants_used(scenario).size(), 2U);
  scenario.site.gravity_m_s2 = normal_gravity(scenario.site.latitude_deg, scenario.site.height_m);
  EXPECT_EQ(constants_used(scenario).size(), 5U);
}

TEST(Summary, ConstantsAreMadeOnceAScene) {
  const Scene scene = made_up_run().scene;
  EXPECT_EQ(&constants_used(scene), &constants_used(scene));
}

TEST(Summary, SameResultSameBytes) {
  RunResult result = made_up_run();
  const std::string first = summary_json(result);
  EXPECT_EQ(first, summary_json(result));
  result.solution.seconds = 99;
  result.certificate.seconds = 98;
  EXPECT_EQ(first, summary_json(result));
  EXPECT_EQ(first.find("seconds"), std::string::npos);
}

TEST(Summary, AnotherResultOtherBytes) {
  RunResult result = made_up_run();
  const std::string first = summary_json(result);
  result.drift.axis_final_rad = std::nextafter(result.drift.axis_final_rad, 1.0);
  EXPECT_NE(first, summary_json(result));
}

TEST(Timing, HoldsWhatTheSummaryMustNot) {
  RunResult result = made_up_run();
  result.looks_seconds = 0.25;
  const json timing = testing::parse_json(timing_json(result));
  EXPECT_EQ(timing.at("solution_s"), 0.125);
  EXPECT_EQ(timing.at("certificate_s"), 0.125);
  EXPECT_EQ(timing.at("looks_s"), 0.25);
  EXPECT_EQ(timing.at("written_utc").get<std::string>().size(), 20U);
  EXPECT_FALSE(timing.at("host").get<std::string>().empty());
}

// A run that failed at its release has no numbers for drift, motion or bounds; in particular no zeros.
TEST(Summary, HasNoNumbersWithoutARowBeyondTheRelease) {
  RunResult result = made_up_run();
  result.rows.resize(1);
  result.status = RunStatus::step_underflow;
  result.verdict.verdict = Verdict::unassessed;
  result.verdict.lyapunov_exponent_1_s = 0.5;
  const json summary = summary_of(result);
  EXPECT_EQ(summary.at("drift").at("verdict"), "unassessed");
  int numbers = 0;
  for (const char* section : {"drift", "motion", "growth_of_disturbances", "attitude_bound_rad"}) {
    const json figures = json{{section, summary.at(section)}}.flatten();
    for (const auto& [path, value] : figures.items()) {
      EXPECT_FALSE(value.is_number()) << path;
      ++numbers;
    }
  }
  EXPECT_GT(numbers, 30);  // they are there, and null
  result.rows.push_back(result.rows.back());
  EXPECT_TRUE(summary_of(result).at("drift").at("axis_final_rad").is_number());
}

}  // namespace
}  // namespace earthtop
