#include "drift/drift_integration.ipp"

namespace earthtop {
template DriftTrajectory<double> integrate_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
}  // namespace earthtop
