// SPDX-License-Identifier: GPL-3.0-or-later
/// The common part of the variational equations of motions without their spin: they are recorded, and integrated by series.
#pragma once

#include <array>
#include <cstddef>

#include "drift/derivatives/variations.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// Records the variational equations of a driven top or of a compass, as they are at a state and a time.
template <template <class> class Equations>
taylor::Operations<double> record_variations(const Equations<double>& equations, const typename Equations<double>::State& x,
                                             double t);

/// A base for systems with the interface of GeneralVariations. A state is the motion, and the numbers of each disturbance.
/// @tparam Equations  a right-hand side for each scalar, with model, top, W_L (the rate of the laboratory) and has_Earth
template <template <class> class Equations, class ShapeOfState, bool kEarth>
class SpinlessVariations {
 public:
  using Shape = ShapeOfState;
  static constexpr std::size_t kMotionSize = Shape::kMotionSize, kSize = Shape::kSize;
  using State = std::array<double, kSize>;
  using Series = RecordedSeries<double, kSize>;

  explicit SpinlessVariations(const MotionProblem<double>& problem) {
    equations_.model = problem.model;
    equations_.top = reduced_top(problem.model);
    equations_.W_L = kEarth ? problem.model.W_IL_L : Vec3<double>(Vec3<double>::Zero());
    equations_.has_Earth = kEarth;
  }

  Series series() const {
    return Series([this](const State& x, double t) { return record_variations(equations_, x, t); });
  }
  void scale(State& x, std::size_t d, double factor) const {
    for (std::size_t k = 0; k < kEach; ++k) x[at(d) + k] *= factor;
  }
  /// The equations have no disturbances but those that a gimbal allows.
  void restrict(State&) const {}

 protected:
  static constexpr std::size_t kEach = (kSize - kMotionSize) / kDisturbances;
  static std::size_t at(std::size_t d) { return kMotionSize + kEach * d; }

  Equations<double> equations_{};
};

}  // namespace earthtop
