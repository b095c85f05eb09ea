// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates a single motion on the rotating Earth, without a reference motion or a deviation from it, as a simulator does
/// that knows nothing of drift. Serves to compare methods and models.
#pragma once

#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/integrate/pace.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// A top, its release, and the output times.
template <class T>
struct MotionProblem {
  Model<T> model;      ///< in natural units, see `units`
  Release<T> release;  ///< in SI units
  NaturalUnits units;
  T fastest_rate = T(1);        ///< rough upper bound on the motion's rates (natural units); sets first and fixed steps
  std::vector<double> times_s;  ///< output times (s); the first is the release, 0
  Pace pace = {};               ///< limits the work of each integration of the problem; no limit while it is not known()

  /// The release as the equations take it, in the model's units.
  NaturalRelease<T> natural_release() const { return units.release_from_rad_s(release); }
};

/// The work at which an integration of the variational equations of the problem's motion is stopped; none where the problem's
/// pace is not known.
/// @param time_s  how long the equations are integrated (s)
template <class T>
WorkLimit variational_limit(const MotionProblem<T>& problem, double time_s, double relative_tolerance) {
  if (!problem.pace.known()) return {};
  return work_limit_for(variational_work(problem.pace, time_s, relative_tolerance));
}

/// Whether these options select the reduced form (reduced_top.hpp) for this model. With ModelForm::automatic they do for a
/// reducible model, if the observer is the laboratory, or inertial with the method `splitting`, which has no general form. With
/// applied torques, a tide or a platform only the Taylor series have the reduced form.
template <class T>
bool takes_reduced_form(const Model<T>& model, const IntegrationOptions& options) {
  const bool driven = options.method == Method::taylor && (is_reducible_when_driven(model) || is_compass(model));
  return takes_reduced_form(is_reducible(model) || driven, options);
}

/// Whether the axis of a driven symmetric top has equations of its own: for body axis 3, in double and by Taylor series. Dry friction,
/// which may bring a top to rest, has none.
inline bool has_axis_motion(const Model<double>& model, const IntegrationOptions& options) {
  return options.method == Method::taylor && options.form != ModelForm::general && model.kind == SceneKind::full &&
         is_reducible_when_driven(model) && symmetry_axis(model.I_BP_B, model.mass_moment_B) == 2 && model.applied.coulomb == 0;
}

/// The part of a motion that is wanted. In the reduced form a symmetric top's axis takes six variables, its attitude nine; with applied
/// torques, a tide or a platform its axis takes seven.
enum class MotionSought { attitude, symmetry_axis };

/// The motion at one instant; SI units.
template <class T>
struct MotionSample {
  T t_s = T(0);
  Quaternion<T> q_LB;                ///< attitude; where only the axis is sought, right up to a turn about that axis
  Vec3<T> w_LB_B = Vec3<T>::Zero();  ///< rate relative to the laboratory (rad/s), in the body axes of `q_LB`
};

/// The motion at the output times, and how its integration ended. Ended early, it has fewer samples.
template <class T>
struct MotionTrajectory {
  RunStatus status = RunStatus::completed;
  std::vector<MotionSample<T>> samples;
  StepCounters counters;
};

/// Integrates the problem's motion from the release to the last output time.
/// @param sought  matters to the reduced form only; the general form always gives the attitude
/// @param watch  may end the integration early, with RunStatus::interrupted
/// @throws std::logic_error for a method that is not built for T (see `is_built`) or does not suit the model, and for the
/// reduced form in body axes or of a model that has none.
template <class T>
MotionTrajectory<T> integrate_motion(const MotionProblem<T>& problem, const IntegrationOptions& options,
                                     MotionSought sought = MotionSought::attitude, const Watch& watch = {});
extern template MotionTrajectory<double> integrate_motion(const MotionProblem<double>&, const IntegrationOptions&, MotionSought,
                                                          const Watch&);
extern template MotionTrajectory<float80> integrate_motion(const MotionProblem<float80>&, const IntegrationOptions&,
                                                           MotionSought, const Watch&);
extern template MotionTrajectory<float128> integrate_motion(const MotionProblem<float128>&, const IntegrationOptions&,
                                                            MotionSought, const Watch&);

}  // namespace earthtop
