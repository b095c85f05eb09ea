/// Speed against error: every method and tolerance on a scenario against 113-bit arithmetic in another observer's equations,
/// repetitions interleaved, medians printed as a Markdown table.
///
/// earthtop-speed-error [SCENARIO [SECONDS [REPETITIONS]]]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "run/setup.hpp"

namespace {

using namespace earthtop;

struct Entry {
  std::string label;
  IntegrationOptions options;
  std::vector<double> seconds;
  double axis_drift_error = 0, drift_largest = 0, attitude_error = 0;
  StepCounters counters;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(const DriftTrajectory<double>& computed, const DriftTrajectory<float128>& exact, Entry& entry) {
  for (std::size_t i = 0; i < computed.samples.size(); ++i) {
    const auto& c = computed.samples[i];
    const auto& e = exact.samples[i];
    const auto error = static_cast<double>(real::abs(static_cast<float128>(c.measures.axis) - e.measures.axis));
    entry.axis_drift_error = std::max(entry.axis_drift_error, error);
    entry.drift_largest = std::max(entry.drift_largest, static_cast<double>(e.measures.axis));
    const Quaternion<float128> q{c.state.q_LB.w, c.state.q_LB.v.cast<float128>()};
    const Quaternion<float128> d = q.conjugate() * e.state.q_LB;
    entry.attitude_error = std::max(entry.attitude_error, static_cast<double>(2 * norm(d.v)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "toy-top";
  Scenario scenario = parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json"));
  if (argc > 2) scenario.duration_s = std::atof(argv[2]);
  const int repetitions = argc > 3 ? std::atoi(argv[3]) : 5;

  std::vector<Entry> entries;
  const auto add = [&](Method method, Observer observer, double tolerance, double step_s) {
    IntegrationOptions options;
    options.method = method;
    options.observer = observer;
    options.relative_tolerance = tolerance;
    std::string label;
    if (step_s > 0) {
      options.step_s = step_s;
      label = fmt::format("step {:g} s", step_s);
    } else {
      label = fmt::format("tolerance {:.0e}", tolerance);
    }
    entries.push_back({label, options, {}, 0, 0, 0, {}});
  };
  for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial})
    for (const double tolerance : {1e-10, 1e-12, 1e-14}) add(Method::rkf78, observer, tolerance, 0);
  for (const double tolerance : {1e-10, 1e-12, 1e-14}) add(Method::bulirsch_stoer, Observer::laboratory, tolerance, 0);
  for (const double tolerance : {1e-10, 1e-12, 1e-14}) add(Method::extrapolation, Observer::laboratory, tolerance, 0);
  for (const double tolerance : {1e-8, 1e-10, 1e-12}) add(Method::dopri5, Observer::laboratory, tolerance, 0);
  for (const double step : {1e-3, 5e-4, 2.5e-4}) add(Method::abm8, Observer::laboratory, 0, step);

  const auto problem = make_problem<double>(scenario);
  IntegrationOptions exact_options;
  exact_options.observer = Observer::inertial;
  exact_options.method = Method::extrapolation;
  exact_options.relative_tolerance = 1e-22;
  const auto exact = integrate_drift(make_problem<float128>(scenario), exact_options);

  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (Entry& entry : entries) {
      const auto start = std::chrono::steady_clock::now();
      const auto trajectory = integrate_drift(problem, entry.options);
      entry.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      entry.counters = trajectory.counters;
      if (repetition == 0) compare(trajectory, exact, entry);
    }

  fmt::print("{}, {:g} s, {} repetitions, one core\n\n", name, scenario.duration_s, repetitions);
  fmt::print(
      "| method | observer | | milliseconds | evaluations | error of the axis drift, of its largest | attitude error (rad) "
      "|\n");
  fmt::print("| --- | --- | --- | ---: | ---: | ---: | ---: |\n");
  for (const Entry& entry : entries)
    fmt::print("| {} | {} | {} | {:.1f} | {} | {:.1e} | {:.1e} |\n", to_string(entry.options.method),
               to_string(entry.options.observer), entry.label, 1e3 * median(entry.seconds), entry.counters.evaluations,
               entry.axis_drift_error / entry.drift_largest, entry.attitude_error);
}
