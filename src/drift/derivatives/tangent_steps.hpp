// SPDX-License-Identifier: GPL-3.0-or-later
/// Follows a motion with its tangents (tangents.hpp) by steps of a Taylor series.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "earthtop/integrate/options.hpp"
#include "earthtop/watch.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/taylor/stabilised_taylor.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {

/// @tparam Motion  has the `Shape` of a state with its tangents, the `kSize` of it, and its `Series`
template <class Motion>
class TangentSteps {
 public:
  using State = std::array<double, Motion::kSize>;

  /// @param stabilised  whether the last terms are weighted (stabilised_taylor.hpp), for motions that relax fast
  TangentSteps(typename Motion::Series series, const State& x, double relative_tolerance, bool stabilised = false)
      : series_(std::move(series)),
        is_stabilised_(stabilised),
        plain_(relative_tolerance, scales_),
        weighted_(relative_tolerance * kStabilisedShare, scales_) {
    restart(x, 0);
  }
  TangentSteps(const TangentSteps&) = delete;

  /// Errors are measured against the sizes of this state, too.
  void include(const State& x) { scales_.include(x); }
  void restart(const State& x, double t) {
    include(x);
    plain_.initialize(x, t);
  }
  /// Takes a step, not beyond the end.   @returns whether it got on
  bool take(State& x, double& t, double end, double longest, std::int64_t& evaluations) {
    const double left = end - t, most = std::min(longest, left);
    if (is_stabilised_) {
      step_ = weighted_.step(series_, x, t, most);
      evaluations += taylor::kStabilisedDegree;
    } else {
      plain_.limit_step(most);
      plain_.do_step(series_);
      step_ = plain_.current_time_step();
      evaluations += plain_.evaluations();
      x = plain_.current_state();
    }
    if (!(step_ > 0) || !(t + step_ > t) || !all_finite(x)) return false;
    t = !(step_ < left) ? end : is_stabilised_ ? t + step_ : plain_.current_time();
    include(x);
    return true;
  }
  double last_step() const { return step_; }
  /// The state, or its first components alone, after a share of the last step, which was not stabilised.
  template <std::size_t kCount = Motion::kSize>
  std::array<double, kCount> within(double share) const {
    std::array<double, kCount> x;
    plain_.state_after(step_ * share, x);
    return x;
  }

 private:
  /// A step's tolerance where its last terms are weighted, as a share of what the last of all terms is held to otherwise.
  static constexpr double kStabilisedShare = 1e-3;

  GroupScales<double, typename Motion::Shape> scales_;
  typename Motion::Series series_;
  bool is_stabilised_;
  taylor::TaylorStepper<double, Motion> plain_;
  taylor::StabilisedTaylor<Motion> weighted_;
  double step_ = 0;
};

struct TangentLimits {
  double end;
  double longest = HUGE_VAL;  ///< of a step
  std::int64_t steps = 20'000'000;
};

/// @param look  called with (x, t) after each step
template <class Motion, class Look>
RunStatus follow_tangents(TangentSteps<Motion>& steps, typename TangentSteps<Motion>::State& x, const TangentLimits& limits,
                          StepCounters& counters, const Watch& watch, const Look& look) {
  double t = 0;
  for (std::int64_t taken = 0; t < limits.end; ++taken, ++counters.accepted) {
    if (taken >= limits.steps) return RunStatus::step_limit;
    watch.reach(t / limits.end);
    if (watch.asks_to_stop()) return RunStatus::interrupted;
    if (!steps.take(x, t, limits.end, limits.longest, counters.evaluations)) return RunStatus::step_underflow;
    look(x, t);
  }
  return RunStatus::completed;
}

}  // namespace earthtop
