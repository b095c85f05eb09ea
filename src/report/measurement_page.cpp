// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a measurement compared with a scenario, from the document that `compare SCENARIO MEASURED --json` writes.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/pages.hpp"
#include "results/time_unit.hpp"

namespace earthtop::report {
namespace {

std::string chi_squared_html(const Json& chi_squared) {
  if (!chi_squared.is_object()) return "";
  std::string html = fmt::format("{} of {} degrees of freedom", number_html(chi_squared.at("value").get<double>(), "", 6),
                                 chi_squared.at("degrees_of_freedom").get<std::int64_t>());
  if (const Json& chance = chi_squared.at("p_value"); chance.is_number())
    html += ", chance " + number_html(chance.get<double>(), "", 3);
  return html;
}

std::string number_or_nothing(const Json& value, const std::string& unit, int digits) {
  return value.is_number() ? number_html(value.get<double>(), unit, digits) : "";
}

std::string estimates_html(const Json& document) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& estimate : document.at("estimates")) {
    const std::string unit = estimate.at("unit").get<std::string>();
    rows.push_back({escaped(estimate.at("name").get<std::string>()), number_or_nothing(estimate.at("estimate"), unit, 9),
                    number_or_nothing(estimate.at("standard_error"), unit, 2),
                    number_or_nothing(estimate.at("standard_error_scaled"), unit, 2),
                    number_or_nothing(estimate.at("start"), unit, 9)});
  }
  return table_html({"input", "estimate", "standard error", "the same by the scatter, where larger", "the scenario's"}, rows);
}

/// The residuals of each quantity over time, in standard errors.
Figure residuals_figure(const Json& document) {
  std::map<std::string, Line> lines;
  double end_s = 0;
  for (const Json& residual : document.at("residuals")) end_s = std::max(end_s, residual.at("t_s").get<double>());
  const TimeUnit unit = time_unit(end_s);
  constexpr LineColor kColors[] = {LineColor::blue, LineColor::vermillion, LineColor::green, LineColor::purple};
  constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  for (const Json& residual : document.at("residuals")) {
    const std::size_t count = lines.size() % std::size(kColors);
    const std::string quantity = residual.at("quantity").get<std::string>();
    Line& line =
        lines.try_emplace(quantity, Line{quantity, {}, {}, kColors[count], LineStyle::thin, kMarkers[count]}).first->second;
    const Json& normalised = residual.at("normalised");
    line.x.push_back(residual.at("t_s").get<double>() * unit.per_s);
    line.y.push_back(normalised.is_number() ? normalised.get<double>() : NAN);
  }
  Figure figure{"Residuals", "Measured less predicted, in standard errors", {"Time", unit.name}, {}};
  Panel panel{{"Residual", "standard errors"}, {}, 260};
  for (auto& [quantity, line] : lines) panel.lines.push_back(std::move(line));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

Report measurement_page(const Json& document) {
  const bool agrees = document.at("agrees").get<bool>();
  const Json& fit = document.at("fit");
  const std::string scenario = document.at("scenario").at("name").get<std::string>();
  Page page("measurement", "Measurement of " + scenario);
  page.headline(fmt::format("{} rows of {} against the scenario {}: they <strong>{}</strong>.",
                            document.at("rows").get<std::uint64_t>(), escaped(document.at("file").get<std::string>()),
                            escaped(scenario), agrees ? "agree" : "do not agree"));
  page.verdict(agrees ? "same" : "differs", agrees ? "<strong>agrees</strong>" : "<strong>does not agree</strong>");
  const Json& prediction = document.at("prediction");
  Facts facts = {{"prediction", fmt::format("{}, to {}", escaped(prediction.at("status").get<std::string>()),
                                            number_or_nothing(prediction.at("reached_s"), "s", 6))},
                 {"chi-squared as given", chi_squared_html(document.at("chi_squared").at("as_given"))}};
  if (const std::string outcome = fit.at("outcome").get<std::string>(); outcome != "not_asked") {
    const std::string reason = fit.at("reason").get<std::string>();
    facts.emplace_back("fit", escaped(reason.empty() ? outcome : outcome + ": " + reason));
  }
  if (const std::string fitted = chi_squared_html(document.at("chi_squared").at("fitted")); !fitted.empty())
    facts.emplace_back("chi-squared after the fit", fitted);
  std::string notes;
  for (const Json& note : document.at("notes")) notes += "<li>" + escaped(note.get<std::string>()) + "</li>\n";
  page.section("agreement", "Agreement", facts_html(facts) + (notes.empty() ? "" : "<ul>" + notes + "</ul>\n"));
  if (!document.at("estimates").empty()) page.section("estimates", "Estimates", estimates_html(document));
  if (!document.at("residuals").empty())
    page.section(
        "residuals", document.at("residuals_of") == "fitted" ? "Residuals after the fit" : "Residuals",
        page.chart("residuals", residuals_figure(document), "Measured less predicted, in standard errors of each value."));
  return page.finish();
}

}  // namespace earthtop::report
