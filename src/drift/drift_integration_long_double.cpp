#include "drift/drift_integration.ipp"

namespace earthtop {
template DriftTrajectory<long double> integrate_drift(const DriftProblem<long double>&, const IntegrationOptions&,
                                                      const Watch&);
}  // namespace earthtop
