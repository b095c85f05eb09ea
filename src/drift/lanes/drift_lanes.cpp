// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/drift/drift_lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <tuple>
#include <utility>

#include "drift/gimbals/gimbal_drift.hpp"
#include "drift/lanes/drift_kernels.hpp"
#include "drift/lanes/general_drift_kernels.hpp"
#include "drift/lanes/recorded_drift_kernels.hpp"
#include "drift/lanes/spherical_top_drift.hpp"
#include "drift/pivot/compass_drift.hpp"
#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/driven_reduced_drift.hpp"
#include "drift/release_rates.hpp"
#include "drift/watch/step_watcher.hpp"
#include "integrate/lanes/choose_kernel.hpp"
#include "integrate/lanes/lane_program.hpp"
#include "integrate/lanes/schedule.hpp"
#include "integrate/natural_times.hpp"

namespace earthtop {
namespace {

/// Puts in the constants that the kernels of any body's drift read.
template <class Put>
void put_general_constants(const Model<double>& model, const Put& put) {
  using Constants = lanes::GeneralDriftConstants;
  const Mat3<double>&I = model.I_BP_B, &inverse = model.I_BP_B_inverse;
  const bool principal = I.isDiagonal(0.0);
  constexpr std::array<std::pair<int, int>, 3> kBeside{{{0, 1}, {0, 2}, {1, 2}}};
  for (int i = 0; i < 3; ++i) {
    const auto [row, column] = kBeside[static_cast<std::size_t>(i)];
    put(Constants::inertia + i, I(i, i));
    put(Constants::inertia_beside + i, I(row, column));
    put(Constants::inverse_reciprocal + i, principal ? I(i, i) : 1 / inverse(i, i));
    put(Constants::inverse_beside + i, principal ? 0.0 : inverse(row, column));
    put(Constants::mass_moment + i, model.mass_moment_B[i]);
    put(Constants::W_scaled + i, model.W_IL_L_scaled[i]);
  }
  put(Constants::gravity, model.apparent_gravity_L[2]);
  put(Constants::epsilon, model.epsilon);
}

/// The drift of any body in its own axes, with the deviation as seen from the laboratory.
class BodyDrift : public DriftSystem<double, Observer::body, SceneKind::plain, RotatingMotion::composed> {
 public:
  using Base = DriftSystem<double, Observer::body, SceneKind::plain, RotatingMotion::composed>;
  static constexpr int kVariables = lanes::kBodyDriftVariables;
  static_assert(lanes::are_groups_of<Base>(lanes::kBodyDriftGroups));

  explicit BodyDrift(const DriftProblem<double>& problem) : Base(problem.model), problem_(problem) {}
  State initial_state() const { return Base::initial_state(problem_.natural_release()); }
  double largest_step() const { return 0; }
  template <class Put>
  void constants(const Put& put) const {
    put_general_constants(problem_.model, put);
  }

 private:
  const DriftProblem<double>& problem_;
};

/// The drift of any body in its own axes, with the deviation as seen from inertial space.
class InertialBodyDrift {
 public:
  using Outer = DriftSystem<double, Observer::inertial, SceneKind::plain, RotatingMotion::composed>;
  using Shape = InertialBodyDrift;
  static constexpr std::size_t kSize = lanes::kInertialBodyDriftVariables;
  static constexpr int kVariables = lanes::kInertialBodyDriftVariables;
  using State = std::array<double, kSize>;
  using Flow = Outer;
  static constexpr auto groups() {
    constexpr auto body = BodyDrift::Shape::groups();
    return std::array<ComponentGroup, 7>{{body[0], body[1], body[2], body[3], {14, 3, 1e-3}, {17, 3, 1e-3}, {20, 3, 1e-3}}};
  }

  explicit InertialBodyDrift(const DriftProblem<double>& problem) : body_(problem), outer_(problem.model), problem_(problem) {}

  State initial_state() const {
    const BodyDrift::State body = body_.initial_state();
    State x{};
    std::copy(body.begin(), body.end(), x.begin());
    const Mat3<double> R_LB = rotation_matrix(problem_.release.q_LB);
    store_vector(transposed_times(R_LB, problem_.model.W_IL_L_scaled), x, 14);
    store_vector(transposed_times(R_LB, problem_.model.apparent_gravity_L), x, 17);
    return x;
  }
  double largest_step() const { return 0; }
  void follow(const State&) {}
  /// The system that the search for a threshold integrates.
  const Flow& flow() const { return outer_; }
  Flow::State flow_state(const State& x, double) const { return in_outer_axes(x); }
  DriftState<double> shared_state(const State& x, double t) const { return outer_.shared_state(in_outer_axes(x), t); }
  DriftState<double> deviation_state(const State& x, double t) const { return outer_.deviation_state(in_outer_axes(x), t); }
  template <class Put>
  void constants(const Put& put) const {
    put_general_constants(problem_.model, put);
  }

 private:
  /// Reference and deviation in the variables of `inertial_deviation_equation`.
  Outer::State in_outer_axes(const State& x) const {
    const Motion<double> reference = drift_state::load_motion(x, drift_state::kReference);
    const Deviation<double> deviation = drift_state::load_deviation(x);
    const Mat3<double> R_ref = rotation_matrix(reference.q);
    Outer::State outer;
    const Vec3<double> L_N = times(R_ref, times(problem_.model.I_BP_B, reference.m));
    drift_state::store_motion<double>({reference.q, L_N}, outer, drift_state::kReference);
    drift_state::store_deviation<double>({deviation.w, times(R_ref, deviation.y), times(R_ref, deviation.p)}, outer);
    return outer;
  }

  BodyDrift body_;
  Outer outer_;
  const DriftProblem<double>& problem_;
};

static_assert(lanes::are_groups_of<InertialBodyDrift>(lanes::kInertialBodyDriftGroups));

/// A point on its way through a lane. @tparam Drift  the system that it integrates
template <class Drift>
class DriftPoint {
 public:
  using System = Drift;
  using State = typename System::State;
  static constexpr int kVariables = System::kVariables;

  DriftPoint(const DriftProblem<double>& problem, const IntegrationOptions& options, const Watch& watch,
             DriftTrajectory<double>& trajectory)
      : problem_(problem),
        system_(problem),
        watcher_(system_, problem),
        times_(natural_times(problem)),
        drive_(drive_options(problem, options, watch)),
        trajectory_(trajectory) {
    drive_.largest_step = system_.largest_step();
    trajectory_.samples.reserve(problem.times_s.size());
  }

  System& system() { return system_; }
  const std::vector<double>& times() const { return times_; }
  const DriveOptions<double>& drive() const { return drive_; }
  double longest_step() const {
    if constexpr (requires { system_.longest(); }) return system_.longest();
    return HUGE_VAL;
  }
  /// A search for a threshold does not bridge steps. Distances need no angles that are followed.
  double longest_unseen_turn() const {
    if (problem_.threshold_rad || drive_.largest_step > 0) return 0;
    return problem_.sought == DriftSought::rows ? 1 : HUGE_VAL;
  }
  void constants(lanes::Row* rows, std::size_t lane) const {
    system_.constants([&](int row, double value) { rows[row].lane[lane] = value; });
  }
  void on_step(double t, const State& x) { watcher_(t, x); }
  void on_row(std::size_t row, const State& x) {
    trajectory_.samples.push_back(watcher_.seen_sample(x, times_[row], problem_.times_s[row]));
    if (row == 0) set_release_rates(problem_, trajectory_.samples.front().state);
  }
  void finish(RunStatus status, const StepCounters& counters) {
    trajectory_.status = status;
    trajectory_.counters = counters;
    trajectory_.threshold = watcher_.threshold();
  }

 private:
  const DriftProblem<double>& problem_;
  System system_;
  StepWatcher<double, System> watcher_;
  std::vector<double> times_;  ///< of the rows
  DriveOptions<double> drive_;
  DriftTrajectory<double>& trajectory_;
};

template <class Drift>
std::vector<DriftTrajectory<double>> integrate(const lanes::Kernel& kernel, std::span<const DriftProblem<double>> problems,
                                               const IntegrationOptions& options, const Watch& watch) {
  std::vector<DriftTrajectory<double>> trajectories(problems.size());
  const auto arguments = [&](std::size_t i) { return std::tie(problems[i], options, watch, trajectories[i]); };
  lanes::run_in_lanes<DriftPoint<Drift>>(lanes::plan_for(kernel, options.relative_tolerance), problems.size(), arguments);
  return trajectories;
}

/// The drift of any body in any scene, as recorded.   @tparam K  full, or gyrostat
template <Observer O, SceneKind K = SceneKind::full>
class ComposedDrift : public DriftSystem<double, O, K, RotatingMotion::composed> {
 public:
  using Base = DriftSystem<double, O, K, RotatingMotion::composed>;
  static constexpr bool kGyrostat = K == SceneKind::gyrostat;
  static constexpr int kVariables = kGyrostat ? lanes::kGyrostatDriftVariables : lanes::kComposedDriftVariables;
  static_assert(kGyrostat ? lanes::are_groups_of<Base>(lanes::kGyrostatDriftGroups)
                          : lanes::are_groups_of<Base>(lanes::kComposedDriftGroups));

  explicit ComposedDrift(const DriftProblem<double>& problem) : Base(problem.model), problem_(problem) {}
  typename Base::State initial_state() const { return Base::initial_state(problem_.natural_release()); }
  double largest_step() const { return longest_unseen_step(problem_); }
  taylor::Operations<double> record() const { return record_drift<double>(problem_.model, O, initial_state(), 0); }

 private:
  const DriftProblem<double>& problem_;
};

/// A drift without the spin, as recorded: of a symmetric top with torques that do not depend on it, or of a wheel in a gimbal.
template <class Drift, int kVariablesOfIt>
class SpinlessDrift : public Drift {
 public:
  static constexpr int kVariables = kVariablesOfIt;
  explicit SpinlessDrift(const DriftProblem<double>& problem) : Drift(problem.model, problem.natural_release()) {}
  taylor::Operations<double> record() const { return record_spinless<double>(this->equations(), this->initial_state(), 0); }
};
template <Observer O>
using DrivenDrift = SpinlessDrift<DrivenReducedDrift<double, O>, lanes::kDrivenDriftVariables>;
template <Observer O>
using WheelDrift = SpinlessDrift<CompassDrift<double, O>, lanes::kCompassDriftVariables>;
/// The drift of a body in gimbals, as recorded.
template <Observer O>
class SuspensionDrift : public GimbalDrift<double, O> {
 public:
  static constexpr int kVariables = lanes::kGimbalDriftVariables;
  explicit SuspensionDrift(const DriftProblem<double>& problem)
      : GimbalDrift<double, O>(problem.model, problem.release.X), largest_step_(longest_unseen_step(problem)) {}
  double largest_step() const { return largest_step_; }
  taylor::Operations<double> record() const { return record_spinless<double>(this->equations(), this->initial_state(), 0); }

 private:
  double largest_step_;
};
static_assert(lanes::are_groups_of<SuspensionDrift<Observer::laboratory>>(lanes::kGimbalDriftGroups));
static_assert(lanes::are_groups_of<DrivenDrift<Observer::laboratory>>(lanes::kDrivenDriftGroups));
static_assert(lanes::are_groups_of<WheelDrift<Observer::laboratory>>(lanes::kCompassDriftGroups));

/// A point whose right-hand side is recorded as it is at the release. Where it branches otherwise later, the point leaves its lane.
template <class Drift>
class RecordedPoint : public DriftPoint<Drift> {
 public:
  RecordedPoint(const DriftProblem<double>& problem, const IntegrationOptions& options, const Watch& watch,
                DriftTrajectory<double>& trajectory, const lanes::RecordedCode& code, lanes::LaneProgram& program,
                bool& has_left)
      : DriftPoint<Drift>(problem, options, watch, trajectory), code_(code), program_(program), has_left_(has_left) {}

  void constants(lanes::Row*, std::size_t lane) {
    lane_ = lane;
    program_.put(lane, code_);
  }
  void before_step(double t) { program_.set_time(lane_, t); }
  bool leaves() { return has_left_ = program_.is_off_branch(lane_); }

 private:
  const lanes::RecordedCode& code_;
  lanes::LaneProgram& program_;
  bool& has_left_;
  std::size_t lane_ = 0;
};

/// Integrates drifts as recorded. Points with the same code go side by side; those that leave their lane are integrated by themselves.
template <class Drift>
std::vector<DriftTrajectory<double>> integrate_recorded(const lanes::Kernel& kernel, int width,
                                                        std::span<const DriftProblem<double>> problems,
                                                        const IntegrationOptions& options, const Watch& watch) {
  std::vector<DriftTrajectory<double>> trajectories(problems.size());
  std::vector<lanes::RecordedCode> codes;
  codes.reserve(problems.size());
  for (const DriftProblem<double>& problem : problems) codes.emplace_back(Drift(problem).record());
  const auto have_left = std::make_unique<bool[]>(problems.size());
  std::vector<bool> is_done(problems.size());
  for (std::size_t first = 0; first < problems.size(); ++first) {
    if (is_done[first]) continue;
    std::vector<std::size_t> alike;
    for (std::size_t i = first; i < problems.size(); ++i)
      if (!is_done[i] && lanes::have_same_code(codes[first], codes[i])) alike.push_back(i), is_done[i] = true;
    lanes::LaneProgram program(codes[first], width);
    lanes::Plan plan = lanes::plan_for(kernel, options.relative_tolerance);
    plan.code = program.code();
    const auto arguments = [&](std::size_t k) {
      const std::size_t i = alike[k];
      return std::tie(problems[i], options, watch, trajectories[i], codes[i], program, have_left[i]);
    };
    lanes::run_in_lanes<RecordedPoint<Drift>>(plan, alike.size(), arguments);
  }
  for (std::size_t i = 0; i < problems.size(); ++i)
    if (have_left[i]) trajectories[i] = integrate_drift(problems[i], options, watch);
  return trajectories;
}

/// Whether the equations of a problem have to be recorded: no series is written for them.
bool is_recorded(const DriftProblem<double>& problem) { return problem.model.kind != SceneKind::plain; }

template <SceneKind K>
std::vector<DriftTrajectory<double>> integrate_composed(const lanes::Kernel& kernel, int width,
                                                        std::span<const DriftProblem<double>> problems,
                                                        const IntegrationOptions& options, const Watch& watch) {
  if (options.observer == Observer::inertial)
    return integrate_recorded<ComposedDrift<Observer::inertial, K>>(kernel, width, problems, options, watch);
  if (options.observer == Observer::body)
    return integrate_recorded<ComposedDrift<Observer::body, K>>(kernel, width, problems, options, watch);
  if constexpr (K == SceneKind::gyrostat)
    return integrate_recorded<ComposedDrift<Observer::laboratory, K>>(kernel, width, problems, options, watch);
  throw std::logic_error("the general form in lanes has no laboratory axes");
}

std::vector<DriftTrajectory<double>> integrate_recorded(std::span<const DriftProblem<double>> problems,
                                                        const IntegrationOptions& options, const Watch& watch,
                                                        InstructionSet set) {
  const bool is_inertial = options.observer == Observer::inertial;
  const int width = lanes::width_of(set);
  if (problems.front().model.kind == SceneKind::suspension) {
    const lanes::Kernel& kernel = EARTHTOP_CHOOSE_KERNEL(set, lanes::kGimbalDrift);
    return is_inertial ? integrate_recorded<SuspensionDrift<Observer::inertial>>(kernel, width, problems, options, watch)
                       : integrate_recorded<SuspensionDrift<Observer::laboratory>>(kernel, width, problems, options, watch);
  }
  if (options.form == ModelForm::general) {
    if (problems.front().model.kind == SceneKind::gyrostat)
      return integrate_composed<SceneKind::gyrostat>(EARTHTOP_CHOOSE_KERNEL(set, lanes::kGyrostatDrift), width, problems,
                                                     options, watch);
    return integrate_composed<SceneKind::full>(EARTHTOP_CHOOSE_KERNEL(set, lanes::kComposedDrift), width, problems, options,
                                               watch);
  }
  if (options.observer == Observer::body) throw std::logic_error("the reduced form has no body axes");
  if (is_compass(problems.front().model)) {
    const lanes::Kernel& kernel = EARTHTOP_CHOOSE_KERNEL(set, lanes::kCompassDrift);
    return is_inertial ? integrate_recorded<WheelDrift<Observer::inertial>>(kernel, width, problems, options, watch)
                       : integrate_recorded<WheelDrift<Observer::laboratory>>(kernel, width, problems, options, watch);
  }
  const lanes::Kernel& kernel = EARTHTOP_CHOOSE_KERNEL(set, lanes::kDrivenDrift);
  return is_inertial ? integrate_recorded<DrivenDrift<Observer::inertial>>(kernel, width, problems, options, watch)
                     : integrate_recorded<DrivenDrift<Observer::laboratory>>(kernel, width, problems, options, watch);
}

std::vector<DriftTrajectory<double>> integrate_general(std::span<const DriftProblem<double>> problems,
                                                       const IntegrationOptions& options, const Watch& watch,
                                                       InstructionSet set) {
  if (options.observer == Observer::body)
    return integrate<BodyDrift>(EARTHTOP_CHOOSE_KERNEL(set, lanes::kBodyDrift), problems, options, watch);
  if (options.observer == Observer::inertial)
    return integrate<InertialBodyDrift>(EARTHTOP_CHOOSE_KERNEL(set, lanes::kInertialBodyDrift), problems, options, watch);
  throw std::logic_error("the general form in lanes has no laboratory axes");
}

}  // namespace

std::vector<DriftTrajectory<double>> integrate_drift_in_lanes(std::span<const DriftProblem<double>> problems,
                                                              const IntegrationOptions& options, const Watch& watch,
                                                              std::optional<InstructionSet> set) {
  const InstructionSet taken = lanes::available(set);
  if (problems.empty()) return {};
  const auto kind = [](const DriftProblem<double>& problem) {
    return std::pair(problem.model.kind, is_compass(problem.model));
  };
  if (std::ranges::adjacent_find(problems, std::ranges::not_equal_to{}, kind) != problems.end())
    throw std::logic_error("problems side by side must be of one kind");
  if (is_recorded(problems.front())) return integrate_recorded(problems, options, watch, taken);
  if (options.form == ModelForm::general) return integrate_general(problems, options, watch, taken);
  switch (options.observer) {
    case Observer::laboratory:
      return integrate<SphericalTopDrift<Observer::laboratory>>(EARTHTOP_CHOOSE_KERNEL(taken, lanes::kLaboratoryDrift),
                                                                problems, options, watch);
    case Observer::inertial:
      return integrate<SphericalTopDrift<Observer::inertial>>(EARTHTOP_CHOOSE_KERNEL(taken, lanes::kInertialDrift), problems,
                                                              options, watch);
    case Observer::body: break;
  }
  throw std::logic_error("the reduced form has no body axes");
}

}  // namespace earthtop
