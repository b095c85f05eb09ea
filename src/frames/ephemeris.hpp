// SPDX-License-Identifier: GPL-3.0-or-later
/// Positions of the Moon and the Sun and orientation of the Earth's axes, for the tide and the precession.
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

/// Position relative to the Earth's centre in the axes of the geocentric celestial frame (m). It is geometric, without light
/// time, because gravitation shows no aberration. Accuracy: Moon some 10 arcsec and 10 km [Meeus' abridged ELP, eraMoon98], Sun
/// some 0.01 arcsec [eraEpv00].
Vec3<double> moon_position_I(const TerrestrialTime& tt);
Vec3<double> sun_position_I(const TerrestrialTime& tt);

/// Unit vector along the mean axis of the Earth (precession without nutation) [IAU 2006, eraPmat06].
Vec3<double> mean_axis_I(const TerrestrialTime& tt);

/// R_EI: takes celestial to Earth-fixed axes [IAU 2000B precession and nutation, 0.001 arcsec]. UT1 is taken equal to UTC (they
/// differ by less than 0.9 s, or 14 arcsec of the Earth's rotation) and runs on evenly after `utc`; the pole is the z axis.
Mat3<double> celestial_to_terrestrial(const UtcInstant& utc, double seconds_later = 0);

}  // namespace earthtop
