// SPDX-License-Identifier: GPL-3.0-or-later
/// A tide as a scenario gives it.
#pragma once

#include <array>

namespace earthtop {

/// Which bodies raise the tide, and how the Earth responds. For a rigid Earth both factors are 1. On the elastic Earth a
/// gravimeter measures the vertical part times the gravimetric factor, about 1.16, and a plumb line fixed to the ground the
/// horizontal part times the tilt factor, about 0.69 [Melchior 1983; for degree 2, without oceans].
struct TideOptions {
  bool moon = true;
  bool sun = true;
  double gravimetric_factor = 1;
  double tilt_factor = 1;
  bool operator==(const TideOptions&) const = default;
};

/// A tide: either that of Moon and Sun from the scenario's start onward, or a harmonic oscillation of given amplitude.
struct TideSpec {
  bool given = false;
  TideOptions options;                               ///< for the tide of Moon and Sun
  std::array<double, 3> amplitude_m_s2 = {0, 0, 0};  ///< for the harmonic tide: East, North, Up
  double frequency_hz = 0;
  double phase_deg = 0;
  bool operator==(const TideSpec&) const = default;
};

}  // namespace earthtop
