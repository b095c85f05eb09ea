// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/error.hpp"
#include "earthtop/plan/plan.hpp"
#include "exact_inputs_text.hpp"
#include "screen.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

std::string painted(std::string_view text, std::string_view code, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
}

/// A number and its unit, which may be empty.
std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + ' ' + unit;
}

std::string measured_text(const PlanReport& report) {
  std::string text;
  for (const PlannedQuantity& quantity : report.plan.quantities)
    text += fmt::format("{}{} ± {:g}", text.empty() ? "" : ", ", quantity.name, quantity.standard_error);
  text += fmt::format(", every {:g} s to {:g} s: {} rows", report.plan.every_s, *report.plan.until_s, report.rows);
  if (report.plan.correlation_time_s > 0)
    text += fmt::format("; errors correlated over {:g} s", report.plan.correlation_time_s);
  return text;
}

/// An estimate's name; with its release where there are several and it is not that of all.
std::string label(const PlannedEstimate& estimate) { return printable(name_in_release(estimate.name, estimate.release)); }

std::string estimates_text(const PlanReport& report, const Screen& screen) {
  std::size_t width = 0;
  for (const PlannedEstimate& estimate : report.estimates) width = std::max(width, label(estimate).size());
  std::string text = "\nStandard errors (Cramer-Rao bound)\n";
  for (std::size_t j = 0; j < report.estimates.size(); ++j) {
    const PlannedEstimate& e = report.estimates[j];
    std::string line = with_unit(fmt::format("{:.7g} ± {:.3g}", e.value, *e.standard_error), e.unit);
    if (!e.is_nuisance) line = painted(line, "1", screen.color);
    if (!e.is_nuisance && e.significance()) line += fmt::format(": {:.3g} sigma", *e.significance());
    if (e.prior) line += fmt::format("; known beforehand to ± {:.2g}", *e.prior);
    text += wrapped_entry("  " + label(e), line, screen.width, width + 4);
    if (report.estimates.size() == 1) continue;
    std::size_t most = j == 0 ? 1 : 0;
    for (std::size_t k = 0; k < report.estimates.size(); ++k)
      if (k != j && std::abs(report.correlation[j][k]) > std::abs(report.correlation[j][most])) most = k;
    text += wrapped_entry("",
                          fmt::format("± {:.3g} if the others were known exactly; largest correlation {:+.4f}, with {}",
                                      *e.standard_error_alone, report.correlation[j][most], label(report.estimates[most])),
                          screen.width, width + 4);
  }
  return text;
}

std::string error_text(const std::optional<double>& error, double now) {
  return error ? fmt::format("{:>10.3e}  {:>8.3g} times", *error, *error / now) : std::string("not determined");
}

std::string variations_text(const PlanReport& report) {
  const PlannedEstimate& target = report.estimates[0];
  const double now = *target.standard_error;
  const std::string of = with_unit("\nStandard error of " + label(target), target.unit.empty() ? "" : "(" + target.unit + ")");
  std::size_t width = 26;
  for (const PlanVariation& v : report.variations)
    if (v.change == PlanChange::known) width = std::max(width, v.input.size() + std::string_view(" known exactly").size());
  std::string known, table;
  for (const PlanVariation& v : report.variations) {
    std::string what;
    switch (v.change) {
      case PlanChange::known:
        known += fmt::format("  {:<{}}  {}\n", printable(v.input) + " known exactly", width, error_text(v.standard_error, now));
        continue;
      case PlanChange::duration: what = fmt::format("to {:g} s, {} rows", v.factor * *report.plan.until_s, v.rows); break;
      case PlanChange::rows: what = fmt::format("every {:g} s, {} rows", report.plan.every_s / v.factor, v.rows); break;
      case PlanChange::sigma:
        what = fmt::format("{} ± {:g}", report.plan.quantities[0].name, v.factor * report.plan.quantities[0].standard_error);
        if (report.plan.quantities.size() > 1) what += ", ...";
        break;
      case PlanChange::prior:
      case PlanChange::tilt: break;
    }
    table += fmt::format("  {:<{}}  {}\n", what, width, error_text(v.standard_error, now));
  }
  std::string text;
  if (!known.empty())
    text += fmt::format("{}: what each unknown costs\n  {:<{}}  {}\n{}", of, "now", width, error_text(now, now), known);
  return text + fmt::format("{}: duration, rows, sigma\n{}", of, table);
}

/// This table says how well each of several releases would tell the first estimate by itself; empty for one.
std::string releases_text(const PlanReport& report) {
  if (report.releases.empty()) return "";
  const PlannedEstimate& target = report.estimates[0];
  const double now = *target.standard_error;
  std::vector<std::string> names = {"all together"};
  for (const ReleasePlan& release : report.releases)
    names.push_back(fmt::format("{} alone, {}", names.size(), printable(release.scenario_name)));
  std::size_t width = 26;
  for (const std::string& name : names) width = std::max(width, name.size());
  std::string lines = fmt::format("  {:<{}}  {}\n", names[0], width, error_text(now, now));
  for (std::size_t r = 0; r < report.releases.size(); ++r)
    lines += fmt::format("  {:<{}}  {}\n", names[r + 1], width, error_text(report.releases[r].standard_error, now));
  return with_unit("\nStandard error of " + label(target), target.unit.empty() ? "" : "(" + target.unit + ")") +
         ": what each release tells\n" + lines;
}

/// Compares a standard error with the present one, than which it is smaller by a factor that may be less than 1.
std::string against_now(double gain) {
  const std::string times = fmt::format("{:.3g}", std::max(gain, 1 / gain));
  return times == "1" ? "as large as now" : fmt::format("{} times {} than now", times, gain < 1 ? "larger" : "smaller");
}

std::string optimum_text(const PlanReport& report, const Screen& screen) {
  const PlanOptimum& optimum = *report.optimum;
  const PlannedEstimate& target = report.estimates[0];
  std::string text =
      fmt::format("\nBest within the limits, {} designs tried{}\n", optimum.evaluations,
                  optimum.avoided > 0
                      ? fmt::format(", {} of them in vain: no motion to rely on, or numbers not determined", optimum.avoided)
                      : "");
  const auto add = [&](const std::string& line) { text += wrapped("  " + line, screen.width, 6) + '\n'; };
  std::string sets;
  for (const DesignChoice& choice : optimum.choices) {
    add(fmt::format("{}  {}, from {:g} to {:g}{}; the scenario's is {:g}", printable(choice.input.pointer),
                    painted(fmt::format("{:.6g}", choice.best), "1", screen.color), choice.input.low, choice.input.high,
                    choice.is_at_limit ? ", at the limit" : "", choice.given));
    sets += fmt::format(" --set {}={:.6g}", choice.input.pointer, choice.best);
  }
  add(fmt::format("{}  ± {}: {:.3g} sigma, {}; {} rows", printable(target.name),
                  with_unit(fmt::format("{:.2e}", optimum.standard_error), target.unit), optimum.significance,
                  against_now(*target.standard_error / optimum.standard_error), optimum.rows));
  return text + "  with" + printable(sets) + "\n";
}

}  // namespace

std::string plan_text(const PlanReport& report, const Screen& screen) {
  std::string names = printable(report.scenario_name);
  for (std::size_t r = 1; r < report.releases.size(); ++r)
    names += fmt::format("{}{}", r + 1 == report.releases.size() ? " and " : ", ", printable(report.releases[r].scenario_name));
  std::string text = wrapped(fmt::format("A measurement of {}", names), screen.width, 2) + '\n';
  const auto add = [&](std::string_view label, std::string_view what) { text += wrapped_entry(label, what, screen.width, 12); };
  add("Measured", measured_text(report));
  if (report.outcome == PlanOutcome::determined)
    add("Predicted",
        fmt::format("{} motions{}", report.predictions, report.verdict ? fmt::format("; {}", to_string(*report.verdict)) : ""));
  else
    add("Outcome", painted(fmt::format("{}: {}", to_string(report.outcome), printable(report.reason)), "31", screen.color));
  if (report.undetermined.size() > 1) {
    std::string changes;
    for (const auto& [name, change] : report.undetermined)
      changes += fmt::format("{}{} by {:+.3g}", changes.empty() ? "" : ", ", printable(name), change);
    add("", "a change that would not be seen: " + changes);
  }
  if (report.outcome == PlanOutcome::not_determined) add("Remedy", printable(report.advice));
  for (const std::string& note : report.notes) add("Note", printable(note));
  if (report.outcome != PlanOutcome::determined) return text;
  const PlannedEstimate& target = report.estimates[0];
  text += estimates_text(report, screen) + releases_text(report) +
          exact_inputs_text(target.exact, label(target), *target.standard_error, screen) + variations_text(report);
  if (report.optimum) text += optimum_text(report, screen);
  return text + '\n' + wrapped(printable(report.advice), screen.width) + '\n';
}

}  // namespace earthtop::tool
