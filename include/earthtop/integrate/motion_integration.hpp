// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates one motion on the rotating Earth by itself, without a reference or a deviation: what a simulator does that
/// knows of no drift. For comparisons of methods and of models.
#pragma once

#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/integrate/pace.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// A top, its release, and when it is looked at.
template <class T>
struct MotionProblem {
  Model<T> model;      ///< in `units`
  Release<T> release;  ///< SI
  NaturalUnits units;
  T fastest_rate = T(1);        ///< rough bound on the rates of the motion (natural units); sets first and fixed steps
  std::vector<double> times_s;  ///< output times; the first is the release, 0
  Pace pace = {};               ///< limits the work of everything that integrates the problem; not known: nothing does
};

/// Where the variational equations of a problem's motion stop that are followed for `time_s`.
template <class T>
WorkLimit variational_limit(const MotionProblem<T>& problem, double time_s, double relative_tolerance) {
  if (!problem.pace.known()) return {};
  return limit_of(variational_work(problem.pace, time_s, relative_tolerance));
}

/// Whether these options mean the reduced form for this model (reduced_top.hpp).
template <class T>
bool takes_reduced_form(const Model<T>& model, const IntegrationOptions& options) {
  return takes_reduced_form(is_reducible(model), options);
}

/// What is asked of a motion. A symmetric top's axis alone takes six variables in the reduced form; its attitude nine.
enum class MotionSought { attitude, symmetry_axis };

/// The motion at one instant; SI units.
template <class T>
struct MotionSample {
  T t_s = T(0);
  Quaternion<T> q_LB;  ///< where only the axis is sought: right but for a turn about it, and so is the rate
  Vec3<T> w_LB_B = Vec3<T>::Zero();
};

template <class T>
struct MotionTrajectory {
  RunStatus status = RunStatus::completed;
  std::vector<MotionSample<T>> samples;
  StepCounters counters;
};

/// @param sought  the general form always gives the attitude
/// @param watch  may end it early with RunStatus::interrupted.
/// @throws std::logic_error for a method that is not built for T, and for a reduced form where the model has none or in body
/// axes.
template <class T>
MotionTrajectory<T> integrate_motion(const MotionProblem<T>& problem, const IntegrationOptions& options,
                                     MotionSought sought = MotionSought::attitude, const Watch& watch = {});
extern template MotionTrajectory<double> integrate_motion(const MotionProblem<double>&, const IntegrationOptions&, MotionSought,
                                                          const Watch&);
extern template MotionTrajectory<long double> integrate_motion(const MotionProblem<long double>&, const IntegrationOptions&,
                                                               MotionSought, const Watch&);
extern template MotionTrajectory<float128> integrate_motion(const MotionProblem<float128>&, const IntegrationOptions&,
                                                            MotionSought, const Watch&);

}  // namespace earthtop
