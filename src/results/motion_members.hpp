// SPDX-License-Identifier: GPL-3.0-or-later
/// The members of summary.json about the motions themselves: the spin at the end, when spin and tilt come to given values, the swing of a
/// pendulum.
#pragma once

#include "results/member_entries.hpp"

namespace earthtop::figure_table {

inline const MotionReport::OfSwing& swing(R r) { return *r.motion->swing; }

/// What is finite; else null.
inline Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// A number of what is reported on wish; left out without the wish.
inline Json if_asked(R r, std::optional<MotionReport::Reached> MotionReport::*wish,
                     std::optional<double> MotionReport::Reached::*member) {
  if (!r.motion || !((*r.motion).*wish)) return kLeftOut;
  return json_from((*((*r.motion).*wish)).*member);
}
inline Json is_sure(R r, std::optional<MotionReport::Reached> MotionReport::*wish, bool MotionReport::Reached::*member) {
  return r.motion && (*r.motion).*wish ? Json((*((*r.motion).*wish)).*member) : kLeftOut;
}
inline Json last_spin(R r, BoundedNumber BoundedPair::*motion, double BoundedNumber::*member) {
  return r.motion ? Json(r.motion->spin_end_rad_s.*motion.*member) : kLeftOut;
}

inline constexpr auto kMotionMembers = [] {
  using enum FigureKind;
  using enum FigureScope;
  using Reached = MotionReport::Reached;
  return std::array{
      told("motion.spin_final_rad_s", kAtEnd, kIsRow,
           [](R r) { return last_spin(r, &BoundedPair::rotating, &BoundedNumber::value); }),
      told("motion.spin_final_bound_rad_s", kAtEnd, kIsRow,
           [](R r) { return last_spin(r, &BoundedPair::rotating, &BoundedNumber::bound); }),
      told("motion.reference_spin_final_rad_s", kAtEnd, kIsRow,
           [](R r) { return last_spin(r, &BoundedPair::reference, &BoundedNumber::value); }),
      of_event(compared("motion.spin_reached_s", time, at_event, kAtEnd,
                        [](R r) { return if_asked(r, &MotionReport::spin, &Reached::rotating_s); }),
               "spin_reached_s", "spin_reached_bound_s"),
      told("motion.spin_reached_bound_s", kAtEnd, kIsBounded,
           [](R r) { return if_asked(r, &MotionReport::spin, &Reached::rotating_bound_s); }),
      told("motion.spin_reached_is_sure", kAtEnd, kIsBounded,
           [](R r) { return is_sure(r, &MotionReport::spin, &Reached::rotating_is_sure); }),
      of_event(compared("motion.reference_spin_reached_s", time, at_event, kAtEnd,
                        [](R r) { return if_asked(r, &MotionReport::spin, &Reached::reference_s); }),
               "reference_spin_reached_s", "reference_spin_reached_bound_s"),
      told("motion.reference_spin_reached_bound_s", kAtEnd, kIsBounded,
           [](R r) { return if_asked(r, &MotionReport::spin, &Reached::reference_bound_s); }),
      told("motion.reference_spin_reached_is_sure", kAtEnd, kIsBounded,
           [](R r) { return is_sure(r, &MotionReport::spin, &Reached::reference_is_sure); }),
      of_event(compared("motion.tilt_reached_s", time, at_event, kAtEnd,
                        [](R r) { return if_asked(r, &MotionReport::tilt, &Reached::rotating_s); }),
               "tilt_reached_s", "tilt_reached_bound_s"),
      told("motion.tilt_reached_bound_s", kAtEnd, kIsBounded,
           [](R r) { return if_asked(r, &MotionReport::tilt, &Reached::rotating_bound_s); }),
      told("motion.tilt_reached_is_sure", kAtEnd, kIsBounded,
           [](R r) { return is_sure(r, &MotionReport::tilt, &Reached::rotating_is_sure); }),
      of_event(compared("motion.reference_tilt_reached_s", time, at_event, kAtEnd,
                        [](R r) { return if_asked(r, &MotionReport::tilt, &Reached::reference_s); }),
               "reference_tilt_reached_s", "reference_tilt_reached_bound_s"),
      told("motion.reference_tilt_reached_bound_s", kAtEnd, kIsBounded,
           [](R r) { return if_asked(r, &MotionReport::tilt, &Reached::reference_bound_s); }),
      told("motion.reference_tilt_reached_is_sure", kAtEnd, kIsBounded,
           [](R r) { return is_sure(r, &MotionReport::tilt, &Reached::reference_is_sure); }),
      // A pendulum's swing on the rotating Earth. The plane's azimuth grows clockwise, seen from above; the apsidal rate is that of the
      // non-rotating prediction's plane.
      object_or_nothing("motion.swing", [](R r) { return r.motion && r.motion->swing; }),
      told("motion.swing.major_start_rad", kAtEnd, kOfEnds, [](R r) { return swing(r).major_start_rad.rotating.value; }),
      told("motion.swing.minor_start_rad", kAtEnd, kOfEnds, [](R r) { return swing(r).minor_start_rad.rotating.value; }),
      told("motion.swing.major_end_rad", kAtEnd, kOfEnds, [](R r) { return swing(r).major_end_rad.rotating.value; }),
      told("motion.swing.major_end_bound_rad", kAtEnd, kOfEnds,
           [](R r) { return finite(swing(r).major_end_rad.rotating.bound); }),
      told("motion.swing.minor_end_rad", kAtEnd, kOfEnds, [](R r) { return swing(r).minor_end_rad.rotating.value; }),
      told("motion.swing.minor_end_bound_rad", kAtEnd, kOfEnds,
           [](R r) { return finite(swing(r).minor_end_rad.rotating.bound); }),
      told("motion.swing.plane_rate_rad_s", kAtEnd, kOfEnds, [](R r) { return swing(r).plane_rate_rad_s.rotating.value; }),
      told("motion.swing.plane_rate_bound_rad_s", kAtEnd, kOfEnds,
           [](R r) { return finite(swing(r).plane_rate_rad_s.rotating.bound); }),
      told("motion.swing.apsidal_rate_rad_s", kAtEnd, kOfEnds, [](R r) { return swing(r).plane_rate_rad_s.reference.value; }),
      told("motion.swing.apsidal_rate_bound_rad_s", kAtEnd, kOfEnds,
           [](R r) { return finite(swing(r).plane_rate_rad_s.reference.bound); })};
}();

}  // namespace earthtop::figure_table
