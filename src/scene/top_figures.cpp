// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scene/top_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closed_form/principal_axes.hpp"
#include "closed_form/top_constants.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/gyrostat.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/journey_figures.hpp"
#include "scene/support_laws.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

constexpr double kRoundOff = 8 * real::epsilon<double>();

/// The principal moments, each in the place of the body axis that its own axis is nearest to.
std::array<double, 3> principal_moments(const Mat3<float128>& tensor) {
  const PrincipalAxes<float128> found = principal_axes<float128>(tensor);
  const Mat3<float128> axes = rotation_matrix(found.q_BP);
  std::array<int, 3> order{0, 1, 2}, best = order;
  float128 most = -1;
  do {
    float128 near = 0;
    for (int i = 0; i < 3; ++i)
      near += axes(i, order[static_cast<std::size_t>(i)]) * axes(i, order[static_cast<std::size_t>(i)]);
    if (near > most) most = near, best = order;
  } while (std::next_permutation(order.begin(), order.end()));
  std::array<double, 3> moments{};
  // A moment about the centre of mass that is 0, as that of a point, may come out of the given doubles a rounding below it.
  for (std::size_t i = 0; i < 3; ++i) moments[i] = std::max(0.0, static_cast<double>(found.moments[best[i]]));
  return moments;
}

/// A number, or none where it is beyond a double.
std::optional<double> finite(double number) { return std::isfinite(number) ? std::optional(number) : std::nullopt; }

/// The largest speed of the outermost circle of the solids about its centre (m/s); empty without solids that have a radius.
std::optional<double> rim_speed(const BodySpec& spec, double rate_rad_s) {
  double radius = 0;
  for (const Solid& solid : spec.solids) radius = std::max(radius, solid.radius_m);
  return radius > 0 ? finite(radius * rate_rad_s) : std::nullopt;
}

/// Why no rate of precession, nutation or critical spin is given whatever the body is; empty where there may be one.
std::string_view why_not_a_top_on_a_pivot(const Scenario& scenario) {
  if (scenario.effects.applied.unequal_support)
    return "precession, nutation and critical spin: the support is not equally stiff, so that gravity is not the only torque";
  if (scenario.effects.applied.gimbal) return "precession, nutation and critical spin: the gimbal holds the axis level";
  if (scenario.platform && scenario.platform->pivot_offset_m != std::array<double, 3>{})
    return "precession, nutation and critical spin: the platform carries the pivot round, so that gravity is not the only "
           "force";
  return "";
}

std::string_view why_not_symmetric(const Body<double>& body) {
  const Mat3<double>& I = body.I_BP_B;
  if (I(0, 1) != 0 || I(0, 2) != 0 || I(1, 2) != 0) return "axis 3 is not a principal axis of the body about the pivot";
  if (I(0, 0) != I(1, 1)) return "I1 and I2 about the pivot are not equal";
  return "the centre of mass is off axis 3";
}

/// Adds the figures of a body on which gravity has no torque about the pivot.
void add_free_body(TopFigures& top, const Body<double>& body, const Vec3<double>& w) {
  top.left_out.emplace_back("precession and critical spin: gravity has no torque about the pivot");
  const Mat3<double>& I = body.I_BP_B;
  const bool is_principal = I(0, 1) == 0 && I(0, 2) == 0 && I(1, 2) == 0;
  if (!is_principal || I(0, 0) != I(1, 1)) {
    if (is_principal && (I(2, 2) - I(0, 0)) * (I(2, 2) - I(1, 1)) < 0)
      top.notes.emplace_back("I3 is the middle moment: turning about axis 3 is unstable");
    top.left_out.emplace_back(is_principal ? "nutation: I1 and I2 about the pivot are not equal"
                                           : "nutation: axis 3 is not a principal axis of the body about the pivot");
    return;
  }
  const double across = I(0, 0) * real::hypot(w[0], w[1]), along = I(2, 2) * std::abs(w[2]);
  const double rate = real::hypot(across, along) / I(0, 0);
  if (!(rate > 0)) {
    top.left_out.emplace_back("nutation: the body is at rest");
    return;
  }
  top.nutation_rad_s = rate;
  top.nutation_kind = across > 0 ? NutationKind::of_release : NutationKind::small_amplitude;
}

/// Adds the steady rates. @param cosine  of the tilt; exactly 0, 1 or -1 where it is so to round-off
void add_precession(TopFigures& top, const SymmetricTop<double>& body, double cosine) {
  const auto rates = steady_precession_rates<double>(body, top.spin_rad_s, cosine);
  if (!rates) {
    const double least = 2 * real::sqrt(body.I1 * std::abs(body.mgl * cosine)) / body.I3;
    top.left_out.push_back(least > 0
                               ? fmt::format("steady precession: at this tilt it needs a spin of at least {} rad/s ({} rpm)",
                                             least_text(least), least_text(least * 30 / std::numbers::pi))
                               : "steady precession: a top at 90 degrees needs a spin");
    return;
  }
  top.slow_precession_rad_s = finite(rates->slow);
  top.fast_precession_rad_s = finite(rates->fast);
  if (cosine == 0) top.left_out.emplace_back("fast precession: at a tilt of 90 degrees there is none");
  if (std::abs(cosine) == 1) top.notes.emplace_back("the axis is vertical: the precessions are those of a small lean");
  if (top.spin_rad_s == 0)
    top.notes.emplace_back("without spin the two precessions are those of a conical pendulum, either way round");
}

/// Whether the axis keeps away from the vertical, so that its azimuth has a mean rate.
bool goes_round_the_vertical(LagrangeRegime regime) {
  return regime == LagrangeRegime::steady || regime == LagrangeRegime::wavy || regime == LagrangeRegime::cusped ||
         regime == LagrangeRegime::looping;
}

void add_nutation(TopFigures& top, const Scene& scene, const SymmetricTop<double>& body, double cosine) {
  const Release<double>& release = scene.release<double>();
  const auto give = [&](double rate, NutationKind kind) {
    top.nutation_rad_s = rate;
    top.nutation_kind = kind;
  };
  const LagrangeTop<double> motion(body, release.q_LB, release.w_XB_B);
  const double period = motion.nutation_period_s();
  const LagrangeRegime regime = motion.regime();
  if (std::abs(cosine) == 1 && release.w_XB_B[0] == 0 && release.w_XB_B[1] == 0) {
    // A small lean goes round at the two rates of precession, and its size beats at their difference.
    const double spin = body.I3 * top.spin_rad_s, square = spin * spin - 4 * body.I1 * body.mgl * cosine;
    if (square > 0)
      give(real::sqrt(square) / body.I1, NutationKind::small_amplitude);
    else
      top.left_out.emplace_back("nutation: the upright top is not stable at this spin");
    return;
  }
  if (!std::isfinite(period) || !(period > 0)) {
    top.left_out.emplace_back("nutation: this release tends to the upright position and has no period");
    return;
  }
  give(2 * std::numbers::pi / period,
       regime == LagrangeRegime::steady ? NutationKind::small_amplitude : NutationKind::of_release);
  const bool in_a_plane = regime == LagrangeRegime::plane_swinging || regime == LagrangeRegime::plane_turning;
  if (const auto rates = in_a_plane ? std::nullopt : mean_rates(top_constants_of(scene))) {
    top.mean_precession_rad_s = rates->precession_rad_s;
    top.mean_precession_bound_rad_s = rates->precession_bound_rad_s;
  } else if (goes_round_the_vertical(regime)) {
    top.left_out.emplace_back("mean precession: the axis passes through the vertical, or too near it");
  }
  if (regime == LagrangeRegime::plane_swinging)
    top.notes.emplace_back("the top swings as a pendulum: its tilt has half the period of a full swing");
}

void add_critical_spin(TopFigures& top, const SymmetricTop<double>& body, double cosine) {
  if (body.mgl * cosine < 0) {
    top.left_out.emplace_back("critical spin: the centre of mass hangs below the pivot");
    return;
  }
  top.critical_spin_rad_s = critical_spin<double>({body.I1, body.I3, std::abs(body.mgl)});
  top.spin_over_critical = finite(std::abs(top.spin_rad_s) / *top.critical_spin_rad_s);
}

/// A release without its steady precession, which does not change the rate about the axis.
ReleaseSpec spec_without_steady(ReleaseSpec spec) {
  if (spec.precession != Precession::given) spec.precession = Precession::none;
  return spec;
}

/// Adds the rotor. The other figures of a rotor in a symmetric cage are those of the rigid top that moves as its axis does.
void add_rotor(TopFigures& top, const Scene& scene, const RotorSpec& spec) {
  const Rotor<double> rotor = make_rotor<double>(spec);
  const bool in_gimbals = scene.support().has_gimbals;
  const Release<double> release =
      in_gimbals ? scene.release<double>()
                 : make_release<double>(spec_without_steady(scene.scenario().release), scene.body<double>(), 0);
  top.rotor_spin_rad_s = rotor.spin;
  top.rotor_momentum_kg_m2_s = rotor.axial * (rotor.spin + (rotor.driven ? 0 : rotor.axis_B.dot(release.w_XB_B)));
  if (scene.support().has_moving_parts()) {
    if (!rotor.driven) top.notes.emplace_back("the moments are those of body and rotor without the rotor's axial moment");
    return;
  }
  top.notes.push_back(
      fmt::format("the axis moves as that of a rigid top with these moments and a spin of {:.6g} rad/s", top.spin_rad_s));
  top.spin_rad_s = release.w_XB_B[2];
}

}  // namespace

BasicTopConstants<float128> top_constants_of(const Scene& scene) {
  const Body<float128>& body = scene.body<float128>();
  const Release<float128>& release = scene.release<float128>();
  const float128 mgl = body.mass * float128(scene.site().gravity_m_s2) * body.p_PBcm_B[2];
  return top_constants(SymmetricTop<float128>{body.I_BP_B(0, 0), body.I_BP_B(2, 2), mgl}, release.q_LB, release.w_XB_B);
}

TopFigures top_figures_of(const Scene& scene) {
  TopFigures top;
  const Body<float128>& exact = scene.body<float128>();
  const Body<double>& body = scene.body<double>();
  const Release<double>& release = scene.release<double>();
  top.mass_kg = body.mass;
  for (std::size_t i = 0; i < 3; ++i) top.center_of_mass_m[i] = body.p_PBcm_B[static_cast<int>(i)];
  top.moments_about_pivot_kg_m2 = principal_moments(exact.I_BP_B);
  top.moments_about_center_kg_m2 = principal_moments(exact.I_BBcm_B());
  top.spin_rad_s = release.w_XB_B[2];
  top.rim_speed_m_s = rim_speed(scene.scenario().body, norm(release.w_XB_B));
  const Mat3<double> R_LB = rotation_matrix(release.q_LB);
  double cosine = R_LB(2, 2);
  const bool is_vertical = real::hypot(R_LB(0, 2), R_LB(1, 2)) <= kRoundOff;
  cosine = std::copysign(is_vertical ? 1 : std::min(std::abs(cosine), 1 - real::epsilon<double>()), cosine);
  if (std::abs(cosine) <= kRoundOff) cosine = 0;
  laws_of(scene).add_figures(top, scene, cosine);
  if (const auto& rotor = scene.scenario().rotor) add_rotor(top, scene, *rotor);
  if (scene.scenario().travel) top.journey = journey_figures_of(scene);
  return top;
}

void PivotLaws::add_figures(TopFigures& top, const Scene& scene, double cosine) const {
  if (const std::string_view why = why_not_a_top_on_a_pivot(scene.scenario()); !why.empty()) {
    top.left_out.emplace_back(why);
    return;
  }
  const Body<double>& body = scene.body<double>();
  const bool is_symmetric = scene.symmetry_axis() == 2;
  if (scene.gravity_torque_N_m() == 0) {
    add_free_body(top, body, scene.release<double>().w_XB_B);
  } else if (!is_symmetric) {
    top.left_out.push_back(fmt::format("precession, nutation and critical spin: {}", why_not_symmetric(body)));
  } else {
    const SymmetricTop<double> symmetric{body.I_BP_B(0, 0), body.I_BP_B(2, 2), scene.axial_gravity_torque_N_m()};
    add_precession(top, symmetric, cosine);
    add_nutation(top, scene, symmetric, cosine);
    add_critical_spin(top, symmetric, cosine);
  }
  if (scene.scenario().effects.applied.friction() && top.nutation_rad_s)
    top.notes.emplace_back("the rates are those at release, without friction");
  if (scene.scenario().effects.applied.given_torque && top.nutation_rad_s)
    top.notes.emplace_back("the rates are those at release, without the given torque");
}

std::optional<double> period_of(const std::optional<double>& rate_rad_s) {
  return rate_rad_s && *rate_rad_s != 0 ? finite(2 * std::numbers::pi / std::abs(*rate_rad_s)) : std::nullopt;
}

}  // namespace earthtop
