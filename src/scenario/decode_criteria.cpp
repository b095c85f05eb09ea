// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the criteria that a scenario's results must satisfy.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {
namespace {

/// Returns how many numbers a value of this quantity has.
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
  Reading codec(given);
  criterion_keys(codec, criterion);
  const auto quantity = given.word("quantity");
  if (!given.word("kind")) return criterion;
  const CriterionRule& rule = row_of(kCriterionRules, criterion.kind);
  check_keys(given, rule);
  if (!quantity || !lists(rule.allowed, "quantity")) return criterion;
  if (!lists(rule.quantities, *quantity))
    given.refuse("quantity", fmt::format("is \"{}\"; for the kind \"{}\" it must be {}", *quantity, rule.word,
                                         fmt::join(split_words(rule.quantities), ", ")));
  else if (rule.value == CriterionKind::value && !criterion.values.empty() && criterion.values.size() != numbers_in(*quantity))
    given.refuse("values",
                 fmt::format("has {} numbers; \"{}\" needs {}", criterion.values.size(), *quantity, numbers_in(*quantity)));
  return criterion;
}

}  // namespace

std::vector<CriterionSpec> decode_criteria(const Section& root) {
  std::vector<CriterionSpec> criteria;
  for (std::size_t i = 0; i < root.size("criteria"); ++i) criteria.push_back(decode_criterion(root.element("criteria", i)));
  return criteria;
}

}  // namespace earthtop::scenario
