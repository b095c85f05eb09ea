// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a planned measurement, from the document that `plan SCENARIO --json` writes.
#include <fmt/core.h>

#include <cctype>
#include <cmath>

#include "earthtop/plan/plan.hpp"
#include "report/exact_inputs_html.hpp"
#include "report/pages.hpp"
#include "report/study_words.hpp"
#include "results/meanings.hpp"
#include "text/json.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

std::optional<double> number_in(const Json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

/// The picture shows these parts of the document.
PlanReport pictured(const Json& document) {
  PlanReport report;
  report.scenario_name = document.at("scenario").at("name").get<std::string>();
  if (document.at("estimates").empty()) refuse_value("a plan has an estimate");
  for (const Json& estimate : document.at("estimates"))
    report.estimates.push_back({estimate.at("name").get<std::string>(),
                                estimate.at("unit").get<std::string>(),
                                estimate.at("value").get<double>(),
                                false,
                                {},
                                number_in(estimate.at("standard_error")),
                                {},
                                {},
                                {}});
  for (const Json& variation : document.at("variations"))
    for (const PlanChange change : {PlanChange::duration, PlanChange::rows, PlanChange::sigma})
      if (variation.at("change") == to_string(change)) {
        PlanVariation& shown = report.variations.emplace_back();
        shown.change = change;
        shown.factor = variation.at("factor").get<double>();
        shown.standard_error = number_in(variation.at("standard_error"));
      }
  return report;
}

std::string errors_html(const Json& document) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& estimate : document.at("estimates")) {
    const std::string unit = estimate.at("unit").get<std::string>();
    rows.push_back({input_html(estimate), number_html(estimate.at("value"), unit),
                    number_html(estimate.at("standard_error"), unit, 3), number_html(estimate.at("significance"), "", 3),
                    number_html(estimate.at("standard_error_alone"), unit, 3), number_html(estimate.at("prior"), unit, 3)});
  }
  return table_html({"input", "scenario's value", "standard error", "value / standard error",
                     "standard error if the others were known", "known beforehand to"},
                    rows);
}

/// This table shows how much each unknown costs the first estimate.
std::string costs_html(const Json& document, const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& variation : document.at("variations"))
    if (variation.at("change") == to_string(PlanChange::known))
      rows.push_back({input_html(variation, "input"), number_html(variation.at("standard_error"), unit, 3)});
  return rows.empty() ? "" : table_html({"unknown", "standard error if it were known exactly"}, rows);
}

/// This table says how well each of several releases would tell the first estimate by itself; empty for one.
std::string releases_html(const Json& document, const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& release : document.value("releases", Json::array()))
    rows.push_back({fmt::format("{} alone, {}", rows.size() + 1, escaped(release.at("scenario").at("name").get<std::string>())),
                    number_html(release.at("standard_error_alone"), unit, 3)});
  return rows.empty() ? "" : table_html({"release", "standard error of the first input"}, rows);
}

/// A setting in words, with its unit and, on demand, its pointer.
std::string setting_html(const std::string& pointer) {
  const QuantityWords words = words_of_setting(pointer, pointer);
  return fmt::format(
      "<span title=\"{}\">{}</span>", escaped(pointer),
      escaped(words.unit.empty() ? words.words : fmt::format("{} ({})", words.words, unit_in_signs(words.unit))));
}

/// A measured quantity in words: "azimuth (°)".
std::string measured_html(const std::string& name) {
  const QuantityWords words = words_of_setting(name, "");
  return fmt::format(
      "<span title=\"{}\">{}</span>", escaped(name),
      escaped(words.unit.empty() ? words.words : fmt::format("{} ({})", words.words, unit_in_signs(words.unit))));
}

/// A sentence of the plan in which inputs have their words, and powers of ten are raised.
std::string in_words(const Json& document, std::string text) {
  for (const Json& estimate : document.at("estimates")) {
    const std::string name = input_name(estimate), words = "the " + input_words(estimate);
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + words.size()))
      text.replace(at, name.size(), words);
  }
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return with_powers(text);
}

/// The finding of the plan, in a sentence.
std::string finding_of(const Json& document, bool is_determined) {
  if (!is_determined) return "This measurement would not determine all that it is to determine.";
  const Json& first = document.at("estimates").at(0);
  const auto error = number_in(first.at("standard_error"));
  if (!error) return "This measurement would determine what it is to determine.";
  const double value = first.at("value").get<double>();
  std::string text = fmt::format("This measurement would tell the {} to ±{} {}", input_words(first), read_number(*error, 2),
                                 unit_in_signs(first.at("unit").get<std::string>()));
  if (value != 0) text += fmt::format(", {} % of its value", read_number(100 * *error / std::abs(value), 2));
  return text + ".";
}

std::string optimum_html(const Json& optimum, const std::string& unit) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& choice : optimum.at("choices"))
    rows.push_back({setting_html(choice.at("pointer").get<std::string>()), number_html(choice.at("best"), "", 6),
                    number_html(choice.at("low"), "", 6), number_html(choice.at("high"), "", 6),
                    choice.at("at_limit").get<bool>() ? "yes" : "no", number_html(choice.at("given"), "", 6)});
  return "<p>The standard error there is " + number_html(optimum.at("standard_error"), unit, 3) + ".</p>\n" +
         table_html({"input", "best", "from", "to", "at a limit", "scenario's value"}, rows);
}

}  // namespace

Report plan_page(const Json& document, const std::vector<std::string>& notes) {
  const PlanReport report = pictured(document);
  const bool is_determined = document.at("outcome") == to_string(PlanOutcome::determined);
  const Json& plan = document.at("plan");
  Page page("plan", "Planned measurement of " + report.scenario_name, notes);
  const std::string advice = document.at("advice").get<std::string>(), reason = document.at("reason").get<std::string>();
  page.finding(escaped(finding_of(document, is_determined)));
  page.headline(escaped(in_words(document, is_determined ? advice : reason + (advice.empty() ? "" : ". " + advice))));
  page.verdict(is_determined ? "same" : "differs",
               is_determined ? "<strong>determined</strong>" : "<strong>not determined</strong>");
  std::string measured;
  for (const Json& quantity : plan.at("quantities"))
    measured += fmt::format("{}{} ± {}", measured.empty() ? "" : ", ", measured_html(quantity.at("name").get<std::string>()),
                            number_html(quantity.at("standard_error"), "", 6));
  Facts facts = {{"measured", measured},
                 {"every", number_html(plan.at("every_s"), "s", 6)},
                 {"until", number_html(plan.at("until_s"), "s", 6)},
                 {"rows", fmt::format("{}", count_in(plan.at("rows")))}};
  if (number_in(plan.at("correlation_time_s")).value_or(0) > 0)
    facts.emplace_back("errors are correlated over", number_html(plan.at("correlation_time_s"), "s", 6));
  std::string list;
  for (const Json& note : document.at("notes")) list += "<li>" + escaped(note.get<std::string>()) + "</li>\n";
  page.section("plan", "Plan", facts_html(facts) + (list.empty() ? "" : "<ul>" + list + "</ul>\n"));
  if (!is_determined) return page.finish();
  const std::string unit = report.estimates.at(0).unit;
  page.section("estimates", "Standard errors",
               errors_html(document) + releases_html(document, unit) + costs_html(document, unit) +
                   exact_inputs_html(document.at("estimates").at(0)));
  page.section(
      "changes", "What a change would do",
      page.chart("changes", plan_figure(report),
                 "The Cramér-Rao bound of the standard error when one thing in the plan is changed and the rest is kept."));
  if (const Json& optimum = document.at("optimum"); optimum.is_object())
    page.section("optimum", "Best within the limits", optimum_html(optimum, unit));
  return page.finish();
}

}  // namespace earthtop::report
