// SPDX-License-Identifier: GPL-3.0-or-later
/// Benchmarks of speed against error: methods, tolerances and precisions on one scenario, timed side by side. Their errors are
/// taken relative to a certified reference.
///
/// Seconds are processor time of the integration alone, on one thread. The repetitions of all contenders are interleaved, so
/// that a disturbance of the machine affects every contender: ratios can be trusted even if seconds cannot.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/bench/peers.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The task of a contender: the rotating motion alone (`axis`: only the axis of a symmetric top; `motion`: the whole attitude),
/// or, as in a run, both motions and their deviation (`drift`).
enum class Workload { axis, motion, drift };
std::string_view to_string(Workload workload);

struct Contender {
  Workload workload = Workload::drift;
  IntegrationOptions options;
  Precision precision = Precision::bits53;
  const Peer* peer = nullptr;  ///< another library's method; only the tolerance of the options is used
  bool is_auto = false;        ///< whether this is what `auto` chooses for this scene
};
/// E.g. "rkf78", "splitting aba864", "gsl_rk8pd".
std::string method_name(const Contender& contender);
/// The equations and their variables, e.g. "reduced, laboratory"; for a peer's drift "difference of two".
std::string equations_name(const Contender& contender);
/// The tolerance or the step as text.
std::string setting_name(const Contender& contender);
/// E.g. "rkf78 1e-12, reduced, laboratory".
std::string describe(const Contender& contender);

/// The largest errors over all checkpoints (rad); none if the workload does not compute the quantity.
struct BenchErrors {
  double axis = 0;                 ///< angle between the two body axes 3
  std::optional<double> attitude;  ///< angle between the two attitudes
  std::optional<double> drift;     ///< error of the axis drift
};

/// The attitude and drift at a checkpoint, from the reference or from a contender.
struct Checkpoint {
  Quaternion<float128> q_LB;
  std::optional<float128> drift_axis;  ///< rad
};

/// The rotating motion and its drift at the checkpoints. The witness is computed from other equations by another method, or
/// from a closed form. The stated error is three times the largest distance between source and witness.
struct CertifiedReference {
  std::vector<Checkpoint> checkpoints;
  std::string source, witness;  ///< in words: the origin of the checkpoints, and what they were compared with
  BenchErrors error;
};

struct BenchEntry {
  Contender contender;
  /// `interrupted`: the entry took longer than allowed, or (without a repetition) was not begun because it took too long at a
  /// coarser tolerance. There are no errors unless the entry was completed.
  RunStatus status = RunStatus::completed;
  BenchErrors errors;
  double seconds = 0;  ///< median of the repetitions
  double seconds_least = 0, seconds_most = 0;
  int repetitions = 0;
  StepCounters counters;
};
/// "completed", "too_slow", "not_tried", or the name of the status.
std::string_view outcome(const BenchEntry& entry);

/// Selects one of an entry's errors.
enum class ErrorKind { axis, attitude, drift };
std::string_view to_string(ErrorKind kind);

struct BenchOptions {
  std::optional<ErrorKind> compared;  ///< default: the workload's; the attitude's if there is no drift
  int repetitions = 5;
  double least_seconds = 5e-3;   ///< within one repetition a contender is run again and again until this time has passed
  double most_seconds = 1;       ///< for one contender: limit of its first call, and of its repetitions together
  std::size_t checkpoints = 60;  ///< number of equal parts of the duration, at whose ends errors are taken
  double reference_seconds =
      1e9;  ///< if a reference of 113 bits is estimated to take longer, one of 64 bits is used; either is
            ///< given up after ten times as long, and not before 10 s
  /// Called with a description of what is computed next: the reference, contender k of n, repetition k of n. May be empty.
  std::function<void(const std::string&)> progress;
};

struct BenchReport {
  std::string scenario, title;
  double duration_s = 0;
  Workload workload = Workload::drift;  ///< workload of the first contender
  BenchOptions options;
  CertifiedReference reference;
  double largest_drift = 0;               ///< largest axis drift over the checkpoints (rad)
  ErrorKind compared = ErrorKind::drift;  ///< the error used in Pareto fronts, costs and figures
  std::vector<BenchEntry> entries;        ///< in the order of the contenders
};

/// Every method at several tolerances and precisions, in every form that the scene has; also the peers if the scene is plain.
/// The choice of `auto` is marked, and added if no other contender is the same.
std::vector<Contender> standard_contenders(const Scene& scene, Workload workload);

/// Integrates the scenario in 113 bits at a tolerance of 1e-20 by extrapolation of the general model, or in 64 bits at 1e-17 by
/// the method that is cheapest there. The witness is the closed form if both motions have one; otherwise another method in
/// another observer's variables, in the other form if the scene has two.
/// @param times_s  checkpoints, beginning with 0 (s)   @param precision  bits113 or bits64
/// @param watch  may end it early   @throws ScenarioError if an integration is not completed
CertifiedReference certified_reference(const Scene& scene, const std::vector<double>& times_s,
                                       Precision precision = Precision::bits113, const Watch& watch = {});

/// The estimated time for the reference on one core (s), within a factor of a few.
double estimated_reference_seconds(const Scene& scene, Precision precision);

/// The scenario, shortened if necessary so that a reference of 64 bits takes no longer than the given time (s).
Scene shortened_for_reference(const Scene& scene, double reference_seconds);

/// @throws ScenarioError for a scene that cannot be run, or whose reference cannot be computed; std::invalid_argument for a
/// contender that does not fit the scene
BenchReport bench(const Scene& scene, std::span<const Contender> contenders, const BenchOptions& options = {});

/// The cost at which these entries reach the given error: seconds and evaluations, interpolated linearly in the logarithms of
/// error and cost. None if no two neighbouring entries (in the order of their cost) enclose the error.
struct CostAtError {
  double seconds = 0;
  double evaluations = 0;
};
/// @param error_of  selects one of the errors
std::optional<CostAtError> cost_at_error(std::span<const BenchEntry> entries, double (*error_of)(const BenchErrors&),
                                         double error);

}  // namespace earthtop
