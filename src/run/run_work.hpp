// SPDX-License-Identifier: GPL-3.0-or-later
/// The phases of a run and what each costs, so that its progress is the share of the work that is done.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop {

/// Work in the seconds of `estimated_seconds`; what a run does not do costs nothing.
struct RunWork {
  double solution = 0, bound = 0, rows = 0, growth = 0, sensitivities = 0, ledger = 0;
  double all() const { return solution + bound + rows + growth + sensitivities + ledger; }
};

/// @param first, second  the options of the two integrations   @param form  that both take
RunWork work_of_run(const Scenario& scenario, const IntegrationOptions& first, const IntegrationOptions& second,
                    ModelForm form);

}  // namespace earthtop
