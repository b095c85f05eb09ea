// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a measurement compared with a scenario, or of several releases, from the document that `compare --json` writes.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "measure/document.hpp"
#include "report/exact_inputs_html.hpp"
#include "report/pages.hpp"
#include "results/meanings.hpp"
#include "results/time_unit.hpp"
#include "text/json.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

std::string words_of(const Json& json, const char* key) {
  const Json value = json.value(key, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

/// A file's name, with its path on demand.
std::string file_html(const std::string& file) {
  return fmt::format("<span title=\"{}\">{}</span>", escaped(file), escaped(file.substr(file.find_last_of('/') + 1)));
}

std::string chi_squared_html(const Json& chi_squared) {
  if (!chi_squared.is_object()) return "";
  std::string html = fmt::format("{} with {} degrees of freedom", number_html(chi_squared.at("value").get<double>(), "", 6),
                                 chi_squared.at("degrees_of_freedom").get<double>());
  if (const Json& p_value = chi_squared.at("p_value"); p_value.is_number())
    html += ", p-value " + number_html(p_value.get<double>(), "", 3);
  return html;
}

/// The sentences on what the data say, one an estimate; empty without a fit.
std::vector<std::string> sentences(const Json& document) {
  std::vector<std::string> list;
  for (const Json& estimate : document.at("estimates"))
    if (const std::string sentence = words_of(estimate, "sentence"); !sentence.empty())
      list.push_back(escaped(with_powers(sentence)));
  return list;
}

/// The finding, in a sentence: the first estimate with its error; without a fit, whether the data agree.
std::string finding_of(const Json& document, const std::string& otherwise) {
  for (const Json& estimate : document.at("estimates")) {
    std::string sentence = words_of(estimate, "sentence");
    if (sentence.empty()) continue;
    sentence = with_powers(sentence.substr(0, sentence.find_first_of(":;")));
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    return sentence + ".";
  }
  return otherwise;
}

std::string list_html(const std::vector<std::string>& items) {
  std::string html;
  for (const std::string& item : items) html += "<li>" + item + "</li>\n";
  return html.empty() ? "" : "<ul>\n" + html + "</ul>\n";
}

/// A table that scrolls by itself where the page is narrow.
std::string wide_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  return table_html(header, rows);
}

/// An estimate to the second digit of its error.
std::string estimate_html(const Json& estimate) {
  const std::string unit = estimate.at("unit").get<std::string>();
  const Json &value = estimate.at("estimate"), &error = estimate.at("standard_error");
  if (!value.is_number() || !error.is_number()) return number_html(value, unit, 7);
  const std::string shown = known_number(value.get<double>(), error.get<double>()).value;
  return fmt::format("<data value=\"{0}\">{1}</data> {2}", value.get<double>(), with_powers(shown),
                     escaped(unit_in_signs(unit)));
}

std::string estimates_html(const Json& document) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& estimate : document.at("estimates")) {
    const std::string unit = estimate.at("unit").get<std::string>();
    rows.push_back({input_html(estimate), estimate_html(estimate), number_html(estimate.at("standard_error"), unit, 2),
                    number_html(estimate.at("standard_error_scaled"), unit, 2), number_html(estimate.at("start"), unit)});
  }
  return wide_table({"input", "estimate", "standard error", "standard error from the scatter, if larger", "scenario's value"},
                    rows);
}

/// The correlation matrix of the estimates; empty for fewer than two.
std::string correlation_html(const Json& document) {
  const Json& correlation = document.at("correlation");
  if (correlation.size() < 2) return "";
  std::vector<std::string> header = {""};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t j = 0; j < correlation.size(); ++j) {
    const Json& estimate = document.at("estimates").at(j);
    header.push_back(input_words(estimate));
    std::vector<std::string> row = {"<strong>" + input_html(estimate) + "</strong>"};
    for (const Json& value : correlation.at(j)) row.push_back(number_html(value, "", 3));
    rows.push_back(std::move(row));
  }
  return "<h3>Correlation of the estimates' errors</h3>\n" + wide_table(header, rows);
}

/// Tells what the estimates of the Earth's rate rest on; where there is none of these, what the first one does.
std::string exact_html(const Json& document) {
  const Json& estimates = document.at("estimates");
  std::string html;
  for (const Json& estimate : estimates)
    if (estimate.value("finding", Json()).is_object()) html += exact_inputs_html(estimate);
  return html.empty() ? exact_inputs_html(estimates.front()) : html;
}

std::string quotation_html(const Json& document) {
  const std::string text = words_of(document, "quotation");
  return text.empty() ? "" : "<h3>To quote</h3>\n<p>" + escaped(text) + "</p>\n";
}

std::string priors_html(const Json& document) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& prior : document.value("priors", Json::array())) {
    const std::string unit = words_of(prior, "unit");
    rows.push_back({input_html(prior, "input"), number_html(prior.at("mean"), unit, 9),
                    number_html(prior.at("standard_error"), unit, 3), number_html(prior.at("pull"), "", 3)});
  }
  std::vector<std::string> unused;
  for (const Json& prior : document.value("unused_priors", Json::array()))
    unused.push_back(input_html(prior) + " was not used: " + escaped(words_of(prior, "reason")));
  if (rows.empty() && unused.empty()) return "";
  return "<h3>Known beforehand</h3>\n" +
         (rows.empty()
              ? ""
              : wide_table({"input", "known as", "standard error", "the estimate differs by, in these errors"}, rows)) +
         list_html(unused);
}

/// This section says how good the fit is; facts on the motions come first.
std::string agreement_html(const Json& document, Facts facts, std::vector<std::string> notes) {
  const Json& fit = document.at("fit");
  facts.emplace_back("chi-squared as given", chi_squared_html(document.at("chi_squared").at("as_given")));
  if (const std::string outcome = fit.at("outcome").get<std::string>(); outcome != "not_asked") {
    const std::string reason = fit.at("reason").get<std::string>();
    facts.emplace_back("fit", escaped(reason.empty() ? outcome : outcome + ": " + reason));
  }
  if (const std::string fitted = chi_squared_html(document.at("chi_squared").at("fitted")); !fitted.empty())
    facts.emplace_back("chi-squared after the fit", fitted);
  if (const Json time = document.value("correlation_time_s", Json()); time.is_number())
    facts.emplace_back("errors",
                       "correlated over " + number_html(time, "s", 6) +
                           ", as stated; chi-squared counts the part of each residual that the one before does not predict");
  for (const Json& note : document.at("notes")) notes.push_back(escaped(note.get<std::string>()));
  std::vector<std::string> list;
  for (const Json& hint : document.value("hints", Json::array()))
    list.push_back(escaped(hint.at("sentence").get<std::string>()));
  list.insert(list.end(), notes.begin(), notes.end());
  return facts_html(facts) + list_html(list) +
         "<p>The p-value is the probability of a chi-squared at least as large if the scenario and the stated standard errors "
         "are right.</p>\n";
}

std::string prediction_html(const Json& document) {
  const Json& prediction = document.at("prediction");
  return fmt::format("{}, to {}", escaped(prediction.at("status").get<std::string>()),
                     number_html(prediction.at("reached_s"), "s", 6));
}

/// The times of a figure's measured values, in its unit.
std::vector<double> measured_times(const Figure& figure) {
  std::set<double> times;
  for (const Panel& panel : figure.panels)
    for (const Line& line : panel.lines)
      if (line.style == LineStyle::points) times.insert(line.x.begin(), line.x.end());
  return {times.begin(), times.end()};
}

/// The charts of one release: data and model, and the histogram of the residuals.
/// @param release  counted from 1; 0 where there is only one
void add_charts(Page& page, const MeasurementReport& report, bool is_fitted, std::size_t release) {
  if (report.residuals.empty()) return;
  const std::string suffix = release > 0 ? fmt::format("-{}", release) : "";
  const std::string of = release > 0 ? fmt::format(" of release {}", release) : "";
  Figure over_time = measurement_figure(report);
  std::vector<double> times = measured_times(over_time);
  page.section(
      "data" + suffix, "Data and model" + of,
      page.chart("data" + suffix, std::move(over_time),
                 "The measured values, the model, and their difference in standard errors. Azimuths are counted beyond "
                 "whole turns where the model's lie close enough together.",
                 std::move(times)));
  page.section(
      "residuals" + suffix, (is_fitted ? "Residuals after the fit" : "Residuals") + of,
      page.chart("residuals" + suffix, residuals_histogram(report),
                 report.correlation_time_s > 0
                     ? "What is new in each residual after those before it, and the counts expected of normally distributed "
                       "errors of the stated size and correlation."
                     : "Residuals in standard errors, and the counts expected of independent, normally distributed errors "
                       "of the stated size."));
}

void add_estimates(Page& page, const Json& document) {
  if (document.at("estimates").empty()) return;
  page.section("estimates", "Estimates",
               list_html(sentences(document)) + estimates_html(document) + correlation_html(document) + priors_html(document) +
                   exact_html(document) + quotation_html(document));
}

void add_verdict(Page& page, bool agrees) {
  page.verdict(agrees ? "same" : "differs", agrees ? "<strong>agrees</strong>" : "<strong>does not agree</strong>");
}

}  // namespace

Report measurement_page(const Json& document, const std::vector<std::string>& notes) {
  const bool agrees = document.at("agrees").get<bool>();
  const std::string scenario = document.at("scenario").at("name").get<std::string>();
  Page page("measurement", "Measurement of " + scenario, notes);
  page.finding(escaped(finding_of(
      document, fmt::format("The measured rows {} with the scenario {}.", agrees ? "agree" : "do not agree", scenario))));
  page.headline(fmt::format("{} rows of {} compared with the scenario {}: they <strong>{}</strong>.",
                            count_in(document.at("rows")), file_html(document.at("file").get<std::string>()), escaped(scenario),
                            agrees ? "agree" : "do not agree"));
  add_verdict(page, agrees);
  add_estimates(page, document);
  page.section("agreement", "Agreement", agreement_html(document, {{"prediction", prediction_html(document)}}, {}));
  add_charts(page, measure::measurement_of(document), document.at("residuals_of") == "fitted", 0);
  return page.finish();
}

Report releases_page(const Json& document, const std::vector<std::string>& notes) {
  const bool agrees = document.at("agrees").get<bool>();
  const Json& releases = document.at("releases");
  Page page("measurement", fmt::format("{} releases, one fit", releases.size()), notes);
  page.finding(escaped(finding_of(document, "")));
  page.headline(fmt::format("{} releases compared with their scenarios by one fit: they <strong>{}</strong>.", releases.size(),
                            agrees ? "agree" : "do not agree"));
  add_verdict(page, agrees);
  add_estimates(page, document);
  Facts facts;
  std::vector<std::string> doubts;
  for (std::size_t r = 0; r < releases.size(); ++r) {
    const Json& release = releases.at(r);
    const Json& both = release.at("chi_squared");
    const Json& last = both.at("fitted").is_object() ? both.at("fitted") : both.at("as_given");
    facts.emplace_back(
        fmt::format("release {}", r + 1),
        fmt::format("{} against {}: {} rows; prediction {}; chi-squared {} of {} values", file_html(words_of(release, "file")),
                    escaped(words_of(release.at("scenario"), "name")), count_in(release.at("rows")), prediction_html(release),
                    number_html(last.at("value").get<double>(), "", 6), release.at("residuals").size()));
    for (const Json& note : release.at("notes"))
      doubts.push_back(escaped(fmt::format("release {}: {}", r + 1, note.get<std::string>())));
  }
  page.section("agreement", "Agreement", agreement_html(document, std::move(facts), std::move(doubts)));
  for (std::size_t r = 0; r < releases.size(); ++r) {
    MeasurementReport report = measure::measurement_of(releases.at(r));
    if (const Json& time = document.at("correlation_time_s"); time.is_number()) report.correlation_time_s = time.get<double>();
    add_charts(page, report, releases.at(r).at("residuals_of") == "fitted", r + 1);
  }
  return page.finish();
}

}  // namespace earthtop::report
