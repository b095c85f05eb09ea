/// Error control by component groups, on odeint's error-checker and step-adjuster concepts.
///
/// Each group of components (an attitude, an angular momentum, a deviation) is measured against its own largest size so
/// far: a spin of 1e3 rad/s does not loosen the attitude, and a component that passes through zero does not stop the clock.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "earthtop/real.hpp"

namespace earthtop {

/// Components [begin, begin + count) of a state, and the least size their error is measured against.
struct ComponentGroup {
  std::size_t begin;
  std::size_t count;
  double least_scale;
};

template <class T, std::size_t N>
T group_size(const std::array<T, N>& x, const ComponentGroup& group) {
  T sum = T(0);
  for (std::size_t i = group.begin; i < group.begin + group.count; ++i) sum += x[i] * x[i];
  return real::sqrt(sum);
}

template <class T, std::size_t N>
bool all_finite(const std::array<T, N>& x) {
  for (const T& value : x)
    if (!real::isfinite(value)) return false;
  return true;
}

/// The largest size each group has had.
template <class T, std::size_t N, std::size_t G>
class GroupScales {
 public:
  explicit GroupScales(const std::array<ComponentGroup, G>& groups) : groups_(groups) {
    for (std::size_t g = 0; g < G; ++g) scales_[g] = T(groups[g].least_scale);
  }
  void include(const std::array<T, N>& x) {
    for (std::size_t g = 0; g < G; ++g) scales_[g] = std::max(scales_[g], group_size(x, groups_[g]));
  }
  const std::array<ComponentGroup, G>& groups() const { return groups_; }
  T scale(std::size_t g) const { return scales_[g]; }

 private:
  std::array<ComponentGroup, G> groups_;
  std::array<T, G> scales_;
};

/// The largest group error over its tolerance; an error that is not finite counts as a huge one, so that a NaN is rejected
/// (odeint itself would accept it).
template <class T, std::size_t N, std::size_t G, class Time>
T largest_group_error(const GroupScales<T, N, G>& scales, T relative_tolerance, const std::array<T, N>& dxdt_old,
                      const std::array<T, N>& x_err, Time dt) {
  T largest = T(0);
  for (std::size_t g = 0; g < G; ++g) {
    const ComponentGroup& group = scales.groups()[g];
    const T size = std::max(scales.scale(g), T(real::abs(dt) * group_size(dxdt_old, group)));
    const T ratio = group_size(x_err, group) / (relative_tolerance * size);
    if (!(ratio <= T(1e30))) return T(1e30);
    largest = std::max(largest, ratio);
  }
  return largest;
}

/// odeint ErrorChecker.
template <class T, std::size_t N, std::size_t G, class Algebra>
class GroupErrorChecker {
 public:
  GroupErrorChecker(T relative_tolerance, const GroupScales<T, N, G>& scales)
      : tolerance_(relative_tolerance), scales_(&scales) {}

  template <class State, class Deriv, class Err, class Time>
  T error(Algebra&, const State&, const Deriv& dxdt_old, Err& x_err, Time dt) const {
    return largest_group_error(*scales_, tolerance_, dxdt_old, x_err, dt);
  }

 private:
  T tolerance_;
  const GroupScales<T, N, G>* scales_;
};

/// odeint StepAdjuster for every scalar: the factor is found in double.
template <class T>
class StepAdjuster {
 public:
  T decrease_step(T dt, T error, int error_order) const {
    return dt * T(std::max(0.9 * std::pow(static_cast<double>(error), -1.0 / error_order), 0.1));
  }
  T increase_step(T dt, T error, int stepper_order) const {
    const double factor = 0.9 * std::pow(std::max(static_cast<double>(error), 1e-10), -1.0 / stepper_order);
    return dt * T(std::clamp(factor, 1.0, 4.0));
  }
  bool check_step_size_limit(T) const { return true; }
  T get_max_dt() const { return T(0); }
};

}  // namespace earthtop
