// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/odeint_pow.hpp"  // must come first: it redirects std::pow
//
#include "drift/derivatives/jet.hpp"  // must come before the formulas that are compiled for jets
//
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

#include "drift/derivatives/disturbed_motion.hpp"
#include "drift/derivatives/growth_work.hpp"
#include "drift/derivatives/tangent_steps.hpp"
#include "drift/stability.hpp"
#include "earthtop/drift/growth.hpp"

namespace earthtop {
namespace {

constexpr double kRescaled = 1e3;  // a disturbance is brought back to size 1 when it has grown by this
constexpr double kPointSpacing = 0.1;
constexpr double kSignificantEFoldings = 2;  // e-foldings in the second half: an oscillation of the growth may make as many
constexpr double kTurning = 1e-10;           // rad, a step: dry friction turns round with the motion, and disturbances jump

/// Follows the sizes of the disturbances, and brings them back to 1 before they overflow.
template <class System>
class Follower {
 public:
  using State = typename System::State;
  Follower(const System& system, double fastest_rate, State& x) : system_(&system), rate_(fastest_rate) {
    constexpr double kDirections[kDisturbances][6] = {{1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1}, {1, 1, -1, -1, 0, 0}};
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      const double(&c)[6] = kDirections[d];
      system.put({{c[0], c[1], c[2]}, {c[3] * rate_, c[4] * rate_, c[5] * rate_}}, x, d);
    }
    system.restrict(x);
    const auto seen = system.disturbances(x);
    for (std::size_t d = 0; d < kDisturbances; ++d) System::scale(x, d, 1 / size(seen[d]));
  }
  /// The logarithm of the largest growth of the three disturbances.
  double log_growth(const State& x) const {
    double largest = -std::numeric_limits<double>::infinity();
    const auto seen = system_->disturbances(x);
    for (std::size_t d = 0; d < kDisturbances; ++d) largest = std::max(largest, log_scale_[d] + real::log(size(seen[d])));
    return largest;
  }
  /// Brings large disturbances back to size 1.   @returns whether the state was changed
  bool rescale(State& x) {
    bool has_rescaled = false;
    const auto seen = system_->disturbances(x);
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      const double grown = size(seen[d]);
      if (!(grown > kRescaled)) continue;
      log_scale_[d] += real::log(grown);
      System::scale(x, d, 1 / grown);
      has_rescaled = true;
    }
    return has_rescaled;
  }

 private:
  double size(const Disturbance& seen) const { return real::hypot(norm(seen.theta_B), norm(seen.dw_B) / rate_); }

  const System* system_;
  double rate_;
  std::array<double, kDisturbances> log_scale_ = {};
};

enum class Step { taken, rejected, failed };

/// The right-hand side of a motion with its disturbances, from its recorded list.
template <class System>
class RecordedRate {
 public:
  explicit RecordedRate(const System& system) : series_(system.series()) {}
  void operator()(const typename System::State& x, typename System::State& dxdt, double t) {
    typename System::State coefficients[2] = {x};
    series_.start(x, t);
    series_.expand(coefficients, 1);
    dxdt = coefficients[1];
  }

 private:
  typename System::Series series_;
};

/// Steps of Fehlberg's method of order 8: for motions whose series end at corners of friction, and for any body in a plain scene, where
/// steps of low accuracy take less work than series.
template <class System, template <class> class Rate>
class EmbeddedSteps {
 public:
  using State = typename System::State;
  EmbeddedSteps(const System& system, const State&, double tolerance, double first_step, double shortest)
      : rate_(system),
        stepper_(boost::numeric::odeint::make_controlled<Fehlberg>(tolerance, tolerance)),
        dt_(first_step),
        shortest_(shortest) {}
  /// Shows the states at which a motion is looked at: the end of the last step.
  template <class Look>
  void look(const State& x, double t, const Look& look) const {
    look(t, x);
  }
  /// Takes a step, not beyond the end.
  Step take(State& x, double& t, double end, std::int64_t& evaluations) {
    dt_ = std::min(dt_, end - t);
    if (dt_ < std::min(shortest_, end - t)) return Step::failed;
    evaluations += kStages;
    if (stepper_.try_step(std::ref(rate_), x, t, dt_) != boost::numeric::odeint::fail) return Step::taken;
    return t + dt_ > t ? Step::rejected : Step::failed;
  }
  void restart(const State&, double) {}

 private:
  using Fehlberg = boost::numeric::odeint::runge_kutta_fehlberg78<State>;
  static constexpr int kStages = 13;
  Rate<System> rate_;
  typename boost::numeric::odeint::result_of::make_controlled<Fehlberg>::type stepper_;
  double dt_, shortest_;
};

template <class System>
using CornerSteps = EmbeddedSteps<System, RecordedRate>;
template <class System>
using PlainSteps = EmbeddedSteps<System, PlainRate>;

/// Steps of a Taylor series.
template <class System>
class SeriesSteps {
 public:
  using State = typename System::State;
  SeriesSteps(const System& system, const State& x, double tolerance, double, double)
      : looks_(system.has_friction() ? 8 : 4), steps_(system.series(), x, growth_series_tolerance(tolerance)) {}
  /// Shows the motion at some times of the last step, which may be long, and at two of them the whole state.
  template <class Look>
  void look(const State& x, double t, const Look& look) const {
    for (int i = 1; i < looks_; ++i) {
      const double at = t - steps_.last_step() * (looks_ - i) / looks_, share = double(i) / looks_;
      if (2 * i == looks_)
        look(at, steps_.within(share));
      else
        look(at, steps_.template within<System::kMotionSize>(share));
    }
    look(t, x);
  }
  Step take(State& x, double& t, double end, std::int64_t& evaluations) {
    return steps_.take(x, t, end, end / kFewestGrowthSteps, evaluations) ? Step::taken : Step::failed;
  }
  void restart(const State& x, double t) { steps_.restart(x, t); }

 private:
  int looks_;  ///< in a step; friction may bring a top to its critical spin between two of them
  TangentSteps<System> steps_;
};

/// The slope of a line fitted to values over the second half of the duration, each weighted by the length of its step.
class LateSlope {
 public:
  explicit LateSlope(double end) : middle_(0.75 * end), half_(end / 2) {}
  void include(double t, double dt, double value) {
    if (t < half_) return;
    const double x = t - middle_;
    weight_ += dt, x_ += dt * x, xx_ += dt * x * x, y_ += dt * value, xy_ += dt * x * value;
    reached_ = t;
  }
  /// The slope; none where less than half of the second half was reached, 0 where the line changes by less than kSignificantEFoldings.
  std::optional<double> slope() const {
    const double spread = weight_ * xx_ - x_ * x_;
    if (reached_ < middle_ || !(spread > 0)) return std::nullopt;
    const double slope = (weight_ * xy_ - x_ * y_) / spread;
    return std::abs(slope) * half_ < kSignificantEFoldings ? 0 : slope;
  }

 private:
  double middle_, half_, reached_ = 0;
  double weight_ = 0, x_ = 0, xx_ = 0, y_ = 0, xy_ = 0;
};

/// Finds when friction brakes an upright top to its critical spin, by a line through the two steps around that time. A leaning
/// top counts as upright if its nutation has brought it within a tenth of a radian of the vertical during the last period.
class CriticalSpin {
 public:
  explicit CriticalSpin(const Model<double>& model) : model_(&model), sought_(model.applied.friction()) {}
  void include(double t, const Motion<double>& motion) {
    if (!sought_) return;
    const auto top = standing_top(*model_, motion.q, motion.m);
    if (!top) return;
    if (top->lean_rad <= kUpright) upright_at_ = t;
    const double above = top->spin_ratio_squared - 1;
    if (above < 0) {
      sought_ = false;
      if (t - upright_at_ > 2 * real::pi<double>() / top->falling_rate) return;
      passed_ = above_before_ >= 0 ? before_ + (t - before_) * above_before_ / (above_before_ - above) : t;
    }
    above_before_ = above, before_ = t;
  }
  std::optional<double> passed() const { return passed_ < 0 ? std::nullopt : std::optional(passed_); }

 private:
  /// Largest lean (rad). What such a top falls by grows tenfold at least; one that leans further only comes to lean more.
  static constexpr double kUpright = 0.1;

  const Model<double>* model_;
  bool sought_;
  double upright_at_ = -HUGE_VAL, before_ = 0, above_before_ = -1, passed_ = -1;
};

/// How far gravity's direction, as seen from the body, and the rate, in units of w0, have departed from those at release.
class Departure {
 public:
  Departure(const Model<double>& model, const Motion<double>& release, double rate)
      : axis_(symmetry_axis(model.I_BP_B, model.mass_moment_B)), up_L_(model.apparent_gravity_L), rate_(rate) {
    if (norm(up_L_) > 0) up_L_ /= norm(up_L_);
    up_B_ = seen_up(release);
    w_B_ = seen_rate(release);
  }
  double of(const Motion<double>& motion) const {
    return norm(Vec3<double>(seen_up(motion) - up_B_)) + norm(Vec3<double>(seen_rate(motion) - w_B_)) / rate_;
  }

 private:
  Vec3<double> seen_up(const Motion<double>& motion) const {
    return without_turn(transposed_times(rotation_matrix(motion.q), up_L_));
  }
  Vec3<double> seen_rate(const Motion<double>& motion) const { return without_turn(motion.m); }
  /// For a symmetric body: the parts of a vector along and across its axis, which a turn of the body about it does not change.
  Vec3<double> without_turn(const Vec3<double>& v_B) const {
    if (axis_ < 0) return v_B;
    return {real::hypot(v_B[(axis_ + 1) % 3], v_B[(axis_ + 2) % 3]), 0, v_B[axis_]};
  }

  int axis_;
  Vec3<double> up_L_;
  double rate_;
  Vec3<double> up_B_, w_B_;
};

/// The times at which steps end: where the paths of masses have joints, and the end.
class StepEnds {
 public:
  StepEnds(std::vector<double> joints, double end) : ends_(std::move(joints)) {
    std::erase_if(ends_, [end](double joint) { return !(joint > 0 && joint < end); });
    ends_.push_back(end);
    std::ranges::sort(ends_);
  }
  double after(double t) const {
    return *std::ranges::find_if(ends_, [t](double end) { return end > t; });
  }

 private:
  std::vector<double> ends_;
};

/// @param problem  of the motion alone: with a model whose Earth stands still for the non-rotating prediction
template <class Law, template <class> class Steps>
GrowthReport follow(const MotionProblem<double>& problem, double duration_s, double tolerance, const Watch& watch) {
  const Model<double>& model = problem.model;
  const double rate = problem.fastest_rate, end = problem.units.time_from_s(duration_s);
  const auto seconds = [&](double t) { return real::scale(t, problem.units.time_exponent); };

  const NaturalRelease<double> given = problem.natural_release();
  const Motion<double> release{given.q_LB, given.inertial_rate_B(model.W_IL_L)};
  using System = DisturbedMotion<Law>;
  const System system(model, Law(problem, release));
  typename System::State x = system.initial_state();
  Follower<System> follower(system, rate, x);
  const Departure departure(model, release, rate);
  CriticalSpin critical_spin(model);
  critical_spin.include(0, release);
  LateSlope late(end);

  // Dry friction turns round with the motion, and disturbances jump: there no step is long enough.
  const double shortest = model.applied.coulomb != 0 ? kTurning / rate : 0;
  Steps<System> steps(system, x, tolerance, std::min(end, 0.1 / rate), shortest);
  GrowthReport report;
  double t = 0, before = 0;
  std::vector<double> joints = model.masses.joints();
  std::ranges::copy(model.gimbals.masses.joints(), std::back_inserter(joints));
  if (!model.journey.empty()) std::ranges::copy(model.journey.joints(), std::back_inserter(joints));
  if (const auto& table = model.applied.given.table) std::ranges::copy(table->joints(), std::back_inserter(joints));
  const StepEnds ends(std::move(joints), end);
  const WorkLimit limit = problem.pace.known() ? work_limit_for(growth_work(problem, duration_s, tolerance)) : WorkLimit();
  const std::int64_t most = std::min(kMostGrowthSteps, limit.steps);
  std::int64_t count = 0;
  StepCounters& counters = report.counters;
  for (; t < end && count < most; ++count) {
    if (watch.asks_to_stop()) return report;
    if (count % 64 == 0) watch.reach(t / end);
    const Step step = steps.take(x, t, ends.after(t), counters.evaluations);
    if (step == Step::failed) return report;
    if (step == Step::rejected) {
      ++counters.rejected;
      continue;
    }
    ++counters.accepted;
    system.restrict(x);
    double log_growth = 0;
    steps.look(x, t, [&](double at, const auto& state) {
      const Motion<double> motion = system.motion(state);
      critical_spin.include(at, motion);
      if (!report.exponential_s) report.departure = std::max(report.departure, departure.of(motion));
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(state)>, typename System::State>) {
        log_growth = follower.log_growth(state);
        const double log_regular = real::log(1 + rate * at);
        late.include(at, at - before, log_growth - log_regular);
        before = at;
        if (!report.exponential_s && log_growth > real::log(kRegularGrowth) + log_regular) report.exponential_s = seconds(at);
        if (report.rises.empty() || log_growth > report.rises.back().log_growth + kPointSpacing)
          report.rises.push_back({seconds(at), log_growth});
      }
    });
    if (!std::isfinite(log_growth)) return report;
    if (follower.rescale(x)) steps.restart(x, t);
    report.end_s = seconds(t);
    report.mean_exponent_1_s = log_growth / report.end_s;
    if (const auto slope = late.slope()) report.late_exponent_1_s = problem.units.rate_to_rad_s(*slope);
    if (const auto passed = critical_spin.passed()) report.critical_spin_s = seconds(*passed);
  }
  report.completed = count < most;
  return report;
}

/// The problem of one motion: the non-rotating prediction is that on an Earth that stands still.
MotionProblem<double> alone(const MotionProblem<double>& problem, MotionKind kind) {
  MotionProblem<double> made = problem;
  if (kind == MotionKind::reference) made.model = without_earth_rate(problem.model);
  return made;
}

}  // namespace

std::optional<double> GrowthReport::passes_s(double log_growth) const {
  const auto point = std::lower_bound(rises.begin(), rises.end(), log_growth,
                                      [](const GrowthPoint& p, double level) { return p.log_growth < level; });
  if (point == rises.end()) return std::nullopt;
  if (point == rises.begin()) return point->t_s;
  const GrowthPoint& before = *std::prev(point);
  return before.t_s + (point->t_s - before.t_s) * (log_growth - before.log_growth) / (point->log_growth - before.log_growth);
}

GrowthReport disturbance_growth(const MotionProblem<double>& problem, MotionKind kind, double duration_s, double tolerance,
                                const Watch& watch) {
  const MotionProblem<double> one = alone(problem, kind);
  if (one.model.kind == SceneKind::suspension) return follow<SuspensionMotion, SeriesSteps>(one, duration_s, tolerance, watch);
  if (!has_smooth_series(problem, duration_s)) return follow<AnyBodyMotion, CornerSteps>(one, duration_s, tolerance, watch);
  if (is_compass(one.model)) return follow<WheelMotion, SeriesSteps>(one, duration_s, tolerance, watch);
  if (is_reducible_when_driven(one.model)) return follow<SpinlessMotion, SeriesSteps>(one, duration_s, tolerance, watch);
  if (one.model.kind == SceneKind::gyrostat) return follow<GyrostatMotion, SeriesSteps>(one, duration_s, tolerance, watch);
  return one.model.kind == SceneKind::plain ? follow<AnyBodyMotion, PlainSteps>(one, duration_s, tolerance, watch)
                                            : follow<AnyBodyMotion, SeriesSteps>(one, duration_s, tolerance, watch);
}

}  // namespace earthtop
