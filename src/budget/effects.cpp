// SPDX-License-Identifier: GPL-3.0-or-later
#include "budget/effects.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "budget/journey_effects.hpp"
#include "budget/torque_size.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "earthtop/model/applied_motion.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kWithoutDate = "2026-01-01T00:00:00Z";  // used only to size effects if the scene gives no date
constexpr double kUsualExcess_s = 1e-3;                            // typical excess of the length of day
constexpr double kUsualDeflection_arcsec = 10;                     // typical deflection of the vertical

UtcInstant start_of(const Scene& scene) {
  return *parse_utc(scene.scenario().start_utc ? std::string_view(*scene.scenario().start_utc) : kWithoutDate);
}
bool has_pole(const Scene& scene) { return scene.site().pole.x_arcsec != 0 || scene.site().pole.y_arcsec != 0; }
bool has_deflection(const Scene& scene) {
  return scene.site().deflection.north_arcsec != 0 || scene.site().deflection.east_arcsec != 0;
}
/// Returns the words that name the time for which an effect is sized, if the scene gives none.
std::string dated(const Scene& scene) { return scene.scenario().start_utc ? "" : fmt::format(" at {}", kWithoutDate); }

Candidate coriolis(const Scene& scene) {
  Candidate c;
  c.reason = scene.scenario().effects.coriolis ? "an effect of the Earth's rotation: on unless switched off" : "switched off";
  c.input.coriolis = 1;
  c.torque = [scene](const FollowedStep& s) {
    const Model<double>& m = scene.problem_without_rows<double>().model;
    return coriolis_size(s, m.W_IL_L, m.S_BP_B);
  };
  return c;
}

Candidate centrifugal(const Scene& scene) {
  Candidate c;
  c.reason = scene.scenario().effects.centrifugal
                 ? "of second order in the Earth's rate; the first-order part is in apparent gravity"
                 : "switched off";
  c.input.centrifugal = 1;
  c.torque = [scene](const FollowedStep& s) {
    const Model<double>& m = scene.problem_without_rows<double>().model;
    return size_of_product(centrifugal_torque(seen_from(s, m.W_IL_L), m.S_BP_B),
                           norm(m.W_IL_L) * norm(m.W_IL_L) * m.S_BP_B.norm());
  };
  return c;
}

/// A release at equal inertial rates differs, in the laboratory, from one at equal laboratory rates by the rate -W.
Candidate release_matching(const Scene&) {
  Candidate c;
  c.reason =
      "the two predictions start with the same inertial rates, so that their rates in the laboratory differ by the Earth's";
  c.input.release = 1;
  c.torque = [](const FollowedStep&) { return 0.0; };
  return c;
}

/// Returns the candidate for a change of the Earth's rate vector. @param share_L  the change over the Earth's rate (1)
Candidate earth_rate_change(const Vec3<double>& share_L, const Scene& scene) {
  Candidate c;
  const Model<double>& m = scene.problem_without_rows<double>().model;
  const double rate_scaled = norm(m.W_IL_L_scaled), size = norm(share_L);
  const Vec3<double> direction = size > 0 ? Vec3<double>(share_L / size) : Vec3<double>(Vec3<double>::UnitZ());
  c.size = size;
  c.input.W_IL_L_scaled = rate_scaled * direction;
  const Vec3<double> change_L = m.epsilon * rate_scaled * direction;
  c.torque = [S_BP_B = m.S_BP_B, change_L](const FollowedStep& s) { return coriolis_size(s, change_L, S_BP_B); };
  return c;
}

Vec3<double> axis_change(const Scene& scene, const PolarMotion& pole, const VerticalDeflection& deflection) {
  Site ellipsoid = scene.site();
  ellipsoid.pole = {}, ellipsoid.deflection = {};
  return celestial_axis_L<double>(ellipsoid, pole, deflection) - celestial_axis_L<double>(ellipsoid);
}

Candidate polar_motion(const Scene& scene) {
  const bool modelled = has_pole(scene);
  const PolarMotion pole = modelled ? scene.site().pole : secular_pole(julian_epoch_year(start_of(scene)));
  Candidate c = earth_rate_change(axis_change(scene, pole, {}), scene);
  c.reason = modelled ? "as given" : "left out; sized for the secular pole" + dated(scene);
  return c;
}

Candidate length_of_day(const Scene& scene) {
  const double given_s = scene.scenario().excess_length_of_day_ms * 1e-3;
  const double excess_s = given_s != 0 ? given_s : kUsualExcess_s;
  Candidate c = earth_rate_change(Vec3<double>(excess_s / 86400 * celestial_axis_L<double>(scene.site())), scene);
  c.assumed = given_s == 0;
  c.reason = c.assumed ? "left out; sized for a day that is longer by 1 ms" : "as given";
  return c;
}

Candidate deflection(const Scene& scene) {
  const bool modelled = has_deflection(scene);
  const VerticalDeflection sized = modelled ? scene.site().deflection : VerticalDeflection{kUsualDeflection_arcsec, 0};
  Candidate c = earth_rate_change(axis_change(scene, {}, sized), scene);
  c.assumed = !modelled;
  c.reason = modelled ? "as given" : fmt::format("left out; sized for {} arcsec to the North", kUsualDeflection_arcsec);
  return c;
}

Candidate axis_precession(const Scene& scene) {
  const double rate = std::abs(scene.rotation_rate_rad_s());
  const Vec3<double> precession_L = precession_rate_L(scene.site(), start_of(scene));
  const Vec3<double> share_L = rate > 0 ? Vec3<double>(precession_L / rate) : Vec3<double>(Vec3<double>::Zero());
  Candidate c = earth_rate_change(share_L, scene);
  c.reason = "never modelled: the Earth's axis precesses once in 26,000 years, at 4e-8 of the Earth's rate";
  return c;
}

/// Returns the candidate for a torque that acts in both predictions, in units of its own size at release.
Candidate torque_in_both(const AppliedTorques<double>& applied, double strength, const Scene& scene) {
  Candidate c;
  c.in_difference = false;
  c.size = strength;
  AppliedTorques<double> unit = applied;
  unit.any = true, unit.level_axis = false;
  const double frequency = applied.given.frequency, phase = applied.given.phase;
  for_each_coefficient([strength](double& coefficient) { coefficient /= strength; },
                       [strength](std::array<GradientTerm<double>, 2>& gradient) {
                         for (GradientTerm<double>& term : gradient) term.strength /= strength;
                       },
                       unit);
  c.input.applied = unit;
  // A torque of a given course is changed in its size alone.
  c.input.applied.given.frequency = c.input.applied.given.phase = 0;
  unit.given.frequency = frequency, unit.given.phase = phase;
  c.torque = [scene, unit](const FollowedStep& s) {
    Model<double> alone = scene.problem_without_rows<double>().model;
    alone.applied = unit;
    return norm(applied_torque_B(alone, s.t, s.q_LB, s.w_LB_B, true));
  };
  return c;
}

double largest_moment(const Scene& scene) { return scene.problem_without_rows<double>().model.I_BP_B.diagonal().maxCoeff(); }

Candidate gravity_gradient(const Scene& scene) {
  AppliedTorquesSpec spec;
  const auto& given = scene.scenario().effects.applied.gravity_gradient;
  spec.gravity_gradient = given ? given : GravityGradientSpec{GradientField::normal, 0};
  const auto applied =
      make_applied_torques<double>(spec, scene.site(), 0, scene.units().mass_exponent, scene.units().time_exponent);
  const double strength = std::max(std::abs(applied.gradient[0].strength), std::abs(applied.gradient[1].strength));
  if (!(strength > 0)) {
    Candidate none = torque_in_both(applied, 1, scene);
    none.reason = "of strength 0";
    return none;
  }
  Candidate c = torque_in_both(applied, strength * largest_moment(scene), scene);
  c.reason = given ? "asked for" : "left out; sized for the tensor of the normal field";
  return c;
}

Candidate tide(const Scene& scene) {
  Candidate c;
  c.in_difference = false;
  const bool modelled = scene.scenario().effects.tide.has_value();
  c.reason = modelled ? "asked for" : "left out; sized for a rigid Earth" + dated(scene);
  constexpr double kLongest_s = 86400;  // one day is enough to see the size of the tide
  TideSeries<double> series;
  if (modelled)
    series = scene.problem_without_rows<double>().model.tide;
  else
    series = TideSeries<double>::of_bodies(scene.site(), start_of(scene), std::min(scene.scenario().duration_s, kLongest_s))
                 .scaled(scene.units().time_exponent);
  c.input.tide = series;
  const Vec3<double> moment_B = scene.problem_without_rows<double>().model.mass_moment_B;
  c.torque = [moment_B, tide = c.input.tide](const FollowedStep& s) {
    return norm(field_torque(moment_B, seen_from(s, tide.acceleration_L(s.t))));
  };
  return c;
}

using FrictionCoefficient = double AppliedTorques<double>::*;

/// Returns the candidate for a single kind of friction, if the scene has it. Its size is that of its torque at the rate of release.
/// @tparam coefficients  those of this kind
template <FrictionCoefficient... coefficients>
std::optional<Candidate> friction(const Scene& scene) {
  const DriftProblem<double>& problem = scene.problem_without_rows<double>();
  const double rate = std::max(norm(problem.natural_release().w_XB_B), 1e-3);
  AppliedTorques<double> alone;
  ((alone.*coefficients = problem.model.applied.*coefficients), ...);
  double size = 0;
  for (int i = 0; i < 3; ++i) size = std::max(size, norm(friction_torque(alone, Vec3<double>(rate * Vec3<double>::Unit(i)))));
  if (!(size > 0)) return std::nullopt;
  Candidate c = torque_in_both(alone, size, scene);
  c.reason = "as given";
  return c;
}

/// Return the candidates for an unequal support and for a given torque without a table, if the scene has them.
std::optional<Candidate> unequal_support(const Scene& scene) {
  AppliedTorques<double> alone;
  alone.support = scene.problem_without_rows<double>().model.applied.support;
  if (!alone.support.acts()) return std::nullopt;
  Candidate c = torque_in_both(alone, alone.support.largest(), scene);
  c.reason = "as given";
  return c;
}
std::optional<Candidate> given_torque(const Scene& scene) {
  AppliedTorques<double> alone;
  alone.given = scene.problem_without_rows<double>().model.applied.given;
  const double size = real::hypot(alone.given.x, alone.given.y, alone.given.z);
  if (!(size > 0)) return std::nullopt;
  Candidate c = torque_in_both(alone, size, scene);
  c.reason = "as given";
  return c;
}

bool is_left_ashore(const Effect& effect, const Scene& scene) { return travels(scene) && !effect.aboard.empty(); }

/// Wraps a size function to the type that the catalogue holds. @tparam size  function that returns a Candidate
template <auto size>
std::optional<Candidate> sized(const Scene& scene) {
  return size(scene);
}

constexpr std::string_view kNoCoefficient = "left out; the scenario gives no coefficient";

bool always(const Scene&) { return true; }
bool never(const Scene&) { return false; }
const EffectsSpec& effects(const Scene& scene) { return scene.scenario().effects; }

const Effect kEffects[] = {
    {"gravity", "", always, Listing::summary},
    {kCoriolis, "/effects/coriolis", [](const Scene& s) { return effects(s).coriolis; }, Listing::both, sized<coriolis>},
    {kCentrifugal, "/effects/centrifugal", [](const Scene& s) { return effects(s).centrifugal; }, Listing::both,
     sized<centrifugal>},
    {.name = kTransverse,
     .key = "/effects/transverse",
     .is_modelled = [](const Scene& s) { return effects(s).transverse; },
     .is_zero = true,
     .modelled_unsized = "zero: the Earth turns uniformly",
     .left_out_unsized = "zero: the Earth turns uniformly",
     .aboard = "in the axes East, North, Up that are carried along it is not zero; the motion is followed in axes without it"},
    {"release_matching", "/release/rates_relative_to",
     [](const Scene& s) { return s.scenario().release.rates_relative_to == RatesRelativeTo::inertial; },
     Listing::budget_where_modelled, sized<release_matching>},
    {.name = "platform_motion",
     .key = "/platform",
     .is_modelled = [](const Scene& s) { return s.scenario().platform.has_value(); },
     .modelled_unsized = "not sized, since it carries both predictions",
     .left_out_unsized = "left out; the pivot is at rest in the laboratory"},
    {.name = kEotvos,
     .key = "/travel",
     .is_modelled = is_felt,
     .listing = Listing::where_modelled,
     .size = eotvos,
     .modelled_unsized = kEotvosReason,
     .torque = eotvos_torque},
    {.name = kBallistic,
     .key = "/travel",
     .is_modelled = travels,
     .listing = Listing::where_modelled,
     .size = ballistic,
     .modelled_unsized = kBallisticReason,
     .torque = ballistic_torque},
    {.name = kTransport,
     .key = "/travel",
     .is_modelled = travels,
     .listing = Listing::where_modelled,
     .size = transport,
     .modelled_unsized = kTransportReason},
    {.name = "gravity_gradient",
     .key = "/effects/gravity_gradient",
     .is_modelled = [](const Scene& s) { return effects(s).applied.gravity_gradient.has_value(); },
     .size = sized<gravity_gradient>,
     .switch_on =
         [](Scenario& s) {
           s.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
         },
     .share = "gradient"},
    {.name = "tide",
     .key = "/effects/tide",
     .is_modelled = [](const Scene& s) { return effects(s).tide.has_value(); },
     .size = sized<tide>,
     .switch_on = [](Scenario& s) { s.effects.tide = TideSpec{}; },
     .needs_date = true,
     .share = "tide",
     .aboard = "left out; it belongs to one place, and is not carried along"},
    {.name = "polar_motion",
     .key = "/effects/polar_motion",
     .is_modelled = has_pole,
     .size = sized<polar_motion>,
     .switch_on = [](Scenario& s) { s.site.pole = secular_pole(julian_epoch_year(*parse_utc(*s.start_utc))); },
     .needs_date = true},
    {"length_of_day", "/effects/excess_length_of_day_ms",
     [](const Scene& s) { return s.scenario().excess_length_of_day_ms != 0; }, Listing::both, sized<length_of_day>},
    {"deflection_of_vertical", "/effects/deflection_of_vertical", has_deflection, Listing::both, sized<deflection>},
    {kAxisPrecession, "", never, Listing::both, sized<axis_precession>},
    {.name = "viscous_torque",
     .key = "/effects/viscous_torque_N_m_s",
     .is_modelled =
         [](const Scene& s) {
           return effects(s).applied.viscous_N_m_s != 0 || effects(s).applied.viscous_by_axis_N_m_s.has_value();
         },
     .size = friction<&AppliedTorques<double>::viscous, &AppliedTorques<double>::viscous_1, &AppliedTorques<double>::viscous_2,
                      &AppliedTorques<double>::viscous_3>,
     .share = "friction",
     .left_out_unsized = kNoCoefficient},
    {.name = "quadratic_torque",
     .key = "/effects/quadratic_torque_N_m_s2",
     .is_modelled = [](const Scene& s) { return effects(s).applied.quadratic_N_m_s2 != 0; },
     .size = friction<&AppliedTorques<double>::quadratic>,
     .share = "friction",
     .left_out_unsized = kNoCoefficient},
    {.name = "air_drag",
     .key = "/effects/air_drag",
     .is_modelled = [](const Scene& s) { return effects(s).applied.air_drag.has_value(); },
     .size = friction<&AppliedTorques<double>::disc_laminar, &AppliedTorques<double>::disc_turbulent>,
     .share = "friction",
     .left_out_unsized = kNoCoefficient},
    {.name = "coulomb_torque",
     .key = "/effects/coulomb_torque_N_m",
     .is_modelled = [](const Scene& s) { return effects(s).applied.coulomb_N_m != 0; },
     .size = friction<&AppliedTorques<double>::coulomb>,
     .share = "friction",
     .left_out_unsized = kNoCoefficient},
    {.name = "gimbal",
     .key = "/effects/gimbal",
     .is_modelled = [](const Scene& s) { return effects(s).applied.gimbal.has_value(); },
     .listing = Listing::summary_and_where_modelled,
     .share = "gimbal",
     .modelled_unsized = "not sized, since it is a constraint: it holds the axis level"},
    {.name = "unequal_support",
     .key = "/effects/unequal_support",
     .is_modelled = [](const Scene& s) { return effects(s).applied.unequal_support.has_value(); },
     .listing = Listing::where_modelled,
     .size = unequal_support,
     .share = "support"},
    {.name = "given_torque",
     .key = "/effects/given_torque",
     .is_modelled = [](const Scene& s) { return effects(s).applied.given_torque.has_value(); },
     .listing = Listing::where_modelled,
     .size = given_torque,
     .share = "given",
     .modelled_unsized = "not sized, since a table gives it"},
    {.name = "air_force",
     .key = "/effects/air_force",
     .is_modelled = [](const Scene& s) { return effects(s).applied.air_force.has_value(); },
     .listing = Listing::where_modelled,
     .share = "friction",
     .modelled_unsized = "as given"},
    {.name = kRotorBearing,
     .key = "/rotor",
     .is_modelled =
         [](const Scene& s) {
           const auto& rotor = s.scenario().rotor;
           return rotor && (rotor->drive != RotorDrive::none || rotor->has_friction());
         },
     .listing = Listing::budget_where_modelled,
     .modelled_unsized = "between rotor and body, along the rotor's axis: in a symmetric cage it does not move the axis"},
    {"elasticity", "", never, Listing::summary},
};

}  // namespace

std::span<const Effect> all_effects() { return kEffects; }

std::vector<Candidate> effect_candidates(const Scene& scene) {
  std::vector<Candidate> candidates;
  for (const Effect& effect : kEffects) {
    if (!effect.size || !effect.is_in_budget(scene) || is_left_ashore(effect, scene)) continue;
    if (std::optional<Candidate> candidate = effect.size(scene)) {
      candidate->effect = &effect;
      candidates.push_back(*std::move(candidate));
    }
  }
  return candidates;
}

std::vector<Candidate> selectable_effects(const Scene& scene) {
  std::vector<Candidate> candidates;
  for (const Effect& effect : kEffects) {
    if (!effect.switch_on || effect.is_modelled(scene) || (effect.needs_date && !scene.scenario().start_utc)) continue;
    candidates.push_back(*effect.size(scene));
    candidates.back().effect = &effect;
  }
  return candidates;
}

EffectEntry unsized_entry(const Effect& effect, const Scene& scene) {
  EffectEntry entry;
  entry.name = effect.name;
  entry.modelled = effect.is_modelled(scene);
  entry.in_difference = effect.is_zero;
  entry.reason = entry.modelled ? effect.modelled_unsized : effect.left_out_unsized;
  if (effect.torque && entry.modelled) {
    const std::array<double, 2> torque = effect.torque(scene);
    entry.torque_release_N_m = torque[0], entry.torque_largest_N_m = torque[1];
  }
  if (is_left_ashore(effect, scene))
    entry.reason = effect.aboard;
  else if (effect.is_zero)
    entry.torque_release_N_m = entry.torque_largest_N_m = entry.drift_rad = entry.drift_final_rad = 0;
  return entry;
}

bool has_share(const Scene& scene, std::string_view share) {
  return std::any_of(std::begin(kEffects), std::end(kEffects),
                     [&](const Effect& effect) { return effect.share == share && effect.is_modelled(scene); });
}

std::vector<std::string_view> effect_names(const Scene& scene, bool modelled) {
  std::vector<std::string_view> names;
  for (const Effect& effect : kEffects)
    if (effect.is_in_summary(scene) && effect.is_modelled(scene) == modelled) names.push_back(effect.name);
  return names;
}

}  // namespace earthtop
