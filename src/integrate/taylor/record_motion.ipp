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

template <class T>
taylor::Operations<T> record_motion(const Model<T>& model, std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  MotionProblem<R> problem;
  problem.model = recorded(model);
  const GeneralMotionSystem<R, Observer::body, SceneKind::full> system(problem);
  return recorded_equations<T, GeneralMotionShape::kSize>(system, recording, x, t);
}

}  // namespace earthtop
