// SPDX-License-Identifier: GPL-3.0-or-later
// The rates of a top on a table and how long they last: its turning and falling, and the relaxation of its slip.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "scene/support_laws.hpp"
#include "scene/touchdown.hpp"

namespace earthtop {
namespace {

/// The released body about its centre of mass, about which it turns on a table.
struct OnTable {
  Mat3<double> inertia;
  double mass, lever;  ///< lever: the longest arm of the table's force (m)
  double gravity, least, swinging, center, momentum, rate;
  int axis;

  explicit OnTable(const Scene& scene)
      : inertia(scene.body<double>().I_BBcm_B()),
        mass(scene.body<double>().mass),
        lever(norm(scene.body<double>().p_PBcm_B) + scene.scenario().contact->tip_radius_m),
        gravity(scene.site().gravity_m_s2),
        least(Eigen::SelfAdjointEigenSolver<Mat3<double>>(inertia, Eigen::EigenvaluesOnly).eigenvalues()[0]),
        swinging(scene.symmetry_axis() == 2 ? inertia(0, 0) : least),
        center(center_from_contact(scene)),
        momentum(norm(Vec3<double>(inertia * scene.release<double>().w_XB_B))),
        rate(norm(scene.release<double>().w_XB_B)),
        axis(scene.symmetry_axis()) {}

  /// Distance of the centre of mass from the contact point at release (m).
  static double center_from_contact(const Scene& scene) {
    const Mat3<double> R_HB = rotation_matrix(scene.release<double>().q_LB);
    return norm(
        Vec3<double>(R_HB * scene.body<double>().p_PBcm_B + scene.scenario().contact->tip_radius_m * Vec3<double>::UnitZ()));
  }
  /// Moment about which a symmetric top nutates: a top that rolls turns about its contact point.
  double nutating(ContactLaw law) const { return law == ContactLaw::rolling ? swinging + mass * center * center : swinging; }

  double falling_rate() const { return 2 * std::sqrt(mass * gravity * lever / swinging); }
  double earth_rate(const Scene& scene) const { return std::abs(scene.rotation_rate_rad_s()); }
};

std::string_view pointer_of(ContactLaw law) {
  switch (law) {
    case ContactLaw::frictionless:
    case ContactLaw::rolling: break;
    case ContactLaw::viscous: return "/contact/sliding_viscosity_N_s_m";
    case ContactLaw::viscous_load: return "/contact/sliding_viscosity_s_m";
    case ContactLaw::coulomb: return "/contact/regularisation_m_s";
    case ContactLaw::contensou: return "/contact/patch_radius_m";
  }
  return "/contact";
}

/// Returns the rate at which spinning friction and rolling resistance brake a turn below their regularisation (1/s).
double braking_rate(const ContactSpec& spec, const OnTable& top) {
  const double arm = spec.spinning_friction_m + spec.rolling_resistance_m;
  return arm > 0 ? arm * top.mass * top.gravity / (top.least * spec.regularisation_rad_s) : 0;
}

/// Returns the rate at which the air brakes the fastest turn or the centre of mass at release (1/s).
double air_rate(const Scene& scene, const OnTable& top) {
  const AirOnTable<double>& air = scene.table<double>().contact.air;
  if (!air.acts()) return 0;
  constexpr double kSpeed = 1;  // m/s: no top walks faster
  const double viscous = air.viscous + std::max({air.viscous_1, air.viscous_2, air.viscous_3});
  const double spinning = 2 * air.quadratic * top.rate + 2 * air.disc_laminar * std::sqrt(top.rate) +
                          2 * air.disc_turbulent * real::pow(top.rate, 0.8);
  return (viscous + spinning) / top.least + (air.force + 2 * air.force_by_speed * kSpeed) / top.mass;
}

/// Returns the integral over the time of the rate at which a slip dies out, for the law `contensou`, where it grows as the patch
/// brakes the spin.
double slip_damping(const Scene& scene, const OnTable& top, double rate) {
  constexpr double kLeft = 0.01;  // share of the spin at which the end counts as reached
  const ContactSpec& spec = *scene.scenario().contact;
  const double time = scene.scenario().duration_s;
  if (spec.law != ContactLaw::contensou || spec.friction_coefficient == 0) return rate * time;
  const double moment = 3 * std::numbers::pi / 16 * spec.friction_coefficient * top.mass * top.gravity * spec.patch_radius_m;
  const double stop = top.momentum / moment;  // s
  const double spent = std::min(time / stop, 1 - kLeft), rest = std::max(0.0, time - (1 - kLeft) * stop);
  return rate * (stop * -real::log1p(-spent) + rest / kLeft);
}

}  // namespace

void TableLaws::fit_units(const Scene& scene, NaturalUnits& units) const {
  // A ball has no pendulum: its tip may slide, and it falls off a tilted table, without a rate at release.
  int rate_exponent = 0;
  std::frexp(OnTable(scene).falling_rate(), &rate_exponent);
  units.time_exponent = std::min(units.time_exponent, -rate_exponent);
}

double TableLaws::fastest_rate(const Scene& scene) const {
  const OnTable top(scene);
  const double falling = 2 * std::sqrt(top.mass * top.gravity * top.lever / top.least);
  return std::max(top.momentum / top.least + falling + top.earth_rate(scene), 1 / scene.scenario().duration_s);
}

Paced TableLaws::paced(const Scene& scene) const {
  constexpr double kUnknownRelaxation = 1e5;  // 1/s: of a law with a corner where the slip ends
  const ContactSpec& spec = *scene.scenario().contact;
  const OnTable top(scene);
  const double time = scene.scenario().duration_s, carried = top.falling_rate() + top.earth_rate(scene);
  const double given = scene.touchdown().relaxation_rate_per_s();
  const double slip = std::isfinite(given) ? given : kUnknownRelaxation, braking = braking_rate(spec, top);

  Pace pace;
  pace.duration_s = time;
  pace.rows = scene.rows();
  pace.judgement_looks = kJudgementLooks;
  pace.axis_rate_rad_s = scene.fastest_rate_rad_s();
  if (top.axis == 2)
    pace.axis_rate_rad_s = std::min(pace.axis_rate_rad_s, std::max(top.momentum / top.swinging + carried, 1 / time));
  pace.turning_rad = std::max(1.0, (std::max(top.rate, top.momentum / top.least) + carried) * time);
  pace.watched_angle_rad = scene.fastest_rate_rad_s() * time;
  const double slipping = std::isfinite(given) ? slip_damping(scene, top, slip) : slip * time;
  const double air = air_rate(scene, top);
  pace.damping = slipping + (braking + air) * time;
  pace.reduced_damping = pace.damping;
  pace.reduced_turning_rad =
      top.axis == 2 ? std::min(pace.turning_rad, std::max(1.0, (top.momentum / top.nutating(spec.law) + carried) * time))
                    : pace.turning_rad;
  const std::string_view moments =
      spec.spinning_friction_m > 0 ? "/contact/spinning_friction_m" : "/contact/rolling_resistance_m";
  return {pace, {slip >= braking && slip >= air ? pointer_of(spec.law) : braking >= air ? moments : "/effects", pace.damping}};
}

}  // namespace earthtop
