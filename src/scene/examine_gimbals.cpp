// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a body in a Cardan suspension, its rates, its unit of time and its methods.
#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/model/gimbal_equations.hpp"
#include "scene/gimbal_rest.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

/// The suspension at the release, without the Earth.
struct ReleasedGimbals {
  Gimbals<double> gimbals;
  double m11, m12, m22;  ///< of the mass matrix of both angles (kg m^2)
  double m11_most;       ///< the largest m11 of any inner angle
  double momentum;       ///< of the rotor (kg m^2/s)
  double torque;         ///< the largest of gravity (N m)

  explicit ReleasedGimbals(const Scene& scene)
      : gimbals(gimbals_of<double>(scene.scenario())), momentum(norm(rotor_momentum(scene))) {
    const Body<double>& body = scene.body<double>();
    const GimbalAngles<double>& at = gimbals.release;
    const GimbalPose<double, double> pose{gimbals, real::sin_cos(at.outer), real::sin_cos(at.inner)};
    const Vec3<double> a_B = pose.outer_axis_B(), I_a = times(body.I_BP_B, a_B);
    m11 = gimbals.ring.I(2, 2) + a_B.dot(I_a), m12 = I_a[1], m22 = body.I_BP_B(1, 1);
    const Eigen::SelfAdjointEigenSolver<Mat3<double>> moments(body.I_BP_B, Eigen::EigenvaluesOnly);
    m11_most = gimbals.ring.I(2, 2) + moments.eigenvalues()[2];
    const double field = scene.site().gravity_m_s2 + scene.platform_demand().acceleration_m_s2;
    torque = field *
             (norm(Vec3<double>(body.mass * body.p_PBcm_B)) + norm(gimbals.ring.mass_moment) + masses_pace(scene).moment_kg_m);
  }
  /// Whether the equations can be solved for the accelerations.
  bool is_solvable() const {
    constexpr double kLeast = 1e-12;
    if (gimbals.inner.locked) return m11 > 0;
    if (gimbals.outer.locked) return m22 > 0;
    return m11 * m22 - m12 * m12 > kLeast * m11_most * m22;
  }
  /// The rate of the nutation (rad/s); 0 where one gimbal is locked.
  double nutation() const {
    if (gimbals.outer.locked || gimbals.inner.locked) return 0;
    return momentum / std::sqrt(m11 * m22 - m12 * m12);
  }
  /// The least moment of a free axis.
  double least() const {
    if (gimbals.inner.locked) return m11;
    if (gimbals.outer.locked) return m22;
    return std::min(m11 - m12 * m12 / m22, m22 - m12 * m12 / m11);
  }
};

}  // namespace

void SuspensionLaws::check(const input::Section& root, const Scene& scene) const {
  const Scenario& scenario = scene.scenario();
  const EffectsSpec& effects = scenario.effects;
  const input::Section given = root.section("effects");
  const auto refuse = [&](const char* key, bool is_given, const char* why) {
    if (is_given) given.refuse_key(key, std::string("is not available with /gimbals: ") + why + "; leave one of the two out");
  };
  constexpr const char* kBearings = "it is friction of a pivot, and gimbals have bearings with friction of their own";
  refuse("viscous_torque_N_m_s", effects.applied.viscous_N_m_s != 0 || effects.applied.viscous_by_axis_N_m_s, kBearings);
  refuse("quadratic_torque_N_m_s2", effects.applied.quadratic_N_m_s2 != 0, kBearings);
  refuse("coulomb_torque_N_m", effects.applied.coulomb_N_m != 0, kBearings);
  refuse("air_drag", effects.applied.air_drag.has_value(), "it is the drag of a disc that spins about body axis 3 itself");
  refuse("unequal_support", effects.applied.unequal_support.has_value(), "a gimbal's springs are its torsion_N_m_rad");
  refuse("given_torque", effects.applied.given_torque.has_value(), "it acts on a body about a pivot");
  refuse("gimbal", effects.applied.gimbal.has_value(), "it holds a rigid wheel without moments of its own");
  constexpr const char* kWhole = "the torques of parts that move belong to all three";
  refuse("coriolis", !effects.coriolis, kWhole);
  refuse("centrifugal", !effects.centrifugal, kWhole);
  refuse("transverse", !effects.transverse, kWhole);
  const input::Section numerics = root.section("numerics");
  if (numerics.has("observer") && scenario.numerics.observer == Observer::body)
    numerics.refuse(
        "observer",
        "is \"body\", and with /gimbals the equations are those of all parts, which no one of them carries; must be "
        "\"laboratory\" or \"inertial\"");
  if (!ReleasedGimbals(scene).is_solvable())
    root.section("release").refuse(
        "inner_angle_deg",
        "is a gimbal lock (gimbal_lock): here the parts that turn about the outer axis have no moment of inertia, and nothing "
        "resists them; give the outer gimbal a mass and moments, or another angle");
}

void SuspensionLaws::fit_units(const Scene& scene, NaturalUnits& units) const {
  const ReleasedGimbals at(scene);
  int exponent = 0;
  std::frexp(scene.fastest_rate_rad_s(), &exponent);
  units.time_exponent = std::min(units.time_exponent, -exponent);
  std::frexp(std::max(at.m11_most, at.m22), &exponent);
  units.mass_exponent = exponent;
}

double SuspensionLaws::fastest_rate(const Scene& scene) const {
  const Scenario& scenario = scene.scenario();
  const ReleasedGimbals at(scene);
  const Gimbals<double>& gimbals = at.gimbals;
  const double carried = std::abs(scene.rotation_rate_rad_s()) + scene.platform_demand().rate_rad_s, least = at.least();
  double rate = at.nutation() + 2 * std::sqrt(at.torque / least) + std::sqrt(gimbals.outer.torsion / at.m11) +
                std::sqrt(gimbals.inner.torsion / at.m22) + std::abs(gimbals.release.outer_rate) +
                std::abs(gimbals.release.inner_rate) + carried;
  // With one gimbal locked the rotor is a compass, or a gyroscope that feels the turning of its carrier.
  if (at.nutation() == 0) rate += std::sqrt(at.momentum * carried / least);
  if (scenario.rotor) rate += 2 * std::numbers::pi * std::abs(scenario.rotor->frequency_hz);
  const MassesPace masses = masses_pace(scene);
  rate += masses.rate_rad_s + masses.momentum_kg_m2_s / least;
  return std::max(rate, 1 / scenario.duration_s);
}

Paced SuspensionLaws::paced(const Scene& scene) const {
  const Scenario& scenario = scene.scenario();
  const ReleasedGimbals at(scene);
  const double time = scenario.duration_s, rate = scene.fastest_rate_rad_s();
  Paced paced;
  Pace& pace = paced.pace;
  pace.duration_s = time;
  pace.rows = scene.rows();
  pace.judgement_looks = kJudgementLooks;
  pace.axis_rate_rad_s = rate;
  for (const FiledTable* table : tables_of(scenario)) pace.joints += static_cast<double>(table->rows->t_s.size());
  pace.joints += masses_pace(scene).joints;
  pace.turning_rad = pace.watched_angle_rad = std::max(1.0, rate * time);
  const auto damp = [&](std::string_view pointer, double viscous, double coulomb, double regularisation, double moment) {
    const double steepest = viscous + (coulomb > 0 ? coulomb / regularisation : 0), damping = steepest / moment * time;
    pace.damping += damping;
    // Regularised dry friction turns over where a rate changes its sign, twice in each nutation.
    if (coulomb > 0) pace.halts += rate * time / std::numbers::pi;
    if (damping > paced.stiffest.damping) paced.stiffest = {pointer, damping};
  };
  const Bearing<double>&outer = at.gimbals.outer, &inner = at.gimbals.inner;
  damp("/gimbals/outer", outer.viscous, outer.coulomb, outer.regularisation, at.m11);
  damp("/gimbals/inner", inner.viscous, inner.coulomb, inner.regularisation, at.m22);
  if (const auto& rotor = scenario.rotor)
    damp("/rotor", rotor->viscous_torque_N_m_s, rotor->coulomb_torque_N_m, rotor->regularisation_rad_s,
         1 / (1 / rotor->axial_kg_m2 + 1 / at.least()));
  pace.reduced_turning_rad = pace.turning_rad, pace.reduced_damping = pace.damping;
  return paced;
}

MethodChoice SuspensionLaws::choose_method(const Scene& scene) const {
  IntegrationOptions options = scene.scenario().numerics;
  if (options.method == Method::taylor) return {options, "asked for"};
  if (options.method != Method::automatic || scene.scenario().precision != Precision::bits53)
    return PivotLaws::choose_method(scene);
  options.method = Method::taylor;
  return {options, "the equations of a suspension have Taylor series, which take the fewest operations"};
}

IntegrationOptions SuspensionLaws::second_options(const Scene& scene, const IntegrationOptions& first,
                                                  IntegrationOptions second) const {
  second = PivotLaws::second_options(scene, first, second);
  second.observer = first.observer == Observer::inertial ? Observer::laboratory : Observer::inertial;
  return second;
}

std::optional<std::string> SuspensionLaws::refuse(const MethodRow& row, const Scene&) const {
  const Method method = row.method;
  if (method == Method::automatic || method == Method::taylor || method == Method::extrapolation || method == Method::rkf78)
    return std::nullopt;
  return fmt::format("\"{}\" is not built for a body in gimbals; take \"auto\", \"taylor\", \"extrapolation\" or \"rkf78\"",
                     row.word);
}

void SuspensionLaws::add_figures(TopFigures& top, const Scene& scene, double) const {
  const GimbalInertia inertia = gimbal_inertia(scene);
  TopFigures::OfGimbals& figures = top.gimbals.emplace();
  figures.outer_moment_kg_m2 = inertia.outer, figures.inner_moment_kg_m2 = inertia.inner;
  if (std::abs(top.spin_rad_s) <= 4 * real::epsilon<double>() * norm(scene.release<double>().w_XB_B)) top.spin_rad_s = 0;
  if ((top.nutation_rad_s = gimbal_nutation(scene))) top.nutation_kind = NutationKind::small_amplitude;
  const double Omega = std::abs(scene.rotation_rate_rad_s()), h = std::abs(gimbal_rotor_momentum(scene));
  // A balanced gyroscope rests along the celestial axis, about which it turns once a sidereal day: that is no place of rest to speak of.
  constexpr double kSlowest = 12 * 3600;
  if (const auto rest = gimbal_rest(scene, Prediction::rotating); rest && !(rest->slow_period_s > kSlowest)) {
    figures.slow_period_s = rest->slow_period_s, figures.fast_period_s = rest->fast_period_s;
    figures.outer_rest_rad = rest->outer_rad, figures.inner_rest_rad = rest->inner_rad;
  }
  if (top.nutation_rad_s && h > 0 && Omega > 0) {
    const double weight = scene.body<double>().mass * scene.site().gravity_m_s2;  // of body and rotor
    figures.earth_torque_N_m = h * Omega;
    if (weight > 0) figures.earth_offset_m = h * Omega / weight;
    const double cosine = std::abs(real::cos(scene.model<double>().gimbals.release.inner));
    // X^2 = 2 M0^2 Omega / (h |cos b| (A3 + B3)), where it is small
    const double square = 2 * inertia.outer * inertia.outer * Omega / (h * cosine * inertia.axial);
    if (has_magnus_drift(scene) && square < 0.1) figures.earth_nutation_rad = std::sqrt(square);
  }
  top.left_out.emplace_back("precession, nutation and critical spin of a rigid top: gimbals hold the body");
}

}  // namespace earthtop
