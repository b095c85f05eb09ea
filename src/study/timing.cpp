// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/study/timing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <thread>

#include "bench/deadline.hpp"
#include "earthtop/scene/scene.hpp"
#include "study/chunk.hpp"
#include "study/sampled_numbers.hpp"

namespace earthtop {
namespace study {
namespace {

constexpr double kBudget_s = 0.5, kBudgetOfSlow_s = 1.5;  // the second for points that are computed one by one
constexpr std::size_t kSideBySide = 8;

/// Points computed together: their number and time, and the time that a rule gives them.
struct TimedChunk {
  std::size_t size = 0;
  double done = 0, seconds = 0, by_rule = 0;
  bool is_whole = true;
};

/// A number 0 < u < 1 from a place in a row of numbers that lie apart: 1/2, 1/4, 3/4, 1/8, ... (van der Corput).
double apart(std::uint64_t place) {
  double u = 0, half = 0.5;
  for (++place; place > 0; place /= 2, half /= 2) u += half * static_cast<double>(place % 2);
  return u;
}

class Timer {
 public:
  explicit Timer(const Study& study) : study_(study), collector_(study), count_(reach(study, point_count(study).value_or(0))) {}

  TimedChunk time(std::size_t size, double patience_s) {
    TimedChunk timed;
    Chunk chunk;
    Design design(study_);
    std::vector<std::uint64_t> numbers;
    if (size == 1)
      numbers = {std::min(count_ - 1, static_cast<std::uint64_t>(apart(chunks_) * static_cast<double>(count_)))};
    else
      numbers = scattered(count_, size, chunks_);
    ++chunks_;
    for (const std::uint64_t number : numbers) chunk.push_back(design.point(number));
    timed.size = chunk.size();
    if (timed.size == 1) {
      std::string refusal;
      if (const auto scene = collector_.scene(point_changes(study_, chunk.front()), refusal))
        timed.by_rule = seconds_by_rule(*scene, collector_.looks_between());
    }
    Progress progress;
    const Deadline deadline(patience_s);
    const double start = thread_seconds();
    compute(study_, collector_, chunk, Watch(deadline.passed(), &progress));
    timed.seconds = thread_seconds() - start;
    timed.is_whole = !deadline.passed()->load();
    timed.done = static_cast<double>(timed.size) * (timed.is_whole ? 1 : progress.share());
    if (!timed.is_whole && timed.size == 1 && timed.by_rule > 0 && timed.done > 0) {
      // Progress is told of parts that are not of one length. Rule and share err to either side: between the two.
      const double whole_s = std::max(timed.seconds, std::sqrt(timed.seconds / timed.done * timed.by_rule));
      timed.done = timed.seconds / whole_s;
    }
    return timed;
  }

 private:
  const Study& study_;
  Collector collector_;
  std::uint64_t count_;
  std::uint64_t chunks_ = 0;
};

/// Times chunks as a study computes them, until the budget is used.
/// @param seconds_a_point  what a study begins with
std::vector<TimedChunk> timed_chunks(const Study& study, unsigned jobs, std::uint64_t points, double seconds_a_point,
                                     double patience_s) {
  std::vector<TimedChunk> chunks;
  Timer timer(study);
  double spent = 0, seen = 0;
  while (true) {
    std::size_t size = std::min<std::uint64_t>(ChunkSize(seconds_a_point, jobs).points(points), points);
    const double left = (size < kSideBySide ? kBudgetOfSlow_s : kBudget_s) - spent;
    if (left <= 0) break;
    if (size >= kSideBySide) {
      const auto affordable = static_cast<std::size_t>(std::min(left / std::max(seconds_a_point, 1e-9), 1e6));
      const std::size_t most = chunks.empty() ? kSideBySide : std::max(kSideBySide, affordable / kSideBySide * kSideBySide);
      size = std::min(size, most);
    }
    chunks.push_back(timer.time(size, patience_s));
    const TimedChunk& last = chunks.back();
    spent += last.seconds;
    seen += last.done;
    if (!last.is_whole || size == points || seen >= 2 * static_cast<double>(points)) break;
    seconds_a_point = last.seconds / last.done;
  }
  return chunks;
}

}  // namespace
}  // namespace study

StudyTiming time_study(const Study& study, unsigned jobs, const StudyShard& shard, double patience_s) {
  using namespace earthtop::study;
  const StudyEstimate expected = estimate(study);
  const auto count = static_cast<double>(expected.points);
  StudyTiming timing;
  timing.core_seconds = expected.core_seconds;
  timing.shard_points = expected.points < shard.k ? 0 : (expected.points - shard.k) / shard.n + 1;
  double slowest = 0;
  try {
    const std::vector<TimedChunk> chunks =
        timed_chunks(study, jobs, expected.points, expected.core_seconds / count, patience_s);
    // The first ones only tell how many points to take together.
    constexpr std::size_t kAlike = 4;
    TimedChunk all;
    double points = 0;
    for (const TimedChunk& chunk : chunks) {
      timing.points_timed += chunk.done;
      timing.spent_seconds += chunk.seconds;
      if (kAlike * chunk.size < chunks.back().size || chunk.size > kAlike * chunks.back().size || chunk.done <= 0) continue;
      points += chunk.done;
      all.seconds += chunk.seconds;
      all.by_rule += chunk.by_rule * chunk.done / static_cast<double>(chunk.size);
      if (chunk.size == 1) slowest = std::max(slowest, chunk.seconds / chunk.done);
    }
    if (points > 0) {
      // A few points may not be like the others: the rule tells by how much.
      constexpr double kMany = 24;
      const bool by_rule = points < std::min(kMany, count) && all.by_rule > 0;
      const double a_point = by_rule ? expected.core_seconds / count * all.seconds / all.by_rule : all.seconds / points;
      timing.core_seconds = kStart_s + count * (a_point + kStoring_s);
    } else {
      timing.points_timed = 0;
      timing.core_seconds = std::max(timing.core_seconds, count * chunks.back().seconds);
    }
  } catch (const std::system_error&) {  // there is no thread to tell the time
    timing.points_timed = timing.spent_seconds = 0;
  }
  const double cores = std::max(1U, std::thread::hardware_concurrency());
  const double threads = std::max(1.0, std::min({static_cast<double>(jobs), cores, static_cast<double>(timing.shard_points)}));
  const double share = count > 0 ? static_cast<double>(timing.shard_points) / count : 0;
  timing.seconds = std::max(timing.core_seconds * share / threads, timing.shard_points > 0 ? slowest : 0);
  return timing;
}

std::string timing_basis(const StudyTiming& timing) {
  if (!timing.is_timed()) return "The times are estimated by rules, as no point could be timed";
  const std::string took = fmt::format(", computed as the study does, which took {:.2g} s", timing.spent_seconds);
  if (timing.points_timed < 1)
    return fmt::format("The times are told from the first {:.0f} % of one point{}", 100 * timing.points_timed, took);
  return fmt::format("The times are those of {:.0f} {} of the design{}", timing.points_timed,
                     timing.points_timed < 1.5 ? "point" : "points", took);
}

}  // namespace earthtop
