// SPDX-License-Identifier: GPL-3.0-or-later
// In place of the integrations in extended precision, where the library is built for double alone (EARTHTOP_EXTENDED_PRECISION=OFF),
// which saves a fifth of the time to build the program. Whoever asks for one is told how to get it.
#include "drift/table/contact_integration.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/error.hpp"
#include "earthtop/integrate/motion_integration.hpp"

#ifndef EARTHTOP_PRECISION_REMEDY  // as tools/play has it, which cannot be built in another way
#define EARTHTOP_PRECISION_REMEDY R"(build all of it with "cmake --preset release && cmake --build --preset release")"
#endif

namespace earthtop {
namespace {

template <class T>
[[noreturn]] void refuse_precision() {
  const Precision precision = std::is_same_v<T, float128> ? Precision::bits113 : Precision::bits64;
  throw ScenarioError("/numerics/precision", precision_refusal(precision).value());
}

}  // namespace

std::optional<std::string> precision_refusal(Precision precision) {
  if (precision == Precision::bits53) return std::nullopt;
  std::string reason = "\"";
  reason += to_string(precision);
  reason += "\" is left out of this build, which computes in double alone; ";
  reason += EARTHTOP_PRECISION_REMEDY;
  return reason;
}

template <class T>
MotionTrajectory<T> integrate_motion(const MotionProblem<T>&, const IntegrationOptions&, MotionSought, const Watch&) {
  refuse_precision<T>();
}
template <class T>
DriftTrajectory<T> integrate_drift(const DriftProblem<T>&, const IntegrationOptions&, const Watch&) {
  refuse_precision<T>();
}
template <class T>
DriftTrajectory<T> integrate_contact(const DriftProblem<T>&, const IntegrationOptions&, const Watch&) {
  refuse_precision<T>();
}
#define EARTHTOP_REFUSE(T)                                                                                        \
  template MotionTrajectory<T> integrate_motion(const MotionProblem<T>&, const IntegrationOptions&, MotionSought, \
                                                const Watch&);                                                    \
  template DriftTrajectory<T> integrate_drift(const DriftProblem<T>&, const IntegrationOptions&, const Watch&);   \
  template DriftTrajectory<T> integrate_contact(const DriftProblem<T>&, const IntegrationOptions&, const Watch&);
EARTHTOP_REFUSE(float80)
EARTHTOP_REFUSE(float128)

}  // namespace earthtop
