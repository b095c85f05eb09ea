#include "integrate/odeint_pow.hpp"  // first: it gives a name of the C library another meaning
//
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>

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
constexpr long kStepLimit = 50'000'000;
constexpr double kTurning = 1e-10;  // rad, a step: dry friction turns round with the motion, and disturbances jump

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

/// Sizes of the disturbances, brought back to 1 before they overflow.
class Follower {
 public:
  explicit Follower(double fastest_rate) : rate_(fastest_rate) {}

  static void start(State& x, double rate) {
    constexpr double kDirections[kDisturbances][6] = {{1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1}, {1, 1, -1, -1, 0, 0}};
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      double square = 0;
      for (const double c : kDirections[d]) square += c * c;
      for (std::size_t k = 0; k < 6; ++k)
        x[kMotionSize + 6 * d + k] = kDirections[d][k] / std::sqrt(square) * (k < 3 ? 1 : rate);
    }
  }
  /// @returns the logarithm of the largest growth of the three
  double include(State& x) {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < kDisturbances; ++d) {
      const std::size_t at = kMotionSize + 6 * d;
      const double size = real::hypot(norm(vector_at(x, at)), norm(vector_at(x, at + 3)) / rate_);
      largest = std::max(largest, log_scale_[d] + real::log(size));
      if (!(size > kRescaled)) continue;
      log_scale_[d] += real::log(size);
      for (std::size_t k = 0; k < 6; ++k) x[at + k] /= size;
    }
    return largest;
  }

 private:
  double rate_;
  std::array<double, kDisturbances> log_scale_ = {};
};

/// Gravity's direction in the body and the rate in units of w0, as they were at release: how far they have gone.
class Departure {
 public:
  Departure(const Model<double>& model, const Motion<double>& release, double rate)
      : up_L_(model.apparent_gravity_L), rate_(rate), up_B_(seen(release)), w_B_(release.m) {
    if (norm(up_L_) > 0) up_L_ /= norm(up_L_);
    up_B_ = seen(release);
  }
  double of(const Motion<double>& motion) const {
    return norm(Vec3<double>(seen(motion) - up_B_)) + norm(Vec3<double>(motion.m - w_B_)) / rate_;
  }

 private:
  Vec3<double> seen(const Motion<double>& motion) const { return transposed_times(rotation_matrix(motion.q), up_L_); }

  Vec3<double> up_L_;
  double rate_;
  Vec3<double> up_B_, w_B_;
};

template <bool kEarth, SceneKind K>
GrowthReport follow(const MotionProblem<double>& problem, double duration_s, double tolerance, const std::atomic<bool>* stop) {
  const Model<double>& model = problem.model;
  const double rate = problem.fastest_rate, end = problem.units.time_from_s(duration_s);
  const auto seconds = [&](double t) { return real::scale(t, problem.units.time_exponent); };

  Motion<double> release{problem.release.q_LB, problem.units.rate_from_rad_s(problem.release.w_XB_B)};
  if (kEarth && problem.release.X == RatesRelativeTo::laboratory)
    release.m += transposed_times(rotation_matrix(release.q), model.W_IL_L);
  State x;
  put(release, x);
  Follower::start(x, rate);
  Follower follower(rate);
  const Departure departure(model, release, rate);

  namespace odeint = boost::numeric::odeint;
  auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(tolerance, tolerance);
  GrowthReport report;
  double t = 0, dt = std::min(end, 0.1 / rate);
  long steps = 0;
  for (; t < end && steps < kStepLimit; ++steps) {
    if (stop != nullptr && *stop) return report;
    dt = std::min(dt, end - t);
    if (model.applied.coulomb != 0 && dt < std::min(kTurning / rate, end - t)) return report;
    if (stepper.try_step(Variations<kEarth, K>{&model}, x, t, dt) == odeint::fail) {
      if (!(t + dt > t)) return report;
      continue;
    }
    const double log_growth = follower.include(x);
    if (!std::isfinite(log_growth)) return report;
    report.end_s = seconds(t);
    report.exponent_1_s = log_growth / report.end_s;
    if (!report.exponential_s) report.departure = std::max(report.departure, departure.of(motion_in(x)));
    if (!report.exponential_s && log_growth > real::log(kRegular * (1 + rate * t))) report.exponential_s = report.end_s;
    if (report.rises.empty() || log_growth > report.rises.back().log_growth + kPointSpacing)
      report.rises.push_back({report.end_s, log_growth});
  }
  report.completed = steps < kStepLimit;
  return report;
}

template <SceneKind K>
GrowthReport follow(const MotionProblem<double>& problem, MotionKind kind, double duration_s, double tolerance,
                    const std::atomic<bool>* stop) {
  return kind == MotionKind::rotating ? follow<true, K>(problem, duration_s, tolerance, stop)
                                      : follow<false, K>(problem, duration_s, tolerance, stop);
}

}  // namespace

std::optional<double> GrowthReport::passes_s(double log_growth) const {
  const auto point = std::lower_bound(rises.begin(), rises.end(), log_growth,
                                      [](const GrowthPoint& p, double level) { return p.log_growth < level; });
  return point == rises.end() ? std::nullopt : std::optional(point->t_s);
}

GrowthReport disturbance_growth(const MotionProblem<double>& problem, MotionKind kind, double duration_s, double tolerance,
                                const std::atomic<bool>* stop) {
  return problem.model.kind == SceneKind::plain ? follow<SceneKind::plain>(problem, kind, duration_s, tolerance, stop)
                                                : follow<SceneKind::full>(problem, kind, duration_s, tolerance, stop);
}

}  // namespace earthtop
