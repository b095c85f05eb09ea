// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_text.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"

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

/// Where a tolerance comes from, without the profile, which the last line of the text names.
std::string short_origin(const std::string& origin) { return origin.substr(0, origin.find(" (profile ")); }

std::string quantity_line(const QuantityVerdict& quantity, std::size_t width) {
  const char* verdict = quantity.passed ? "ok" : "FAILED";
  const std::string name = shown(quantity.name, kWidestName);
  if (!quantity.reason.empty()) return fmt::format("  {:6}  {:<{}}  {}\n", verdict, name, width, shown(quantity.reason));
  std::string line = fmt::format("  {:6}  {:<{}}  {:>9.3g}  {:>9.3g}  {:>7}  {:<18}  {}", verdict, name, width,
                                 quantity.largest, quantity.tolerance, fmt::format("{:.2g}", quantity.share),
                                 change_words(quantity.change), short_origin(quantity.origin));
  if (!quantity.where.empty() && quantity.largest > 0) line += "; largest at " + quantity.where;
  if (!quantity.first_violation.empty())
    line += fmt::format("; beyond it from {} on, {} times", quantity.first_violation, quantity.violations);
  return shown(line) + '\n';
}

std::string pair_text(const PairReport& pair, bool everything) {
  std::string text;
  if (!pair.name.empty()) text += fmt::format("{}: {}\n", shown(pair.name), verdict_word(pair));
  if (!pair.refusal.empty()) return text + fmt::format("  {}\n", shown(pair.refusal));
  for (const CompareFinding& finding : pair.findings)
    text += fmt::format("  FAILED  {}: {}\n", finding.kind, shown(finding.text));
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
  for (const std::string& hint : pair.hints) text += fmt::format("  perhaps {}\n", shown(hint));
  if (everything || !pair.passed())
    for (const std::string& note : pair.notes) text += fmt::format("  note: {}\n", shown(note));
  if (everything || !pair.passed())
    for (const CostRatio& ratio : pair.cost) {
      text += fmt::format("  {}  {}: {:.4g} where the reference has {:.4g}", ratio.passed() ? "cost  " : "FAILED", ratio.name,
                          ratio.candidate, ratio.reference);
      if (ratio.reference > 0) text += fmt::format(", {:.3g} times", ratio.candidate / ratio.reference);
      text += ratio.limit ? fmt::format("; limit {} times\n", *ratio.limit) : "\n";
    }
  return text;
}

/// A sentence that sums up the changes: how the changed numbers compare with their error bounds, if they have any, and whether
/// there are other differences, to which no bound applies: a key, a word, a missing value, the scenario, the cost.
std::string summary_of_changes(const CompareReport& report) {
  bool compared = false, moved = false, above = false, within_failed = false, unknown = false, unknown_failed = false,
       other = false;
  for (const PairReport& pair : report.pairs) {
    other = other || !pair.refusal.empty() || !pair.findings.empty() ||
            std::any_of(pair.cost.begin(), pair.cost.end(), [](const CostRatio& ratio) { return !ratio.passed(); });
    for (const QuantityVerdict& quantity : pair.quantities) {
      compared = compared || quantity.compared > 0;
      other = other || !quantity.reason.empty();
      if (quantity.change == Change::none || (!quantity.reason.empty() && quantity.largest == 0)) continue;
      moved = true;
      above = above || quantity.change == Change::above_errors;
      within_failed = within_failed || (quantity.change == Change::within_errors && !quantity.passed);
      unknown = unknown || quantity.change == Change::unknown;
      unknown_failed = unknown_failed || (quantity.change == Change::unknown && !quantity.passed);
    }
  }
  std::string text;
  if (!compared)
    return "no number could be compared";
  else if (!moved)
    text = other ? "what both have has not changed by a bit" : "not a bit has changed";
  else if (above)
    text = "something has changed by more than both error bounds";
  else if (!unknown)
    text = "all numbers that have changed are within both error bounds";
  else if (!unknown_failed)
    text = "where error bounds are known, what has changed is within them; the rest is within its tolerance";
  else if (!within_failed)
    text = "what has changed by more than its tolerance has no error bounds";
  else
    text = "where error bounds are known, what has changed is within them; something without has passed its tolerance";
  return other ? text + "; what else differs is named above" : text;
}

}  // namespace

std::string compare_text(const CompareReport& report, bool everything) {
  std::string text;
  std::size_t same = 0, refused = 0, rows = 0;
  for (const PairReport& pair : report.pairs) {
    if (report.pairs.size() == 1 || everything || !pair.passed())
      text += pair_text(pair, everything || report.pairs.size() == 1);
    same += pair.passed() ? 1 : 0;
    refused += pair.refusal.empty() ? 0 : 1;
    rows += pair.rows;
  }
  const std::string_view profile = to_string(report.profile);
  const std::string tolerances =
      report.tolerances_file.empty()
          ? fmt::format("profile {}", profile)
          : fmt::format("{} on profile {}", shown(report.tolerances_file, kLongestFileName), profile);
  const std::string_view verdict = report.refused() ? "REFUSED" : report.passed() ? "same" : "DIFFERS";
  text += fmt::format("{}: {} against {} ({}; {} rows compared", verdict, shown(report.candidate, kLongestFileName),
                      shown(report.reference, kLongestFileName), tolerances, rows);
  if (report.pairs.size() > 1)
    text += fmt::format("; {} results: {} same, {} differ, {} refused", report.pairs.size(), same,
                        report.pairs.size() - same - refused, refused);
  return text + fmt::format(")\n{}\n", summary_of_changes(report));
}

}  // namespace earthtop::tool
