// SPDX-License-Identifier: GPL-3.0-or-later
/// The gradient tensor of gravitation at the site: how gravitation varies over the size of a body.
#pragma once

#include "earthtop/frames/earth.hpp"

namespace earthtop {

/// The gradient d g_i / d x_j of the gravitation of the WGS 84 level ellipsoid (no centrifugal part), in axes East, North, Up
/// of the geodetic normal (1/s^2). Symmetric, with trace 0 also at and below the surface, where the outer field is continued.
/// Summed from the series of zonal harmonics; accurate to all digits of a double from 12 km below the ellipsoid upwards.
///   V = GM/r (1 - sum_k J_2k (a/r)^2k P_2k(sin delta))                              [Heiskanen & Moritz, eq. 2-90 and 2-92]
/// @param latitude_deg  geodetic latitude (deg)   @param height_m  height above the ellipsoid (m)
Mat3<double> normal_gravity_gradient_L(double latitude_deg, double height_m);

/// GM/r^3 of WGS 84, r from the Earth's centre to the site (1/s^2).
double geocentric_gm_over_r3(double latitude_deg, double height_m);

/// The unit vector from the Earth's centre to the site in axes East, North, Up: (0, -sin d, cos d), where d is the geodetic
/// minus the geocentric latitude; exactly Up at the poles and on the equator.
Vec3<double> geocentric_up_L(double latitude_deg, double height_m);

/// The gravity gradient of a point mass at the Earth's centre: GM/r^3 (3 u u^T - 1) (1/s^2).
/// @param gm_over_r3  (1/s^2)   @param up  unit vector away from the centre
Mat3<double> spherical_gradient(double gm_over_r3, const Vec3<double>& up);

}  // namespace earthtop
