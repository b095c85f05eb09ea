// SPDX-License-Identifier: GPL-3.0-or-later
// GSL's odeiv2 as a peer.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>

#include "bench/peer_system.hpp"
#include "error/gsl_errors.hpp"

namespace earthtop {
namespace {

int rates(double, const double* x, double* dxdt, void* system) {
  return static_cast<PeerSystem*>(system)->rates(x, dxdt) ? GSL_SUCCESS : GSL_EBADFUNC;
}

MotionTrajectory<double> integrate(const gsl_odeiv2_step_type* type, const MotionProblem<double>& problem, double tolerance,
                                   const Watch& watch) {
  const ReturnedGslErrors returned;
  PeerSystem top(problem, watch);
  gsl_odeiv2_system system{rates, nullptr, PeerSystem::kSize, &top};
  const std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver(
      allocated(gsl_odeiv2_driver_alloc_standard_new(&system, type, top.first_step(), tolerance, tolerance, 1, 0)),
      gsl_odeiv2_driver_free);
  PeerSystem::State x = top.initial_state();
  auto trajectory = top.trajectory(x, [&](double from, double to) {
    const int status = gsl_odeiv2_driver_apply(driver.get(), &from, to, x.data());
    if (top.is_stopped()) return RunStatus::interrupted;
    return status == GSL_SUCCESS ? RunStatus::completed : RunStatus::step_underflow;
  });
  trajectory.counters.accepted = static_cast<std::int64_t>(driver->e->count);
  trajectory.counters.rejected = static_cast<std::int64_t>(driver->e->failed_steps);
  return trajectory;
}

}  // namespace

MotionTrajectory<double> integrate_with_gsl_rk8pd(const MotionProblem<double>& problem, double tolerance, const Watch& watch) {
  return integrate(gsl_odeiv2_step_rk8pd, problem, tolerance, watch);
}
MotionTrajectory<double> integrate_with_gsl_msadams(const MotionProblem<double>& problem, double tolerance,
                                                    const Watch& watch) {
  return integrate(gsl_odeiv2_step_msadams, problem, tolerance, watch);
}

}  // namespace earthtop
