// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the events of a suspension (gimbal_event.hpp) between the states of an integration, by its own equations.
#pragma once

#include <utility>
#include <vector>

#include "drift/gimbals/gimbal_drift.hpp"
#include "drift/watch/close_in.hpp"
#include "drift/watch/flow_search.hpp"
#include "drift/watch/step_watcher.hpp"
#include "earthtop/drift/gimbal_event.hpp"

namespace earthtop {

template <class T, Observer O>
class GimbalWatch {
 public:
  using System = GimbalDrift<T, O>;
  using State = typename System::State;

  GimbalWatch(const System& system, const NaturalUnits& units) : system_(system), units_(units) {}

  void follow(T t, const State& x) {
    if (!system_.equations().model.gimbals.has_rotor) return;
    const Seen now = seen(t, x);
    if (is_started_ && t > t_) {
      if (before_.closing < T(0) && !(now.closing < T(0))) find(GimbalEventKind::gimbal_lock_passed, &Seen::closing, t, now);
      if ((before_.spin < T(0)) != (now.spin < T(0))) find(GimbalEventKind::rotor_reversed, &Seen::spin, t, now);
    }
    t_ = t, x_ = x, before_ = now, is_started_ = true;
  }
  const std::vector<GimbalEvent>& events() const { return events_; }

 private:
  /// Of the rotating motion.
  struct Seen {
    T square;   ///< of the sine of the angle between the rotor's axis and the outer one
    T closing;  ///< its rate
    T spin;     ///< of the rotor
    T outer_rate;
  };
  Seen seen(T t, const State& x) const {
    const Model<T>& model = system_.equations().model;
    const GimbalMotion<Paired<T>> m = system_.equations().motion(x, t);
    const Vec3<T> a_B = parts(m.axis_B, &Paired<T>::rot), c = model.rotor.axis_B;
    const T along = c.dot(a_B), turning = c.dot(a_B.cross(Vec3<T>(Vec3<T>::UnitY()))) * m.inner_rate.rot;
    const Vec3<T> across = c.cross(a_B);
    return {across.dot(across), T(-2) * along * turning, m.rotor_rate.rot, m.outer_rate.rot};
  }
  void find(GimbalEventKind kind, T Seen::*value, T t, const Seen& now) {
    T at = t_;
    State x = x_;
    Seen look = before_;
    const auto to = [&](T between) {
      if (between < at) at = t_, x = x_;
      GroupScales<T, GimbalShape> scales;
      scales.include(x_), scales.include(x);
      std::int64_t evaluations = 0;
      extrapolate(RightHandSide<T, System::kSize>(system_, evaluations), scales, T(512) * real::epsilon<T>(), at, between, x);
      at = between;
      look = seen(at, x);
      return look.*value;
    };
    close_in(t_, before_.*value, t, now.*value, to, [] { return false; });
    constexpr double kNear = 3.0458649045213493e-4;  // the square of the sine of a degree
    if (kind == GimbalEventKind::gimbal_lock_passed && !(look.square < T(kNear))) return;
    const auto number = [](const T& v) { return static_cast<double>(v); };
    events_.push_back({kind,
                       number(real::scale(at, units_.time_exponent)),
                       number(real::asin(real::sqrt(std::max(look.square, T(0))))),
                       number(units_.rate_to_rad_s(look.outer_rate)),
                       {}});
  }

  const System& system_;
  const NaturalUnits& units_;
  bool is_started_ = false;
  T t_ = T(0);
  State x_{};
  Seen before_{};
  std::vector<GimbalEvent> events_;
};

template <class T, Observer O>
struct EventWatchOf<T, GimbalDrift<T, O>> {
  using Type = GimbalWatch<T, O>;
};

}  // namespace earthtop
