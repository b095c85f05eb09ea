// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a symmetric top that slides by exact dry friction, up to the stop of its slip. Under this law the slip
/// vanishes within a finite time, at which its direction, and with it the force, has no derivative. Each motion gets a clock sigma
/// of its own, dt = |v_P| dsigma: every right-hand side times |v_P|. Both slips then decay exponentially at the same sigma, the
/// equations are smooth to the end, and the time becomes a pair, whose difference is that of the two stops.
#pragma once

#include <array>

#include "drift/table/contact_reduced_equations.hpp"

namespace earthtop {

/// The state in laboratory axes (contact_reduced_equations.hpp), then the time of the reference, and that of the rotating motion
/// minus it, over epsilon. The two halves of the state are at the same sigma, not at the same time.
struct ContactSlipClockShape {
  using Slide = ContactReducedShape<Observer::laboratory>;
  static constexpr std::size_t kTime = Slide::kSize, kTimeDifference = kTime + 1, kSize = kTime + 2;
  static constexpr auto groups() {
    constexpr auto kSlide = Slide::groups();
    std::array<ComponentGroup, kSlide.size() + 2> all{};
    for (std::size_t i = 0; i < kSlide.size(); ++i) all[i] = kSlide[i];
    all[kSlide.size()] = {kTime, 1, 1.0};
    all[kSlide.size() + 1] = {kTimeDifference, 1, 1.0};
    // The slip is measured against its own size, however small: the caller forgets the sizes kept as it decays.
    for (ComponentGroup& group : all)
      if (group.begin == Slide::kSlip || group.begin == Slide::kHalf + Slide::kSlip) group.least_scale = 1e-30;
    return all;
  }
};

template <class T>
class ContactSlipClock {
 public:
  using Shape = ContactSlipClockShape;
  using Slide = ContactReducedEquations<T, Observer::laboratory>;
  using SlideShape = typename Slide::Shape;
  using SlideState = typename Slide::State;
  using P = Paired<T>;
  static constexpr std::size_t kSize = Shape::kSize, kHalf = SlideShape::kHalf;
  using State = std::array<T, kSize>;

  explicit ContactSlipClock(const Slide& slide) : slide_(slide) {}

  void operator()(const State& x, State& dxdt, T) const {
    const SlideState now = sliding_state(x);
    ReducedContactRates<P> rates;
    Vec3<P> a_dot;
    const auto instant = slide_.instant(now, x[Shape::kTime]);
    slide_.rates_of(instant, rates, a_dot);
    const P speed = slip(now);
    ReducedContactRates<P> scaled;
    scaled.n = speed * rates.n, scaled.u = speed * rates.u, scaled.w3 = speed * rates.w3;
    scaled.v_P = speed * rates.v_P, scaled.p_O = speed * rates.p_O;
    SlideState rate;
    slide_.store(now, scaled, Vec3<P>(speed * a_dot), rate);
    // The whole phase of the rotating motion goes on with its own time.
    const T k = now[kHalf + SlideShape::kSpin], w3 = slide_.w3() + now[SlideShape::kSpin];
    rate[SlideShape::kPhase] = now[SlideShape::kSpin] * speed.ref;
    rate[kHalf + SlideShape::kPhase] = (P(w3, w3 + slide_.model().epsilon * k, k) * speed).diff;
    // The integrals, too, are each motion's own.
    slide_.store_integrals(instant, rates.reaction, rate);
    for (const std::size_t i : {SlideShape::kWork, SlideShape::kJellett}) rate[i] *= speed.ref, rate[kHalf + i] *= speed.rot;
    for (std::size_t i = 0; i < SlideShape::kSize; ++i) dxdt[i] = rate[i];
    dxdt[Shape::kTime] = speed.ref, dxdt[Shape::kTimeDifference] = speed.diff;
  }

  State started(const SlideState& x, T t) const {
    State made{};
    for (std::size_t i = 0; i < SlideShape::kSize; ++i) made[i] = x[i];
    made[Shape::kTime] = t;
    return made;
  }
  static SlideState sliding_state(const State& x) {
    SlideState now;
    for (std::size_t i = 0; i < SlideShape::kSize; ++i) now[i] = x[i];
    return now;
  }
  /// The sizes of both slips.
  P slip(const SlideState& x) const {
    const Vec3<P> v = slide_.top(x, T(0)).state.v_P;
    return real::sqrt(inner(v, v));
  }
  /// The times of both stops, from states whose slip is nearly gone: what is left of it decays at its present rate.
  P stop_time(const State& x) const {
    const SlideState now = sliding_state(x);
    ReducedContactRates<P> rates;
    Vec3<P> a_dot;
    slide_.rates_of(slide_.instant(now, x[Shape::kTime]), rates, a_dot);
    const Vec3<P> v = slide_.top(now, T(0)).state.v_P;
    const P difference(x[Shape::kTime], x[Shape::kTime] + slide_.model().epsilon * x[Shape::kTimeDifference],
                       x[Shape::kTimeDifference]);
    return difference - inner(v, v) / inner(v, rates.v_P);
  }
  /// The state without slip, from which both motions roll on, each from its own stop. What errors of the steps have left of
  /// n.n - 1 and u.n is taken away, in both motions and in their difference: rolling would keep it as an error of the spin.
  SlideState stopped(const State& x) const {
    SlideState now = sliding_state(x);
    for (std::size_t i = 0; i < 2; ++i) now[SlideShape::kSlip + i] = now[kHalf + SlideShape::kSlip + i] = T(0);
    const ReducedContactState<P> top = slide_.top(now, T(0)).state;
    const P length = real::sqrt(inner(top.n, top.n));
    const Vec3<P> n(top.n[0] / length, top.n[1] / length, top.n[2] / length), u = top.u - inner(top.u, n) * n;
    for (std::size_t i = 0; i < 3; ++i) {
      const int axis = static_cast<int>(i);
      now[SlideShape::kN + i] = n[axis].ref, now[kHalf + SlideShape::kN + i] = n[axis].diff;
      now[SlideShape::kU + i] = u[axis].ref, now[kHalf + SlideShape::kU + i] = u[axis].diff;
    }
    return now;
  }

 private:
  const Slide& slide_;
};

/// Takes the rotating motion of a state, which is ahead of the reference by epsilon * ahead, to the reference's time t, by one
/// step of the classical Runge-Kutta method. The step is of order epsilon; as its increment is divided by epsilon, nothing cancels.
template <class T>
typename ContactReducedEquations<T, Observer::laboratory>::State at_reference_time(
    const ContactReducedEquations<T, Observer::laboratory>& equations,
    const typename ContactReducedEquations<T, Observer::laboratory>::State& x, T t, T ahead) {
  using Equations = ContactReducedEquations<T, Observer::laboratory>;
  using Shape = typename Equations::Shape;
  using P = Paired<T>;
  const T epsilon = equations.model().epsilon;
  // Rates of the rotating motion, stored as those of the differences.
  const auto rates = [&](const typename Equations::State& at) {
    ReducedContactRates<P> found;
    Vec3<P> a_dot;
    const auto instant = equations.instant(at, t);
    equations.rates_of(instant, found, a_dot);
    const auto rotating = [](const Vec3<P>& v) {
      return Vec3<P>(P(T(0), T(0), v[0].rot), P(T(0), T(0), v[1].rot), P(T(0), T(0), v[2].rot));
    };
    ReducedContactRates<P> moved;
    moved.n = rotating(found.n), moved.u = rotating(found.u), moved.v_P = rotating(found.v_P), moved.p_O = rotating(found.p_O);
    moved.w3 = P(T(0), T(0), found.w3.rot);
    typename Equations::State rate;
    equations.store(at, moved, rotating(a_dot), rate);
    equations.store_integrals(instant, found.reaction, rate);
    for (const std::size_t i : {Shape::kWork, Shape::kJellett}) rate[Shape::kHalf + i] *= epsilon;
    rate[Shape::kHalf + Shape::kPhase] = equations.w3() + at[Shape::kSpin] + epsilon * at[Shape::kHalf + Shape::kSpin];
    return rate;
  };
  // A difference grows by the rate of the rotating motion times -ahead; the motion itself by epsilon times that.
  const auto moved = [&](const typename Equations::State& rate, T part) {
    typename Equations::State at = x;
    for (std::size_t i = Shape::kHalf; i < Shape::kSize; ++i) at[i] -= part * ahead * rate[i];
    return at;
  };
  const auto k1 = rates(x), k2 = rates(moved(k1, T(1) / T(2))), k3 = rates(moved(k2, T(1) / T(2))), k4 = rates(moved(k3, T(1)));
  typename Equations::State sum;
  for (std::size_t i = 0; i < Shape::kSize; ++i) sum[i] = (k1[i] + T(2) * (k2[i] + k3[i]) + k4[i]) / T(6);
  return moved(sum, T(1));
}

}  // namespace earthtop
