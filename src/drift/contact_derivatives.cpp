// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/contact_derivatives.hpp"

#include <cmath>

#include "drift/contact_bundle.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {
namespace {

template <class Drift>
ContactDerivatives derivatives(const DriftProblem<double>& problem, std::span<const ContactChange<double>> changes, double at_s,
                               double relative_tolerance, const Watch& watch) {
  const Model<double> model = model_for_change(problem.model);
  std::vector<Drift> drifts;
  for (const ContactChange<double>& change : changes)
    drifts.emplace_back(model, problem.table->contact, problem.table->start, problem.release, problem.units, change);
  using Bundle = ContactBundle<Drift>;
  const Bundle bundle(std::move(drifts));

  typename Bundle::State x = bundle.initial_state();
  GroupScales<double, typename Bundle::Shape> scales;
  scales.include(x), scales.include(bundle.typical_state());
  taylor::TaylorStepper<double, Bundle> stepper(relative_tolerance, scales);
  auto series = bundle.series();
  ContactDerivatives found;
  const double end = problem.units.time_from_s(at_s);
  stepper.initialize(x, 0);
  double t = 0;
  for (; t < end; ++found.counters.accepted) {
    if (watch.asks_to_stop() || found.counters.accepted >= kMostBundleSteps) return found;
    if (found.counters.accepted % 64 == 0) watch.reach(t / end);
    stepper.limit_step(end - t);
    stepper.do_step(series);
    found.counters.evaluations += stepper.evaluations();
    const double step = stepper.current_time_step();
    x = stepper.current_state();
    if (!(t + step > t) || !all_finite(x)) return found;
    t = step < end - t ? stepper.current_time() : end;
    scales.include(x);
  }
  for (std::size_t c = 0; c < bundle.size(); ++c) {
    const ContactDriftState<double> state = bundle.contact_state(x, c, t);
    const auto change = [](const Vec3<Paired<double>>& v) { return Vec3<double>(v[0].diff, v[1].diff, v[2].diff); };
    found.each.push_back({change(state.axis_L), change(state.tip_L)});
  }
  found.completed = true;
  return found;
}

}  // namespace

ContactDerivatives contact_derivatives(const DriftProblem<double>& problem, std::span<const ContactChange<double>> changes,
                                       double at_s, double relative_tolerance, const Watch& watch) {
  if (changes.empty()) return {true, {}, {}};
  return is_symmetric(problem.table->contact)
             ? derivatives<ContactReducedDrift<double, Observer::laboratory>>(problem, changes, at_s, relative_tolerance, watch)
             : derivatives<ContactGeneralDrift<double, Observer::laboratory>>(problem, changes, at_s, relative_tolerance,
                                                                              watch);
}

}  // namespace earthtop
