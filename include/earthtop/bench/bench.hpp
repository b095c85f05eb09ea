/// Speed against error: methods, tolerances and precisions on one scenario, timed side by side, their errors taken against a
/// certified reference.
///
/// Seconds are processor time of the integration alone, on one thread. Repetitions are interleaved: what disturbs the machine
/// disturbs every contender, and ratios can be trusted where seconds cannot.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// What a contender computes: the rotating motion by itself (a symmetric top's axis alone, or the attitude), or both motions
/// and their deviation as a run does; or the closed form of the motion, called at every checkpoint.
enum class Workload { axis, motion, drift, closed_form };
std::string_view to_string(Workload workload);

struct Contender {
  Workload workload = Workload::drift;
  IntegrationOptions options;  ///< not read for the closed form
  Precision precision = Precision::bits53;
};
/// E.g. "rkf78 1e-12, reduced, laboratory".
std::string describe(const Contender& contender);

/// The largest errors over all checkpoints (rad); none where the workload does not have the quantity.
struct BenchErrors {
  double axis = 0;                 ///< angle between the two body axes 3
  std::optional<double> attitude;  ///< angle between the two attitudes
  std::optional<double> drift;     ///< of the axis drift
};

/// The rotating motion and its drift at the checkpoints in 113 bits. The witness comes from other equations by another method,
/// or from a closed form; the error stated is three times the largest distance between the two.
struct CertifiedReference {
  std::vector<DriftSample<float128>> samples;
  std::string source, witness;  ///< in words: what the samples come from, and what was held against them
  BenchErrors error;
};

struct BenchEntry {
  Contender contender;
  RunStatus status = RunStatus::completed;  ///< of an entry that did not complete there are no errors
  BenchErrors errors;
  double seconds = 0;  ///< median of the repetitions
  double seconds_least = 0, seconds_most = 0;
  StepCounters counters;  ///< closed form: evaluations are calls
};

struct BenchOptions {
  int repetitions = 5;
  double least_seconds = 5e-3;         ///< a repetition runs a contender again and again until this much time is measured
  std::size_t checkpoints = 60;        ///< equal parts of the duration, where errors are taken and steps must land
  double reference_tolerance = 1e-20;  ///< of both integrations behind the reference
};

struct BenchReport {
  std::string scenario;
  double duration_s = 0;
  CertifiedReference reference;
  std::vector<BenchEntry> entries;  ///< as the contenders stood
};

/// Every method at several tolerances in every form that the scene has, and the closed form where there is one, in double
/// precision.
std::vector<Contender> standard_contenders(const Scenario& scenario);

/// Integrates the scenario in 113 bits by extrapolation of the general model; the witness is the closed form where both motions
/// have one, rkf78 in another observer's variables where not, without the spin where the scene allows it.
/// @param times_s  checkpoints, from 0   @throws std::runtime_error where an integration does not complete
CertifiedReference certified_reference(const Scenario& scenario, const std::vector<double>& times_s, double tolerance);

/// @throws ScenarioError for a scene that cannot be run; std::runtime_error where the reference cannot be had;
/// std::invalid_argument for a contender that this scene does not have.
BenchReport bench(const Scenario& scenario, std::span<const Contender> contenders, const BenchOptions& options = {});

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
