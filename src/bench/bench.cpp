// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/bench/bench.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "bench/deadline.hpp"
#include "bench/errors.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/scenario/support.hpp"

namespace earthtop {
namespace {

/// The work of one contender, ready to be repeated, and the results of its first computation.
struct TimedContender {
  std::function<void()> compute;
  RunStatus status = RunStatus::completed;
  StepCounters counters;
  std::vector<Checkpoint> checkpoints;
  double first_seconds = 0;
  std::vector<double> seconds;
  int repetitions = 0, calls_a_repetition = 1;
};

/// The two motions of a peer; its drift is their difference.
struct PeerDrift {
  RunStatus status;
  std::vector<Checkpoint> samples;
  StepCounters counters;
};

Checkpoint checkpoint_of(const Checkpoint& checkpoint) { return checkpoint; }

/// Computes once, stopping if it takes too long, and stores the results; afterwards `racer.compute` computes again without
/// storing.
template <class Compute>
void prepare(const Compute& compute, double most_seconds, TimedContender& racer) {
  const Deadline deadline(most_seconds);
  const double start = thread_seconds();
  const auto trajectory = compute(deadline.passed());
  racer.first_seconds = thread_seconds() - start;
  racer.status = trajectory.status;
  racer.counters = trajectory.counters;
  for (const auto& sample : trajectory.samples) racer.checkpoints.push_back(checkpoint_of(sample));
  racer.compute = [compute] { compute(Watch()); };
}

PeerDrift subtract(const MotionTrajectory<double>& rotating, const MotionTrajectory<double>& reference) {
  PeerDrift drift{rotating.status != RunStatus::completed ? rotating.status : reference.status, {}, rotating.counters};
  drift.counters.accepted += reference.counters.accepted;
  drift.counters.rejected += reference.counters.rejected;
  drift.counters.evaluations += reference.counters.evaluations;
  for (std::size_t i = 0; i < std::min(rotating.samples.size(), reference.samples.size()); ++i)
    drift.samples.push_back(subtracted(checkpoint_of(rotating.samples[i]).q_LB, checkpoint_of(reference.samples[i]).q_LB));
  return drift;
}

void prepare_peer(const Contender& contender, const Scene& scene, const std::vector<double>& times_s, double most_seconds,
                  TimedContender& racer) {
  const auto problem_of = [&](const Scene& of) {
    MotionProblem<double> problem = of.problem<double>();
    problem.times_s = times_s;
    return problem;
  };
  const Peer& peer = *contender.peer;
  const double tolerance = contender.options.relative_tolerance;
  const MotionProblem<double> rotating = problem_of(scene);
  if (contender.workload != Workload::drift)
    return prepare([=, &peer](const Watch& watch) { return integrate_with_peer(peer, rotating, tolerance, watch); },
                   most_seconds, racer);
  prepare(
      [=, &peer, reference = problem_of(scene.without_rotation())](const Watch& watch) {
        const auto first = integrate_with_peer(peer, rotating, tolerance, watch);
        return subtract(first, integrate_with_peer(peer, reference, tolerance, watch));
      },
      most_seconds, racer);
}

template <class T>
void prepare(const Contender& contender, const Scene& scene, const std::vector<double>& times_s, double most_seconds,
             TimedContender& racer) {
  DriftProblem<T> problem = scene.problem<T>();
  problem.times_s = times_s;
  const IntegrationOptions& options = contender.options;
  if (contender.workload == Workload::drift)
    return prepare([=](const Watch& watch) { return integrate_drift(problem, options, watch); }, most_seconds, racer);
  const MotionSought sought = contender.workload == Workload::axis ? MotionSought::symmetry_axis : MotionSought::attitude;
  prepare([=](const Watch& watch) { return integrate_motion<T>(problem, options, sought, watch); }, most_seconds, racer);
}

/// @throws std::invalid_argument for a method that does not fit the scene
/// @param scene  without numerics of its own
void require_fit(const Contender& contender, const Scene& scene) {
  if (const std::string_view reason = scene.support().no_motion_alone; contender.workload != Workload::drift && !reason.empty())
    throw std::invalid_argument("bench: " + std::string(reason));
  if (contender.peer) {
    if (!scene.is_plain()) throw std::invalid_argument("bench: no peer can integrate this scenario");
  } else if (const auto& reason = scene.method_refusal(contender.options.method)) {
    throw std::invalid_argument("bench: " + *reason);
  }
}

void prepare(const Contender& contender, const Scene& scene, const std::vector<double>& times_s, double most_seconds,
             TimedContender& racer) {
  if (contender.peer) return prepare_peer(contender, scene, times_s, most_seconds, racer);
  switch (contender.precision) {
    case Precision::bits53: return prepare<double>(contender, scene, times_s, most_seconds, racer);
    case Precision::bits64: return prepare<float80>(contender, scene, times_s, most_seconds, racer);
    case Precision::bits113: return prepare<float128>(contender, scene, times_s, most_seconds, racer);
  }
}

/// Decides how often to repeat, and how often to compute in each repetition. For a slow contender the first computation is its
/// measurement.
void plan_repetitions(const BenchOptions& options, TimedContender& racer) {
  const double calls = std::ceil(options.least_seconds / std::max(racer.first_seconds, 1e-9));
  racer.calls_a_repetition = static_cast<int>(std::clamp(calls, 1.0, 1e6));
  const double left = racer.status == RunStatus::completed ? options.most_seconds - racer.first_seconds : 0;
  const double affordable = std::max(left, 0.0) / std::max(racer.first_seconds, options.least_seconds);
  racer.repetitions = std::min(std::max(options.repetitions, 1), static_cast<int>(std::min(affordable, 1e6)));
  if (racer.repetitions < 2) {
    racer.repetitions = 0;
    racer.seconds.push_back(racer.first_seconds);
  }
}

/// Whether the same contender at a coarser tolerance was already too slow.
bool was_too_slow_when_coarser(const Contender& contender, const Contender& before, const TimedContender& racer) {
  return racer.status == RunStatus::interrupted && method_name(contender) == method_name(before) &&
         equations_name(contender) == equations_name(before) && contender.precision == before.precision &&
         !contender.options.step_s && contender.options.relative_tolerance < before.options.relative_tolerance;
}

void time_once(TimedContender& racer) {
  const double start = thread_seconds();
  for (int call = 0; call < racer.calls_a_repetition; ++call) racer.compute();
  racer.seconds.push_back((thread_seconds() - start) / racer.calls_a_repetition);
}

/// If the laboratory does not rotate, the drift is zero and so is every error in it; then the attitude is compared.
ErrorKind compared_by_default(const BenchReport& report) {
  if (report.workload == Workload::axis) return ErrorKind::axis;
  return report.workload == Workload::drift && report.largest_drift > 0 ? ErrorKind::drift : ErrorKind::attitude;
}

BenchEntry entry_of(const Contender& contender, TimedContender& racer, const std::vector<Checkpoint>& reference) {
  BenchEntry entry;
  entry.contender = contender;
  entry.status = racer.status;
  entry.counters = racer.counters;
  if (racer.status == RunStatus::completed)
    entry.errors = largest_errors(racer.checkpoints, reference, contender.workload != Workload::axis);
  std::sort(racer.seconds.begin(), racer.seconds.end());
  entry.seconds = racer.seconds[racer.seconds.size() / 2];
  entry.seconds_least = racer.seconds.front();
  entry.seconds_most = racer.seconds.back();
  entry.repetitions = entry.seconds > 0 ? static_cast<int>(racer.seconds.size()) : 0;
  return entry;
}

}  // namespace

BenchReport bench(const Scene& scene, std::span<const Contender> contenders, const BenchOptions& options) {
  if (const auto reason = precision_refusal(Precision::bits113))
    throw ScenarioError("", "a bench compares with a reference in extended precision: " + *reason);
  scene.require_affordable();
  const Scenario& scenario = scene.scenario();
  Scenario as_asked = scenario;
  as_asked.numerics = {};
  const Scene without_numerics = resolve(std::move(as_asked));
  for (const Contender& contender : contenders) require_fit(contender, without_numerics);
  BenchReport report;
  report.scenario = scenario.name;
  report.title = scenario.title;
  report.duration_s = scenario.duration_s;
  report.options = options;
  if (!contenders.empty()) report.workload = contenders[0].workload;
  std::vector<double> times_s;
  for (std::size_t k = 0; k <= options.checkpoints; ++k)
    times_s.push_back(scenario.duration_s * static_cast<double>(k) / static_cast<double>(options.checkpoints));
  const auto tell = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  tell("reference");
  const bool full = estimated_reference_seconds(scene, Precision::bits113) <= options.reference_seconds;
  constexpr double kTimes = 3, kLeast_s = 1, kMost_s = 1e6;  // the limit is one of estimates, which err by so much
  const Deadline latest(kTimes * std::clamp(options.reference_seconds, kLeast_s, kMost_s));
  report.reference = certified_reference(scene, times_s, full ? Precision::bits113 : Precision::bits64, latest.passed());
  const std::vector<Checkpoint>& reference = report.reference.checkpoints;
  for (const Checkpoint& checkpoint : reference)
    report.largest_drift = std::max(report.largest_drift, static_cast<double>(checkpoint.drift_axis.value_or(0)));

  report.compared = options.compared.value_or(compared_by_default(report));

  std::vector<TimedContender> racers(contenders.size());
  int rounds = 0;
  for (std::size_t i = 0; i < racers.size(); ++i) {
    tell(fmt::format("contender {} of {}: {}", i + 1, racers.size(), describe(contenders[i])));
    if (i > 0 && was_too_slow_when_coarser(contenders[i], contenders[i - 1], racers[i - 1])) {
      racers[i].status = RunStatus::interrupted;
      racers[i].seconds = {0};
      continue;
    }
    prepare(contenders[i], scene, times_s, options.most_seconds, racers[i]);
    plan_repetitions(options, racers[i]);
    rounds = std::max(rounds, racers[i].repetitions);
  }
  for (int round = 0; round < rounds; ++round) {
    tell(fmt::format("repetition {} of {}", round + 1, rounds));
    for (TimedContender& racer : racers)
      if (round < racer.repetitions) time_once(racer);
  }

  for (std::size_t i = 0; i < racers.size(); ++i) report.entries.push_back(entry_of(contenders[i], racers[i], reference));
  return report;
}

std::optional<CostAtError> cost_at_error(std::span<const BenchEntry> entries, double (*error_of)(const BenchErrors&),
                                         double error) {
  std::vector<const BenchEntry*> sorted;
  for (const BenchEntry& entry : entries)
    if (entry.status == RunStatus::completed && error_of(entry.errors) > 0) sorted.push_back(&entry);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto* a, const auto* b) { return a->counters.evaluations < b->counters.evaluations; });
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    const BenchEntry &coarse = *sorted[i], &fine = *sorted[i + 1];
    const double from = real::log(error_of(coarse.errors)), to = real::log(error_of(fine.errors)), at = real::log(error);
    if (!(from >= at && at >= to && from > to)) continue;
    const double part = (from - at) / (from - to);
    const auto between = [&](double x, double y) { return real::exp((1 - part) * real::log(x) + part * real::log(y)); };
    return CostAtError{between(coarse.seconds, fine.seconds), between(static_cast<double>(coarse.counters.evaluations),
                                                                      static_cast<double>(fine.counters.evaluations))};
  }
  return std::nullopt;
}

}  // namespace earthtop
