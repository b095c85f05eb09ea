// SPDX-License-Identifier: GPL-3.0-or-later
/// Records the right-hand sides of a top on a table. The recording scalar is compiled apart, since it takes long.
#pragma once

#include <span>

#include "drift/table/contact_general_equations.hpp"
#include "drift/table/contact_reduced_equations.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop {

/// The equations of a symmetric top in contact_reduced_equations.hpp.   @param x, t  state and time at which they are recorded
template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>& equations, std::span<const T> x, T t);
/// The equations of any body in contact_general_equations.hpp.
template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>& equations, std::span<const T> x, T t);
#define EARTHTOP_RECORD_CONTACT(T, O)                                                                                \
  extern template taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>&, std::span<const T>, T); \
  extern template taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>&, std::span<const T>, T);
EARTHTOP_RECORD_CONTACT(double, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(double, Observer::inertial)
EARTHTOP_RECORD_CONTACT(float80, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(float80, Observer::inertial)
EARTHTOP_RECORD_CONTACT(float128, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(float128, Observer::inertial)
#undef EARTHTOP_RECORD_CONTACT

}  // namespace earthtop
