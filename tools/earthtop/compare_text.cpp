// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "screen.hpp"
#include "text/number_words.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

std::string_view verdict_word(const PairReport& pair) {
  if (!pair.refusal.empty()) return "REFUSED";
  return pair.passed() ? "same" : "DIFFERS";
}

std::string_view change_words(Change change) {
  switch (change) {
    case Change::none: return "none";
    case Change::within_errors: return "within both errors";
    case Change::above_errors: return "above both errors";
    case Change::unknown: return "";
  }
  return "";
}

constexpr std::size_t kWidestName = 100;  // bytes

/// A text of a report for a line of the terminal.
std::string shown(std::string_view text, std::size_t most = kLongestMessage) { return printable(shortened(text, most)); }

/// A line of prose, indented by two columns; it goes on with eight.
std::string indented(std::string_view text, std::size_t width) { return wrapped("  " + std::string(text), width, 8) + '\n'; }

/// Where a tolerance comes from, without the profile, which the last line of the text names.
std::string short_origin(const std::string& origin) { return origin.substr(0, origin.find(" (profile ")); }

std::string quantity_line(const QuantityVerdict& quantity, std::size_t width) {
  const char* verdict = quantity.passed ? "ok" : "FAILED";
  const std::string name = shown(quantity.name, kWidestName);
  if (!quantity.reason.empty()) return fmt::format("  {:6}  {:<{}}  {}\n", verdict, name, width, shown(quantity.reason));
  const auto [largest, tolerance] = told_apart(quantity.largest, quantity.tolerance, 3);
  // Of a tolerance of 0 there is no share.
  const std::string share = std::isfinite(quantity.share) ? told_apart(quantity.share, 1, 2).first : "-";
  std::string line = fmt::format("  {:6}  {:<{}}  {:>9}  {:>9}  {:>7}  {:<18}  {}", verdict, name, width, largest, tolerance,
                                 share, change_words(quantity.change), short_origin(quantity.origin));
  if (!quantity.where.empty() && quantity.largest > 0) line += "; largest at " + quantity.where;
  if (!quantity.first_violation.empty())
    line += fmt::format("; beyond it {} times, first at {}", quantity.violations, quantity.first_violation);
  return shown(line) + '\n';
}

std::string pair_text(const PairReport& pair, bool everything, std::size_t screen_width) {
  std::string text;
  if (!pair.name.empty()) text += fmt::format("{}: {}\n", shown(pair.name), verdict_word(pair));
  if (!pair.refusal.empty()) return text + indented(shown(pair.refusal), screen_width);
  for (const CompareFinding& finding : pair.findings)
    text += indented(fmt::format("FAILED  {}: {}", finding.kind, shown(finding.text)), screen_width);
  std::size_t width = 8;
  for (const QuantityVerdict& quantity : pair.quantities)
    if (everything || !quantity.passed) width = std::max(width, std::min(quantity.name.size(), kWidestName));
  bool has_header = false;
  for (const QuantityVerdict& quantity : pair.quantities) {
    if (!everything && quantity.passed) continue;
    if (!has_header)
      text += fmt::format("          {:<{}}  {:>9}  {:>9}  {:>7}  {:<18}  {}\n", "quantity", width, "largest", "tolerance",
                          "of it", "change", "tolerance from");
    has_header = true;
    text += quantity_line(quantity, width);
  }
  for (const std::string& hint : pair.hints) text += indented("hint: " + shown(hint), screen_width);
  for (const std::string& note : pair.notes) text += indented("note: " + shown(note), screen_width);
  if (everything || !pair.passed())
    for (const CostRatio& ratio : pair.cost) {
      std::string line = fmt::format("{}  {}: {:.4g} where the reference has {:.4g}", ratio.passed() ? "cost  " : "FAILED",
                                     ratio.name, ratio.candidate, ratio.reference);
      if (const auto times = share_of(ratio.candidate, ratio.reference))
        line += fmt::format(", {} times", told_apart(*times, ratio.limit.value_or(*times), 3).first);
      if (ratio.limit) line += fmt::format("; limit {} times", *ratio.limit);
      text += indented(line, screen_width);
    }
  return text;
}

/// What was compared: "compared from 0 to 60 s, 101 of 601 rows".
std::string compared_words(const CompareReport& report) {
  std::uint64_t compared = 0, of = 0;
  bool has_rows = false, has_points = false;
  double from_s = HUGE_VAL, to_s = -HUGE_VAL;
  for (const PairReport& pair : report.pairs) {
    compared += pair.rows;
    of += pair.span.of;
    (pair.span.are_points ? has_points : has_rows) = true;
    if (pair.span.are_points || pair.rows == 0) continue;
    from_s = std::min(from_s, pair.span.from_s), to_s = std::max(to_s, pair.span.to_s);
  }
  const char* noun = has_points && !has_rows ? "points" : "rows";
  if (compared == 0) return fmt::format("none of {} {} compared", of, noun);
  const std::string span = from_s <= to_s ? fmt::format(" from {:.10g} to {},", from_s, time_text(to_s)) : "";
  return fmt::format("compared{} {} of {} {}", span, compared, of, noun);
}

}  // namespace

std::string engine_fit_text(const EngineFit& fit, const Screen& screen) {
  std::string text = wrapped(fmt::format("{} against {}: {} rows, all of the same weight, since the file states no errors",
                                         shown(fit.file, kLongestFileName), shown(fit.scenario), fit.rows),
                             screen.width, 2) +
                     '\n';
  text += indented(fmt::format("as given: the differences are {:.3g} rad (root mean square; rates divided by the fastest one)",
                               fit.given_rms_rad),
                   screen.width);
  if (!fit.reason.empty()) return text + indented("no fit: " + shown(fit.reason), screen.width);
  if (fit.fitted_rms_rad) text += indented(fmt::format("fitted: {:.3g} rad", *fit.fitted_rms_rad), screen.width);
  for (const EngineFit::Number& number : fit.numbers)
    if (number.estimate)
      text += indented(fmt::format("{} {:.9g} {} (the scenario has {:.9g})", shown(number.name), *number.estimate, number.unit,
                                   number.given),
                       screen.width);
  return text;
}

std::string compare_text(const CompareReport& report, bool everything, const Screen& screen) {
  std::string details;
  for (const PairReport& pair : report.pairs) {
    if (report.pairs.size() == 1 || everything || !pair.passed()) details += pair_text(pair, everything, screen.width);
  }
  const std::string_view profile = to_string(report.profile);
  const std::string tolerances =
      report.tolerances_file.empty()
          ? fmt::format("profile {}", profile)
          : fmt::format("{} on profile {}", shown(report.tolerances_file, kLongestFileName), profile);
  const std::string_view verdict = report.refused() ? "REFUSED" : report.passed() ? "same" : "DIFFERS";
  std::string text = wrapped(fmt::format("{}: {} against {} ({}; {})", verdict, shown(report.candidate, kLongestFileName),
                                         shown(report.reference, kLongestFileName), tolerances, compared_words(report)),
                             screen.width, 2) +
                     '\n';
  for (const std::string& sentence : comparison_conclusion(report)) text += wrapped(shown(sentence), screen.width, 2) + '\n';
  return details.empty() ? text : text + '\n' + details;
}

}  // namespace earthtop::tool
