// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "report/drift_chart.hpp"
#include "report/motion_data.hpp"
#include "report/seen.hpp"
#include "run/seen_motion.hpp"
#include "text/json.hpp"

namespace earthtop::play {
namespace {

using report::Json, report::Run;

constexpr std::size_t kMostRows = 2000;  // that are drawn where there are no looks

/// The rows of a run that was stopped before it looked stand in for looks.
void take_rows(Run& run, const RunResult& result) {
  std::vector<DriftRow> rows;
  const std::size_t stride = result.rows.size() / kMostRows + 1;
  for (std::size_t i = 0; i < result.rows.size(); i += stride) rows.push_back(result.rows[i]);
  run.drawn = run.played = {report::rows_of(run, rows)};
  run.drawn_words = run.played_words = "Drawn: the output rows. What the motion does between them is not seen.";
}

Run run_of(const RunResult& result, std::string_view summary) {
  Run run;
  run.results.summary = json_of(summary);
  run.scene = result.modelled;
  run.has_contact = result.contact.has_value();
  if (result.looks.size() < 2) {
    take_rows(run, result);
  } else {
    const auto last = [&] { return look_at_motion(result.modelled, result.reached_s, result.reached_s).last; };
    report::take_looks(run, result.looks, result.looks_a_window, last);
  }
  if (!run.drawn.rows.empty()) run.time = time_unit(run.drawn.rows.back().t_s);
  return run;
}

/// A picture without its style: the page has one, and allows no other.
std::string drawing(const Figure& figure, PlotWidth width) {
  constexpr std::string_view kEnd = "</style>";
  std::string picture = svg(figure, width);
  const std::size_t begin = picture.find("<style>"), end = picture.find(kEnd);
  if (begin != picture.npos && end != picture.npos) picture.erase(begin, end + kEnd.size() - begin);
  return picture;
}

}  // namespace

std::string pictures_json(const RunResult& result, std::string_view summary) {
  const Run run = run_of(result, summary);
  Json motion = Json::object();
  report::add_motion(run, motion);
  const DriftCurves curves = report::drift_curves(run, run.drawn);
  Figure figure = drift_figure(curves, curves);
  figure.id = "drift";
  Json chart = {{"wide", drawing(figure, PlotWidth::wide)}};
  figure.id = "drift-narrow";
  chart["narrow"] = drawing(figure, PlotWidth::narrow);
  chart["words"] = run.drawn_words;
  motion["words"] = run.played_words;
  return R"("chart":)" + written_replacing(chart) + R"(,"motion":)" + written_replacing(motion);
}

}  // namespace earthtop::play
