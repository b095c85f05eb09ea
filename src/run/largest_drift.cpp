// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/largest_drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
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

/// How a quantity depends on the motion: a length or an angle between two directions has a corner where it vanishes, and its square none.
enum class Kind { smooth, length, angle };

/// A quantity of which the largest value is sought, from the release to a time.
struct Sought {
  std::function<double(const DriftRow&)> value;
  double until_s;
  Kind kind;
  double scale = 0;  ///< size of the quantity: the largest value at the looks
  std::optional<Largest> largest = {};

  /// A smooth function that grows with the quantity. Of an angle, which ends at half a turn, it is the square of the sine of its half.
  double smooth(const DriftRow& row) const {
    const double x = value(row);
    if (kind == Kind::smooth || scale == 0) return x;
    const double part = kind == Kind::length ? x / scale : real::sin(x / 2) / real::sin(scale / 2);
    return part * part;
  }
  /// The size that the largest value has at least, whatever the error of the polynomial.
  double least_known() const { return largest->value - largest->error; }
  /// Takes the largest value of the smooth function back to the quantity.
  Largest back(Largest found) const {
    if (kind == Kind::smooth || scale == 0) return found;
    const double root = std::sqrt(found.value);
    found.error *= scale / (2 * root);
    if (kind == Kind::length) {
      found.value = scale * root;
    } else {
      const double sine = std::min(1.0, root * real::sin(scale / 2));
      found.value = 2 * real::atan2(sine, std::sqrt((1 - sine) * (1 + sine)));
    }
    return found;
  }
};

class Search {
 public:
  Search(const LookSource& source, const RunResult& result, std::vector<Sought>& sought)
      : source_(source), sought_(sought), a_window_(result.looks_a_window) {
    for (Sought& one : sought) {
      if (one.kind != Kind::smooth)
        for (const DriftRow& look : result.looks) one.scale = std::fmax(one.scale, one.value(look));
      one.largest = largest_in(result.looks, a_window_, one);
    }
    if (a_window_ > 0) narrow(result.looks);
    sharpen(result.looks.back().t_s);
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
      // A polynomial that did not resolve the motion may have led astray: the nearest look is then larger.
      if (value >= one.value(result.looks[one.largest->nearest]))
        one.largest->value = value, one.largest->error = 0, one.largest->amplified = 1;
      else if (a_window_ == 0)
        one.largest = Largest{result.looks[one.largest->nearest].t_s, one.value(result.looks[one.largest->nearest]),
                              one.largest->error, one.largest->nearest};
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
        times_s.push_back(rows[i].t_s), values.push_back(sought.smooth(rows[i]));
      const auto top = largest_of(times_s, values);
      if (!top) continue;
      const Largest found = sought.back(*top);
      if (largest && found.value <= largest->value) continue;
      largest = found;
      largest->nearest += begin;
    }
    return largest;
  }

  /// The largest value within a window, and what the motion next to the window may reach.
  struct Window {
    Largest top;
    double reach;
  };

  /// The windows next to which the largest value may lie, at most some of them: those that reach above every value found.
  /// @param tops  of windows in the order of time, in groups of neighbours
  static std::vector<Largest> candidates(std::span<const std::vector<Largest>> groups, double most) {
    constexpr std::size_t kMost = 12;
    std::vector<Window> windows;
    for (const std::vector<Largest>& tops : groups)
      for (std::size_t i = 0; i < tops.size(); ++i) {
        const double before = i > 0 ? tops[i].value - tops[i - 1].value : 0;
        const double after = i + 1 < tops.size() ? tops[i].value - tops[i + 1].value : 0;
        const double reach = tops[i].value + std::max(std::abs(before), std::abs(after)) / 2;
        if (before >= 0 && after >= 0 && reach >= most) windows.push_back({tops[i], reach});
      }
    std::ranges::sort(windows, std::greater{}, &Window::reach);
    if (windows.size() > kMost) windows.resize(kMost);
    std::vector<Largest> best;
    for (const Window& window : windows) best.push_back(window.top);
    return best;
  }

  /// The largest values of windows of some looks each.
  static std::vector<Largest> tops_of(std::span<const DriftRow> rows, std::size_t a_window, const Sought& sought) {
    std::vector<Largest> tops;
    for (std::size_t begin = 0; begin < rows.size(); begin += a_window)
      if (const auto top = largest_in(rows.subspan(begin, std::min(a_window, rows.size() - begin)), 0, sought))
        tops.push_back(*top);
    return tops;
  }

  /// Looks more closely where the looks do not resolve the motion, as next to the vertical.
  void sharpen(double end) {
    constexpr int kMostRounds = 3, kEachSide = 16;
    constexpr double kUnresolved = 1e-7;
    double apart = source_.step_s;
    for (int round = 0; round < kMostRounds; ++round) {
      const double step = 1.2 * apart / kEachSide;
      std::vector<std::pair<Sought*, std::vector<double>>> regions;
      Looks wanted;
      const double zero[] = {0};
      wanted.add(zero, LookFor::picture);
      for (Sought& one : sought_) {
        if (!one.largest || !(one.largest->error > kUnresolved * std::abs(one.largest->value))) continue;
        std::vector<double>& times_s = regions.emplace_back(&one, std::vector<double>()).second;
        const double first = std::max(one.largest->t_s - kEachSide * step, 0.0);
        for (int k = 0; k <= 2 * kEachSide; ++k) times_s.push_back(std::min(end, first + k * step));
        times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
        wanted.add(times_s, LookFor::picture);
      }
      if (regions.empty()) return;
      const std::vector<DriftRow> rows = source_.look(wanted.times_s);
      if (rows.size() < wanted.size()) return;
      for (auto& [one, times_s] : regions)
        if (auto top = largest_in(rows_at(rows, times_s), 0, *one); top && top->value >= one->least_known()) {
          top->nearest = one->largest->nearest;  // of the result's looks
          one->largest = top;
        }
      apart = step;
    }
  }
  static std::vector<DriftRow> rows_at(std::span<const DriftRow> rows, std::span<const double> times_s) {
    std::vector<DriftRow> seen;
    for (const double t_s : times_s) seen.push_back(*std::ranges::lower_bound(rows, t_s, {}, &DriftRow::t_s));
    return seen;
  }

  /// The search of one quantity in windows.
  struct Narrowing {
    Sought* sought;
    std::vector<std::vector<Largest>> groups;       ///< tops of the last windows
    std::vector<std::vector<double>> regions = {};  ///< times of the next looks, a region around each candidate
    std::size_t a_window = 0;                       ///< looks in each of the next windows
  };

  /// Looks at ever smaller windows around the largest values found, until they touch.
  void narrow(std::span<const DriftRow> looks) {
    constexpr int kMostRounds = 24;
    if (looks.size() <= a_window_) return;
    const double end = looks.back().t_s, window = source_.step_s * static_cast<double>(a_window_ - 1);
    double apart = looks[a_window_].t_s - looks[0].t_s;
    std::vector<Narrowing> searches;
    for (Sought& one : sought_)
      if (one.largest) searches.push_back({&one, {tops_of(looks, a_window_, one)}});
    for (int round = 0; round < kMostRounds; ++round) {
      const bool touches = apart <= window;
      double widest = 0;
      Looks wanted;
      const double zero[] = {0};
      wanted.add(zero, LookFor::picture);
      for (Narrowing& search : searches) {
        widest = std::max(widest, plan_regions(search, apart, window, end));
        for (const std::vector<double>& region : search.regions) wanted.add(region, LookFor::picture);
      }
      const std::vector<DriftRow> rows = source_.look(wanted.times_s);
      if (rows.size() < wanted.size()) return;
      for (Narrowing& search : searches) take_regions(search, rows);
      if (touches) return;
      apart = widest;
    }
  }

  /// Plans the looks around the candidates of a quantity. @returns the distance of the windows
  double plan_regions(Narrowing& search, double apart, double window, double end) const {
    constexpr double kWindows = 60;  // each time
    std::vector<Largest> best = candidates(search.groups, search.sought->largest->value);
    if (best.empty()) best.push_back(*search.sought->largest);
    const bool touches = apart <= window;
    const double each_side = std::max(1.0, std::floor((kWindows / static_cast<double>(best.size()) - 1) / 2));
    const double spacing = std::max(apart / each_side, 0.9 * window);
    search.a_window = touches ? static_cast<std::size_t>(std::ceil(2 * (apart + window) / source_.step_s)) + 1 : a_window_;
    search.regions.clear();
    for (const Largest& top : best) {
      std::vector<double>& times_s = search.regions.emplace_back();
      if (touches)  // all of the motion around the value is looked at
        add_window(top.t_s - apart - window, search.a_window, end, times_s);
      else
        for (double at = top.t_s - apart; at <= top.t_s + apart; at += spacing)
          add_window(at - window / 2, search.a_window, end, times_s);
    }
    return spacing;
  }

  /// Finds the tops of the windows that were looked at.
  static void take_regions(Narrowing& search, std::span<const DriftRow> rows) {
    Sought& one = *search.sought;
    search.groups.clear();
    for (const std::vector<double>& region : search.regions) {
      search.groups.push_back(tops_of(rows_at(rows, region), search.a_window, one));
      for (Largest& top : search.groups.back()) {
        top.nearest = one.largest->nearest;  // of the result's looks
        if (top.value >= one.largest->value) one.largest = top;
      }
    }
  }
  /// Adds the looks of a window, moved into the run and beyond the times that are there.
  void add_window(double begin, std::size_t count, double end, std::vector<double>& times_s) const {
    const double length = source_.step_s * static_cast<double>(count - 1);
    begin = std::clamp(begin, source_.step_s, std::max(source_.step_s, end - length));
    if (!times_s.empty() && !(begin > times_s.back())) return;
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
      {[](const DriftRow& row) { return row.drift_axis_rad; }, result.reached_s, Kind::angle},
      {size_of([](const DriftRow& row) { return row.drift_tilt_rad; }, result.looks), result.reached_s, Kind::smooth},
      {size_of([](const DriftRow& row) { return row.drift_azimuth_rad.value_or(kNoNumber); }, result.looks), result.reached_s,
       Kind::smooth}};
  const bool has_tip = drift.tip_max_m.has_value();
  if (has_tip) sought.push_back({[](const DriftRow& row) { return row.contact->drift_tip_m; }, result.reached_s, Kind::length});
  const std::size_t rotor = sought.size();
  const bool has_rotor = drift.rotor_axis_max_rad.has_value();
  if (has_rotor)
    sought.push_back({[](const DriftRow& row) { return row.rotor->drift_axis_rad; }, result.reached_s, Kind::angle});
  const std::size_t angles = sought.size();
  const auto add_angle = [&](double BasicGimbalRow<double>::*angle) {
    const auto value = [angle](const DriftRow& row) { return (*row.gimbals).*angle; };
    sought.push_back({size_of(value, result.looks), result.reached_s, Kind::smooth});
  };
  if (drift.outer_angle) {
    add_angle(&BasicGimbalRow<double>::drift_outer_angle_rad);
    add_angle(&BasicGimbalRow<double>::drift_inner_angle_rad);
  }
  SecularDrift* const trend = drift.secular && drift.secular->azimuth_rate_rad_s ? &*drift.secular : nullptr;
  const std::size_t swings = sought.size();
  if (trend != nullptr) {
    const double until_s = std::min(result.reached_s, result.verdict.reliable_until_s);
    sought.push_back({[&](const DriftRow& row) { return -beside_line(row, *trend); }, until_s, Kind::smooth});
    sought.push_back({[&](const DriftRow& row) { return beside_line(row, *trend); }, until_s, Kind::smooth});
  }
  const Search search(source, result, sought);

  // A row that shows more than the search has found, as rounding may, counts.
  const auto bound_with = [](double of_looks, const Largest& largest) { return largest.amplified * of_looks + largest.error; };
  const auto axis_bound = [&](const Largest& largest) {
    return bound_with(judged_at(judged, largest.t_s).axis_bound_rad, largest);
  };
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
      drift.tip_max_bound_m = bound_with(judged_at(judged, found->t_s).tip_bound_m, *found);
    }
  if (has_rotor)
    if (const auto& found = sought[rotor].largest; found && found->value >= *drift.rotor_axis_max_rad) {
      const JudgedLook& at = judged_at(judged, found->t_s);
      drift.rotor_axis_max_rad = found->value, drift.rotor_axis_max_at_s = found->t_s;
      drift.rotor_axis_max_bound_rad = bound_with(at.watched_axis_bound_rad(), *found);
    }
  const auto take_angle = [&](const std::optional<Largest>& found, double JudgedLook::OfGimbals::*bound,
                              DriftSummary::OfAngle& angle) {
    if (!found || found->value < angle.max_rad) return;
    angle.max_rad = found->value, angle.max_at_s = found->t_s;
    angle.max_bound_rad = bound_with((*judged_at(judged, found->t_s).gimbals).*bound, *found);
  };
  if (drift.outer_angle) {
    take_angle(sought[angles].largest, &JudgedLook::OfGimbals::outer_bound_rad, *drift.outer_angle);
    take_angle(sought[angles + 1].largest, &JudgedLook::OfGimbals::inner_bound_rad, *drift.inner_angle);
  }
  if (trend == nullptr) return;
  const auto &least = sought[swings].largest, &most = sought[swings + 1].largest;
  if (!least || !most) return;
  double nearest = HUGE_VAL;
  for (const DriftRow& row : result.looks)
    if (row.t_s <= sought.back().until_s) nearest = std::min(nearest, horizontal(row));
  const double bound = judged_at(judged, std::max(least->t_s, most->t_s)).axis_bound_rad;
  trend->azimuth_oscillation_rad = (most->value + least->value) / 2;
  trend->azimuth_oscillation_bound_rad = bound / nearest + (most->error + least->error) / 2;
  trend->azimuth_oscillation_at_s = {least->t_s, most->t_s};
}

}  // namespace earthtop
