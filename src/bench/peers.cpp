// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/bench/peers.hpp"

#include <gsl/gsl_version.h>

#include <stdexcept>

#include "bench/peer_system.hpp"

namespace earthtop {
namespace {

constexpr Peer kPeers[] = {
    {"gsl_rk8pd", "circle", integrate_with_gsl_rk8pd},
    {"gsl_msadams", "square", integrate_with_gsl_msadams},
#ifdef EARTHTOP_SUNDIALS
    {"cvode_adams", "triangle", integrate_with_cvode},
    {"arkode_erk", "diamond", integrate_with_arkode},
#endif
};

}  // namespace

std::span<const Peer> peers_built() { return kPeers; }

std::string peers_description() {
  std::string text = "GSL " GSL_VERSION " odeiv2";
#ifdef EARTHTOP_SUNDIALS
  text += ", SUNDIALS " + sundials_version() + " CVODE and ARKODE";
#else
  text += "; SUNDIALS is not compiled in";
#endif
  return text;
}

MotionTrajectory<double> integrate_with_peer(const Peer& peer, const MotionProblem<double>& problem, double tolerance,
                                             const Watch& watch) {
  if (problem.model.kind != SceneKind::plain)
    throw std::invalid_argument("bench: peers integrate only scenarios without a platform and with all torques");
  return peer.integrate(problem, tolerance, watch);
}

}  // namespace earthtop
