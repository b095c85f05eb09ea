// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/conclusion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/row.hpp"
#include "results/columns.hpp"
#include "results/unit_of_name.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace compare {
namespace {

/// "1 quantity has", "3 quantities have".
std::string counted(std::size_t count, std::string_view one, std::string_view several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  const bool has_end = text.ends_with('.') || text.ends_with('?') || text.ends_with('!');
  return has_end ? text : text + '.';
}

/// A quantity with its largest difference: "drift_spin_rad (spin phase, rotating minus prediction), 8.6e-07 rad at t = 59.6 s".
std::string told(const QuantityVerdict& quantity) {
  const std::string_view unit = unit_of_name(quantity.name);
  std::string text = fmt::format("{} ({}): {:.3g}", quantity.name, in_words(quantity.name), quantity.largest);
  if (!unit.empty()) text += fmt::format(" {}", unit);
  if (!quantity.where.empty()) text += " at " + quantity.where;
  return text;
}

/// Says which part of its tolerance a quantity uses where its difference is largest and, where that is more, elsewhere.
std::string share_words(const QuantityVerdict& quantity) {
  constexpr double kRounding = 1e-9;
  if (quantity.origin.starts_with("a factor of"))
    return (quantity.passed ? "within " : "not within ") + quantity.origin.substr(0, quantity.origin.find(" ("));
  const auto told_share = [](double share) -> std::string {
    if (std::isinf(share)) return "where nothing is allowed";
    return share < 1 ? fmt::format("{} of its tolerance", told_apart(share, 1, 2).first)
                     : fmt::format("{} times its tolerance", told_apart(share, 1, 3).first);
  };
  const double here = quantity.tolerance > 0 ? quantity.largest / quantity.tolerance : std::numeric_limits<double>::infinity();
  const bool is_elsewhere = quantity.share > here * (1 + kRounding);
  return told_share(here) + (is_elsewhere ? fmt::format(", but {} elsewhere", told_share(quantity.share)) : "");
}

/// Says which quantities differ, or how near the two results are to that.
std::string what_was_found(const PairReport& pair) {
  std::vector<const QuantityVerdict*> beyond, without;
  const QuantityVerdict* nearest = nullptr;
  bool moved = false;
  for (const QuantityVerdict& quantity : pair.quantities) {
    moved = moved || quantity.change != Change::none;
    if (!quantity.passed) (quantity.reason.empty() ? beyond : without).push_back(&quantity);
    if (quantity.passed && quantity.largest > 0 && (!nearest || quantity.share > nearest->share)) nearest = &quantity;
  }
  const std::size_t count = pair.quantities.size();
  std::string text;
  const auto add = [&](std::string more) { text += (text.empty() ? "" : " ") + sentence(std::move(more)); };
  if (!beyond.empty()) {
    const QuantityVerdict& most =
        **std::max_element(beyond.begin(), beyond.end(), [](auto* a, auto* b) { return a->share < b->share; });
    add(fmt::format("{} of {} changed by more than allowed, {}{}, {}", beyond.size(), counted(count, "quantity", "quantities"),
                    beyond.size() > 1 ? "most of all " : "", told(most), share_words(most)));
  }
  if (!without.empty())
    add(fmt::format("{} otherwise than by a number, {}{}: {}", counted(without.size(), "quantity differs", "quantities differ"),
                    without.size() > 1 ? "the first one " : "", without[0]->name, without[0]->reason));
  if (!pair.findings.empty())
    add(fmt::format("{}: {}{}", pair.findings[0].kind, pair.findings[0].text,
                    pair.findings.size() > 1
                        ? fmt::format(", and {} more", counted(pair.findings.size() - 1, "finding", "findings"))
                        : ""));
  for (const CostRatio& ratio : pair.cost)
    if (!ratio.passed()) {
      const auto [before, now] = told_apart(ratio.reference, ratio.candidate, 4);
      add(fmt::format("{} went from {} to {}, more than {} times", ratio.name, before, now, *ratio.limit));
    }
  if (!text.empty()) return text;
  if (count == 0) return "There is nothing to compare.";
  if (!moved)
    return sentence(fmt::format("{} to the last bit",
                                count == 1 ? "the only quantity agrees" : fmt::format("all {} quantities agree", count)));
  add(count == 1 ? "the only quantity is within its tolerance"
                 : fmt::format("all {} quantities are within their tolerances", count));
  if (nearest) add(fmt::format("nearest to its tolerance is {}, {}", told(*nearest), share_words(*nearest)));
  return text;
}

}  // namespace

std::string in_words(std::string_view quantity) {
  const auto in_short = [](std::string_view meaning) { return std::string(meaning.substr(0, meaning.find_first_of(";:"))); };
  for (const RowQuantity& known : kDriftQuantities)
    if (known.measure == quantity) return in_short(known.meaning);
  for (const RowQuantity& known : torque_quantities())
    if (known.measure == quantity) return in_short(known.meaning);
  std::string_view unit;
  for (const std::string_view ending : {"_rad_s", "_m_s2", "_N_m", "_kg_m2", "_rad", "_deg", "_kg", "_hz", "_1_s", "_s", "_m"})
    if (unit.empty() && quantity.ends_with(ending)) unit = ending;
  std::string words(quantity.substr(0, quantity.size() - unit.size()));
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == '_' || words[i] == '.') words[i] = ' ';
  return words + " of the summary";
}

std::string conclusion_of(const PairReport& pair) {
  if (!pair.refusal.empty()) return "The two cannot be compared: " + pair.refusal + '.';
  std::string text = what_was_found(pair);
  if (!pair.common_end) return text;
  const CommonEnd& end = *pair.common_end;
  text += " " + sentence(fmt::format("both were compared up to t = {}, where the {} ends; the {} goes on to t = {}",
                                     time_text(end.t_s), end.reference_goes_on ? "new result" : "reference",
                                     end.reference_goes_on ? "reference" : "new result", time_text(end.longer_t_s)));
  const std::size_t left_out = pair.left_out.size();
  if (left_out > 0)
    text += " " +
            sentence(fmt::format("What does not belong to that time is left out: {}", counted(left_out, "figure", "figures")));
  return text;
}

std::string changes_of(const CompareReport& report) {
  bool compared = false, moved = false, above = false, within = false, within_failed = false, unknown = false,
       unknown_failed = false, other = false;
  for (const PairReport& pair : report.pairs) {
    other = other || !pair.refusal.empty() || !pair.findings.empty() ||
            std::any_of(pair.cost.begin(), pair.cost.end(), [](const CostRatio& ratio) { return !ratio.passed(); });
    for (const QuantityVerdict& quantity : pair.quantities) {
      compared = compared || quantity.compared > 0;
      other = other || !quantity.reason.empty();
      const bool is_no_number = !quantity.reason.empty() && quantity.where.empty();  // a word, or a figure that is missing
      if (quantity.change == Change::none || is_no_number) continue;
      moved = true;
      above = above || quantity.change == Change::above_errors;
      within = within || quantity.change == Change::within_errors;
      within_failed = within_failed || (quantity.change == Change::within_errors && !quantity.passed);
      unknown = unknown || quantity.change == Change::unknown;
      unknown_failed = unknown_failed || (quantity.change == Change::unknown && !quantity.passed);
    }
  }
  std::string text;
  if (!compared)
    return "no number could be compared";
  else if (!moved)
    text = other ? "no quantity's number has changed by a bit" : "not a bit has changed";
  else if (above)
    text = "something has changed by more than both error bounds";
  else if (!unknown)
    text = "all numbers that have changed are within both error bounds";
  else if (!unknown_failed && !within)
    text = "what has changed has no error bounds, and is within its tolerance";
  else if (!unknown_failed)
    text = "where error bounds are known, what has changed is within them; the rest is within its tolerance";
  else if (!within_failed)
    text = "what has changed by more than its tolerance has no error bounds";
  else
    text = "where error bounds are known, what has changed is within them; something without them is beyond its tolerance";
  return other ? text + "; what else differs is named below" : text;
}

}  // namespace compare

std::vector<std::string> comparison_conclusion(const CompareReport& report) {
  std::vector<std::string> sentences;
  if (report.pairs.size() == 1) {
    sentences.push_back(compare::conclusion_of(report.pairs[0]));
  } else {
    std::size_t same = 0, refused = 0;
    const PairReport* first = nullptr;
    for (const PairReport& pair : report.pairs) {
      same += pair.passed() ? 1 : 0;
      refused += pair.refusal.empty() ? 0 : 1;
      if (!first && !pair.passed()) first = &pair;
    }
    sentences.push_back(fmt::format("{} results: {} same, {} differ, {} refused.", report.pairs.size(), same,
                                    report.pairs.size() - same - refused, refused));
    if (first) sentences.push_back(fmt::format("First {}: {}", first->name, compare::conclusion_of(*first)));
  }
  sentences.push_back(compare::sentence(compare::changes_of(report)));
  return sentences;
}

}  // namespace earthtop
