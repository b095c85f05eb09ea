// SPDX-License-Identifier: GPL-3.0-or-later
/// Slides to the stop of the slip under the exact Coulomb law, by the clocks of both motions (contact_slip_clock.hpp), and rolls
/// on from there.
#pragma once

#include <algorithm>
#include <optional>

#include "drift/table/contact_reduced_drift.hpp"
#include "drift/table/contact_slip_clock.hpp"
#include "earthtop/watch.hpp"
#include "integrate/extrapolation.hpp"
#include "integrate/right_hand_side.hpp"

namespace earthtop {

/// The stops of both slips.
template <class T>
struct SlipStop {
  Paired<T> time;                                                          ///< in natural units
  typename ContactReducedEquations<T, Observer::laboratory>::State state;  ///< both motions, each at its own stop
};

/// Whether the tip slips at release, in the reference; a slip of the size of its terms' rounding is none.
template <class T>
bool slips_at_release(const ContactReducedDrift<T, Observer::laboratory>& drift) {
  using Equations = ContactReducedEquations<T, Observer::laboratory>;
  using Shape = typename Equations::Shape;
  const auto start = drift.initial_state(), typical = drift.typical_state();
  const T rounding = T(64) * real::epsilon<T>() * typical[Shape::kSpin] * typical[Shape::kPosition];
  return ContactSlipClock<T>(drift.equations()).slip(start).ref > rounding;
}

/// @param start  the state at release   @param end  time beyond which no stop is sought   @returns none if there is none
template <class T>
std::optional<SlipStop<T>> slide_to_stop(const ContactReducedDrift<T, Observer::laboratory>& drift,
                                         const typename ContactReducedDrift<T, Observer::laboratory>::State& start, T end,
                                         T relative_tolerance, const Watch& watch) {
  using Clock = ContactSlipClock<T>;
  using Shape = typename Clock::Shape;
  using Slide = typename Clock::SlideShape;
  constexpr int kMostSteps = 200'000;
  const Clock clock(drift.equations());
  auto x = clock.started(start, T(0));
  std::int64_t evaluations = 0;
  const RightHandSide<T, Shape::kSize> equations(clock, evaluations);
  if (!slips_at_release(drift)) return SlipStop<T>{{}, clock.stopped(x)};
  const T at_start = clock.slip(start).ref;
  // The slip that is left decays at its present rate, to first order: it may be the root of the round-off for the last
  // digits of the stop, and is taken much smaller as the direction converges like a power of what is left.
  const T gone = T(0.1) * real::epsilon<T>() * at_start;
  // Errors are measured against what a state is made of, but those of a slip only against the slip itself: measured against the one
  // at release, a slip that dies out would be lost in them, and never be gone.
  auto sizes = clock.started(drift.typical_state(), T(1));
  for (const std::size_t i : {Slide::kSlip, Slide::kHalf + Slide::kSlip}) sizes[i] = sizes[i + 1] = T(0);
  T sigma = T(0), step = T(0.01);
  int steps = 0;
  for (T slip = at_start; slip > gone;) {
    // The sizes that errors are measured against are kept for one power of ten of the slip.
    GroupScales<T, Shape> scales;
    scales.include(x), scales.include(sizes);
    Extrapolation<T, Shape> stepper(relative_tolerance, scales);
    const T next = slip / T(10), most = T(10) * slip;
    for (; slip > next; slip = clock.slip(Clock::sliding_state(x)).ref) {
      if (++steps > kMostSteps || watch.asks_to_stop() || !all_finite(x) || x[Shape::kTime] > end) return std::nullopt;
      stepper.try_step(equations, x, sigma, step);
      if (slip > most) break;
    }
  }
  return SlipStop<T>{clock.stop_time(x), clock.stopped(x)};
}

/// The motions after the stops: they roll, each from its own stop, for equal durations. All that is shown of them is at the
/// reference's time.
template <class T>
class ContactRolledOn : public ContactReducedDrift<T, Observer::laboratory> {
  using Base = ContactReducedDrift<T, Observer::laboratory>;

 public:
  using State = typename Base::State;
  /// @param drift  before the stop   @param stop  outlives this
  ContactRolledOn(const Base& drift, const SlipStop<T>& stop) : Base(drift), stop_(stop) { this->set_law(ContactLaw::rolling); }

  State initial_state() const { return stop_.state; }
  void follow(const State& x, T t) { Base::follow(seen(x, t), t); }
  DriftState<T> shared_state(const State& x, T t) const { return Base::shared_state(seen(x, t), t); }
  DriftState<T> deviation_state(const State& x, T t) const { return Base::deviation_state(seen(x, t), t); }
  ContactDriftState<T> contact_state(const State& x, T t) const { return Base::contact_state(seen(x, t), t); }

 private:
  State seen(const State& x, T t) const { return at_reference_time(this->equations(), x, t, stop_.time.diff); }
  SlipStop<T> stop_;
};

}  // namespace earthtop
