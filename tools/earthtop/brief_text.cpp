// SPDX-License-Identifier: GPL-3.0-or-later
// The short text on a run.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact_text.hpp"
#include "earthtop/results/results.hpp"
#include "number_text.hpp"
#include "results/compared_words.hpp"
#include "summary_parts.hpp"
#include "summary_text.hpp"
#include "text/number_words.hpp"

namespace earthtop::tool {
namespace {

/// The quantity that the verdict follows, in words, its drift and the bound.
struct Headline {
  std::string what;
  double drift_rad, bound_rad;
};
Headline headline_of(const RunResult& result, const DriftRow& row) {
  if (const auto& gimbals = row.gimbals; gimbals && gimbals->headline == GimbalHeadline::outer)
    return {"outer gimbal's angle", gimbals->drift_outer_angle_rad, gimbals->drift_outer_angle_bound_rad};
  if (const auto& gimbals = row.gimbals; gimbals && gimbals->headline == GimbalHeadline::inner)
    return {"inner gimbal's angle", gimbals->drift_inner_angle_rad, gimbals->drift_inner_angle_bound_rad};
  if (row.rotor && judges_rotor_axis(result))
    return {"rotor's axis", row.rotor->drift_axis_rad, row.rotor->drift_axis_bound_rad};
  return {"spin axis", row.drift_axis_rad, row.drift_axis_bound_rad};
}

std::string drift_sentences(const RunResult& result, const TextPage& page) {
  if (!has_drift(result)) return "not known: the run has no row beyond the release";
  const DriftRow* last = last_reliable_row(result);
  if (last == nullptr || last->t_s == 0) return "none that can be trusted";
  const Headline headline = headline_of(result, *last);
  std::string text =
      fmt::format("after {} the {} is {} away from where it would be without {}: {}", time_text(last->t_s), headline.what,
                  page.strong(pictured(std::abs(headline.drift_rad))), compared_words(result.scene.scenario()).cause,
                  page.strong(with_bound(headline.drift_rad, headline.bound_rad, "rad")));
  const DriftSummary& drift = result.drift;
  const bool is_of_axis = headline.what == "spin axis";
  if (is_of_axis && result.verdict.trusts(drift.axis_max_at_s) && drift.axis_max_at_s < last->t_s)
    text += fmt::format("; at most {}, at {:.6g} s", pictured(drift.axis_max_rad), drift.axis_max_at_s);
  if (!is_of_axis) text += fmt::format("; the spin axis is {} away", pictured(last->drift_axis_rad));
  if (const auto tip = tip_drift_lines(result, *last, reliable_drift(result).tip_bound_m.value_or(0)); !tip.empty())
    text += "; the tip " + tip.front();
  if (last != &result.rows.back()) text += "; later rows are not reliable";
  return text;
}

std::size_t lines_of(std::string_view text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

/// The entries that may be left out, the last ones first: events on a table, and why the drift is what it is.
std::vector<std::string> optional_entries(const RunResult& result, const Screen& screen) {
  std::vector<std::string> entries;
  const auto add = [&](std::string_view label, const std::string& text) {
    TextPage entry(screen);
    entry.entry(label, text);
    entries.push_back(std::move(entry).text());
  };
  for (const LabelledLine& line : contact_event_lines(result))
    if (!line.is_warning) add(line.label, line.text);
  const char* label = "Why";
  for (const WhySentence& sentence : result.why) add(std::exchange(label, ""), sentence.text);
  return entries;
}

}  // namespace

std::string brief_text(const RunResult& result, const Written& where, bool changed, const Screen& screen,
                       std::string_view picture) {
  constexpr std::size_t kScreen = 24, kPrompts = 2;  // the command above, and the next one below
  const Scenario& scenario = result.scene.scenario();
  TextPage first(screen), last(screen);
  first.heading(printable(scenario.title.empty() ? scenario.name : scenario.title));
  write_status(first, result);
  first.entry("Drift", drift_sentences(result, first));
  write_verdict(first, result);
  write_known_to(first, result);
  write_stops(first, result);
  std::vector<LabelledLine> warnings = contact_event_lines(result);
  std::erase_if(warnings, [](const LabelledLine& line) { return !line.is_warning; });
  write_lines(first, warnings);
  write_accuracy(first, result);
  write_threshold(first, result);
  if (const auto check = check_headline(result); check && !changed && !(check->difference && check->met))
    write_headline(first, *check, result, changed);
  write_notes(first, result);
  write_end(last, where, true);
  std::string text = std::move(first).text();
  const std::string end = std::string(picture) + std::move(last).text();
  for (const std::string& entry : optional_entries(result, screen)) {
    if (lines_of(text) + lines_of(entry) + lines_of(end) + kPrompts > kScreen) break;
    text += entry;
  }
  return text + end;
}

}  // namespace earthtop::tool
