#include "earthtop/bench/bench.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "bench/errors.hpp"
#include "bench/exact_motion.hpp"
#include "run/setup.hpp"

namespace earthtop {
namespace {

/// Processor time of this thread (s): what other programs do meanwhile is not in it.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One contender's work, ready to be repeated, and what it last said.
struct Racer {
  std::function<void()> compute;
  RunStatus status = RunStatus::completed;
  StepCounters counters;
  std::vector<Checkpoint> checkpoints;
  std::vector<double> seconds;
  int calls_a_repetition = 1;
};

template <class Trajectory>
void note(const Trajectory& trajectory, Racer& racer) {
  racer.status = trajectory.status;
  racer.counters = trajectory.counters;
  racer.checkpoints.clear();
  for (const auto& sample : trajectory.samples) racer.checkpoints.push_back(checkpoint_of(sample));
}

/// Computes once and notes what came out, then once more without noting whenever called.
template <class T>
void prepare(const Contender& contender, const Scenario& scenario, const std::vector<double>& times_s, Racer& racer) {
  if (contender.workload == Workload::closed_form) {
    const ExactLaboratoryMotion<T> motion = exact_laboratory_motion<T>(scenario);
    if (!motion) throw std::invalid_argument("bench: this scene has no closed form");
    for (const double t : times_s) racer.checkpoints.push_back(checkpoint_of(motion(T(t))));
    racer.counters.evaluations = static_cast<std::int64_t>(times_s.size());
    racer.compute = [motion, times_s] {
      for (const double t : times_s) static_cast<void>(motion(T(t)));
    };
    return;
  }
  auto problem = make_problem<T>(scenario);
  problem.times_s = times_s;
  if (contender.workload == Workload::drift) {
    note(integrate_drift(problem, contender.options), racer);
    racer.compute = [problem, options = contender.options] { integrate_drift(problem, options); };
  } else {
    const MotionSought sought = contender.workload == Workload::axis ? MotionSought::symmetry_axis : MotionSought::attitude;
    note(integrate_motion<T>(problem, contender.options, sought), racer);
    racer.compute = [problem, sought, options = contender.options] { integrate_motion<T>(problem, options, sought); };
  }
}

void prepare(const Contender& contender, const Scenario& scenario, const std::vector<double>& times_s, Racer& racer) {
  switch (contender.precision) {
    case Precision::bits53: return prepare<double>(contender, scenario, times_s, racer);
    case Precision::bits64: return prepare<long double>(contender, scenario, times_s, racer);
    case Precision::bits113: return prepare<float128>(contender, scenario, times_s, racer);
  }
}

void time_once(Racer& racer) {
  const double start = thread_seconds();
  for (int call = 0; call < racer.calls_a_repetition; ++call) racer.compute();
  racer.seconds.push_back((thread_seconds() - start) / racer.calls_a_repetition);
}

BenchEntry entry_of(const Contender& contender, Racer& racer, const std::vector<Checkpoint>& reference) {
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
  return entry;
}

}  // namespace

BenchReport bench(const Scenario& scenario, std::span<const Contender> contenders, const BenchOptions& options) {
  require_affordable(scenario);
  BenchReport report;
  report.scenario = scenario.name;
  report.duration_s = scenario.duration_s;
  std::vector<double> times_s;
  for (std::size_t k = 0; k <= options.checkpoints; ++k)
    times_s.push_back(scenario.duration_s * static_cast<double>(k) / static_cast<double>(options.checkpoints));
  report.reference = certified_reference(scenario, times_s, options.reference_tolerance);
  std::vector<Checkpoint> reference;
  for (const auto& sample : report.reference.samples) reference.push_back(checkpoint_of(sample));

  std::vector<Racer> racers(contenders.size());
  for (std::size_t i = 0; i < racers.size(); ++i) {
    prepare(contenders[i], scenario, times_s, racers[i]);
    time_once(racers[i]);  // warms up, and says how often a repetition has to call
    const double calls = std::ceil(options.least_seconds / std::max(racers[i].seconds.front(), 1e-9));
    racers[i].calls_a_repetition = static_cast<int>(std::clamp(calls, 1.0, 1e6));
    racers[i].seconds.clear();
  }
  for (int repetition = 0; repetition < std::max(options.repetitions, 1); ++repetition)
    for (Racer& racer : racers) time_once(racer);

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
    const double from = std::log(error_of(coarse.errors)), to = std::log(error_of(fine.errors)), at = std::log(error);
    if (!(from >= at && at >= to && from > to)) continue;
    const double part = (from - at) / (from - to);
    const auto between = [&](double x, double y) { return std::exp((1 - part) * std::log(x) + part * std::log(y)); };
    return CostAtError{between(coarse.seconds, fine.seconds), between(static_cast<double>(coarse.counters.evaluations),
                                                                      static_cast<double>(fine.counters.evaluations))};
  }
  return std::nullopt;
}

}  // namespace earthtop
