// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/gimbals.hpp"

#include "earthtop/frames/degrees.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"

namespace earthtop {
namespace {

template <class T>
T radians(double degrees) {
  return T(degrees) * real::pi<T>() / T(180);
}

template <class T>
Bearing<T> make_bearing(const BearingSpec& spec) {
  Bearing<T> bearing;
  bearing.locked = spec.locked;
  bearing.viscous = T(spec.viscous_torque_N_m_s);
  bearing.coulomb = T(spec.coulomb_torque_N_m);
  bearing.regularisation = T(spec.regularisation_rad_s);
  bearing.torsion = T(spec.torsion_N_m_rad);
  bearing.rest = radians<T>(spec.torsion_rest_deg);
  return bearing;
}

/// R_0, exact at multiples of 90 degrees.
template <class T>
Mat3<T> base_matrix(const GimbalsSpec& spec) {
  const SinCos<T> turn = sin_cos_degrees(T(90) - T(spec.axis_azimuth_deg)), tilt = sin_cos_degrees(T(spec.axis_tilt_deg));
  Mat3<T> R;
  R << turn.cos * tilt.cos, -turn.sin, turn.cos * tilt.sin, turn.sin * tilt.cos, turn.cos, turn.sin * tilt.sin, -tilt.sin, T(0),
      tilt.cos;
  return R;
}

}  // namespace

template <class T>
Gimbals<T> make_gimbals(const GimbalsSpec& spec, const GimbalReleaseSpec& release, const std::vector<MovingMassSpec>& masses,
                        bool has_rotor) {
  Gimbals<T> gimbals;
  gimbals.q_P0 = release_attitude<T>(spec.axis_tilt_deg, spec.axis_azimuth_deg, 0);
  gimbals.R_P0 = base_matrix<T>(spec);
  const SinCos<T> skew = sin_cos_degrees(T(spec.axis_skew_deg)), half = sin_cos_degrees(T(spec.axis_skew_deg) / T(2));
  gimbals.skew_cos = skew.cos, gimbals.skew_sin = skew.sin;
  gimbals.q_skew = {half.cos, Vec3<T>(half.sin, T(0), T(0))};
  if (spec.ring) {
    const Body<T> ring = make_body<T>(*spec.ring);
    gimbals.ring = {ring.I_BP_B, ring.S_BP_B, Vec3<T>(ring.mass * ring.p_PBcm_B)};
  }
  const MovingMasses<T> all = make_masses<T>(masses, MassCarrier::outer, false);
  gimbals.ring.S += all.at_release.second_moment, gimbals.ring.I += inertia_of(all.at_release.second_moment);
  gimbals.ring.mass_moment += all.at_release.mass_moment;
  gimbals.masses = make_masses<T>(masses, MassCarrier::outer, true);
  gimbals.has_rotor = has_rotor;
  gimbals.outer = make_bearing<T>(spec.outer), gimbals.inner = make_bearing<T>(spec.inner);
  gimbals.release = {radians<T>(release.outer_angle_deg), radians<T>(release.inner_angle_deg), T(release.outer_rate_rad_s),
                     T(release.inner_rate_rad_s)};
  return gimbals;
}

template <class T>
Gimbals<T> in_units(Gimbals<T> gimbals, int mass, int time) {
  const auto scale = [](T& x, int exponent) { x = real::scale(x, exponent); };
  for (int i = 0; i < 3; ++i) {
    scale(gimbals.ring.mass_moment[i], -mass);
    for (int j = 0; j < 3; ++j) scale(gimbals.ring.I(i, j), -mass), scale(gimbals.ring.S(i, j), -mass);
  }
  for (Bearing<T>* bearing : {&gimbals.outer, &gimbals.inner}) {
    scale(bearing->viscous, time - mass);
    scale(bearing->coulomb, 2 * time - mass);
    scale(bearing->torsion, 2 * time - mass);
    scale(bearing->regularisation, time);
  }
  gimbals.masses = in_units(std::move(gimbals.masses), mass, time);
  scale(gimbals.release.outer_rate, time), scale(gimbals.release.inner_rate, time);
  return gimbals;
}

#define EARTHTOP_GIMBALS(T)                                                                                                 \
  template Gimbals<T> make_gimbals(const GimbalsSpec&, const GimbalReleaseSpec&, const std::vector<MovingMassSpec>&, bool); \
  template Gimbals<T> in_units(Gimbals<T>, int, int);
EARTHTOP_GIMBALS(double)
EARTHTOP_GIMBALS(float80)
EARTHTOP_GIMBALS(float128)
#undef EARTHTOP_GIMBALS

}  // namespace earthtop
