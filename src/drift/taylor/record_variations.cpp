// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "drift/compass_variations.hpp"
#include "drift/driven_reduced_variations.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {

taylor::Operations<double> record_driven_variations(const Model<double>& model, const ReducedTop<double>& top, double w3,
                                                    bool has_Earth, const DrivenVariationsEquations<double>::State& x,
                                                    double t) {
  using R = real::Recorded<double>;
  taylor::Recording<double> recording;
  const Vec3<double> W_L = has_Earth ? model.W_IL_L : Vec3<double>(Vec3<double>::Zero());
  const DrivenVariationsEquations<R> equations{
      recorded_model(model), recorded_top(top), w3, top.spin_ratio * w3, recorded_model_detail::recorded(W_L), has_Earth};
  return recorded_equations<double, DrivenVariationsShape::kSize>(equations, recording, x, t);
}

taylor::Operations<double> record_compass_variations(const CompassVariationsEquations<double>& equations,
                                                     const CompassVariationsEquations<double>::State& x, double t) {
  using R = real::Recorded<double>;
  taylor::Recording<double> recording;
  const CompassVariationsEquations<R> made{recorded_model(equations.model),
                                           recorded_top(equations.top),
                                           equations.east,
                                           equations.north,
                                           equations.w3,
                                           recorded_model_detail::recorded(equations.W_L),
                                           equations.has_Earth};
  return recorded_equations<double, CompassVariationsShape::kSize>(made, recording, x, t);
}

}  // namespace earthtop
