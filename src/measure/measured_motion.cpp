// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/measured_motion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "earthtop/closed_form/swing.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/frames/earth.hpp"
#include "earthtop/scenario/support.hpp"
#include "earthtop/vectors.hpp"
#include "measure/features.hpp"
#include "measure/quantities.hpp"
#include "scene/caged_top.hpp"
#include "scene/motion_alone.hpp"
#include "scene/pendulum.hpp"

namespace earthtop::measure {
namespace {

double horizontal_part(const Vec3<double>& n_L) { return real::hypot(n_L[0], n_L[1]); }
double tilt_of(const Vec3<double>& n_L) { return real::atan2(horizontal_part(n_L), n_L[2]); }
double azimuth_of(const Vec3<double>& n_L) {
  return horizontal_part(n_L) > 0 ? real::atan2(n_L[0], n_L[1]) : std::numeric_limits<double>::quiet_NaN();
}

constexpr double kDegree = std::numbers::pi / 180;

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

/// Adds the residuals of measured values to a list: two for an axis, one for any other quantity.
class RowResiduals {
 public:
  RowResiduals(const Measurement& measurement, std::vector<MeasurementResidual>& all) : measurement_(measurement), all_(all) {}

  /// @param feature  of a value that is a turning point, a period or a passage
  void add(const MeasuredValue& value, const PredictedAxis& there, const PredictedFeature& feature) {
    const QuantityRow& row = row_of(value.quantity);
    if (value.quantity == MeasuredQuantity::axis) {
      const Vec3<double> m_M(value.axis_L[0], value.axis_L[1], value.axis_L[2]);
      const auto [along_tilt, along_azimuth] = turn_to(m_M, there.n_M);
      append(value, "axis_tilt", tilt_of(m_M), tilt_of(there.n_M), along_tilt);
      return append(value, "axis_azimuth", azimuth_of(m_M), azimuth_of(there.n_M), along_azimuth);
    }
    const double predicted = row.feature == Feature::value ? there[value.quantity] : feature.value;
    if (std::isnan(predicted)) {
      require_azimuth(value);
      refuse(value, fmt::format("{} was measured{}, and {}, or leave the {} out", row.name,
                                row.feature == Feature::turning ? fmt::format(" at {:g} s", value.t_s) : "", row.missing,
                                row.feature == Feature::turning ? "row" : "column"));
    }
    const double apart = value.value - predicted;
    append(value, row.name, value.value, predicted, row.period > 0 ? std::remainder(apart, row.period) : apart);
  }

  [[noreturn]] void refuse(const MeasuredValue& value, std::string message) const {
    throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(value.line), 1, "", std::move(message)}}, measurement_.file);
  }

 private:
  void require_azimuth(const MeasuredValue& value) const {
    if (value.quantity != MeasuredQuantity::azimuth && value.quantity != MeasuredQuantity::drift_azimuth) return;
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

std::vector<double> measured_times(const Measurement& measurement) {
  std::vector<double> times = {0};
  for (const MeasuredValue& value : measurement.values)
    if (value.t_s > times.back()) times.push_back(value.t_s);
  return times;
}

std::vector<CurvePoint> curve_of(const PredictedMotion& motion, const Measurement& measurement) {
  std::array<bool, kMeasuredQuantities> is_shown{};
  for (const MeasuredValue& value : measurement.values) is_shown[static_cast<std::size_t>(row_of(value.quantity).of)] = true;
  std::vector<CurvePoint> points;
  points.reserve(motion.axes.size());
  for (const PredictedAxis& axis : motion.axes) {
    CurvePoint& point = points.emplace_back(CurvePoint{axis.t_s});
    for (const QuantityRow& row : quantity_rows())
      if (row.shown || is_shown[static_cast<std::size_t>(row.quantity)]) show(point, row, axis[row.quantity]);
  }
  return points;
}

Sought sought_of(const Measurement& measurement) {
  using enum MeasuredQuantity;
  Sought sought;
  for (const MeasuredValue& value : measurement.values) {
    const MeasuredQuantity q = value.quantity;
    sought.drift = sought.drift || q == drift_azimuth || q == drift_tilt;
    sought.turned_rates = sought.turned_rates || (q >= w_LB_B_x && q <= w_IB_B_z);
    sought.tip = sought.tip || q == tip_L_x || q == tip_L_y;
    sought.swing = sought.swing || q == swing_azimuth || q == swing_major || q == swing_minor;
    sought.angle_rates = sought.angle_rates || row_of(q).feature != Feature::value;
    sought.rates = sought.rates || q == spin || sought.turned_rates || sought.swing || sought.angle_rates;
  }
  return sought;
}

double end_time_s(const MeasuredValue& value) {
  switch (row_of(value.quantity).feature) {
    case Feature::period: return value.t_s + value.value;
    case Feature::passage: return std::max(value.t_s, value.value);
    default: return value.t_s;
  }
}

double last_time_s(const Measurement& measurement) {
  double last_s = 0;
  for (const MeasuredValue& value : measurement.values) last_s = std::max(last_s, end_time_s(value));
  return last_s;
}

namespace {

/// The scene to these times of the motion.
Scene scene_to_predict(const Scene& measured, const std::vector<double>& times_s, std::optional<Method> method) {
  Scenario scenario = measured.scenario();
  ask_for_motion_alone(scenario, times_s.back());
  // The choice of the method depends on the number of rows.
  scenario.output_step_s = scenario.duration_s / static_cast<double>(std::max<std::size_t>(times_s.size() - 1, 1));
  if (method) scenario.numerics.method = *method;
  return Scene(std::move(scenario));
}

/// The rate of the laboratory along its own axes (rad/s).
Vec3<double> rate_IL_L(const Scene& scene) { return scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site()); }

constexpr MeasuredQuantity kFixedRates[] = {MeasuredQuantity::w_LB_B_x, MeasuredQuantity::w_LB_B_y, MeasuredQuantity::w_LB_B_z},
                           kInertialRates[] = {MeasuredQuantity::w_IB_B_x, MeasuredQuantity::w_IB_B_y,
                                               MeasuredQuantity::w_IB_B_z};

void put_rates(PredictedAxis& axis, const Vec3<double>& w_LB_B, const Vec3<double>& w_IB_B) {
  axis.w_LB_B = w_LB_B;
  axis[MeasuredQuantity::spin] = w_LB_B[2];
  for (int i = 0; i < 3; ++i) axis[kFixedRates[i]] = w_LB_B[i], axis[kInertialRates[i]] = w_IB_B[i];
}
Vec3<double> inertial_rate(const PredictedAxis& axis) {
  return {axis[kInertialRates[0]], axis[kInertialRates[1]], axis[kInertialRates[2]]};
}

/// Fills in what follows from attitude and rate. @param w_IL_L  the laboratory's rate
void take_rates(PredictedAxis& axis, const Quaternion<double>& q_LB, const Vec3<double>& w_LB_B, const Vec3<double>& w_IL_L) {
  const Mat3<double> R_LB = rotation_matrix(q_LB);
  axis.rate_M = R_LB * Vec3<double>(w_LB_B[1], -w_LB_B[0], 0);
  put_rates(axis, w_LB_B, w_LB_B + R_LB.transpose() * w_IL_L);
}

PredictedMotion predicted_axes(const Scene& measured, const std::vector<double>& times_s, const Sought& sought,
                               const Watch& watch, std::optional<Method> method) {
  using enum MeasuredQuantity;
  const Scene scene = scene_to_predict(measured, times_s, method);
  scene.require_integrable();
  scene.require_affordable();
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = times_s;
  const IntegrationOptions& options = scene.choice().options;
  const Vec3<double> w_IL_L = rate_IL_L(scene);
  PredictedMotion predicted;
  predicted.axes.reserve(times_s.size());
  // A motion that dry friction brings to rest is held at rest where drifts are computed; a driven symmetric top whose axis has no
  // equations of its own has those without the spin there; a top on a table, and the rotor of a gyrostat, have all of their equations
  // there.
  const bool axis_alone = scene.symmetry_axis() == 2 && !sought.turned_rates;
  const bool is_driven_top = !scene.is_plain() && scene.form(options) == ModelForm::reduced &&
                             !(axis_alone && has_axis_motion(problem.model, options));
  if (sought.drift || is_driven_top || scene.support().has_moving_parts() || !scene.support().no_motion_alone.empty() ||
      scene.scenario().effects.applied.coulomb_N_m != 0) {
    const DriftTrajectory<double> motion = integrate_drift(problem, options, watch);
    const Mat3<double> R_LH =
        problem.table ? rotation_matrix(problem.table->start.q_LH) : Mat3<double>(Mat3<double>::Identity());
    predicted.status = motion.status;
    for (const DriftSample<double>& sample : motion.samples) {
      PredictedAxis& axis = predicted.axes.emplace_back();
      axis.t_s = sample.state.t_s;
      axis.n_M = rotation_matrix(sample.state.q_LB).col(2);
      if (sought.drift) axis[drift_tilt] = sample.measures.tilt;
      if (sought.drift && sample.measures.azimuth_defined) axis[drift_azimuth] = sample.azimuth;
      if (sample.rotor) axis[rotor_rate] = sample.rotor->rate;
      if (sample.gimbals) {
        axis[outer_angle] = sample.gimbals->outer.rot, axis[inner_angle] = sample.gimbals->inner.rot;
        axis.rate_of(outer_angle) = sample.gimbals->outer_rate.rot, axis.rate_of(inner_angle) = sample.gimbals->inner_rate.rot;
      }
      if (sample.contact) {
        const auto& tip_L = sample.contact->tip_L;
        const Vec3<double> tip_H = transposed_times(R_LH, Vec3<double>(tip_L[0].rot, tip_L[1].rot, tip_L[2].rot));
        axis[tip_L_x] = tip_H[0], axis[tip_L_y] = tip_H[1];
      }
      if (sought.rates) take_rates(axis, sample.state.q_LB, sample.state.w_LB_B, w_IL_L);
    }
    for (const ContactEvent& event : motion.contact_events)
      if (ends_run(event.kind) && predicted.axes.size() < times_s.size()) predicted.end = event;
    return predicted;
  }
  const MotionTrajectory<double> motion =
      integrate_motion(problem, options, axis_alone ? MotionSought::symmetry_axis : MotionSought::attitude, watch);
  predicted.status = motion.status;
  for (const MotionSample<double>& sample : motion.samples) {
    PredictedAxis& axis = predicted.axes.emplace_back();
    axis.t_s = sample.t_s;
    axis.n_M = rotation_matrix(sample.q_LB).col(2);
    if (sought.rates) take_rates(axis, sample.q_LB, sample.w_LB_B, w_IL_L);
  }
  return predicted;
}

/// Fills in the swing of a pendulum.
void take_swings(PredictedMotion& motion, const Scene& scene) {
  using enum MeasuredQuantity;
  const std::optional<SymmetricTop<double>> pendulum = pendulum_of(scene);
  if (!pendulum) return;
  const double up_rad_s = rate_IL_L(scene)[2];
  for (PredictedAxis& axis : motion.axes) {
    const auto swing = swing_of(*pendulum, axis.n_M, axis.rate_M, axis.w_LB_B[2], up_rad_s);
    if (!swing) continue;
    axis[swing_major] = swing->major_rad, axis[swing_minor] = swing->minor_rad;
    if (swing->azimuth_rad) axis[swing_azimuth] = *swing->azimuth_rad;
  }
}

/// A vector v turned by a rotation vector, whose length is the angle (Rodrigues' formula).
Vec3<double> turned(const Vec3<double>& v, const Vec3<double>& turn) {
  const double angle = norm(turn);
  const SinCos<double> part = real::sin_cos(angle);
  const Vec3<double> axis = turn / angle;
  return part.cos * v + part.sin * axis.cross(v) + (1 - part.cos) * axis.dot(v) * axis;
}

/// The scales of an instrument, by the quantities that are read on them.
constexpr MeasuredQuantity kOnScales[kInstrumentScales] = {MeasuredQuantity::azimuth, MeasuredQuantity::tilt,
                                                           MeasuredQuantity::outer_angle, MeasuredQuantity::inner_angle};

/// A rate of which an instrument reads bias + scale * rate.
struct ReadRate {
  MeasuredQuantity quantity;
  InstrumentInput bias, scale;
};
constexpr ReadRate kRatesRead[] = {
    {MeasuredQuantity::rotor_rate, InstrumentInput::rotor_rate_bias, InstrumentInput::rotor_rate_scale},
    {MeasuredQuantity::spin, InstrumentInput::spin_bias, InstrumentInput::spin_scale},
    {MeasuredQuantity::w_LB_B_x, InstrumentInput::w_x_bias, InstrumentInput::w_scale},
    {MeasuredQuantity::w_LB_B_y, InstrumentInput::w_y_bias, InstrumentInput::w_scale},
    {MeasuredQuantity::w_LB_B_z, InstrumentInput::w_z_bias, InstrumentInput::w_scale},
    {MeasuredQuantity::w_IB_B_x, InstrumentInput::w_x_bias, InstrumentInput::w_scale},
    {MeasuredQuantity::w_IB_B_y, InstrumentInput::w_y_bias, InstrumentInput::w_scale},
    {MeasuredQuantity::w_IB_B_z, InstrumentInput::w_z_bias, InstrumentInput::w_scale}};

}  // namespace

void read_angles(PredictedAxis& top, const Scenario& scenario) {
  using enum MeasuredQuantity;
  const Instrument instrument = scenario.instrument.value_or(Instrument());
  top[azimuth] = instrument.reading(0, azimuth_of(top.n_M));
  top[tilt] = instrument.reading(1, tilt_of(top.n_M));
}

namespace {

/// Replaces a motion's axis in the laboratory, and what else is measured, by what the instrument makes of it.
void read_by_instrument(PredictedAxis& top, const Scenario& scenario) {
  using enum MeasuredQuantity;
  const Instrument instrument = scenario.instrument.value_or(Instrument());
  const Vec3<double> turn_L =
      kDegree * Vec3<double>(instrument[InstrumentInput::turn_east], instrument[InstrumentInput::turn_north],
                             instrument[InstrumentInput::turn_up]);
  if (norm(turn_L) > 0) top.n_M = turned(top.n_M, turn_L), top.rate_M = turned(top.rate_M, turn_L);
  for (const ReadRate& read : kRatesRead)
    top[read.quantity] = instrument[read.bias] + instrument[read.scale] * top[read.quantity];
  top[outer_angle] = instrument.reading(2, top[outer_angle]);
  top[inner_angle] = instrument.reading(3, top[inner_angle]);
  top[swing_azimuth] = instrument.reading(0, top[swing_azimuth] - turn_L[2]);
  read_angles(top, scenario);
  const Vec3<double>& n = top.n_M;
  const double horizontal = horizontal_part(n);
  top.rate_of(azimuth) = (top.rate_M[0] * n[1] - top.rate_M[1] * n[0]) / (horizontal * horizontal);
  top.rate_of(tilt) = -top.rate_M[2] / horizontal;
  for (std::size_t scale = 0; scale < kInstrumentScales; ++scale)
    top.rate_of(kOnScales[scale]) *= (instrument.reversed[scale] ? -1 : 1) / instrument[InstrumentInput::clock_rate];
}

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

PredictedMotion predict(const Scene& scene, const std::vector<double>& times_s, const Sought& sought, const Watch& watch,
                        std::optional<Method> method) {
  using enum MeasuredQuantity;
  const auto [motion_times_s, places] = times_of_motion(scene, times_s);
  PredictedMotion motion = predicted_axes(scene, motion_times_s, sought, watch, method);
  if (is_caged_top(scene.scenario())) {
    const CagedTop<double> cage(scene.scenario());
    for (PredictedAxis& axis : motion.axes) {
      axis[rotor_rate] = cage.rotor_rate(axis.t_s);
      if (!sought.rates) continue;
      put_rates(axis, cage.rate_of_cage(axis.w_LB_B, axis.t_s), cage.rate_of_cage(inertial_rate(axis), axis.t_s));
    }
  }
  if (sought.swing) take_swings(motion, scene);
  for (PredictedAxis& axis : motion.axes) read_by_instrument(axis, scene.scenario());
  PredictedMotion read{motion.status, {}, motion.end};
  read.axes.reserve(times_s.size());
  for (std::size_t k = 0; k < times_s.size() && places[k] < motion.axes.size(); ++k) {
    read.axes.push_back(motion.axes[places[k]]);
    read.axes.back().t_s = times_s[k];
  }
  return read;
}

PredictedMotion predict(const Scene& scene, const Measurement& measurement, const Watch& watch, std::optional<Method> method) {
  if (has_features(measurement)) return predict_features(scene, measurement, watch, method);
  return predict(scene, measured_times(measurement), sought_of(measurement), watch, method);
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
  ask_for_motion_alone(scenario, end_s);
  scenario.output_step_s = scenario.duration_s / kLooks;
  const RunResult result = run(resolve(std::move(scenario)), {watch, false});
  return {result.status, result.reached_s, result.verdict};
}

std::vector<MeasurementResidual> residuals_of(const Measurement& measurement, const PredictedMotion& motion) {
  std::vector<MeasurementResidual> residuals;
  residuals.reserve(2 * measurement.values.size());
  RowResiduals rows(measurement, residuals);
  std::size_t at = 0;
  for (std::size_t i = 0; i < measurement.values.size(); ++i) {
    const MeasuredValue& value = measurement.values[i];
    while (at < motion.axes.size() && motion.axes[at].t_s < value.t_s) ++at;
    if (at == motion.axes.size() && motion.end) rows.refuse(value, words_on_end(*motion.end) + "; leave out later rows");
    if (at == motion.axes.size()) break;
    rows.add(value, motion.axes[at], motion.features.empty() ? PredictedFeature{} : motion.features[i]);
  }
  return residuals;
}

double period_of(const MeasurementResidual& residual) {
  return residual.quantity.starts_with("axis") ? 0 : row_of(residual.quantity).period;
}

}  // namespace earthtop::measure
