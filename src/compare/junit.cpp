// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "earthtop/compare/compare.hpp"
#include "plot/svg_text.hpp"

namespace earthtop {
namespace compare {
namespace {

struct Suite {
  std::string cases;
  std::size_t tests = 0, failures = 0, errors = 0;

  void add(const std::string& suite, const std::string& name, const std::string& tag, const std::string& message) {
    ++tests;
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escape_xml(suite), escape_xml(name));
    if (tag.empty()) {
      cases += "/>\n";
      return;
    }
    ++(tag == "error" ? errors : failures);
    cases += fmt::format(">\n      <{} message=\"{}\"/>\n    </testcase>\n", tag, escape_xml(message));
  }
};

std::string failure_of(const QuantityVerdict& quantity) {
  if (!quantity.reason.empty()) return quantity.reason;
  return fmt::format("differs by {:.6g}{}{}, tolerance {:.6g} from {}{}", quantity.largest,
                     quantity.where.empty() ? "" : " at ", quantity.where, quantity.tolerance, quantity.origin,
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
    for (const CostRatio& ratio : pair.cost)
      suite.add(name, "cost: " + ratio.name, ratio.passed() ? "" : "failure",
                ratio.passed() ? ""
                               : fmt::format("{} where the reference has {}, limit {} times", ratio.candidate, ratio.reference,
                                             *ratio.limit));
    suites += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}  </testsuite>\n",
                          escape_xml(name), suite.tests, suite.failures, suite.errors, suite.cases);
    all.tests += suite.tests;
    all.failures += suite.failures;
    all.errors += suite.errors;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"earthtop compare\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\">\n{}</testsuites>\n",
      all.tests, all.failures, all.errors, suites);
}

}  // namespace earthtop
