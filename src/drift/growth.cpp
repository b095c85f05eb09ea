// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/odeint_pow.hpp"  // must come first: it redirects std::pow
//
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>

#include "drift/stability.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/equations.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kDisturbances = 3, kMotionSize = 7, kSize = kMotionSize + 6 * kDisturbances;
using State = std::array<double, kSize>;  // q, w, then theta and dw of each disturbance

constexpr double kRegular = 100;   // how much faster than 1 + w0 t a regular motion lets a disturbance grow, at most
constexpr double kRescaled = 1e3;  // a disturbance is brought back to size 1 when it has grown by this
constexpr double kPointSpacing = 0.1;
constexpr double kSignificantEFoldings = 2;  // e-foldings in the second half: an oscillation of the growth may make as many
constexpr int kStages = 13;                  // of Fehlberg's method of order 8
constexpr double kTurning = 1e-10;           // rad, a step: dry friction turns round with the motion, and disturbances jump

Vec3<double> vector_at(const State& x, std::size_t i) { return {x[i], x[i + 1], x[i + 2]}; }
void put(const Vec3<double>& v, State& x, std::size_t i) {
  for (std::size_t k = 0; k < 3; ++k) x[i + k] = v[static_cast<int>(k)];
}
Motion<double> motion_in(const State& x) { return {{x[0], vector_at(x, 1)}, vector_at(x, 4)}; }
void put(const Motion<double>& motion, State& x) {
  x[0] = motion.q.w;
  put(motion.q.v, x, 1);
  put(motion.m, x, 4);
}

/// The right-hand side of the motion and of the variational equations of its disturbances.
template <bool kEarth, SceneKind K>
struct Variations {
  const Model<double>* model;

  void operator()(const State& x, State& dxdt, double t) const {
    const Motion<double> motion = motion_in(x);
    const PivotField<double> field = pivot_field<K>(*model, t);
    const Vec3<double>& field_L = kEarth ? field.rotating_L : field.reference_L;
    Motion<double> rate = body_equation<kEarth, K>(*model, motion, field_L);
    const Vec3<double>& w = motion.m;
    const bool applied = K == SceneKind::full && model->applied.any;
    const Vec3<double> w_LB_B = kEarth ? Vec3<double>(w - transposed_times(rotation_matrix(motion.q), model->W_IL_L)) : w;
    if (applied) rate.m += times(model->I_BP_B_inverse, applied_torque_B(*model, t, motion.q, w_LB_B, kEarth));
    put(rate, dxdt);
    const Vec3<double> L_B = times(model->I_BP_B, w), field_B = transposed_times(rotation_matrix(motion.q), field_L);
    for (std::size_t i = kMotionSize; i < kSize; i += 6) {
      const Vec3<double> theta = vector_at(x, i), dw = vector_at(x, i + 3);
      put(Vec3<double>(theta.cross(w) + dw), dxdt, i);
      Vec3<double> torque_B = times(model->I_BP_B, dw).cross(w) + L_B.cross(dw) +
                              field_torque(model->mass_moment_B, Vec3<double>(field_B.cross(theta)));
      if (applied) torque_B += applied_torque_change_B(*model, t, motion.q, w_LB_B, kEarth, theta, dw);
      put(times(model->I_BP_B_inverse, torque_B), dxdt, i + 3);
    }
  }
};

/// Restricts disturbances to those that a gimbal allows. The gimbal keeps u.e3 = 0 and therefore w_LB.h = 0, with h = u x e3
/// and u = Up as seen from the body. A disturbance that keeps both has theta.h = 0 and d(w_LB).h = -w_LB.dh, with
/// dh = (u x theta) x e3 and d(w_LB) = dw - (R^T W) x theta. Any departure from that is taken away along h.
template <bool kEarth>
class GimbalFreedom {
 public:
  GimbalFreedom(const Model<double>& model, const Motion<double>& motion)
      : w_LB_B_(motion.m), W_B_(Vec3<double>::Zero()), up_B_(Vec3<double>(rotation_matrix(motion.q).row(2).transpose())) {
    if constexpr (kEarth) W_B_ = transposed_times(rotation_matrix(motion.q), model.W_IL_L);
    w_LB_B_ -= W_B_;
    h_ = up_B_.cross(Vec3<double>::UnitZ());
    h_square_ = h_.dot(h_);
  }
  void restrict(Vec3<double>& theta, Vec3<double>& dw) const {
    theta -= (theta.dot(h_) / h_square_) * h_;
    const Vec3<double> dh = Vec3<double>(up_B_.cross(theta)).cross(Vec3<double>::UnitZ());
    const Vec3<double> dw_LB = dw - W_B_.cross(theta);
    dw -= ((dw_LB.dot(h_) + w_LB_B_.dot(dh)) / h_square_) * h_;
  }

 private:
  Vec3<double> w_LB_B_, W_B_, up_B_, h_;
  double h_square_ = 0;
};

/// Follows the sizes of the disturbances, and brings them back to 1 before they overflow.
template <bool kEarth>
class Follower {
 public:
  Follower(const Model<double>& model, double fastest_rate, State& x) : model_(&model), rate_(fastest_rate) {
    constexpr double kDirections[kDisturbances][6] = {{1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1}, {1, 1, -1, -1, 0, 0}};
    for (std::size_t d = 0; d < kDisturbances; ++d)
      for (std::size_t k = 0; k < 6; ++k) x[kMotionSize + 6 * d + k] = kDirections[d][k] * (k < 3 ? 1 : rate_);
    restrict(x);
    for (std::size_t d = 0; d < kDisturbances; ++d) scale(x, d, 1 / size(x, d));
  }
  /// Takes in the state after a step. @returns the logarithm of the largest growth of the three disturbances
  double include(State& x) {
    restrict(x);
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      const double grown = size(x, d);
      largest = std::max(largest, log_scale_[d] + real::log(grown));
      if (!(grown > kRescaled)) continue;
      log_scale_[d] += real::log(grown);
      scale(x, d, 1 / grown);
    }
    return largest;
  }

 private:
  void restrict(State& x) const {
    if (!model_->applied.level_axis) return;
    const GimbalFreedom<kEarth> freedom(*model_, motion_in(x));
    for (std::size_t i = kMotionSize; i < kSize; i += 6) {
      Vec3<double> theta = vector_at(x, i), dw = vector_at(x, i + 3);
      freedom.restrict(theta, dw);
      put(theta, x, i);
      put(dw, x, i + 3);
    }
  }
  double size(const State& x, std::size_t d) const {
    const std::size_t at = kMotionSize + 6 * d;
    return real::hypot(norm(vector_at(x, at)), norm(vector_at(x, at + 3)) / rate_);
  }
  static void scale(State& x, std::size_t d, double factor) {
    for (std::size_t k = 0; k < 6; ++k) x[kMotionSize + 6 * d + k] *= factor;
  }

  const Model<double>* model_;
  double rate_;
  std::array<double, kDisturbances> log_scale_ = {};
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
/// top counts as upright if its nutation has brought it within 0.2 rad of the vertical during the last period.
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
  static constexpr double kUpright = 0.2;  // largest lean (rad); a top that leans so far has a critical spin 1 percent lower

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

template <bool kEarth, SceneKind K>
GrowthReport follow(const MotionProblem<double>& problem, double duration_s, double tolerance, const Watch& watch) {
  const Model<double>& model = problem.model;
  const double rate = problem.fastest_rate, end = problem.units.time_from_s(duration_s);
  const auto seconds = [&](double t) { return real::scale(t, problem.units.time_exponent); };

  Motion<double> release{problem.release.q_LB, problem.units.rate_from_rad_s(problem.release.w_XB_B)};
  if (kEarth && problem.release.X == RatesRelativeTo::laboratory)
    release.m += transposed_times(rotation_matrix(release.q), model.W_IL_L);
  State x;
  put(release, x);
  Follower<kEarth> follower(model, rate, x);
  const Departure departure(model, release, rate);
  CriticalSpin critical_spin(model);
  critical_spin.include(0, release);
  LateSlope late(end);

  namespace odeint = boost::numeric::odeint;
  auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(tolerance, tolerance);
  GrowthReport report;
  double t = 0, dt = std::min(end, 0.1 / rate);
  const WorkLimit limit = variational_limit(problem, duration_s, tolerance);
  const std::int64_t most = std::min(kMostGrowthSteps, limit.steps);
  std::int64_t steps = 0;
  StepCounters& counters = report.counters;
  for (; t < end && steps < most; ++steps) {
    if (watch.asks_to_stop()) return report;
    if (steps % 64 == 0) watch.reach(t / end);
    dt = std::min(dt, end - t);
    if (model.applied.coulomb != 0 && dt < std::min(kTurning / rate, end - t)) return report;
    const double before = t;
    counters.evaluations += kStages;
    if (stepper.try_step(Variations<kEarth, K>{&model}, x, t, dt) == odeint::fail) {
      ++counters.rejected;
      if (!(t + dt > t)) return report;
      continue;
    }
    ++counters.accepted;
    const double log_growth = follower.include(x);
    if (!std::isfinite(log_growth)) return report;
    const Motion<double> motion = motion_in(x);
    const double log_regular = real::log(1 + rate * t);
    critical_spin.include(t, motion);
    late.include(t, t - before, log_growth - log_regular);
    report.end_s = seconds(t);
    report.mean_exponent_1_s = log_growth / report.end_s;
    if (const auto slope = late.slope()) report.late_exponent_1_s = problem.units.rate_to_rad_s(*slope);
    if (const auto passed = critical_spin.passed()) report.critical_spin_s = seconds(*passed);
    if (!report.exponential_s) report.departure = std::max(report.departure, departure.of(motion));
    if (!report.exponential_s && log_growth > real::log(kRegular) + log_regular) report.exponential_s = report.end_s;
    if (report.rises.empty() || log_growth > report.rises.back().log_growth + kPointSpacing)
      report.rises.push_back({report.end_s, log_growth});
  }
  report.completed = steps < most;
  return report;
}

template <SceneKind K>
GrowthReport follow(const MotionProblem<double>& problem, MotionKind kind, double duration_s, double tolerance,
                    const Watch& watch) {
  return kind == MotionKind::rotating ? follow<true, K>(problem, duration_s, tolerance, watch)
                                      : follow<false, K>(problem, duration_s, tolerance, watch);
}

}  // namespace

std::optional<double> GrowthReport::passes_s(double log_growth) const {
  const auto point = std::lower_bound(rises.begin(), rises.end(), log_growth,
                                      [](const GrowthPoint& p, double level) { return p.log_growth < level; });
  return point == rises.end() ? std::nullopt : std::optional(point->t_s);
}

GrowthReport disturbance_growth(const MotionProblem<double>& problem, MotionKind kind, double duration_s, double tolerance,
                                const Watch& watch) {
  return problem.model.kind == SceneKind::plain ? follow<SceneKind::plain>(problem, kind, duration_s, tolerance, watch)
                                                : follow<SceneKind::full>(problem, kind, duration_s, tolerance, watch);
}

}  // namespace earthtop
