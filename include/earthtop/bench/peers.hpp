// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrators of other libraries ("peers"), as far as they are compiled in: for comparing costs with earthtop's own methods.
///
/// Each peer integrates the seven variables of any body in body axes (Euler's equation, and the quaternion with rotations of q
/// / |q|), with the same right-hand side as earthtop's methods for these variables. The drift is the difference of two such
/// motions.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// One integrator of another library.
struct Peer {
  std::string_view word;
  std::string_view marker;  ///< in pictures, where all peers are grey
  /// As `integrate_with_peer`, for a plain scene.
  MotionTrajectory<double> (*integrate)(const MotionProblem<double>& problem, double tolerance, const Watch& watch);
};

/// The peers that this program contains: GSL's Prince-Dormand 8(9) and its Adams method of varying order; also SUNDIALS' Adams
/// method (CVODE) and Fehlberg's 7(8) (ARKODE) if its headers and libraries were found at configuration.
std::span<const Peer> peers_built();

/// E.g. "GSL 2.7.1 odeiv2, SUNDIALS 6.4.1 CVODE and ARKODE".
std::string peers_description();

/// The rotating motion at the output times; Runge-Kutta methods end steps exactly at these times.
/// @param problem  a plain scene: no platform, all torques   @param tolerance  relative and absolute, in natural units
/// @param watch  may stop the integration, with RunStatus::interrupted
/// @throws std::invalid_argument for a scene that is not plain
MotionTrajectory<double> integrate_with_peer(const Peer& peer, const MotionProblem<double>& problem, double tolerance,
                                             const Watch& watch = {});

}  // namespace earthtop
