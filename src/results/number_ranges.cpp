// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/number_ranges.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "earthtop/error.hpp"
#include "input/node.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

struct RangeRule {
  std::string_view words;  ///< of a name, one after the other; with a dot: the parent's name, and the whole name or nothing
  NumberRange range;
};

/// The first rule whose words a name has is the one that holds.
constexpr auto kRangeRules = [] {
  using enum NumberRange;
  return std::to_array<RangeRule>({
      {"p_value", probability},
      {"correlation_time", not_negative},
      {"correlation", correlation},
      {"drift_reliable", flag},
      // Sizes of errors, and what errors are measured by.
      {"bound", not_negative},
      {"bounds", not_negative},
      {"error", not_negative},
      {"errors", not_negative},
      {"tolerance", not_negative},
      {"limit", not_negative},
      {"limit_sigma", not_negative},
      {"from_zero_sigma", not_negative},
      {"misfit", not_negative},
      {"scale", not_negative},
      {"share_used", not_negative},
      {"error.", not_negative},
      {"uncertainty.", not_negative},
      {"largest_drift_rad", not_negative},
      {"largest_difference", not_negative},
      {"largest_change", not_negative},
      {"curve.difference", not_negative},
      {"as_given.value", not_negative},
      {"fitted.value", not_negative},
      {"per_degree_of_freedom", not_negative},
      {"of_priors", not_negative},
      {"factor", not_negative},
      // Times that something takes.
      {"duration_s", not_negative},
      {"every_s", not_negative},
      {"until_s", not_negative},
      {"reached_s", not_negative},
      {"seconds", not_negative},
      {"solution_s", not_negative},
      {"certificate_s", not_negative},
      {"looks_s", not_negative},
      {"selection_s", not_negative},
      {"cost.reference", not_negative},
      {"cost.new", not_negative},
      {"cost.ratio", not_negative},
      // Counts.
      {"rows", count},
      {"values", count},
      {"line", count},
      {"compared_from", any},
      {"compared_to", any},
      {"compared", count},
      {"violations", count},
      {"row_count", count},
      {"digits", count},
      {"steps", count},
      {"evaluations", count},
      {"repetitions", count},
      {"checkpoints", count},
      {"iterations", count},
      {"predictions", count},
      {"spans", count},
      {"minima", count},
      {"motions", count},
      {"attempts", count},
      {"avoided", count},
      // A fit of fewer values than inputs has less than none.
      {"degrees_of_freedom", any},
  });
}();

bool has_words(std::string_view name, std::string_view words) {
  for (std::size_t at = name.find(words); at != name.npos; at = name.find(words, at + 1)) {
    const std::size_t end = at + words.size();
    if ((at == 0 || name[at - 1] == '_') && (end == name.size() || name[end] == '_')) return true;
  }
  return false;
}

bool is_of(const RangeRule& rule, std::string_view name, std::string_view parent) {
  const std::size_t dot = rule.words.find('.');
  if (dot == rule.words.npos) return has_words(name, rule.words);
  const std::string_view whole = rule.words.substr(dot + 1);
  return parent == rule.words.substr(0, dot) && (whole.empty() || name == whole);
}

/// Goes through a document and keeps what is out of range.
class RangeCheck {
 public:
  std::vector<Diagnostic> faults;

  void look(const Json& json, const std::string& pointer, std::string_view name, std::string_view parent) {
    if (json.is_object()) {
      for (const auto& [key, value] : json.items())
        if (key != "scenario") look(value, pointer + input::pointer_step(key), key, name);
    } else if (json.is_array()) {
      if (range_of(name, parent) == NumberRange::count) return;  // a list of rows, whose numbers are of columns
      std::size_t i = 0;
      for (const Json& value : json) look(value, pointer + "/" + std::to_string(i++), name, parent);
    } else if (json.is_number() && faults.size() < kMostFaults) {
      const auto number = json.get<double>();
      if (const std::string_view wanted = fault_of(range_of(name, parent), number); !wanted.empty())
        faults.push_back(
            {0, 0, pointer,
             fmt::format("is {}, but must be {}: the file is not as earthtop wrote it; write it anew", number, wanted)});
    }
  }

 private:
  static constexpr std::size_t kMostFaults = 20;
};

}  // namespace

NumberRange range_of(std::string_view name, std::string_view parent) {
  for (const RangeRule& rule : kRangeRules)
    if (is_of(rule, name, parent)) return rule.range;
  return NumberRange::any;
}

std::string_view fault_of(NumberRange range, double number) {
  constexpr double kRounding = 1e-9;  // a correlation is a quotient of sums; no flipped digit of a 1 is as near
  if (std::isnan(number)) return "";
  switch (range) {
    case NumberRange::any: return "";
    case NumberRange::not_negative: return number >= 0 ? "" : "0 or positive";
    case NumberRange::count: return number >= 0 && std::floor(number) == number ? "" : "a whole number, 0 or positive";
    case NumberRange::probability: return number >= 0 && number <= 1 ? "" : "a probability, from 0 to 1";
    case NumberRange::correlation: return std::abs(number) <= 1 + kRounding ? "" : "a correlation, from -1 to 1";
    case NumberRange::flag: return number == 0 || number == 1 ? "" : "0 or 1";
  }
  return "";
}

void check_ranges(const Json& document, const std::string& file) {
  RangeCheck check;
  check.look(document, "", "", "");
  if (!check.faults.empty()) throw ScenarioError(std::move(check.faults), file);
}

}  // namespace earthtop
