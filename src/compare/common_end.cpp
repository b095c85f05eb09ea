// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/common_end.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/interpolate.hpp"
#include "compare/pairing.hpp"
#include "compare/scenario_changes.hpp"
#include "compare/survey.hpp"
#include "compare/tell.hpp"

namespace earthtop::compare {
namespace {

constexpr double kSameEnd = 1e-12;  // part of a run's length within which two ends are one
constexpr std::string_view kOfWholeRun = "a figure of a whole run has no common meaning for runs of unlike lengths",
                           kNoEvent = "no event before the common end tells it";

/// A table of a single row, which has nothing but its time.
class OneTime : public RowSource {
 public:
  explicit OneTime(double t_s) : t_s_(t_s) {}
  bool next(Row& row) override {
    row.t_s = t_s_;
    return !std::exchange(read_, true);
  }
  bool has_column(std::size_t) const override { return false; }
  std::string where() const override { return ""; }

 private:
  double t_s_;
  bool read_ = false;
};

/// The rows of another source, for as long as the watch does not ask to stop.
class WatchedRows : public RowSource {
 public:
  WatchedRows(RowSource& rows, const Watch& watch) : rows_(rows), watch_(watch) {}
  bool next(Row& row) override {
    if (watch_.asks_to_stop()) throw Interrupted();
    return rows_.next(row);
  }
  bool has_column(std::size_t column) const override { return rows_.has_column(column); }
  std::string where() const override { return rows_.where(); }

 private:
  RowSource& rows_;
  const Watch& watch_;
};

/// Finds the longer run's row at the common end, from its rows about it if there is none.
void find_row(const Comparand& comparand, const Survey& known, const Watch& watch, LongerRun& longer) {
  const double t_s = longer.end.t_s;
  const auto rows = comparand.open_rows();
  WatchedRows watched(*rows, watch);
  OneTime common(t_s);
  Pairing pairing(watched, common, known, comparand.has_some_rows_only);
  const PairedRow paired = pairing.next();
  if (paired.kind == PairKind::same_time) longer.row = *paired.reference[1];
  if (paired.kind != PairKind::between) return;
  const auto surveyed = comparand.open_rows();
  const Survey errors = survey(*surveyed, trajectory_table(), true, watch, t_s);
  if (errors.largest_rate_rad_s * errors.largest_step_s > kMostTurnBetweenRows) return;
  longer.row = interpolate(paired.reference, t_s);
  longer.interpolation_error = errors.interpolation_error;
}

/// Puts what the rows tell of the common end into the summary of the longer run.
void tell_common_end(const Comparand& shorter, const Survey& known, LongerRun& longer) {
  const Table& table = trajectory_table();
  Json summary = *longer.comparand.summary;
  const auto put = [&](const std::string& pointer, const Json& value) { summary[Json::json_pointer(pointer)] = value; };
  const auto largest = [&](std::string_view measure) {
    for (std::size_t i = 0; i < table.measures.size(); ++i)
      if (table.measures[i].name == measure) return known.largest[i];
    return 0.0;
  };
  for (const SummaryMember& member : summary_members()) {
    if (member.of_row.empty() || !longer.row) continue;
    const auto quantity = std::find_if(kDriftQuantities.begin(), kDriftQuantities.end(),
                                       [&](const RowQuantity& q) { return q.is_called(member.of_row); });
    std::string pointer = "/" + std::string(member.path);
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    if (!summary.contains(Json::json_pointer(pointer))) continue;
    for (std::size_t i = 0; i < quantity->width(); ++i) {
      const std::size_t column = *table.find(quantity->column(i));
      put(quantity->width() == 1 ? pointer : fmt::format("{}/{}", pointer, i),
          longer.row->kind[column] == CellKind::number ? Json(longer.row->value[column]) : Json());
    }
  }
  // The attitudes' errors are stated for a whole run alone. Until the common end they are taken to have grown as those of the drift
  // have, which the rows state, and to be at least as many times those as in the shorter run.
  const auto whole = longer.comparand.number("/attitude_bound_rad"),
             whole_drift = longer.comparand.number("/drift/attitude_bound_rad"), other = shorter.number("/attitude_bound_rad"),
             other_drift = shorter.number("/drift/attitude_bound_rad");
  if (whole && whole_drift && other && other_drift && *whole_drift > 0 && *other_drift > 0) {
    const double times = std::max(*whole / *whole_drift, *other / *other_drift);
    put("/attitude_bound_rad", std::min(*whole, std::max(*other, times * largest("drift_attitude_bound_rad"))));
  }
  put("/drift/axis_bound_rad", largest("drift_axis_bound_rad"));
  put("/drift/attitude_bound_rad", largest("drift_attitude_bound_rad"));
  if (longer.comparand.number("/drift/tip_bound_m")) put("/drift/tip_bound_m", largest("drift_tip_bound_m"));
  // The largest drifts until then are the sizes by which tolerances are limited.
  put("/drift/axis_max_rad", largest("drift_axis_rad"));
  put("/drift/azimuth_max_rad", largest("drift_azimuth_rad"));
  if (longer.comparand.number("/drift/tip_max_m")) put("/drift/tip_max_m", largest("drift_tip_m"));
  longer.comparand.summary = std::move(summary);
}

}  // namespace

std::optional<LongerRun> find_common_end(const Comparand& reference, const Comparand& candidate,
                                         const CompareOptions& options) {
  const std::string duration = "/motion/duration_s";
  const auto before = reference.number("/outcome/reached_s"), now = candidate.number("/outcome/reached_s");
  const bool may_differ = is_below(duration, options.may_change) &&
                          reference.number("/scenario" + duration) != candidate.number("/scenario" + duration);
  if (!may_differ || !before || !now || std::abs(*before - *now) <= kSameEnd * std::max(*before, *now)) return std::nullopt;
  LongerRun longer;
  longer.end = {std::min(*before, *now), std::max(*before, *now), *before > *now};
  longer.comparand = longer.end.reference_goes_on ? reference : candidate;
  const auto rows = longer.comparand.open_rows();
  const Watch watch = options.watch.part(0, 0);
  const Survey known = survey(*rows, trajectory_table(), false, watch, longer.end.t_s);
  find_row(longer.comparand, known, watch, longer);
  tell_common_end(longer.end.reference_goes_on ? candidate : reference, known, longer);
  return longer;
}

std::string_view why_left_out(const SummaryMember& member, const std::string& path, const Comparand& reference,
                              const Comparand& candidate, const LongerRun& longer) {
  switch (member.scope) {
    case FigureScope::any: return "";
    case FigureScope::end: return member.of_row.empty() || !longer.row ? kNoRow : "";
    case FigureScope::span:
    case FigureScope::motion:
    case FigureScope::rows: return kOfWholeRun;
    case FigureScope::at_event: break;
  }
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  const std::string beside = pointer.substr(0, pointer.rfind('/') + 1);
  double first_s = longer.end.longer_t_s, error_s = 0;
  for (const Comparand* side : {&reference, &candidate}) {
    first_s = std::min(first_s, side->number(beside + std::string(member.event_time)).value_or(first_s));
    error_s = std::max(error_s, side->number(beside + std::string(member.event_bound)).value_or(0));
  }
  // A figure that joins two events is known only where both are in the shorter run.
  const bool is_known =
      member.kind != FigureKind::derived || (longer.end.reference_goes_on ? candidate : reference).number(pointer);
  return is_known && first_s + error_s < longer.end.t_s ? "" : kNoEvent;
}

}  // namespace earthtop::compare
