// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the Moon, the Sun and the Earth's axes are: what the tide and the precession are made of.
#pragma once

#include "earthtop/frames/rotation.hpp"
#include "earthtop/frames/utc_instant.hpp"

namespace earthtop {

/// Terrestrial time as a Julian date in two parts.
struct TerrestrialTime {
  double day = 0;
  double fraction = 0;
};
TerrestrialTime terrestrial_time(const UtcInstant& utc, double seconds_later = 0);

/// From the Earth's centre in the axes of the geocentric celestial frame (m), geometric, no light time: gravitation shows no
/// aberration. Moon to some 10 arcsec and 10 km [Meeus' abridged ELP, eraMoon98], Sun to some 0.01 arcsec [eraEpv00].
Vec3<double> moon_position_I(const TerrestrialTime& tt);
Vec3<double> sun_position_I(const TerrestrialTime& tt);

/// Unit vector along the mean axis of the Earth (precession without nutation) [IAU 2006, eraPmat06].
Vec3<double> mean_axis_I(const TerrestrialTime& tt);

/// R_EI: from celestial axes to Earth-fixed ones [IAU 2000B precession and nutation, 0.001 arcsec]. UT1 is taken for UTC (they
/// stay within 0.9 s, or 14 arcsec of the Earth's turn) and flows on evenly after `utc`; the pole is the z axis.
Mat3<double> celestial_to_terrestrial(const UtcInstant& utc, double seconds_later = 0);

}  // namespace earthtop
