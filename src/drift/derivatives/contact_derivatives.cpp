// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/contact_tangents.hpp"  // must come first: the formulas included below are compiled for jets
//
#include <algorithm>
#include <cmath>

#include "drift/derivatives/contact_derivatives.hpp"
#include "drift/derivatives/tangent_steps.hpp"
#include "drift/table/contact_stop_integration.hpp"

namespace earthtop {
namespace {

/// Whether slip relaxes so fast, compared with the motion, that steps of a low tolerance would be kept short by it.
bool has_stiff_slip(const DriftProblem<double>& problem) {
  constexpr double kFast = 5;  // times the motion's fastest rate; plain steps of low order are stable up to as much
  const Contact<double>& c = problem.table->contact;
  double slow_slip = 0;  // below which friction is in proportion to slip
  if (c.law == ContactLaw::coulomb) slow_slip = c.slip_floor;
  if (c.law == ContactLaw::contensou) slow_slip = c.slip_of_spin * c.patch_radius * norm(problem.natural_release().w_XB_B);
  const double arm = c.tip_radius + std::abs(c.height_of_center), across = std::min(c.I1, c.I3);
  const double most = c.coefficient * norm(problem.model.apparent_gravity_L) * (1 + c.mass * arm * arm / across);
  return slow_slip > 0 && most > kFast * problem.fastest_rate * slow_slip;
}

/// Integrates with one group of inputs, of which `count` are asked for, and appends their derivatives.
template <class System>
bool include_derivatives(const DriftProblem<double>& problem, const Inputs& inputs, std::size_t count, double at_s,
                         double relative_tolerance, const Watch& watch, ContactDerivatives& found) {
  using Motion = ContactTangents<System, OnTable::reference>;
  using Tangents = JetTangents<Motion>;
  using State = typename Tangents::State;
  const Motion motion(problem, inputs, count);
  State x = Tangents::packed(motion.initial_state());
  TangentSteps<Tangents> steps(typename Tangents::Series([&](const State& at, double t) { return motion.record(at, t); }), x,
                               relative_tolerance, has_stiff_slip(problem));
  steps.include(Tangents::packed(motion.typical_state()));
  const TangentLimits limits{.end = problem.units.time_from_s(at_s)};
  if (follow_tangents(steps, x, limits, found.counters, watch, [](const State&, double) {}) != RunStatus::completed)
    return false;
  const auto jets = Tangents::unpacked(x);
  const Mat3<double> R_LH = rotation_matrix(problem.table->start.q_LH);
  const Vec3<Jet> axis = reference_axis<System>(jets),
                  tip(jets[System::Shape::kPosition], jets[System::Shape::kPosition + 1], 0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto in_L = [&](const Vec3<Jet>& v) { return times(R_LH, Vec3<double>(v[0].d[k], v[1].d[k], v[2].d[k])); };
    found.each.push_back({in_L(axis), in_L(tip)});
  }
  return true;
}

}  // namespace

bool has_tangents(const DriftProblem<double>& problem) {
  return !has_exact_coulomb(with_law_of_tangents(problem).table->contact);
}

DriftProblem<double> with_law_of_tangents(const DriftProblem<double>& problem) {
  DriftProblem<double> smooth = problem;
  const TableProblem<double>& table = *problem.table;
  if (has_exact_coulomb(table.contact) && !slips_at_release(ContactReducedDrift<double, Observer::laboratory>(
                                              problem.model, table.contact, table.start, problem.natural_release())))
    smooth.table->contact.law = ContactLaw::rolling;
  return smooth;
}

ContactDerivatives contact_derivatives(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                       double at_s, double relative_tolerance, const Watch& watch) {
  const DriftProblem<double> smooth = with_law_of_tangents(problem);
  const auto follow =
      is_symmetric(problem.table->contact) ? include_derivatives<ContactReducedJets> : include_derivatives<ContactGeneralJets>;
  ContactDerivatives found;
  for (std::size_t first = 0; first < inputs.size(); first += kInputsAtOnce) {
    const std::size_t count = std::min(kInputsAtOnce, inputs.size() - first);
    Inputs group;
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(first), count, group.begin());
    const auto share = [&](std::size_t done) { return double(done) / double(inputs.size()); };
    if (!follow(smooth, group, count, at_s, relative_tolerance, watch.part(share(first), share(first + count)), found))
      return found;
  }
  found.completed = true;
  return found;
}

ProblemDerivative table_tilt_change(const Model<double>& model, const ContactRelease<double>& start,
                                    const SinCos<double>& azimuth) {
  const Vec3<double> gravity_H = in_table_axes(model, start.q_LH).apparent_gravity_L, axis(-azimuth.cos, azimuth.sin, 0);
  ProblemDerivative change;
  change.apparent_gravity_L = times(rotation_matrix(start.q_LH), Vec3<double>(gravity_H.cross(axis)));
  return change;
}

}  // namespace earthtop
