// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of record_motion; record_motion.cpp instantiates it for double, record_motion_extended.cpp for the other scalars.
#pragma once

#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "integrate/motion_system.hpp"
#include "integrate/taylor/record_equations.hpp"
#include "integrate/taylor/record_motion.hpp"
#include "model/applied_motion.ipp"

namespace earthtop {

namespace {

template <SceneKind K, class T>
taylor::Operations<T> record_body_motion(const Model<T>& model, std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  MotionProblem<R> problem;
  problem.model = recorded(model);
  using System = GeneralMotionSystem<R, Observer::body, K>;
  return recorded_equations<T, System::kSize>(System(problem), recording, x, t);
}

}  // namespace

template <class T>
taylor::Operations<T> record_motion(const Model<T>& model, std::span<const T> x, T t) {
  if (model.kind == SceneKind::gyrostat) return record_body_motion<SceneKind::gyrostat>(model, x, t);
  return record_body_motion<SceneKind::full>(model, x, t);
}

}  // namespace earthtop
