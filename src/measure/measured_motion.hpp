// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion that a scenario predicts at measured times, and the residuals of a measurement against it.
#pragma once

#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "earthtop/drift/contact_event.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/vectors.hpp"
#include "earthtop/watch.hpp"

namespace earthtop::measure {

inline constexpr double kWholeTurn = 2 * std::numbers::pi;  // rad

/// The measured times (s), each once, ascending; the first is that of the release, 0.
std::vector<double> measured_times(const Measurement& measurement);

/// The parts of a motion that are wanted beside body axis 3; each costs something.
struct Sought {
  bool drift = false;         ///< the non-rotating prediction as well, which makes the work threefold
  bool rates = false;         ///< rates, and with them the spin
  bool turned_rates = false;  ///< rates about axes 1 and 2, which need the attitude
  bool tip = false, swing = false;
  bool angle_rates = false;  ///< how fast the angles that turn change
};
Sought sought_of(const Measurement& measurement);

/// The top at one instant, as the scenario's instrument reads it.
struct PredictedAxis {
  double t_s = 0;
  Vec3<double> n_M = Vec3<double>::Zero();     ///< body axis 3 along the axes of the instrument's mount
  Vec3<double> rate_M = Vec3<double>::Zero();  ///< its rate (1/s), where rates are sought
  Vec3<double> w_LB_B = Vec3<double>::Zero();  ///< (rad/s), likewise
  /// By MeasuredQuantity, in rad, rad/s and m; angles of gimbals and drifts of azimuths are continuous. NaN where the scenario has no such
  /// quantity, where it was not sought, for the azimuth of a vertical axis, and for what is no value at one time.
  std::array<double, kMeasuredQuantities> value = filled();
  std::array<double, kMeasuredQuantities> rate = filled();  ///< of the angles that may turn (rad/s)

  double& operator[](MeasuredQuantity quantity) { return value[static_cast<std::size_t>(quantity)]; }
  double operator[](MeasuredQuantity quantity) const { return value[static_cast<std::size_t>(quantity)]; }
  double& rate_of(MeasuredQuantity quantity) { return rate[static_cast<std::size_t>(quantity)]; }
  double rate_of(MeasuredQuantity quantity) const { return rate[static_cast<std::size_t>(quantity)]; }

 private:
  static constexpr std::array<double, kMeasuredQuantities> filled() {
    std::array<double, kMeasuredQuantities> all{};
    all.fill(std::numeric_limits<double>::quiet_NaN());
    return all;
  }
};

/// A turning point, a period or a passage of a motion.
struct PredictedFeature {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< in rad or s; NaN where the motion has none
  double t_s = 0;                                           ///< of the turning point, or of the end of the turn
  double turns = 0;                                         ///< of the azimuth until a passage
  Extreme extreme = Extreme::either;                        ///< which one a turning point is
};
struct PredictedMotion {
  RunStatus status = RunStatus::completed;
  std::vector<PredictedAxis> axes;              ///< one for each time that was reached
  std::optional<ContactEvent> end;              ///< the event on the table after which there is no motion at the later times
  std::vector<PredictedFeature> features = {};  ///< one for each measured value; empty where none is one
};

/// A scenario's motion at given times of its instrument's clock, computed in double precision whatever precision the scenario asks for. The scenario's
/// rows and other requests are ignored.
/// @param times_s  ascending, starting at 0, none later than the scenario's duration
/// @param watch  may end the work early
/// @param method  to be taken instead of the scenario's
/// @throws ScenarioError for a method that does not fit the scene, or a scene that would take days
PredictedMotion predict(const Scene& scene, const std::vector<double>& times_s, const Sought& sought, const Watch& watch,
                        std::optional<Method> method = {});
/// The motion that a measurement is compared with: at its times, and with its turning points, periods and passages (features.hpp).
PredictedMotion predict(const Scene& scene, const Measurement& measurement, const Watch& watch,
                        std::optional<Method> method = {});
/// The time until which a motion has to be predicted for a value, and for all of a measurement (s): of a period its end.
double end_time_s(const MeasuredValue& value);
double last_time_s(const Measurement& measurement);
/// The method that `predict` takes for a scene.
Method method_of_prediction(const Scene& scene, const std::vector<double>& times_s);

/// Fills in the angles at which an instrument reads the axis n_M.
void read_angles(PredictedAxis& top, const Scenario& scenario);

/// A motion for a picture, with the quantities that were measured.
std::vector<CurvePoint> curve_of(const PredictedMotion& motion, const Measurement& measurement);

/// The verdict of a run on the motion to a time.
struct JudgedMotion {
  RunStatus status = RunStatus::completed;  ///< or the reason why there is no verdict
  double reached_s = 0;                     ///< less than the time where an event on the table ends the motion
  VerdictReport verdict;
};
/// Runs the scenario to `end_s`, prepared as for `predict`.
JudgedMotion judged_motion(const Scene& scene, double end_s, const Watch& watch);

/// Whether the verdict says that no prediction at `until_s` means anything.
bool is_beyond_prediction(const VerdictReport& verdict, double until_s);

/// That an event ends the motion, in a sentence without its full stop.
std::string words_on_end(const ContactEvent& event);

/// A measurement's residuals against the motion at measured_times(), for the rows that the motion reached. Residuals of
/// azimuths are reduced to -pi to pi. The components of an axis are taken along directions that depend on the measured axis
/// alone, so that they do not turn when the prediction is varied.
/// @throws ScenarioError, with the row's line, for a measured azimuth where the predicted axis is vertical, and for a row beyond
/// an event that ends the motion
std::vector<MeasurementResidual> residuals_of(const Measurement& measurement, const PredictedMotion& motion);

/// The amount by which a residual jumps when its angle passes a full turn (rad), or its plane half a turn; 0 where it cannot jump.
double period_of(const MeasurementResidual& residual);

}  // namespace earthtop::measure
