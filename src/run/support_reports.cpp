// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/support_reports.hpp"

#include <array>
#include <cmath>

#include "earthtop/scenario/support.hpp"
#include "run/assessment.hpp"
#include "run/contact_assessment.hpp"
#include "run/contact_report.hpp"
#include "run/contact_verdict.hpp"
#include "run/verdict.hpp"

namespace earthtop {
namespace {

template <class T>
using Samples = std::vector<DriftSample<T>>;

constexpr SupportReports kTable{growth_on_table, why::tell_on_table}, kPivot{growth_on_pivot, why::tell_on_pivot},
    kRotor{growth_on_pivot, why::tell_with_rotor}, kMasses{growth_on_pivot, why::tell_with_masses},
    kSuspension{growth_on_pivot, why::tell_with_gimbals};

/// The attitude's rounding on a table is that of the rate at release, because the nudge on a table is little more, and the angle of spin makes the most of it.
template <class T>
double turned_on_table(const DriftSample<T>& sample, std::size_t, double) {
  constexpr int kTurnUnits = 4;  // in the last place of a rate
  return kTurnUnits * static_cast<double>(real::epsilon<T>()) * static_cast<double>(norm(sample.state.w_LB_B)) *
         static_cast<double>(sample.state.t_s);
}

/// The attitude's rounding on a pivot is that of an axis which goes round fast: each step turns the axis by a rounding, and the rate of precession depends on its tilt.
/// (A top in steady fast precession had errors of 1.8e-12 rad in both integrations, which were 1.3e-13 apart.)
template <class T>
double turned_on_pivot(const DriftSample<T>& sample, std::size_t steps, double duration_s) {
  constexpr double kAxisUnits = 8;
  const double t_s = static_cast<double>(sample.state.t_s), steps_so_far = static_cast<double>(steps) * (t_s / duration_s);
  const Vec3<T>& w = sample.state.w_LB_B;
  return kAxisUnits * static_cast<double>(real::epsilon<T>()) * std::sqrt(steps_so_far) *
         static_cast<double>(real::hypot(w[0], w[1])) * t_s;
}

template <class T>
void report_contact(const TwoIntegrations<T>& made, int safety, RunResult& result) {
  const auto balances = assess_contact_balances(result.scene, made.first.samples, result.rows.size());
  result.contact = ContactReport{assess_contact_events(made.first, made.second, safety), 0, {}};
  result.contact->rotating = balances[0], result.contact->reference = balances[1];
}

template <class T>
constexpr SupportReportsIn<T> kTableIn{turned_on_table<T>, report_contact<T>, assess_prediction_changes,
                                       [](const RunResult& result, const Samples<T>& samples, const Watch& watch) {
                                         return assess_contact_invariants(result.scene, samples, result.rows.size(), watch);
                                       },
                                       [](const RunResult& result, const Samples<T>& samples, const Watch& watch) {
                                         return assess_contact_ledger(result.scene, samples, result.rows.size(), watch);
                                       }};

template <class T>
constexpr SupportReportsIn<T> kPivotIn{
    turned_on_pivot<T>, [](const TwoIntegrations<T>&, int, RunResult&) {}, [](RunResult&, const Watch&) {},
    [](const RunResult& result, const Samples<T>&, const Watch& watch) { return assess_invariants(result, watch); },
    [](const RunResult& result, const Samples<T>&, const Watch& watch) { return assess_ledger(result, watch); }};

/// Both in the order of SupportKind.
constexpr std::array kReports = {kTable, kSuspension, kMasses, kRotor, kPivot, kPivot, kPivot, kPivot};
template <class T>
constexpr std::array kReportsIn = {kTableIn<T>, kPivotIn<T>, kPivotIn<T>, kPivotIn<T>,
                                   kPivotIn<T>, kPivotIn<T>, kPivotIn<T>, kPivotIn<T>};
static_assert(kReports.size() == kSupportCount && kReportsIn<double>.size() == kSupportCount);

}  // namespace

const SupportReports& reports_of(const Scene& scene) { return kReports[static_cast<std::size_t>(scene.support().kind)]; }
template <class T>
const SupportReportsIn<T>& reports_in(const Scene& scene) {
  return kReportsIn<T>[static_cast<std::size_t>(scene.support().kind)];
}
template const SupportReportsIn<double>& reports_in(const Scene&);
template const SupportReportsIn<float80>& reports_in(const Scene&);
template const SupportReportsIn<float128>& reports_in(const Scene&);

}  // namespace earthtop
