// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "earthtop/compare/compare.hpp"
#include "plot/svg_text.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace compare {
namespace {

struct Suite {
  std::string cases;
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;

  void add(const std::string& suite, const std::string& name, const std::string& tag, const std::string& message) {
    ++tests;
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escape_xml(suite), escape_xml(name));
    if (tag.empty()) {
      cases += "/>\n";
      return;
    }
    std::size_t& count = tag == "error" ? errors : tag == "skipped" ? skipped : failures;
    ++count;
    cases += fmt::format(">\n      <{} message=\"{}\"/>\n    </testcase>\n", tag, escape_xml(message));
  }
  /// The counts as attributes.
  std::string counts() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"{}", tests, failures, errors,
                       skipped > 0 ? fmt::format(" skipped=\"{}\"", skipped) : "");
  }
};

std::string failure_of(const QuantityVerdict& quantity) {
  if (!quantity.reason.empty()) return quantity.reason;
  const auto [largest, tolerance] = told_apart(quantity.largest, quantity.tolerance, 6);
  return fmt::format("differs by {}{}{}, tolerance {} from {}{}", largest, quantity.where.empty() ? "" : " at ", quantity.where,
                     tolerance, quantity.origin,
                     quantity.first_violation.empty() ? "" : ", first beyond it at " + quantity.first_violation);
}

}  // namespace
}  // namespace compare

std::string comparison_junit(const CompareReport& report) {
  using namespace compare;
  std::string suites;
  Suite all;
  for (const PairReport& pair : report.pairs) {
    const std::string name = pair.name.empty() ? pair.candidate : pair.name;
    Suite suite;
    if (!pair.refusal.empty()) suite.add(name, "input", "error", pair.refusal);
    for (const CompareFinding& finding : pair.findings) suite.add(name, finding.kind, "failure", finding.text);
    for (const QuantityVerdict& quantity : pair.quantities)
      suite.add(name, quantity.name, quantity.passed ? "" : "failure", quantity.passed ? "" : failure_of(quantity));
    for (const LeftOut& one : pair.left_out) suite.add(name, one.name, "skipped", std::string(one.why));
    for (const CostRatio& ratio : pair.cost)
      suite.add(name, "cost: " + ratio.name, ratio.passed() ? "" : "failure",
                ratio.passed() ? ""
                               : fmt::format("{} where the reference has {}, limit {} times", ratio.candidate, ratio.reference,
                                             *ratio.limit));
    suites += fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", escape_xml(name), suite.counts(), suite.cases);
    all.tests += suite.tests;
    all.failures += suite.failures;
    all.errors += suite.errors;
    all.skipped += suite.skipped;
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"earthtop compare\" {}>\n{}</testsuites>\n",
                     all.counts(), suites);
}

}  // namespace earthtop
