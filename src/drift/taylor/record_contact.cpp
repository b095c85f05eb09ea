// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include "drift/contact_bundle.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {
namespace {

template <class T>
Quaternion<real::Recorded<T>> recorded_quaternion(const Quaternion<T>& q) {
  return {q.w, Vec3<real::Recorded<T>>(q.v[0], q.v[1], q.v[2])};
}

template <class T, Observer O>
ContactReducedEquations<real::Recorded<T>, O> recorded(const ContactReducedEquations<T, O>& equations) {
  return {recorded(equations.model()), recorded(equations.contact()), recorded_quaternion(equations.q_LH()), equations.w3(),
          recorded(equations.change())};
}
template <class T, Observer O>
ContactGeneralEquations<real::Recorded<T>, O> recorded(const ContactGeneralEquations<T, O>& equations) {
  return {recorded(equations.model()), recorded(equations.contact()), recorded_quaternion(equations.q_LH()),
          recorded(equations.change())};
}
template <class Equations>
taylor::Operations<double> record_bundle(const ContactBundleEquations<double, Equations>& bundle, std::span<const double> x,
                                         double t) {
  using R = real::Recorded<double>;
  using Made = decltype(recorded(bundle.each().front()));
  taylor::Recording<double> recording;
  std::vector<Made> each;
  for (const Equations& equations : bundle.each()) each.push_back(recorded(equations));
  const ContactBundleEquations<R, Made> made(std::move(each));
  return recorded_equations<double, ContactBundleEquations<R, Made>::Shape::kSize>(made, recording, x, t);
}

}  // namespace

template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, ContactReducedShape<O>::kSize>(recorded(equations), recording, x, t);
}
template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, ContactGeneralShape<O>::kSize>(recorded(equations), recording, x, t);
}
taylor::Operations<double> record_contact_bundle(
    const ContactBundleEquations<double, ContactReducedEquations<double, Observer::laboratory>>& bundle,
    std::span<const double> x, double t) {
  return record_bundle(bundle, x, t);
}
taylor::Operations<double> record_contact_bundle(
    const ContactBundleEquations<double, ContactGeneralEquations<double, Observer::laboratory>>& bundle,
    std::span<const double> x, double t) {
  return record_bundle(bundle, x, t);
}

#define EARTHTOP_RECORD_CONTACT(T, O)                                                                         \
  template taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>&, std::span<const T>, T); \
  template taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>&, std::span<const T>, T);
EARTHTOP_RECORD_CONTACT(double, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(double, Observer::inertial)
EARTHTOP_RECORD_CONTACT(long double, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(long double, Observer::inertial)
EARTHTOP_RECORD_CONTACT(float128, Observer::laboratory)
EARTHTOP_RECORD_CONTACT(float128, Observer::inertial)

}  // namespace earthtop
