// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/measured_motion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

constexpr double kDegree = std::numbers::pi / 180;

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
    switch (value.quantity) {
      case MeasuredQuantity::azimuth:
        require_azimuth(value, !std::isnan(predicted.azimuth_rad));
        return append(value, "azimuth", value.value, predicted.azimuth_rad, folded(value.value - predicted.azimuth_rad));
      case MeasuredQuantity::tilt:
        return append(value, "tilt", value.value, predicted.tilt_rad, value.value - predicted.tilt_rad);
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
        const Vec3<double> m_M(value.axis_L[0], value.axis_L[1], value.axis_L[2]);
        const auto [along_tilt, along_azimuth] = turn_to(m_M, predicted.n_M);
        append(value, "axis_tilt", tilt_of(m_M), tilt_of(predicted.n_M), along_tilt);
        return append(value, "axis_azimuth", azimuth_of(m_M), azimuth_of(predicted.n_M), along_azimuth);
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
    points.push_back({axis.t_s, axis.azimuth_rad, axis.tilt_rad,
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

/// The scene to these times of the motion.
Scene scene_to_predict(const Scene& measured, const std::vector<double>& times_s, std::optional<Method> method) {
  Scenario scenario = measured.scenario();
  prepare(scenario, times_s.back());
  // The choice of the method depends on the number of rows.
  scenario.output_step_s = scenario.duration_s / static_cast<double>(std::max<std::size_t>(times_s.size() - 1, 1));
  if (method) scenario.numerics.method = *method;
  return Scene(std::move(scenario));
}

PredictedMotion predicted_axes(const Scene& measured, const std::vector<double>& times_s, bool drift, const Watch& watch,
                               std::optional<Method> method) {
  const Scene scene = scene_to_predict(measured, times_s, method);
  scene.require_integrable();
  scene.require_affordable();
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = times_s;
  const IntegrationOptions& options = scene.choice().options;
  PredictedMotion predicted;
  predicted.axes.reserve(times_s.size());
  // A motion that dry friction brings to rest is held at rest where drifts are computed; a driven symmetric top whose axis has no
  // equations of its own has those without the spin there; a top on a table, and the rotor of a gyrostat, have all of their equations
  // there.
  const bool axis_alone = scene.symmetry_axis() == 2;
  const bool is_driven_top = !scene.is_plain() && scene.form(options) == ModelForm::reduced &&
                             !(axis_alone && has_axis_motion(problem.model, options));
  if (drift || is_driven_top || scene.support().has_moving_parts() || !scene.support().no_motion_alone.empty() ||
      scene.scenario().effects.applied.coulomb_N_m != 0) {
    const DriftTrajectory<double> motion = integrate_drift(problem, options, watch);
    predicted.status = motion.status;
    for (const DriftSample<double>& sample : motion.samples) {
      PredictedAxis axis{.t_s = sample.state.t_s, .n_M = rotation_matrix(sample.state.q_LB).col(2)};
      axis.drift_tilt_rad = sample.measures.tilt;
      if (sample.measures.azimuth_defined) axis.drift_azimuth_rad = sample.azimuth;
      if (sample.rotor) axis.rotor_rate_rad_s = sample.rotor->rate;
      if (sample.gimbals) axis.outer_angle_rad = sample.gimbals->outer.rot, axis.inner_angle_rad = sample.gimbals->inner.rot;
      predicted.axes.push_back(axis);
    }
    for (const ContactEvent& event : motion.contact_events)
      if (ends_run(event.kind) && predicted.axes.size() < times_s.size()) predicted.end = event;
    return predicted;
  }
  const MotionTrajectory<double> motion =
      integrate_motion(problem, options, axis_alone ? MotionSought::symmetry_axis : MotionSought::attitude, watch);
  predicted.status = motion.status;
  for (const MotionSample<double>& sample : motion.samples)
    predicted.axes.push_back({.t_s = sample.t_s, .n_M = rotation_matrix(sample.q_LB).col(2)});
  return predicted;
}

}  // namespace

void read_angles(PredictedAxis& axis, const Scenario& scenario) {
  const Instrument instrument = scenario.instrument.value_or(Instrument());
  axis.azimuth_rad = instrument.reading(0, azimuth_of(axis.n_M));
  axis.tilt_rad = instrument.reading(1, tilt_of(axis.n_M));
}

namespace {

/// A vector v turned by a rotation vector, whose length is the angle (Rodrigues' formula).
Vec3<double> turned(const Vec3<double>& v, const Vec3<double>& turn) {
  const double angle = norm(turn);
  const SinCos<double> part = real::sin_cos(angle);
  const Vec3<double> axis = turn / angle;
  return part.cos * v + part.sin * axis.cross(v) + (1 - part.cos) * axis.dot(v) * axis;
}

/// Replaces a motion's axis in the laboratory, and what else is measured, by what the instrument makes of it.
void read_by_instrument(PredictedAxis& axis, const Scenario& scenario) {
  using enum InstrumentInput;
  if (scenario.instrument) {
    const Instrument& instrument = *scenario.instrument;
    const Vec3<double> turn_L = kDegree * Vec3<double>(instrument[turn_east], instrument[turn_north], instrument[turn_up]);
    if (norm(turn_L) > 0) axis.n_M = turned(axis.n_M, turn_L);
    if (axis.rotor_rate_rad_s)
      *axis.rotor_rate_rad_s = instrument[rotor_rate_bias] + instrument[rotor_rate_scale] * *axis.rotor_rate_rad_s;
    if (axis.outer_angle_rad) *axis.outer_angle_rad = instrument.reading(2, *axis.outer_angle_rad);
    if (axis.inner_angle_rad) *axis.inner_angle_rad = instrument.reading(3, *axis.inner_angle_rad);
  }
  read_angles(axis, scenario);
}

}  // namespace

namespace {

/// The times of the motion (s), and the place among them of each time that the instrument's clock shows.
std::pair<std::vector<double>, std::vector<std::size_t>> times_of_motion(const Scene& scene,
                                                                         const std::vector<double>& times_s) {
  const Instrument instrument = scene.scenario().instrument.value_or(Instrument());
  std::pair<std::vector<double>, std::vector<std::size_t>> found({0}, {});
  auto& [motion_times_s, places] = found;
  for (const double t_s : times_s) {
    const double of_motion_s = instrument.time_of_motion_s(t_s);
    if (of_motion_s > motion_times_s.back()) motion_times_s.push_back(of_motion_s);
    places.push_back(motion_times_s.size() - 1);
  }
  return found;
}

}  // namespace

Method method_of_prediction(const Scene& scene, const std::vector<double>& times_s) {
  return scene_to_predict(scene, times_of_motion(scene, times_s).first, {}).choice().options.method;
}

PredictedMotion predict(const Scene& scene, const std::vector<double>& times_s, bool drift, const Watch& watch,
                        std::optional<Method> method) {
  const auto [motion_times_s, places] = times_of_motion(scene, times_s);
  PredictedMotion motion = predicted_axes(scene, motion_times_s, drift, watch, method);
  if (is_caged_top(scene.scenario())) {
    const CagedTop<double> cage(scene.scenario());
    for (PredictedAxis& axis : motion.axes) axis.rotor_rate_rad_s = cage.rotor_rate(axis.t_s);
  }
  for (PredictedAxis& axis : motion.axes) read_by_instrument(axis, scene.scenario());
  PredictedMotion read{motion.status, {}, motion.end};
  read.axes.reserve(times_s.size());
  for (std::size_t k = 0; k < times_s.size() && places[k] < motion.axes.size(); ++k) {
    read.axes.push_back(motion.axes[places[k]]);
    read.axes.back().t_s = times_s[k];
  }
  return read;
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
