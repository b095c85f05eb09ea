// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/long_horizon/long_horizon_drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>

#include "drift/long_horizon/followed_nutation.hpp"
#include "drift/long_horizon/long_horizon_work.hpp"
#include "drift/long_horizon/rate_interpolation.hpp"
#include "drift/motion_way.hpp"
#include "drift/release_rates.hpp"
#include "drift/spinless_pair_system.hpp"
#include "drift/watch/step_watcher.hpp"
#include "drift/watch/threshold_watch.hpp"
#include "integrate/drive_problem.hpp"
#include "integrate/long_horizon.hpp"

namespace earthtop {
namespace {

using T = double;
using long_horizon::kGoldenPart;
using long_horizon::kNodeDrift;
using long_horizon::kSmall;
using Top = TiltedTop<T>;
using Pair = SpinlessPair<T>;
using PairSystem = SpinlessPairSystem<T>;
using Joined = JoinedPair<T>;

/// What the walks of a run leave for later looks.
struct WalkedStops {
  struct Stop {
    LongHorizonWalk<T>::Position position;
    Pair followed;  ///< both motions there, to which angles have been followed
    StepWatcherTurns<T> turns;
  };
  using OfRate = std::map<std::int64_t, Stop>;  ///< by the number of steps
  std::map<T, OfRate> of;                       ///< by the Earth's rate
  T node = T(0);  ///< the largest rate at which a small drift is taken; 0: none has been found yet
};

class LongHorizonDrift {
 public:
  LongHorizonDrift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch)
      : problem_(problem),
        options_(options),
        watch_(watch),
        model_(problem.model),
        symmetric_(reduced_top(problem.model)),
        release_(problem.natural_release()),
        times_(natural_times(problem)),
        duration_(problem.are_looks ? problem.way->duration_from(times_.back()) : times_.back()),
        reference_(top_at(T(0))),
        reference_flow_(reference_, reference_.start()) {}

  DriftTrajectory<T> run() {
    DriftTrajectory<T> trajectory = rows();
    if (problem_.threshold_rad) trajectory.threshold = found_threshold();
    return trajectory;
  }

 private:
  DriftTrajectory<T> rows() {
    const T epsilon = model_.epsilon;
    if (norm(model_.W_IL_L_scaled) == T(0) || times_.size() < 2) {
      for (const T t : times_) pairs_.push_back(pair(reference_flow_.at(t), reference_, t, T(1)));
      for (Pair& p : pairs_) p.e_w = T(1), p.y = Vec3<T>::Zero();
      return watched(epsilon, true);
    }
    const Top top = top_at(epsilon);
    const LongHorizonPlan<T> plan = plan_of(top, T(options_.relative_tolerance));
    walked_.push_back({top, plan, epsilon});
    set_step(plan);
    T largest_node = std::numeric_limits<T>::infinity();
    if (plan.averages()) {
      const T averaging = averaging_error(top, duration_, plan.averaging);
      stated_error_ = averaging / duration_;
      largest_node = epsilon * long_horizon::largest_node(top, duration_, plan.averaging);
    }
    DriftTrajectory<T> plain = watch_walk(top, plan, epsilon);
    const T largest = largest_drift(epsilon);
    const bool difference_suffices = largest >= kSmall || largest_node < T(2) * epsilon;
    // Two walks with long steps may have the same error, mostly in the turn about the axis, which their comparison does not
    // show: up to 5e-12 rad, as in one of 180 gyroscopes, or, at a loose tolerance, five times what averaging is said to leave over.
    if (plan.averages() && difference_suffices) {
      const T unseen = std::max(long_horizon::kUnseenError, long_horizon::kUnseenShare * stated_error_ * duration_);
      for (std::size_t i = 0; i < plain.samples.size(); ++i) {
        const T so_far = unseen * (times_[i] / duration_);
        plain.samples[i].drift_error += so_far, plain.samples[i].attitude_error += so_far;
      }
    }
    if (difference_suffices || trajectory_status_ != RunStatus::completed) return plain;
    const T drift = interpolate(epsilon, largest, largest_node);
    if (!(drift > T(0))) return plain;  // there is no drift at any rate
    return watched(epsilon, false);
  }

  static constexpr T kApart = 1e-3;           ///< phase of the fast motion between the states that rates come from (rad)
  static constexpr double kWalkShare = 0.75;  ///< share of the remaining work that is left after a walk, for the progress

  Top top_at(T epsilon) const { return Top(model_, symmetric_, release_, Vec3<T>(epsilon * model_.W_IL_L_scaled)); }
  Model<T> model_at(T epsilon) const {
    Model<T> model = model_;
    model.epsilon = epsilon, model.W_IL_L = epsilon * model_.W_IL_L_scaled;
    return model;
  }
  LongHorizonPlan<T> plan_of(const Top& top, T tolerance) {
    const T duration = duration_;
    if (options_.step_s) {
      const T step = problem_.units.time_from_s(T(*options_.step_s));
      return make_plan(top, kick_schedules::gauss(4), step, may_average(top, duration, step, tolerance));
    }
    LongHorizonPlan<T> plan = options_.kick_steps ? plan_from(top, *options_.kick_steps, problem_.units)
                                                  : find_plan(top, duration, tolerance, counters_, watch_);
    found_ = {real::scale(plan.step, problem_.units.time_exponent), is_composed(plan) ? 0 : plan.schedule.kicks,
              plan.averaging};
    // Another observer asks for an independent check. It gets steps that are incommensurable with these, and an average over
    // twice the time, which has four times the error.
    if (is_second()) plan.step *= kGoldenPart, plan.filter = make_filter(top, plan.averaging, true);
    return plan;
  }
  bool is_second() const { return options_.observer != Observer::laboratory; }
  void set_step(const LongHorizonPlan<T>& plan) {
    step_s_ = static_cast<double>(real::scale(T(duration_ / T(steps_in(plan, duration_))), problem_.units.time_exponent));
  }

  Pair pair(const TiltedTopState<T>& rotating, const Top& top, T t, T epsilon) const {
    const Top::Seen there = top.seen(rotating, t), reference = reference_.seen(reference_flow_.at(t), t);
    const Quaternion<T> e = (reference.q_LF.conjugate() * there.q_LF).normalized();
    return {reference.q_LF, reference.across, e.w, Vec3<T>(e.v / epsilon), there.across, there.spin_excess};
  }

  bool goes_on() {
    if (watch_.asks_to_stop()) trajectory_status_ = RunStatus::interrupted;
    if (counters_.accepted > options_.step_limit) trajectory_status_ = RunStatus::step_limit;
    return trajectory_status_ == RunStatus::completed;
  }
  /// Whether the step limit allows this many more steps to the next row.
  bool has_room_for(T steps) {
    if (static_cast<T>(counters_.accepted) + steps > static_cast<T>(options_.step_limit))
      trajectory_status_ = RunStatus::step_limit;
    return trajectory_status_ == RunStatus::completed;
  }
  static bool finite(const Pair& p) {
    return real::isfinite(p.e_w + p.y.sum() + p.across.re + p.across.im + p.ref_q_LF.w + p.ref_across.re + p.ref_across.im);
  }

  /// Follows the pairs of a walk.
  struct Watched {
    PairSystem system;
    StepWatcher<T, PairSystem> watcher;
    Watched(const LongHorizonDrift& drift, T epsilon)
        : system(epsilon, drift.release_.w_XB_B[2]), watcher(system, drift.problem_) {
      system.start_from(drift.problem_.release.q_LB);
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;
  };

  /// Lets a walk go on from the last stop before t, if that is ahead.
  static void go_to_stop(const WalkedStops::OfRate& stops, T t, LongHorizonPath<T>& path, Watched* watched) {
    const auto after = stops.upper_bound(path.whole_steps(t));
    if (after == stops.begin()) return;
    const auto& [steps, stop] = *std::prev(after);
    if (steps <= path.steps_done()) return;
    path.go_to(steps, stop.position);
    if (watched == nullptr) return;
    watched->system.go_on_from(stop.followed);
    watched->watcher.go_on_from(stop.turns);
  }

  /// Makes one walk and notes the pair at each row. @param look  called with time and pair, at the rows and between them
  /// @param watched  what `look` shows the pairs to; null if nothing
  template <class Look>
  void walk(const Top& top, const LongHorizonPlan<T>& plan, T epsilon, T longest_time_between_looks, Watched* watched,
            Look&& look) {
    LongHorizonPath<T> path(top, plan, duration_, counters_, watch_);
    const Model<T> model = model_at(epsilon);
    std::optional<FollowedNutation> followed;
    WalkedStops::OfRate* stops = nullptr;
    if (problem_.are_looks) {
      stops = &problem_.way->stops<WalkedStops>().of[epsilon];
      if (real::isfinite(top.nutation_period())) followed.emplace(model, release_, top.nutation_period());
    }
    const Watch part = next_walk();
    pairs_.clear();
    for (std::size_t i = 0; i < times_.size() && goes_on(); ++i) {
      const T t = times_[i];
      part.reach(static_cast<double>(t / duration_));
      Pair p;
      if (i > 0 && followed && followed->reaches(t)) {
        p = followed->at(t);
      } else {
        TiltedTopState<T> state = top.start();
        if (i > 0) {
          if (stops != nullptr) go_to_stop(*stops, t, path, watched);
          if (!has_room_for(path.steps_to(t))) return;
          state = path.at(
              t, longest_time_between_looks,
              [&](T on_the_way, const TiltedTopState<T>& x) {
                if (on_the_way > times_[i - 1]) look(on_the_way, pair(x, top, on_the_way, epsilon));
              },
              [&] {
                if (stops == nullptr) return;
                const T here = path.time_done();
                const Pair there = pair(path.walk().state(), top, here, epsilon);
                if (here > times_[i - 1]) look(here, there);
                WalkedStops::Stop stop{path.walk().position(), there, {}};
                if (watched != nullptr)
                  stop.followed = watched->system.signed_like_followed(there), stop.turns = watched->watcher.turns();
                stops->try_emplace(path.steps_done(), stop);
              });
        }
        if (!goes_on()) return;
        p = pair(state, top, t, epsilon);
        if (followed) followed->begin(t, p);
      }
      if (!finite(p)) {
        trajectory_status_ = RunStatus::not_finite;
        return;
      }
      pairs_.push_back(p);
      look(t, p);
    }
  }
  /// Searches for the threshold, going from step to step once more. Each look between two steps takes walks of its own from the
  /// last position: the state of a walk is complete only where the walk stops, so states on its way are no use. Wherever the
  /// drift and its nutation might reach the threshold, looks lie close enough to resolve the nutation.
  ThresholdRecord<T> found_threshold() {
    ThresholdWatch<T> watch(T(*problem_.threshold_rad), walked_.empty() ? T(1) : fast_rate());
    StepCounters uncounted;
    std::vector<LongHorizonWalk<T>> walks;
    walks.reserve(walked_.size());
    for (const Walked& walked : walked_) walks.emplace_back(walked.top, walked.plan, uncounted, watch_.part(1, 1));
    T begin = T(0);
    const T apart = T(kApart) / fast_rate();
    const auto pair_at = [&](T t) {
      std::array<Pair, kRateNodes.size()> at;
      for (std::size_t i = 0; i < walks.size(); ++i) {
        LongHorizonWalk<T> walk = walks[i];
        if (t != begin) walk.advance(t - begin, T(0), [](T, const TiltedTopState<T>&) {});
        at[i] = pair(walk.state(), walked_[i].top, t, walked_[i].epsilon);
      }
      if (walks.size() == 1) return at[0];
      return joined(at, model_.epsilon, walked_[0].epsilon).pair;
    };
    const auto state_at = [&](T t) {
      const Pair p = pair_at(t);
      DriftState<T> s;
      s.epsilon = model_.epsilon, s.ref_q_LB = p.ref_q_LF, s.e_w = p.e_w, s.e_v_scaled = p.y;
      return s;
    };
    const auto look_at = [&](T t) {
      return axis_look(t, state_at(t), state_at(t - apart), state_at(t + apart), T(T(2) * apart));
    };
    if (!walks.empty()) watch.follow(look_at(T(0)), look_at);
    // Goes on in the walks' own steps, so that no look in between is more than the work of one step away.
    const T reached = pairs_.empty() ? T(0) : times_[pairs_.size() - 1];
    const std::int64_t steps = walks.empty() ? 0 : steps_in(walked_.front().plan, duration_);
    for (std::int64_t step = 1; step <= steps && begin < reached && !watch.done() && goes_on(); ++step) {
      const T end = std::min(reached, T(duration_ * (T(step) / T(steps))));
      watch.follow(watch.has_passed() ? axis_look(end, state_at(end)) : look_at(end), look_at);
      for (LongHorizonWalk<T>& walk : walks) walk.advance(end - begin, T(0), [](T, const TiltedTopState<T>&) {});
      begin = end;
    }
    return watch.record().in_seconds(problem_.units.time_exponent);
  }
  /// Upper estimate of all rates: of the nutation and of the Earth.
  T fast_rate() const {
    T fastest = T(0);
    for (const Walked& walked : walked_) fastest = std::max(fastest, walked.top.fast_rate());
    return fastest + norm(model_.W_IL_L);
  }

  /// The part of the watch for the next walk. If the drift may be large enough, the first walk is the only one. Otherwise there
  /// are about five more, if the first rates tried for them are right.
  Watch next_walk() {
    const bool is_alone = walks_ == 0 && norm(model_.W_IL_L) * duration_ > kSmall;
    const double done = walks_ == 0 ? 0 : 1 - real::pow(kWalkShare, walks_);
    ++walks_;
    return watch_.part(done, is_alone ? 1 : 1 - real::pow(kWalkShare, walks_));
  }
  T longest_time_between_looks(const Top& top, bool averages) const {
    const T rate = top.frame_rate() + reference_.frame_rate() + norm(model_.W_IL_L);
    return rate > T(0) ? T(long_horizon::look_angle(averages)) / rate : duration_;
  }

  DriftTrajectory<T> watch_walk(const Top& top, const LongHorizonPlan<T>& plan, T epsilon) {
    Watched watched(*this, epsilon);
    DriftTrajectory<T> trajectory;
    trajectory.samples.reserve(times_.size());
    std::size_t rows = 0;
    walk(top, plan, epsilon, longest_time_between_looks(top, plan.averages()), &watched, [&](T t, const Pair& p) {
      watched.watcher(t, p);
      if (pairs_.size() > rows) add_sample(watched.watcher, p, rows++, trajectory);
    });
    return finished(trajectory);
  }
  /// The trajectory from the pairs noted already.
  DriftTrajectory<T> watched(T epsilon, bool exact) {
    Watched seen(*this, epsilon);
    DriftTrajectory<T> trajectory;
    trajectory.samples.reserve(times_.size());
    const T every = longest_time_between_looks(reference_, !walked_.empty() && walked_.front().plan.averages());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      // The deviation is small and cannot go round between two rows; only the reference has to be followed.
      if (i > 0)
        for (T t = times_[i - 1] + every; t < times_[i]; t += every) {
          Pair between = pairs_[i - 1];
          between.ref_q_LF = reference_.seen(reference_flow_.at(t), t).q_LF;
          seen.system.follow(between);
        }
      seen.watcher(times_[i], pairs_[i]);
      add_sample(seen.watcher, pairs_[i], i, trajectory);
    }
    if (exact) counters_.evaluations += 1;
    return finished(trajectory);
  }
  void add_sample(const StepWatcher<T, PairSystem>& watcher, const Pair& p, std::size_t row, DriftTrajectory<T>& trajectory) {
    trajectory.samples.push_back(watcher.sample(p, times_[row], problem_.times_s[row]));
    trajectory.samples.back().drift_error = stated_error_ * times_[row];
    if (row < interpolation_errors_.size()) trajectory.samples.back().drift_error += interpolation_errors_[row];
    if (row == 0) set_release_rates(problem_, trajectory.samples.front().state);
  }
  DriftTrajectory<T> finished(DriftTrajectory<T>& trajectory) const {
    trajectory.status = trajectory_status_;
    trajectory.counters = counters_;
    trajectory.step_s = step_s_;
    trajectory.kick_steps = found_;
    return trajectory;
  }

  T largest_drift(T epsilon) const {
    T largest = T(0);
    for (const Pair& p : pairs_) largest = std::max(largest, T(2) * real::atan2(T(epsilon * norm(p.y)), real::abs(p.e_w)));
    return largest;
  }

  /// Fills `pairs_` for this epsilon from walks at four larger rates.
  /// @param drift  a first estimate of the drift at epsilon (rad)   @param largest_node  limit to the four rates
  /// @returns the drift at the largest of these rates; 0 if there is none at any rate
  T interpolate(T epsilon, T drift, T largest_node) {
    const auto quiet = [](T, const Pair&) {};
    constexpr T kResolved = 1e-5;  // a drift of this size is not round-off, and tells by how much to enlarge the rate
    constexpr T kRoundOff = 1e-13;
    // The Earth turns by a radian at most. An axis that has not drifted by then, as one parallel to the Earth's, hardly drifts
    // at any rate.
    T most = std::min(largest_node, T(1) / duration_);
    T node = std::min(most, drift > kResolved ? T(epsilon * kNodeDrift / drift) : T(kNodeDrift / duration_));
    const bool is_known = problem_.are_looks && problem_.way->stops<WalkedStops>().node > T(0);
    if (is_known) node = problem_.way->stops<WalkedStops>().node;
    for (int trial = 0; trial < 60; ++trial) {
      const Top top = top_at(node);
      const LongHorizonPlan<T> plan = plan_of(top, long_horizon::node_tolerance(options_.relative_tolerance));
      walk(top, plan, node, T(0), nullptr, quiet);
      const T reached = largest_drift(node);
      if (trajectory_status_ != RunStatus::completed) return reached;
      if (reached == T(0) || (reached < kRoundOff && node >= most)) return T(0);
      const bool fits = !(reached > kNodeDrift * T(2) || (reached < kNodeDrift / T(8) && node < most));
      if (!fits && !(is_known && trial == 0)) {  // a rate that is known was tried over the whole run
        node = std::min(most, T(node * std::clamp(T(kNodeDrift / reached), T(1e-6), T(1e3))));
        continue;
      }
      std::array<std::vector<Pair>, kRateNodes.size()> at;
      at[0] = pairs_;
      walked_.clear();
      walked_.push_back({top, plan, node});
      for (std::size_t i = 1; i < kRateNodes.size(); ++i) {
        LongHorizonPlan<T> same = plan;
        const Top other = top_at(kRateNodes[i] * node);
        same.filter = make_filter(other, plan.averaging, is_second());
        walked_.push_back({other, same, kRateNodes[i] * node});
        walk(other, same, kRateNodes[i] * node, T(0), nullptr, quiet);
        if (trajectory_status_ != RunStatus::completed) return reached;
        at[i] = pairs_;
      }
      if (join(at, epsilon, node) || trial > 40) {
        if (problem_.are_looks) problem_.way->stops<WalkedStops>().node = node;
        return reached;
      }
      if (node >= most) most /= T(4);
      node /= T(4);
    }
    return T(1);
  }

  /// Fills `pairs_` by interpolation. @returns whether the cubic's third-order term is small enough to trust the cubic
  bool join(const std::array<std::vector<Pair>, kRateNodes.size()>& at, T epsilon, T node) {
    InterpolationError<T> error;
    interpolation_errors_.clear();
    for (std::size_t row = 0; row < pairs_.size(); ++row) {
      const Joined there = joined({at[0][row], at[1][row], at[2][row], at[3][row]}, epsilon, node);
      pairs_[row] = there.pair;
      error.include(norm(there.pair.y), norm(there.second_order_term), norm(there.third_order_term));
      interpolation_errors_.push_back(T(2) * epsilon * error.fourth_order());
    }
    return error.third_order_is_small();
  }

  const DriftProblem<T>& problem_;
  const IntegrationOptions& options_;
  Watch watch_;
  const Model<T>& model_;
  ReducedTop<T> symmetric_;
  NaturalRelease<T> release_;
  std::vector<T> times_;
  T duration_;
  Top reference_;
  Top::Flow reference_flow_;
  StepCounters counters_;
  int walks_ = 0;
  RunStatus trajectory_status_ = RunStatus::completed;
  std::optional<double> step_s_;
  std::optional<KickSteps> found_;
  T stated_error_ = T(0);                ///< error of averaging per unit of time
  std::vector<T> interpolation_errors_;  ///< of the drift at each row (rad), where it is interpolated between larger rates
  std::vector<Pair> pairs_;
  /// The walks that the rows come from: one at the rate asked for, or one at each of four larger rates.
  struct Walked {
    Top top;
    LongHorizonPlan<T> plan;
    T epsilon;
  };
  std::vector<Walked> walked_;
};

}  // namespace

DriftTrajectory<double> long_horizon_drift(const DriftProblem<double>& problem, const IntegrationOptions& options,
                                           const Watch& watch) {
  if (reduced_top(problem.model).axis != 2) throw std::logic_error("long_horizon: the top is not symmetric about body axis 3");
  return LongHorizonDrift(problem, options, watch).run();
}

}  // namespace earthtop
