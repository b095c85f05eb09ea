// SPDX-License-Identifier: GPL-3.0-or-later
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
template taylor::Operations<double> record_motion(const Model<double>&, std::span<const double>, double);
template taylor::Operations<long double> record_motion(const Model<long double>&, std::span<const long double>, long double);
template taylor::Operations<float128> record_motion(const Model<float128>&, std::span<const float128>, float128);

}  // namespace earthtop
