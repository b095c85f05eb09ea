// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include <algorithm>
#include <concepts>

#include "drift/derivatives/contact_tangents.hpp"
#include "integrate/taylor/record_equations.hpp"
#include "integrate/taylor/tangents.hpp"

namespace earthtop {
namespace {

template <class T>
Quaternion<real::Recorded<T>> recorded_quaternion(const Quaternion<T>& q) {
  return {q.w, Vec3<real::Recorded<T>>(q.v[0], q.v[1], q.v[2])};
}

/// The equations with another model and contact.
template <class T, Observer O>
ContactReducedEquations<real::Recorded<T>, O> recorded(const ContactReducedEquations<T, O>& equations,
                                                       const Model<real::Recorded<T>>& model,
                                                       const Contact<real::Recorded<T>>& contact) {
  return {model, contact, recorded_quaternion(equations.q_LH()), equations.w3()};
}
template <class T, Observer O>
ContactGeneralEquations<real::Recorded<T>, O> recorded(const ContactGeneralEquations<T, O>& equations,
                                                       const Model<real::Recorded<T>>& model,
                                                       const Contact<real::Recorded<T>>& contact) {
  return {model, contact, recorded_quaternion(equations.q_LH())};
}
template <class T, class Equations>
auto recorded_whole(const Equations& equations) {
  return recorded(equations, recorded(equations.model()), recorded(equations.contact()));
}

/// Makes parameters of the coefficients that a change has. @returns their derivatives by all changes, one after the other
std::vector<double> differentiate(const ContactChanges& changes, Contact<real::Recorded<double>>& contact,
                                  Model<real::Recorded<double>>& model, taylor::Recording<double>& recording) {
  using R = real::Recorded<double>;
  std::vector<double> derivatives;
  const auto vary = ByKind{[&](R& coefficient, const std::same_as<double> auto&... by_change) {
                             if (((by_change == 0) && ...)) return;
                             coefficient = R(recording, recording.parameter(coefficient.value()));
                             (derivatives.push_back(by_change), ...);
                           },
                           [&](Vec3<R>& vector, const std::same_as<Vec3<double>> auto&... by_change) {
                             for (int i = 0; i < 3; ++i) {
                               if (((by_change[i] == 0) && ...)) continue;
                               vector[i] = R(recording, recording.parameter(vector[i].value()));
                               (derivatives.push_back(by_change[i]), ...);
                             }
                           }};
  [&]<std::size_t... c>(std::index_sequence<c...>) {
    using Change = ContactChange<double>;
    for_each_in_tuples(vary, Change::changed(contact, model), Change::members_of(changes.of_inputs[c])...);
  }
  (std::make_index_sequence<kMostContactChanges>());
  return derivatives;
}

/// The reference alone, without the integrals of its work.
template <class Made>
struct ReferenceAlone {
  const Made& pair;
  using Half = typename Made::Half;
  template <class Time>
  void operator()(const Half& x, Half& dxdt, const Time& t) const {
    typename Made::State rate;
    pair(Made::pair(x, Half{}), rate, t);
    dxdt = {};
    std::copy_n(rate.begin(), Made::Shape::kWork, dxdt.begin());
  }
};

template <class Equations>
taylor::Operations<double> record_tangents_of(const Equations& equations, const ContactChanges& changes,
                                              std::span<const double> x, double t) {
  taylor::Recording<double> recording;
  auto model = recorded(equations.model());
  auto contact = recorded(equations.contact());
  const std::vector<double> derivatives = differentiate(changes, contact, model, recording);
  const auto made = recorded(equations, model, contact);
  const ReferenceAlone<std::remove_const_t<decltype(made)>> reference{made};
  constexpr std::size_t kEach = Equations::kHalf;
  const auto plain = recorded_equations<double, kEach>(reference, recording, x.first(kEach), t);
  return taylor::with_tangents<double>(plain, changes.count, derivatives, x, t);
}

}  // namespace

template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactReducedEquations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, ContactReducedShape<O>::kSize>(recorded_whole<T>(equations), recording, x, t);
}
template <class T, Observer O>
taylor::Operations<T> record_contact(const ContactGeneralEquations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, ContactGeneralShape<O>::kSize>(recorded_whole<T>(equations), recording, x, t);
}
taylor::Operations<double> record_contact_tangents(const ContactReducedEquations<double, Observer::laboratory>& equations,
                                                   const ContactChanges& changes, std::span<const double> x, double t) {
  return record_tangents_of(equations, changes, x, t);
}
taylor::Operations<double> record_contact_tangents(const ContactGeneralEquations<double, Observer::laboratory>& equations,
                                                   const ContactChanges& changes, std::span<const double> x, double t) {
  return record_tangents_of(equations, changes, x, t);
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
