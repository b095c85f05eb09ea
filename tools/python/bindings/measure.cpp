// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <limits>
#include <tuple>

#include "bindings.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/plan/plan.hpp"
#include "waiting.hpp"

namespace earthtop::python {
namespace {

/// A scenario as Python has it: the name of its file, its text, and the changes as pointers and JSON values.
using Given = std::tuple<std::string, std::string, Overrides>;

ScenarioSource source_of(const Given& given) { return {std::get<0>(given), std::get<1>(given)}; }

/// Data as Python has them: a file, or a name and a text; what the columns are, the standard errors, and the clock at the release.
using Data = std::tuple<std::string, std::optional<std::string>, std::vector<std::string>, std::vector<std::string>, double>;

Measurement measurement_of(const Data& data) {
  const auto& [name, text, columns, sigmas, time_offset_s] = data;
  const MeasurementFormat format{columns, sigmas, time_offset_s};
  return text ? parse_measurement(name, *text, format) : read_measurement(name, format);
}

struct Fit {
  std::string document, picture, histogram;
  std::optional<std::string> fitted;  // the scenario's text with the estimates, where there are any
};

Fit fitted(const Given& given, const Data& data, MeasurementOptions options, bool free_start, const Watch& watch) {
  ScenarioSource source = source_of(given);
  Overrides overrides = std::get<2>(given);
  if (free_start) {
    source = with_free_start(source, overrides);
    overrides.clear();
    options.estimates = with_free_start_estimates(std::move(options.estimates));
  }
  options.curve_points = MeasurementOptions::kCurvePoints;
  const MeasurementReport report = compare_with_measurement(source, overrides, measurement_of(data), options, watch);
  Fit fit{measurement_json(report), svg(measurement_figure(report)), svg(residuals_histogram(report)), std::nullopt};
  if (report.fitted && !report.estimates.empty()) fit.fitted = fitted_scenario(source, overrides, report, source.file);
  return fit;
}

/// The document of several releases; each has a scenario and data.
std::string fitted(const std::vector<std::pair<Given, Data>>& given, MeasurementOptions options, const Watch& watch) {
  options.curve_points = MeasurementOptions::kCurvePoints;
  std::vector<MeasuredRelease> releases;
  for (const auto& [scenario, data] : given)
    releases.push_back({source_of(scenario), std::get<2>(scenario), measurement_of(data), {}});
  return releases_json(compare_releases(releases, options, watch));
}

/// @param quantities  names with their standard errors
MeasurementPlan plan_of(const std::vector<std::pair<std::string, double>>& quantities, double every_s,
                        std::optional<double> until_s, double correlation_time_s) {
  MeasurementPlan plan;
  for (const auto& [name, standard_error] : quantities) plan.quantities.push_back(planned_quantity(name, standard_error));
  plan.every_s = every_s;
  plan.until_s = until_s;
  plan.correlation_time_s = correlation_time_s;
  return plan;
}

}  // namespace

void bind_measure(py::module_& module) {
  module.def(
      "fit",
      [](const Given& scenario, const Data& data, const std::vector<std::string>& estimates, bool priors,
         double correlation_time_s, bool free_start, const py::object& on_progress) {
        const MeasurementOptions options{estimates, priors, correlation_time_s};
        const Fit fit =
            result_of(on_progress, [&](const Watch& watch) { return fitted(scenario, data, options, free_start, watch); });
        return py::make_tuple(fit.document, fit.picture, fit.histogram, fit.fitted);
      },
      py::arg("scenario"), py::arg("data"), py::arg("estimates"), py::arg("priors"), py::arg("correlation_time_s"),
      py::arg("free_start"), py::arg("on_progress"),
      "Compares data with a scenario and fits: (document, picture, histogram of the residuals, text of the fitted scenario).");
  module.def(
      "fit_releases",
      [](const std::vector<std::pair<Given, Data>>& releases, const std::vector<std::string>& estimates,
         const std::vector<std::string>& shared, bool priors, double correlation_time_s, const py::object& on_progress) {
        MeasurementOptions options{estimates, priors, correlation_time_s};
        options.shared = shared;
        return result_of(on_progress, [&](const Watch& watch) { return fitted(releases, options, watch); });
      },
      py::arg("releases"), py::arg("estimates"), py::arg("shared"), py::arg("priors"), py::arg("correlation_time_s"),
      py::arg("on_progress"), "Fits several releases at once: the document.");
  module.def(
      "plan",
      [](const std::vector<Given>& scenarios, const std::vector<std::pair<std::string, double>>& quantities, double every_s,
         std::optional<double> until_s, double correlation_time_s, const std::vector<std::string>& estimates,
         const std::vector<std::string>& nuisances, const std::vector<std::string>& shared,
         const std::vector<std::string>& design, const py::object& on_progress) {
        MeasurementPlan plan = plan_of(quantities, every_s, until_s, correlation_time_s);
        plan.estimates = estimates;
        plan.nuisances = nuisances;
        plan.shared = shared;
        std::vector<PlannedRelease> releases;
        for (const Given& scenario : scenarios) releases.push_back({source_of(scenario), std::get<2>(scenario)});
        std::vector<DesignInput> inputs;
        for (const std::string& text : design) inputs.push_back(design_input(text));
        const auto texts = result_of(on_progress, [&](const Watch& watch) {
          const PlanReport report = releases.size() == 1
                                        ? plan_measurement(releases[0].source, releases[0].overrides, plan, inputs, watch)
                                        : plan_releases(releases, plan, watch);
          return std::pair(plan_json(report), svg(plan_figure(report)));
        });
        return texts;
      },
      py::arg("scenarios"), py::arg("quantities"), py::arg("every_s"), py::arg("until_s"), py::arg("correlation_time_s"),
      py::arg("estimates"), py::arg("nuisances"), py::arg("shared"), py::arg("design"), py::arg("on_progress"),
      "What a planned measurement would tell: (document, picture).");
  module.def(
      "simulated_measurement",
      [](const Given& scenario, const std::vector<std::pair<std::string, double>>& quantities, double every_s,
         std::optional<double> until_s, double correlation_time_s, std::uint64_t seed, const py::object& on_progress) {
        const MeasurementPlan plan = plan_of(quantities, every_s, until_s, correlation_time_s);
        return result_of(on_progress, [&](const Watch& watch) {
          return simulated_measurement(source_of(scenario), std::get<2>(scenario), plan, seed, watch);
        });
      },
      py::arg("scenario"), py::arg("quantities"), py::arg("every_s"), py::arg("until_s"), py::arg("correlation_time_s"),
      py::arg("seed"), py::arg("on_progress"), "The scenario's motion with normal errors, as CSV.");
}

}  // namespace earthtop::python
