#include "integrate/motion_integration.ipp"

namespace earthtop {
template MotionTrajectory<double> integrate_motion(const MotionProblem<double>&, const IntegrationOptions&, MotionSought,
                                                   const Watch&);
}  // namespace earthtop
