// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "drift/taylor/record_contact.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {

template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>& equations, std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  const Quaternion<T>& q = equations.q_LH();
  const ContactReducedEquations<R, O> made(recorded_model(equations.model()),
                                           converted<R>(equations.contact(), [](const T& number) { return R(number); }),
                                           Quaternion<R>{q.w, Vec3<R>(q.v[0], q.v[1], q.v[2])}, equations.w3());
  return recorded_equations<T, ContactReducedShape<O>::kSize>(made, recording, x, t);
}

#define EARTHTOP_RECORD_CONTACT(T)                                                                                              \
  template taylor::Operations<T> record_contact(const ContactReducedEquations<T, Observer::laboratory>&, std::span<const T>, T); \
  template taylor::Operations<T> record_contact(const ContactReducedEquations<T, Observer::inertial>&, std::span<const T>, T);
EARTHTOP_RECORD_CONTACT(double)
EARTHTOP_RECORD_CONTACT(long double)
EARTHTOP_RECORD_CONTACT(float128)

}  // namespace earthtop
