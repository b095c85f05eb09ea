// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/odeint_pow.hpp"  // must come first: it redirects std::pow
//
#include "drift/table/contact_integration.ipp"

namespace earthtop {
template DriftTrajectory<float80> integrate_contact(const DriftProblem<float80>&, const IntegrationOptions&, const Watch&);
}  // namespace earthtop
