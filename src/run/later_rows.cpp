// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/later_rows.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "drift/motion_way.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/rows.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kFewRows = 1000, kRowsAPart = 2048;

/// Whether the result holds the row at a time.
bool is_held(const RunResult& result, double t_s) {
  const auto row = std::ranges::lower_bound(result.rows, t_s, {}, &DriftRow::t_s);
  return row != result.rows.end() && row->t_s == t_s;
}

/// Adds rows to means.
class MeanOfRows {
 public:
  explicit MeanOfRows(std::size_t count) : count_(static_cast<double>(count)) {}
  void include(const DriftRow& row) {
    for (std::size_t i = 0; i < 3; ++i) {
      means_.axis_L[i] += row.axis_L[i] / count_;
      means_.ref_axis_L[i] += row.ref_axis_L[i] / count_;
    }
  }
  const AxisMeans& means() const { return means_; }

 private:
  double count_;
  AxisMeans means_;
};

}  // namespace

bool is_made_row_by_row(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  if (!(scenario.duration_s / scenario.output_step_s > static_cast<double>(kLongTable))) return false;
  if (scenario.precision != Precision::bits53 || scenario.ledger || scene.support().has_contact) return false;
  if (scenario.effects.applied.coulomb_N_m != 0) return false;
  if (scenario.headline && scenario.headline->at_s && *scenario.headline->at_s != scenario.duration_s) return false;
  const Method method = scene.choice().options.method;
  return method == Method::taylor || method == Method::long_horizon || is_exact(method);
}

/// Its step is longer by a power of two, so that the times are the very same.
Scene with_few_rows(const Scene& scene) {
  Scenario few = scene.scenario();
  while (few.duration_s / few.output_step_s > static_cast<double>(kFewRows)) few.output_step_s *= 2;
  return resolve(std::move(few));
}

LaterRows::LaterRows(Scene few, OutputTimes times, IntegrationOptions options, LookMemory memory,
                     std::vector<JudgedLook> judged, bool ahead)
    : few_(std::move(few)),
      times_(times),
      options_(std::move(options)),
      memory_(std::move(memory)),
      judged_(std::move(judged)),
      ahead_(ahead) {}

/// The rows come by the method of the run, which its looks need not. What they leave on their way is no part of the run: the digits of
/// rows do not depend on who has visited them before.
LookMemory LaterRows::memory_for_rows() const {
  LookMemory memory = memory_;
  const bool is_of_rows = !memory.way->looked_by || memory.way->looked_by->method == options_.method;
  memory.way = is_of_rows ? std::make_shared<MotionWay>(*memory.way) : LookMemory::new_way();
  memory.way->looked_by = options_;
  memory.way->looked_by->kick_steps = memory.kick_steps;
  return memory;
}

std::size_t LaterRows::count_until(double reached_s) const {
  std::size_t low = 0, high = times_.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    times_.at(middle) <= reached_s ? low = middle + 1 : high = middle;
  }
  return low;
}

bool LaterRows::are_all_trusted(const RunResult& result) const {
  const std::size_t count = count_until(result.reached_s);
  for (std::size_t i = 0; i < count; ++i)
    if (!result.verdict.trusts(times_.at(i))) return false;
  return true;
}

LaterRows::Part LaterRows::make(std::size_t begin, std::size_t end, const RunResult& result, const LookMemory& memory,
                                const Watch& watch) const {
  Part part{begin, end, {}};
  std::vector<double> times = {0};  // looks begin at the release
  for (std::size_t i = std::max<std::size_t>(begin, 1); i < end; ++i)
    if (!is_held(result, times_.at(i))) times.push_back(times_.at(i));
  const std::size_t count = times.size() - 1;
  if (count == 0) return part;
  // The first looks go to the end of the run, so that their way knows how long it is.
  if (begin == 0 && times.back() < few_.scenario().duration_s) times.push_back(few_.scenario().duration_s);
  const DriftTrajectory<double> looks = look_again(few_, std::move(times), options_, memory, watch.with_progress(nullptr));
  if (watch.asks_to_stop()) return part;
  if (looks.samples.size() <= count) throw std::runtime_error("the motion between two rows could not be integrated once more");
  part.made.reserve(count);
  const RowParts<double> parts(few_, {});
  for (std::size_t i = 1; i <= count; ++i) {
    DriftRow row = make_row(looks.samples[i], DriftBound<double>(0), parts);
    take_bounds(judged_, row);
    row.drift_reliable = result.verdict.trusts(row.t_s);
    part.made.push_back(row);
  }
  return part;
}

void LaterRows::visit(const RunResult& result, const std::function<void(const DriftRow&)>& visit, const Watch& watch) const {
  const std::size_t count = count_until(result.reached_s);
  const LookMemory memory = memory_for_rows();
  const auto make_from = [&](std::size_t begin) {
    return make(begin, std::min(begin + kRowsAPart, count), result, memory, watch);
  };
  std::future<Part> next;
  MeanOfRows means(count);
  auto held = result.rows.begin();
  for (std::size_t begin = 0; begin < count; begin += kRowsAPart) {
    const Part part = next.valid() ? next.get() : make_from(begin);
    if (watch.asks_to_stop()) return;
    if (ahead_ && part.end < count) try {
        next = std::async(std::launch::async, make_from, part.end);
      } catch (const std::system_error&) {  // no thread is available: one part follows the other
      }
    auto made = part.made.begin();
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const bool is_held = held != result.rows.end() && held->t_s == times_.at(i);
      const DriftRow& row = is_held ? *held++ : *made++;
      means.include(row);
      visit(row);
    }
    watch.reach(static_cast<double>(part.end) / static_cast<double>(count));
  }
  means_ = means.means();
}

std::size_t row_count(const RunResult& result) {
  return result.later_rows ? result.later_rows->count_until(result.reached_s) : result.rows.size();
}

void each_row(const RunResult& result, const std::function<void(const DriftRow&)>& visit, const Watch& watch) {
  if (result.later_rows) return result.later_rows->visit(result, visit, watch);
  constexpr std::size_t kOften = 1024;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    if (i % kOften == 0) watch.reach(static_cast<double>(i) / static_cast<double>(result.rows.size()));
    visit(result.rows[i]);
  }
}

AxisMeans axis_means(const RunResult& result) {
  if (result.later_rows) {
    if (!result.later_rows->means()) each_row(result, [](const DriftRow&) {});
    return *result.later_rows->means();
  }
  MeanOfRows means(result.rows.size());
  for (const DriftRow& row : result.rows) means.include(row);
  return means.means();
}

}  // namespace earthtop
