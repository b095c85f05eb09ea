// SPDX-License-Identifier: GPL-3.0-or-later
// SUNDIALS' CVODE (Adams) and ARKODE (explicit Runge-Kutta) as peers; compiled if SUNDIALS was found.
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <new>

#include "bench/peer_system.hpp"

namespace earthtop {
namespace {

int rates(realtype, N_Vector x, N_Vector dxdt, void* system) {
  return static_cast<PeerSystem*>(system)->rates(N_VGetArrayPointer(x), N_VGetArrayPointer(dxdt)) ? 0 : -1;
}

/// A context of SUNDIALS, and the state as one of its vectors.
struct Workspace {
  SUNContext context = nullptr;
  N_Vector x = nullptr;
  explicit Workspace(PeerSystem::State& state) {
    if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
    x = N_VMake_Serial(PeerSystem::kSize, state.data(), context);
    if (x == nullptr) throw std::bad_alloc();
  }
  ~Workspace() {
    N_VDestroy(x);
    SUNContext_Free(&context);
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
};

RunStatus status_of(int flag, const PeerSystem& top) {
  if (top.is_stopped()) return RunStatus::interrupted;
  return flag >= 0 ? RunStatus::completed : RunStatus::step_underflow;
}

}  // namespace

std::string sundials_version() { return SUNDIALS_VERSION; }

MotionTrajectory<double> integrate_with_cvode(const MotionProblem<double>& problem, double tolerance, const Watch& watch) {
  PeerSystem top(problem, watch);
  PeerSystem::State x = top.initial_state();
  const Workspace workspace(x);
  const auto free_memory = [](void* memory) { CVodeFree(&memory); };
  const std::unique_ptr<void, decltype(free_memory)> memory(CVodeCreate(CV_ADAMS, workspace.context), free_memory);
  const std::unique_ptr<_generic_SUNNonlinearSolver, int (*)(SUNNonlinearSolver)> solver(
      SUNNonlinSol_FixedPoint(workspace.x, 0, workspace.context), SUNNonlinSolFree);
  void* cvode = memory.get();
  if (CVodeInit(cvode, rates, 0, workspace.x) != CV_SUCCESS) throw std::bad_alloc();
  CVodeSetErrFile(cvode, nullptr);
  CVodeSetUserData(cvode, &top);
  CVodeSStolerances(cvode, tolerance, tolerance);
  CVodeSetNonlinearSolver(cvode, solver.get());
  CVodeSetMaxNumSteps(cvode, -1);
  auto trajectory = top.trajectory(x, [&](double, double to) {
    realtype reached = 0;
    return status_of(CVode(cvode, to, workspace.x, &reached, CV_NORMAL), top);  // interpolates to the output time
  });
  long accepted = 0, rejected = 0;
  CVodeGetNumSteps(cvode, &accepted);
  CVodeGetNumErrTestFails(cvode, &rejected);
  trajectory.counters.accepted = accepted;
  trajectory.counters.rejected = rejected;
  return trajectory;
}

MotionTrajectory<double> integrate_with_arkode(const MotionProblem<double>& problem, double tolerance, const Watch& watch) {
  PeerSystem top(problem, watch);
  PeerSystem::State x = top.initial_state();
  const Workspace workspace(x);
  const auto free_memory = [](void* memory) { ERKStepFree(&memory); };
  const std::unique_ptr<void, decltype(free_memory)> memory(ERKStepCreate(rates, 0, workspace.x, workspace.context),
                                                            free_memory);
  void* arkode = memory.get();
  if (arkode == nullptr) throw std::bad_alloc();
  ERKStepSetErrFile(arkode, nullptr);
  ERKStepSetUserData(arkode, &top);
  ERKStepSetTableNum(arkode, ARKODE_FEHLBERG_13_7_8);
  ERKStepSStolerances(arkode, tolerance, tolerance);
  ERKStepSetMaxNumSteps(arkode, -1);
  auto trajectory = top.trajectory(x, [&](double, double to) {
    realtype reached = 0;
    ERKStepSetStopTime(arkode, to);  // steps must end at the output time: its interpolation is of order 5 at most
    return status_of(ERKStepEvolve(arkode, to, workspace.x, &reached, ARK_NORMAL), top);
  });
  long accepted = 0, rejected = 0;
  ERKStepGetNumSteps(arkode, &accepted);
  ERKStepGetNumErrTestFails(arkode, &rejected);
  trajectory.counters.accepted = accepted;
  trajectory.counters.rejected = rejected;
  return trajectory;
}

}  // namespace earthtop
