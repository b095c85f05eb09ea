// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/contact_assessment.hpp"

#include "drift/table/contact_integrals.hpp"
#include "earthtop/model/ledger.hpp"
#include "run/invariant_follower.hpp"
#include "run/ledger_report.hpp"

namespace earthtop {
namespace {

TableConditions conditions(const Scene& scene, bool symmetric) {
  const EffectsSpec& effects = scene.scenario().effects;
  const bool alone = effects.plain();
  return {*scene.scenario().contact, symmetric, alone};
}

/// One of the two motions on a table, in natural units.
template <class T>
class MotionOnTable {
 public:
  MotionOnTable(const DriftProblem<T>& problem, bool rotating)
      : problem_(problem),
        rotating_(rotating),
        R_LH_(rotation_matrix(problem.table->start.q_LH)),
        member_(rotating ? &Paired<T>::rot : &Paired<T>::ref) {
    const Model<T> model = in_table_axes(problem.model, problem.table->start.q_LH);
    around_ = {Vec3<T>::UnitZ(), model.apparent_gravity_L, rotating ? model.W_IL_L : Vec3<T>(Vec3<T>::Zero()), Mat3<T>::Zero()};
  }

  InstantOnTable<T> at(const DriftSample<T>& sample) const {
    const DriftState<T>& state = sample.state;
    const Mat3<T> R_LB = rotation_matrix((rotating_ ? state.q_LB : state.ref_q_LB).normalized());
    const Vec3<T> w_LB_B = problem_.units.rate_from_rad_s(rotating_ ? state.w_LB_B : state.ref_w_LB_B);
    return {problem_.table->contact,
            around_,
            R_LH_.transpose() * R_LB,
            transposed_times(R_LH_, Vec3<T>(times(R_LB, w_LB_B))),
            norm(w_LB_B),
            in_H(sample.contact->axis_L),
            sample.contact->spin.*member_,
            in_H(sample.contact->slip_L),
            in_H(sample.contact->tip_L) + Vec3<T>(T(0), T(0), problem_.table->contact.tip_radius)};
  }

 private:
  Vec3<T> in_H(const Vec3<Paired<T>>& v_L) const { return transposed_times(R_LH_, motion_of(v_L, member_)); }

  const DriftProblem<T>& problem_;
  bool rotating_;
  Mat3<T> R_LH_;
  T Paired<T>::*member_;
  ContactSurroundings<T> around_;
};

}  // namespace

template <class T>
std::vector<InvariantReport> assess_contact_invariants(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                       std::size_t rows, const Watch& watch) {
  const DriftProblem<T>& problem = scene.problem_without_rows<T>();
  const TableConditions table = conditions(scene, is_symmetric(problem.table->contact));
  const MotionOnTable<T> rotating(problem, true), reference(problem, false);
  std::vector<InvariantReport> reports;
  for (const ConservedQuantity<T>& quantity : kConserved<T>) {
    if (quantity.holds_on_table == nullptr || !quantity.holds_on_table(table)) continue;
    const MotionOnTable<T>& motion = quantity.motion == ConservingMotion::rotating ? rotating : reference;
    const int exponent = quantity.mass_power * problem.units.mass_exponent - quantity.rate_power * problem.units.time_exponent;
    InvariantFollower<T> follower(quantity);
    for (std::size_t i = 0; i < std::min(rows, samples.size()) && !watch.asks_to_stop(); ++i) {
      const ConservedValue<T> now = quantity.on_table(motion.at(samples[i]));
      follower.include({real::scale(now.value, exponent), real::scale(now.scale, exponent)});
    }
    reports.push_back(follower.report());
  }
  return reports;
}

template <class T>
std::array<ContactBalances, 2> assess_contact_balances(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                       std::size_t rows) {
  std::array<ContactBalances, 2> balances;
  const DriftProblem<T>& problem = scene.problem_without_rows<T>();
  const EffectsSpec& effects = scene.scenario().effects;
  // The tide is uniform and exerts no torque about the centre of mass.
  const bool jellett_holds = effects.all_on() && !effects.applied.gravity_gradient;
  if (samples.empty() || rows == 0 || !jellett_holds || !samples.front().contact->integrals) return balances;
  const DriftSample<T>&first = samples.front(), &last = samples[std::min(rows, samples.size()) - 1];
  const NaturalUnits& units = problem.units;
  const auto made = [](T at_first, T at_last, T integral, T size, int exponent) {
    const auto plain = [&](T x) { return static_cast<double>(real::scale(x, exponent)); };
    return ContactBalance{plain(at_first), plain(at_last), plain(integral), plain(at_last - at_first - integral), plain(size)};
  };
  for (const bool rotates : {true, false}) {
    const MotionOnTable<T> motion(problem, rotates);
    const InstantOnTable<T> at_first = motion.at(first), at_last = motion.at(last);
    const std::size_t number = rotates ? 1 : 0;
    const ContactIntegrals<T>&from = (*first.contact->integrals)[number], &to = (*last.contact->integrals)[number];
    ContactBalances& balance = balances[rotates ? 0 : 1];
    if (from.jellett_change && to.jellett_change) {
      const Contact<T>& c = problem.table->contact;
      const T spin = std::max(real::abs(at_first.spin), real::abs(at_last.spin));
      const T size = std::max(c.I1, c.I3) * std::max(spin, norm(problem.units.rate_from_rad_s(first.state.ref_w_LB_B))) *
                     (c.tip_radius + real::abs(c.height_of_center));
      balance.jellett = made(conserved::jellett(at_first).value, conserved::jellett(at_last).value,
                             *to.jellett_change - *from.jellett_change, size, units.mass_exponent - units.time_exponent);
    }
    if (effects.tide) continue;
    const ConservedValue<T> J_first = conserved::jacobi(at_first), J_last = conserved::jacobi(at_last);
    balance.jacobi = made(J_first.value, J_last.value, to.work - from.work, std::max(J_first.scale, J_last.scale),
                          units.mass_exponent - 2 * units.time_exponent);
  }
  return balances;
}

template <class T>
std::optional<LedgerReport> assess_contact_ledger(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                  std::size_t rows, const Watch& watch) {
  const std::optional<LedgerObserver>& observer = scene.scenario().ledger;
  if (!observer) return std::nullopt;
  const DriftProblem<T>& problem = scene.problem_without_rows<T>();
  const NaturalUnits& units = problem.units;
  const int newtons = units.mass_exponent - 2 * units.time_exponent;  // lengths are metres in both units
  std::vector<LedgerRow<T>> ledger;
  ledger.reserve(rows);
  for (std::size_t i = 0; i < std::min(rows, samples.size()); ++i) {
    if (watch.asks_to_stop()) break;
    if (i % 64 == 0) watch.reach(static_cast<double>(i) / static_cast<double>(rows));
    const DriftSample<T>& sample = samples[i];
    const StateOnTable<T> state{sample.state.q_LB.normalized(), units.rate_from_rad_s(sample.state.w_LB_B),
                                motion_of(sample.contact->slip_L, &Paired<T>::rot),
                                motion_of(sample.contact->tip_L, &Paired<T>::rot)};
    LedgerRow<T> row = ledger_row(ledger_entry_on_table(*observer, problem.model, problem.table->contact, problem.table->start,
                                                        units.time_from_s(sample.state.t_s), state));
    for (std::array<T, 3>* column : {&row.tau_phys_A, &row.tau_cor_A, &row.tau_trans_A, &row.tau_cent_A, &row.dL_dt_A,
                                     &row.residual_A, &row.share_A[0], &row.share_A[1], &row.share_A[2], &row.force_table_A})
      for (T& component : *column) component = real::scale(component, newtons);
    ledger.push_back(row);
  }
  return ledger_report(*observer, std::move(ledger));
}

template std::vector<InvariantReport> assess_contact_invariants(const Scene&, const std::vector<DriftSample<double>>&,
                                                                std::size_t, const Watch&);
template std::array<ContactBalances, 2> assess_contact_balances(const Scene&, const std::vector<DriftSample<double>>&,
                                                                std::size_t);
template std::optional<LedgerReport> assess_contact_ledger(const Scene&, const std::vector<DriftSample<double>>&, std::size_t,
                                                           const Watch&);
template std::vector<InvariantReport> assess_contact_invariants(const Scene&, const std::vector<DriftSample<float80>>&,
                                                                std::size_t, const Watch&);
template std::array<ContactBalances, 2> assess_contact_balances(const Scene&, const std::vector<DriftSample<float80>>&,
                                                                std::size_t);
template std::optional<LedgerReport> assess_contact_ledger(const Scene&, const std::vector<DriftSample<float80>>&, std::size_t,
                                                           const Watch&);
template std::vector<InvariantReport> assess_contact_invariants(const Scene&, const std::vector<DriftSample<float128>>&,
                                                                std::size_t, const Watch&);
template std::array<ContactBalances, 2> assess_contact_balances(const Scene&, const std::vector<DriftSample<float128>>&,
                                                                std::size_t);
template std::optional<LedgerReport> assess_contact_ledger(const Scene&, const std::vector<DriftSample<float128>>&, std::size_t,
                                                           const Watch&);

}  // namespace earthtop
