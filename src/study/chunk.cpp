// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/chunk.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <span>

#include "scene/parts.hpp"

namespace earthtop::study {
namespace {

std::vector<BatchOutcome> run_guarded(std::span<const Scene> scenes, const Watch& watch, bool between) {
  try {
    return run_batch(scenes, watch, between);
  } catch (const std::exception& error) {
    const bool lacks_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    if (lacks_memory && scenes.size() == 1) throw;
    if (scenes.size() == 1) {
      std::vector<BatchOutcome> outcome(1);
      outcome.front().refusal = plain_words(error);
      return outcome;
    }
  }
  // One of the scenarios caused the error: run each of them alone.
  std::vector<BatchOutcome> outcomes;
  outcomes.reserve(scenes.size());
  for (const Scene& scene : scenes) outcomes.push_back(std::move(run_guarded({&scene, 1}, watch, between).front()));
  return outcomes;
}

}  // namespace

std::vector<PointResult> compute(const Study& study, const Collector& collector, const Chunk& chunk, const Watch& watch) {
  std::vector<PointResult> results;
  results.reserve(chunk.size());
  std::vector<Scene> scenes;
  scenes.reserve(chunk.size());
  std::vector<std::size_t> of_scene;  // index in `results`
  of_scene.reserve(chunk.size());
  for (const PlannedPoint& point : chunk) {
    PointResult& result = results.emplace_back();
    result.number = point.number;
    result.values.resize(study.quantities.size());
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      result.axis_values.push_back(axis_value(study.axes[a], point.settings[a]));
    if (watch.asks_to_stop()) {
      result.status = to_string(RunStatus::interrupted);
    } else if (auto scene = collector.scene(point_changes(study, point), result.reason)) {
      of_scene.push_back(results.size() - 1);
      scenes.push_back(*std::move(scene));
    } else {
      result.status = "refused";
    }
  }
  const bool between = collector.looks_between();
  Parts parts(watch, static_cast<double>(scenes.size()));
  for (std::size_t begin = 0; begin < scenes.size();) {
    std::size_t end = begin + 1;
    for (double times = times_held(scenes[begin], between); end < scenes.size(); ++end)
      if (times += times_held(scenes[end], between); times > kMostTimesHeld) break;
    const auto outcomes =
        run_guarded(std::span(scenes).subspan(begin, end - begin), parts.next(static_cast<double>(end - begin)), between);
    for (std::size_t i = begin; i < end; ++i) collector.collect(outcomes[i - begin], results[of_scene[i]]);
    begin = end;
  }
  std::erase_if(results, [](const PointResult& point) { return point.status == to_string(RunStatus::interrupted); });
  return results;
}

}  // namespace earthtop::study
