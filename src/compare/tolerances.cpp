// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/tolerances.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/fields.hpp"
#include "earthtop/error.hpp"
#include "input/check.hpp"
#include "input/file.hpp"
#include "input/section.hpp"

namespace earthtop {
namespace compare {
namespace {

using namespace input;

constexpr double kNoEffect = 1e-6;        // where there is no such effect: in rad, or as part of the quantity's size
constexpr double kRoundingAngle = 1e-13;  // rad
constexpr double kOrderOfMagnitude = 10;  // largest ratio of two errors
constexpr double kTorque = 1e-9;          // part of a torque's largest value: many times the state's error
constexpr double kContact = 1e-8;    // part of a quantity of the contact for which no row states bounds: as of a torque, but
                                     // slip and tip lose a digit where a tippe top turns over
constexpr double kDerived = 1e-6;    // part of a number computed from several, for which no summary states bounds
constexpr double kTime = 1e-3;       // part of a time at which disturbances have grown: growth is computed to some percent
constexpr double kEventTime = 1e-9;  // part of the time of a contact's event: far more than the last digit of a root found
constexpr double kOfSize = 0.1;      // part of a quantity's size: upper limit of error bounds where there is no effect
constexpr double kSmall = 0.01;      // part of the largest error; smaller errors count as equal in size
// Tolerances for the same computation, rounded otherwise: parts of a quantity's size, and of the error bounds, which are larger
// where rounding has more time to add up.
constexpr double kSame = 1e-10, kSameOfBounds = 0.01, kSameOfRateBounds = 0.001, kSameTimes = 1e-6;

bool is_error(const Measure& measure) { return measure.part == RowPart::error && measure.kind != MeasureKind::flag; }
/// Whether two values are equal or not, and nothing between.
bool is_exact(const Measure& measure) { return measure.kind == MeasureKind::flag || measure.kind == MeasureKind::word; }

std::optional<Rule> regression_rule(const Measure& measure, bool same_computation) {
  if (is_error(measure)) return same_computation ? std::optional(Rule{0, 0, 0, 0, "", kOrderOfMagnitude}) : std::nullopt;
  if (is_exact(measure)) return Rule{};
  if (same_computation && measure.bound == BoundKind::rates) return Rule{0, kRoundingOfSize, 0, kSameOfRateBounds, ""};
  if (same_computation) return Rule{0, kSame, 0, kSameOfBounds, ""};
  if (measure.owner == RowOwner::contact && measure.bound == BoundKind::none) return Rule{0, kContact, 0, 0, ""};
  switch (measure.kind) {
    case MeasureKind::attitude:
    case MeasureKind::direction: return Rule{kRoundingAngle, 0, 0, 1, ""};
    case MeasureKind::vector: return Rule{0, measure.bound == BoundKind::none ? kTorque : kRoundingOfSize, 0, 1, ""};
    default: return Rule{0, kRoundingOfSize, 0, 1, ""};
  }
}

std::optional<Rule> physics_rule(const Measure& measure, double effect) {
  if (is_error(measure) || is_exact(measure)) return std::nullopt;
  if (measure.effect.empty()) return Rule{0, kOfEffect, 0, 0, ""};
  if (effect > 0) return Rule{0, 0, kOfEffect, 1, ""};
  const bool is_angle = measure.name.ends_with("_rad");
  return Rule{is_angle ? kNoEffect : 0, is_angle ? 0 : kNoEffect, 0, 1, ""};
}

std::optional<Rule> regression_rule(FigureKind kind, bool same_computation) {
  if (kind == FigureKind::word || kind == FigureKind::outcome) return Rule{};
  if (kind == FigureKind::time || kind == FigureKind::threshold_time)
    return Rule{0, same_computation ? kSameTimes : kTime, 0, 0, ""};
  if (kind == FigureKind::event_time) return Rule{0, same_computation ? kSame : kEventTime, 0, 1, ""};
  if (kind == FigureKind::error)
    return same_computation ? std::optional(Rule{0, 0, 0, 0, "", kOrderOfMagnitude}) : std::nullopt;
  if (kind == FigureKind::conserved) return Rule{0, 0, 0, 1, ""};
  const double beside = kind == FigureKind::input ? kRoundingOfSize : kind == FigureKind::derived ? kDerived : 0;
  if (same_computation) return Rule{0, kSame, 0, kSameOfBounds, "", 0, beside};
  if (beside > 0) return Rule{0, beside, 0, 0, "", 0, beside};
  return Rule{kind == FigureKind::attitude ? kRoundingAngle : 0, kind == FigureKind::attitude ? 0 : kRoundingOfSize, 0, 1, ""};
}

std::optional<Rule> physics_rule(FigureKind kind) {
  switch (kind) {
    case FigureKind::outcome: return Rule{};
    case FigureKind::drift_axis:
    case FigureKind::drift_tilt:
    case FigureKind::drift_azimuth:
    case FigureKind::azimuth_rate:
    case FigureKind::drift_attitude:
    case FigureKind::drift_spin:
    case FigureKind::drift_tip:
    case FigureKind::event_time:
    case FigureKind::ratio: return Rule{0, kOfEffect, 0, 1, ""};
    case FigureKind::attitude: return Rule{0, 0, kOfEffect, 1, ""};
    case FigureKind::time:
    case FigureKind::threshold_time: return Rule{0, 50 * kTime, 0, 0, ""};
    default: return std::nullopt;
  }
}

/// The rule after the changes that a tolerance file makes for this quantity. A part that the file does not name counts as 0:
/// otherwise nobody could ask for a smaller tolerance than the profile's.
std::optional<Rule> changed(std::optional<Rule> rule, const std::string& name, const Tolerances& tolerances) {
  const auto given = tolerances.rules.find(name);
  if (given != tolerances.rules.end())
    return Rule{given->second.absolute.value_or(0),
                given->second.relative.value_or(0),
                0,
                given->second.bounds.value_or(0),
                tolerances.file,
                0};
  if (rule) rule->source = fmt::format("profile {}", to_string(tolerances.profile));
  return rule;
}

std::optional<double> limit_of(const Node& node, std::string_view key, const std::string& pointer, Findings& findings) {
  const Node* value = node.find(key);
  if (!value || value->kind == JsonKind::refused) return std::nullopt;
  if (value->kind == JsonKind::number && value->number >= 0) return value->number;
  findings.add(value->place, fmt::format("{}/{}", pointer, key), "must be a number of at least 0");
  return std::nullopt;
}

void decode_rules(const Node& quantities, Findings& findings, Tolerances& tolerances) {
  if (quantities.kind != JsonKind::object)
    return findings.add(quantities.place, "/quantities", "must be an object of quantity names and their tolerances");
  for (const Node& given : quantities.children) {
    if (is_comment(given.key)) continue;
    const std::string pointer = "/quantities" + pointer_step(given.key);
    const bool known = given.key.find('.') != std::string::npos ||
                       std::any_of(trajectory_table().measures.begin(), trajectory_table().measures.end(),
                                   [&](const Measure& measure) { return measure.name == given.key; }) ||
                       std::any_of(torques_table().measures.begin(), torques_table().measures.end(),
                                   [&](const Measure& measure) { return measure.name == given.key; });
    if (!known) {
      std::string names;
      for (const Measure& measure : trajectory_table().measures) names += fmt::format(", {}", measure.name);
      for (const Measure& measure : torques_table().measures) names += fmt::format(", {}", measure.name);
      findings.add(given.key_place, pointer,
                   fmt::format("is not a known quantity; known are the dotted paths of summary.json{}", names));
      continue;
    }
    if (given.kind != JsonKind::object) {
      findings.add(given.place, pointer, "must be an object with absolute, relative or bounds");
      continue;
    }
    for (const Node& member : given.children)
      if (!is_comment(member.key) && member.key != "absolute" && member.key != "relative" && member.key != "bounds")
        findings.add(member.key_place, pointer + pointer_step(member.key),
                     "unknown key; allowed here: absolute, relative, bounds");
    tolerances.rules[given.key] = {limit_of(given, "absolute", pointer, findings),
                                   limit_of(given, "relative", pointer, findings),
                                   limit_of(given, "bounds", pointer, findings)};
  }
}

}  // namespace

double fixed_part(const Rule& rule, double scale, double effect) {
  return std::max({rule.absolute, rule.relative * scale, rule.effect * effect});
}

std::string interpolation_words(double error) { return fmt::format(" + interpolation {:.2g}", error); }

double largest_for_bounds(double scale, double effect) {
  if (effect > 0) return effect;
  return kOfSize * (scale > 0 ? scale : 1);
}

bool are_of_one_size(double a, double b, double times, double largest) {
  if (a == b) return true;
  if (!(a >= 0) || !(b >= 0)) return false;
  return std::max(a, b) <= times * std::min(a, b) || std::max(a, b) <= kSmall * largest;
}

Tolerance tolerance_of(const Rule& rule, double scale, double effect, double errors) {
  if (rule.times > 0) return {rule.times * scale, fmt::format("a factor of {:g} ({})", rule.times, rule.source)};
  const double most = largest_for_bounds(scale, effect);
  const double by_bounds = std::min(rule.bounds * errors, most), value = std::max(fixed_part(rule, scale, effect), by_bounds);
  std::string part = "exact";
  if (value > 0 && value == by_bounds && by_bounds == most)
    part = "the largest that error bounds may allow here";
  else if (value > 0 && value == by_bounds)
    part = rule.bounds == 1 ? "both error bounds" : fmt::format("{:g} x both error bounds", rule.bounds);
  else if (value > 0 && value == rule.absolute)
    part = "absolute";
  else if (value > 0 && value == rule.relative * scale)
    part = fmt::format("{:g} x its size {:.3g}", rule.relative, scale);
  else if (value > 0)
    part = fmt::format("{:g} x the Earth's effect {:.3g}", rule.effect, effect);
  return {value, fmt::format("{} ({})", part, rule.source)};
}

std::optional<Rule> rule_of(const Measure& measure, const Tolerances& tolerances, bool same_computation, double effect) {
  std::optional<Rule> rule = Rule{};
  if (tolerances.profile == Profile::regression) rule = regression_rule(measure, same_computation);
  if (tolerances.profile == Profile::physics) rule = physics_rule(measure, effect);
  return changed(rule, std::string(measure.name), tolerances);
}

std::optional<Rule> rule_of(const std::string& name, FigureKind kind, const Tolerances& tolerances, bool same_computation) {
  std::optional<Rule> rule = Rule{};
  if (tolerances.profile == Profile::regression) rule = regression_rule(kind, same_computation);
  if (tolerances.profile == Profile::physics) rule = physics_rule(kind);
  return changed(rule, name, tolerances);
}

}  // namespace compare

std::string_view to_string(Profile profile) {
  switch (profile) {
    case Profile::bitwise: return "bitwise";
    case Profile::regression: return "regression";
    case Profile::physics: return "physics";
  }
  return "unknown";
}

Tolerances read_tolerances(const std::string& file) {
  using namespace input;
  const std::string content = read_regular_file(file, file, {"tolerance file", false});
  std::string_view text = content;
  Findings findings;
  const Node root = read_checked(text, file, compare::tolerances_fields(), findings);
  const Section section(root, findings, compare::tolerances_fields());
  Tolerances tolerances;
  tolerances.file = file;
  const auto profile = section.word("profile");
  for (const Profile known : {Profile::bitwise, Profile::regression, Profile::physics})
    if (profile == to_string(known)) tolerances.profile = known;
  if (const Node* quantities = section.any("quantities")) compare::decode_rules(*quantities, findings, tolerances);
  tolerances.steps_ratio = section.section("cost").number("steps_ratio");
  tolerances.seconds_ratio = section.section("cost").number("seconds_ratio");
  if (!findings.empty()) throw ScenarioError(findings.errors(text), file);
  return tolerances;
}

}  // namespace earthtop
