// SPDX-License-Identifier: GPL-3.0-or-later
// Questions about a study that are answered before it is computed: its identity, its size and cost, and whether its points
// can be run.
#include <fmt/core.h>

#include <algorithm>

#include "earthtop/results/provenance.hpp"
#include "earthtop/study/study.hpp"
#include "earthtop/study/timing.hpp"
#include "scene/parts.hpp"
#include "study/collect.hpp"
#include "study/design.hpp"
#include "study/json_text.hpp"
#include "study/sampled_numbers.hpp"
#include "text/number_words.hpp"
#include "text/sha256.hpp"

namespace earthtop {
namespace study {
namespace {

/// Keeps those of the common errors that this report has too: errors at the same key.
void keep_common(std::vector<Diagnostic>& common, const ScenarioReport& report) {
  std::erase_if(common, [&](const Diagnostic& a) {
    return std::none_of(report.errors.begin(), report.errors.end(), [&](const Diagnostic& b) {
      return a.pointer == b.pointer && (!a.pointer.empty() || a.message == b.message);
    });
  });
}

std::string range_text(const StudyAxis::Range& range) {
  std::string text = range.logarithmic ? "log" : "linear";
  for (std::size_t i = 0; i < range.from.size(); ++i)
    text += fmt::format(" {} {}", json_text(range.from[i]), json_text(range.to[i]));
  return text + fmt::format(" {}", range.points);
}

}  // namespace
}  // namespace study

StudyEstimate estimate(const Study& study) {
  using namespace earthtop::study;
  const auto count = point_count(study);
  StudyEstimate estimate{.points = count.value_or(~std::uint64_t{0})};
  if (!count || *count > study.limits.points) return estimate;
  const Collector collector(study);
  Design design(study);
  double seconds = 0, points = 0, times = 0, most_times = 0;
  for (const std::uint64_t number : spread(reach(study, *count), 25)) {
    std::string refusal;
    points += 1;
    if (const auto scene = collector.scene(point_changes(study, design.point(number)), refusal)) {
      seconds += seconds_by_rule(*scene, collector.looks_between());
      const double held = times_held(*scene, collector.looks_between());
      times += held, most_times = std::max(most_times, held);
    }
  }
  constexpr double kSecondsAPoint = 2e-4;  // reading, verdict, storing
  estimate.core_seconds = static_cast<double>(*count) * (kSecondsAPoint + (points > 0 ? seconds / points : 0));
  // A row of the store: number, status, hash, and some 12 bytes a value; the exported line is about as long.
  const double columns = static_cast<double>(study.axes.size() + study.quantities.size());
  estimate.disk_bytes = static_cast<double>(*count) * 2 * (90 + 12 * columns);
  // The document names every value of each point of a small study, in lines of their own; measured for 20, 400 and 10,000 points.
  constexpr double kMostPointsListed = 1000, kOtherFiles = 3e4, kAPoint = 360, kAValue = 80;
  estimate.disk_bytes += kOtherFiles;
  if (static_cast<double>(*count) <= kMostPointsListed)
    estimate.disk_bytes += static_cast<double>(*count) * (kAPoint + kAValue * columns);
  // As measured. Points are computed eight side by side, unless each takes long.
  constexpr double kProgram = 1.7e7, kAStoredPoint = 7e3, kATime = 650, kTogether = 8, kLong_s = 0.25;
  const double together = seconds > kLong_s * points ? 1 : std::min(kTogether, static_cast<double>(*count));
  if (points > 0) times = std::max(most_times, std::min(kMostTimesHeld, together * times / points));
  estimate.memory_bytes = kProgram + kAStoredPoint * static_cast<double>(*count);
  estimate.memory_bytes_a_job = kATime * times;
  return estimate;
}

StudySample sample_points(const Study& study) {
  using namespace earthtop::study;
  constexpr std::uint64_t kPoints = 20, kQuickSobol = 100'000'000;
  const std::uint64_t count = point_count(study).value_or(0);
  const Collector collector(study);
  Design design(study);
  StudySample sample;
  std::vector<Diagnostic> common;
  for (const std::uint64_t number : scattered(reach(study, count, kQuickSobol), kPoints)) {
    const ScenarioReport report = collector.examine(point_changes(study, design.point(number)));
    ++sample.looked_at;
    if (report.scenario) continue;
    if (++sample.refused == 1) {
      sample.first_refusal = first_message(report);
      common = report.errors;
    }
    keep_common(common, report);
  }
  if (sample.refused < sample.looked_at || common.empty()) return sample;
  for (Diagnostic& finding : common)
    if (study.base_inside) finding.line = finding.column = 0;  // they count from the base's beginning, not from the file's
  common.back().message += sample.looked_at == count
                               ? fmt::format("; the same holds at all {} points of the study", count)
                               : fmt::format("; the same holds at all {} points examined, of {}", sample.looked_at, count);
  common.back().message += "; correct the study or its base, or compute it anyway with --keep-going";
  sample.common.emplace(std::move(common), study.base.file);
  return sample;
}

void require_affordable(const Study& study) {
  const auto count = point_count(study);
  const auto refuse = [](const char* pointer, std::string message) { throw ScenarioError(pointer, std::move(message)); };
  const auto limit = study.limits;
  const std::string points = count ? fmt::format("{}", *count) : "more than 9e15";
  if (!count || *count > limit.points) {
    // A rough figure only: nothing of the study has been examined yet.
    const double n = count ? static_cast<double>(*count) : 9e15;
    refuse("/axes",
           fmt::format("the study has {} points, at 10 ms each {:.1g} hours on one core and at 300 bytes each {:.1g} GB; "
                       "at most {} are allowed; take fewer, or raise /limits/points",
                       points, n * 0.01 / 3600, n * 300 / 1e9, limit.points));
  }
  if (*count == 0) refuse("/axes", "the study has no points");
  StudyEstimate e = estimate(study);
  // A rule may be far above what a study takes: it does not refuse without a look at some points.
  if (e.core_seconds > 3600 * limit.core_hours)
    e.core_seconds = std::min(e.core_seconds, time_study(study, 1, {}, 1).core_seconds);
  if (e.core_seconds > 3600 * limit.core_hours)
    refuse("/axes",
           fmt::format(
               "the study's {} points take about {} hours on one core and {:.2g} GB; at most {} hours are allowed; take "
               "fewer points or a shorter motion, or raise /limits/core_hours",
               points, told_apart(e.core_seconds / 3600, limit.core_hours, 2).first, e.disk_bytes / 1e9, limit.core_hours));
  if (e.disk_bytes > 1e9 * limit.disk_gb)
    refuse("/axes",
           fmt::format("the study's {} points take about {} GB and {:.2g} hours on one core; at most {} GB are allowed; "
                       "take fewer points or quantities, or raise /limits/disk_gb",
                       points, told_apart(e.disk_bytes / 1e9, limit.disk_gb, 2).first, e.core_seconds / 3600, limit.disk_gb));
}

std::string study_sha256(const Study& study) {
  using namespace earthtop::study;
  std::string text = fmt::format("{} {} {} {} {}\n", to_string(study.design.kind), study.design.points, study.design.seed,
                                 study.design.indices, study.needed_rows_only);
  for (const StudyAxis& axis : study.axes) {
    text += fmt::format("axis {} ", axis.name);
    for (const std::string& pointer : axis.pointers) text += pointer + " ";
    if (axis.range) text += range_text(*axis.range);
    for (const auto& level : axis.levels)
      for (const std::string& value : level) text += value + " ";
    text += "\n";
  }
  for (const StudyQuantity& quantity : study.quantities) text += fmt::format("quantity {} {}\n", quantity.name, quantity.path);
  // The scenarios as the points see them: an added comment or a default written out does not make another study.
  const Collector collector(study);
  Design design(study);
  bool seen = false;
  for (const std::uint64_t number : spread(reach(study, point_count(study).value_or(0)), 7)) {
    std::string refusal;
    const auto scene = collector.scene(point_changes(study, design.point(number)), refusal);
    text += fmt::format("point {} {}\n", number, scene ? scene->sha256() : refusal);
    seen = seen || scene;
  }
  if (!seen) text += study.base.text;
  return sha256_hex(text);
}

}  // namespace earthtop
