// SPDX-License-Identifier: GPL-3.0-or-later
/// The members of summary.json about the motions themselves: the spin at the end, when spin and tilt come to given values, the swing of a
/// pendulum.
#pragma once

#include "results/member_entries.hpp"

namespace earthtop::figure_table {

inline const MotionReport::OfSwing& swing(R r) { return *r.motion->swing; }

/// A finite number as it is; else null.
inline Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// A number that is reported on wish; left out without the wish.
template <auto wish, auto member>
Json if_asked(R r) {
  return r.motion && (*r.motion).*wish ? json_from((*((*r.motion).*wish)).*member) : kLeftOut;
}
/// A time that is reported on wish, its bound, and whether it is sure.
/// @param time_s, bound_s, is_sure  paths, all of them in `motion`
template <auto wish, auto time, auto bound, auto sure>
constexpr std::array<SummaryMember, 3> reached(std::string_view time_s, std::string_view bound_s, std::string_view is_sure) {
  constexpr std::size_t kInside = std::string_view("motion.").size();
  return {
      of_event(compared(time_s, FigureKind::time, FigureScope::at_event, kAtEnd, [](R r) { return if_asked<wish, time>(r); }),
               time_s.substr(kInside), bound_s.substr(kInside)),
      told(bound_s, kAtEnd, kIsBounded, [](R r) { return if_asked<wish, bound>(r); }),
      told(is_sure, kAtEnd, kIsBounded, [](R r) { return if_asked<wish, sure>(r); })};
}

inline Json last_spin(R r, BoundedNumber BoundedPair::*motion, double BoundedNumber::*member) {
  return r.motion ? Json(r.motion->spin_end_rad_s.*motion.*member) : kLeftOut;
}

inline constexpr std::array kLastSpin = {told("motion.spin_final_rad_s", kAtEnd, kIsRow,
                                              [](R r) { return last_spin(r, &BoundedPair::rotating, &BoundedNumber::value); }),
                                         told("motion.spin_final_bound_rad_s", kAtEnd, kIsRow,
                                              [](R r) { return last_spin(r, &BoundedPair::rotating, &BoundedNumber::bound); }),
                                         told("motion.reference_spin_final_rad_s", kAtEnd, kIsRow, [](R r) {
                                           return last_spin(r, &BoundedPair::reference, &BoundedNumber::value);
                                         })};

inline constexpr std::array kSwingMembers = {
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

inline constexpr auto kMotionMembers = [] {
  using Reached = MotionReport::Reached;
  constexpr auto kSpin = &MotionReport::spin, kTilt = &MotionReport::tilt;
  return joined(
      kLastSpin,
      reached<kSpin, &Reached::rotating_s, &Reached::rotating_bound_s, &Reached::rotating_is_sure>(
          "motion.spin_reached_s", "motion.spin_reached_bound_s", "motion.spin_reached_is_sure"),
      reached<kSpin, &Reached::reference_s, &Reached::reference_bound_s, &Reached::reference_is_sure>(
          "motion.reference_spin_reached_s", "motion.reference_spin_reached_bound_s", "motion.reference_spin_reached_is_sure"),
      reached<kTilt, &Reached::rotating_s, &Reached::rotating_bound_s, &Reached::rotating_is_sure>(
          "motion.tilt_reached_s", "motion.tilt_reached_bound_s", "motion.tilt_reached_is_sure"),
      reached<kTilt, &Reached::reference_s, &Reached::reference_bound_s, &Reached::reference_is_sure>(
          "motion.reference_tilt_reached_s", "motion.reference_tilt_reached_bound_s", "motion.reference_tilt_reached_is_sure"),
      kSwingMembers);
}();

}  // namespace earthtop::figure_table
