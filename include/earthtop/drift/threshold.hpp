// SPDX-License-Identifier: GPL-3.0-or-later
/// The record that an integration keeps about the time at which the axis drift first passes a threshold.
#pragma once

#include <array>
#include <optional>

#include "earthtop/vectors.hpp"

namespace earthtop {

/// The axis drift at one instant, and how fast it changes.
template <class T>
struct AxisDriftSample {
  T t = T(0);
  T axis = T(0);                              ///< angle between the two axes (rad)
  T rate = T(0);                              ///< time derivative of that angle
  Vec3<T> difference = Vec3<T>::Zero();       ///< rotating axis minus reference axis, in laboratory axes
  Vec3<T> difference_rate = Vec3<T>::Zero();  ///< its time derivative: bounds how fast the drift changes where `rate` is 0
};

/// The findings of one integration about the threshold. Times are in the integration's own unit until `in_seconds` converts
/// them.
///
/// An error of the drift moves the passing. By how much is known only once that error is, which is after the integration. So
/// the record keeps what is needed for this: near the passing, the drift's rate and curvature; farther away,
/// the times at which the drift came within some part of the threshold below it, and exceeded it by that part.
template <class T>
struct ThresholdRecord {
  static constexpr int kParts = 60;           ///< number of parts of the threshold that are used: 1, 1/2, 1/4, ...
  std::optional<AxisDriftSample<T>> passing;  ///< the first passing; none if there was none
  T curvature = T(0);                         ///< second derivative of the drift there
  T resolved = T(0);                          ///< how long before and after the passing rate and curvature describe the drift
  T highest = T(0);                           ///< the largest drift before the passing, or of the whole run if there is none
  T turned_back = T(0);                       ///< the largest drift before the passing from which the drift then fell
  bool fell_after = false;                    ///< whether the drift came back below the threshold after the passing
  bool unresolved = false;  ///< whether the drift oscillates faster than it was looked at: it may have passed earlier
  T last_t = T(0);          ///< time of the last look
  /// For each part: the earliest time at which the drift may have been less than that part of the threshold below it.
  std::array<std::optional<T>, kParts> within;
  /// For each part: the latest time at which the drift first was that part of the threshold above it.
  std::array<std::optional<T>, kParts> beyond;

  /// The same record in seconds. @param exponent  the integration's unit of time is 2^exponent s
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
