// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/table_truth.hpp"

#include "drift/table/contact_reduced_drift.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "integrate/extrapolation.hpp"

namespace earthtop::testing {
namespace {

/// Puts the rows before the slip stops in place of those in the laboratory's axes, by extrapolation in inertial axes: sliding
/// friction is smooth there.
void slide_in_inertial_axes(const Scenario& scenario, double tolerance, TrueRun& truth) {
  using T = float128;
  using Drift = ContactReducedDrift<T, Observer::inertial>;
  const Scene scene(scenario);
  const DriftProblem<T>& problem = scene.problem<T>();
  const TableProblem<T>& table = *problem.table;
  Drift drift(problem.model, table.contact, table.start, problem.natural_release());
  typename Drift::State x = drift.initial_state();
  GroupScales<T, typename Drift::Shape> scales;
  scales.include(x), scales.include(drift.typical_state());
  Extrapolation<T, typename Drift::Shape> stepper(T(tolerance), scales);
  double until_s = problem.times_s.back();
  for (const ContactEvent& event : truth.events) until_s = std::min(until_s, event.t_s);
  const ContactRows<T> rows(problem, truth.events);
  T t = T(0), dt = T(0.05);
  for (std::size_t i = 1; i < truth.rows.size() && problem.times_s[i] < until_s; ++i) {
    const T end = problem.units.time_from_s(T(problem.times_s[i]));
    while (t < end) {
      const bool lands = t + dt >= end;
      T step = lands ? T(end - t) : dt;
      const T tried = step;
      const bool taken = stepper.try_step(drift, x, t, step) == boost::numeric::odeint::success;
      dt = taken && tried < dt ? std::max(dt, step) : step;
      if (!taken) continue;
      if (lands) t = end;
      scales.include(x);
      drift.follow(x, t);
    }
    DriftSample<T> sample;
    sample.state = drift.shared_state(x, t);
    sample.state.t_s = T(problem.times_s[i]);
    sample.measures = measure_drift(drift.deviation_state(x, t));
    sample.contact = std::make_shared<const ContactDriftState<float128>>(drift.contact_state(x, t));
    truth.rows[i] = make_row(sample, DriftBound<T>(0), RowParts<T>(rows));
  }
}

}  // namespace

TrueRun truth_on_table(const Scenario& scenario, bool extended, std::size_t rows) {
  constexpr double kAffordable = 1e4;  // evaluations by extrapolation in 113 bits, a second
  const ContactSpec& contact = *scenario.contact;
  const bool exact = contact.law == ContactLaw::coulomb && contact.regularisation_m_s == 0;
  IntegrationOptions options;
  options.observer = scenario.numerics.observer == Observer::inertial ? Observer::laboratory : Observer::inertial;
  options.form = ModelForm::automatic;
  if (extended) {
    options.method = Method::extrapolation;
    options.relative_tolerance = 1e-22;
    if (!exact && Scene(scenario).cost(options).work.evaluations > kAffordable) options.method = Method::taylor;
    TrueRun truth = integrate_truth<float128>(scenario, options, rows);
    if (exact && truth.rows.front().contact->state == ContactState::slide)
      slide_in_inertial_axes(scenario, options.relative_tolerance, truth);
    return truth;
  }
  options.method = Method::taylor;
  options.relative_tolerance = 1e-18;
  return integrate_truth<float80>(scenario, options, rows);
}

}  // namespace earthtop::testing
