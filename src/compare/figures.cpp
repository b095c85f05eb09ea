// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/tolerances.hpp"
#include "results/figures.hpp"
#include "text/json.hpp"

namespace earthtop::compare {
namespace {

using Figures = std::vector<std::pair<std::string, const Json*>>;

/// Collects the leaves of a JSON value by their dotted paths. An element of a list is called by its name, if it has one.
void flatten(const Json& json, const std::string& path, Figures& figures) {
  const std::string start = path.empty() ? "" : path + ".";
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) flatten(value, start + key, figures);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      const bool named = json[i].is_object() && json[i].contains("name") && json[i].at("name").is_string();
      flatten(json[i], start + (named ? json[i].at("name").get<std::string>() : fmt::format("{}", i)), figures);
    }
  } else {
    figures.emplace_back(path, &json);
  }
}

/// The table's entry of a figure that is compared; null for one that is not.
const SummaryMember* compared_member(const std::string& path) {
  const SummaryMember* member = find_member(path);
  return member && is_compared(member->kind) ? member : nullptr;
}

/// Gives the sum of both results' error bounds on a figure, in the figure's unit; none where a bound is missing.
class FigureErrors {
 public:
  FigureErrors(const Comparand& a, const Comparand& b) : a_(&a), b_(&b) {
    const auto sum = [&](const std::string& pointer) -> std::optional<double> {
      const auto x = a.number(pointer), y = b.number(pointer);
      return x && y ? std::optional(*x + *y) : std::nullopt;
    };
    axis_ = sum("/drift/axis_bound_rad");
    attitude_drift_ = sum("/drift/attitude_bound_rad");
    attitude_ = sum("/attitude_bound_rad");
    tip_ = sum("/drift/tip_bound_m");
    tip_drift_m_ = a.number("/drift/tip_max_m").value_or(0);
    for (std::size_t i = 0; a.number(fmt::format("/contact/events/{}/t_s", i)); ++i)
      events_.push_back(sum(fmt::format("/contact/events/{}/bound_s", i)));
    axis_drift_rad_ = a.number("/drift/axis_max_rad").value_or(0);
    final_rad_ = a.number("/drift/axis_final_rad").value_or(0);
    azimuth_rad_ = a.number("/drift/azimuth_max_rad").value_or(0);
    threshold_time_ = sum("/drift/threshold_time_bound_s");
    trend_ = sum("/drift/secular/azimuth_rate_bound_95_rad_s");
    ratio_ = a.number("/drift/axis_final_over_earth_angle").value_or(0);
  }
  /// Size of the Earth's effect, for a figure of this kind.
  double effect(FigureKind kind) const { return kind == FigureKind::drift_tip ? tip_drift_m_ : axis_drift_rad_; }

  /// @param path  for an invariant's figure: tells which invariant's scale the error has
  std::optional<double> of(FigureKind kind, const std::string& path, const Comparand& reference) const {
    const std::optional<double> error = of_kind(kind, path, reference);
    return error ? std::optional(std::max(*error, of_largest(path))) : error;
  }

 private:
  /// Returns the sum of the bounds that both results state on a largest value; 0 for another figure, and where none is stated.
  double of_largest(std::string path) const {
    const std::size_t at = path.find("_max_");
    if (at == path.npos) return 0;
    path.replace(at, std::string_view("_max_").size(), "_max_bound_");
    std::ranges::replace(path, '.', '/');
    return a_->number('/' + path).value_or(0) + b_->number('/' + path).value_or(0);
  }
  std::optional<double> of_kind(FigureKind kind, const std::string& path, const Comparand& reference) const {
    // An error of the axis causes an error of its azimuth that is larger by 1 / sin(tilt), but no summary states the tilt. The
    // ratio of the largest azimuth drift to that of the axis is used instead, with a factor for rows nearer to the vertical.
    const double steeper = kNearVertical * (axis_drift_rad_ > 0 ? std::max(1.0, azimuth_rad_ / axis_drift_rad_) : 1);
    // The directions along which a drift is split into its parts turn by the attitudes' errors, and more near the vertical.
    const double turned = axis_drift_rad_ * attitude_.value_or(0);
    switch (kind) {
      case FigureKind::drift_axis: return axis_;
      case FigureKind::drift_tilt: return axis_ ? std::optional(*axis_ + turned * steeper) : std::nullopt;
      case FigureKind::drift_azimuth: return axis_ ? std::optional((*axis_ + turned * steeper) * steeper) : std::nullopt;
      case FigureKind::azimuth_rate: return trend_;
      case FigureKind::drift_attitude:
      case FigureKind::drift_spin: return attitude_drift_;
      case FigureKind::attitude: return attitude_;
      case FigureKind::ratio: return axis_ && final_rad_ > 0 ? std::optional(*axis_ / final_rad_ * ratio_) : std::nullopt;
      case FigureKind::conserved:
        return attitude_ ? std::optional((*attitude_ + kRounding) * scale_of(path, reference)) : std::nullopt;
      case FigureKind::threshold_time: return threshold_time_;
      case FigureKind::drift_tip: return tip_;
      case FigureKind::event_time: return event(path);
      default: return std::nullopt;
    }
  }

  static constexpr double kNearVertical = 10;
  static constexpr double kRounding = 1e-12;  // thousands of steps with some roundings each

  /// The scale of the invariant that the path leads to.
  static double scale_of(const std::string& path, const Comparand& reference) {
    for (const Json& invariant : reference.summary->value("invariants", Json::array()))
      if (path.starts_with("invariants." + invariant.value("name", "") + ".")) return std::abs(invariant.value("scale", 0.0));
    return 0;
  }

  /// Sum of the bounds on an event's time, from the path of one of its figures.
  std::optional<double> event(std::string_view path) const {
    path.remove_prefix(std::string_view("contact.events.").size());
    std::size_t number = 0;
    std::from_chars(path.data(), path.data() + path.size(), number);
    return number < events_.size() ? events_[number] : std::nullopt;
  }

  const Comparand *a_, *b_;
  std::optional<double> axis_, attitude_drift_, attitude_, threshold_time_, trend_, tip_;
  std::vector<std::optional<double>> events_;
  double tip_drift_m_ = 0, axis_drift_rad_ = 0, final_rad_ = 0, azimuth_rad_ = 0, ratio_ = 0;
};

QuantityVerdict failed(const std::string& name, std::string reason) {
  QuantityVerdict verdict;
  verdict.name = name;
  verdict.passed = false;
  verdict.violations = 1;
  verdict.reason = std::move(reason);
  verdict.change = Change::unknown;
  return verdict;
}

constexpr double kAnySize = std::numeric_limits<double>::max();  // no limit: the errors of other figures are limited already

std::string text_of(const Json& json) { return written_replacing(json); }

/// By what a figure is judged.
struct Measures {
  const FigureErrors& errors;
  const Rule& rule;
  double size_beside = 0;          ///< what a member beside it says of its size; 0 where none does
  double interpolation_error = 0;  ///< of a figure that was interpolated between rows
};

QuantityVerdict judge(const std::string& name, const SummaryMember& member, const Json& a, const Json& b, const Measures& by,
                      const Comparand& reference) {
  const FigureKind kind = member.kind;
  const Rule& rule = by.rule;
  const bool always_there = kind == FigureKind::drift_axis || kind == FigureKind::drift_attitude ||
                            kind == FigureKind::drift_spin || kind == FigureKind::attitude || kind == FigureKind::conserved;
  // A run without a row after the release has the verdict `unassessed`, and no numbers.
  const bool none_stated = a.is_null() && b.is_null() && reference.word("/drift/verdict") == to_string(Verdict::unassessed);
  if (always_there && !none_stated && (a.is_null() || b.is_null())) return failed(name, "not a finite number");
  if (!a.is_number() || !b.is_number()) {
    if (a != b) return failed(name, fmt::format("{} in the reference, {} now", text_of(a), text_of(b)));
    QuantityVerdict same;
    same.name = name;
    same.compared = 1;
    same.origin = "equal";
    return same;
  }
  QuantityVerdict verdict;
  verdict.name = name;
  verdict.compared = 1;
  const auto x = a.get<double>(), y = b.get<double>();
  const bool folds = is_angle(kind);
  verdict.largest = folds ? std::abs(std::remainder(x - y, 2 * std::numbers::pi)) : std::abs(x - y);
  verdict.errors = by.errors.of(kind, name, reference);
  const double folded = folds ? std::abs(std::remainder(x, 2 * std::numbers::pi)) : std::abs(x);
  const double size = kind == FigureKind::attitude ? 1 : folded;
  const bool is_drift = kind == FigureKind::drift_tilt || kind == FigureKind::drift_azimuth || kind == FigureKind::attitude ||
                        kind == FigureKind::drift_axis || kind == FigureKind::drift_attitude ||
                        kind == FigureKind::drift_spin || kind == FigureKind::drift_tip;
  const double effect = is_drift ? std::max(folded, by.errors.effect(kind)) : kAnySize;
  Tolerance tolerance = tolerance_of(rule, size, effect, verdict.errors.value_or(0));
  if (const double beside = rule.beside * by.size_beside; beside > tolerance.value)
    tolerance = {beside, fmt::format("{:g} x {} {:.3g} ({})", rule.beside, member.sized_by, by.size_beside, rule.source)};
  if (rule.times > 0 && !are_of_one_size(x, y, rule.times, 0)) tolerance.value = 0;
  if (rule.times > 0 && tolerance.value > 0) tolerance.value = std::max(tolerance.value, verdict.largest);
  if (by.interpolation_error > 0) {
    verdict.interpolation_error = by.interpolation_error;
    tolerance.value += by.interpolation_error;
    tolerance.origin += interpolation_words(by.interpolation_error);
  }
  verdict.tolerance = tolerance.value;
  verdict.origin = tolerance.origin;
  verdict.passed = verdict.largest <= tolerance.value;
  verdict.violations = verdict.passed ? 0 : 1;
  if (verdict.largest > 0)
    verdict.share = tolerance.value > 0 ? verdict.largest / tolerance.value : std::numeric_limits<double>::infinity();
  if (verdict.largest == 0)
    verdict.change = Change::none;
  else if (!verdict.errors)
    verdict.change = Change::unknown;
  else
    verdict.change = verdict.largest <= *verdict.errors ? Change::within_errors : Change::above_errors;
  return verdict;
}

/// The error of a figure of the end that is interpolated between the longer run's rows; 0 for others.
double interpolation_error(const SummaryMember& member, const FigureContext& context) {
  if (!context.longer || context.longer->interpolation_error.empty() || member.of_row.empty()) return 0;
  const auto& measures = trajectory_table().measures;
  const auto quantity = std::find_if(kDriftQuantities.begin(), kDriftQuantities.end(),
                                     [&](const RowQuantity& q) { return q.is_called(member.of_row); });
  const auto measure =
      std::find_if(measures.begin(), measures.end(), [&](const Measure& m) { return m.name == quantity->measure; });
  return context.longer->interpolation_error[static_cast<std::size_t>(measure - measures.begin())];
}

}  // namespace

FiguresComparison compare_figures(const Comparand& reference, const Comparand& candidate, const FigureContext& context,
                                  const CompareOptions& options) {
  FiguresComparison found;
  Figures old_figures, new_figures;
  flatten(*reference.summary, "", old_figures);
  flatten(*candidate.summary, "", new_figures);
  const FigureErrors errors(reference, candidate);
  const auto find = [](const Figures& figures, const std::string& path) -> const Json* {
    const auto at = std::find_if(figures.begin(), figures.end(), [&](const auto& figure) { return figure.first == path; });
    return at == figures.end() ? nullptr : at->second;
  };
  /// The size that a member beside a figure states, the smaller one of both; 0 where none does.
  const auto size_beside = [&](const SummaryMember& member, const std::string& path) {
    if (member.sized_by.empty()) return 0.0;
    const std::string beside = path.substr(0, path.rfind('.') + 1) + std::string(member.sized_by);
    const Json *a = find(old_figures, beside), *b = find(new_figures, beside);
    return a && b && a->is_number() && b->is_number() ? std::min(std::abs(a->get<double>()), std::abs(b->get<double>())) : 0.0;
  };
  const bool bitwise = options.tolerances.profile == Profile::bitwise;
  /// Whether a figure is left out; where that is so because of unlike lengths, it is told.
  const auto is_left_out = [&](const SummaryMember& member, const std::string& path) {
    using enum FigureScope;
    if (context.longer) {
      const std::string_view why = why_left_out(member, path, reference, candidate, *context.longer);
      const auto is_told = [](const Json* figure) { return figure && !figure->is_null(); };
      if (!why.empty() && (is_told(find(old_figures, path)) || is_told(find(new_figures, path))))
        found.left_out.push_back({path, why});
      if (!why.empty()) return true;
    }
    if (!bitwise && !context.whole_run && (member.scope == motion || member.scope == rows || member.scope == end)) {
      const bool is_known = member.scope == end && !member.of_row.empty() && context.end_trusted;
      if (!is_known) return true;
    }
    return (member.scope == rows && !context.same_rows) || (member.scope == motion && !context.both_of_motion);
  };
  for (const auto& [path, value] : old_figures) {
    const SummaryMember* member = compared_member(path);
    const auto rule = member ? rule_of(path, member->kind, options.tolerances, context.same_computation) : std::nullopt;
    if (!rule || is_left_out(*member, path)) continue;
    const Json* now = find(new_figures, path);
    if (!now) {
      found.quantities.push_back(failed(path, "is missing in the new summary"));
      continue;
    }
    const double interpolation = interpolation_error(*member, context);
    QuantityVerdict verdict =
        judge(path, *member, *value, *now, {errors, *rule, size_beside(*member, path), interpolation}, reference);
    if (interpolation > 0 && 2 * interpolation > verdict.tolerance)
      found.left_out.push_back({path, kNoRow});  // interpolation tells less than the tolerance
    else
      found.quantities.push_back(std::move(verdict));
  }
  if (options.tolerances.profile != Profile::physics && !reference.has_some_rows_only)
    for (const auto& [path, value] : new_figures)
      if (const SummaryMember* member = compared_member(path);
          !value->is_null() && member && !member->of_scenario && !find(old_figures, path) && !is_left_out(*member, path))
        found.quantities.push_back(failed(path, "is missing in the reference's summary"));
  return found;
}

}  // namespace earthtop::compare
