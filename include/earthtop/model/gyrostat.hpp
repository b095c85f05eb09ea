// SPDX-License-Identifier: GPL-3.0-or-later
/// A gyrostat, a body in which a rotor turns (rotor.hpp) or masses move (moving_masses.hpp), from its specification.
#pragma once

#include <vector>

#include "earthtop/model/model.hpp"
#include "earthtop/model/moving_masses_spec.hpp"
#include "earthtop/model/rotor_spec.hpp"

namespace earthtop {

/// The rotor in SI units.   @throws std::invalid_argument for RotorDrive::table with a missing or invalid table
template <class T>
Rotor<T> make_rotor(const RotorSpec& spec);

/// Body and rotor together: `S_BP_B`, mass and centre of mass are those of both.
/// @param cage  the body without the rotor; its own tensor may be singular
/// @param whole  whether `I_BP_B` has the rotor's axial moment, as the equations of a driven rotor take it
template <class T>
Body<T> gyrostat_body(const Body<T>& cage, const RotorSpec& rotor, bool whole);

/// The body without the rotor: the inverse of gyrostat_body.
template <class T>
Body<T> without_rotor(const Body<T>& both, const RotorSpec& rotor, bool whole);

/// A body with the masses that it carries, where they are at release; and the body without them.
template <class T>
Body<T> with_masses(const Body<T>& body, const std::vector<MovingMassSpec>& masses);
template <class T>
Body<T> without_masses(const Body<T>& all, const std::vector<MovingMassSpec>& masses);

/// Makes the model of `with_masses` one in which they move. Without a rotor in it, it gets one without a moment.
template <class T>
void put_masses(Model<T>& model, const std::vector<MovingMassSpec>& masses, const NaturalUnits& units);

/// Makes the model of `gyrostat_body` that of a gyrostat.   @param rotor  in SI units
template <class T>
void put_rotor(Model<T>& model, Rotor<T> rotor, const NaturalUnits& units);

/// Makes a model that of a Cardan suspension, after its rotor and its masses if it has them.   @param gimbals  in SI units
template <class T>
void put_gimbals(Model<T>& model, const Gimbals<T>& gimbals, const NaturalUnits& units);

#define EARTHTOP_ROTOR(T)                                                                              \
  extern template Rotor<T> make_rotor(const RotorSpec&);                                               \
  extern template Body<T> gyrostat_body(const Body<T>&, const RotorSpec&, bool);                       \
  extern template Body<T> without_rotor(const Body<T>&, const RotorSpec&, bool);                       \
  extern template void put_rotor(Model<T>&, Rotor<T>, const NaturalUnits&);                            \
  extern template Body<T> with_masses(const Body<T>&, const std::vector<MovingMassSpec>&);             \
  extern template Body<T> without_masses(const Body<T>&, const std::vector<MovingMassSpec>&);          \
  extern template void put_masses(Model<T>&, const std::vector<MovingMassSpec>&, const NaturalUnits&); \
  extern template void put_gimbals(Model<T>&, const Gimbals<T>&, const NaturalUnits&);
EARTHTOP_ROTOR(double)
EARTHTOP_ROTOR(float80)
EARTHTOP_ROTOR(float128)
#undef EARTHTOP_ROTOR

}  // namespace earthtop
