// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/run_work.hpp"

#include "run/sensitivities.hpp"
#include "run/verdict.hpp"
#include "scenario/work.hpp"

namespace earthtop {
namespace {

/// Seconds for a row: its measures, invariants and ledger entry, as measured.
double seconds_a_row(Precision precision) { return precision == Precision::bits53 ? 1e-6 : 1e-4; }

}  // namespace

RunWork work_of_run(const Scenario& scenario, const IntegrationOptions& first, const IntegrationOptions& second,
                    ModelForm form) {
  RunWork work;
  work.solution = integration_work(scenario, first, form);
  work.bound = integration_work(scenario, second, form);
  work.rows = seconds_a_row(scenario.precision) * scenario.duration_s / scenario.output_step_s;
  if (scenario.ledger) work.ledger = work.rows;
  if (const auto tolerance = growth_tolerance(scenario)) work.growth = growth_work(scenario, scenario.duration_s, *tolerance);
  if (const auto tolerance = sensitivity_tolerance(scenario))
    work.sensitivities = sensitivity_work(scenario, scenario.duration_s, *tolerance, kInputNames.size());
  return work;
}

}  // namespace earthtop
