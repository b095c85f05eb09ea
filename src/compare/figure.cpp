// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>

#include "earthtop/compare/compare.hpp"
#include "results/time_unit.hpp"
#include "results/unit_of_name.hpp"

namespace earthtop {
namespace compare {
namespace {

constexpr std::size_t kMostDifferences = 6;

/// The quantities that get a panel: first those that failed, then those nearest to their tolerance.
std::vector<const QuantityVerdict*> chosen(const PairReport& pair) {
  std::vector<const QuantityVerdict*> list;
  for (const QuantityVerdict& quantity : pair.quantities)
    if (!quantity.curve.t_s.empty() && quantity.name != "drift_reliable") list.push_back(&quantity);
  std::stable_sort(list.begin(), list.end(),
                   [](const auto* a, const auto* b) { return a->passed != b->passed ? !a->passed : a->share > b->share; });
  if (list.size() > kMostDifferences) list.resize(kMostDifferences);
  return list;
}

}  // namespace
}  // namespace compare

Figure comparison_figure(const CompareReport& report) {
  using namespace compare;
  const auto failed =
      std::find_if(report.pairs.begin(), report.pairs.end(), [](const PairReport& pair) { return !pair.passed(); });
  Figure figure{"Differences over time", "", {"Time", "s"}, {}};
  if (report.pairs.empty()) return figure;
  const PairReport& pair = failed == report.pairs.end() ? report.pairs.front() : *failed;
  figure.subtitle = fmt::format("{} against {}", pair.candidate, pair.reference);
  const auto quantities = chosen(pair);
  double last_s = 0;
  for (const QuantityVerdict* quantity : quantities) last_s = std::max(last_s, quantity->curve.t_s.back());
  const TimeUnit time = time_unit(last_s);
  figure.x.unit = time.name;
  for (const QuantityVerdict* quantity : quantities) {
    std::vector<double> times = quantity->curve.t_s;
    for (double& t : times) t *= time.per_s;
    const LineColor color = quantity->passed ? LineColor::blue : LineColor::vermillion;
    Line tolerance{"tolerance", times, quantity->curve.tolerance, LineColor::grey, LineStyle::dashed};
    Line difference{quantity->passed ? "difference" : "difference, beyond it", times, quantity->curve.difference, color,
                    LineStyle::solid};
    std::vector<Line> lines;  // not as a list, parts of which g++ 12 would destroy twice when memory ends
    lines.push_back(std::move(tolerance));
    lines.push_back(std::move(difference));
    figure.panels.push_back(
        {{quantity->name, std::string(unit_of_name(quantity->name)), AxisScale::logarithmic}, std::move(lines), 130});
  }
  return figure;
}

}  // namespace earthtop
