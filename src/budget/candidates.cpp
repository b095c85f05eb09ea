// SPDX-License-Identifier: GPL-3.0-or-later
#include "budget/candidates.hpp"

#include <fmt/core.h>

#include <cmath>

#include "earthtop/elementary.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "earthtop/model/applied_motion.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kWithoutDate = "2026-01-01T00:00:00Z";  // for sizes only, where a scene names no date
constexpr double kUsualExcess_s = 1e-3;                            // of the length of day
constexpr double kUsualDeflection_arcsec = 10;                     // of the vertical

Vec3<double> seen_from(const FollowedStep& step, const Vec3<double>& u_L) {
  return transposed_times(rotation_matrix(step.q_LB), u_L);
}

UtcInstant start_of(const Scene& scene) {
  return *parse_utc(scene.scenario().start_utc ? std::string_view(*scene.scenario().start_utc) : kWithoutDate);
}
std::string dated(const Scene& scene) {
  return scene.scenario().start_utc ? "" : fmt::format(", sized as on {}", kWithoutDate);
}

Candidate coriolis(const Scene& scene) {
  Candidate c;
  c.name = "coriolis";
  c.modelled = scene.scenario().effects.coriolis;
  c.reason = c.modelled ? "the Earth's rotation: on unless switched off" : "switched off";
  c.input.coriolis = 1;
  c.torque = [scene](const FollowedStep& s) {
    const Model<double>& m = scene.problem<double>().model;
    return norm(coriolis_torque(seen_from(s, m.W_IL_L), velocity_moment(m.S_BP_B, s.w_LB_B)));
  };
  return c;
}

Candidate centrifugal(const Scene& scene) {
  Candidate c;
  c.name = "centrifugal";
  c.modelled = scene.scenario().effects.centrifugal;
  c.reason = c.modelled ? "of second order in the Earth's rate; the first is in apparent gravity" : "switched off";
  c.input.centrifugal = 1;
  c.torque = [scene](const FollowedStep& s) {
    return norm(centrifugal_torque(seen_from(s, scene.problem<double>().model.W_IL_L), scene.problem<double>().model.S_BP_B));
  };
  return c;
}

/// A start that is the same in inertial space is, in the laboratory, one at the rate -W.
Candidate matching() {
  Candidate c;
  c.name = "release_matching";
  c.modelled = true;
  c.reason = "the two predictions start with the same inertial rates, which differ by the Earth's in the laboratory";
  c.input.release = 1;
  c.torque = [](const FollowedStep&) { return 0.0; };
  return c;
}

/// A change of the Earth's rate in laboratory axes by `share` of it.
Candidate earth_rate_change(std::string_view name, const Vec3<double>& share_L, const Scene& scene) {
  Candidate c;
  c.name = name;
  const Model<double>& m = scene.problem<double>().model;
  const double rate_scaled = norm(m.W_IL_L_scaled), size = norm(share_L);
  const Vec3<double> direction = size > 0 ? Vec3<double>(share_L / size) : Vec3<double>(Vec3<double>::UnitZ());
  c.size = size;
  c.input.W_IL_L_scaled = rate_scaled * direction;
  const Vec3<double> change_L = m.epsilon * rate_scaled * direction;
  c.torque = [S_BP_B = m.S_BP_B, change_L](const FollowedStep& s) {
    return norm(coriolis_torque(seen_from(s, change_L), velocity_moment(S_BP_B, s.w_LB_B)));
  };
  return c;
}

Vec3<double> axis_change(const Scene& scene, const PolarMotion& pole, const VerticalDeflection& deflection) {
  Site ellipsoid = scene.site();
  ellipsoid.pole = {}, ellipsoid.deflection = {};
  return celestial_axis_L<double>(ellipsoid, pole, deflection) - celestial_axis_L<double>(ellipsoid);
}

Candidate polar_motion(const Scene& scene) {
  const PolarMotion& given = scene.site().pole;
  const bool modelled = given.x_arcsec != 0 || given.y_arcsec != 0;
  const PolarMotion pole = modelled ? given : secular_pole(julian_epoch_year(start_of(scene)));
  Candidate c = earth_rate_change("polar_motion", axis_change(scene, pole, {}), scene);
  c.modelled = modelled;
  c.reason = modelled ? "as given" : "left out; sized by the secular pole" + dated(scene);
  return c;
}

Candidate length_of_day(const Scene& scene) {
  const double given_s = scene.scenario().excess_length_of_day_ms * 1e-3;
  const double excess_s = given_s != 0 ? given_s : kUsualExcess_s;
  Candidate c =
      earth_rate_change("length_of_day", Vec3<double>(excess_s / 86400 * celestial_axis_L<double>(scene.site())), scene);
  c.modelled = given_s != 0;
  c.assumed = !c.modelled;
  c.reason = c.modelled ? "as given" : "left out; sized by a day longer by 1 ms";
  return c;
}

Candidate deflection(const Scene& scene) {
  const VerticalDeflection& given = scene.site().deflection;
  const bool modelled = given.north_arcsec != 0 || given.east_arcsec != 0;
  const VerticalDeflection sized = modelled ? given : VerticalDeflection{kUsualDeflection_arcsec, 0};
  Candidate c = earth_rate_change("deflection_of_vertical", axis_change(scene, {}, sized), scene);
  c.modelled = modelled;
  c.assumed = !modelled;
  c.reason = modelled ? "as given" : fmt::format("left out; sized by {} arcsec to the North", kUsualDeflection_arcsec);
  return c;
}

Candidate axis_precession(const Scene& scene) {
  const double rate = std::abs(scene.rotation_rate_rad_s());
  const Vec3<double> precession_L = precession_rate_L(scene.site(), start_of(scene));
  const Vec3<double> share_L = rate > 0 ? Vec3<double>(precession_L / rate) : Vec3<double>(Vec3<double>::Zero());
  Candidate c = earth_rate_change(kAxisPrecession, share_L, scene);
  c.reason = "never modelled: the axis goes round in 26,000 years, 4e-8 of the Earth's rate";
  return c;
}

/// A torque in both predictions, in units of its own size at release.
Candidate torque_in_both(std::string_view name, const AppliedTorques<double>& applied, double strength, const Scene& scene) {
  Candidate c;
  c.name = name;
  c.in_difference = false;
  c.size = strength;
  AppliedTorques<double> unit = applied;
  unit.any = true, unit.level_axis = false;
  for (double* part : {&unit.viscous, &unit.quadratic, &unit.coulomb, &unit.disc_laminar, &unit.disc_turbulent,
                       &unit.gradient[0].strength, &unit.gradient[1].strength})
    *part /= strength;
  c.input.applied = unit;
  c.torque = [scene, unit](const FollowedStep& s) {
    Model<double> alone = scene.problem<double>().model;
    alone.applied = unit;
    return norm(applied_torque_B(alone, s.t, s.q_LB, s.w_LB_B, true));
  };
  return c;
}

double largest_moment(const Scene& scene) { return scene.problem<double>().model.I_BP_B.diagonal().maxCoeff(); }

Candidate gravity_gradient(const Scene& scene) {
  AppliedTorquesSpec spec;
  const auto& given = scene.scenario().effects.applied.gravity_gradient;
  spec.gravity_gradient = given ? given : GravityGradientSpec{GradientField::normal, 0};
  const auto applied =
      make_applied_torques<double>(spec, scene.site(), 0, scene.units().mass_exponent, scene.units().time_exponent);
  const double strength = std::max(std::abs(applied.gradient[0].strength), std::abs(applied.gradient[1].strength));
  if (!(strength > 0)) {
    Candidate none = torque_in_both("gravity_gradient", applied, 1, scene);
    none.modelled = true;
    none.reason = "of strength 0";
    return none;
  }
  Candidate c = torque_in_both("gravity_gradient", applied, strength * largest_moment(scene), scene);
  c.modelled = given.has_value();
  c.reason = c.modelled ? "asked for" : "left out; sized by the tensor of the normal field";
  return c;
}

Candidate tide(const Scene& scene) {
  Candidate c;
  c.name = "tide";
  c.in_difference = false;
  c.modelled = scene.scenario().effects.tide.has_value();
  c.reason = c.modelled ? "asked for" : "left out; sized on a rigid Earth" + dated(scene);
  constexpr double kLongest_s = 86400;  // a day shows its size
  TideSeries<double> series;
  if (c.modelled)
    series = scene.problem<double>().model.tide;
  else
    series = TideSeries<double>::of_bodies(scene.site(), start_of(scene), std::min(scene.scenario().duration_s, kLongest_s))
                 .scaled(scene.units().time_exponent);
  c.input.tide = series;
  const Vec3<double> moment_B = scene.problem<double>().model.mass_moment_B;
  c.torque = [moment_B, tide = c.input.tide](const FollowedStep& s) {
    return norm(field_torque(moment_B, seen_from(s, tide.acceleration_L(s.t))));
  };
  return c;
}

/// Friction that the scene gives, each kind by itself.
void add_friction(const Scene& scene, std::vector<Candidate>& candidates) {
  const AppliedTorques<double>& all = scene.problem<double>().model.applied;
  const double rate = std::max(norm(scene.units().rate_from_rad_s(scene.problem<double>().release.w_XB_B)), 1e-3);
  const auto add = [&](std::string_view name, double size, const std::function<void(AppliedTorques<double>&)>& keep) {
    if (!(size > 0)) return;
    AppliedTorques<double> alone;
    keep(alone);
    Candidate c = torque_in_both(name, alone, size, scene);
    c.modelled = true;
    c.reason = "as given";
    candidates.push_back(c);
  };
  add("viscous_torque_N_m_s", all.viscous * rate, [&](auto& a) { a.viscous = all.viscous; });
  add("quadratic_torque_N_m_s2", all.quadratic * rate * rate, [&](auto& a) { a.quadratic = all.quadratic; });
  add("coulomb_torque_N_m", all.coulomb, [&](auto& a) { a.coulomb = all.coulomb; });
  add("air_drag", all.disc_laminar * real::pow(rate, 1.5) + all.disc_turbulent * real::pow(rate, 1.8), [&](auto& a) {
    a.disc_laminar = all.disc_laminar;
    a.disc_turbulent = all.disc_turbulent;
  });
}

}  // namespace

std::vector<Candidate> effect_candidates(const Scene& scene) {
  std::vector<Candidate> candidates{coriolis(scene), centrifugal(scene)};
  if (scene.scenario().release.rates_relative_to == RatesRelativeTo::inertial) candidates.push_back(matching());
  candidates.push_back(gravity_gradient(scene));
  candidates.push_back(tide(scene));
  candidates.push_back(polar_motion(scene));
  candidates.push_back(length_of_day(scene));
  candidates.push_back(deflection(scene));
  candidates.push_back(axis_precession(scene));
  add_friction(scene, candidates);
  return candidates;
}

std::vector<Candidate> selectable_effects(const Scene& scene) {
  std::vector<Candidate> candidates{gravity_gradient(scene)};
  if (scene.scenario().start_utc) {
    candidates.push_back(tide(scene));
    candidates.push_back(polar_motion(scene));
  }
  std::erase_if(candidates, [](const Candidate& candidate) { return candidate.modelled; });
  return candidates;
}

std::vector<EffectEntry> effects_of_unknown_size(const Scene& scene) {
  const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
  std::vector<EffectEntry> entries;
  const auto add = [&](std::string_view name, bool modelled, std::string_view reason) {
    EffectEntry entry;
    entry.name = name;
    entry.modelled = modelled;
    entry.in_difference = false;
    entry.reason = reason;
    entries.push_back(std::move(entry));
  };
  {
    EffectEntry transverse;
    transverse.name = "transverse";
    transverse.modelled = scene.scenario().effects.transverse;
    transverse.torque_release_N_m = transverse.torque_largest_N_m = transverse.drift_rad = transverse.drift_final_rad = 0;
    transverse.reason = "zero: the Earth turns uniformly";
    entries.push_back(std::move(transverse));
  }
  constexpr std::string_view kNoCoefficient = "left out; the scene gives no coefficient";
  if (applied.viscous_N_m_s == 0) add("viscous_torque_N_m_s", false, kNoCoefficient);
  if (applied.quadratic_N_m_s2 == 0) add("quadratic_torque_N_m_s2", false, kNoCoefficient);
  if (applied.coulomb_N_m == 0) add("coulomb_torque_N_m", false, kNoCoefficient);
  if (!applied.air_drag) add("air_drag", false, kNoCoefficient);
  if (applied.gimbal) add("gimbal", true, "holds the axis level: a constraint, not sized");
  add("platform", scene.scenario().platform.has_value(),
      scene.scenario().platform ? "both predictions ride on it: not sized"
                                : "left out; the pivot is at rest in the laboratory");
  return entries;
}

}  // namespace earthtop
