// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/record_motion.ipp"

namespace earthtop {
template taylor::Operations<double> record_motion(const Model<double>&, std::span<const double>, double);

taylor::Operations<double> record_axis_motion(const DrivenAxisEquations<double>& equations, std::span<const double> x,
                                              double t) {
  taylor::Recording<double> recording;
  DrivenAxisEquations<real::Recorded<double>> made;
  convert(equations, made, ToRecorded<double>());
  return recorded_equations<double, DrivenAxisShape::kSize>(made, recording, x, t);
}
}  // namespace earthtop
