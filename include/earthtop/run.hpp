// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a scenario: computes both predictions, their difference (the drift) and a bound on its error.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/budget/budget.hpp"
#include "earthtop/drift/contact_event.hpp"
#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/gimbal_event.hpp"
#include "earthtop/drift/stop_event.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// One of the two integrations behind a run.
struct IntegrationReport {
  Observer observer = Observer::laboratory;
  ModelForm form = ModelForm::general;  ///< form of the equations of motion that was used
  Method method = Method::rkf78;
  std::string reason;  ///< why this method
  RunStatus status = RunStatus::completed;
  std::string precision = "double";
  double relative_tolerance = 0;  ///< 0 for a closed form
  std::optional<double> step_s;   ///< fixed-step methods: the step taken
  StepCounters counters;
  double seconds = 0;  ///< wall time
};

/// A quantity that the exact motion conserves, and by how much it changed in the computed motion.
struct InvariantReport {
  std::string name;  ///< e.g. "jacobi_integral"
  std::string unit;
  double initial = 0;
  double largest_change = 0;
  double scale = 0;  ///< size of its largest term: largest_change / scale is the relative change
};

/// A first-order theoretical prediction, to compare with the computed number.
struct TheoryReport {
  std::string name;       ///< e.g. "precession_rate_change"
  std::string statement;  ///< the formula in words
  std::string unit;
  double predicted = 0;
  std::optional<double> computed;        ///< none where the run does not determine it
  double predicted_error = 0;            ///< size of the terms that the theory leaves out
  bool applies = true;                   ///< whether these terms are small
  std::optional<double> computed_error;  ///< bound on the error of `computed`
};

/// A sentence that says why the drift is what it is, with the numbers that it states (SI units, in their names). It is there only
/// where theory applies to the scene and agrees with the run.
struct WhySentence {
  std::string_view name;  ///< e.g. "laboratory_turns"
  std::string text;
  std::vector<std::pair<std::string_view, double>> numbers;
};

/// The torques on the motion on the rotating Earth, as seen by the observer that the scenario names.
struct LedgerReport {
  LedgerObserver observer = LedgerObserver::laboratory;
  std::vector<LedgerRow<double>> entries;             ///< one entry for each output row
  std::vector<LedgerRow<float128>> extended_entries;  ///< the same in full precision; empty in double precision
  LedgerLargest largest;
};

/// How far a drift can be trusted.
enum class Verdict {
  reliable,     ///< the error is within its bound
  noise_floor,  ///< the drift is not above its error bound
  unstable,     ///< disturbances grow exponentially along this particular motion
  chaotic,      ///< disturbances grow exponentially everywhere: Earth rotation looks like any other disturbance
  marginal,     ///< at a stability limit: digits that no experiment can measure decide the kind of motion
  unassessed    ///< not judged: there is no row after the release, or the run was interrupted
};
std::string_view to_string(Verdict verdict);

/// Why the drift is not to be trusted for some time.
enum class Doubt {
  rounding_grown,
  bound_loose,
  earth_grown,
  critical_spin,
  stability_limit,
  slip_started,
  noise,
  not_assessed,
  one_at_rest,
  mixed_contact
};

struct DoubtType {
  Doubt doubt;
  std::string_view name;   ///< its word in summary.json
  std::string_view words;  ///< a sentence without its full stop
  /// Whether the run's verdict rests on it. The others belong to moments that the two motions pass one after the other.
  bool of_verdict;
};
inline constexpr DoubtType kDoubts[] = {
    {Doubt::rounding_grown, "rounding_grown", "rounding has grown to a microradian", true},
    {Doubt::bound_loose, "bound_loose", "the bound on the drift's error has passed 0.01 rad", true},
    {Doubt::earth_grown, "earth_grown", "the Earth's own disturbance has grown to 0.1 rad", true},
    {Doubt::critical_spin, "critical_spin", "friction has slowed an upright top to its critical spin", true},
    {Doubt::stability_limit, "stability_limit", "an upright top is at its critical spin", true},
    {Doubt::slip_started, "slip_started", "how the tip slips is not computed", true},
    {Doubt::noise, "noise", "the drift is not above three times the bound on its error", true},
    {Doubt::not_assessed, "not_assessed", "the drift was not judged", true},
    {Doubt::one_at_rest, "one_at_rest", "one motion is at rest and the other one moves on", false},
    {Doubt::mixed_contact, "mixed_contact", "the tip slides in one motion and rolls in the other one", false}};
constexpr const DoubtType& type_of(Doubt doubt) { return kDoubts[static_cast<std::size_t>(doubt)]; }
static_assert([] {
  for (const DoubtType& type : kDoubts)
    if (&type_of(type.doubt) != &type) return false;
  return true;
}());

/// A time in which the drift is not to be trusted: from `from_s` to just before `until_s`, or to the end where there is none.
struct VerdictInterval {
  double from_s = 0;
  std::optional<double> until_s;
  Doubt why = Doubt::not_assessed;
  bool contains(double t_s) const { return t_s >= from_s && !(until_s && t_s >= *until_s); }
};

struct VerdictReport {
  Verdict verdict = Verdict::reliable;
  /// The times in which the drift is not to be trusted, ascending. Those on which the verdict rests do not overlap; each states the
  /// doubt that came first.
  std::vector<VerdictInterval> intervals{};
  /// Time (s) from which the verdict does not trust the drift; empty where it trusts the run to its end.
  std::optional<double> from_s;
  /// Time (s) from which it trusts the drift again; empty where it does not.
  std::optional<double> until_s{};
  double reliable_until_s = 0;  ///< the begin of the first interval, or the end of the run
  /// Whether the drift at this time can be trusted: no interval contains it.
  bool trusts(double t_s) const;
  /// Whether the verdict does not trust the motions themselves at this time, and not only what they tell of the Earth.
  bool doubts_motion(double t_s) const;
  std::string reason;
  /// Finite-time Lyapunov exponent at late times (1/s), the larger one of the two motions (see GrowthReport); empty where
  /// closed forms show that nothing grows exponentially, or where the growth could not be followed.
  std::optional<double> lyapunov_exponent_1_s;
  std::optional<double> round_off_grown_s;  ///< when rounding errors have grown exponentially to 1e-6 rad (s)
  /// Time (s) when the drift of the attitude, to which the Earth's rotation has grown along a motion whose disturbances grow
  /// exponentially, first passes 0.1 rad; empty where it does not, where its bound is too loose to tell, and where the Earth itself
  /// turns by as much until then, so that a large effect is expected.
  std::optional<double> earth_grown_s;
};

/// The change of the last reliable drift with one input (rad per unit of the input), and the drift error due to that input.
struct InputSensitivity {
  std::string_view name;                                ///< one of kInputNames (scenario/inputs.hpp)
  double value = 0;                                     ///< value of the input
  double axis_rad = 0, attitude_rad = 0, tilt_rad = 0;  ///< `axis_rad` of a rotor's axis where there is one
  std::optional<double> azimuth_rad{};                  ///< empty where an axis is vertical
  double axis_error_rad = 0;  ///< standard error of the axis drift due to this input (rad); 0 if none is given
  double axis_bound_rad = 0;  ///< bound on the error of `axis_rad` itself
  std::string unavailable{};  ///< why there is no derivative with respect to this input; empty if there is
};
struct SensitivityReport {
  double at_s = 0;
  std::vector<InputSensitivity> inputs;  ///< those that the scene has, in the order of kInputNames; empty if unavailable
  std::string unavailable;               ///< why there are no derivatives; empty if there are
  double axis_error_rad = 0;             ///< standard error of the axis drift from all inputs, taken as independent (rad)
  std::string_view without_derivative;   ///< an input with a standard error that has no derivative; empty if there is none
};

/// How far the non-rotating prediction itself moves with one input of the contact, at the last reliable row.
struct PredictionChange {
  std::string_view input;          ///< "friction_coefficient", "table_tilt", ...
  std::string_view step;           ///< what the change is: "1 %", "1 arcsec"
  double axis_rad = 0, tip_m = 0;  ///< change of the reference axis and of the reference tip; the largest over its directions
};
/// A quantity that the contact changes at a known rate, along one motion from the release to the last row.
struct ContactBalance {
  double first = 0, last = 0;
  double integral = 0;  ///< of its rate, along the motion
  double balance = 0;   ///< last - first - integral: what the computed motion fails by
  double size = 0;      ///< of the quantity's largest term: balance / size is the relative error
};
/// The balances of one motion: of Jellett's integral (kg m^3/s), for symmetric bodies, and of the Jacobi integral (J), which
/// changes by the work of friction. Each is empty where the scene has torques that change it otherwise, or where the rows were
/// not integrated in laboratory axes.
struct ContactBalances {
  std::optional<ContactBalance> jellett, jacobi;
};
/// The report of a run of a top on a table about the contact.
struct ContactReport {
  std::vector<ContactEvent> events;  ///< ascending in time
  double at_s = 0;                   ///< time of `changes`
  std::vector<PredictionChange> changes;
  ContactBalances rotating{}, reference{};
};

/// A number with a bound on its error.
struct BoundedNumber {
  double value = 0;
  double bound = 0;
};
/// The same number in both motions.
struct BoundedPair {
  BoundedNumber rotating, reference;
};

/// What a run tells of the motions themselves.
struct MotionReport {
  BoundedPair spin_end_rad_s;  ///< component of the rate in the laboratory along body axis 3, in the last row
  /// When spin and tilt first come to the values that the scenario names (s); none in a motion that does not. Where the error may keep the
  /// motion from it, or bring it there, it is not sure, and has no bound.
  struct Reached {
    std::optional<double> rotating_s, reference_s;
    std::optional<double> rotating_bound_s, reference_bound_s;
    bool rotating_is_sure = true, reference_is_sure = true;
  };
  std::optional<Reached> spin, tilt;
  /// The ellipse of a pendulum's swing (closed_form/swing.hpp). Azimuths of planes are counted clockwise.
  struct OfSwing {
    BoundedPair major_start_rad, minor_start_rad, major_end_rad, minor_end_rad;
    BoundedPair plane_rate_rad_s;  ///< mean rate of the plane in the laboratory; of the reference: the apsidal rate
  };
  std::optional<OfSwing> swing;
};

/// States whether the requested error was reached, counting both the error bound and the effects left out.
struct AccuracyReport {
  double asked_rad = 0;
  double reached_rad = 0;
  int attempts = 0;  ///< number of runs needed to find a tolerance
  bool reached() const { return reached_rad <= asked_rad; }
};

class LaterRows;

struct RunResult {
  // The special members are defined in one source file, to save compile time in the others.
  RunResult();
  RunResult(const RunResult&);
  RunResult(RunResult&&) noexcept;
  RunResult& operator=(const RunResult&);
  RunResult& operator=(RunResult&&) noexcept;
  ~RunResult();

  Scene scene;                             ///< the scene as given
  Scene modelled;                          ///< the scene with the chosen effects and tolerance
  std::optional<Selection> selection;      ///< present if the scenario leaves the choice of effects open
  std::optional<AccuracyReport> accuracy;  ///< present if the scenario requests an accuracy
  RunStatus status = RunStatus::completed;
  double reached_s = 0;  ///< time of the last row, or time that an interrupted solution reached (s)
  /// For an interrupted run: whether the solution was complete, so that only later work was cut short.
  bool solution_is_whole = false;
  std::vector<DriftRow> rows;
  /// Makes the rows of a long table, of which `rows` holds only every n-th and the last (run/each_row.hpp); null: `rows` holds all.
  std::shared_ptr<const LaterRows> later_rows;
  std::vector<ExtendedDriftRow> extended_rows;  ///< the same rows in full precision; empty in double precision
  float128 extended_axis_max_rad = 0;           ///< the largest axis drift in full precision; 0 in double precision
  /// The motion at times of the run's own, which resolve the axes' fastest motion: pictures, maxima and sentences come from these, and so
  /// do not depend on the output times. Where the run has too many periods of that motion, in windows as long as one period.
  std::vector<DriftRow> looks;
  std::size_t looks_a_window = 0;  ///< number of looks in a window; 0: they are evenly spaced from the release to the end
  DriftSummary drift;
  VerdictReport verdict;
  std::vector<StopEvent> stops;            ///< the times when dry friction brought a motion to rest
  std::vector<GimbalEvent> gimbal_events;  ///< of a Cardan suspension
  std::optional<ContactReport> contact;    ///< present for a top on a table
  IntegrationReport solution;              ///< the integration that gives the rows
  IntegrationReport certificate;           ///< the second integration, whose distance to the rows gives the bounds
  double looks_seconds = 0;                ///< time of the integrations for `looks` and largest values, besides the two (s)
  double attitude_bound_rad = 0;           ///< error bound of q_LB and ref_q_LB themselves, largest of all rows
  std::vector<InvariantReport> invariants;
  std::vector<TheoryReport> theory;
  std::vector<WhySentence> why;                    ///< in the order in which they are read
  std::optional<SensitivityReport> sensitivities;  ///< present if the scenario requests them
  std::optional<LedgerReport> ledger;              ///< present if the scenario requests one
  std::vector<std::string> notes;                  ///< e.g. that a scene is non-physical
  std::optional<MotionReport> motion;              ///< none without a row after the release
};

/// Returns whether there is a row after the release; without one nothing is known about the drift.
bool has_drift(const RunResult& result);

/// Returns a text that says which integration exceeded its limit of steps; empty where none did.
std::string why_limited(const RunResult& result);
/// Returns whether an integration was stopped by the limit derived from its estimated work, not by the general step limit.
bool stopped_beyond_estimate(const RunResult& result);

/// Returns whether the drift of every row is reliable.
bool is_all_reliable(const RunResult& result);

/// Returns the last row whose drift is reliable; null where there is none.
const DriftRow* last_reliable_row(const RunResult& result);

struct RunOptions {
  Watch watch;  ///< receives the progress and may stop the run
  /// Whether a run that is interrupted after its solution is complete keeps its rows, without error bounds and verdict.
  bool partial = false;
  /// Number of threads, 1 or more. With two, the second integration, which gives the bounds, runs alongside the first. The result
  /// is the same.
  unsigned jobs = 1;
  /// Whether the motion between the rows is looked at. Without it the result has few looks, and its largest values, swings and computed
  /// theory are those of these looks: for callers that do not read them.
  bool between = true;
  /// Whether the result of a run with a long table holds only a few of its rows, where `is_made_row_by_row` has it (run/each_row.hpp).
  bool row_by_row = false;
};

/// Runs a scene, or the scene of a scenario. The result depends on the scene only; the watch is the only side effect.
/// Numerical trouble is reported in the result's status, and the rows before it are kept. A run that was asked to stop has no
/// rows, except with `RunOptions::partial`: then its bounds are NaN and its verdict is `unassessed`.
/// @throws ScenarioError for a scene that cannot be run; ArithmeticError for what `arithmetic_faults` finds
RunResult run(const Scene& scene, const RunOptions& options = {});

/// Estimates, within a factor of a few, the time (s) that a run takes on one core, with its assessments and the choice of
/// effects.
double estimated_run_seconds(const Scene& scene);

/// Returns whether a result has rows without bounds and verdict.
bool is_partial(const RunResult& result);

}  // namespace earthtop
