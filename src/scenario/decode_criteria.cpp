// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the criteria that a scenario's results must satisfy.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scenario/decode.hpp"
#include "scenario/fields.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {
namespace {

/// Numbers that a value of this quantity has.
std::size_t numbers_in(std::string_view name) {
  for (const RowQuantity& quantity : kDriftQuantities)
    if (quantity.is_called(name)) return quantity.width();
  return 1;
}

void check_keys(const Section& given, const CriterionRule& rule) {
  for (const std::string_view key : split_words(rule.required)) given.require(key);
  for (const std::string_view key : split_words(kCriterionKeys))
    if (given.has(key) && !lists(rule.allowed, key))
      given.refuse_key(
          key, fmt::format("does not belong to the kind \"{}\"; allowed with it: {}", rule.word,
                           rule.allowed.empty() ? "set" : fmt::format("{}", fmt::join(split_words(rule.allowed), ", "))));
}

CriterionSpec decode_criterion(const Section& given) {
  CriterionSpec criterion;
  given.require("kind");
  given.require("why");
  const auto kind = given.word("kind");
  const auto quantity = given.word("quantity");
  criterion.quantity = quantity.value_or("");
  criterion.set = given.changes("set").value_or(criterion.set);
  criterion.values = given.numbers("values").value_or(criterion.values);
  criterion.at_s = given.number("at_s");
  criterion.until_s = given.number("until_s");
  criterion.tolerance = given.number("tolerance");
  criterion.why = given.word("why").value_or("");
  criterion.slow = given.flag("slow").value_or(false);
  if (!kind) return criterion;
  const CriterionRule& rule =
      *std::find_if(kCriterionRules.begin(), kCriterionRules.end(), [&](const auto& r) { return r.word == *kind; });
  criterion.kind = rule.kind;
  check_keys(given, rule);
  if (!quantity || !lists(rule.allowed, "quantity")) return criterion;
  if (!lists(rule.quantities, *quantity))
    given.refuse("quantity", fmt::format("is \"{}\"; of the kind \"{}\" it must be {}", *quantity, rule.word,
                                         fmt::join(split_words(rule.quantities), ", ")));
  else if (rule.kind == CriterionKind::value && !criterion.values.empty() && criterion.values.size() != numbers_in(*quantity))
    given.refuse("values",
                 fmt::format("has {} numbers; \"{}\" has {}", criterion.values.size(), *quantity, numbers_in(*quantity)));
  return criterion;
}

}  // namespace

std::vector<CriterionSpec> decode_criteria(const Section& root) {
  std::vector<CriterionSpec> criteria;
  for (std::size_t i = 0; i < root.size("criteria"); ++i) criteria.push_back(decode_criterion(root.element("criteria", i)));
  return criteria;
}

}  // namespace earthtop::scenario
