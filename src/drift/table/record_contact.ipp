// SPDX-License-Identifier: GPL-3.0-or-later
/// The definitions of record_contact.hpp; record_contact.cpp instantiates them for double, record_contact_extended.cpp for the other scalars.
#pragma once

#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "drift/table/record_contact.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {
namespace {

template <class T, Observer O>
ContactReducedEquations<real::Recorded<T>, O> recorded_whole(const ContactReducedEquations<T, O>& equations) {
  return {recorded(equations.model()), recorded(equations.contact()), recorded(equations.q_LH()), equations.w3()};
}
template <class T, Observer O>
ContactGeneralEquations<real::Recorded<T>, O> recorded_whole(const ContactGeneralEquations<T, O>& equations) {
  return {recorded(equations.model()), recorded(equations.contact()), recorded(equations.q_LH())};
}

}  // namespace

template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, ContactReducedShape<O>::kSize>(recorded_whole(equations), recording, x, t);
}
template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, ContactGeneralShape<O>::kSize>(recorded_whole(equations), recording, x, t);
}

#define EARTHTOP_RECORD_CONTACT(T, O)                                                                         \
  template taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>&, std::span<const T>, T); \
  template taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>&, std::span<const T>, T);

}  // namespace earthtop
