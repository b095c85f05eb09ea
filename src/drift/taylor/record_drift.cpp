// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include <algorithm>
#include <stdexcept>

#include "drift/driven_reduced_equations.hpp"
#include "drift/drift_system.hpp"
#include "drift/taylor/record_drift.hpp"

namespace earthtop {
namespace {

/// Records a right-hand side called with (x, dxdt, t).
template <class T, std::size_t N, class Equations>
taylor::Operations<T> recorded(const Equations& equations, taylor::Recording<T>& recording, std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  if (x.size() != N) throw std::logic_error("record: a state of another size");
  std::array<R, N> state, rate;
  for (std::size_t i = 0; i < N; ++i)
    state[i] = R(recording, recording.add({.kind = taylor::Kind::state, .a = static_cast<int>(i)}, x[i]));
  const R time(recording, recording.add({.kind = taylor::Kind::time}, t));
  equations(state, rate, time);
  std::vector<int> outputs;
  for (const R& component : rate) outputs.push_back(component.place_in(recording));
  return recording.finish(std::move(outputs));
}

template <class T, Observer O>
taylor::Operations<T> record_general(const Model<T>& model, std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  const Model<R> made = recorded_model(model);
  const DriftSystem<R, O, SceneKind::full, RotatingMotion::composed> system(made);
  return recorded<T, DriftShape<RotatingMotion::composed>::kSize>(system, recording, x, t);
}

template <class T, Observer O>
taylor::Operations<T> record_top(const Model<T>& model, const ReducedTop<T>& top, T w3, const NutationRate<T>& b,
                                 std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  const ReducedTop<R> made{top.axis, top.spin_ratio, top.spin_ratio_rest, top.moment_ratio, top.I1, top.I3};
  const DrivenReducedEquations<R, O> equations{recorded_model(model), made, w3, b.value, b.rest};
  return recorded<T, DrivenReducedShape::kSize>(equations, recording, x, t);
}

}  // namespace

template <class T>
taylor::Operations<T> record_drift(const Model<T>& model, Observer observer, std::span<const T> x, T t) {
  switch (observer) {
    case Observer::laboratory: break;
    case Observer::body: return record_general<T, Observer::body>(model, x, t);
    case Observer::inertial: return record_general<T, Observer::inertial>(model, x, t);
  }
  throw std::logic_error("in laboratory axes the rotating motion is integrated, and has no series");
}

template <class T>
taylor::Operations<T> record_driven_top(const Model<T>& model, const ReducedTop<T>& top, T w3, const NutationRate<T>& b,
                                        Observer observer, std::span<const T> x, T t) {
  if (observer == Observer::laboratory) return record_top<T, Observer::laboratory>(model, top, w3, b, x, t);
  if (observer == Observer::inertial) return record_top<T, Observer::inertial>(model, top, w3, b, x, t);
  throw std::logic_error("the reduced form has no body axes");
}

#define EARTHTOP_RECORD(T)                                                                                            \
  template taylor::Operations<T> record_drift(const Model<T>&, Observer, std::span<const T>, T);                       \
  template taylor::Operations<T> record_driven_top(const Model<T>&, const ReducedTop<T>&, T, const NutationRate<T>&, \
                                                   Observer, std::span<const T>, T);
EARTHTOP_RECORD(double)
EARTHTOP_RECORD(long double)
EARTHTOP_RECORD(float128)

}  // namespace earthtop
