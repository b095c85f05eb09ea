// SPDX-License-Identifier: GPL-3.0-or-later
/// One motion on a table and its derivatives along several changes at once: of its inputs (contact_change.hpp), or of its start.
#pragma once

#include "drift/derivatives/contact_change.hpp"
#include "drift/table/contact_general_drift.hpp"
#include "drift/table/contact_reduced_drift.hpp"
#include "integrate/taylor/tangent_shape.hpp"

namespace earthtop {

/// A motion is followed with its derivatives for at most this many steps.
inline constexpr std::int64_t kMostTangentSteps = 20'000'000;
inline constexpr std::size_t kMostContactChanges = 6;
/// Changes of the inputs, or none where only the start changes.
struct ContactChanges {
  std::size_t count = 0;  ///< of derivatives that are followed
  std::array<ContactChange<double>, kMostContactChanges> of_inputs = {};
};

/// The reference alone of equations of a pair in laboratory axes, with its derivatives.
/// @param x  the motion and its derivatives at which they are recorded
taylor::Operations<double> record_contact_tangents(const ContactReducedEquations<double, Observer::laboratory>& equations,
                                                   const ContactChanges& changes, std::span<const double> x, double t);
taylor::Operations<double> record_contact_tangents(const ContactGeneralEquations<double, Observer::laboratory>& equations,
                                                   const ContactChanges& changes, std::span<const double> x, double t);

/// The system of a motion with its derivatives, for steps of a Taylor series.
/// @tparam Drift  ContactReducedDrift or ContactGeneralDrift of double, in laboratory axes
template <class Drift>
class ContactTangents {
 public:
  using Equations = typename Drift::Equations;
  using PairState = typename Equations::State;
  using Half = typename Equations::Half;
  static constexpr std::size_t kEach = Equations::kHalf;
  /// Slip and position are lengths, whose changes are often small.
  static constexpr double least_scale(double of_motion) { return of_motion < 1e-3 ? 1e-9 : 1e-5; }
  using Shape = taylor::TangentShape<typename Equations::Shape, kEach, kMostContactChanges, least_scale>;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<double, kSize>;
  using Series = RecordedSeries<double, kSize>;

  /// @param drift  a pair whose model has epsilon = 0 (without_earth_rate)
  ContactTangents(Drift drift, const ContactChanges& changes) : drift_(std::move(drift)), changes_(changes) {}

  const Drift& drift() const { return drift_; }
  State initial_state() const { return alone(drift_.initial_state()); }
  State typical_state() const { return alone(drift_.typical_state()); }
  /// The motion with one of its derivatives as the difference of a pair.
  static PairState pair(const State& x, std::size_t c) { return Equations::pair(half(x, 0), half(x, 1 + c)); }
  /// Sets a derivative.   @param both  the motion, with the derivative as the difference
  static void put_change(const PairState& both, State& x, std::size_t c) {
    std::ranges::copy(Equations::tangent(both), x.begin() + static_cast<std::ptrdiff_t>((1 + c) * kEach));
  }
  ContactDriftState<double> contact_state(const State& x, std::size_t c, double t) const {
    return drift_.contact_state(pair(x, c), t);
  }
  Series series() const {
    return Series([this](const State& x, double t) { return record_contact_tangents(drift_.equations(), changes_, x, t); });
  }

 private:
  static Half half(const State& x, std::size_t slot) {
    Half taken;
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(slot * kEach), kEach, taken.begin());
    return taken;
  }
  static State alone(const PairState& both) {
    State x{};
    std::copy_n(both.begin(), kEach, x.begin());
    return x;
  }

  Drift drift_;
  ContactChanges changes_;
};

}  // namespace earthtop
