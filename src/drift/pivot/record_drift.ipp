// SPDX-License-Identifier: GPL-3.0-or-later
/// The definitions of record_drift.hpp; record_drift.cpp instantiates them for double, record_drift_extended.cpp for the other scalars.
#pragma once

#include "integrate/taylor/recorded_model.hpp"  // must come first: the model's formulas call the recording scalar's functions
//
#include <stdexcept>

#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/driven_reduced_equations.hpp"
#include "drift/pivot/record_drift.hpp"
#include "integrate/taylor/record_equations.hpp"

namespace earthtop {
namespace {

template <class T, Observer O, SceneKind K>
taylor::Operations<T> record_system(const Model<T>& model, std::span<const T> x, T t) {
  using R = real::Recorded<T>;
  taylor::Recording<T> recording;
  const Model<R> made = recorded(model);
  using System = DriftSystem<R, O, K, RotatingMotion::composed>;
  return recorded_equations<T, System::kSize>(System(made), recording, x, t);
}
template <class T, Observer O>
taylor::Operations<T> record_general(const Model<T>& model, std::span<const T> x, T t) {
  if (model.kind == SceneKind::gyrostat) return record_system<T, O, SceneKind::gyrostat>(model, x, t);
  return record_system<T, O, SceneKind::full>(model, x, t);
}

template <class T, template <class, Observer> class Equations, Observer O>
Equations<real::Recorded<T>, O> recorded(const Equations<T, O>& equations) {
  Equations<real::Recorded<T>, O> made;
  convert(equations, made, ToRecorded<T>());
  return made;
}

}  // namespace

template <class T>
taylor::Operations<T> record_drift(const Model<T>& model, Observer observer, std::span<const T> x, T t) {
  switch (observer) {
    case Observer::laboratory:
      if (model.kind == SceneKind::gyrostat) return record_system<T, Observer::laboratory, SceneKind::gyrostat>(model, x, t);
      break;
    case Observer::body: return record_general<T, Observer::body>(model, x, t);
    case Observer::inertial: return record_general<T, Observer::inertial>(model, x, t);
  }
  throw std::logic_error("in laboratory axes the rotating motion is integrated, and has no series");
}

template <class T, template <class, Observer> class Equations, Observer O>
taylor::Operations<T> record_spinless(const Equations<T, O>& equations, std::span<const T> x, T t) {
  taylor::Recording<T> recording;
  return recorded_equations<T, Equations<T, O>::kSize>(recorded(equations), recording, x, t);
}

#define EARTHTOP_RECORD_TOP(T, O)                                                                             \
  template taylor::Operations<T> record_spinless(const DrivenReducedEquations<T, O>&, std::span<const T>, T); \
  template taylor::Operations<T> record_spinless(const CompassEquations<T, O>&, std::span<const T>, T);       \
  template taylor::Operations<T> record_spinless(const GimbalDriftEquations<T, O>&, std::span<const T>, T);
#define EARTHTOP_RECORD(T)                                                                       \
  template taylor::Operations<T> record_drift(const Model<T>&, Observer, std::span<const T>, T); \
  EARTHTOP_RECORD_TOP(T, Observer::laboratory)                                                   \
  EARTHTOP_RECORD_TOP(T, Observer::inertial)

}  // namespace earthtop
