// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a Cardan suspension rests, and how it swings about that place: the small motions in closed form.
#pragma once

#include <optional>

#include "earthtop/drift/stop_event.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// With R = h u.c + (u.Theta_A u + u.Theta u)/2 - V, where u is the inertial rate of the carrier and V the energy of gravity and springs,
/// a suspension rests where grad R = 0. There, with K the second derivatives of -R, M the mass matrix and gamma the gyroscopic coupling,
///   det(M) s^2 - (M11 K22 + M22 K11 - 2 M12 K12 + gamma^2) s + det(K) = 0 ,  s = (2 pi / T)^2
struct GimbalRest {
  double outer_rad = 0, inner_rad = 0;
  std::optional<double> slow_period_s, fast_period_s;  ///< of undamped swings; none where there is no such swing
};

/// The place of rest nearest to the release; none where there is none within half a radian, or where the carrier does not turn steadily.
std::optional<GimbalRest> gimbal_rest(const Scene& scene, Prediction prediction);

/// The nutation of a suspension at release, without the Earth (rad/s): h times the sine of the angle between the rotor's axis and the outer
/// one over the root of the mass matrix's determinant. None where a gimbal is locked or there is no rotor.
std::optional<double> gimbal_nutation(const Scene& scene);

/// Whether the theory of Magnus holds for a suspension: both gimbals free, without friction and springs, the inner axis normal to the
/// outer one and to the rotor's, moments without products, and no moment of gravity.
bool has_magnus_drift(const Scene& scene);

/// The moments of the suspension about both axes at the release, without the rotor's axial moment (kg m^2).
struct GimbalInertia {
  double outer, inner, coupling;
  double axial;  ///< A3 + B3: the part of `outer` that stays when the rotor's axis is along the outer one
};
GimbalInertia gimbal_inertia(const Scene& scene);

/// The rotor's momentum about its axis at the release, in the non-rotating prediction (kg m^2/s).
double gimbal_rotor_momentum(const Scene& scene);

}  // namespace earthtop
