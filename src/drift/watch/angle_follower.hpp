// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "drift/watch/turn_counter.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/real.hpp"

namespace earthtop {

/// Follows the two drift angles that can go round. Where one of them changes fast, as the azimuth does near the vertical, it
/// takes further looks in between.
/// @tparam Pair  has advance(t), which follows both motions to t, and followed_state(t), their drift state there
template <class Pair>
class AngleFollower {
 public:
  explicit AngleFollower(Pair& pair) : pair_(pair) {}

  /// Goes on to t, at most one of the pair's steps after the last time; leaves the pair followed to t.
  void follow_to(double t) {
    pair_.advance(t);
    looks_left_ = kMostLooks;
    follow_to(t, drift_phases(pair_.followed_state(t)));
  }
  double half_spin_offset() const { return half_spin_.offset(); }
  double azimuth_offset() const { return azimuth_.offset(); }
  /// Takes the phases of the row itself, which are more exact: where an angle is at +-pi, their digits decide on the side.
  template <class T>
  void settle(const DriftPhases<T>& phases) {
    take({static_cast<double>(phases.half_spin_sine), static_cast<double>(phases.half_spin_cosine), phases.azimuth_defined,
          static_cast<double>(phases.azimuth_sine), static_cast<double>(phases.azimuth_cosine)});
  }

 private:
  /// Enough looks for two at each of thirty halvings; more would only see the rounding of an axis that stands upright.
  static constexpr int kMostLooks = 60;

  /// Whether the angle has changed by more than a sixth of a turn.
  static bool far(double sine, double cosine, double last_sine, double last_cosine) {
    return sine * last_sine + cosine * last_cosine < 0.5 * real::hypot(sine, cosine) * real::hypot(last_sine, last_cosine);
  }
  bool far(const DriftPhases<double>& phases) const {
    return far(phases.half_spin_sine, phases.half_spin_cosine, last_.half_spin_sine, last_.half_spin_cosine) ||
           (phases.azimuth_defined && last_.azimuth_defined &&
            far(phases.azimuth_sine, phases.azimuth_cosine, last_.azimuth_sine, last_.azimuth_cosine));
  }
  void follow_to(double t, const DriftPhases<double>& phases) {
    while (far(phases) && looks_left_-- > 0) {
      const double middle = t_ + (t - t_) / 2;
      pair_.advance(middle);
      follow_to(middle, drift_phases(pair_.followed_state(middle)));
      pair_.advance(t);
    }
    take(phases);
    t_ = t;
  }
  void take(const DriftPhases<double>& phases) {
    half_spin_.follow(phases.half_spin_sine, phases.half_spin_cosine);
    if (phases.azimuth_defined) azimuth_.follow(phases.azimuth_sine, phases.azimuth_cosine);
    last_ = phases;
  }

  Pair& pair_;
  double t_ = 0;
  int looks_left_ = 0;
  DriftPhases<double> last_{0, 1, false, 0, 1};
  TurnCounter<double> half_spin_, azimuth_;
};

}  // namespace earthtop
