// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "earthtop/results/headline.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "results/digits.hpp"
#include "results/summary_section.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Text from a user may be anything; bytes that are not UTF-8 become U+FFFD instead of an exception.
std::string dump(const Json& json) { return json_with_escapes(written_replacing(json, 2)) + '\n'; }

std::string_view to_word(RatesRelativeTo frame) { return frame == RatesRelativeTo::laboratory ? "laboratory" : "inertial"; }

/// The same document with null for every number.
Json without_numbers(Json json) {
  if (json.is_number()) return nullptr;
  for (Json& part : json)
    if (part.is_structured() || part.is_number()) part = without_numbers(std::move(part));
  return json;
}

/// The drift where it can be trusted last.
Json reliable_json(const RunResult& result) {
  Json json = {{"until_s", result.verdict.reliable_until_s}};
  const DriftRow* row = last_reliable_row(result);
  json["at_s"] = row ? Json(row->t_s) : Json();
  json["axis_rad"] = row ? Json(row->drift_axis_rad) : Json();
  json["axis_bound_rad"] = row ? Json(row->drift_axis_bound_rad) : Json();
  json["attitude_rad"] = row ? Json(row->drift_attitude_rad) : Json();
  json["attitude_bound_rad"] = row ? Json(row->drift_attitude_bound_rad) : Json();
  return json;
}

Json growth_json(const VerdictReport& verdict) {
  return {{"lyapunov_exponent_1_s", or_null(verdict.lyapunov_exponent_1_s)},
          {"round_off_grown_s", or_null(verdict.round_off_grown_s)},
          {"earth_grown_s", or_null(verdict.earth_grown_s)}};
}

/// The largest size of a value over the rows that have it.
template <class Value>
Json largest(const std::vector<DriftRow>& rows, const Value& value_of) {
  std::optional<double> most;
  for (const DriftRow& row : rows)
    if (const std::optional<double> value = value_of(row)) most = std::max(most.value_or(0), std::abs(*value));
  return or_null(most);
}

Json drift_json(const RunResult& result) {
  const DriftSummary& drift = result.drift;
  const std::optional<double>& threshold_rad = result.scene.scenario().threshold_rad;
  Json secular = nullptr;
  Json oscillation = nullptr;
  if (drift.secular) {
    secular = {{"azimuth_rate_rad_s", drift.secular->azimuth_rate_rad_s},
               {"azimuth_rate_standard_error_rad_s", drift.secular->azimuth_rate_standard_error_rad_s},
               {"mean_precession_rate_change_rad_s", drift.secular->mean_precession_rate_change_rad_s}};
    oscillation = {{"azimuth_rad", drift.secular->azimuth_oscillation_rad}};
  }
  Json json = {{"axis_final_rad", drift.axis_final_rad},
               {"axis_max_rad", drift.axis_max_rad},
               {"axis_bound_rad", drift.axis_bound_rad},
               {"attitude_final_rad", drift.attitude_final_rad},
               {"attitude_bound_rad", drift.attitude_bound_rad},
               {"spin_final_rad", drift.spin_final_rad},
               {"azimuth_final_rad", or_null(drift.azimuth_final_rad)},
               {"tilt_final_rad", drift.tilt_final_rad},
               {"azimuth_max_rad", largest(result.rows, [](const DriftRow& row) { return row.drift_azimuth_rad; })},
               {"tilt_max_rad", largest(result.rows, [](const DriftRow& row) { return std::optional(row.drift_tilt_rad); })},
               {"axis_final_over_earth_angle", or_null(drift.axis_final_over_earth_angle)},
               {"verdict", to_string(result.verdict.verdict)},
               {"verdict_from_s", or_null(result.verdict.from_s)},
               {"verdict_reason", result.verdict.reason},
               {"reliable", reliable_json(result)},
               {"secular", std::move(secular)},
               {"oscillation", std::move(oscillation)},
               {"threshold_rad", or_null(threshold_rad)},
               {"threshold_time_s", or_null(drift.threshold_time_s)},
               {"threshold_time_bound_s", or_null(drift.threshold_time_bound_s)},
               {"threshold_crossing", drift.threshold_crossing ? Json(to_string(*drift.threshold_crossing)) : Json()}};
  if (const auto digits = drift_digits(result))
    json["digits"] = {{"axis_final_rad", digits->axis_final_rad},
                      {"axis_max_rad", digits->axis_max_rad},
                      {"attitude_final_rad", digits->attitude_final_rad},
                      {"spin_final_rad", digits->spin_final_rad}};
  return json;
}

/// Body axis 3 in the laboratory (East, North, Up): in the last row, and the mean of all rows, which is where a precessing or
/// nutating axis goes round.
Json motion_json(const RunResult& result) {
  if (result.rows.empty()) return nullptr;
  std::array<double, 3> mean{}, reference_mean{};
  const auto count = static_cast<double>(result.rows.size());
  for (const DriftRow& row : result.rows)
    for (std::size_t i = 0; i < 3; ++i) {
      mean[i] += row.axis_L[i] / count;
      reference_mean[i] += row.ref_axis_L[i] / count;
    }
  return {{"axis_final_L", result.rows.back().axis_L},
          {"reference_axis_final_L", result.rows.back().ref_axis_L},
          {"axis_mean_L", mean},
          {"reference_axis_mean_L", reference_mean}};
}

/// When dry friction brought a motion to rest.
Json stops_json(const std::vector<StopEvent>& stops) {
  Json list = Json::array();
  for (const StopEvent& stop : stops)
    list.push_back({{"prediction", stop.prediction == Prediction::rotating ? "rotating" : "non_rotating"},
                    {"t_s", stop.t_s},
                    {"bound_s", or_null(stop.bound_s)}});
  return list;
}

Json headline_json(const std::optional<HeadlineCheck>& check) {
  if (!check) return nullptr;
  return {{"quantity", check->stated.quantity},
          {"at_s", or_null(check->at_s)},
          {"stated", check->stated.value},
          {"tolerance", check->stated.tolerance},
          {"computed", or_null(check->computed)},
          {"difference", or_null(check->difference)},
          {"met", check->met},
          {"origin", check->stated.origin}};
}

Json integration_json(const IntegrationReport& report) {
  Json json = {{"reason", report.reason},
               {"observer", to_string(report.observer)},
               {"model", to_string(report.form)},
               {"method", to_string(report.method)},
               {"precision", report.precision},
               {"relative_tolerance", report.relative_tolerance > 0 ? Json(report.relative_tolerance) : Json()},
               {"step_s", or_null(report.step_s)},
               {"steps_accepted", report.counters.accepted},
               {"steps_rejected", report.counters.rejected},
               {"right_hand_side_evaluations", report.counters.evaluations}};
  if (report.status != RunStatus::completed) json["status"] = to_string(report.status);
  return json;
}

Json invariants_json(const std::vector<InvariantReport>& invariants) {
  Json list = Json::array();
  for (const InvariantReport& invariant : invariants) {
    list.push_back({{"name", invariant.name},
                    {"unit", invariant.unit},
                    {"initial", invariant.initial},
                    {"largest_change", invariant.largest_change},
                    {"scale", invariant.scale}});
  }
  return list;
}

Json theory_json(const std::vector<TheoryReport>& theory) {
  Json list = Json::array();
  for (const TheoryReport& report : theory) {
    list.push_back({{"name", report.name},
                    {"statement", report.statement},
                    {"unit", report.unit},
                    {"predicted", report.predicted},
                    {"computed", report.computed}});
  }
  return list;
}

Json sensitivities_json(const SensitivityReport& report) {
  if (!report.unavailable.empty()) return {{"at_s", report.at_s}, {"unavailable", report.unavailable}};
  Json inputs = Json::array();
  for (const InputSensitivity& input : report.inputs)
    inputs.push_back({{"name", input.name},
                      {"value", input.value},
                      {"d_axis_rad", input.axis_rad},
                      {"d_attitude_rad", input.attitude_rad},
                      {"d_tilt_rad", input.tilt_rad},
                      {"d_azimuth_rad", or_null(input.azimuth_rad)},
                      {"axis_error_rad", input.axis_error_rad}});
  return {{"at_s", report.at_s}, {"per", "one unit of the input, as its name says"}, {"inputs", std::move(inputs)}};
}

/// The last reliable drift of the axis with what is known of its errors: from the inputs (a standard error, inputs independent)
/// and from the numerics (a bound).
Json uncertainty_json(const RunResult& result) {
  const SensitivityReport& report = *result.sensitivities;
  if (!report.unavailable.empty()) return {{"unavailable", report.unavailable}};
  const DriftRow* row = last_reliable_row(result);
  const auto largest = std::max_element(report.inputs.begin(), report.inputs.end(),
                                        [](const auto& a, const auto& b) { return a.axis_error_rad < b.axis_error_rad; });
  return {{"axis_rad", row->drift_axis_rad},
          {"from_inputs_rad", report.axis_error_rad},
          {"from_numerics_rad", row->drift_axis_bound_rad},
          {"largest_from", largest->axis_error_rad > 0 ? Json(largest->name) : Json()}};
}

Json ledger_json(const LedgerReport& ledger) {
  return {{"observer", to_string(ledger.observer)},      {"tau_phys_max_N_m", ledger.largest.tau_phys},
          {"tau_cor_max_N_m", ledger.largest.tau_cor},   {"tau_trans_max_N_m", ledger.largest.tau_trans},
          {"tau_cent_max_N_m", ledger.largest.tau_cent}, {"dL_dt_max_N_m", ledger.largest.dL_dt},
          {"residual_max_N_m", ledger.largest.residual}, {"residual_over_largest_torque", ledger.largest.relative_residual()}};
}

/// Everything that could turn a top is on one of the two lists.
Json effects_json(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const EffectsSpec& effects = scenario.effects;
  const AppliedTorquesSpec& applied = effects.applied;
  const Site& site = scene.site();
  Json modelled = Json::array({"gravity"});
  Json left_out = Json::array();
  const auto list = [&](const char* name, bool on) { (on ? modelled : left_out).push_back(name); };
  list("coriolis", effects.coriolis);
  list("centrifugal", effects.centrifugal);
  list("transverse", effects.transverse);
  list("platform_motion", scenario.platform.has_value());
  list("gravity_gradient", applied.gravity_gradient.has_value());
  list("tide", effects.tide.has_value());
  list("polar_motion", site.pole.x_arcsec != 0 || site.pole.y_arcsec != 0);
  list("length_of_day", scenario.excess_length_of_day_ms != 0);
  list("deflection_of_vertical", site.deflection.north_arcsec != 0 || site.deflection.east_arcsec != 0);
  list("viscous_torque", applied.viscous_N_m_s != 0);
  list("quadratic_torque", applied.quadratic_N_m_s2 != 0);
  list("air_drag", applied.air_drag.has_value());
  list("coulomb_torque", applied.coulomb_N_m != 0);
  list("gimbal", applied.gimbal.has_value());
  list("axis_precession", false);
  list("elasticity", false);
  return {{"modelled", std::move(modelled)}, {"left_out", std::move(left_out)}};
}

/// What was chosen for a scene that left it open, and what the error asked for came to.
Json selection_json(const Selection& selection) {
  return {{"accuracy_rad", selection.accuracy_rad},
          {"switched_on", selection.switched_on},
          {"left_out", selection.left_out},
          {"left_out_drift_rad", selection.left_out_drift_rad}};
}
Json accuracy_json(const AccuracyReport& accuracy) {
  return {{"asked_rad", accuracy.asked_rad},
          {"reached_rad", accuracy.reached_rad},
          {"reached", accuracy.reached()},
          {"attempts", accuracy.attempts}};
}

Json provenance_json(const Scene& scene) {
  const BuildInfo& build = build_info();
  Json libraries = Json::object();
  for (const auto& [name, version] : build.libraries) libraries[name] = version;
  Json constants = Json::array();
  for (const Constant& constant : constants_used(scene))
    constants.push_back(
        {{"name", constant.name}, {"value", constant.value}, {"unit", constant.unit}, {"source", constant.source}});
  return {{"program", "earthtop"},
          {"version", build.version},
          {"commit", build.commit},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"libraries", std::move(libraries)},
          {"scenario_sha256", scene.sha256()},
          {"constants", std::move(constants)}};
}

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc));
}

}  // namespace

std::string matching_rule(const Scenario& scenario) {
  return scenario.release.rates_relative_to == RatesRelativeTo::laboratory
             ? "same attitude and same rates relative to the laboratory at release"
             : "same attitude and same rates relative to inertial space at release";
}

std::optional<DriftDigits> drift_digits(const RunResult& result) {
  if (result.extended_rows.empty() || !has_drift(result)) return std::nullopt;
  const auto in_full = [&](float128 value) { return digits(value, result.scene.scenario().precision); };
  float128 axis_max = 0;
  for (const ExtendedDriftRow& row : result.extended_rows) axis_max = std::max(axis_max, row.drift_axis_rad);
  const ExtendedDriftRow& last = result.extended_rows.back();
  return DriftDigits{in_full(last.drift_axis_rad), in_full(axis_max), in_full(last.drift_attitude_rad),
                     in_full(last.drift_spin_rad)};
}

namespace {

/// One of the document's members; null where the result has none.
struct Section {
  const char* name;
  bool optional;
  Json (*json)(const RunResult&);
  bool of_rows = false;  ///< it says what rows say: without a row beyond the release there is no number in it
};

Json section_json(const Section& section, const RunResult& result) {
  Json json = section.json(result);
  return section.of_rows && !has_drift(result) ? without_numbers(std::move(json)) : json;
}

constexpr bool kOfRows = true;
constexpr Section kSections[] = {
    {"$schema", false, [](const RunResult&) -> Json { return "earthtop-summary-1.json"; }},
    {"name", false, [](const RunResult& r) -> Json { return r.scene.scenario().name; }},
    {"title", false, [](const RunResult& r) -> Json { return r.scene.scenario().title; }},
    {"outcome", false,
     [](const RunResult& r) -> Json {
       return {{"status", to_string(r.status)}, {"reached_s", r.reached_s}, {"rows", r.rows.size()}};
     }},
    {"matching_rule", false,
     [](const RunResult& r) -> Json {
       return {{"rates_relative_to", to_word(r.scene.scenario().release.rates_relative_to)},
               {"statement", matching_rule(r.scene.scenario())}};
     }},
    {"drift", false, [](const RunResult& r) { return drift_json(r); }, kOfRows},
    {"motion", false, [](const RunResult& r) { return motion_json(r); }, kOfRows},
    {"growth_of_disturbances", false, [](const RunResult& r) { return growth_json(r.verdict); }, kOfRows},
    {"stops", false, [](const RunResult& r) { return stops_json(r.stops); }},
    {"headline", false, [](const RunResult& r) { return headline_json(check_headline(r)); }},
    {"solution", false, [](const RunResult& r) { return integration_json(r.solution); }},
    {"certificate", false, [](const RunResult& r) { return integration_json(r.certificate); }},
    {"attitude_bound_rad", false, [](const RunResult& r) -> Json { return r.attitude_bound_rad; }, kOfRows},
    {"invariants", false, [](const RunResult& r) { return invariants_json(r.invariants); }},
    {"theory", false, [](const RunResult& r) { return theory_json(r.theory); }},
    {"sensitivities", true, [](const RunResult& r) { return r.sensitivities ? sensitivities_json(*r.sensitivities) : Json(); }},
    {"uncertainty", true,
     [](const RunResult& r) { return r.sensitivities && r.scene.scenario().uncertainty ? uncertainty_json(r) : Json(); }},
    {"ledger", true, [](const RunResult& r) { return r.ledger ? ledger_json(*r.ledger) : Json(); }},
    {"effects", false, [](const RunResult& r) { return effects_json(r.modelled); }},
    {"selection", true, [](const RunResult& r) { return r.selection ? selection_json(*r.selection) : Json(); }},
    {"accuracy", true, [](const RunResult& r) { return r.accuracy ? accuracy_json(*r.accuracy) : Json(); }},
    {"notes", false, [](const RunResult& r) -> Json { return r.notes; }},
    {"scenario", false, [](const RunResult& r) { return json_of(canonical_json(r.scene.scenario())); }},
    {"provenance", false, [](const RunResult& r) { return provenance_json(r.scene); }},
};

}  // namespace

std::string summary_json(const RunResult& result) {
  Json summary = Json::object();
  for (const Section& section : kSections) {
    Json json = section_json(section, result);
    if (!section.optional || !json.is_null()) summary[section.name] = std::move(json);
  }
  return dump(summary);
}

std::optional<Json> summary_section(const RunResult& result, std::string_view name) {
  for (const Section& section : kSections)
    if (section.name == name) return section_json(section, result);
  return std::nullopt;
}

std::string timing_json(const RunResult& result) {
  return dump({{"solution_s", result.solution.seconds},
               {"certificate_s", result.certificate.seconds},
               {"selection_s", result.selection ? Json(result.selection->seconds) : Json()},
               {"written_utc", utc_now()},
               {"host", host_name()}});
}

}  // namespace earthtop
