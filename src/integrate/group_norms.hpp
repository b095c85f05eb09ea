// SPDX-License-Identifier: GPL-3.0-or-later
/// Error control by component groups, on odeint's error-checker and step-adjuster concepts.
///
/// The error of each group of components (an attitude, an angular momentum, a deviation) is measured relative to the largest
/// size that this group has had so far. So a spin of 1e3 rad/s does not loosen the attitude's tolerance, and a component that
/// passes through zero does not force the step to zero.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "earthtop/real.hpp"

namespace earthtop {

/// The components [begin, begin + count) of a state, and the least size that their error is measured against.
struct ComponentGroup {
  std::size_t begin;
  std::size_t count;
  double least_scale;
};

template <class T, std::size_t N>
T squared_size(const std::array<T, N>& x, const ComponentGroup& group) {
  T sum = T(0);
  for (std::size_t i = group.begin; i < group.begin + group.count; ++i) sum += x[i] * x[i];
  return sum;
}

template <class T, std::size_t N>
bool all_finite(const std::array<T, N>& x) {
  for (const T& value : x)
    if (!real::isfinite(value)) return false;
  return true;
}

/// Keeps the largest size that each group has had, squared. The groups are known at compile time, so that loops over them are
/// unrolled.
/// @tparam Shape  describes a state: `kSize` components, and their `groups()`
template <class T, class Shape>
class GroupScales {
 public:
  using State = std::array<T, Shape::kSize>;
  static constexpr auto kGroups = Shape::groups();

  GroupScales() {
    for (std::size_t g = 0; g < kGroups.size(); ++g) squares_[g] = T(kGroups[g].least_scale) * T(kGroups[g].least_scale);
  }
  void include(const State& x) {
    for (std::size_t g = 0; g < kGroups.size(); ++g) squares_[g] = std::max(squares_[g], squared_size(x, kGroups[g]));
  }
  /// The largest size of each group, squared.
  const std::array<T, kGroups.size()>& squares() const { return squares_; }
  /// The error of the worst group divided by its tolerance. An error that is not finite counts as a huge one, so that a NaN is
  /// rejected (odeint itself would accept it).
  T largest_error(T relative_tolerance, const State& dxdt_old, const State& x_err, T dt) const {
    T largest = T(0);
    for (std::size_t g = 0; g < kGroups.size(); ++g) {
      const T square = std::max(squares_[g], T(dt * dt * squared_size(dxdt_old, kGroups[g])));
      const T ratio = squared_size(x_err, kGroups[g]) / square;
      if (!(ratio <= T(1e30))) return T(1e30);
      largest = std::max(largest, ratio);
    }
    return std::min(T(real::sqrt(largest) / relative_tolerance), T(1e30));
  }
  /// The largest ratio of a group of x to the size kept for it, squared.
  T largest_squared_ratio(const State& x) const {
    T largest = T(0);
    for (std::size_t g = 0; g < kGroups.size(); ++g) largest = std::max(largest, T(squared_size(x, kGroups[g]) / squares_[g]));
    return largest;
  }
  /// How far dx/dt * dt turns the unit vectors and quaternions, which are the groups with a least size of 1.
  T turned(const State& dxdt, T dt) const {
    T largest = T(0);
    for (std::size_t g = 0; g < kGroups.size(); ++g)
      if (kGroups[g].least_scale == 1.0) largest = std::max(largest, squared_size(dxdt, kGroups[g]));
    return real::sqrt(largest) * dt;
  }

 private:
  std::array<T, kGroups.size()> squares_;
};

/// An error checker for odeint's controlled steppers.
template <class T, class Shape, class Algebra>
class GroupErrorChecker {
 public:
  GroupErrorChecker(T relative_tolerance, const GroupScales<T, Shape>& scales)
      : tolerance_(relative_tolerance), scales_(&scales) {}

  template <class State, class Deriv, class Err, class Time>
  T error(Algebra&, const State&, const Deriv& dxdt_old, Err& x_err, Time dt) const {
    return scales_->largest_error(tolerance_, dxdt_old, x_err, dt);
  }

 private:
  T tolerance_;
  const GroupScales<T, Shape>* scales_;
};

/// A step adjuster for odeint's controlled steppers, for every scalar: the factor is found in double.
template <class T>
class StepAdjuster {
 public:
  T decrease_step(T dt, T error, int error_order) const {
    return dt * T(std::max(0.9 * real::pow(static_cast<double>(error), -1.0 / error_order), 0.1));
  }
  T increase_step(T dt, T error, int stepper_order) const {
    const double factor = 0.9 * real::pow(std::max(static_cast<double>(error), 1e-10), -1.0 / stepper_order);
    return dt * T(std::clamp(factor, 1.0, 4.0));
  }
  bool check_step_size_limit(T) const { return true; }
  T get_max_dt() const { return T(0); }
};

}  // namespace earthtop
