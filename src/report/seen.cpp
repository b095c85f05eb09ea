// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/seen.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "report/thinning.hpp"
#include "results/columns.hpp"
#include "run/seen_motion.hpp"

namespace earthtop::report {
namespace {

using compare::CellKind;
using compare::Row;

constexpr double kMostSeconds = 3;  // that looking at the motion may take, as estimated

Row row_of(const DriftRow& look, bool is_reliable) {
  Row row;
  row.t_s = look.t_s;
  const std::vector<Column>& columns = trajectory_columns();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::optional<double> number;
    if (has_part(look, columns[i].quantity->owner)) number = columns[i].value(look);
    row.kind[i] = !number ? CellKind::empty : std::isfinite(*number) ? CellKind::number : CellKind::not_finite;
    row.value[i] = row.kind[i] == CellKind::number ? *number : kNoNumber;
  }
  row.value[column("drift_reliable")] = is_reliable ? 1 : 0;
  return row;
}

/// Whether the file's drift at a time is the one that this version computes of the scenario.
bool agree(const Run& run, const DriftRow& look) {
  constexpr double kSame = 1e-3, kBounds = 2;  // of the drift, and of its bound
  const auto drift = run.number("/drift/reliable/axis_rad"), bound = run.number("/drift/reliable/axis_bound_rad");
  return drift && bound && std::abs(*drift - look.drift_axis_rad) <= kSame * std::abs(*drift) + kBounds * *bound;
}

/// Mean rows of windows, of which each look has a share that falls to zero at the window's ends: what is as fast as the looks goes.
std::vector<Row> means_of(std::span<const Row> rows, std::size_t a_window) {
  std::vector<Row> means;
  for (std::size_t begin = 0; begin + a_window <= rows.size(); begin += a_window) {
    Row mean = rows[begin + a_window / 2];
    mean.t_s = (rows[begin].t_s + rows[begin + a_window - 1].t_s) / 2;
    for (std::size_t i = 0; i < mean.value.size(); ++i) {
      double sum = 0, weights = 0;
      for (std::size_t k = 0; k < a_window; ++k) {
        const double place = (static_cast<double>(k) + 1) / (static_cast<double>(a_window) + 1) - 0.5;
        const double weight = 1 - 4 * place * place;
        sum += weight * rows[begin + k].value[i], weights += weight;
      }
      mean.value[i] = sum / weights;
    }
    means.push_back(mean);
  }
  return means;
}

/// Whether rows follow the axes' path, and do not jump about on it.
bool follow_the_path(std::span<const Row> rows) {
  constexpr double kLargestTurn = 0.6;  // of a step beside the one before; at twelve steps a turn it is 0.52
  constexpr double kRounding = 1e-14;   // a path with smaller steps is a point
  const std::size_t at = column("ref_axis_L_x");
  double steps = 0, turns = 0;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    for (std::size_t k = at; k < at + 3; ++k) {
      const double before = rows[i].value[k] - rows[i - 1].value[k], after = rows[i + 1].value[k] - rows[i].value[k];
      steps += before * before, turns += (after - before) * (after - before);
    }
  return turns <= kLargestTurn * kLargestTurn * steps + kRounding * kRounding * static_cast<double>(rows.size());
}

/// Looks at the motion of the run's scenario. @returns why that cannot be; empty if it was done
std::string look(Run& run) {
  const double reached = run.number("/outcome/reached_s").value_or(0);
  if (run.word("/outcome/status") == "interrupted") return "the run was interrupted";
  if (!run.scene) return "this version does not follow such a scene";
  if (!(reached > 0) || run.listed.rows.size() < 2) return "there is no row after the release";
  try {
    Scene scene = *run.scene;
    const bool chooses = scene.scenario().effects.automatic;
    const double seconds = seconds_to_look(scene) + (chooses ? selection_seconds(scene) : 0);
    if (!(seconds <= kMostSeconds)) return fmt::format("to look between them would take about {:.0f} s", seconds);
    if (chooses) select_effects(scene, run.watch);
    const double checked_s = run.number("/drift/reliable/at_s").value_or(reached);
    const SeenMotion seen = look_at_motion(scene, reached, checked_s, run.watch);
    if (run.watch.asks_to_stop()) throw Interrupted();
    if (seen.looks.size() < 2 || !(seen.looks.back().t_s >= checked_s)) return "the motion could not be computed again";
    if (!agree(run, seen.checked)) return "the scenario gives another motion in this version";
    take_looks(run, seen.looks, seen.a_window, [&] { return seen.last; });
    return "";
  } catch (const ScenarioError&) {
    return "this version does not follow such a scene";
  }
}

}  // namespace

std::vector<Row> rows_of(const Run& run, std::span<const DriftRow> looks) {
  std::vector<Row> rows;
  rows.reserve(looks.size());
  const Trust trust(run);
  for (const DriftRow& look : looks) rows.push_back(row_of(look, trust.at(look.t_s)));
  return rows;
}

void take_looks(Run& run, std::span<const DriftRow> looks, std::size_t a_window,
                const std::function<std::vector<DriftRow>()>& last) {
  run.drawn = {rows_of(run, looks), a_window, true};
  const std::size_t count = looks.size();
  if (a_window == 0) {
    run.drawn_words = fmt::format("Drawn: the motion at {} times, twelve or more in each of the axis's fastest swings.", count);
    run.played = run.drawn;
    run.played_words = run.drawn_words;
    return;
  }
  run.drawn_words = fmt::format(
      "Drawn: the motion in {} windows, each a little longer than one of the axis's fastest swings and seen at {} times.",
      count / a_window, a_window);
  run.played = {means_of(run.drawn.rows, a_window), 0, true};
  run.played_is_mean = true;
  run.played_words = fmt::format("The axis has too many swings to show each: drawn is its mean over one, at {} times.",
                                 run.played.rows.size());
  if (follow_the_path(run.played.rows)) return;
  run.played = {rows_of(run, last()), 0, true};
  run.played_is_mean = false;
  run.played_words = fmt::format("The axis has too many swings and turns to show them all: drawn are the last {:.4g} s.",
                                 run.played.rows.back().t_s - run.played.rows.front().t_s);
}

void see_motion(Run& run) {
  const std::string why_not = look(run);
  if (why_not.empty()) return;
  run.drawn = run.played = run.listed;
  const std::uint64_t rows = run.results.stated_rows.value_or(0), drawn = run.listed.rows.size();
  run.drawn_words = "Drawn: the output rows, since " + why_not;
  if (rows > drawn) run.drawn_words += fmt::format("; {} of {}, {}", drawn, rows, kThinningRule);
  run.drawn_words += ". What the motion does between them is not seen.";
  run.played_words = run.drawn_words;
}

}  // namespace earthtop::report
