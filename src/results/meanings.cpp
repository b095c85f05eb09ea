// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/meanings.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

#include "results/unit_of_name.hpp"
#include "scenario/fields.hpp"

namespace earthtop {
namespace {

using Phrase = std::pair<std::string_view, std::string_view>;

/// A key that ends with a star stands for all paths that begin so; an element of a list is 0. The first that fits holds. The bound of a
/// number needs no phrase of its own.
constexpr std::array kPhrases = {
    Phrase("name", "name of the scenario"),
    Phrase("title", "its title"),
    Phrase("outcome.status", "how the run ended"),
    Phrase("outcome.reached_s", "time that was reached"),
    Phrase("outcome.rows", "number of rows"),
    Phrase("matching_rule.rates_relative_to", "frame whose rates both motions share at the release"),
    Phrase("matching_rule.statement", "what both motions have in common at the release"),
    Phrase("drift.axis_final_rad", "drift of the axis at the end"),
    Phrase("drift.axis_max_rad", "largest drift of the axis"),
    Phrase("drift.axis_max_at_s", "time of the axis's largest drift"),
    Phrase("drift.axis_rad", "drift of the axis"),
    Phrase("drift.attitude_final_rad", "drift of the attitude at the end"),
    Phrase("drift.attitude_rad", "drift of the attitude"),
    Phrase("drift.spin_final_rad", "drift of the turn about the axis at the end"),
    Phrase("drift.azimuth_final_rad", "drift of the axis's azimuth at the end (clockwise from above)"),
    Phrase("drift.azimuth_max_rad", "largest drift of the azimuth"),
    Phrase("drift.azimuth_max_at_s", "time of the azimuth's largest drift"),
    Phrase("drift.tilt_final_rad", "drift of the axis's tilt at the end"),
    Phrase("drift.tilt_max_rad", "largest drift of the tilt"),
    Phrase("drift.tilt_max_at_s", "time of the tilt's largest drift"),
    Phrase("drift.tip_final_m", "drift of the contact point at the end"),
    Phrase("drift.tip_final_x_m", "drift of the contact point at the end (to the east)"),
    Phrase("drift.tip_final_y_m", "drift of the contact point at the end (to the north)"),
    Phrase("drift.tip_max_m", "largest drift of the contact point"),
    Phrase("drift.tip_max_at_s", "time of the contact point's largest drift"),
    Phrase("drift.tip_m", "drift of the contact point"),
    Phrase("drift.rotor_axis_final_rad", "drift of the rotor's axis at the end"),
    Phrase("drift.rotor_axis_max_rad", "largest drift of the rotor's axis"),
    Phrase("drift.rotor_axis_max_at_s", "time of the largest drift of the rotor's axis"),
    Phrase("drift.rotor_axis_rad", "drift of the rotor's axis"),
    Phrase("drift.outer_angle_final_rad", "drift of the outer gimbal's angle at the end"),
    Phrase("drift.outer_angle_max_rad", "largest drift of the outer gimbal's angle"),
    Phrase("drift.outer_angle_max_at_s", "time of the largest drift of the outer gimbal's angle"),
    Phrase("drift.outer_angle_rad", "drift of the outer gimbal's angle"),
    Phrase("drift.inner_angle_final_rad", "drift of the inner gimbal's angle at the end"),
    Phrase("drift.inner_angle_max_rad", "largest drift of the inner gimbal's angle"),
    Phrase("drift.inner_angle_max_at_s", "time of the largest drift of the inner gimbal's angle"),
    Phrase("drift.inner_angle_rad", "drift of the inner gimbal's angle"),
    Phrase("drift.axis_final_over_earth_angle", "drift of the axis at the end over the angle by which the Earth has turned"),
    Phrase("drift.verdict", "whether the drift is to be trusted"),
    Phrase("drift.verdict_from_s", "time from which the verdict holds"),
    Phrase("drift.verdict_reason", "why"),
    Phrase("drift.verdict_intervals.0.from_s", "beginning of an interval in which the drift is not to be trusted"),
    Phrase("drift.verdict_intervals.0.until_s", "end of an interval in which the drift is not to be trusted"),
    Phrase("drift.verdict_intervals.0.why", "its kind of doubt"),
    Phrase("drift.verdict_intervals.0.text", "the doubt in words"),
    Phrase("drift.reliable.until_s", "time up to which the drift is reliable"),
    Phrase("drift.reliable.at_s", "time of the last reliable row"),
    Phrase("drift.reliable.axis_rad", "drift of the axis in the last reliable row"),
    Phrase("drift.reliable.attitude_rad", "drift of the attitude in the last reliable row"),
    Phrase("drift.secular.azimuth_rate_rad_s", "trend of the azimuth's drift"),
    Phrase("drift.secular.azimuth_rate_bound_95_rad_s", "half of the 95 % interval of the trend of the azimuth's drift"),
    Phrase("drift.secular.mean_precession_rate_change_rad_s",
           "change of the mean precession rate, counterclockwise from above"),
    Phrase("drift.secular.turns_seen", "turns of the axis about the vertical that the trend comes from"),
    Phrase("drift.secular.mean_of_window", "whether the trend is a mean over the whole run"),
    Phrase("drift.secular.window_s.0", "beginning of the time that the trend comes from"),
    Phrase("drift.secular.window_s.1", "end of the time that the trend comes from"),
    Phrase("drift.secular.reason", "why there is no trend"),
    Phrase("drift.oscillation.azimuth_rad", "largest distance of the azimuth's drift from its trend"),
    Phrase("drift.oscillation.azimuth_at_s.0", "time at which the azimuth's drift is farthest below its trend"),
    Phrase("drift.oscillation.azimuth_at_s.1", "time at which the azimuth's drift is farthest above its trend"),
    Phrase("drift.threshold_rad", "the scenario's threshold of the drift"),
    Phrase("drift.threshold_time_s", "time at which the drift first passes its threshold"),
    Phrase("drift.threshold_crossing", "what became of the threshold"),
    Phrase("drift.digits.axis_final_rad", "drift of the axis at the end with all digits, as text"),
    Phrase("drift.digits.axis_max_rad", "largest drift of the axis with all digits, as text"),
    Phrase("drift.digits.attitude_final_rad", "drift of the attitude at the end with all digits, as text"),
    Phrase("drift.digits.spin_final_rad", "drift of the spin's angle at the end with all digits, as text"),
    Phrase("motion.axis_final_L.0", "direction of the axis at the end (to the east)"),
    Phrase("motion.axis_final_L.1", "direction of the axis at the end (to the north)"),
    Phrase("motion.axis_final_L.2", "direction of the axis at the end (upward)"),
    Phrase("motion.reference_axis_final_L.0", "direction of the prediction's axis at the end (to the east)"),
    Phrase("motion.reference_axis_final_L.1", "direction of the prediction's axis at the end (to the north)"),
    Phrase("motion.reference_axis_final_L.2", "direction of the prediction's axis at the end (upward)"),
    Phrase("motion.axis_mean_L.0", "mean of the axis's direction over the rows (to the east)"),
    Phrase("motion.axis_mean_L.1", "mean of the axis's direction over the rows (to the north)"),
    Phrase("motion.axis_mean_L.2", "mean of the axis's direction over the rows (upward)"),
    Phrase("motion.reference_axis_mean_L.0", "mean of the prediction's axis over the rows (to the east)"),
    Phrase("motion.reference_axis_mean_L.1", "mean of the prediction's axis over the rows (to the north)"),
    Phrase("motion.reference_axis_mean_L.2", "mean of the prediction's axis over the rows (upward)"),
    Phrase("motion.spin_final_rad_s", "spin at the end"),
    Phrase("motion.reference_spin_final_rad_s", "the prediction's spin at the end"),
    Phrase("motion.spin_reached_s", "time at which the spin first comes to report.until_spin_rad_s"),
    Phrase("motion.spin_reached_is_sure", "whether that is sure"),
    Phrase("motion.reference_spin_reached_s", "time at which the prediction's spin comes to report.until_spin_rad_s"),
    Phrase("motion.reference_spin_reached_is_sure", "whether that is sure"),
    Phrase("motion.tilt_reached_s", "time at which the tilt first comes to report.until_tilt_deg"),
    Phrase("motion.tilt_reached_is_sure", "whether that is sure"),
    Phrase("motion.reference_tilt_reached_s", "time at which the prediction's tilt comes to report.until_tilt_deg"),
    Phrase("motion.reference_tilt_reached_is_sure", "whether that is sure"),
    Phrase("motion.swing.major_start_rad", "larger semi-axis of a pendulum's swing at the release"),
    Phrase("motion.swing.minor_start_rad", "smaller semi-axis of a pendulum's swing at the release"),
    Phrase("motion.swing.major_end_rad", "larger semi-axis of a pendulum's swing at the end"),
    Phrase("motion.swing.minor_end_rad", "smaller semi-axis of a pendulum's swing at the end"),
    Phrase("motion.swing.plane_rate_rad_s", "mean rate at which the plane of the swing turns, clockwise from above"),
    Phrase("motion.swing.apsidal_rate_rad_s", "mean rate at which the prediction's plane of the swing turns"),
    Phrase("rotor.rate_initial_rad_s", "the rotor's rate relative to the body at the release"),
    Phrase("rotor.rate_final_rad_s", "the rotor's rate relative to the body at the end"),
    Phrase("rotor.angle_final_rad", "the rotor's angle at the end"),
    Phrase("growth_of_disturbances.lyapunov_exponent_1_s", "mean rate at which disturbances grow (1/s)"),
    Phrase("growth_of_disturbances.round_off_grown_s", "when rounding has grown to the size of the motion"),
    Phrase("growth_of_disturbances.earth_grown_s", "when the Earth's disturbance has grown to the size of the motion"),
    Phrase("gimbal_events.0.type", "what happens in the gimbals"),
    Phrase("gimbal_events.0.t_s", "time of an event in the gimbals"),
    Phrase("gimbal_events.0.bound_s", "bound on the error of the time of an event in the gimbals"),
    Phrase("gimbal_events.0.axis_angle_rad", "angle between the rotor's and the outer axis then"),
    Phrase("gimbal_events.0.outer_rate_rad_s", "rate of the outer gimbal then"),
    Phrase("stops.0.prediction", "motion that friction stops: rotating or reference"),
    Phrase("stops.0.t_s", "time at which friction stops the motion"),
    Phrase("stops.0.bound_s", "bound on the error of the time at which friction stops the motion"),
    Phrase("notes.0", "a note on the run"),
    Phrase("headline.quantity", "quantity of the scenario's headline figure"),
    Phrase("headline.at_s", "its time"),
    Phrase("headline.stated", "its value as stated"),
    Phrase("headline.tolerance", "the tolerance stated"),
    Phrase("headline.computed", "its value as computed"),
    Phrase("headline.difference", "computed minus stated"),
    Phrase("headline.met", "whether it is met"),
    Phrase("headline.origin", "where it comes from"),
    Phrase("solution.*", "of the solution: how it was integrated, and its work"),
    Phrase("certificate.*", "of the second integration, from which bounds come: how, and its work"),
    Phrase("attitude_bound_rad", "bound on the error of the attitudes"),
    Phrase("invariants.0.name", "a conserved quantity"),
    Phrase("invariants.0.unit", "its unit"),
    Phrase("invariants.0.initial", "its value at the release"),
    Phrase("invariants.0.largest_change", "its largest change"),
    Phrase("invariants.0.scale", "the size with which the change is compared"),
    Phrase("theory.0.name", "a prediction of first order"),
    Phrase("theory.0.statement", "what it says"),
    Phrase("theory.0.unit", "its unit"),
    Phrase("theory.0.predicted", "the predicted value"),
    Phrase("theory.0.predicted_error", "its error"),
    Phrase("theory.0.applies", "whether it applies"),
    Phrase("theory.0.computed", "the computed value"),
    Phrase("theory.0.computed_error", "its error"),
    Phrase("why.0.name", "a sentence on the motion"),
    Phrase("why.0.text", "the sentence"),
    Phrase("why.0.numbers*", "a number in it"),
    Phrase("ledger.observer", "observer whose torques are listed"),
    Phrase("ledger.tau_phys_max_N_m", "largest physical torque"),
    Phrase("ledger.tau_cor_max_N_m", "largest Coriolis torque"),
    Phrase("ledger.tau_trans_max_N_m", "largest transverse torque"),
    Phrase("ledger.tau_cent_max_N_m", "largest centrifugal torque"),
    Phrase("ledger.dL_dt_max_N_m", "largest derivative of the angular momentum"),
    Phrase("ledger.residual_max_N_m", "largest residual of the balance"),
    Phrase("ledger.residual_over_largest_torque", "that over the largest torque"),
    Phrase("ledger*", "a torque of the ledger"),
    Phrase("effects*", "what is modelled, or left out"),
    Phrase("selection.accuracy_rad", "accuracy for which effects were chosen"),
    Phrase("selection.left_out_drift_rad", "drift by what was left out"),
    Phrase("selection*", "how effects were chosen"),
    Phrase("accuracy.asked_rad", "error of the drift that was asked for"),
    Phrase("accuracy.reached_rad", "error of the drift that was reached"),
    Phrase("accuracy.reached", "whether it was reached"),
    Phrase("accuracy.attempts*", "how often it was tried"),
    Phrase("contact.events.0.event", "what happens on the table"),
    Phrase("contact.events.0.t_s", "time of an event on the table"),
    Phrase("contact.events.0.bound_s", "bound on the error of the time of an event on the table"),
    Phrase("contact.events.0.prediction", "in which motion: rotating or reference"),
    Phrase("contact.events.0.time_difference_s", "time of an event on the table minus that in the prediction"),
    Phrase("contact.prediction_changes.0.input", "an input of the friction"),
    Phrase("contact.prediction_changes.0.step", "by how much it is changed"),
    Phrase("contact.prediction_changes.0.axis_rad", "how far the prediction's axis then moves"),
    Phrase("contact.prediction_changes.0.tip_m", "how far its contact point moves"),
    Phrase("contact.prediction_changes.0.at_s", "when"),
    Phrase("contact.jellett*", "balance of Jellett's integral"),
    Phrase("contact.work*", "balance of the Jacobi integral and the work of friction"),
    Phrase("sensitivities.at_s", "time of the derivatives"),
    Phrase("sensitivities.unavailable", "why there are none"),
    Phrase("sensitivities.per", "what they are taken by"),
    Phrase("sensitivities.inputs.0.name", "an input"),
    Phrase("sensitivities.inputs.0.value", "its value"),
    Phrase("sensitivities.inputs.0.d_axis_rad", "derivative of the axis's drift by it"),
    Phrase("sensitivities.inputs.0.d_attitude_rad", "derivative of the attitude's drift"),
    Phrase("sensitivities.inputs.0.d_tilt_rad", "derivative of the tilt's drift"),
    Phrase("sensitivities.inputs.0.d_azimuth_rad", "derivative of the azimuth's drift"),
    Phrase("sensitivities.inputs.0.axis_error_rad", "error of the axis's drift that comes from it"),
    Phrase("sensitivities.inputs.0.unavailable", "why there is none"),
    Phrase("sensitivities*", "derivatives of the drift by the inputs"),
    Phrase("uncertainty.unavailable", "why there is none"),
    Phrase("uncertainty.axis_rad", "standard uncertainty of the axis's drift"),
    Phrase("uncertainty.from_inputs_rad", "part of the inputs in the uncertainty of the axis's drift"),
    Phrase("uncertainty.from_numerics_rad", "part of the numerics in the uncertainty of the axis's drift"),
    Phrase("uncertainty.largest_from", "the input that gives most of it"),
    Phrase("top.mass_kg", "mass of the top"),
    Phrase("top.spin_rad_s", "spin at the release"),
    Phrase("top.rotor_spin_rad_s", "the rotor's rate at the release"),
    Phrase("top.rotor_momentum_kg_m2_s", "the rotor's momentum about its axis"),
    Phrase("top.slow_precession_rad_s", "rate of the slow steady precession"),
    Phrase("top.slow_precession_period_s", "period of the slow steady precession"),
    Phrase("top.fast_precession_rad_s", "rate of the fast steady precession"),
    Phrase("top.fast_precession_period_s", "period of the fast steady precession"),
    Phrase("top.mean_precession_rad_s", "mean rate of the precession from this release"),
    Phrase("top.mean_precession_period_s", "mean period of the precession from this release"),
    Phrase("top.nutation_rad_s", "rate of the nutation"),
    Phrase("top.nutation_period_s", "period of the nutation"),
    Phrase("top.nutation_kind", "its kind"),
    Phrase("top.critical_spin_rad_s", "least spin of a sleeping top"),
    Phrase("top.spin_over_critical", "spin over the least spin of a sleeping top"),
    Phrase("top.rim_speed_m_s", "speed of the rim"),
    Phrase("top.gimbals.outer_moment_kg_m2", "moment about the outer gimbal's axis"),
    Phrase("top.gimbals.inner_moment_kg_m2", "moment about the inner gimbal's axis"),
    Phrase("top.gimbals.slow_period_s", "period of the slow swing"),
    Phrase("top.gimbals.fast_period_s", "period of the fast swing"),
    Phrase("top.gimbals.outer_rest_rad", "angle of rest of the outer gimbal"),
    Phrase("top.gimbals.inner_rest_rad", "angle of rest of the inner gimbal"),
    Phrase("top.gimbals.earth_torque_N_m", "torque by which the Earth's rotation acts"),
    Phrase("top.gimbals.earth_offset_m", "offset of the centre of mass with the same effect"),
    Phrase("top.gimbals.earth_nutation_rad", "nutation that the Earth's rotation excites"),
    Phrase("travel.length_m", "length of the journey"),
    Phrase("travel.end_latitude_deg", "latitude at its end"),
    Phrase("travel.end_longitude_deg", "longitude at its end"),
    Phrase("travel.end_height_m", "height at its end"),
    Phrase("travel.transport_rate_rad_s", "largest rate at which East, North and Up turn over the Earth"),
    Phrase("travel.transport_over_earth", "that rate over the Earth's"),
    Phrase("travel.plumb_lean_rad", "largest lean of the plumb line aboard"),
    Phrase("travel.false_north_start_rad", "azimuth at which a level compass settles, at the start"),
    Phrase("travel.false_north_end_rad", "azimuth at which a level compass settles, at the end"),
    Phrase("travel.wander_rad_s", "rate of a level free axis in azimuth, at the start"),
    Phrase("travel.transport_wander_rad_s", "the part of it that the journey makes"),
    Phrase("travel.table_noise_m_s2", "acceleration that one unit in the last digit of the journey's table makes"),
    Phrase("travel.schuler_kappa", "Schuler's number of a pendulous compass"),
    Phrase("travel.schuler_period_s", "its undamped period"),
    Phrase("travel*", "figure of the journey"),
    Phrase("top*", "figure of the top to check against a balance, a ruler and a stopwatch"),
    Phrase("provenance.program", "name of the program"),
    Phrase("provenance.version", "its version"),
    Phrase("provenance.commit", "commit of its source"),
    Phrase("provenance.compiler", "its compiler"),
    Phrase("provenance.flags", "the compiler's flags"),
    Phrase("provenance.scenario_sha256", "hash of the scenario"),
    Phrase("provenance.constants.0.name", "a constant that was used"),
    Phrase("provenance.constants.0.value", "its value"),
    Phrase("provenance.constants.0.unit", "its unit"),
    Phrase("provenance.constants.0.source", "its source"),
    Phrase("provenance*", "libraries and their versions"),
};

std::string_view phrase_of(std::string_view path) {
  for (const auto& [key, phrase] : kPhrases)
    if (key.ends_with('*') ? path.starts_with(key.substr(0, key.size() - 1)) : path == key) return phrase;
  return "";
}

/// The key of a scenario at "scenario.release.tilt_deg"; the one that holds it where it has no entry; null where there is none.
const input::Field* field_at(std::string_view path) {
  std::string pattern;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string_view step = path.substr(0, dot);
    const bool number = std::all_of(step.begin(), step.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    pattern += "/" + (number ? std::string("*") : std::string(step));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  for (; !pattern.empty(); pattern.resize(pattern.rfind('/')))
    if (const input::Field* field = scenario::fields().find(pattern)) return field;
  return nullptr;
}

bool is_of_scenario_text(std::string_view path) { return path.starts_with("scenario."); }

}  // namespace

std::string unit_of_path(std::string_view path) {
  if (is_of_scenario_text(path))
    if (const input::Field* field = field_at(path.substr(path.find('.') + 1))) return std::string(field->unit);
  while (!path.empty() && (std::isdigit(static_cast<unsigned char>(path.back())) != 0 || path.back() == '.'))
    path.remove_suffix(1);
  return std::string(unit_of_name(path));
}

std::string meaning_of_path(std::string_view path) {
  if (is_of_scenario_text(path)) {
    const input::Field* field = field_at(path.substr(path.find('.') + 1));
    return field ? std::string(field->doc) : "";
  }
  if (const std::string_view phrase = phrase_of(path); !phrase.empty()) return std::string(phrase);
  constexpr std::string_view kBound = "_bound";
  if (const std::size_t at = path.rfind(kBound); at != path.npos) {
    const std::string base = std::string(path.substr(0, at)) + std::string(path.substr(at + kBound.size()));
    if (const std::string_view phrase = phrase_of(base); !phrase.empty())
      return "bound on the error of: " + std::string(phrase);
  }
  return "";
}

namespace {

/// A name without its unit, as words: "spin_rad_s" -> "spin".
std::string words_of_name(std::string_view name, std::string_view unit) {
  constexpr auto is_same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  const std::string_view own = unit_of_name(name);
  std::string ending;
  for (const std::string_view given : {unit, own}) {
    ending = "_";
    for (const char c : given)
      if (c != '^') ending += c == ' ' || c == '/' ? '_' : c;
    if (given == "1/s") ending = "_1_s";
    if (!given.empty() && name.size() > ending.size() && std::equal(ending.rbegin(), ending.rend(), name.rbegin(), is_same)) {
      name.remove_suffix(ending.size());
      break;
    }
  }
  std::string words;
  for (const char c : name) words += c == '_' || c == '.' ? ' ' : c;
  return words;
}

bool is_index(std::string_view step) {
  return !step.empty() && std::all_of(step.begin(), step.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

QuantityWords words_of_setting(std::string_view name, std::string_view pointer) {
  std::string path(pointer.substr(std::min<std::size_t>(1, pointer.size())));
  std::replace(path.begin(), path.end(), '/', '.');
  const input::Field* field = path.empty() ? nullptr : field_at(path);
  const std::string_view unit = field ? field->unit : unit_of_name(name);
  if (!name.empty() && name.front() != '/') return {words_of_name(name, unit), std::string(unit)};
  std::string_view key = pointer.substr(pointer.rfind('/') + 1), number;
  if (is_index(key)) {
    number = key;
    const std::string_view list = pointer.substr(0, pointer.rfind('/'));
    key = list.substr(list.rfind('/') + 1);
  }
  std::string words = words_of_name(key, unit);
  if (!number.empty()) words += " " + std::to_string(std::stoul(std::string(number)) + 1);
  return {std::move(words), std::string(unit)};
}

QuantityWords words_of_quantity(std::string_view name, std::string_view path) {
  std::string unit = unit_of_path(path);
  std::string words = name == path ? meaning_of_path(path) : words_of_name(name, unit);
  return {words.empty() ? words_of_name(name, unit) : std::move(words), std::move(unit)};
}

std::string unit_in_signs(std::string_view unit) {
  if (unit == "deg") return "°";
  std::string signs;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (unit[i] == '^' && i + 1 < unit.size() && (unit[i + 1] == '2' || unit[i + 1] == '3'))
      signs += unit[++i] == '2' ? "²" : "³";
    else
      signs += unit[i];
  }
  return signs;
}

}  // namespace earthtop
