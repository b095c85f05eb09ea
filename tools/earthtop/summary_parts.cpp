// SPDX-License-Identifier: GPL-3.0-or-later
#include "summary_parts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/results/results.hpp"
#include "number_text.hpp"
#include "text/number_words.hpp"
#include "text/shell_word.hpp"

namespace earthtop::tool {
namespace {

constexpr double kArcsecond = std::numbers::pi / (180 * 3600.0);

/// When an interval of the verdict is: "from 2 s on", "from 2 to 3 s", with as many digits as tell its ends apart.
std::string span_of(const VerdictInterval& interval) {
  if (!interval.until_s) return fmt::format("from {:.6g} s on", interval.from_s);
  int digits = 6;
  const auto end = [&](double t_s) { return fmt::format("{:.{}g}", t_s, digits); };
  constexpr int kAll = 17;
  while (digits < kAll && end(interval.from_s) == end(*interval.until_s)) ++digits;
  return fmt::format("from {} to {} s", end(interval.from_s), end(*interval.until_s));
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + spoken(name);
  return text.empty() ? "nothing" : text;
}

}  // namespace

std::string pictured(double rad) {
  const double arcseconds = rad / kArcsecond;
  const double size = std::abs(arcseconds);
  if (size >= 3600) return fmt::format("{:.5g}°", arcseconds / 3600);
  if (size >= 0.1 || size == 0) return fmt::format("{:.5g} arcsec", arcseconds);
  if (size >= 1e-4) return fmt::format("{:.5g} milliarcsec", arcseconds * 1e3);
  return fmt::format("{:.5g} microarcsec", arcseconds * 1e6);
}

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

DriftSummary reliable_drift(const RunResult& result) {
  if (is_all_reliable(result)) return result.drift;
  std::vector<DriftRow> rows = result.rows;
  std::erase_if(rows, [](const DriftRow& row) { return !row.drift_reliable; });
  return summarize_drift(rows, result.scene.rotation_rate_rad_s());
}

bool judges_rotor_axis(const RunResult& result) {
  const auto& rotor = result.scene.scenario().rotor;
  return rotor && (rotor->axis[0] != 0 || rotor->axis[1] != 0 || rotor->axis[2] < 0);
}

void write_lines(TextPage& page, const std::vector<LabelledLine>& lines) {
  for (const LabelledLine& line : lines) page.entry(line.label, line.is_warning ? page.warning(line.text) : line.text);
}

void write_verdict(TextPage& page, const RunResult& result) {
  const VerdictReport& verdict = result.verdict;
  std::string text = spoken(std::string(to_string(verdict.verdict)));
  const char* link = " ";
  if (verdict.verdict != Verdict::unassessed)
    for (const VerdictInterval& interval : verdict.intervals)
      if (type_of(interval.why).of_verdict) text += std::exchange(link, " and ") + span_of(interval);
  page.entry("Verdict", verdict.from_s || verdict.verdict == Verdict::unassessed ? page.warning(text) : text);
  page.entry("", verdict.reason);
  for (const VerdictInterval& interval : verdict.intervals)
    if (const DoubtType& doubt = type_of(interval.why); !doubt.of_verdict)
      page.entry("", page.warning(fmt::format("{} the drift is not to be trusted: {}", span_of(interval), doubt.words)));
}

void write_stops(TextPage& page, const RunResult& result) {
  for (const StopEvent& stop : result.stops)
    page.entry("At rest", fmt::format("the {} prediction, by dry friction, at t = {}",
                                      stop.prediction == Prediction::rotating ? "rotating" : "non-rotating",
                                      time_with_bound(stop.t_s, stop.bound_s)));
}

void write_choice(TextPage& page, const RunResult& result) {
  if (const auto& selection = result.selection) {
    page.entry("Effects", fmt::format("switched on: {}; left out: {}, worth {:.1e} rad at most ({:.2g} s to choose)",
                                      listed(selection->switched_on), listed(selection->left_out),
                                      selection->left_out_drift_rad, selection->seconds));
  }
}

void write_accuracy(TextPage& page, const RunResult& result) {
  if (const auto& accuracy = result.accuracy; accuracy && std::isfinite(accuracy->reached_rad)) {
    const auto [asked, reached] = told_apart(accuracy->asked_rad, accuracy->reached_rad, 2, 'e');
    const std::string text =
        fmt::format("{} rad asked for, {} rad {}", asked, reached, accuracy->reached() ? "reached" : "NOT reached");
    page.entry("Accuracy", accuracy->reached() ? text : page.warning(text));
  }
}

void write_threshold(TextPage& page, const RunResult& result) {
  const std::optional<ThresholdCrossing>& crossing = result.drift.threshold_crossing;
  if (!crossing || !result.scene.scenario().threshold_rad) return;
  const std::optional<double>& time = result.drift.threshold_time_s;
  const std::string threshold = fmt::format("{} rad {}", *result.scene.scenario().threshold_rad,
                                            result.drift.headline == GimbalHeadline::outer   ? "of the outer angle "
                                            : result.drift.headline == GimbalHeadline::inner ? "of the inner angle "
                                            : judges_rotor_axis(result)                      ? "of the rotor's axis "
                                                                                             : "");
  const std::string computed = time ? fmt::format(", as computed at t = {:.9g} s", *time) : ", as computed not passed";
  switch (*crossing) {
    case ThresholdCrossing::not_reached: page.entry("Threshold", threshold + "not reached"); break;
    case ThresholdCrossing::clear:
      page.entry("Threshold", fmt::format("{}passed at t = {}", threshold,
                                          time_with_bound(time.value_or(0), result.drift.threshold_time_bound_s)));
      break;
    case ThresholdCrossing::tangential:
      page.entry("Threshold", page.warning(threshold + "only touched" + computed));
      page.entry("", page.warning(
                         "the drift turns back within its error of the threshold, so whether and when it passes is not known"));
      break;
    case ThresholdCrossing::uncertain:
      page.entry("Threshold", page.warning(threshold + "passed or not" + computed));
      page.entry("", page.warning("the drift stays within its error of the threshold until the run ends, its bound cannot "
                                  "decide, or it is not to be "
                                  "trusted there"));
      break;
  }
}

void write_headline(TextPage& page, const HeadlineCheck& check, const RunResult& result, bool changed) {
  const std::string quantity =
      check.at_s ? fmt::format("{} at {}", check.stated.quantity, time_text(*check.at_s)) : check.stated.quantity;
  const std::string stated = fmt::format("{} = {:.12g} ± {:.1g}", quantity, check.stated.value, check.stated.tolerance);
  if (!check.difference) {
    const std::string why = result.status != RunStatus::completed && check.at_s
                                ? fmt::format("the run stopped at {}", time_text(result.reached_s))
                                : std::string("this run has no such number");
    page.entry("Headline", page.warning(fmt::format("{}: not compared, {}", stated, why)));
    return;
  }
  const std::string off = fmt::format("off by {:.1e}", *check.difference);
  if (check.met)
    page.entry("Headline", fmt::format("{}: met, {}", stated, off));
  else if (changed)
    page.entry("Headline", fmt::format("{}: differs, as the scenario was changed ({})", stated, off));
  else
    page.entry("Headline", page.warning(fmt::format("{}: NOT MET ({})", stated, off)));
}

void write_status(TextPage& page, const RunResult& result) {
  if (result.status != RunStatus::completed)
    page.entry("Stopped",
               page.warning(fmt::format("{} at t = {} of {}", spoken(std::string(to_string(result.status))),
                                        time_text(result.reached_s), time_text(result.scene.scenario().duration_s))));
}

void write_known_to(TextPage& page, const RunResult& result) {
  if (!result.sensitivities || !result.sensitivities->unavailable.empty() || !result.scene.scenario().uncertainty) return;
  const SensitivityReport& report = *result.sensitivities;
  if (!report.without_derivative.empty())
    return page.entry("Known to",
                      page.warning(fmt::format("not known: there is no derivative by {}", report.without_derivative)));
  const DriftRow* row = last_reliable_row(result);
  page.entry("Known to", fmt::format("{:.6e} rad ± {:.1e} from the inputs (standard error) ± {:.1e} from the numerics (bound)",
                                     row->drift_axis_rad, report.axis_error_rad, row->drift_axis_bound_rad));
}

void write_notes(TextPage& page, const RunResult& result) {
  for (const std::string& note : result.notes) page.entry("Note", page.warning(printable(note)));
}

void write_end(TextPage& page, const Written& where, bool is_brief) {
  page.entry("Written", printable(where.directory) +
                            (where.taken.empty() ? "" : fmt::format(", as {} holds other results", printable(where.taken))));
  page.entry("More",
             is_brief ? "with --long; or as a page that shows the top in motion:" : "as a page that shows the top in motion:");
  page.line("            earthtop report {}", shell_word(where.directory));
}

}  // namespace earthtop::tool
