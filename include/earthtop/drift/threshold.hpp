// SPDX-License-Identifier: GPL-3.0-or-later
/// When the axis drift first passes a threshold: what an integration finds out about it on its way.
#pragma once

#include <array>
#include <optional>

#include "earthtop/vectors.hpp"

namespace earthtop {

/// The axis drift at one instant, and how fast it changes.
template <class T>
struct AxisLook {
  T t = T(0);
  T axis = T(0);                              ///< angle between the two axes (rad)
  T rate = T(0);                              ///< of that angle
  Vec3<T> difference = Vec3<T>::Zero();       ///< of the two axes, laboratory
  Vec3<T> difference_rate = Vec3<T>::Zero();  ///< which says how fast the drift can change where `rate` happens to be zero
};

/// What one integration tells of the threshold; times as the integration has them until `in_seconds`.
///
/// An error of the drift moves the passing. By how much is known only when that error is, which the integration itself does not
/// know: the record keeps what the answer takes. Near the passing that is the drift's rate and curvature; farther away, when
/// the drift first came within a part of the threshold of it, and when it first was that part above it.
template <class T>
struct ThresholdRecord {
  static constexpr int kParts = 60;  ///< of the threshold: 1, 1/2, 1/4, ...
  std::optional<AxisLook<T>> passing;
  T curvature = T(0);       ///< second derivative of the drift there
  T resolved = T(0);        ///< rate and curvature describe the drift this long before and after the passing
  T highest = T(0);         ///< the largest drift before the passing, or of all if there is none
  T turned_back = T(0);     ///< the largest drift before the passing from which it then fell
  bool fell_after = false;  ///< whether the drift came back below the threshold after the passing
  bool unresolved = false;  ///< whether the drift oscillates faster than it was looked at: it may have passed before
  T last_t = T(0);          ///< of the last look
  /// When the drift was less than this part of the threshold below it, at the earliest.
  std::array<std::optional<T>, kParts> within;
  /// When the drift had been this part above it, at the latest.
  std::array<std::optional<T>, kParts> beyond;

  /// The same in seconds. @param exponent  a unit of time is 2^exponent s
  ThresholdRecord in_seconds(int exponent) const {
    ThresholdRecord seconds = *this;
    const auto scale_time = [exponent](T& t) { t = real::scale(t, exponent); };
    const auto scale_rate = [exponent](T& w) { w = real::scale(w, -exponent); };
    if (seconds.passing) {
      scale_time(seconds.passing->t), scale_rate(seconds.passing->rate);
      for (int i = 0; i < 3; ++i) scale_rate(seconds.passing->difference_rate[i]);
    }
    scale_rate(seconds.curvature), scale_rate(seconds.curvature);
    scale_time(seconds.resolved), scale_time(seconds.last_t);
    for (auto* times : {&seconds.within, &seconds.beyond})
      for (std::optional<T>& t : *times)
        if (t) scale_time(*t);
    return seconds;
  }
  std::optional<double> time_s() const { return passing ? std::optional(static_cast<double>(passing->t)) : std::nullopt; }
};

}  // namespace earthtop
