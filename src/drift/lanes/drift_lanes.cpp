#include "earthtop/drift/drift_lanes.hpp"

#include <tuple>

#include "drift/lanes/drift_kernels.hpp"
#include "drift/reduced_drift_system.hpp"
#include "drift/release_rates.hpp"
#include "drift/step_watcher.hpp"
#include "integrate/lanes/choose_kernel.hpp"
#include "integrate/lanes/schedule.hpp"

namespace earthtop {
namespace {

template <Observer O>
class DriftPoint {
 public:
  using System = ReducedDriftSystem<double, O>;
  using State = typename System::State;
  static constexpr int kVariables =
      O == Observer::laboratory ? lanes::kLaboratoryDriftVariables : lanes::kInertialDriftVariables;
  static_assert(lanes::are_groups_of<System>(lanes::kDriftGroups));

  DriftPoint(const DriftProblem<double>& problem, const IntegrationOptions& options, const std::atomic<bool>* stop,
             DriftTrajectory<double>& trajectory)
      : problem_(problem),
        system_(problem.model, problem.release, problem.units),
        watcher_(system_, problem.units, problem.threshold_rad),
        times_(natural_times(problem)),
        drive_(drive_options(problem, options, stop)),
        trajectory_(trajectory) {
    drive_.largest_step = system_.largest_step();
    trajectory_.samples.reserve(times_.size());
  }

  System& system() { return system_; }
  const std::vector<double>& times() const { return times_; }
  const DriveOptions<double>& drive() const { return drive_; }
  void constants(lanes::Row* rows, std::size_t lane) const {
    const auto put = [&](int row, double value) { rows[row].lane[lane] = value; };
    using Constants = lanes::DriftConstants;
    const ReducedDriftConstants<double>& constants = system_.constants();
    put(Constants::b, constants.b.value);
    put(Constants::b_rest, constants.b.rest);
    put(Constants::k, constants.k);
    put(Constants::of_axis_rate, constants.of_axis_rate);
    put(Constants::of_cross, constants.of_cross);
    put(Constants::moment_ratio, system_.top().moment_ratio);
    put(Constants::gravity, problem_.model.apparent_gravity_L[2]);
    put(Constants::epsilon, problem_.model.epsilon);
    for (int i = 0; i < 3; ++i) put(Constants::W_scaled + i, problem_.model.W_IL_L_scaled[i]);
  }
  void on_step(double t, const State& x) { watcher_(t, x); }
  void on_row(std::size_t row, const State& x) {
    trajectory_.samples.push_back(watcher_.sample(x, times_[row], problem_.times_s[row]));
    if (row == 0) set_release_rates(problem_, trajectory_.samples.front().state);
  }
  void finish(RunStatus status, const StepCounters& counters) {
    trajectory_.status = status;
    trajectory_.counters = counters;
    trajectory_.threshold_time_s = watcher_.threshold_time_s();
  }

 private:
  const DriftProblem<double>& problem_;
  System system_;
  StepWatcher<double, System> watcher_;
  std::vector<double> times_;
  DriveOptions<double> drive_;
  DriftTrajectory<double>& trajectory_;
};

template <Observer O>
std::vector<DriftTrajectory<double>> integrate(const lanes::Kernel& kernel, std::span<const DriftProblem<double>> problems,
                                               const IntegrationOptions& options, const std::atomic<bool>* stop) {
  std::vector<DriftTrajectory<double>> trajectories(problems.size());
  const auto arguments = [&](std::size_t i) { return std::tie(problems[i], options, stop, trajectories[i]); };
  lanes::run_in_lanes<DriftPoint<O>>(lanes::plan_for(kernel, options.relative_tolerance), problems.size(), arguments);
  return trajectories;
}

}  // namespace

std::vector<DriftTrajectory<double>> integrate_drift_in_lanes(std::span<const DriftProblem<double>> problems,
                                                              const IntegrationOptions& options, const std::atomic<bool>* stop,
                                                              std::optional<InstructionSet> set) {
  const InstructionSet taken = lanes::set_taken(set);
  switch (options.observer) {
    case Observer::laboratory:
      return integrate<Observer::laboratory>(EARTHTOP_CHOOSE_KERNEL(taken, lanes::kLaboratoryDrift), problems, options, stop);
    case Observer::inertial:
      return integrate<Observer::inertial>(EARTHTOP_CHOOSE_KERNEL(taken, lanes::kInertialDrift), problems, options, stop);
    case Observer::body: break;
  }
  throw std::logic_error("the reduced form has no body axes");
}

}  // namespace earthtop
