// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "drift/derivatives/single_motion.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {

template <template <class> class Equations>
taylor::Operations<double> record_single_motion(const Equations<double>& equations, std::span<const double> x, double t) {
  taylor::Recording<double> recording;
  return recorded_equations<double, Equations<double>::kSize>(recorded(equations), recording, x, t);
}
template taylor::Operations<double> record_single_motion(const SpinlessMotionEquations<double>&, std::span<const double>,
                                                         double);
template taylor::Operations<double> record_single_motion(const WheelMotionEquations<double>&, std::span<const double>, double);
template taylor::Operations<double> record_single_motion(const GimbalMotionEquations<double>&, std::span<const double>, double);

}  // namespace earthtop
