// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "drift/derivatives/compass_variations.hpp"
#include "drift/derivatives/driven_reduced_variations.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {

template <template <class> class Equations>
taylor::Operations<double> record_variations(const Equations<double>& equations, const typename Equations<double>::State& x,
                                             double t) {
  taylor::Recording<double> recording;
  constexpr std::size_t kSize = std::tuple_size_v<typename Equations<double>::State>;
  return recorded_equations<double, kSize>(recorded(equations), recording, x, t);
}
template taylor::Operations<double> record_variations(const DrivenVariationsEquations<double>&,
                                                      const DrivenVariationsEquations<double>::State&, double);
template taylor::Operations<double> record_variations(const CompassVariationsEquations<double>&,
                                                      const CompassVariationsEquations<double>::State&, double);

}  // namespace earthtop
