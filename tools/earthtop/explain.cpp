// SPDX-License-Identifier: GPL-3.0-or-later
// earthtop explain: the effect budget of a scenario.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "command_line.hpp"
#include "earthtop/budget/budget.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/scenario/support.hpp"
#include "explain_text.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "results/compared_words.hpp"
#include "scenario_operand.hpp"
#include "screen.hpp"
#include "text/number_words.hpp"
#include "verbs.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

struct ExplainArguments {
  std::string scenario;  // a file, or "-"
  bool json = false;
  bool quiet = false;
  std::vector<std::string> sets;
};

std::string sized(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.2e}", *value) : "?";
}

std::string effects_text(const Budget& budget, std::size_t width) {
  std::string text =
      fmt::format("{:<24}{:<10}{:>10}{:>10}{:>12}{:>10}\n", "Effect", "", "torque", "largest", "moves axis", "drift");
  text += fmt::format("{:<24}{:<10}{:>10}{:>10}{:>12}{:>10}\n", "", "", "N m", "N m", "rad", "rad");
  for (const EffectEntry& entry : budget.effects) {
    const std::string in_each = entry.in_difference ? "-" : sized(entry.displacement_rad);
    text += fmt::format("{:<24}{:<10}{:>10}{:>10}{:>12}{:>10}\n", entry.name, entry.modelled ? "modelled" : "left out",
                        sized(entry.torque_release_N_m), sized(entry.torque_largest_N_m), in_each, sized(entry.drift_rad));
    text += wrapped("    " + entry.reason, width, 4) + '\n';
  }
  return text +
         wrapped(
             "moves axis: in both predictions alike, so that it cancels in their difference to first order; what remains is "
             "under drift",
             width, 4) +
         '\n' +
         wrapped(
             "drift: the effect's share of the difference between the two predictions; both columns at their largest, to "
             "first order",
             width, 4) +
         '\n';
}

std::string_view unit_of(const std::string& name) {
  const auto* row = std::ranges::find(kInputs, name, &InputRow::name);
  return row != kInputs.end() ? row->unit : "";
}

std::string inputs_text(const Budget& budget, std::size_t screen_width) {
  if (!budget.inputs_unavailable.empty()) return wrapped("Inputs: " + budget.inputs_unavailable, screen_width, 2) + '\n';
  std::string text =
      wrapped(fmt::format("How well the inputs must be known: the error of each that moves the axis as far as the "
                          "Earth does, {:.3e} rad",
                          budget.earth_drift_rad),
              screen_width, 2) +
      '\n';
  std::size_t width = 22;
  for (const InputNeed& need : budget.inputs) width = std::max(width, need.name.size() + 2);
  for (const InputNeed& need : budget.inputs) {
    const std::optional<double> share = need.hides_earth ? share_of(*need.hides_earth, std::abs(need.value)) : std::nullopt;
    const std::string relative = share ? fmt::format(", {:.1e} of it", *share) : "";
    text += fmt::format(
        "  {:<{}}{:>14.6g}   {}\n", need.name, width, need.value,
        need.hides_earth ? fmt::format("{:.2e} {}{}", *need.hides_earth, unit_of(need.name), relative) : "has no part in it");
  }
  return text +
         wrapped("  (for latitude and rotation rate: an error that changes the drift by its whole size)", screen_width, 3) +
         '\n';
}

std::string run_text(const Scene& scene, std::size_t width) {
  const MethodChoice& choice = scene.choice();
  return '\n' +
         wrapped(fmt::format("run would use {} ({}): some {:.2g} steps, {}", to_string(choice.options.method), choice.reason,
                             scene.estimate().solution.steps, about_seconds(estimated_run_seconds(scene))),
                 width, 2) +
         '\n';
}

std::string explained(const Budget& budget, const Scene& scene, std::size_t width) {
  const Scenario& scenario = scene.scenario();
  const std::string drift =
      std::isfinite(budget.earth_drift_rad) ? fmt::format("about {:.3e} rad", budget.earth_drift_rad) : "not known";
  const auto paragraph = [&](const std::string& sentence) { return wrapped(sentence, width, 2) + '\n'; };
  std::string text = scenario.name + '\n' +
                     paragraph(fmt::format("Drift by {} after {}: {}; {}", compared_words(scenario).cause,
                                           time_text(scenario.duration_s), drift, matching_rule(scenario)));
  text += rotor_equations_text(scene, width);
  text += '\n' + effects_text(budget, width) + '\n' + inputs_text(budget, width);
  if (std::isfinite(budget.earth_drift_rad) && budget.followed_s < scenario.duration_s * (1 - 1e-9))
    text +=
        '\n' + paragraph(fmt::format("The motion was followed for {:.4g} s; sizes after that are taken in proportion to time "
                                     "and drift.",
                                     budget.followed_s));
  text += run_text(scene, width);
  for (const std::string& warning : budget.warnings) text += paragraph("Warning: " + warning);
  return text;
}

/// The effect budget, computed with a progress display. Returns nothing if interrupted.
std::optional<Budget> watched_budget(Scene& scene, bool lively) {
  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(lively, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  std::optional<Budget> budget = explain_effects(scene, watch);
  if (budget) progress.reach(1);
  return budget;
}

/// The same for a top on a table: what it prints; nothing if interrupted.
std::optional<std::string> watched_explanation(const Scene& scene, bool lively, bool json) {
  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(lively, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  const ContactExplanation explained = explain_contact(scene, watch);
  if (watch.asks_to_stop()) return std::nullopt;
  progress.reach(1);
  const std::size_t width = output_screen().width;
  return json ? contact_explanation_json(explained, scene)
              : contact_explanation_text(explained, scene, width) + run_text(scene, width);
}

int explain_verb(const ExplainArguments& arguments) {
  const ScenarioSource source = scenario_of(arguments.scenario);
  ScenarioReport report = examine_scenario(source, split_sets(arguments.sets));
  if (!report.scene) throw ScenarioError(std::move(report.errors), source.file);
  if (!arguments.quiet) report_warnings(source.file, report.warnings);
  Scene scene = *std::move(report.scene);
  const bool lively = !arguments.quiet && !arguments.json;
  std::optional<std::string> text;
  if (scene.support().has_contact)
    text = watched_explanation(scene, lively, arguments.json);
  else if (const auto budget = watched_budget(scene, lively))
    text = arguments.json ? budget_json(*budget, scene) : explained(*budget, scene, output_screen().width);
  if (!text) return report_errors("", {{0, 0, "", "interrupted; nothing was written"}}, arguments.json, interrupted_status());
  print(*text);
  return kDone;
}

}  // namespace

Verb describe_explain() {
  auto arguments = std::make_shared<ExplainArguments>();
  Verb explain("explain", "print the effect budget: every torque, the drift that it causes, and why it is modelled or left out",
               [arguments] { return explain_verb(*arguments); });
  explain.add("SCENARIO", &arguments->scenario, kScenarioOperand).required().json_file();
  explain.add("--json", &arguments->json, "print the budget, or the errors, as one JSON document");
  explain.add("--quiet", &arguments->quiet, "print no warnings about the scenario");
  add_set_option(explain, arguments->sets);
  explain.describe(
      "Lists for each torque how large it is, how far it moves the axis, how much of that is drift, and whether the scenario "
      "models it. A second table says how well each input must be known for its error to move the axis by less than the Earth "
      "does, and a line below says which method run would use and how long it would take. For a top on a table, it lists the "
      "size of every force and of its torque, the drift, and how well friction and the table's tilt must be known. Nothing is "
      "written.");
  explain.example("earthtop explain toy-top.json", "prints the budget as a table");
  explain.example("earthtop explain toy-top.json --set /motion/duration_s=600", "the same for ten minutes");
  explain.example("earthtop example tippe-top | earthtop explain -",
                  "takes the scenario, a top on a table, from standard input");
  explain.ends_with(kDone, "the budget is printed");
  explain.ends_with(kRefused, "the command line or the scenario was refused");
  explain.ends_with(kWriteFailed, "reading the scenario broke off, or writing to standard output failed");
  return explain;
}

}  // namespace earthtop::tool
