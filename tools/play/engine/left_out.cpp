// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that the engine leaves out, in place of the core's own sources: numbers of more than 53 bits, whose integrators would double the
// engine's size and which WebAssembly computes in software; and the places of the Sun and the Moon, since ERFA is a compiled library.
#include "left_out.hpp"

#include "drift/table/contact_integration.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/error.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "frames/ephemeris.hpp"

namespace earthtop {
namespace {

[[noreturn]] void refuse(const char* pointer, const char* what) {
  throw ScenarioError(pointer, std::string(what) + "; run it with the program, earthtop run");
}
[[noreturn]] void refuse_precision() { refuse("/numerics/precision", play::kPrecision); }
[[noreturn]] void refuse_date() { refuse("/start_utc", play::kDate); }

}  // namespace

template <class T>
MotionTrajectory<T> integrate_motion(const MotionProblem<T>&, const IntegrationOptions&, MotionSought, const Watch&) {
  refuse_precision();
}
template <class T>
DriftTrajectory<T> integrate_drift(const DriftProblem<T>&, const IntegrationOptions&, const Watch&) {
  refuse_precision();
}
template <class T>
DriftTrajectory<T> integrate_contact(const DriftProblem<T>&, const IntegrationOptions&, const Watch&) {
  refuse_precision();
}
template MotionTrajectory<long double> integrate_motion(const MotionProblem<long double>&, const IntegrationOptions&,
                                                        MotionSought, const Watch&);
template DriftTrajectory<long double> integrate_drift(const DriftProblem<long double>&, const IntegrationOptions&,
                                                      const Watch&);
template DriftTrajectory<long double> integrate_contact(const DriftProblem<long double>&, const IntegrationOptions&,
                                                        const Watch&);
template MotionTrajectory<float128> integrate_motion(const MotionProblem<float128>&, const IntegrationOptions&, MotionSought,
                                                     const Watch&);
template DriftTrajectory<float128> integrate_drift(const DriftProblem<float128>&, const IntegrationOptions&, const Watch&);
template DriftTrajectory<float128> integrate_contact(const DriftProblem<float128>&, const IntegrationOptions&, const Watch&);

std::optional<UtcInstant> parse_utc(std::string_view) { refuse_date(); }
TerrestrialTime terrestrial_time(const UtcInstant&, double) { refuse_date(); }
Vec3<double> moon_position_I(const TerrestrialTime&) { refuse_date(); }
Vec3<double> sun_position_I(const TerrestrialTime&) { refuse_date(); }
Vec3<double> mean_axis_I(const TerrestrialTime&) { refuse_date(); }
Mat3<double> celestial_to_terrestrial(const UtcInstant&, double) { refuse_date(); }

}  // namespace earthtop
