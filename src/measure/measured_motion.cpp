// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/measured_motion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scenario/support.hpp"
#include "earthtop/vectors.hpp"
#include "scene/caged_top.hpp"

namespace earthtop::measure {
namespace {

double horizontal_part(const Vec3<double>& n_L) { return real::hypot(n_L[0], n_L[1]); }
double tilt_of(const Vec3<double>& n_L) { return real::atan2(horizontal_part(n_L), n_L[2]); }
double azimuth_of(const Vec3<double>& n_L) {
  return horizontal_part(n_L) > 0 ? real::atan2(n_L[0], n_L[1]) : std::numeric_limits<double>::quiet_NaN();
}

/// The angle reduced by whole turns to -pi to pi (rad).
double folded(double angle) { return std::remainder(angle, kWholeTurn); }

/// The turn from the predicted axis p to the measured axis m, as its components (rad) along growing tilt and along growing
/// azimuth at m; along North and East where m is vertical. (p x m) x m points from p to m at m, and its length is the sine of
/// the angle between them: no digits cancel where the axes are close.
std::array<double, 2> turn_to(const Vec3<double>& m_L, const Vec3<double>& p_L) {
  const double horizontal = horizontal_part(m_L);
  const double east = horizontal > 0 ? m_L[0] / horizontal : 0, north = horizontal > 0 ? m_L[1] / horizontal : 1;
  const Vec3<double> down_L(m_L[2] * east, m_L[2] * north, -horizontal), clockwise_L(north, -east, 0);
  const Vec3<double> cross_L = p_L.cross(m_L);
  const double sine = norm(cross_L), angle = real::atan2(sine, p_L.dot(m_L));
  if (!(sine > 0)) return {angle, 0};
  const Vec3<double> along_L = cross_L.cross(m_L);
  return {angle * along_L.dot(down_L) / sine, angle * along_L.dot(clockwise_L) / sine};
}

/// Changes a scenario so that it runs to `end_s` in double precision, and asks for nothing but the motion.
void prepare(Scenario& scenario, double end_s) {
  if (end_s > 0) scenario.duration_s = end_s;
  scenario.output_step_s = scenario.duration_s;
  scenario.threshold_rad.reset();
  scenario.accuracy_rad.reset();
  scenario.uncertainty.reset();
  scenario.ledger.reset();
  scenario.sensitivities = false;
  scenario.precision = Precision::bits53;
  scenario.numerics.relative_tolerance = default_tolerance(Precision::bits53);
}

/// Adds the residuals of measured values to a list: two for an axis, one for any other quantity.
class RowResiduals {
 public:
  RowResiduals(const Measurement& measurement, std::vector<MeasurementResidual>& all) : measurement_(measurement), all_(all) {}

  void add(const MeasuredValue& value, const PredictedAxis& predicted) {
    const Vec3<double>& n_L = predicted.n_L;
    switch (value.quantity) {
      case MeasuredQuantity::azimuth:
        require_azimuth(value, horizontal_part(n_L) > 0);
        return append(value, "azimuth", value.value, azimuth_of(n_L), folded(value.value - azimuth_of(n_L)));
      case MeasuredQuantity::tilt: return append(value, "tilt", value.value, tilt_of(n_L), value.value - tilt_of(n_L));
      case MeasuredQuantity::drift_azimuth: {
        require_azimuth(value, predicted.drift_azimuth_rad.has_value());
        const double azimuth = predicted.drift_azimuth_rad.value_or(0);
        return append(value, "drift_azimuth", value.value, azimuth, folded(value.value - azimuth));
      }
      case MeasuredQuantity::drift_tilt:
        return append(value, "drift_tilt", value.value, predicted.drift_tilt_rad, value.value - predicted.drift_tilt_rad);
      case MeasuredQuantity::rotor_rate:
      case MeasuredQuantity::outer_angle:
      case MeasuredQuantity::inner_angle: {
        const PartQuantity& part = *part_quantity(value.quantity);
        const std::optional<double>& there = predicted.*part.predicted;
        if (!there)
          refuse(value,
                 fmt::format("{} was measured, and {}, or leave the column out", to_string(value.quantity), part.missing));
        return append(value, to_string(value.quantity), value.value, *there, value.value - *there);
      }
      case MeasuredQuantity::axis: {
        const Vec3<double> m_L(value.axis_L[0], value.axis_L[1], value.axis_L[2]);
        const auto [along_tilt, along_azimuth] = turn_to(m_L, n_L);
        append(value, "axis_tilt", tilt_of(m_L), tilt_of(n_L), along_tilt);
        return append(value, "axis_azimuth", azimuth_of(m_L), azimuth_of(n_L), along_azimuth);
      }
    }
  }

  [[noreturn]] void refuse(const MeasuredValue& value, std::string message) const {
    throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(value.line), 1, "", std::move(message)}}, measurement_.file);
  }

 private:
  void require_azimuth(const MeasuredValue& value, bool defined) const {
    if (defined) return;
    refuse(value, fmt::format("at {:g} s the predicted axis is vertical and has no azimuth; leave the cell empty, or measure "
                              "axis_L_x, _y, _z",
                              value.t_s));
  }
  void append(const MeasuredValue& value, std::string_view quantity, double measured, double predicted, double residual) {
    all_.push_back({value.t_s, value.line, quantity, measured, predicted, residual, value.standard_error});
  }

  const Measurement& measurement_;
  std::vector<MeasurementResidual>& all_;
};

}  // namespace

const PartQuantity* part_quantity(MeasuredQuantity quantity) {
  const auto row = std::ranges::find(kPartQuantities, quantity, &PartQuantity::quantity);
  return row == std::end(kPartQuantities) ? nullptr : &*row;
}
const PartQuantity* part_quantity(std::string_view name) {
  for (const PartQuantity& row : kPartQuantities)
    if (to_string(row.quantity) == name) return &row;
  return nullptr;
}

std::vector<double> measured_times(const Measurement& measurement) {
  std::vector<double> times = {0};
  for (const MeasuredValue& value : measurement.values)
    if (value.t_s > times.back()) times.push_back(value.t_s);
  return times;
}

std::vector<CurvePoint> angles_of(const PredictedMotion& motion, bool drift) {
  constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
  std::vector<CurvePoint> points;
  points.reserve(motion.axes.size());
  for (const PredictedAxis& axis : motion.axes)
    points.push_back({axis.t_s, azimuth_of(axis.n_L), tilt_of(axis.n_L),
                      drift ? axis.drift_azimuth_rad.value_or(kNotMeasured) : kNotMeasured,
                      drift ? axis.drift_tilt_rad : kNotMeasured, axis.rotor_rate_rad_s.value_or(kNotMeasured),
                      axis.outer_angle_rad.value_or(kNotMeasured), axis.inner_angle_rad.value_or(kNotMeasured)});
  return points;
}

bool has_drifts(const Measurement& measurement) {
  return std::any_of(measurement.values.begin(), measurement.values.end(), [](const MeasuredValue& value) {
    return value.quantity == MeasuredQuantity::drift_azimuth || value.quantity == MeasuredQuantity::drift_tilt;
  });
}

namespace {

PredictedMotion predicted_axes(const Scene& measured, const std::vector<double>& times_s, bool drift, const Watch& watch) {
  Scenario scenario = measured.scenario();
  prepare(scenario, times_s.back());
  // The choice of the method depends on the number of rows.
  scenario.output_step_s = scenario.duration_s / static_cast<double>(std::max<std::size_t>(times_s.size() - 1, 1));
  const Scene scene(std::move(scenario));
  scene.require_integrable();
  scene.require_affordable();
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = times_s;
  const IntegrationOptions& options = scene.choice().options;
  PredictedMotion predicted;
  predicted.axes.reserve(times_s.size());
  // A motion that dry friction brings to rest is held at rest where drifts are computed; a driven symmetric top has its
  // equations without the spin there; a top on a table, and the rotor of a gyrostat, have all of their equations there.
  const bool is_driven_top = !scene.is_plain() && scene.form(options) == ModelForm::reduced;
  if (drift || is_driven_top || scene.support().has_moving_parts() || !scene.support().no_motion_alone.empty() ||
      scene.scenario().effects.applied.coulomb_N_m != 0) {
    const DriftTrajectory<double> motion = integrate_drift(problem, options, watch);
    predicted.status = motion.status;
    for (const DriftSample<double>& sample : motion.samples) {
      PredictedAxis axis{sample.state.t_s, rotation_matrix(sample.state.q_LB).col(2), sample.measures.tilt, {}, {}, {}, {}};
      if (sample.measures.azimuth_defined) axis.drift_azimuth_rad = sample.azimuth;
      if (sample.rotor) axis.rotor_rate_rad_s = sample.rotor->rate;
      if (sample.gimbals) axis.outer_angle_rad = sample.gimbals->outer.rot, axis.inner_angle_rad = sample.gimbals->inner.rot;
      predicted.axes.push_back(axis);
    }
    for (const ContactEvent& event : motion.contact_events)
      if (ends_run(event.kind) && predicted.axes.size() < times_s.size()) predicted.end = event;
    return predicted;
  }
  const bool axis_alone = scene.symmetry_axis() == 2;
  const MotionTrajectory<double> motion =
      integrate_motion(problem, options, axis_alone ? MotionSought::symmetry_axis : MotionSought::attitude, watch);
  predicted.status = motion.status;
  for (const MotionSample<double>& sample : motion.samples)
    predicted.axes.push_back({sample.t_s, rotation_matrix(sample.q_LB).col(2), 0, {}, {}, {}, {}});
  return predicted;
}

}  // namespace

PredictedMotion predict(const Scene& scene, const std::vector<double>& times_s, bool drift, const Watch& watch) {
  PredictedMotion predicted = predicted_axes(scene, times_s, drift, watch);
  if (!is_caged_top(scene.scenario())) return predicted;
  const CagedTop<double> cage(scene.scenario());
  for (PredictedAxis& axis : predicted.axes) axis.rotor_rate_rad_s = cage.rotor_rate(axis.t_s);
  return predicted;
}

bool is_beyond_prediction(const VerdictReport& verdict, double until_s) {
  const bool grows = verdict.verdict == Verdict::unstable || verdict.verdict == Verdict::chaotic;
  return grows && verdict.from_s && *verdict.from_s <= until_s;
}

std::string words_on_end(const ContactEvent& event) {
  return fmt::format("at {:.6g} s {}", event.t_s, type_of(event.kind).words);
}

JudgedMotion judged_motion(const Scene& measured, double end_s, const Watch& watch) {
  constexpr double kLooks = 200;  // number of times at which bounds are checked
  Scenario scenario = measured.scenario();
  prepare(scenario, end_s);
  scenario.output_step_s = scenario.duration_s / kLooks;
  const RunResult result = run(resolve(std::move(scenario)), {watch, false});
  return {result.status, result.reached_s, result.verdict};
}

std::vector<MeasurementResidual> residuals_of(const Measurement& measurement, const PredictedMotion& motion) {
  std::vector<MeasurementResidual> residuals;
  residuals.reserve(2 * measurement.values.size());
  RowResiduals rows(measurement, residuals);
  std::size_t at = 0;
  for (const MeasuredValue& value : measurement.values) {
    while (at < motion.axes.size() && motion.axes[at].t_s < value.t_s) ++at;
    if (at == motion.axes.size() && motion.end) rows.refuse(value, words_on_end(*motion.end) + "; leave out later rows");
    if (at == motion.axes.size()) break;
    rows.add(value, motion.axes[at]);
  }
  return residuals;
}

double period_of(const MeasurementResidual& residual) {
  return residual.quantity == "azimuth" || residual.quantity == "drift_azimuth" ? kWholeTurn : 0;
}

}  // namespace earthtop::measure
