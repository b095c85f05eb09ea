// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion that a scenario predicts at measured times, and the residuals of a measurement against it.
#pragma once

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

/// Body axis 3 at one instant, as the scenario's instrument reads it, and how far it has drifted from the non-rotating prediction.
struct PredictedAxis {
  double t_s = 0;
  Vec3<double> n_M = Vec3<double>::Zero();  ///< along the axes of the instrument's mount
  double azimuth_rad = 0, tilt_rad = 0;     ///< as the instrument reads them; the azimuth is NaN where the axis is vertical
  double drift_tilt_rad = 0;                ///< (rad); 0 where no drift was asked for
  std::optional<double> drift_azimuth_rad =
      {};  ///< (rad), continuous; none where an axis is vertical, or no drift was asked for
  std::optional<double> rotor_rate_rad_s = {};                       ///< relative to the body; none without a rotor
  std::optional<double> outer_angle_rad = {}, inner_angle_rad = {};  ///< continuous; none without gimbals
};

/// A measured quantity that is one number of a part of the top, beside its axis.
struct PartQuantity {
  MeasuredQuantity quantity;
  std::optional<double> PredictedAxis::*predicted;
  double CurvePoint::*shown;
  const char* column;   ///< of its curve
  const char* spoken;   ///< as a picture calls it
  const char* missing;  ///< why a scenario may not have it, and what to do
};
inline constexpr PartQuantity kPartQuantities[] = {
    {MeasuredQuantity::rotor_rate, &PredictedAxis::rotor_rate_rad_s, &CurvePoint::rotor_rate_rad_s, "rotor_rate_rad_s",
     "Rate of the rotor", "the scenario has no rotor; give it /rotor"},
    {MeasuredQuantity::outer_angle, &PredictedAxis::outer_angle_rad, &CurvePoint::outer_angle_rad, "outer_angle_rad",
     "Angle of the outer gimbal", "the scenario has no gimbals; give it /gimbals"},
    {MeasuredQuantity::inner_angle, &PredictedAxis::inner_angle_rad, &CurvePoint::inner_angle_rad, "inner_angle_rad",
     "Angle of the inner gimbal", "the scenario has no gimbals; give it /gimbals"},
};
/// The row of a quantity, by itself or by its name; null for one of the axis.
const PartQuantity* part_quantity(MeasuredQuantity quantity);
const PartQuantity* part_quantity(std::string_view name);
struct PredictedMotion {
  RunStatus status = RunStatus::completed;
  std::vector<PredictedAxis> axes;  ///< one for each time that was reached
  std::optional<ContactEvent> end;  ///< the event on the table after which there is no motion at the later times
};

/// A scenario's motion at given times of its instrument's clock, computed in double precision whatever precision the scenario asks for. The scenario's
/// rows and other requests are ignored.
/// @param times_s  ascending, starting at 0, none later than the scenario's duration
/// @param drift  whether drifts are wanted: these need the non-rotating prediction as well, which makes the work threefold
/// @param watch  may end the work early
/// @param method  to be taken instead of the scenario's
/// @throws ScenarioError for a method that does not fit the scene, or a scene that would take days
PredictedMotion predict(const Scene& scene, const std::vector<double>& times_s, bool drift, const Watch& watch,
                        std::optional<Method> method = {});
/// The method that `predict` takes for a scene.
Method method_of_prediction(const Scene& scene, const std::vector<double>& times_s);

/// Fills in the angles at which an instrument reads the axis n_M.
void read_angles(PredictedAxis& axis, const Scenario& scenario);

/// The angles of a motion for a picture. @param drift  whether it was computed with drifts
std::vector<CurvePoint> angles_of(const PredictedMotion& motion, bool drift);

bool has_drifts(const Measurement& measurement);

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

/// The amount by which a residual jumps when its angle passes a full turn (rad); 0 where it cannot jump.
double period_of(const MeasurementResidual& residual);

}  // namespace earthtop::measure
