// SPDX-License-Identifier: GPL-3.0-or-later
/// The main job: both predictions of a scenario, their drift, and the bound on its error.
#pragma once

#include <string>
#include <vector>

#include "earthtop/budget/budget.hpp"
#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/stop_event.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// One of the two integrations behind a run.
struct IntegrationReport {
  Observer observer = Observer::laboratory;
  ModelForm form = ModelForm::general;  ///< the one taken
  Method method = Method::rkf78;
  std::string reason;  ///< why this method
  RunStatus status = RunStatus::completed;
  std::string precision = "double";
  double relative_tolerance = 0;  ///< 0 of a closed form
  std::optional<double> step_s;   ///< fixed-step methods: the step taken
  StepCounters counters;
  double seconds = 0;  ///< wall time
};

/// A quantity that the exact motion conserves, and how far the computed one moved.
struct InvariantReport {
  std::string name;  ///< e.g. "jacobi_integral"
  std::string unit;
  double initial = 0;
  double largest_change = 0;
  double scale = 0;  ///< size of its largest term: largest_change / scale is the relative change
};

/// A first-order prediction beside the computed number.
struct TheoryReport {
  std::string name;       ///< e.g. "precession_rate_change"
  std::string statement;  ///< the formula in words
  std::string unit;
  double predicted = 0;
  double computed = 0;
};

/// The torques on the rotating motion, as the scenario's observer counts them.
struct LedgerReport {
  LedgerObserver observer = LedgerObserver::laboratory;
  std::vector<LedgerRow<double>> entries;             ///< one for each row
  std::vector<LedgerRow<float128>> extended_entries;  ///< the same in full; none in double precision
  LedgerLargest largest;
};

/// A judgement on a computed drift: whether its value can be trusted.
enum class Verdict {
  reliable,     ///< the error is within its bound
  noise_floor,  ///< the drift is not above its error bound
  unstable,     ///< disturbances grow exponentially along this one motion
  chaotic,      ///< they do wherever the motion goes: what Earth rotation does cannot be told from any other disturbance
  marginal,     ///< at a limit of stability: the motion's character hangs on digits that no experiment knows
  unassessed    ///< nothing is known of it: no row beyond the release, or the run was interrupted before
};
std::string_view to_string(Verdict verdict);

struct VerdictReport {
  Verdict verdict = Verdict::reliable;
  /// From here on the drift is no longer to be trusted; none where it is to the end of the run.
  std::optional<double> from_s;
  double reliable_until_s = 0;  ///< `from_s`, or the end of the run
  std::string reason;
  /// Finite-time Lyapunov exponent of late times, the larger one of the two motions' (1/s; GrowthReport); none where closed
  /// forms say that nothing grows exponentially, or where it could not be followed.
  std::optional<double> lyapunov_exponent_1_s;
  std::optional<double> round_off_grown_s;  ///< when rounding has grown to a microradian, exponentially
  /// When the Earth's own disturbance has grown to 0.1 rad, exponentially; none where the Earth turns by as much itself by
  /// then, so that its effect is meant to be large.
  std::optional<double> earth_grown_s;
};

/// How the last reliable drift changes with one input (rad per unit of the input), and what the input's error makes of it.
struct InputSensitivity {
  std::string_view name;  ///< one of kInputNames
  double value = 0;       ///< of the input
  double axis_rad = 0, attitude_rad = 0, tilt_rad = 0;
  std::optional<double> azimuth_rad;  ///< none where an axis is vertical
  double axis_error_rad = 0;          ///< standard error of the axis drift from this input; 0 where none is given
};
struct SensitivityReport {
  double at_s = 0;
  std::vector<InputSensitivity> inputs;  ///< in the order of kInputNames; none where they could not be had
  std::string unavailable;               ///< why there are none; empty where there are
  double axis_error_rad = 0;             ///< standard error of the axis drift from all inputs, taken as independent
};

/// Whether the error asked for was reached, bound and effects left out taken together.
struct AccuracyReport {
  double asked_rad = 0;
  double reached_rad = 0;
  int attempts = 0;  ///< runs it took to find a tolerance
  bool reached() const { return reached_rad <= asked_rad; }
};

struct RunResult {
  // Compiled once, not in every source that holds one.
  RunResult();
  RunResult(const RunResult&);
  RunResult(RunResult&&) noexcept;
  RunResult& operator=(const RunResult&);
  RunResult& operator=(RunResult&&) noexcept;
  ~RunResult();

  Scene scene;                             ///< as given
  Scene modelled;                          ///< the same with the effects and the tolerance that were chosen for it
  std::optional<Selection> selection;      ///< where the scenario leaves the choice of effects open
  std::optional<AccuracyReport> accuracy;  ///< where it asks for one
  RunStatus status = RunStatus::completed;
  double reached_s = 0;  ///< time of the last row, or of an interrupted solution
  /// For an interrupted run: whether the solution had reached its end, so that only later work (error bounds, verdict) was cut
  /// short.
  bool solution_is_whole = false;
  std::vector<DriftRow> rows;
  std::vector<ExtendedDriftRow> extended_rows;  ///< the same rows in full; none in double precision
  DriftSummary drift;
  VerdictReport verdict;
  std::vector<StopEvent> stops;   ///< when dry friction brought which motion to rest
  IntegrationReport solution;     ///< the rows come from this one
  IntegrationReport certificate;  ///< the bounds come from comparing with this one
  double attitude_bound_rad = 0;  ///< of q_LB and ref_q_LB themselves, largest of all rows
  std::vector<InvariantReport> invariants;
  std::vector<TheoryReport> theory;
  std::optional<SensitivityReport> sensitivities;  ///< where the scenario asks for them
  std::optional<LedgerReport> ledger;              ///< where the scenario asks for one
  std::vector<std::string> notes;                  ///< e.g. that a scene is non-physical
};

/// Whether there is a row beyond the release: without one nothing is known of the drift.
bool has_drift(const RunResult& result);

/// Which integration took more steps than it may; empty where none did.
std::string why_limited(const RunResult& result);
/// Whether that was more than the work estimated of it allows, and not the limit that every run has.
bool stopped_beyond_estimate(const RunResult& result);

/// The last row before the verdict's time; null where there is none.
const DriftRow* last_reliable_row(const RunResult& result);

struct RunOptions {
  Watch watch;  ///< may stop the run, and sees how far it is
  /// Whether a run that is interrupted after its solution is whole keeps its rows, without error bounds and verdict.
  bool partial = false;
};

/// Runs a scene, or the scene of a scenario; a pure function but for its watch. @throws ScenarioError for a scene that cannot
/// be run; ArithmeticError where the processor rounds otherwise than to nearest, or flushes subnormal numbers. Numerical
/// trouble is the result's status; the rows up to it are kept. A run that was asked to stop has none but with
/// `RunOptions::partial`: then bounds are not numbers, and the verdict is `unassessed`.
RunResult run(const Scene& scene, const RunOptions& options = {});

/// The seconds that a run takes on one core with all that it assesses, the choice of effects included; within a factor of a
/// few.
double estimated_run_seconds(const Scene& scene);

/// Whether a result has rows without bounds and verdict.
bool is_partial(const RunResult& result);

}  // namespace earthtop
