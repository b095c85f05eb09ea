// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/integrate/motion_lanes.hpp"

#include <cmath>
#include <tuple>

#include "integrate/lanes/choose_kernel.hpp"
#include "integrate/lanes/motion_kernels.hpp"
#include "integrate/lanes/schedule.hpp"
#include "integrate/motion_system.hpp"

namespace earthtop {
namespace {

template <MotionSought S>
class MotionPoint {
 public:
  using System = ReducedMotionSystem<double, Observer::laboratory, S>;
  using State = typename System::State;
  static constexpr int kVariables = System::kSize;
  static_assert(lanes::are_groups_of<System>(lanes::kMotionGroups));

  MotionPoint(const MotionProblem<double>& problem, const IntegrationOptions& options, const Watch& watch,
              MotionTrajectory<double>& trajectory)
      : problem_(problem),
        system_(problem),
        times_(natural_times(problem)),
        drive_(drive_options(problem, options, watch)),
        trajectory_(trajectory) {
    trajectory_.samples.reserve(times_.size());
  }

  System& system() { return system_; }
  const std::vector<double>& times() const { return times_; }
  const DriveOptions<double>& drive() const { return drive_; }
  double longest_step() const { return HUGE_VAL; }
  double longest_unseen_turn() const { return 0; }
  void constants(lanes::Row* rows, std::size_t lane) const {
    const auto put = [&](int row, double value) { rows[row].lane[lane] = value; };
    using Constants = lanes::MotionConstants;
    put(Constants::b, system_.nutation_rate().value);
    put(Constants::b_rest, system_.nutation_rate().rest);
    put(Constants::moment_ratio, system_.top().moment_ratio);
    put(Constants::gravity, problem_.model.apparent_gravity_L[2]);
    for (int i = 0; i < 3; ++i) put(Constants::W + i, problem_.model.W_IL_L[i]);
  }
  void on_step(double, const State& x) { system_.follow(x); }
  void on_row(std::size_t row, const State& x) {
    system_.follow(x);
    trajectory_.samples.push_back(sample_at(system_, problem_, x, times_[row], problem_.times_s[row]));
  }
  void finish(RunStatus status, const StepCounters& counters) {
    trajectory_.status = status;
    trajectory_.counters = counters;
  }

 private:
  const MotionProblem<double>& problem_;
  System system_;
  std::vector<double> times_;
  DriveOptions<double> drive_;
  MotionTrajectory<double>& trajectory_;
};

template <MotionSought S>
std::vector<MotionTrajectory<double>> integrate(const lanes::Kernel& kernel, std::span<const MotionProblem<double>> problems,
                                                const IntegrationOptions& options, const Watch& watch) {
  std::vector<MotionTrajectory<double>> trajectories(problems.size());
  const auto arguments = [&](std::size_t i) { return std::tie(problems[i], options, watch, trajectories[i]); };
  lanes::run_in_lanes<MotionPoint<S>>(lanes::plan_for(kernel, options.relative_tolerance), problems.size(), arguments);
  return trajectories;
}

}  // namespace

std::vector<MotionTrajectory<double>> integrate_motion_in_lanes(std::span<const MotionProblem<double>> problems,
                                                                const IntegrationOptions& options, MotionSought sought,
                                                                const Watch& watch, std::optional<InstructionSet> set) {
  const InstructionSet taken = lanes::available(set);
  if (sought == MotionSought::symmetry_axis)
    return integrate<MotionSought::symmetry_axis>(EARTHTOP_CHOOSE_KERNEL(taken, lanes::kAxisMotion), problems, options, watch);
  return integrate<MotionSought::attitude>(EARTHTOP_CHOOSE_KERNEL(taken, lanes::kAttitudeMotion), problems, options, watch);
}

}  // namespace earthtop
