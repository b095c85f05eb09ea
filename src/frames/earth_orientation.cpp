// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/earth_orientation.hpp"

#include "frames/ephemeris.hpp"

namespace earthtop {

Vec3<double> precession_rate_I(const UtcInstant& utc) {
  const double year_s = 365.25 * 86400;
  const Vec3<double> before = mean_axis_I(terrestrial_time(utc, -year_s)), after = mean_axis_I(terrestrial_time(utc, year_s));
  // n x dn/dt with n at the middle instant: the result is exactly normal to n.
  return mean_axis_I(terrestrial_time(utc)).cross(after - before) / (2 * year_s);
}

Vec3<double> precession_rate_L(const Site& site, const UtcInstant& utc) {
  const Vec3<double> rate_E = celestial_to_terrestrial(utc) * precession_rate_I(utc);
  return laboratory_attitude<double>(site).inverse() * rate_E;
}

template <class T>
Vec3<T> corrected_celestial_axis_L(const Site& site) {
  return celestial_axis_L<T>(site, site.pole, site.deflection);
}
template Vec3<double> corrected_celestial_axis_L(const Site&);
template Vec3<float80> corrected_celestial_axis_L(const Site&);
template Vec3<float128> corrected_celestial_axis_L(const Site&);

}  // namespace earthtop
