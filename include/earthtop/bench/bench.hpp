// SPDX-License-Identifier: GPL-3.0-or-later
/// Speed against error: methods, tolerances and precisions on one scenario, timed side by side, their errors taken against a
/// certified reference.
///
/// Seconds are processor time of the integration alone, on one thread. Repetitions are interleaved: what disturbs the machine
/// disturbs every contender, and ratios can be trusted where seconds cannot.
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

/// What a contender computes: the rotating motion by itself (a symmetric top's axis alone, or the attitude), or both motions
/// and their deviation as a run does.
enum class Workload { axis, motion, drift };
std::string_view to_string(Workload workload);

struct Contender {
  Workload workload = Workload::drift;
  IntegrationOptions options;
  Precision precision = Precision::bits53;
  std::optional<Peer> peer = std::nullopt;  ///< another library's method; of the options only the tolerance is read
  bool is_auto = false;                     ///< what `auto` takes for this scene
};
/// E.g. "rkf78", "splitting aba864", "gsl_rk8pd".
std::string method_name(const Contender& contender);
/// Whose equations, in which variables: e.g. "reduced, laboratory"; "difference of two" of a peer's drift.
std::string equations_name(const Contender& contender);
/// The tolerance or the step.
std::string setting_name(const Contender& contender);
/// E.g. "rkf78 1e-12, reduced, laboratory".
std::string describe(const Contender& contender);

/// The largest errors over all checkpoints (rad); none where the workload does not have the quantity.
struct BenchErrors {
  double axis = 0;                 ///< angle between the two body axes 3
  std::optional<double> attitude;  ///< angle between the two attitudes
  std::optional<double> drift;     ///< of the axis drift
};

/// What is known, or what a contender said, at a checkpoint.
struct Checkpoint {
  Quaternion<float128> q_LB;
  std::optional<float128> drift_axis;  ///< rad
};

/// The rotating motion and its drift at the checkpoints. The witness comes from other equations by another method, or from a
/// closed form; the error stated is three times the largest distance between the two.
struct CertifiedReference {
  std::vector<Checkpoint> checkpoints;
  std::string source, witness;  ///< in words: what the checkpoints come from, and what was held against them
  BenchErrors error;
};

struct BenchEntry {
  Contender contender;
  /// Of an entry that did not complete there are no errors; `interrupted`: it took more than the seconds allowed or, without a
  /// repetition, was not begun because it did so at a coarser tolerance.
  RunStatus status = RunStatus::completed;
  BenchErrors errors;
  double seconds = 0;  ///< median of the repetitions
  double seconds_least = 0, seconds_most = 0;
  int repetitions = 0;
  StepCounters counters;
};
/// "completed", "too_slow", "not_tried", or the outcome's name.
std::string_view outcome(const BenchEntry& entry);

/// Which of an entry's errors.
enum class ErrorKind { axis, attitude, drift };
std::string_view to_string(ErrorKind kind);

struct BenchOptions {
  std::optional<ErrorKind> compared;  ///< if left out, that of the workload; where there is no drift to err in, the attitude's
  int repetitions = 5;
  double least_seconds = 5e-3;     ///< a repetition runs a contender again and again until this much time is measured
  double most_seconds = 1;         ///< of one contender: its first call is stopped there, and its repetitions together
  std::size_t checkpoints = 60;    ///< equal parts of the duration, where errors are taken
  double reference_seconds = 1e9;  ///< where 113 bits would take longer by estimate, the reference is of 64
  /// Told what is about to be computed: the reference, contender k of n, repetition k of n. May be empty.
  std::function<void(const std::string&)> progress;
};

struct BenchReport {
  std::string scenario, title;
  double duration_s = 0;
  Workload workload = Workload::drift;  ///< of the first contender
  BenchOptions options;
  CertifiedReference reference;
  double largest_drift = 0;               ///< of the axis, over the checkpoints (rad)
  ErrorKind compared = ErrorKind::drift;  ///< what fronts, costs and pictures are of
  std::vector<BenchEntry> entries;        ///< as the contenders stood
};

/// Every method at several tolerances and precisions in every form that the scene has, and the peers where it is plain; what
/// `auto` takes is marked, and added where no other contender is the same.
std::vector<Contender> standard_contenders(const Scene& scene, Workload workload);

/// Integrates the scenario in 113 bits at 1e-20 by extrapolation of the general model, or in 64 bits at 1e-17 by the method
/// that is cheapest there. The witness is the closed form where both motions have one; else another method in another
/// observer's variables, of the other form where the scene has two.
/// @param times_s  checkpoints, from 0   @param precision  bits113 or bits64
/// @throws std::runtime_error where an integration does not complete
CertifiedReference certified_reference(const Scene& scene, const std::vector<double>& times_s,
                                       Precision precision = Precision::bits113);

/// What the reference will take on one core (s), within a factor of a few.
double estimated_reference_seconds(const Scene& scene, Precision precision);

/// The scenario as long as it may be for a reference of 64 bits within the seconds given.
Scene shortened_for_reference(const Scene& scene, double reference_seconds);

/// @throws ScenarioError for a scene that cannot be run; std::runtime_error where the reference cannot be had;
/// std::invalid_argument for a contender that this scene does not have.
BenchReport bench(const Scene& scene, std::span<const Contender> contenders, const BenchOptions& options = {});

/// Where on the line of these entries, in the logarithms of error and cost, the error is met: seconds and evaluations.
/// None where no two neighbouring entries (in the order of their cost) lie on either side of it.
struct CostAtError {
  double seconds = 0;
  double evaluations = 0;
};
/// @param error_of  which of the errors
std::optional<CostAtError> cost_at_error(std::span<const BenchEntry> entries, double (*error_of)(const BenchErrors&),
                                         double error);

}  // namespace earthtop
