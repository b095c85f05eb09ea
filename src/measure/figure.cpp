// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a comparison with a measurement.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "earthtop/measure/measurement.hpp"
#include "measure/measured_motion.hpp"
#include "measure/quantities.hpp"
#include "results/time_unit.hpp"

namespace earthtop {
namespace measure {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kAllUpTo = 600, kSpans = 300;  // values of a quantity in a picture

using Series = std::vector<const MeasurementResidual*>;

/// The residuals of each quantity, in the order in which the quantities first appear.
std::vector<Series> series_of(const MeasurementReport& report) {
  std::vector<Series> list;
  std::map<std::string_view, std::size_t> places;
  for (const MeasurementResidual& residual : report.residuals) {
    const auto place = places.try_emplace(residual.quantity, list.size()).first->second;
    if (place == list.size()) list.emplace_back();
    list[place].push_back(&residual);
  }
  return list;
}

/// The values whose residuals are least and largest in each of some spans, where there are very many.
Series thinned(const Series& all) {
  if (all.size() <= kAllUpTo) return all;
  Series kept;
  const auto smaller = [](const auto* a, const auto* b) { return a->normalised() < b->normalised(); };
  for (std::size_t k = 0; k < kSpans; ++k) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(all.size() * k / kSpans);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(all.size() * (k + 1) / kSpans);
    auto [least, largest] = std::minmax_element(begin, end, smaller);
    if (largest < least) std::swap(least, largest);
    kept.push_back(*least);
    if (largest != least) kept.push_back(*largest);
  }
  return kept;
}

/// Whether a quantity begins again after a turn, or half of one.
bool is_azimuth(std::string_view quantity) { return row_of(quantity).period > 0; }

struct Point {
  double t_s, value;
  bool is_drawn;  ///< whether the model's line goes through it
};

/// The model's number over time, from the curve and from the predictions at measured times. No line through means passes these.
std::vector<Point> model_of(const MeasurementReport& report, const Series& series) {
  std::vector<Point> points;
  const QuantityRow& row = row_of(series.front()->quantity);
  for (const CurvePoint& point : report.curve)
    points.push_back({point.t_s, shown(point, row), row.feature != Feature::period && row.feature != Feature::passage});
  for (const MeasurementResidual* residual : series)
    points.push_back(
        {residual->t_s, residual->predicted, row.feature == Feature::value && (!report.curve_is_mean || report.curve.empty())});
  std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.t_s < b.t_s; });
  return points;
}

/// Counts the azimuths of a model on over whole turns. Where two neighbours are far apart that cannot be done: then they stay
/// as they are, from 0 to a turn, and the curve is broken where it leaps.
void unwrap(std::vector<Point>& points, double period) {
  const double far_apart = 0.4 * period;  // beyond half a period the next one could as well be on the other side
  std::vector<Point> unwrapped = points;
  double before = kNone;
  bool is_continuous = true;
  for (Point& point : unwrapped) {
    if (!std::isfinite(point.value)) continue;
    if (std::isfinite(before)) point.value = before + std::remainder(point.value - before, period);
    is_continuous = is_continuous && !(std::abs(point.value - before) > far_apart);
    before = point.value;
  }
  const double turns = std::isfinite(before) && !unwrapped.empty() && std::isfinite(unwrapped.front().value)
                           ? std::floor(unwrapped.front().value / period)
                           : 0;
  if (is_continuous) {
    for (Point& point : unwrapped) point.value -= turns * period;  // compass azimuths begin from 0 to a turn
    points = std::move(unwrapped);
    return;
  }
  std::vector<Point> broken;
  for (Point point : points) {
    point.value -= std::floor(point.value / period) * period;
    if (!broken.empty() && std::abs(point.value - broken.back().value) > period / 2) broken.push_back({point.t_s, kNone, true});
    broken.push_back(point);
  }
  points = std::move(broken);
}

struct ShownUnit {
  const char* name;
  double per_unit;
};
/// The unit of a rate; of angles degrees, or seconds of arc where all is within a quarter of a degree of 0.
ShownUnit unit_for(std::string_view quantity, const std::vector<Point>& points) {
  const Dimension dimension = row_of(quantity).dimension;
  if (dimension != Dimension::angle) return {spoken_unit(dimension).data(), 1};
  double largest = 0;
  for (const Point& point : points) largest = std::isfinite(point.value) ? std::max(largest, std::abs(point.value)) : largest;
  constexpr double kDegrees = 180 / std::numbers::pi;
  return largest > 0.25 / kDegrees ? ShownUnit{"°", kDegrees} : ShownUnit{"″", 3600 * kDegrees};
}

/// A quantity as a picture calls it: "axis_azimuth" -> "Azimuth of the axis".
std::string spoken(std::string_view quantity) {
  if (quantity == "axis_azimuth") return "Azimuth of the axis";
  if (quantity == "axis_tilt") return "Tilt of the axis";
  return row_of(quantity).spoken;
}

/// The measured number of a residual whose model is drawn at `model_value`: the residual is added to the model, so that both are
/// counted over the same turns. An axis's residual along its azimuth is a length on the sphere.
double measured_beside(const MeasurementResidual& residual, double model_value) {
  if (!is_azimuth(residual.quantity)) return residual.measured;
  if (residual.quantity == "axis_azimuth")
    return model_value + std::remainder(residual.measured - residual.predicted, kWholeTurn);
  return model_value + residual.residual;
}

/// The label of a line: with its quantity, where there are several.
std::string label(const MeasurementReport& report, const Series& series, const char* what) {
  const bool is_alone = series.size() == report.residuals.size();
  return is_alone ? what : fmt::format("{}, {}", series.front()->quantity, what);
}

Panel data_panel(const MeasurementReport& report, const Series& series, LineColor color, double per_s) {
  const std::string_view quantity = series.front()->quantity;
  std::vector<Point> model = model_of(report, series);
  if (is_azimuth(quantity) && quantity != "drift_azimuth")
    unwrap(model, row_of(quantity).period);  // a drift is continuous already
  const ShownUnit unit = unit_for(quantity, model);
  Panel panel{{spoken(quantity), unit.name}, {}, 240};
  const bool is_mean = report.curve_is_mean && !report.curve.empty();
  Line line{
      label(report, series, is_mean ? "model, the mean of its swings" : "model"), {}, {}, LineColor::grey, LineStyle::thin};
  for (const Point& point : model) {
    if (!point.is_drawn) continue;
    line.x.push_back(point.t_s * per_s);
    line.y.push_back(point.value * unit.per_unit);
  }
  Line data{label(report, series, "measured"), {}, {}, color, LineStyle::points, Marker::circle};
  auto beside = model.begin();
  for (const MeasurementResidual* residual : thinned(series)) {
    while (beside->t_s < residual->t_s || !(std::isfinite(beside->value) || !std::isfinite(residual->predicted))) ++beside;
    data.x.push_back(residual->t_s * per_s);
    data.y.push_back(measured_beside(*residual, beside->value) * unit.per_unit);
    data.error.push_back(residual->standard_error * unit.per_unit);
  }
  panel.lines = {std::move(line), std::move(data)};
  return panel;
}

Panel residual_panel(const MeasurementReport& report, const Series& series, LineColor color, double per_s) {
  const std::string name = spoken(series.front()->quantity);
  Panel panel{{name + ": measured minus model", "standard errors"}, {}, 150};
  Line line{label(report, series, "residual"), {}, {}, color, LineStyle::points, Marker::circle};
  for (const MeasurementResidual* residual : thinned(series)) {
    line.x.push_back(residual->t_s * per_s);
    line.y.push_back(residual->normalised());
    line.error.push_back(1);
  }
  panel.lines.push_back(std::move(line));
  return panel;
}

double normal_density(double x) { return real::exp(-x * x / 2) / std::sqrt(kWholeTurn); }

}  // namespace
}  // namespace measure

Figure measurement_figure(const MeasurementReport& report) {
  using namespace measure;
  constexpr LineColor kColors[] = {LineColor::blue, LineColor::vermillion, LineColor::green, LineColor::purple};
  const double end_s = report.residuals.empty() ? 0 : report.residuals.back().t_s;
  const TimeUnit time = time_unit(end_s);
  Figure figure{fmt::format("{} and {}", report.file.substr(report.file.find_last_of('/') + 1), report.scenario_name),
                fmt::format("Measured values with their standard errors, and the model {}",
                            report.fitted ? "with the fitted numbers" : "as the scenario gives it"),
                {"Time since release", time.name},
                {}};
  const std::vector<Series> list = series_of(report);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const LineColor color = kColors[k % std::size(kColors)];
    figure.panels.push_back(data_panel(report, list[k], color, time.per_s));
    figure.panels.push_back(residual_panel(report, list[k], color, time.per_s));
  }
  return figure;
}

Figure residuals_histogram(const MeasurementReport& report) {
  using namespace measure;
  std::vector<double> values;
  for (const MeasurementResidual& residual : report.residuals)
    if (std::isfinite(residual.independent())) values.push_back(residual.independent());
  const auto n = static_cast<double>(values.size());
  constexpr double kEnd = 5;  // standard errors; what is beyond is counted in the bins at the ends
  const double width = values.size() < 50 ? 1 : values.size() < 1000 ? 0.5 : 0.25;
  const auto bins = static_cast<std::size_t>(2 * kEnd / width);
  Line bars{"residuals", {}, std::vector<double>(bins, 0), LineColor::blue, LineStyle::bars};
  for (std::size_t k = 0; k < bins; ++k) bars.x.push_back(-kEnd + (static_cast<double>(k) + 0.5) * width);
  std::size_t beyond = 0;
  for (const double value : values) {
    const double place = std::clamp((value + kEnd) / width, 0.0, static_cast<double>(bins) - 0.5);
    ++bars.y[static_cast<std::size_t>(place)];
    beyond += std::abs(value) > kEnd ? 1 : 0;
  }
  Line normal{"expected of the stated errors", {}, {}, LineColor::vermillion};
  for (int k = -100; k <= 100; ++k) {
    normal.x.push_back(kEnd * k / 100);
    normal.y.push_back(n * width * normal_density(normal.x.back()));
  }
  std::vector<Line> lines{std::move(bars), std::move(normal)};
  std::vector<Panel> panels{{{"Number of values", ""}, std::move(lines), 240}};
  return {"How often each size occurs",
          beyond > 0 ? fmt::format("{} of {} values lie beyond 5 standard errors and are counted in the bins at the ends",
                                   beyond, values.size())
                     : fmt::format("{} values", values.size()),
          {report.correlation_time_s > 0 ? "Whitened residual" : "Residual", "standard errors"},
          std::move(panels)};
}

}  // namespace earthtop
