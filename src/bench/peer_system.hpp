// SPDX-License-Identifier: GPL-3.0-or-later
/// The system that a peer integrates: q_LB (4 variables) and w_IB in body axes (3 variables), in natural units.
#pragma once

#include <array>
#include <functional>

#include "earthtop/bench/peers.hpp"
#include "earthtop/model/equations.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

class PeerSystem {
 public:
  static constexpr std::size_t kSize = 7;
  using State = std::array<double, kSize>;

  PeerSystem(const MotionProblem<double>& problem, const Watch& watch) : problem_(problem), watch_(watch) {}

  State initial_state() const {
    const NaturalRelease<double> release = problem_.natural_release();
    const Vec3<double> w_IB_B = release.inertial_rate_B(problem_.model.W_IL_L);
    return {release.q_LB.w, release.q_LB.v[0], release.q_LB.v[1], release.q_LB.v[2], w_IB_B[0], w_IB_B[1], w_IB_B[2]};
  }

  /// @returns false if the integration is to stop
  bool rates(const double* x, double* dxdt) {
    ++evaluations_;
    const Motion<double> motion = load(x);
    const Motion<double> rate =
        body_equation<true, SceneKind::plain>(problem_.model, motion, problem_.model.apparent_gravity_L);
    dxdt[0] = rate.q.w;
    for (int i = 0; i < 3; ++i) dxdt[1 + i] = rate.q.v[i], dxdt[4 + i] = rate.m[i];
    return !is_stopped();
  }
  bool is_stopped() const { return watch_.asks_to_stop(); }
  std::int64_t evaluations() const { return evaluations_; }

  MotionSample<double> sample(const double* x, double t_s) const {
    const Motion<double> motion = load(x);
    MotionSample<double> sample{t_s, motion.q, motion.m};
    sample.w_LB_B -= transposed_times(rotation_matrix(motion.q), problem_.model.W_IL_L);
    for (int i = 0; i < 3; ++i) sample.w_LB_B[i] = problem_.units.rate_to_rad_s(sample.w_LB_B[i]);
    return sample;
  }

  /// Computes the trajectory from one output time to the next.
  /// @param advance  integrates the state from one time to another (natural units) and returns how that ended
  MotionTrajectory<double> trajectory(State& x, const std::function<RunStatus(double from, double to)>& advance) {
    MotionTrajectory<double> trajectory;
    trajectory.samples.push_back(sample(x.data(), problem_.times_s.front()));
    for (std::size_t i = 1; i < problem_.times_s.size(); ++i) {
      const double from = problem_.units.time_from_s(problem_.times_s[i - 1]),
                   to = problem_.units.time_from_s(problem_.times_s[i]);
      trajectory.status = advance(from, to);
      if (trajectory.status != RunStatus::completed) break;
      trajectory.samples.push_back(sample(x.data(), problem_.times_s[i]));
    }
    trajectory.counters.evaluations = evaluations_;
    return trajectory;
  }

  /// The first step size to be tried (natural units): a small part of a radian of the fastest motion.
  double first_step() const { return 1e-3 / problem_.fastest_rate; }

 private:
  static Motion<double> load(const double* x) { return {{x[0], {x[1], x[2], x[3]}}, {x[4], x[5], x[6]}}; }

  const MotionProblem<double>& problem_;
  Watch watch_;
  std::int64_t evaluations_ = 0;
};

MotionTrajectory<double> integrate_with_gsl_rk8pd(const MotionProblem<double>& problem, double tolerance, const Watch& watch);
MotionTrajectory<double> integrate_with_gsl_msadams(const MotionProblem<double>& problem, double tolerance, const Watch& watch);
MotionTrajectory<double> integrate_with_cvode(const MotionProblem<double>& problem, double tolerance, const Watch& watch);
MotionTrajectory<double> integrate_with_arkode(const MotionProblem<double>& problem, double tolerance, const Watch& watch);
std::string sundials_version();

}  // namespace earthtop
