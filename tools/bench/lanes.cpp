// SPDX-License-Identifier: GPL-3.0-or-later
/// Points per second on one core: batches of toy tops in SIMD lanes compared with the scalar series and with odeint. The
/// contenders take turns in one program; each is listed with its largest error, measured against long double. Prints Markdown.
///
/// earthtop-lanes [POINTS [ROUNDS]]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/drift_lanes.hpp"
#include "earthtop/integrate/motion_lanes.hpp"
#include "earthtop/run_batch.hpp"
#include "earthtop/scene/scene.hpp"

namespace {

using namespace earthtop;

constexpr double kAxisError = 1e-9;  // rad; the error that no contender may exceed

/// Toy tops over one minute, all different in spin, tilt and latitude.
std::vector<Scenario> toy_tops(std::size_t count, double output_step_s) {
  const Scenario shipped = parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json"));
  std::vector<Scenario> scenes(count, shipped);
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    scenes[i].release.spin_rad_s = 190 + 20 * part;
    scenes[i].release.tilt_deg = 18 + 4 * std::fmod(7.3 * part, 1);
    scenes[i].site.latitude_deg = -80 + 160 * std::fmod(31.7 * part, 1);
    scenes[i].output_step_s = output_step_s;
  }
  return scenes;
}

/// Scenes of which nothing is computed yet: resolving them is part of a run.
std::vector<Scene> fresh(const std::vector<Scenario>& scenarios) { return {scenarios.begin(), scenarios.end()}; }

template <class T>
std::vector<DriftProblem<T>> problems_of(const std::vector<Scenario>& scenes) {
  std::vector<DriftProblem<T>> problems;
  problems.reserve(scenes.size());
  for (const Scenario& scene : scenes) problems.push_back(Scene(scene).problem<T>());
  return problems;
}

IntegrationOptions numerics(Method method, Observer observer, ModelForm form, double tolerance) {
  IntegrationOptions options;
  options.method = method;
  options.observer = observer;
  options.form = form;
  options.relative_tolerance = tolerance;
  return options;
}

/// One way to integrate points: `integrate` computes the given number of points, and `error` returns the largest error of them
/// (rad).
struct Contender {
  std::string name;
  std::size_t points;  ///< points per round; fewer for slow contenders
  std::function<void(std::size_t)> integrate;
  std::function<double()> error;
  double seconds_a_point = 1e9;
};

/// The axes of a batch at the end, computed in long double.
class MotionReference {
 public:
  explicit MotionReference(const std::vector<Scenario>& scenes) {
    const IntegrationOptions fine = numerics(Method::taylor, Observer::laboratory, ModelForm::reduced, 1e-18);
    for (const auto& problem : problems_of<float80>(scenes))
      axes_.push_back(axis(integrate_motion<float80>(problem, fine, MotionSought::symmetry_axis)));
  }
  double largest_error(std::span<const MotionTrajectory<double>> trajectories) const {
    float80 largest = 0;
    for (std::size_t i = 0; i < trajectories.size(); ++i) {
      if (trajectories[i].status != RunStatus::completed) return HUGE_VAL;
      largest = std::max(largest, norm(Vec3<float80>(axis(trajectories[i]) - axes_[i])));
    }
    return static_cast<double>(largest);
  }

 private:
  template <class T>
  static Vec3<float80> axis(const MotionTrajectory<T>& trajectory) {
    return rotation_matrix(trajectory.samples.back().q_LB).col(2).template cast<float80>();
  }
  std::vector<Vec3<float80>> axes_;
};

/// The drift of a batch at every row, computed in long double.
class DriftReference {
 public:
  explicit DriftReference(const std::vector<Scenario>& scenes) {
    const IntegrationOptions fine = numerics(Method::taylor, Observer::laboratory, ModelForm::reduced, 1e-18);
    for (const auto& problem : problems_of<float80>(scenes)) {
      std::vector<double> drift;
      for (const auto& sample : integrate_drift<float80>(problem, fine).samples)
        drift.push_back(static_cast<double>(sample.measures.axis));
      drifts_.push_back(drift);
    }
  }
  double largest_error(std::span<const DriftTrajectory<double>> trajectories) const {
    double largest = 0;
    for (std::size_t i = 0; i < trajectories.size(); ++i)
      for (std::size_t row = 0; row < drifts_[i].size(); ++row)
        largest = std::max(largest, std::abs(trajectories[i].samples.at(row).measures.axis - drifts_[i][row]));
    return largest;
  }
  double largest_error(std::span<const RunResult> results) const {
    double largest = 0;
    for (std::size_t i = 0; i < results.size(); ++i)
      for (std::size_t row = 0; row < drifts_[i].size(); ++row)
        largest = std::max(largest, std::abs(results[i].rows.at(row).drift_axis_rad - drifts_[i][row]));
    return largest;
  }

 private:
  std::vector<std::vector<double>> drifts_;
};

/// Runs all contenders in turns, and counts the fastest round of each. Prints their rates and the ratios to those marked by
/// `against`.
void race(const char* title, std::vector<Contender>& contenders, int rounds, std::span<const std::size_t> against) {
  for (int round = 0; round < rounds; ++round)
    for (Contender& c : contenders) {
      const auto start = std::chrono::steady_clock::now();
      c.integrate(c.points);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      c.seconds_a_point = std::min(c.seconds_a_point, seconds / static_cast<double>(c.points));
    }
  fmt::print("\n| {} | points | points a second | largest error, rad |", title);
  for (const std::size_t i : against) fmt::print(" times {} |", contenders[i].name);
  fmt::print("\n| --- | ---: | ---: | ---: |");
  for (std::size_t i = 0; i < against.size(); ++i) fmt::print(" ---: |");
  for (const Contender& c : contenders) {
    fmt::print("\n| {} | {} | {:.1f} | {:.1e} |", c.name, c.points, 1 / c.seconds_a_point, c.error());
    for (const std::size_t i : against) fmt::print(" {:.1f} |", contenders[i].seconds_a_point / c.seconds_a_point);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

/// The loosest tolerance (1e-6 divided by powers of two) at which the error over a few points is well below the one allowed.
double loosest_tolerance(const std::function<double(double tolerance)>& error) {
  for (double tolerance = 1e-6; tolerance > 2e-14; tolerance /= 2)
    if (error(tolerance) < 0.3 * kAxisError) return tolerance;
  return 1e-14;
}

void race_motions(std::size_t count, int rounds) {
  const std::vector<Scenario> scenes = toy_tops(count, 60);
  const auto drifts = problems_of<double>(scenes);
  const std::vector<MotionProblem<double>> problems(drifts.begin(), drifts.end());
  const MotionReference reference(scenes);
  const std::size_t some = std::min<std::size_t>(count, 16), few = std::min<std::size_t>(count, 48);
  std::vector<MotionTrajectory<double>> made;
  const auto scalar = [&](const IntegrationOptions& options, MotionSought sought, std::size_t n) {
    made.clear();
    for (std::size_t i = 0; i < n; ++i) made.push_back(integrate_motion(problems[i], options, sought));
  };
  const auto error = [&] { return reference.largest_error(made); };
  const auto rkf78 = [](double tolerance) { return numerics(Method::rkf78, Observer::body, ModelForm::general, tolerance); };
  const auto taylor = [](double tolerance) {
    return numerics(Method::taylor, Observer::laboratory, ModelForm::reduced, tolerance);
  };
  const double of_rkf78 = loosest_tolerance([&](double tolerance) {
    scalar(rkf78(tolerance), MotionSought::attitude, some);
    return error();
  });
  const double of_taylor = loosest_tolerance([&](double tolerance) {
    scalar(taylor(tolerance), MotionSought::symmetry_axis, few);
    const double of_scalar = error();
    made = integrate_motion_in_lanes(std::span(problems).first(few), taylor(tolerance), MotionSought::symmetry_axis);
    return std::max(of_scalar, error());
  });

  std::vector<Contender> contenders;
  std::vector<double> errors;
  const auto add = [&](std::string name, std::size_t n, const std::function<void(std::size_t)>& integrate) {
    const std::size_t i = contenders.size();
    errors.push_back(0);
    contenders.push_back({std::move(name), n,
                          [&made, integrate](std::size_t points) {
                            made.clear();
                            integrate(points);
                          },
                          [&errors, i] { return errors[i]; }});
  };
  add(fmt::format("rkf78 {:.1e}, full model", of_rkf78), few,
      [&](std::size_t n) { scalar(rkf78(of_rkf78), MotionSought::attitude, n); });
  add(fmt::format("taylor {:.1e}, scalar", of_taylor), count,
      [&](std::size_t n) { scalar(taylor(of_taylor), MotionSought::symmetry_axis, n); });
  for (const InstructionSet set : instruction_sets())
    add(fmt::format("taylor {:.1e}, lanes, {}", of_taylor, to_string(set)), count, [&, set](std::size_t n) {
      made =
          integrate_motion_in_lanes(std::span(problems).first(n), taylor(of_taylor), MotionSought::symmetry_axis, nullptr, set);
    });
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    contenders[i].integrate(contenders[i].points);
    errors[i] = error();
  }
  race("motion, the axis after a minute", contenders, rounds, std::vector<std::size_t>{0, 1});
}

void race_drifts(std::size_t count, int rounds) {
  const std::vector<Scenario> scenes = toy_tops(count, 0.1);
  const auto problems = problems_of<double>(scenes);
  const DriftReference reference(scenes);
  std::vector<DriftTrajectory<double>> made;
  std::vector<Contender> contenders;
  std::vector<double> errors;
  const auto add = [&](std::string name, const std::function<void()>& integrate, const std::function<double()>& error) {
    integrate();
    const double largest = error();
    contenders.push_back({std::move(name), count, [integrate](std::size_t) { integrate(); }, [largest] { return largest; }});
  };
  const auto error = [&] { return reference.largest_error(made); };
  const auto options = numerics(Method::taylor, Observer::laboratory, ModelForm::reduced, 1e-12);
  add(
      "taylor, scalar",
      [&] {
        made.clear();
        for (const auto& problem : problems) made.push_back(integrate_drift(problem, options));
      },
      error);
  for (const Observer observer : {Observer::laboratory, Observer::inertial})
    for (const InstructionSet set : instruction_sets()) {
      IntegrationOptions in_lanes = options;
      in_lanes.observer = observer;
      add(
          fmt::format("taylor, lanes, {} axes, {}", to_string(observer), to_string(set)),
          [&, in_lanes, set] { made = integrate_drift_in_lanes(problems, in_lanes, nullptr, set); }, error);
    }
  race("drift, 601 rows, at 1e-12", contenders, rounds, std::vector<std::size_t>{0});

  std::vector<RunResult> results;
  contenders.clear();
  const auto error_of_results = [&] { return reference.largest_error(std::span<const RunResult>(results)); };
  add(
      "run",
      [&] {
        results.clear();
        for (const Scenario& scene : scenes) results.push_back(run(scene));
      },
      error_of_results);
  add(
      "run_batch",
      [&] {
        results.clear();
        for (BatchOutcome& outcome : run_batch(fresh(scenes))) results.push_back(std::move(*outcome.result));
      },
      error_of_results);
  race("whole run, 601 rows, bounds and verdict", contenders, rounds, std::vector<std::size_t>{0});
}

/// Asymmetric tops over ten seconds, in body axes; the scalar series is the reference for the others.
void race_asymmetric_tops(std::size_t count, int rounds) {
  const Scenario shipped = parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/asymmetric-top.json"));
  std::vector<Scenario> scenes(count, shipped);
  for (std::size_t i = 0; i < count; ++i)
    scenes[i].release.spin_rad_s *= 1 + 0.05 * static_cast<double>(i) / static_cast<double>(count);
  const auto problems = problems_of<double>(scenes);
  const auto body = numerics(Method::taylor, Observer::body, ModelForm::general, 1e-12);
  std::vector<DriftTrajectory<double>> scalar, made;
  for (const auto& problem : problems) scalar.push_back(integrate_drift(problem, body));
  const auto difference = [&] {
    double largest = 0;
    for (std::size_t i = 0; i < made.size(); ++i)
      largest = std::max(largest, std::abs(made[i].samples.back().measures.axis - scalar[i].samples.back().measures.axis));
    return largest;
  };
  std::vector<Contender> contenders;
  const auto add = [&](std::string name, const std::function<void()>& integrate) {
    integrate();
    const double largest = difference();
    contenders.push_back({std::move(name), count, [integrate](std::size_t) { integrate(); }, [largest] { return largest; }});
  };
  add("taylor, scalar", [&] {
    made.clear();
    for (const auto& problem : problems) made.push_back(integrate_drift(problem, body));
  });
  for (const Observer observer : {Observer::body, Observer::inertial})
    for (const InstructionSet set : instruction_sets()) {
      IntegrationOptions in_lanes = body;
      in_lanes.observer = observer;
      add(fmt::format("taylor, lanes, {} equations, {}", to_string(observer), to_string(set)),
          [&, in_lanes, set] { made = integrate_drift_in_lanes(problems, in_lanes, nullptr, set); });
    }
  race("asymmetric top, drift at 1e-12; errors: from the scalar series", contenders, rounds, std::vector<std::size_t>{0});

  contenders.clear();
  made.clear();  // runs must not leave any
  add("run", [&] {
    for (const Scenario& scene : scenes) run(scene);
  });
  add("run_batch", [&] { run_batch(fresh(scenes)); });
  race("asymmetric top, whole run", contenders, rounds, std::vector<std::size_t>{0});
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::size_t>(argc > 1 ? std::atol(argv[1]) : 1000);
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  fmt::print("Toy tops of 60 s, each with its own spin, tilt and latitude; one core; the fastest of {} rounds.\n", rounds);
  race_motions(count, rounds);
  race_drifts(std::min<std::size_t>(count, 128), rounds);
  race_asymmetric_tops(std::min<std::size_t>(count, 128), rounds);
}
