// SPDX-License-Identifier: GPL-3.0-or-later
/// Records the right-hand sides of drift integrations: of any body, of a symmetric top with applied torques, of a wheel in a gimbal.
/// The recording scalar is compiled apart, since it takes long.
#pragma once

#include <span>

#include "drift/gimbals/gimbal_drift_equations.hpp"
#include "drift/pivot/compass_equations.hpp"
#include "drift/pivot/driven_reduced_equations.hpp"
#include "earthtop/integrate/options.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop {

/// The equations of any body in drift_system.hpp, with the rotating motion composed from reference and deviation.
/// @param observer  body or inertial   @param x, t  state and time at which they are recorded
template <class T>
taylor::Operations<T> record_drift(const Model<T>& model, Observer observer, std::span<const T> x, T t);
extern template taylor::Operations<double> record_drift(const Model<double>&, Observer, std::span<const double>, double);
extern template taylor::Operations<float80> record_drift(const Model<float80>&, Observer, std::span<const float80>, float80);
extern template taylor::Operations<float128> record_drift(const Model<float128>&, Observer, std::span<const float128>,
                                                          float128);

/// Equations without an attitude: of a symmetric top in driven_reduced_equations.hpp, of a wheel in a gimbal in compass_equations.hpp,
/// of a Cardan suspension in gimbal_drift_equations.hpp.
template <class T, template <class, Observer> class Equations, Observer O>
taylor::Operations<T> record_spinless(const Equations<T, O>& equations, std::span<const T> x, T t);
#define EARTHTOP_RECORD_TOP(T, O)                                                                                    \
  extern template taylor::Operations<T> record_spinless(const DrivenReducedEquations<T, O>&, std::span<const T>, T); \
  extern template taylor::Operations<T> record_spinless(const CompassEquations<T, O>&, std::span<const T>, T);       \
  extern template taylor::Operations<T> record_spinless(const GimbalDriftEquations<T, O>&, std::span<const T>, T);
EARTHTOP_RECORD_TOP(double, Observer::laboratory)
EARTHTOP_RECORD_TOP(double, Observer::inertial)
EARTHTOP_RECORD_TOP(float80, Observer::laboratory)
EARTHTOP_RECORD_TOP(float80, Observer::inertial)
EARTHTOP_RECORD_TOP(float128, Observer::laboratory)
EARTHTOP_RECORD_TOP(float128, Observer::inertial)
#undef EARTHTOP_RECORD_TOP

}  // namespace earthtop
