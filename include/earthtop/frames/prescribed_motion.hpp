// SPDX-License-Identifier: GPL-3.0-or-later
/// A prescribed rotation about a fixed axis: the motion of a platform, of the Earth, or of any layer of a frame stack.
#pragma once

#include <memory>

#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/frames/journey.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/members.hpp"

namespace earthtop {

/// angle(t) = angle0 + rate t + acceleration t^2 / 2 + amplitude sin(2 pi frequency t + phase) + table(t) - turned(t), about `axis`,
/// where turned(t) is the turn of a journey's course since its start, clockwise from above. Each kind of motion (constant rate, ramp,
/// harmonic, table, course) leaves the terms of the others zero; for a layer at rest all are zero.
template <class T>
struct PrescribedMotion {
  Vec3<T> axis = Vec3<T>::UnitZ();                        ///< unit vector; the same components in the parent and in the layer
  T angle0 = T(0);                                        ///< rad
  T rate = T(0);                                          ///< rad/s
  T acceleration = T(0);                                  ///< rad/s^2
  T amplitude = T(0);                                     ///< rad
  T frequency = T(0);                                     ///< Hz
  T phase = T(0);                                         ///< rad
  std::shared_ptr<const AngleSpline<T>> table = nullptr;  ///< null if there is no table
  std::shared_ptr<const Journey<T>> journey = nullptr;    ///< with whose course the layer turns; null if it does not
  EARTHTOP_MEMBERS(axis, angle0, rate, acceleration, amplitude, frequency, phase, table, journey)

  T angle(T t) const {
    const T formula = angle0 + t * (rate + t * acceleration / T(2)) + amplitude * real::sin(argument(t));
    if (journey) return formula - journey->turned(t, 0);
    return table ? formula + table->angle(t) : formula;
  }
  T angle_rate(T t) const {
    const T formula = rate + t * acceleration + amplitude * pulsation() * real::cos(argument(t));
    if (journey) return formula - journey->turned(t, 1);
    return table ? formula + table->angle_rate(t) : formula;
  }
  T angle_acceleration(T t) const {
    const T formula = acceleration - amplitude * pulsation() * pulsation() * real::sin(argument(t));
    if (journey) return formula - journey->turned(t, 2);
    return table ? formula + table->angle_acceleration(t) : formula;
  }
  /// An upper bound of |angle_rate| from 0 to `end`.
  T largest_rate(T end) const {
    const T formula = real::abs(rate) + end * real::abs(acceleration) + real::abs(amplitude * pulsation());
    if (journey) return formula + journey->largest_turning(end);
    return table ? formula + table->largest_rate() : formula;
  }
  /// Whether the layer stays parallel to its parent.
  bool never_turns() const {
    return angle0 == T(0) && rate == T(0) && acceleration == T(0) && amplitude == T(0) && (!table || table->is_zero()) &&
           !journey;
  }

 private:
  T pulsation() const { return T(2) * real::pi<T>() * frequency; }
  T argument(T t) const { return pulsation() * t + phase; }
};

/// The same motion with times in units of 2^time_exponent s; no digit changes.
template <class T>
PrescribedMotion<T> in_time_units(PrescribedMotion<T> motion, int time_exponent) {
  motion.rate = real::scale(motion.rate, time_exponent);
  motion.acceleration = real::scale(motion.acceleration, 2 * time_exponent);
  motion.frequency = real::scale(motion.frequency, time_exponent);
  if (motion.table) motion.table = std::make_shared<const AngleSpline<T>>(motion.table->in_time_units(time_exponent));
  if (motion.journey) motion.journey = std::make_shared<const Journey<T>>(motion.journey->in_time_units(time_exponent));
  return motion;
}

}  // namespace earthtop
