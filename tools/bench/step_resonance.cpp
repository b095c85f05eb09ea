// SPDX-License-Identifier: GPL-3.0-or-later
/// Error of the composition methods as a function of the step, which is varied in small steps of 1 %: a resonance of the step
/// with the nutation would show as a spike. Writes an SVG to standard output.
///
/// earthtop-step-resonance [SCENARIO [SECONDS]] SCENARIO: name of a shipped scenario

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/plot/plot.hpp"
#include "earthtop/scene/scene.hpp"
#include "integrate/compositions.hpp"

namespace {

using namespace earthtop;

Vec3<double> axis_at_end(const DriftProblem<double>& problem, const IntegrationOptions& options) {
  const auto trajectory = integrate_motion(problem, options, MotionSought::symmetry_axis);
  if (trajectory.status != RunStatus::completed) return Vec3<double>::Constant(std::nan(""));
  return rotation_matrix(trajectory.samples.back().q_LB).col(2);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "fast-gyro";
  Scenario scenario = parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json"));
  scenario.duration_s = scenario.output_step_s = argc > 2 ? std::atof(argv[2]) : 10;
  const auto problem = Scene(scenario).problem<double>();
  const ReducedTop<double> top = reduced_top(problem.model);
  const double nutation_rad_s = std::abs(problem.release.w_XB_B[top.axis]) * top.I3 / top.I1;

  IntegrationOptions options;
  options.form = ModelForm::reduced;
  options.method = Method::extrapolation;
  options.relative_tolerance = 1e-14;
  const Vec3<double> exact = axis_at_end(problem, options);

  constexpr LineColor kColors[] = {LineColor::grey,  LineColor::sky,        LineColor::blue,
                                   LineColor::green, LineColor::vermillion, LineColor::purple};
  Figure figure;
  figure.title = "Axis error against the step of a splitting, swept by 1 %";
  figure.subtitle = fmt::format("{}, {:g} s; step in radians of nutation ({:.0f} rad/s); a whole nutation is 6.28",
                                scenario.title, scenario.duration_s, nutation_rad_s);
  figure.x = {"step", "rad of nutation", AxisScale::logarithmic};
  figure.panels.push_back({{"error of the axis", "rad", AxisScale::logarithmic}, {}});
  options.method = Method::splitting;
  for (const CompositionTable& table : kCompositionTables) {
    options.composition = table.name;
    Line line;
    line.label = to_string(table.name);
    line.color = kColors[figure.panels[0].lines.size()];
    double steps_before = 0;
    for (double phase = 0.3; phase < 8; phase *= 1.01) {
      const double steps = std::ceil(scenario.duration_s * nutation_rad_s / phase);
      if (steps == steps_before) continue;
      steps_before = steps;
      options.step_s = scenario.duration_s / steps * (1 + 1e-13);
      line.x.push_back(scenario.duration_s * nutation_rad_s / steps);
      line.y.push_back(norm(Vec3<double>(axis_at_end(problem, options) - exact)));
    }
    figure.panels[0].lines.push_back(line);
  }
  fmt::print("{}", svg(figure));
}
