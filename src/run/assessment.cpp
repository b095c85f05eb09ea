#include "run/assessment.hpp"

#include <cmath>

#include "earthtop/model/invariants.hpp"
#include "run/setup.hpp"

namespace earthtop {
namespace {

/// Follows one conserved quantity over the rows.
class InvariantFollower {
 public:
  InvariantFollower(std::string name, std::string unit) { report_.name = std::move(name), report_.unit = std::move(unit); }
  void include(double value, double scale) {
    if (first_) report_.initial = value;
    first_ = false;
    report_.largest_change = std::max(report_.largest_change, std::abs(value - report_.initial));
    report_.scale = std::max(report_.scale, scale);
  }
  const InvariantReport& report() const { return report_; }

 private:
  InvariantReport report_;
  bool first_ = true;
};

Quaternion<double> quaternion(const std::array<double, 4>& q) { return {q[0], Vec3<double>(q[1], q[2], q[3])}; }
Vec3<double> vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::vector<InvariantReport> assess_invariants(const Scenario& scenario, const std::vector<DriftRow>& rows) {
  if (scenario.platform || !scenario.effects.all_on()) return {};
  const auto body = make_body<double>(scenario.body);
  const Vec3<double> mass_moment_B = body.mass * body.p_PBcm_B;
  const Vec3<double> gravity_L = apparent_gravity_L<double>(scenario.site);
  const Vec3<double> W_L = scenario.rotation_rate_rad_s * celestial_axis_L<double>(scenario.site);
  const int axis = symmetry_axis(body);
  InvariantFollower jacobi("jacobi_integral", "J"), energy("reference_energy", "J"), spin("inertial_spin", "rad/s");
  for (const DriftRow& row : rows) {
    const Quaternion<double> q = quaternion(row.q_LB);
    const Vec3<double> w_LB_B = vector(row.w_LB_B);
    const auto J = jacobi_integral(body.I_BP_B, mass_moment_B, gravity_L, W_L, q, w_LB_B);
    jacobi.include(J.value, J.scale);
    const auto E = jacobi_integral<double>(body.I_BP_B, mass_moment_B, gravity_L, Vec3<double>::Zero(),
                                           quaternion(row.ref_q_LB), vector(row.ref_w_LB_B));
    energy.include(E.value, E.scale);
    if (axis >= 0) {
      const double w = w_LB_B[axis] + (rotation_matrix(q).transpose() * W_L)[axis];
      spin.include(w, std::max(std::abs(w), norm(w_LB_B)));
    }
  }
  std::vector<InvariantReport> reports{jacobi.report(), energy.report()};
  if (axis >= 0) reports.push_back(spin.report());
  return reports;
}

std::vector<TheoryReport> assess_theory(const Scenario& scenario, const std::vector<DriftRow>& rows,
                                        const DriftSummary& drift) {
  const auto body = make_body<double>(scenario.body);
  const double Omega = scenario.rotation_rate_rad_s;
  if (symmetry_axis(body) != 2 || scenario.platform || !scenario.effects.coriolis || Omega == 0 || rows.size() < 3) return {};
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const SinCos<double> phi = sin_cos_degrees(scenario.site.latitude_deg);
  const double I1 = body.I_BP_B(0, 0), spin_momentum = body.I_BP_B(2, 2) * release.w_XB_B[2];
  const double mgl = body.mass * scenario.site.gravity_m_s2 * body.p_PBcm_B[2];
  const Vec3<double> axis_L = rotation_matrix(release.q_LB).col(2);
  const bool vertical = real::hypot(axis_L[0], axis_L[1]) < 1e-9;
  std::vector<TheoryReport> theory;
  if (mgl == 0) {
    const bool along_axis = release.X == RatesRelativeTo::inertial && release.w_XB_B[0] == 0 && release.w_XB_B[1] == 0;
    if (along_axis) {
      // The axis keeps its direction in space: in the laboratory it turns about the celestial axis.
      const double sine = norm(Vec3<double>(celestial_axis_L<double>(scenario.site).cross(axis_L)));
      const double t = rows.back().t_s;
      theory.push_back({"free_gyro_axis_drift",
                        "the axis stays in inertial space: 2 asin(sin(angle from the celestial axis) |sin(Omega t/2)|)", "rad",
                        2 * std::asin(sine * std::abs(std::sin(Omega * t / 2))), drift.axis_final_rad});
    }
    return theory;
  }
  // Fast: at least twice the spin at which an upright top falls asleep.
  const bool fast = spin_momentum * spin_momentum > 16 * I1 * std::abs(mgl);
  if (!fast) return theory;
  if (vertical) {
    double lean_south = 0;
    for (const DriftRow& row : rows) lean_south -= (row.axis_L[1] - row.ref_axis_L[1]) / static_cast<double>(rows.size());
    if (axis_L[2] > 0)
      theory.push_back({"sleeping_top_lean_south", "mean lean I3 w3 Omega cos(latitude) / (m g l)", "rad",
                        spin_momentum * Omega * phi.cos / mgl, lean_south});
    return theory;
  }
  if (drift.secular)
    theory.push_back({"precession_rate_change", "-Omega sin(latitude), counterclockwise about Up", "rad/s", -Omega * phi.sin,
                      drift.secular->mean_precession_rate_change_rad_s});
  return theory;
}

std::optional<LedgerReport> assess_ledger(const Scenario& scenario, const std::vector<DriftRow>& rows) {
  if (!scenario.ledger) return std::nullopt;
  const auto model = make_model<double>(scenario);
  LedgerReport report;
  report.observer = *scenario.ledger;
  report.entries.reserve(rows.size());
  for (const DriftRow& row : rows) {
    report.entries.push_back(ledger_entry(report.observer, model, row.t_s, quaternion(row.q_LB), vector(row.w_LB_B)));
    report.largest.include(report.entries.back());
  }
  return report;
}

}  // namespace earthtop
