// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>

#include "earthtop/plan/plan.hpp"
#include "measure/spoken_input.hpp"

namespace earthtop {

Figure plan_figure(const PlanReport& report) {
  Figure figure{"What a measurement would show", "", {"Changed by a factor of", "", AxisScale::logarithmic}, {}};
  if (report.estimates.empty()) return figure;
  const PlannedEstimate& target = report.estimates[0];
  figure.subtitle = fmt::format("{}: standard error of {}", report.scenario_name, measure::spoken_input(target.name));
  struct Curve {
    PlanChange change;
    const char* label;
    LineColor color;
    Marker marker;
  };
  constexpr Curve kCurves[] = {{PlanChange::duration, "measured longer", LineColor::blue, Marker::circle},
                               {PlanChange::rows, "more rows", LineColor::vermillion, Marker::square},
                               {PlanChange::sigma, "smaller standard errors", LineColor::green, Marker::triangle}};
  Panel panel{{"Standard error", target.unit, AxisScale::logarithmic}, {}, 320};
  for (const Curve& curve : kCurves) {
    Line line{curve.label, {}, {}, curve.color, LineStyle::solid, curve.marker};
    for (const PlanVariation& variation : report.variations) {
      if (variation.change != curve.change) continue;
      line.x.push_back(curve.change == PlanChange::sigma ? 1 / variation.factor : variation.factor);
      line.y.push_back(variation.standard_error.value_or(NAN));
    }
    panel.lines.push_back(std::move(line));
  }
  const double value = std::abs(target.value);
  if (value > 0)
    panel.lines.push_back({"the scenario's value", {0.125, 4}, {value, value}, LineColor::grey, LineStyle::dashed});
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace earthtop
