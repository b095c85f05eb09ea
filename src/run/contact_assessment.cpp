// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/contact_assessment.hpp"

#include "drift/table/contact_integrals.hpp"
#include "earthtop/model/contact_invariants.hpp"
#include "earthtop/model/ledger.hpp"
#include "run/invariant_follower.hpp"
#include "run/ledger_report.hpp"

namespace earthtop {
namespace {

/// Which quantities a scene conserves.
struct Conserved {
  bool energy, spin, jellett, routh;

  /// @param symmetric  whether the body is symmetric about axis 3
  Conserved(const Scene& scene, bool symmetric) {
    const ContactSpec& spec = *scene.scenario().contact;
    const EffectsSpec& effects = scene.scenario().effects;
    const bool moments = spec.spinning_friction_m > 0 || spec.rolling_resistance_m > 0 || spec.law == ContactLaw::contensou;
    const bool alone = effects.all_on() && !effects.tide && !effects.applied.gravity_gradient;
    energy = alone && !moments && (spec.law == ContactLaw::frictionless || spec.law == ContactLaw::rolling);
    spin = alone && symmetric && !moments && (spec.law == ContactLaw::frictionless || spec.tip_radius_m == 0);
    jellett = alone && symmetric && !moments;
    // On a tilted table gravity is not along the normal.
    routh = jellett && spec.law == ContactLaw::rolling && spec.table_tilt_deg == 0;
  }
};

/// The conserved quantities of one motion, in natural units.
template <class T>
class MotionInvariants {
 public:
  MotionInvariants(const DriftProblem<T>& problem, bool rotating)
      : problem_(problem),
        rotating_(rotating),
        R_LH_(rotation_matrix(problem.table->start.q_LH)),
        member_(rotating ? &Paired<T>::rot : &Paired<T>::ref) {
    const Model<T> model = in_table_axes(problem.model, problem.table->start.q_LH);
    around_ = {Vec3<T>::UnitZ(), model.apparent_gravity_L, rotating ? model.W_IL_L : Vec3<T>(Vec3<T>::Zero()), Mat3<T>::Zero()};
  }

  ContactJacobi<T> jacobi(const DriftSample<T>& sample) const {
    const Contact<T>& c = contact();
    const Mat3<T> R_HB = R_LH_.transpose() * rotation_matrix(q_LB(sample));
    const Vec3<T> w = rate(sample), r_c = times(R_HB, c.p_OC_B), z = Vec3<T>::UnitZ();
    const Vec3<T> v_O = in_H(sample.contact->slip_L) + c.tip_radius * Vec3<T>(w.cross(z));
    const Vec3<T> p_C = in_H(sample.contact->tip_L) + c.tip_radius * z + r_c;
    return contact_jacobi(c, around_, turned_tensor(R_HB, c.I_BC_B), w, p_C, Vec3<T>(v_O + Vec3<T>(w.cross(r_c))));
  }
  T spin(const DriftSample<T>& sample) const { return sample.contact->spin.*member_; }
  T jellett(const DriftSample<T>& sample) const { return earthtop::jellett(contact(), around_, reduced(sample)); }
  T routh(const DriftSample<T>& sample) const { return earthtop::routh(contact(), around_, reduced(sample)); }

 private:
  const Contact<T>& contact() const { return problem_.table->contact; }
  Quaternion<T> q_LB(const DriftSample<T>& sample) const {
    return (rotating_ ? sample.state.q_LB : sample.state.ref_q_LB).normalized();
  }
  Vec3<T> in_H(const Vec3<Paired<T>>& v_L) const { return transposed_times(R_LH_, motion_of(v_L, member_)); }
  /// The rate relative to the laboratory.
  Vec3<T> rate(const DriftSample<T>& sample) const {
    const Vec3<T> w_LB_B = problem_.units.rate_from_rad_s(rotating_ ? sample.state.w_LB_B : sample.state.ref_w_LB_B);
    return transposed_times(R_LH_, Vec3<T>(times(rotation_matrix(q_LB(sample)), w_LB_B)));
  }
  ReducedContactState<T> reduced(const DriftSample<T>& sample) const {
    ReducedContactState<T> x;
    x.n = in_H(sample.contact->axis_L);
    const Vec3<T> w_IB = rate(sample) + around_.W;
    x.w3 = spin(sample);
    x.u = w_IB - inner(w_IB, x.n) * x.n;
    x.v_P = in_H(sample.contact->slip_L), x.p_O = in_H(sample.contact->tip_L);
    return x;
  }

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
  const DriftProblem<T>& problem = scene.problem<T>();
  const Contact<T>& contact = problem.table->contact;
  const Conserved conserved(scene, is_symmetric(contact));
  const MotionInvariants<T> rotating(problem, true), reference(problem, false);
  const NaturalUnits& units = problem.units;
  const auto joules = [&](T x) { return real::scale(x, units.mass_exponent - 2 * units.time_exponent); };
  const auto momentum = [&](T x) { return real::scale(x, units.mass_exponent - units.time_exponent); };
  InvariantFollower<T> jacobi("jacobi_integral", "J"), energy("reference_energy", "J"), spin("inertial_spin", "rad/s"),
      jellett("reference_jellett_integral", "kg m^3/s"), routh("reference_routh_integral", "kg m^2 rad/s");
  const auto include_energy = [&](InvariantFollower<T>& follower, const ContactJacobi<T>& J) {
    follower.include(joules(J.value), joules(J.kinetic + real::abs(J.potential)));
  };
  const T length = contact.tip_radius + real::abs(contact.height_of_center);
  for (std::size_t i = 0; i < std::min(rows, samples.size()); ++i) {
    if (watch.asks_to_stop()) break;
    const DriftSample<T>& sample = samples[i];
    if (conserved.energy) {
      include_energy(jacobi, rotating.jacobi(sample));
      include_energy(energy, reference.jacobi(sample));
    }
    if (conserved.spin) {
      const T w3 = units.rate_to_rad_s(rotating.spin(sample));
      spin.include(w3, std::max(real::abs(w3), norm(sample.state.w_LB_B)));
    }
    if (conserved.jellett) {
      const T w = units.rate_from_rad_s(norm(sample.state.ref_w_LB_B));
      jellett.include(momentum(reference.jellett(sample)), momentum(std::max(contact.I1, contact.I3) * w * length));
    }
    if (conserved.routh) {
      const T value = units.rate_to_rad_s(real::scale(reference.routh(sample), units.mass_exponent));
      routh.include(value, real::abs(value));
    }
  }
  std::vector<InvariantReport> reports;
  if (conserved.energy) reports.push_back(jacobi.report()), reports.push_back(energy.report());
  if (conserved.spin) reports.push_back(spin.report());
  if (conserved.jellett) reports.push_back(jellett.report());
  if (conserved.routh) reports.push_back(routh.report());
  return reports;
}

template <class T>
std::array<ContactBalances, 2> assess_contact_balances(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                       std::size_t rows) {
  std::array<ContactBalances, 2> balances;
  const DriftProblem<T>& problem = scene.problem<T>();
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
    const MotionInvariants<T> motion(problem, rotates);
    const std::size_t number = rotates ? 1 : 0;
    const ContactIntegrals<T>&from = (*first.contact->integrals)[number], &to = (*last.contact->integrals)[number];
    ContactBalances& balance = balances[rotates ? 0 : 1];
    if (from.jellett_change && to.jellett_change) {
      const Contact<T>& c = problem.table->contact;
      const T spin = std::max(real::abs(motion.spin(first)), real::abs(motion.spin(last)));
      const T size = std::max(c.I1, c.I3) * std::max(spin, norm(problem.units.rate_from_rad_s(first.state.ref_w_LB_B))) *
                     (c.tip_radius + real::abs(c.height_of_center));
      balance.jellett = made(motion.jellett(first), motion.jellett(last), *to.jellett_change - *from.jellett_change, size,
                             units.mass_exponent - units.time_exponent);
    }
    if (effects.tide) continue;
    const ContactJacobi<T> J_first = motion.jacobi(first), J_last = motion.jacobi(last);
    const T size = std::max(J_first.kinetic + real::abs(J_first.potential), J_last.kinetic + real::abs(J_last.potential));
    balance.jacobi =
        made(J_first.value, J_last.value, to.work - from.work, size, units.mass_exponent - 2 * units.time_exponent);
  }
  return balances;
}

template <class T>
std::optional<LedgerReport> assess_contact_ledger(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                  std::size_t rows, const Watch& watch) {
  const std::optional<LedgerObserver>& observer = scene.scenario().ledger;
  if (!observer) return std::nullopt;
  const DriftProblem<T>& problem = scene.problem<T>();
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
template std::vector<InvariantReport> assess_contact_invariants(const Scene&, const std::vector<DriftSample<long double>>&,
                                                                std::size_t, const Watch&);
template std::array<ContactBalances, 2> assess_contact_balances(const Scene&, const std::vector<DriftSample<long double>>&,
                                                                std::size_t);
template std::optional<LedgerReport> assess_contact_ledger(const Scene&, const std::vector<DriftSample<long double>>&,
                                                           std::size_t, const Watch&);
template std::vector<InvariantReport> assess_contact_invariants(const Scene&, const std::vector<DriftSample<float128>>&,
                                                                std::size_t, const Watch&);
template std::array<ContactBalances, 2> assess_contact_balances(const Scene&, const std::vector<DriftSample<float128>>&,
                                                                std::size_t);
template std::optional<LedgerReport> assess_contact_ledger(const Scene&, const std::vector<DriftSample<float128>>&, std::size_t,
                                                           const Watch&);

}  // namespace earthtop
