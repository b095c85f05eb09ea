// SPDX-License-Identifier: GPL-3.0-or-later
/// A gyrostat, a body in which a rotor turns (rotor.hpp), from its specification.
#pragma once

#include "earthtop/model/model.hpp"
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

/// Makes the model of `gyrostat_body` that of a gyrostat.   @param rotor  in SI units
template <class T>
void put_rotor(Model<T>& model, Rotor<T> rotor, const NaturalUnits& units);

/// Makes a model that of a Cardan suspension, after its rotor if it has one.   @param gimbals  in SI units
template <class T>
void put_gimbals(Model<T>& model, const Gimbals<T>& gimbals, const NaturalUnits& units);

#define EARTHTOP_ROTOR(T)                                                        \
  extern template Rotor<T> make_rotor(const RotorSpec&);                         \
  extern template Body<T> gyrostat_body(const Body<T>&, const RotorSpec&, bool); \
  extern template Body<T> without_rotor(const Body<T>&, const RotorSpec&, bool); \
  extern template void put_rotor(Model<T>&, Rotor<T>, const NaturalUnits&);      \
  extern template void put_gimbals(Model<T>&, const Gimbals<T>&, const NaturalUnits&);
EARTHTOP_ROTOR(double)
EARTHTOP_ROTOR(long double)
EARTHTOP_ROTOR(float128)
#undef EARTHTOP_ROTOR

}  // namespace earthtop
