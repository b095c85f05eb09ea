// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes motion and numerics, that is, what happens after the release.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "earthtop/frames/earth_orientation.hpp"
#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"
#include "text/number_words.hpp"

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
  Reading codec(motion);
  motion_keys(codec, scenario);
  if (scenario.start_utc && !parse_utc(*scenario.start_utc)) {
    motion.refuse("start_utc",
                  fmt::format("is \"{}\"; must be an instant of UTC, YYYY-MM-DDThh:mm:ssZ", excerpt(*scenario.start_utc)));
    scenario.start_utc.reset();
  }
  const double duration = std::exchange(scenario.duration_s, 0), given_step = std::exchange(scenario.output_step_s, 0);
  if (!motion.number("duration_s")) return;
  if (!motion.number("output_step_s") && motion.has("output_step_s")) return;  // refused already
  const double step = motion.has("output_step_s") ? given_step : duration / 1000;
  const double rows = output_row_count(duration, step);
  if (rows > kMostRows)
    return motion.refuse(
        "output_step_s",
        fmt::format("about {} output rows; at most {:.0f} are allowed: output_step_s must be at least {} s for "
                    "this duration",
                    told_apart(rows, kMostRows, 3).first, kMostRows, least_text(duration / (kMostRows - 1))));
  scenario.duration_s = duration;
  scenario.output_step_s = step;
}

namespace {

/// Returns the methods with a property, as words in quotes.
template <class Property>
std::string methods_that(Property property) {
  std::string words;
  for (const MethodRow& row : kMethodRows)
    if (property(row)) words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", row.word);
  return words;
}

/// Decodes a given fixed step, and checks that the method takes one.
void decode_step(const Section& numerics, Scenario& scenario) {
  const Method method = scenario.numerics.method;
  const MethodRow& rule = row_of(method);
  if (rule.step_s == Need::none) {
    scenario.numerics.step_s.reset();
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
  if (!scenario.numerics.step_s || !(scenario.duration_s > 0)) return;
  // Each interval between rows has a whole number of steps; one that is a rounding shorter than they are counts as theirs.
  const double interval = std::min(scenario.output_step_s, scenario.duration_s), step = *scenario.numerics.step_s;
  const double intervals = output_row_count(scenario.duration_s, scenario.output_step_s) - 1;
  const double steps = std::ceil(interval / step * (1 - 1e-12)) * intervals;
  const auto limit = static_cast<double>(scenario.numerics.step_limit);
  if (!(steps > limit)) return;
  const auto [shown, most] = told_apart(steps, limit, 3);
  numerics.refuse("step_s",
                  fmt::format("about {} steps; at most {} are allowed: step_s must be at least {} s for this duration", shown,
                              most, least_text(interval / std::max(1.0, std::floor(limit / intervals)))));
}

/// Checks that the tolerance is above the precision's round-off and that the method is built for it.
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
  Reading codec(numerics);
  numerics_keys(codec, scenario);
  const auto method = numerics.word("method");
  check_precision(numerics, scenario);
  if (!method || to_string(options.method) != *method) return options.step_s.reset();
  if (options.composition != Composition::automatic && !row_of(options.method).composes)
    numerics.refuse_key("composition", fmt::format("\"{}\" does not compose flows; a composition belongs to {}", *method,
                                                   methods_that([](const MethodRow& row) { return row.composes; })));
  if (is_exact(options.method)) {
    options.step_s.reset();
    for (const std::string_view key : {"relative_tolerance", "step_s"})
      if (numerics.has(key))
        numerics.refuse_key(
            key, fmt::format("\"{}\" takes no steps and has no tolerance; leave it out, or take another method", *method));
    return;
  }
  decode_step(numerics, scenario);
}

}  // namespace earthtop::scenario
