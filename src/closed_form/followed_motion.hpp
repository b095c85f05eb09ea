// SPDX-License-Identifier: GPL-3.0-or-later
/// An exact motion followed in time, so that its quaternion is continuous. A closed form gives the attitude at any time, but
/// not how often it went round before. Where output rows are far apart, the motion is therefore also evaluated between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "earthtop/closed_form/exact_motion.hpp"
#include "earthtop/error.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// The motion is followed in double, which is enough to tell a quaternion from its opposite.
class FollowedMotion {
 public:
  /// @param q0_NB  attitude at t = 0; its sign is the one to be continued
  FollowedMotion(const ExactBody<double>& body, const Quaternion<double>& q0_NB, const Vec3<double>& w0_IB_B)
      : motion_(body, q0_NB, w0_IB_B), q_NB_(q0_NB), despun_(q0_NB) {}

  /// The attitude at t. Its sign is continuous if less than pi / turn_rate has passed since the last call.
  const Quaternion<double>& advance(double t) {
    q_NB_ = motion_.at(t).q_NB;
    Quaternion<double> despun = motion_.despun(q_NB_, t);
    if (despun.w * despun_.w + despun.v.dot(despun_.v) < 0) {
      q_NB_ = {-q_NB_.w, -q_NB_.v};
      despun = {-despun.w, -despun.v};
    }
    despun_ = despun;
    return q_NB_;
  }
  const Quaternion<double>& attitude() const { return q_NB_; }
  double turn_rate() const { return motion_.turn_rate(); }

 private:
  ExactMotion<double> motion_;
  Quaternion<double> q_NB_, despun_;
};

/// q or -q, whichever is nearer to `near`.
template <class T>
Quaternion<T> with_sign_of(const Quaternion<double>& near, const Quaternion<T>& q) {
  const T dot = q.w * T(near.w) + q.v[0] * T(near.v[0]) + q.v[1] * T(near.v[1]) + q.v[2] * T(near.v[2]);
  return dot < T(0) ? Quaternion<T>{-q.w, -q.v} : q;
}

/// Visits the times in order, and enough times between them that no step is longer than `longest_step`.
/// @param visit  called as visit(t, row), where row is the index of the time, or -1 between rows   @param watch  may stop it
template <class Visit>
RunStatus visit_times(const std::vector<double>& times, double longest_step, std::int64_t step_limit, const Watch& watch,
                      Visit&& visit) {
  std::int64_t visited = 0;
  for (std::size_t row = 0; row < times.size(); ++row) {
    const double before = row == 0 ? times[0] : times[row - 1], interval = times[row] - before;
    const double steps = std::max(1.0, std::ceil(interval / longest_step));
    if (!(steps < static_cast<double>(step_limit - visited))) return RunStatus::step_limit;
    const auto count = static_cast<std::int64_t>(steps);
    visited += count;
    for (std::int64_t k = 1; k <= count; ++k) {
      if (watch.asks_to_stop()) return RunStatus::interrupted;
      if (k % 64 == 1 && times.back() > 0) watch.reach((before + interval * (static_cast<double>(k) / steps)) / times.back());
      if (k == count)
        visit(times[row], static_cast<std::int64_t>(row));
      else
        visit(before + interval * (static_cast<double>(k) / steps), std::int64_t{-1});
    }
  }
  return RunStatus::completed;
}

}  // namespace earthtop
