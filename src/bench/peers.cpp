// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/bench/peers.hpp"

#include <gsl/gsl_version.h>

#include <stdexcept>

#include "bench/peer_system.hpp"

namespace earthtop {
namespace {

#ifdef EARTHTOP_SUNDIALS
constexpr bool kSundials = true;
#else
constexpr bool kSundials = false;
#endif

}  // namespace

std::string_view to_string(Peer peer) {
  switch (peer) {
    case Peer::gsl_rk8pd: return "gsl_rk8pd";
    case Peer::gsl_msadams: return "gsl_msadams";
    case Peer::cvode_adams: return "cvode_adams";
    case Peer::arkode_erk: return "arkode_erk";
  }
  return "unknown";
}

std::vector<Peer> peers_built() {
  if (kSundials) return {Peer::gsl_rk8pd, Peer::gsl_msadams, Peer::cvode_adams, Peer::arkode_erk};
  return {Peer::gsl_rk8pd, Peer::gsl_msadams};
}

std::string peers_description() {
  std::string text = "GSL " GSL_VERSION " odeiv2";
#ifdef EARTHTOP_SUNDIALS
  text += ", SUNDIALS " + sundials_version() + " CVODE and ARKODE";
#else
  text += "; SUNDIALS is not compiled in";
#endif
  return text;
}

MotionTrajectory<double> integrate_with_peer(Peer peer, const MotionProblem<double>& problem, double tolerance,
                                             const Watch& watch) {
  if (problem.model.kind != SceneKind::plain)
    throw std::invalid_argument("bench: peers are made for scenes without a platform, with all torques");
  switch (peer) {
    case Peer::gsl_rk8pd:
    case Peer::gsl_msadams: return integrate_with_gsl(peer, problem, tolerance, watch);
#ifdef EARTHTOP_SUNDIALS
    case Peer::cvode_adams: return integrate_with_cvode(problem, tolerance, watch);
    case Peer::arkode_erk: return integrate_with_arkode(problem, tolerance, watch);
#else
    case Peer::cvode_adams:
    case Peer::arkode_erk: break;
#endif
  }
  throw std::invalid_argument("bench: " + std::string(to_string(peer)) + " is not compiled in");
}

}  // namespace earthtop
