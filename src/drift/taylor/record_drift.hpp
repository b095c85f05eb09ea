// SPDX-License-Identifier: GPL-3.0-or-later
/// Records the right-hand sides of drift integrations of scenes with applied torques, platforms, tides or without one of [F]'s
/// torques. The recording scalar is compiled apart, since it takes long.
#pragma once

#include <span>

#include "earthtop/integrate/options.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop {

/// The equations of any body in drift_system.hpp, with the rotating motion composed from reference and deviation.
/// @param observer  body or inertial   @param x, t  state and time at which they are recorded
template <class T>
taylor::Operations<T> record_drift(const Model<T>& model, Observer observer, std::span<const T> x, T t);
extern template taylor::Operations<double> record_drift(const Model<double>&, Observer, std::span<const double>, double);
extern template taylor::Operations<long double> record_drift(const Model<long double>&, Observer, std::span<const long double>,
                                                             long double);
extern template taylor::Operations<float128> record_drift(const Model<float128>&, Observer, std::span<const float128>,
                                                          float128);

/// The equations of a symmetric top in driven_reduced_equations.hpp.
/// @param w3  inertial spin of the reference at release   @param b  (I3/I1) w3
template <class T>
taylor::Operations<T> record_driven_top(const Model<T>& model, const ReducedTop<T>& top, T w3, const NutationRate<T>& b,
                                        Observer observer, std::span<const T> x, T t);
extern template taylor::Operations<double> record_driven_top(const Model<double>&, const ReducedTop<double>&, double,
                                                             const NutationRate<double>&, Observer, std::span<const double>,
                                                             double);
extern template taylor::Operations<long double> record_driven_top(const Model<long double>&, const ReducedTop<long double>&,
                                                                  long double, const NutationRate<long double>&, Observer,
                                                                  std::span<const long double>, long double);
extern template taylor::Operations<float128> record_driven_top(const Model<float128>&, const ReducedTop<float128>&, float128,
                                                               const NutationRate<float128>&, Observer,
                                                               std::span<const float128>, float128);

}  // namespace earthtop
