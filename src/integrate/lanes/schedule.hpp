// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes many points (problems) through a kernel, eight at a time. Each lane has its own clock, step and rows, and takes the
/// next point as soon as its own is done. A lane does what the driver's `run_dense` does with its stepper; lanes share nothing
/// but the order of the series and the tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "earthtop/arithmetic.hpp"
#include "earthtop/elementary.hpp"
#include "integrate/drive_options.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The settings that all points of a batch share.
struct Plan {
  const Kernel* kernel;
  int order;
  double last_term;          ///< size of a series' last term relative to that of its component group
  LaneCode* code = nullptr;  ///< of equations that are recorded
};

/// The plan for a tolerance. The last term is that of `TaylorStepper`. The order is the one of least work for tops with many
/// nutations; it is higher than that for a series with a near singularity.
inline Plan plan_for(const Kernel& kernel, double relative_tolerance) {
  const double last_term = 1e-4 * relative_tolerance;
  return {&kernel, std::clamp(static_cast<int>(1 - 0.7 * real::log(last_term)), 6, kMostOrder), last_term};
}

/// One point in its lane.
/// @tparam Point  has
///   System                     the point's system, with the `Shape` of its states and initial_state(), typical_state() if any
///   kVariables                 number of the kernel's state variables; those that the system does not have begin at 0
///   system(), times(), drive() the system, the output times and the driver's options; in natural units
///   longest_step()             a limit to the steps, in natural units
///   longest_unseen_turn()      how far the motion may turn between two states that on_step or on_row sees (rad); 0: they see
///                              the end of every step
///   constants(rows, lane)      puts the constants of the equations into the lane's place
///   before_step(t)             where the point has it, is called before a step that begins at t
///   leaves()                   where the point has it: whether the step that was taken does not count, and the point is left unfinished
///   on_step(t, x), on_row(row, x)    see the states between the rows, and those of the rows
///   finish(status, counters)   is called at the end
template <class Point>
class Lane {
 public:
  using System = typename Point::System;
  using State = std::array<double, System::kSize>;

  template <class... Arguments>
  Lane(Block& block, std::size_t lane, Arguments&&... arguments)
      : block_(block),
        lane_(lane),
        point_(std::forward<Arguments>(arguments)...),
        clock_(point_.times().front(), point_.times().back()) {}

  /// Puts the point, at its release, into the lane. @returns whether there is a step to take
  bool begin() {
    const State x = point_.system().initial_state();
    GroupScales<double, typename System::Shape> scales;
    scales.include(x);
    if constexpr (requires { point_.system().typical_state(); }) scales.include(point_.system().typical_state());
    if (!all_finite(x)) return end(RunStatus::not_finite);
    point_.on_row(0, x);
    if (point_.times().size() == 1) return end(RunStatus::completed);
    for (std::size_t i = 0; i < static_cast<std::size_t>(Point::kVariables); ++i) {
      at(block_.x[i]) = i < x.size() ? x[i] : 0.0;
      at(block_.rest[i]) = 0.0;
    }
    for (std::size_t g = 0; g < scales.squares().size(); ++g) at(block_.squares[g]) = scales.squares()[g];
    point_.constants(block_.constants, lane_);
    return true;
  }

  /// Prepares a step. @returns whether it may be taken
  bool prepare() {
    const auto& times = point_.times();
    if (const RunStatus status = may_go_on(point_.drive(), counters_, clock_.now(), times.front(), times.back());
        status != RunStatus::completed)
      return end(status);
    at(block_.longest) = std::min(clock_.remaining(), point_.longest_step());
    if constexpr (requires { point_.before_step(clock_.now()); }) point_.before_step(clock_.now());
    return true;
  }

  /// Accepts the step that the kernel has taken. @returns whether the point goes on, with states of that step to be seen
  bool accept() {
    if constexpr (requires { point_.leaves(); })
      if (point_.leaves()) return false;
    ++counters_.accepted;
    counters_.evaluations += block_.order;
    if (!(at(block_.not_finite) == 0.0)) return end(RunStatus::not_finite);
    step_ = at(block_.step);
    lands_ = step_ >= clock_.remaining();
    if (!lands_ && step_ < least_step<double>()) return end(RunStatus::step_underflow);
    piece_ = 1;
    pieces_ = 1;
    passes_end_ = !is_watched<System>();
    if constexpr (is_watched<System>()) {
      turned_ = std::sqrt(at(block_.first_turn)) * step_ + std::sqrt(at(block_.second_turn)) * (step_ * step_);
      pieces_ = static_cast<int>(pieces_of_step(point_.drive(), step_, turned_));
      // The end may be passed if there is room for another step like this before the next look.
      unseen_ += turned_;
      passes_end_ = unseen_ + turned_ < point_.longest_unseen_turn();
      if (!passes_end_) unseen_ = 0;
    }
    return true;
  }

  /// Goes on to the next state within the step that a row or the watcher asks for. States at the step's end are shown here.
  /// @param after  set to the time of that state after the beginning of the step
  /// @returns whether there is such a state before the step's end: `see` is to be called with it
  bool next_look(double& after) {
    const auto& times = point_.times();
    while (piece_ <= pieces_) {
      const bool in_piece = row_ < times.size() && (clock_.until(times[row_]) <= piece_end() || (piece_ == pieces_ && lands_));
      if (!in_piece && row_ == times.size()) return false;
      if (!in_piece && passes_end_) {
        ++piece_;
        continue;
      }
      looks_at_row_ = in_piece;
      after = in_piece ? clock_.until(times[row_]) : piece_end();
      if (after < step_) return true;
      see(block_.x);
    }
    return false;
  }
  /// Shows the state that was asked for. @param x  the states of all lanes at the times asked for
  void see(const Row* x) {
    State seen;
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = x[i].lane[lane_];
    if (looks_at_row_) {
      point_.on_row(row_, seen);
      ++row_;
      unseen_ = std::min(unseen_, turned_);
    } else {
      point_.on_step(clock_.now() + piece_end(), seen);
      ++piece_;
    }
  }

  /// Goes on to the end of the step. @returns whether the point has another step to take
  bool advance() {
    clock_.advance(step_);
    return row_ < point_.times().size() || end(RunStatus::completed);
  }

 private:
  bool end(RunStatus status) {
    point_.finish(status, counters_);
    return false;
  }
  double& at(Row& row) const { return row.lane[lane_]; }
  double piece_end() const { return piece_ == pieces_ ? step_ : step_ * piece_ / pieces_; }

  Block& block_;
  std::size_t lane_;
  Point point_;
  IntervalClock<double> clock_;
  StepCounters counters_;
  std::size_t row_ = 1;
  double step_ = 0;
  bool lands_ = false;
  int piece_ = 1, pieces_ = 1;      ///< the pieces in which the watcher sees the step
  double turned_ = 0, unseen_ = 0;  ///< how far the step turns the motion, and how far it has turned since the last look (rad)
  bool passes_end_ = false;         ///< whether the step's end is not looked at
  bool looks_at_row_ = false;
};

/// Gives the points of a batch to the lanes.
/// @tparam Arguments  a function that takes the number of a point to the arguments of its Point, as a tuple
template <class Point, class Arguments>
class Schedule {
 public:
  Schedule(const Plan& plan, std::size_t count, const Arguments& arguments)
      : kernel_(*plan.kernel), count_(count), arguments_(arguments), block_(std::make_unique<Block>()) {
    block_->order = plan.order;
    block_->code = plan.code;
    block_->tolerance_squared = plan.last_term * plan.last_term;
  }

  void run() {
    for (std::size_t l = 0; l < kLaneCount; ++l) refill(l);
    while (prepare()) {
      kernel_.step(*block_);
      for (std::size_t l = 0; l < kLaneCount; ++l)
        if (lanes_[l] && !lanes_[l]->accept()) refill(l), fresh_[l] = true;
      show();
      for (std::size_t l = 0; l < kLaneCount; ++l)
        if (lanes_[l] && !fresh_[l] && !lanes_[l]->advance()) refill(l);
    }
  }

 private:
  static constexpr std::size_t kLaneCount = kLanes;

  /// Fills the lane with the next point that has a step to take. If there is none, the lane idles; its numbers are then
  /// harmless.
  void refill(std::size_t l) {
    lanes_[l].reset();
    while (next_ < count_) {
      std::apply([&](auto&&... a) { lanes_[l].emplace(*block_, l, a...); }, arguments_(next_++));
      if (lanes_[l]->begin()) return;
      lanes_[l].reset();
    }
    const auto clear = [&](auto& rows) {
      for (Row& row : rows) row.lane[l] = 0.0;
    };
    clear(block_->x), clear(block_->rest), clear(block_->constants);
    for (Row& row : block_->squares) row.lane[l] = 1.0;
    block_->longest.lane[l] = 1.0;
  }

  /// @returns whether any lane has a step to take
  bool prepare() {
    bool any = false;
    for (std::size_t l = 0; l < kLaneCount; ++l) {
      fresh_[l] = false;
      while (lanes_[l] && !lanes_[l]->prepare()) refill(l);
      any = any || lanes_[l];
    }
    return any;
  }

  /// Shows the rows of all lanes within the step, and the states that their watchers ask for.
  void show() {
    for (;;) {
      Row after{};
      unsigned wanted = 0;
      for (std::size_t l = 0; l < kLaneCount; ++l)
        if (lanes_[l] && !fresh_[l] && lanes_[l]->next_look(after.lane[l])) wanted |= 1U << l;
      if (wanted == 0) return;
      kernel_.evaluate(*block_, after, wanted, seen_.data());
      for (std::size_t l = 0; l < kLaneCount; ++l)
        if ((wanted >> l & 1U) != 0) lanes_[l]->see(seen_.data());
    }
  }

  const Kernel& kernel_;
  std::size_t count_, next_ = 0;
  const Arguments& arguments_;
  std::unique_ptr<Block> block_;
  std::array<std::optional<Lane<Point>>, kLaneCount> lanes_;
  std::array<bool, kLaneCount> fresh_{};  ///< refilled since the last step
  std::array<Row, kMostVariables> seen_{};
};

/// Runs a batch. Lanes without a point and lanes that end compute with numbers that may overflow or be none; nobody sees them, and
/// a host that traps such exceptions must not, either.
template <class Point, class Arguments>
void run_in_lanes(const Plan& plan, std::size_t count, const Arguments& arguments) {
  const NoTraps held;
  Schedule<Point, Arguments>(plan, count, arguments).run();
}

/// Whether the component groups of a kernel are those of the system.
template <class System, std::size_t kMost>
constexpr bool are_groups_of(const Group (&groups)[kMost]) {
  constexpr auto expected = System::Shape::groups();
  static_assert(expected.size() <= kMostGroups);
  bool same = kMost >= expected.size();
  for (std::size_t g = 0; same && g < expected.size(); ++g)
    same = groups[g].begin == static_cast<int>(expected[g].begin) && groups[g].count == static_cast<int>(expected[g].count) &&
           groups[g].turns == (expected[g].least_scale == 1.0);
  return same;
}

}  // namespace earthtop::lanes
