// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/largest_drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "run/largest.hpp"
#include "run/rows.hpp"

namespace earthtop {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
/// A value whose estimated error is a larger share of it is computed anew at its time.
constexpr double kExact = 1e-10;

/// The azimuth drift beside the line of its trend (rad).
double beside_line(const DriftRow& row, const SecularDrift& trend) {
  return row.drift_azimuth_rad ? *row.drift_azimuth_rad - *trend.azimuth_rate_rad_s * row.t_s : kNoNumber;
}

/// A quantity of which the largest value is sought, from the release to a time.
struct Sought {
  std::function<double(const DriftRow&)> value;
  double until_s;
  std::optional<Largest> largest = {};
};

class Search {
 public:
  Search(const LookSource& source, const RunResult& result, std::vector<Sought>& sought)
      : source_(source), sought_(sought), a_window_(result.looks_a_window) {
    for (Sought& one : sought) one.largest = largest_in(result.looks, a_window_, one);
    if (a_window_ > 0) narrow(result.looks);
    std::vector<double> times_s;
    for (const Sought& one : sought)
      if (one.largest && one.largest->t_s > 0 &&
          (source.all_exact || one.largest->error > kExact * std::abs(one.largest->value)))
        times_s.push_back(one.largest->t_s);
    if (times_s.empty()) return;
    std::ranges::sort(times_s);
    times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
    exact_ = source.exact(std::move(times_s));
    for (Sought& one : sought) {
      const ExtendedDriftRow* const row = one.largest ? exact(one.largest->t_s) : nullptr;
      if (row == nullptr) continue;
      const double value = one.value(row_cast<double>(*row));
      if (!std::isnan(value)) one.largest->value = value, one.largest->error = 0;
    }
  }
  /// The motion at the time of a largest value, where it was computed anew; null elsewhere.
  const ExtendedDriftRow* exact(double t_s) const {
    const auto row = std::ranges::find(exact_, t_s, [](const ExtendedDriftRow& r) { return static_cast<double>(r.t_s); });
    return row == exact_.end() ? nullptr : &*row;
  }

 private:
  static std::optional<Largest> largest_in(std::span<const DriftRow> rows, std::size_t a_window, const Sought& sought) {
    std::optional<Largest> largest;
    std::vector<double> times_s, values;
    const std::size_t count = a_window == 0 ? rows.size() : a_window;
    for (std::size_t begin = 0; begin < rows.size(); begin += count) {
      times_s.clear(), values.clear();
      for (std::size_t i = begin; i < std::min(rows.size(), begin + count) && rows[i].t_s <= sought.until_s; ++i)
        times_s.push_back(rows[i].t_s), values.push_back(sought.value(rows[i]));
      auto top = largest_of(times_s, values);
      if (!top || (largest && top->value <= largest->value)) continue;
      top->nearest += begin;
      largest = top;
    }
    return largest;
  }

  /// Looks at ever smaller windows around the largest values found.
  void narrow(std::span<const DriftRow> looks) {
    constexpr int kWindows = 15, kMostRounds = 24;  // windows on either side, each time
    const double end = looks.back().t_s, window = source_.step_s * static_cast<double>(a_window_ - 1);
    double apart = a_window_ < looks.size() ? looks[a_window_].t_s - looks[0].t_s : 0;
    for (int round = 0; round < kMostRounds && apart > 0; ++round) {
      const bool touches = apart <= window;
      const double spacing = touches ? 0 : std::max(apart / kWindows, window * 0.9);
      for (Sought& one : sought_) {
        if (!one.largest) continue;
        std::vector<double> times_s{0};
        std::size_t each = a_window_;
        if (touches) {
          // The windows touch: all of the motion around the value is looked at.
          each = static_cast<std::size_t>(std::ceil((2 * apart + 2 * window) / source_.step_s)) + 1;
          add_window(one.largest->t_s - apart - window, each, end, times_s);
        } else {
          for (int k = -kWindows; k <= kWindows; ++k)
            add_window(one.largest->t_s + k * spacing - window / 2, each, end, times_s);
        }
        std::vector<DriftRow> rows = source_.look(times_s);
        if (rows.size() < times_s.size()) continue;
        rows.erase(rows.begin());
        auto top = largest_in(rows, each, one);
        if (!top || top->value < one.largest->value) continue;
        top->nearest = one.largest->nearest;  // of the result's looks
        one.largest = top;
      }
      if (touches) return;
      apart = spacing;
    }
  }
  /// Adds the looks of a window, moved into the run and beyond the times that are there.
  void add_window(double begin, std::size_t count, double end, std::vector<double>& times_s) const {
    const double length = source_.step_s * static_cast<double>(count - 1);
    begin = std::clamp(begin, source_.step_s, std::max(source_.step_s, end - length));
    if (!(begin > times_s.back())) return;
    for (std::size_t k = 0; k < count; ++k) times_s.push_back(std::min(end, begin + source_.step_s * static_cast<double>(k)));
  }

  std::vector<ExtendedDriftRow> exact_;
  const LookSource& source_;
  std::vector<Sought>& sought_;
  std::size_t a_window_;
};

/// The size of a quantity that has a sign, where it is largest. A smooth function is wanted: no size has a corner at zero.
template <class Value>
std::function<double(const DriftRow&)> size_of(const Value& value, std::span<const DriftRow> looks) {
  double least = 0, most = 0;
  for (const DriftRow& look : looks) least = std::fmin(least, value(look)), most = std::fmax(most, value(look));
  const double sign = -least > most ? -1 : 1;
  return [value, sign](const DriftRow& row) { return sign * value(row); };
}

}  // namespace

void assess_largest(const LookSource& source, std::span<const JudgedLook> judged, RunResult& result) {
  if (result.looks.size() < 2) return;
  DriftSummary& drift = result.drift;
  enum : std::size_t { axis, tilt, azimuth, tip };
  std::vector<Sought> sought{
      {[](const DriftRow& row) { return row.drift_axis_rad; }, result.reached_s},
      {size_of([](const DriftRow& row) { return row.drift_tilt_rad; }, result.looks), result.reached_s},
      {size_of([](const DriftRow& row) { return row.drift_azimuth_rad.value_or(kNoNumber); }, result.looks), result.reached_s}};
  const bool has_tip = drift.tip_max_m.has_value();
  if (has_tip) sought.push_back({[](const DriftRow& row) { return row.contact->drift_tip_m; }, result.reached_s});
  SecularDrift* const trend = drift.secular && drift.secular->azimuth_rate_rad_s ? &*drift.secular : nullptr;
  const std::size_t swings = sought.size();
  if (trend != nullptr) {
    const double until_s = trend->window_s[1];
    sought.push_back({[&](const DriftRow& row) { return -beside_line(row, *trend); }, until_s});
    sought.push_back({[&](const DriftRow& row) { return beside_line(row, *trend); }, until_s});
  }
  const Search search(source, result, sought);

  // A row that shows more than the search has found, as rounding may, counts.
  const auto axis_bound = [&](const Largest& largest) { return judged_at(judged, largest.t_s).axis_bound_rad + largest.error; };
  if (const auto& found = sought[axis].largest; found && found->value >= drift.axis_max_rad) {
    drift.axis_max_rad = found->value, drift.axis_max_at_s = found->t_s, drift.axis_max_bound_rad = axis_bound(*found);
    if (const ExtendedDriftRow* row = search.exact(found->t_s); row != nullptr && !result.extended_rows.empty())
      result.extended_axis_max_rad = row->drift_axis_rad;
  }
  if (const auto& found = sought[tilt].largest; found && found->value >= drift.tilt_max_rad)
    drift.tilt_max_rad = found->value, drift.tilt_max_at_s = found->t_s, drift.tilt_max_bound_rad = axis_bound(*found);
  if (const auto& found = sought[azimuth].largest; found && !(found->value < drift.azimuth_max_rad)) {
    drift.azimuth_max_rad = found->value, drift.azimuth_max_at_s = found->t_s;
    drift.azimuth_max_bound_rad = axis_bound(*found) / horizontal(result.looks[found->nearest]);
  }
  if (has_tip)
    if (const auto& found = sought[tip].largest; found && found->value >= *drift.tip_max_m) {
      drift.tip_max_m = found->value, drift.tip_max_at_s = found->t_s;
      drift.tip_max_bound_m = judged_at(judged, found->t_s).tip_bound_m + found->error;
    }
  if (trend == nullptr) return;
  const auto &least = sought[swings].largest, &most = sought[swings + 1].largest;
  if (!least || !most) return;
  double nearest = HUGE_VAL;
  for (const DriftRow& row : result.looks)
    if (row.t_s <= trend->window_s[1]) nearest = std::min(nearest, horizontal(row));
  const double bound = judged_at(judged, std::max(least->t_s, most->t_s)).axis_bound_rad;
  trend->azimuth_oscillation_rad = (most->value + least->value) / 2;
  trend->azimuth_oscillation_bound_rad = bound / nearest + (most->error + least->error) / 2;
  trend->azimuth_oscillation_at_s = {least->t_s, most->t_s};
}

}  // namespace earthtop
