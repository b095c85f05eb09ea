// SPDX-License-Identifier: GPL-3.0-or-later
// Motion and numerics: what happens after the release.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "scenario/decode.hpp"
#include "scenario/fields.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {

double output_row_count(double duration_s, double output_step_s) {
  return std::max(1.0, std::ceil(duration_s / output_step_s - 1e-9)) + 1;
}

bool is_output_time(double t_s, double duration_s, double output_step_s) {
  const double slack = 1e-9 * output_step_s;
  if (std::abs(t_s - duration_s) <= slack) return true;
  return t_s <= duration_s && std::abs(t_s - std::round(t_s / output_step_s) * output_step_s) <= slack;
}

void decode_motion(const Section& motion, Scenario& scenario) {
  motion.require("duration_s");
  const auto duration = motion.number("duration_s");
  auto step = motion.number("output_step_s");
  if (!duration) return;
  if (!step && motion.has("output_step_s")) return;  // refused already
  if (!step) step = *duration / 1000;
  const double rows = output_row_count(*duration, *step);
  if (rows > kMostRows)
    return motion.refuse("output_step_s",
                         fmt::format("about {:.3g} output rows; at most {:.0f} are allowed: output_step_s must be "
                                     "at least {:.6g} s for this duration",
                                     rows, kMostRows, *duration / (kMostRows - 1)));
  scenario.duration_s = *duration;
  scenario.output_step_s = *step;
}

namespace {

/// The methods with a property, as words in quotes.
template <class Property>
std::string methods_that(Property property) {
  std::string words;
  for (const MethodRow& row : kMethodRows)
    if (property(row)) words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", row.word);
  return words;
}

constexpr ModelForm kForms[] = {ModelForm::automatic, ModelForm::general};
constexpr Observer kObservers[] = {Observer::laboratory, Observer::body, Observer::inertial};
constexpr LedgerObserver kLedgers[] = {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform,
                                       LedgerObserver::body};

/// A fixed step that is given, where the method takes one.
void decode_step(const Section& numerics, Scenario& scenario) {
  const Method method = scenario.numerics.method;
  const MethodRow& rule = row_of(method);
  if (rule.step_s == Need::none) {
    if (!numerics.has("step_s")) return;
    return numerics.refuse_key(
        "step_s", fmt::format("\"{}\" chooses its own steps from relative_tolerance; step_s belongs to {}", to_string(method),
                              methods_that([](const MethodRow& row) { return row.step_s != Need::none; })));
  }
  if (rule.step_s == Need::required) {
    if (numerics.has("relative_tolerance"))
      numerics.refuse_key(
          "relative_tolerance",
          fmt::format("{} has a fixed step and no tolerance; give step_s, or take a controlled method", to_string(method)));
    numerics.require("step_s");
  } else if (numerics.has("step_s") && numerics.has("relative_tolerance")) {
    numerics.refuse_key(
        "relative_tolerance",
        fmt::format("\"{}\" finds its step from it where no step_s is given; give one of the two", to_string(method)));
  }
  scenario.numerics.step_s = numerics.number("step_s");
  if (!scenario.numerics.step_s || !(scenario.duration_s > 0)) return;
  const double interval = std::min(scenario.output_step_s, scenario.duration_s), step = *scenario.numerics.step_s;
  const double steps = std::ceil(interval / step) * (output_row_count(scenario.duration_s, scenario.output_step_s) - 1);
  const auto limit = static_cast<double>(scenario.numerics.step_limit);
  if (steps > limit)
    numerics.refuse("step_s",
                    fmt::format("about {:.3g} steps; at most {:.3g} are allowed: step_s must be at least {:.6g} s for this "
                                "duration",
                                steps, limit, scenario.duration_s / limit));
}

/// What the scenario's precision allows: tolerances above its round-off, the methods that are built for it.
void check_precision(const Section& numerics, Scenario& scenario) {
  IntegrationOptions& options = scenario.numerics;
  const Precision precision = scenario.precision;
  const double least = least_tolerance(precision);
  if (!numerics.has("relative_tolerance"))
    options.relative_tolerance = default_tolerance(precision);
  else if (options.relative_tolerance < least)
    numerics.refuse(
        "relative_tolerance",
        fmt::format("{} is out of range; must be a number from {} to 0.1; below {} the rounding of {} precision, not "
                    "the step, decides the error",
                    options.relative_tolerance, least, least, to_string(precision)));
  if (is_built(options.method, precision)) return;
  const std::string built = methods_that([&](const MethodRow& row) { return is_built(row.method, precision); });
  numerics.refuse(
      "method", fmt::format("\"{}\" is not built for {}; must be {}", to_string(options.method), to_string(precision), built));
  options.method = Method::automatic;
}

}  // namespace

void decode_numerics(const Section& numerics, Scenario& scenario) {
  IntegrationOptions& options = scenario.numerics;
  const auto method = numerics.word("method"), observer = numerics.word("observer"), precision = numerics.word("precision");
  if (const auto tolerance = numerics.number("relative_tolerance")) options.relative_tolerance = *tolerance;
  if (const auto ledger = numerics.word("ledger"))
    scenario.ledger =
        *std::find_if(std::begin(kLedgers), std::end(kLedgers), [&](LedgerObserver o) { return to_string(o) == *ledger; });
  if (observer)
    options.observer =
        *std::find_if(std::begin(kObservers), std::end(kObservers), [&](Observer o) { return to_string(o) == *observer; });
  if (const auto form = numerics.word("model"))
    options.form = *std::find_if(std::begin(kForms), std::end(kForms), [&](ModelForm f) { return to_string(f) == *form; });
  if (precision)
    scenario.precision =
        *std::find_if(kPrecisions.begin(), kPrecisions.end(), [&](Precision p) { return to_string(p) == *precision; });
  if (method)
    options.method =
        std::find_if(kMethodRows.begin(), kMethodRows.end(), [&](auto& row) { return row.word == *method; })->method;
  const auto composition = numerics.word("composition");
  if (composition)
    options.composition =
        *std::find_if(kCompositions.begin(), kCompositions.end(), [&](Composition c) { return to_string(c) == *composition; });
  check_precision(numerics, scenario);
  if (!method || to_string(options.method) != *method) return;
  if (options.composition != Composition::automatic && !row_of(options.method).composes)
    numerics.refuse_key("composition", fmt::format("\"{}\" composes nothing; it belongs to {}", *method,
                                                   methods_that([](const MethodRow& row) { return row.composes; })));
  if (is_exact(options.method)) {
    for (const std::string_view key : {"relative_tolerance", "step_s"})
      if (numerics.has(key))
        numerics.refuse_key(
            key, fmt::format("\"{}\" takes no steps and has no tolerance; leave it out, or take another method", *method));
    return;
  }
  decode_step(numerics, scenario);
}

}  // namespace earthtop::scenario
