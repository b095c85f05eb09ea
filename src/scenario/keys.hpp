// SPDX-License-Identifier: GPL-3.0-or-later
/// One description of each section of a scenario: its keys and the members that they set. `Reading` uses it to decode a text,
/// `Writing` uses it to write the canonical text. Keys that exclude each other are variants here; the decoder checks all other
/// rules that involve several keys.
#pragma once

#include <string_view>

#include "earthtop/scenario/inputs.hpp"
#include "input/fields.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {

// -- site and Earth

/// Describes the site. Gravity is given, or computed from latitude and height, to which an anomaly may be added. Without an
/// anomaly the value of gravity is written; otherwise the anomaly is.
template <class Codec, class S>
void site_keys(Codec& codec, S& scenario) {
  codec.key("latitude_deg", scenario.site.latitude_deg);
  codec.key("longitude_deg", scenario.site.longitude_deg);
  codec.key("height_m", scenario.site.height_m);
  if (codec.takes("gravity_m_s2", scenario.gravity_anomaly_m_s2 == 0))
    codec.key("gravity_m_s2", scenario.site.gravity_m_s2);
  else
    codec.key("gravity_anomaly_m_s2", scenario.gravity_anomaly_m_s2);
}

template <class Codec, class S>
void earth_keys(Codec& codec, S& scenario) {
  codec.key("rotation_rate_rad_s", scenario.rotation_rate_rad_s);
}

// -- body

template <class Codec, class S>
void solid_keys(Codec& codec, S& solid) {
  codec.word("shape", solid.shape, kShapeRules);
  // A member that the shape does not have must not be written, as it would be refused on reading; otherwise its default is 0.
  codec.sparse("radius_m", solid.radius_m);
  if (row_of(kShapeRules, solid.shape).inner_radius == Need::required)
    codec.key("inner_radius_m", solid.inner_radius_m);
  else
    codec.sparse("inner_radius_m", solid.inner_radius_m);
  codec.sparse("length_m", solid.length_m);
  codec.key("mass_kg", solid.mass_kg);
  codec.key("density_kg_m3", solid.density_kg_m3);
  codec.key("at_m", solid.at_m);
}

/// Describes the inertia. The tensor is written in full; when reading, its principal moments may be given instead.
template <class Codec, class S>
void inertia_keys(Codec& codec, S& body) {
  codec.word("about", body.inertia_about, kInertiaPoints);
  if constexpr (!Codec::kWrites) {
    if (codec.takes("principal_kg_m2", false)) {
      std::array<double, 3> moments = {};
      codec.key("principal_kg_m2", moments);
      for (std::size_t i = 0; i < 3; ++i) body.inertia_kg_m2[i][i] = moments[i];
      return;
    }
  }
  codec.key("matrix_kg_m2", body.inertia_kg_m2);
}

/// Describes a body that is not a union of solids.
template <class Codec, class S>
void body_keys(Codec& codec, S& body) {
  codec.key("mass_kg", body.mass_kg);
  codec.key("center_of_mass_m", body.center_of_mass_m);
  codec.object("inertia", true, [&](auto& below) { inertia_keys(below, body); });
}

// -- release

template <class Codec, class S>
void attitude_keys(Codec& codec, S& release) {
  if (codec.takes("quaternion_LB", release.quaternion_LB.has_value())) {
    if constexpr (!Codec::kWrites) release.quaternion_LB.emplace();
    codec.object("quaternion_LB", true, [&](auto& below) {
      constexpr std::string_view kParts[] = {"w", "x", "y", "z"};
      for (std::size_t i = 0; i < 4; ++i) below.key(kParts[i], (*release.quaternion_LB)[i]);
    });
    return;
  }
  codec.key("tilt_deg", release.tilt_deg);
  codec.key("azimuth_deg", release.azimuth_deg);
  codec.key("spin_angle_deg", release.spin_angle_deg);
}

/// Describes the spin. It is written in rad/s, so that the canonical text has the number that the run used.
template <class Codec, class S>
void spin_keys(Codec& codec, S& release) {
  if constexpr (!Codec::kWrites) {
    if (codec.takes("spin_rpm", false)) {
      double rpm = 0;
      codec.key("spin_rpm", rpm);
      release.spin_rad_s = rad_s_from_rpm(rpm);
      return;
    }
  }
  codec.key("spin_rad_s", release.spin_rad_s);
}

template <class Codec, class S>
void precession_keys(Codec& codec, S& release) {
  if constexpr (!Codec::kWrites)
    if (codec.is_object("precession")) release.precession = Precession::given;
  if (release.precession == Precession::given)
    codec.object("precession", true, [&](auto& below) { below.key("rate_rad_s", release.precession_rate_rad_s); });
  else
    codec.word("precession", release.precession, kPrecessions);
}

template <class Codec, class S>
void rates_keys(Codec& codec, S& release) {
  if (codec.takes("angular_velocity_body_rad_s", release.angular_velocity_body_rad_s.has_value()))
    return codec.key("angular_velocity_body_rad_s", release.angular_velocity_body_rad_s);
  spin_keys(codec, release);
  precession_keys(codec, release);
}

// -- motion and platform

template <class Codec, class S>
void motion_keys(Codec& codec, S& scenario) {
  codec.key("duration_s", scenario.duration_s);
  codec.key("output_step_s", scenario.output_step_s);
  codec.key("start_utc", scenario.start_utc);
}

template <class Codec, class S>
void platform_keys(Codec& codec, S& platform) {
  codec.word("motion", platform.motion, kMotionRules);
  codec.key("axis", platform.axis);
  codec.key("pivot_offset_m", platform.pivot_offset_m);
  const auto of_motion = [&](std::string_view key, auto& member) {
    if (!Codec::kWrites || input::lists(row_of(kMotionRules, platform.motion).allowed, key)) codec.key(key, member);
  };
  of_motion("rate_rad_s", platform.rate_rad_s);
  of_motion("acceleration_rad_s2", platform.acceleration_rad_s2);
  of_motion("amplitude_rad", platform.amplitude_rad);
  of_motion("frequency_hz", platform.frequency_hz);
  of_motion("phase_deg", platform.phase_deg);
  of_motion("file", platform.table.file);
  of_motion("file_sha256", platform.table.file_sha256);  // represents the table in the run's identity
}

// -- instrument

template <class Codec, class S>
void instrument_keys(Codec& codec, S& instrument) {
  for (std::size_t i = 0; i < kInstrumentInputs; ++i) {
    codec.key(instrument_key(kInstrument[i].pointer), instrument.value[i]);
    codec.sparse(instrument_key(kInstrument[i].standard_error), instrument.standard_error[i]);
  }
  for (std::size_t i = 0; i < kInstrumentScales; ++i)
    codec.key(instrument_key(kReadScales[i].reversed), instrument.reversed[i]);
}

// -- rotor

/// The spin is written in rad/s, and what is off is left out.
template <class Codec, class S>
void rotor_keys(Codec& codec, S& rotor) {
  codec.key("mass_kg", rotor.mass_kg);
  codec.key("axial_kg_m2", rotor.axial_kg_m2);
  codec.key("transverse_kg_m2", rotor.transverse_kg_m2);
  codec.key("axis", rotor.axis);
  codec.key("center_m", rotor.center_m);
  const bool has_table = Codec::kWrites ? rotor.drive == RotorDrive::table : codec.takes("file", false);
  if (!has_table) spin_keys(codec, rotor);
  codec.word("drive", rotor.drive, kDriveRules);
  codec.sparse("acceleration_rad_s2", rotor.acceleration_rad_s2);
  codec.sparse("amplitude_rad_s", rotor.amplitude_rad_s);
  codec.sparse("frequency_hz", rotor.frequency_hz);
  codec.sparse("phase_deg", rotor.phase_deg);
  codec.sparse("viscous_torque_N_m_s", rotor.viscous_torque_N_m_s);
  codec.sparse("coulomb_torque_N_m", rotor.coulomb_torque_N_m);
  codec.sparse("regularisation_rad_s", rotor.regularisation_rad_s);
  codec.sparse("file", rotor.table.file);
  codec.sparse("file_sha256", rotor.table.file_sha256);  // represents the table in the run's identity
}

// -- gimbals

template <class Codec, class S>
void bearing_keys(Codec& codec, S& bearing) {
  codec.key("locked", bearing.locked);
  codec.sparse("viscous_torque_N_m_s", bearing.viscous_torque_N_m_s);
  codec.sparse("coulomb_torque_N_m", bearing.coulomb_torque_N_m);
  codec.sparse("regularisation_rad_s", bearing.regularisation_rad_s);
  codec.sparse("torsion_N_m_rad", bearing.torsion_N_m_rad);
  codec.sparse("torsion_rest_deg", bearing.torsion_rest_deg);
}

template <class Codec, class S>
void gimbals_keys(Codec& codec, S& gimbals) {
  codec.object("outer", true, [&](auto& below) {
    below.key("axis_tilt_deg", gimbals.axis_tilt_deg);
    below.key("axis_azimuth_deg", gimbals.axis_azimuth_deg);
    if (gimbals.ring) body_keys(below, *gimbals.ring);
    bearing_keys(below, gimbals.outer);
  });
  codec.object("inner", true, [&](auto& below) {
    below.key("axis_skew_deg", gimbals.axis_skew_deg);
    bearing_keys(below, gimbals.inner);
  });
}

template <class Codec, class S>
void gimbal_release_keys(Codec& codec, S& release) {
  codec.key("outer_angle_deg", release.outer_angle_deg);
  codec.key("inner_angle_deg", release.inner_angle_deg);
  codec.key("outer_rate_rad_s", release.outer_rate_rad_s);
  codec.key("inner_rate_rad_s", release.inner_rate_rad_s);
}

// -- moving masses

/// The keys of a motion are written with that motion only.
template <class Codec, class S>
void moving_mass_keys(Codec& codec, S& mass) {
  codec.key("mass_kg", mass.mass_kg);
  codec.word("carrier", mass.carrier, kMassCarriers);
  codec.word("motion", mass.motion, kMassMotionRules);
  const auto of_motion = [&](std::string_view key, auto& member) {
    if (!Codec::kWrites || input::lists(row_of(kMassMotionRules, mass.motion).allowed, key)) codec.key(key, member);
  };
  of_motion("center_m", mass.center_m);
  of_motion("amplitude_m", mass.amplitude_m);
  of_motion("start_m", mass.start_m);
  of_motion("axis", mass.axis);
  of_motion("frequency_hz", mass.frequency_hz);
  of_motion("phase_deg", mass.phase_deg);
  of_motion("times_s", mass.times_s);
  of_motion("points_m", mass.points_m);
  of_motion("file", mass.coordinates[0].file);
  of_motion("file_sha256", mass.coordinates[0].file_sha256);  // represents the table in the run's identity
}

// -- contact

/// Describes the contact. A law's coefficients are written with that law only; what is off, and a level table, is left out.
template <class Codec, class S>
void contact_keys(Codec& codec, S& contact) {
  codec.key("tip_radius_m", contact.tip_radius_m);
  codec.word("law", contact.law, kContactLaws);
  const auto of_law = [&](std::string_view key, auto& member) {
    if (!Codec::kWrites || input::lists(row_of(kContactLaws, contact.law).allowed, key)) codec.key(key, member);
  };
  of_law("sliding_viscosity_N_s_m", contact.sliding_viscosity_N_s_m);
  of_law("sliding_viscosity_s_m", contact.sliding_viscosity_s_m);
  of_law("friction_coefficient", contact.friction_coefficient);
  of_law("regularisation_m_s", contact.regularisation_m_s);
  of_law("patch_radius_m", contact.patch_radius_m);
  of_law("static_coefficient", contact.static_coefficient);
  codec.sparse("spinning_friction_m", contact.spinning_friction_m);
  codec.sparse("rolling_resistance_m", contact.rolling_resistance_m);
  codec.sparse("regularisation_rad_s", contact.regularisation_rad_s);
  if (codec.takes("tip_velocity_m_s", contact.start == ContactStart::tip_velocity)) {
    codec.key("tip_velocity_m_s", contact.tip_velocity_m_s);
    if constexpr (!Codec::kWrites) contact.start = ContactStart::tip_velocity;
  } else {
    if constexpr (!Codec::kWrites)
      if (contact.law == ContactLaw::rolling) contact.start = ContactStart::rolling;
    codec.word("start", contact.start, kContactStarts);
  }
  codec.key("tip_position_m", contact.tip_position_m);
  codec.key("max_tilt_deg", contact.max_tilt_deg);
  codec.object("table", true, [&](auto& below) {
    below.sparse("tilt_deg", contact.table_tilt_deg);
    below.sparse("tilt_azimuth_deg", contact.table_tilt_azimuth_deg);
  });
}

// -- effects: an effect that is off is left out, so that a scene keeps its identity when new effects are added to the format

template <class Codec, class S>
void air_drag_keys(Codec& codec, S& air) {
  codec.key("disc_radius_m", air.disc_radius_m);
  codec.key("density_kg_m3", air.density_kg_m3);
  codec.key("kinematic_viscosity_m2_s", air.kinematic_viscosity_m2_s);
  codec.word("flow", air.flow, kDiscFlows);
}

template <class Codec, class S>
void gravity_gradient_key(Codec& codec, S& gradient) {
  constexpr std::string_view kKey = "gravity_gradient";
  if (!codec.switched(kKey, gradient)) return;
  if constexpr (!Codec::kWrites)
    gradient->field = codec.is_object(kKey) ? GradientField::given
                      : codec.is_word(kKey) ? GradientField::normal
                                            : GradientField::radial;
  switch (gradient->field) {
    case GradientField::radial: return codec.yes(kKey);
    case GradientField::normal: return codec.literal(kKey, "normal");
    case GradientField::given:
      return codec.object(kKey, true, [&](auto& below) { below.key("gm_over_r3_s2", gradient->gm_over_r3_s2); });
  }
}

/// Describes a tide of given amplitude, or that of Moon and Sun.
template <class Codec, class S>
void tide_key(Codec& codec, S& tide) {
  if (!codec.switched("tide", tide)) return;
  codec.object("tide", true, [&](auto& below) {
    if constexpr (!Codec::kWrites) tide->given = below.takes("amplitude_m_s2", false);
    if (tide->given) {
      below.key("amplitude_m_s2", tide->amplitude_m_s2);
      below.key("frequency_hz", tide->frequency_hz);
      below.key("phase_deg", tide->phase_deg);
    } else {
      below.key("gravimetric_factor", tide->options.gravimetric_factor);
      below.key("tilt_factor", tide->options.tilt_factor);
    }
  });
}

/// Describes the Earth's orientation. If `true` has the pole looked up by the date, the numbers found are written, so that the
/// text holds all values used.
template <class Codec, class S>
void orientation_keys(Codec& codec, S& scenario) {
  auto& pole = scenario.site.pole;
  codec.object("polar_motion", !(pole == PolarMotion{}), [&](auto& below) {
    below.key("x_arcsec", pole.x_arcsec);
    below.key("y_arcsec", pole.y_arcsec);
  });
  auto& deflection = scenario.site.deflection;
  codec.object("deflection_of_vertical", !(deflection == VerticalDeflection{}), [&](auto& below) {
    below.key("north_arcsec", deflection.north_arcsec);
    below.key("east_arcsec", deflection.east_arcsec);
  });
  codec.sparse("excess_length_of_day_ms", scenario.excess_length_of_day_ms);
}

/// Describes an unequal support, by its stiffness or by the periods of a pendulum.
template <class Codec, class S>
void unequal_support_keys(Codec& codec, S& support) {
  if (codec.takes("periods_s", support.periods_s.has_value()))
    codec.key("periods_s", support.periods_s);
  else
    codec.key("kappa_N_m", support.kappa_N_m);
  codec.key("azimuth_deg", support.azimuth_deg);
}

/// Describes a given torque. The keys of a course are written with that course only.
template <class Codec, class S>
void given_torque_keys(Codec& codec, S& given) {
  codec.word("axes", given.axes, kTorqueAxes);
  codec.word("course", given.course, kTorqueCourses);
  const auto of_course = [&](std::string_view key, auto& member) {
    if (!Codec::kWrites || input::lists(row_of(kTorqueCourses, given.course).allowed, key)) codec.key(key, member);
  };
  of_course("torque_N_m", given.torque_N_m);
  of_course("frequency_hz", given.frequency_hz);
  of_course("phase_deg", given.phase_deg);
  of_course("file", given.components[0].file);
  of_course("file_sha256", given.components[0].file_sha256);  // represents the table in the run's identity
}

template <class Codec, class S>
void torque_keys(Codec& codec, S& effects) {
  codec.key("coriolis", effects.coriolis);
  codec.key("centrifugal", effects.centrifugal);
  codec.key("transverse", effects.transverse);
  auto& applied = effects.applied;
  if (codec.takes_array("viscous_torque_N_m_s", applied.viscous_by_axis_N_m_s.has_value()))
    codec.key("viscous_torque_N_m_s", applied.viscous_by_axis_N_m_s);
  else
    codec.sparse("viscous_torque_N_m_s", applied.viscous_N_m_s);
  codec.sparse("quadratic_torque_N_m_s2", applied.quadratic_N_m_s2);
  codec.sparse("coulomb_torque_N_m", applied.coulomb_N_m);
  if (codec.switched("air_drag", applied.air_drag))
    codec.object("air_drag", true, [&](auto& below) { air_drag_keys(below, *applied.air_drag); });
  gravity_gradient_key(codec, applied.gravity_gradient);
  if (codec.switched("gimbal", applied.gimbal))
    codec.object("gimbal", true, [&](auto& below) { below.key("damping_N_m_s", applied.gimbal->damping_N_m_s); });
  if (codec.switched("unequal_support", applied.unequal_support))
    codec.object("unequal_support", true, [&](auto& below) { unequal_support_keys(below, *applied.unequal_support); });
  if (codec.switched("given_torque", applied.given_torque))
    codec.object("given_torque", true, [&](auto& below) { given_torque_keys(below, *applied.given_torque); });
  if (codec.switched("air_force", applied.air_force))
    codec.object("air_force", true, [&](auto& below) {
      below.key("linear_N_s_m", applied.air_force->linear_N_s_m);
      below.key("quadratic_N_s2_m2", applied.air_force->quadratic_N_s2_m2);
    });
  if (codec.takes("select", effects.automatic)) {
    codec.literal("select", "auto");
    if constexpr (!Codec::kWrites) effects.automatic = true;
  }
}

// -- numerics

/// Describes the numerics. A given step replaces the tolerance, from which a step would be found; a closed form has neither.
template <class Codec, class S>
void numerics_keys(Codec& codec, S& scenario) {
  auto& options = scenario.numerics;
  codec.named("method", options.method);
  codec.named("observer", options.observer);
  codec.named("model", options.form);
  codec.named("precision", scenario.precision);
  if (!Codec::kWrites || (!options.step_s && !is_exact(options.method)))
    codec.key("relative_tolerance", options.relative_tolerance);
  codec.key("step_s", options.step_s);
  if (!Codec::kWrites || options.composition != Composition::automatic) codec.named("composition", options.composition);
  codec.named("ledger", scenario.ledger);
}

// -- what the run has to report, and what is known about it

/// Describes the reports. Standard errors of the inputs imply that the derivatives are computed.
template <class Codec, class S>
void report_keys(Codec& codec, S& scenario) {
  codec.key("threshold_rad", scenario.threshold_rad);
  codec.key("until_spin_rad_s", scenario.reported_spin_rad_s);
  codec.key("until_tilt_deg", scenario.reported_tilt_deg);
  if (!Codec::kWrites || !scenario.uncertainty) codec.sparse("sensitivities", scenario.sensitivities);
}

/// Describes the standard errors. Those of inputs that not every scenario has are left out where they are 0.
template <class Codec, class S>
void uncertainty_keys(Codec& codec, S& standard_errors) {
  for (std::size_t i = 0; i < kInputCount; ++i) {
    if (i < kCommonInputs)
      codec.key(kInputNames[i], standard_errors[i]);
    else
      codec.sparse(kInputNames[i], standard_errors[i]);
  }
}

template <class Codec, class S>
void headline_keys(Codec& codec, S& headline) {
  codec.key("quantity", headline.quantity);
  codec.key("at_s", headline.at_s);
  codec.key("value", headline.value);
  codec.key("tolerance", headline.tolerance);
  codec.key("origin", headline.origin);
}

template <class Codec, class S>
void criterion_keys(Codec& codec, S& criterion) {
  codec.word("kind", criterion.kind, kCriterionRules);
  codec.sparse("quantity", criterion.quantity);
  codec.sparse("set", criterion.set);
  codec.sparse("values", criterion.values);
  codec.key("at_s", criterion.at_s);
  codec.key("until_s", criterion.until_s);
  codec.key("tolerance", criterion.tolerance);
  codec.key("why", criterion.why);
  codec.sparse("slow", criterion.slow);
}

template <class Codec, class S>
void description_keys(Codec& codec, S& scenario) {
  codec.key("name", scenario.name);
  codec.sparse("title", scenario.title);
  codec.sparse("purpose", scenario.purpose);
}

}  // namespace earthtop::scenario
