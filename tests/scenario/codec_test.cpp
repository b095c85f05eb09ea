// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of the table of fields, set to a legal value that is not its default: it must come back from the canonical text,
// and change the identity of the run unless it only describes the scenario. A key that the table has and the codec lacks fails.
#include <fmt/core.h>

#include <fstream>
#include <map>

#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "scenario/fields.hpp"
#include "support.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::scenario_test {
namespace {

using input::Field, input::FieldKind;

/// The way in which the test sets one key: the overrides that the key needs beside it (`base`), and its value where the one
/// made up for its kind would not be legal (else empty).
struct Setting {
  Overrides base;
  std::string value = "";
  Overrides instead = {};           ///< overrides made instead of it, where the key cannot be changed alone
  bool has_one_value_only = false;  ///< the key may be given, but says nothing new
};

const std::string kStart = "2026-11-22T12:00:00Z";
constexpr const char* kHarmonic = R"({"motion": "harmonic", "amplitude_rad": 0.1, "frequency_hz": 1})";
constexpr const char* kTurnsAsMeasured =
    R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "drive": "table", "file": "one_rates.csv"})";
constexpr const char* kRubbingRotor =
    R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "viscous_torque_N_m_s": 1, "coulomb_torque_N_m": 1,
    "regularisation_rad_s": 1})";
constexpr const char* kFixedMass = R"([{"mass_kg": 1, "motion": "fixed", "center_m": [0, 0, 0.1]}])";
constexpr const char* kSwingingMass =
    R"([{"mass_kg": 1, "motion": "harmonic", "center_m": [0, 0, 0.1], "amplitude_m": [0.1, 0, 0], "frequency_hz": 1}])";
constexpr const char* kCirclingMass =
    R"([{"mass_kg": 1, "motion": "circle", "center_m": [0, 0, 0.1], "start_m": [0.1, 0, 0], "axis": [0, 0, 1], "frequency_hz": 1}])";
constexpr const char* kMassOnWaypoints =
    R"([{"mass_kg": 1, "motion": "waypoints", "times_s": [0, 1], "points_m": [[0, 0, 0.1], [0.1, 0, 0]]}])";
constexpr const char* kMassAsMeasured = R"([{"mass_kg": 1, "motion": "table", "file": "one_places.csv"}])";
constexpr const char* kSails = R"({"path": "rhumb", "course_deg": 30, "speed_m_s": 10, "legs": [{"duration_s": 9}]})";
constexpr const char* kSailsASphere = R"({"path": "rhumb", "course_deg": 30, "speed_m_s": 10, "figure": "sphere"})";
constexpr const char* kSailsAsMeasured = R"({"path": "table", "file": "one_voyage.csv"})";
constexpr const char* kInGimbals = R"({"outer_angle_deg": 20, "inner_angle_deg": 60})";
constexpr const char* kGimbals =
    R"({"outer": {"mass_kg": 1, "inertia": {"principal_kg_m2": [1, 1, 1]}, "viscous_torque_N_m_s": 1,
    "coulomb_torque_N_m": 1, "regularisation_rad_s": 1, "torsion_N_m_rad": 1}, "inner": {"viscous_torque_N_m_s": 1,
    "coulomb_torque_N_m": 1, "regularisation_rad_s": 1, "torsion_N_m_rad": 1}})";
constexpr const char* kGimbalsByMatrix =
    R"({"outer": {"mass_kg": 1, "inertia": {"matrix_kg_m2": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}})";
constexpr const char* kConstantTorque = R"({"axes": "body", "torque_N_m": [1e-6, 2e-6, 3e-6]})";
constexpr const char* kHarmonicTorque =
    R"({"axes": "body", "course": "harmonic", "torque_N_m": [1e-6, 2e-6, 3e-6], "frequency_hz": 1})";
constexpr const char* kTorqueAsMeasured = R"({"axes": "body", "course": "table", "file": "one_torques.csv"})";
constexpr const char* kRolls = R"({"tip_radius_m": 0.002, "law": "frictionless", "spinning_friction_m": 1e-5,
    "rolling_resistance_m": 1e-5, "regularisation_rad_s": 0.1})";

/// The settings by the beginning of a key's pointer pattern. The longest beginning in the table that fits a key counts.
const std::map<std::string, Setting>& settings() {
  static const auto* all = new std::map<std::string, Setting>{
      {"", {}},
      {"/$schema", {{}, "\"earthtop-scenario-1.json\"", {}, true}},
      {"/headline", {{{"/headline", R"({"quantity": "drift_axis_rad", "value": 1, "tolerance": 1, "origin": ""})"}}}},
      {"/criteria",
       {{{"/criteria", R"([{"kind": "value", "quantity": "drift_axis_rad", "values": [1], "tolerance": 1, "why": ""}])"}}}},
      {"/criteria/*/kind",
       {{{"/criteria", R"([{"kind": "order", "quantity": "convergence", "tolerance": 1, "why": ""}])"}},
        "",
        {{"/criteria", R"([{"kind": "exactly_zero", "quantity": "drift", "why": ""}])"}}}},
      {"/criteria/*/until_s",
       {{{"/criteria", R"([{"kind": "closed_form", "quantity": "reference", "tolerance": 1, "why": ""}])"}}}},
      {"/body/mass_kg", {{}, "0.11"}},
      {"/body/center_of_mass_m", {{}, "[0, 0, 0.02]"}},
      {"/body/inertia/principal_kg_m2", {{}, "[3e-4, 3e-4, 4e-5]"}},
      {"/body/inertia/matrix_kg_m2",
       {{{"/body/inertia", R"({"matrix_kg_m2": [[2e-4, 0, 0], [0, 2e-4, 0], [0, 0, 4e-5]]})"}},
        "[[2e-4, 1e-6, 0], [1e-6, 2e-4, 0], [0, 0, 4e-5]]"}},
      {"/body/solids", {{{"/body", R"({"solids": [{"shape": "cylinder", "radius_m": 0.1, "length_m": 0.2, "mass_kg": 1}]})"}}}},
      {"/body/solids/*/inner_radius_m",
       {{{"/body", R"({"solids": [{"shape": "ring", "radius_m": 0.5, "inner_radius_m": 0, "mass_kg": 1}]})"}}}},
      {"/body/solids/*/density_kg_m3",
       {{{"/body", R"({"solids": [{"shape": "sphere", "radius_m": 0.5, "density_kg_m3": 1000}]})"}}}},
      {"/release/quaternion_LB",
       {{{"/release", R"({"quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "spin_rad_s": 200})"}}, "0.001"}},
      {"/release/quaternion_LB/w",
       {{{"/release", R"({"quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "spin_rad_s": 200})"}}, "0.9999995"}},
      {"/release/angular_velocity_body_rad_s",
       {{{"/release", R"({"tilt_deg": 20, "angular_velocity_body_rad_s": [1, 2, 3]})"}}}},
      {"/release/precession/rate_rad_s", {{{"/release/precession", R"({"rate_rad_s": 1})"}}}},
      {"/motion/start_utc", {{}, "\"" + kStart + "\""}},
      {"/gimbals", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/gimbals/outer/axis_tilt_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "10"}},
      {"/gimbals/outer/inertia/principal_kg_m2", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "[1, 1, 1.5]"}},
      {"/gimbals/outer/inertia/matrix_kg_m2",
       {{{"/gimbals", kGimbalsByMatrix}, {"/release", kInGimbals}}, "[[1, 0, 0], [0, 1, 0], [0, 0, 1.5]]"}},
      {"/gimbals/outer/center_of_mass_m", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "[0, 0, 0.1]"}},
      {"/gimbals/outer/locked", {{{"/gimbals", "{}"}, {"/release", kInGimbals}}, "true"}},
      {"/gimbals/inner/locked", {{{"/gimbals", "{}"}, {"/release", kInGimbals}}, "true"}},
      {"/gimbals/inner/axis_skew_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "10"}},
      {"/release/outer_angle_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "30"}},
      {"/release/inner_angle_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "30"}},
      {"/release/outer_rate_rad_s", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "1"}},
      {"/release/inner_rate_rad_s", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}, "1"}},
      {"/rotor/mass_kg", {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "2"}},
      {"/rotor/axial_kg_m2",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "0.5"}},
      {"/rotor/transverse_kg_m2",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "2"}},
      {"/rotor/axis",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "[0, 1, 1]"}},
      {"/rotor/center_m",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "[0, 0, 1]"}},
      {"/rotor/spin_rad_s", {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "3"}},
      {"/rotor/spin_rpm",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}},
        "",
        {{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rpm": 7})"}}}},
      {"/rotor/drive",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "\"constant\""}},
      {"/rotor/acceleration_rad_s2",
       {{{"/rotor",
          R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "drive": "ramp", "acceleration_rad_s2": 1})"}},
        "2"}},
      {"/rotor/amplitude_rad_s",
       {{{"/rotor",
          R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "drive": "harmonic", "amplitude_rad_s": 1, "frequency_hz": 1})"}},
        "2"}},
      {"/rotor/frequency_hz",
       {{{"/rotor",
          R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "drive": "harmonic", "amplitude_rad_s": 1, "frequency_hz": 1})"}},
        "2"}},
      {"/rotor/phase_deg",
       {{{"/rotor",
          R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "drive": "harmonic", "amplitude_rad_s": 1, "frequency_hz": 1})"}},
        "2"}},
      {"/rotor/viscous_torque_N_m_s",
       {{{"/rotor", R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1})"}}, "0.5"}},
      {"/rotor/coulomb_torque_N_m",
       {{{"/rotor",
          R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "coulomb_torque_N_m": 1, "regularisation_rad_s": 1})"}},
        "0.5"}},
      {"/rotor/regularisation_rad_s",
       {{{"/rotor",
          R"({"mass_kg": 1, "axial_kg_m2": 1, "transverse_kg_m2": 1, "spin_rad_s": 1, "coulomb_torque_N_m": 1, "regularisation_rad_s": 1})"}},
        "0.5"}},
      {"/rotor/file", {{{"/rotor", kTurnsAsMeasured}}, "\"other_rates.csv\""}},
      {"/rotor/file_sha256", {{{"/rotor", kTurnsAsMeasured}}, "SHA256 OF ONE", {}, true}},
      {"/moving_masses/*/mass_kg", {{{"/moving_masses", kFixedMass}}, "2"}},
      {"/moving_masses/*/carrier", {{{"/moving_masses", kFixedMass}}, "\"body\"", {}, true}},
      {"/moving_masses/*/motion", {{{"/moving_masses", kFixedMass}}, "", {{"/moving_masses", kSwingingMass}}}},
      {"/moving_masses/*/center_m", {{{"/moving_masses", kFixedMass}}, "[0, 0.1, 0.1]"}},
      {"/moving_masses/*/amplitude_m", {{{"/moving_masses", kSwingingMass}}, "[0.1, 0.1, 0]"}},
      {"/moving_masses/*/frequency_hz", {{{"/moving_masses", kSwingingMass}}, "2"}},
      {"/moving_masses/*/phase_deg", {{{"/moving_masses", kSwingingMass}}, "10"}},
      {"/moving_masses/*/start_m", {{{"/moving_masses", kCirclingMass}}, "[0.1, 0.1, 0]"}},
      {"/moving_masses/*/axis", {{{"/moving_masses", kCirclingMass}}, "[0, 0.1, 1]"}},
      {"/moving_masses/*/times_s", {{{"/moving_masses", kMassOnWaypoints}}, "[0.5, 1]"}},
      {"/moving_masses/*/points_m", {{{"/moving_masses", kMassOnWaypoints}}, "[[0, 0, 0.1], [0.1, 0.1, 0]]"}},
      {"/moving_masses/*/file", {{{"/moving_masses", kMassAsMeasured}}, "\"other_places.csv\""}},
      {"/moving_masses/*/file_sha256", {{{"/moving_masses", kMassAsMeasured}}, "SHA256 OF ONE", {}, true}},
      {"/travel", {{{"/travel", kSails}}}},
      {"/travel/path", {{{"/travel", kSails}}, "\"geodesic\""}},
      {"/travel/speed_kn",
       {{{"/travel", kSails}}, "", {{"/travel", R"({"path": "rhumb", "course_deg": 30, "speed_kn": 10})"}}}},
      {"/travel/legs/*/speed_kn",
       {{{"/travel", kSails}},
        "",
        {{"/travel", R"({"path": "rhumb", "course_deg": 30, "speed_m_s": 10, "legs": [{"duration_s": 9, "speed_kn": 10}]})"}}}},
      {"/travel/file", {{{"/site", "{}"}, {"/travel", kSailsAsMeasured}}, "\"other_voyage.csv\""}},
      {"/travel/file_sha256", {{{"/site", "{}"}, {"/travel", kSailsAsMeasured}}, "SHA256 OF ONE", {}, true}},
      {"/travel/radius_m", {{{"/travel", kSailsASphere}}, "6.4e6"}},
      {"/platform", {{{"/platform", R"({"motion": "constant", "rate_rad_s": 1})"}}}},
      {"/platform/motion",
       {{{"/platform", R"({"motion": "constant", "rate_rad_s": 1})"}},
        "",
        {{"/platform", R"({"motion": "ramp", "acceleration_rad_s2": 1})"}}}},
      {"/platform/acceleration_rad_s2", {{{"/platform", R"({"motion": "ramp", "acceleration_rad_s2": 1})"}}}},
      {"/platform/amplitude_rad", {{{"/platform", R"({"motion": "harmonic", "amplitude_rad": 1, "frequency_hz": 1})"}}}},
      {"/platform/frequency_hz", {{{"/platform", R"({"motion": "harmonic", "amplitude_rad": 1, "frequency_hz": 1})"}}}},
      {"/platform/phase_deg", {{{"/platform", R"({"motion": "harmonic", "amplitude_rad": 1, "frequency_hz": 1})"}}}},
      {"/platform/file", {{{"/platform", R"({"motion": "table", "file": "one.csv"})"}}, "\"other.csv\""}},
      {"/platform/file_sha256", {{{"/platform", R"({"motion": "table", "file": "one.csv"})"}}, "SHA256 OF ONE", {}, true}},
      {"/contact", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}}},
      {"/contact/tip_radius_m", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}, "0.003"}},
      {"/contact/law",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}},
        "",
        {{"/contact", R"({"tip_radius_m": 0.002, "law": "rolling"})"}}}},
      {"/contact/sliding_viscosity_N_s_m",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.01})"}}}},
      {"/contact/sliding_viscosity_s_m",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "viscous_load", "sliding_viscosity_s_m": 0.01})"}}}},
      {"/contact/friction_coefficient",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.1})"}}}},
      {"/contact/regularisation_m_s",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.1})"}}}},
      {"/contact/patch_radius_m",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "contensou", "friction_coefficient": 0.1, "patch_radius_m": 1e-4})"}},
        "2e-4"}},
      {"/contact/static_coefficient", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "rolling"})"}}}},
      {"/contact/spinning_friction_m",
       {{{"/contact",
          R"({"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.01, "rolling_resistance_m": 1e-5,
             "regularisation_rad_s": 0.1})"}},
        "1e-5"}},
      {"/contact/rolling_resistance_m",
       {{{"/contact",
          R"({"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.01, "spinning_friction_m": 1e-5,
             "regularisation_rad_s": 0.1})"}},
        "1e-5"}},
      {"/contact/regularisation_rad_s",
       {{{"/contact",
          R"({"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.01, "spinning_friction_m": 1e-5,
             "regularisation_rad_s": 0.1})"}}}},
      {"/contact/start", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}, "\"rolling\""}},
      {"/contact/tip_velocity_m_s", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}, "[0.1, -0.2]"}},
      {"/contact/max_tilt_deg", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}, "75"}},
      {"/effects", {{{"/accuracy/drift_rad", "1e-3"}}}},
      {"/effects/gravity_gradient/gm_over_r3_s2", {{{"/effects/gravity_gradient", R"({"gm_over_r3_s2": 1})"}}}},
      {"/effects/tide", {{{"/motion/start_utc", kStart}}}},
      {"/effects/tide/gravimetric_factor", {{{"/motion/start_utc", kStart}, {"/effects/tide", "{}"}}}},
      {"/effects/tide/tilt_factor", {{{"/motion/start_utc", kStart}, {"/effects/tide", "{}"}}}},
      {"/effects/tide/amplitude_m_s2", {{{"/effects/tide", R"({"amplitude_m_s2": [1, 0, 0], "frequency_hz": 1})"}}}},
      {"/effects/tide/frequency_hz", {{{"/effects/tide", R"({"amplitude_m_s2": [1, 0, 0], "frequency_hz": 1})"}}}},
      {"/effects/tide/phase_deg", {{{"/effects/tide", R"({"amplitude_m_s2": [1, 0, 0], "frequency_hz": 1})"}}}},
      {"/effects/polar_motion", {{{"/motion/start_utc", kStart}}}},
      {"/effects/polar_motion/x_arcsec", {{{"/effects/polar_motion", R"({"x_arcsec": 0, "y_arcsec": 0})"}}}},
      {"/effects/polar_motion/y_arcsec", {{{"/effects/polar_motion", R"({"x_arcsec": 0, "y_arcsec": 0})"}}}},
      {"/effects/viscous_torque_N_m_s", {{}, "1e-6"}},
      {"/effects/quadratic_torque_N_m_s2", {{}, "1e-9"}},
      {"/effects/unequal_support/kappa_N_m", {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}}}},
      {"/effects/unequal_support/periods_s", {{{"/effects/unequal_support", R"({"periods_s": [1, 2]})"}}}},
      {"/effects/unequal_support/azimuth_deg", {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}}}},
      {"/effects/unequal_support", {{}, R"({"kappa_N_m": 1})"}},
      {"/effects/given_torque", {{}, kConstantTorque}},
      {"/effects/given_torque/axes", {{{"/effects/given_torque", kConstantTorque}}, "\"laboratory\""}},
      {"/effects/given_torque/course",
       {{{"/effects/given_torque", kConstantTorque}}, "", {{"/effects/given_torque", kHarmonicTorque}}}},
      {"/effects/given_torque/torque_N_m", {{{"/effects/given_torque", kConstantTorque}}}},
      {"/effects/given_torque/frequency_hz", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/effects/given_torque/phase_deg", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/effects/given_torque/file", {{{"/effects/given_torque", kTorqueAsMeasured}}, "\"other_torques.csv\""}},
      {"/effects/given_torque/file_sha256", {{{"/effects/given_torque", kTorqueAsMeasured}}, "SHA256 OF ONE", {}, true}},
      {"/effects/air_force", {{{"/contact", kRolls}}, R"({"linear_N_s_m": 0.1})"}},
      {"/effects/air_force/linear_N_s_m", {{{"/contact", kRolls}, {"/effects/air_force", R"({"quadratic_N_s2_m2": 0.1})"}}}},
      {"/effects/air_force/quadratic_N_s2_m2", {{{"/contact", kRolls}, {"/effects/air_force", R"({"linear_N_s_m": 0.1})"}}}},
      {"/effects/coulomb_torque_N_m", {{}, "1e-6"}},
      {"/effects/air_drag", {{{"/effects/air_drag", R"({"disc_radius_m": 0.02})"}}}},
      {"/effects/air_drag/disc_radius_m", {{{"/effects/air_drag", R"({"disc_radius_m": 0.02})"}}, "0.03"}},
      {"/effects/gimbal", {{{"/release/tilt_deg", "90"}}}},
      {"/effects/gimbal/damping_N_m_s", {{{"/release/tilt_deg", "90"}, {"/effects/gimbal", "{}"}}, "1e-6"}},
      {"/numerics/step_s", {{{"/numerics/method", "gauss"}}, "1e-3"}},
      {"/numerics/composition", {{{"/numerics/method", "splitting"}}}},
      {"/uncertainty/travel_speed_m_s", {{{"/travel", kSails}}}},
      {"/uncertainty/travel_course_deg", {{{"/travel", kSails}}}},
      {"/uncertainty/viscous_torque_N_m_s", {{{"/effects/viscous_torque_N_m_s", "1e-6"}}}},
      {"/uncertainty/viscous_torque_1_N_m_s", {{{"/effects/viscous_torque_N_m_s", "[1e-6, 2e-6, 3e-6]"}}}},
      {"/uncertainty/viscous_torque_2_N_m_s", {{{"/effects/viscous_torque_N_m_s", "[1e-6, 2e-6, 3e-6]"}}}},
      {"/uncertainty/viscous_torque_3_N_m_s", {{{"/effects/viscous_torque_N_m_s", "[1e-6, 2e-6, 3e-6]"}}}},
      {"/uncertainty/support_kappa_N_m", {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}}}},
      {"/uncertainty/support_azimuth_deg", {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}}}},
      {"/uncertainty/given_torque_1_N_m", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/uncertainty/given_torque_2_N_m", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/uncertainty/given_torque_3_N_m", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/uncertainty/given_torque_frequency_hz", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/uncertainty/given_torque_phase_deg", {{{"/effects/given_torque", kHarmonicTorque}}}},
      {"/uncertainty/air_force_linear_N_s_m",
       {{{"/contact", kRolls}, {"/effects/air_force", R"({"linear_N_s_m": 0.1, "quadratic_N_s2_m2": 0.1})"}}}},
      {"/uncertainty/air_force_quadratic_N_s2_m2",
       {{{"/contact", kRolls}, {"/effects/air_force", R"({"linear_N_s_m": 0.1, "quadratic_N_s2_m2": 0.1})"}}}},
      {"/uncertainty/quadratic_torque_N_m_s2", {{{"/effects/quadratic_torque_N_m_s2", "1e-9"}}}},
      {"/uncertainty/coulomb_torque_N_m", {{{"/effects/coulomb_torque_N_m", "1e-6"}}}},
      {"/uncertainty/disc_radius_m", {{{"/effects/air_drag", R"({"disc_radius_m": 0.02})"}}}},
      {"/uncertainty/air_density_kg_m3", {{{"/effects/air_drag", R"({"disc_radius_m": 0.02})"}}}},
      {"/uncertainty/air_viscosity_m2_s", {{{"/effects/air_drag", R"({"disc_radius_m": 0.02})"}}}},
      {"/uncertainty/gimbal_damping_N_m_s", {{{"/release/tilt_deg", "90"}, {"/effects/gimbal", R"({"damping_N_m_s": 1e-6})"}}}},
      {"/uncertainty/outer_angle_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/inner_angle_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_rate_rad_s", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/inner_rate_rad_s", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_torsion_N_m_rad", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/inner_torsion_N_m_rad", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_torsion_rest_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/inner_torsion_rest_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_viscous_torque_N_m_s", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/inner_viscous_torque_N_m_s", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_coulomb_torque_N_m", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/inner_coulomb_torque_N_m", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/axis_skew_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_axis_tilt_deg", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/outer_axial_kg_m2", {{{"/gimbals", kGimbals}, {"/release", kInGimbals}}}},
      {"/uncertainty/platform_rate_rad_s", {{{"/platform", R"({"motion": "constant", "rate_rad_s": 0})"}}}},
      {"/uncertainty/platform_acceleration_rad_s2", {{{"/platform", R"({"motion": "ramp", "acceleration_rad_s2": 1})"}}}},
      {"/uncertainty/platform_amplitude_rad", {{{"/platform", kHarmonic}}}},
      {"/uncertainty/platform_frequency_hz", {{{"/platform", kHarmonic}}}},
      {"/uncertainty/platform_phase_deg", {{{"/platform", kHarmonic}}}},
      {"/uncertainty/pivot_offset_m",
       {{{"/platform", R"({"motion": "constant", "rate_rad_s": 1, "pivot_offset_m": [0, 0.1, 0]})"}}}},
      {"/uncertainty/tip_radius_m", {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}}},
      {"/uncertainty/sliding_viscosity_N_s_m",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.05})"}}}},
      {"/uncertainty/sliding_viscosity_s_m",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "viscous_load", "sliding_viscosity_s_m": 0.3})"}}}},
      {"/uncertainty/friction_coefficient",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.2})"}}}},
      {"/uncertainty/patch_radius_m",
       {{{"/contact", R"({"tip_radius_m": 0.002, "law": "contensou", "friction_coefficient": 0.2, "patch_radius_m": 1e-4})"}}}},
      {"/uncertainty/spinning_friction_m", {{{"/contact", kRolls}}}},
      {"/uncertainty/rotor_spin_rad_s", {{{"/rotor", kRubbingRotor}}}},
      {"/uncertainty/rotor_axial_kg_m2", {{{"/rotor", kRubbingRotor}}}},
      {"/uncertainty/rotor_transverse_kg_m2", {{{"/rotor", kRubbingRotor}}}},
      {"/uncertainty/rotor_viscous_torque_N_m_s", {{{"/rotor", kRubbingRotor}}}},
      {"/uncertainty/rotor_coulomb_torque_N_m", {{{"/rotor", kRubbingRotor}}}},
      {"/uncertainty/rolling_resistance_m", {{{"/contact", kRolls}}}},
  };
  return *all;
}

const Setting& setting_of(std::string pattern) {
  while (!settings().contains(pattern)) pattern.resize(pattern.rfind('/'));
  return settings().at(pattern);
}

/// A legal value of the field's kind that is not its default, as JSON.
std::string made_up(const Field& field) {
  switch (field.kind) {
    case FieldKind::text: return "\"another text\"";
    case FieldKind::name: return "\"another-name\"";
    case FieldKind::flag: return field.fallback == "true" ? "false" : "true";
    case FieldKind::flag_or_object: return "true";
    case FieldKind::word:
    case FieldKind::object_or_word:
      for (const std::string_view word : input::split_words(field.words))
        if (fmt::format("\"{}\"", word) != field.fallback) return fmt::format("\"{}\"", word);
      return "";
    case FieldKind::number:
      for (const double value : {0.25, 2e-3, -0.5})
        if (field.range.contains(value) && fmt::format("{}", value) != field.fallback) return fmt::format("{}", value);
      return "";
    case FieldKind::number_or_vector3: return "[0.1, 0.2, 0.3]";
    case FieldKind::vector2: return "[0.1, 0.2]";
    case FieldKind::vector3: return "[0.1, 0.2, 0.3]";
    case FieldKind::numbers:
    case FieldKind::series: return "[0.25]";
    case FieldKind::points: return "[[0.1, 0.2, 0.3]]";
    case FieldKind::changes: return "[\"/motion/duration_s=2\"]";
    default: return "";
  }
}

class Codec : public ::testing::Test {
 protected:
  Codec() {
    for (const auto& [prefix, last] : {std::pair("one", "0.3"), std::pair("other", "0.4")})
      for (const auto& [name, header] : {std::pair(".csv", "t_s,angle_rad"), std::pair("_rates.csv", "t_s,rate_rad_s")})
        std::ofstream(temporary_.path() / (std::string(prefix) + name))
            << header << "\n0,0\n20,0.1\n40,0.2\n60," << last << "\n";
    for (const auto& [prefix, last] : {std::pair("one", "0.3"), std::pair("other", "0.4")})
      for (const auto& [name, header] :
           {std::pair("_places.csv", "t_s,x_m,y_m,z_m"), std::pair("_torques.csv", "t_s,x_N_m,y_N_m,z_N_m"),
            std::pair("_voyage.csv", "t_s,latitude_deg,longitude_deg,height_m")})
        std::ofstream(temporary_.path() / (std::string(prefix) + name))
            << header << "\n0,0,0,0.1\n20,0.1,0,0.1\n40,0.2,0,0.1\n60," << last << ",0,0.1\n";
  }
  Scenario decoded(const std::string& text, const Overrides& overrides = {}) const {
    return parse_scenario({(temporary_.path() / "minimal.json").string(), text}, overrides);
  }
  testing::TemporaryDirectory temporary_;
};

bool only_describes(const Field& field) {
  for (const std::string_view key : describing_keys())
    if (field.pointer == fmt::format("/{}", key) || field.pointer.starts_with(fmt::format("/{}/", key))) return true;
  return false;
}

TEST_F(Codec, EveryKeyOfTheTableComesBackAndDecidesTheIdentity) {
  int walked = 0;
  for (const Field& field : scenario::fields().fields) {
    if (field.kind == FieldKind::object || field.kind == FieldKind::list) continue;  // what lies below them is walked
    SCOPED_TRACE(std::string(field.pointer));
    const Setting& setting = setting_of(std::string(field.pointer));
    const Scenario base = decoded(kMinimal, setting.base);
    Overrides overrides = setting.base;
    std::string pointer(field.pointer);
    if (const auto star = pointer.find('*'); star != std::string::npos) pointer[star] = '0';
    std::string value = setting.value.empty() ? made_up(field) : setting.value;
    if (value == "SHA256 OF ONE") value = fmt::format("\"{}\"", tables_of(base).front()->file_sha256);
    if (setting.instead.empty())
      overrides.emplace_back(pointer, value);
    else
      overrides.insert(overrides.end(), setting.instead.begin(), setting.instead.end());
    const Scenario scenario = decoded(kMinimal, overrides);
    EXPECT_EQ(scenario == base, setting.has_one_value_only);

    const std::string canonical = canonical_json(scenario);
    const Scenario again = decoded(canonical);
    EXPECT_TRUE(again == scenario) << canonical;
    EXPECT_EQ(canonical_json(again), canonical);
    EXPECT_EQ(resolve(again).sha256(), resolve(scenario).sha256());
    EXPECT_EQ(resolve(scenario).sha256() == resolve(base).sha256(), only_describes(field) || setting.has_one_value_only);
    ++walked;
  }
  EXPECT_GT(walked, 80);
}

TEST_F(Codec, WhatIsLeftOutOfTheIdentityIsReadBack) {
  const Scenario scenario = decoded(kMinimal, {{"/title", "a title"}, {"/purpose", "a purpose"}});
  EXPECT_EQ(identity_json(scenario), identity_json(decoded(kMinimal)));
  EXPECT_EQ(decoded(canonical_json(scenario)).purpose, "a purpose");
}

/// Solids, an attitude by quaternion, and platforms: variants that a walk of single keys does not reach.
TEST_F(Codec, VariantsComeBack) {
  const Overrides variants = {
      {"/body", R"({"solids": [{"shape": "ring", "radius_m": 0.1, "inner_radius_m": 0, "mass_kg": 1, "at_m": -0.1},
                               {"shape": "rod", "length_m": 0.1, "mass_kg": 0.1},
                               {"shape": "sphere", "radius_m": 0.1, "density_kg_m3": 1000},
                               {"shape": "cone", "radius_m": 0.1, "length_m": 0.2, "density_kg_m3": 1000}]})"},
      {"/release", R"({"quaternion_LB": {"w": 0.6, "x": 0, "y": 0.8, "z": 0}, "angular_velocity_body_rad_s": [1, 2, 3]})"},
      {"/platform", R"({"motion": "ramp", "acceleration_rad_s2": 1e-3, "pivot_offset_m": [1, 2, 3]})"},
      {"/effects/gravity_gradient", "normal"},
      {"/numerics", R"({"method": "abm8", "step_s": 1e-3})"},
      {"/numerics", R"({"precision": "float128"})"}};
  for (const auto& variant : variants) {
    const Scenario scenario = decoded(kMinimal, {variant});
    EXPECT_TRUE(decoded(canonical_json(scenario)) == scenario) << variant.first;
    EXPECT_NE(identity_json(scenario), identity_json(decoded(kMinimal))) << variant.first;
  }
  const Scenario exact = decoded(kMinimal, {{"/earth/rotation_rate_rad_s", "0"}, {"/numerics/method", "closed_form"}});
  EXPECT_TRUE(decoded(canonical_json(exact)) == exact);
}

/// Numbers that are computed from what was given: the canonical text must not give them twice, nor lose them.
TEST_F(Codec, TheCanonicalTextRunsToTheSameNumbers) {
  const std::vector<Overrides> scenes = {{{"/effects/excess_length_of_day_ms", "900"}},
                                         {{"/site/gravity_anomaly_m_s2", "0.05"}, {"/site/height_m", "1000"}},
                                         {{"/effects/polar_motion", "true"}, {"/motion/start_utc", kStart}},
                                         {{"/effects/tide", R"({"tilt_factor": 0.7})"}, {"/motion/start_utc", kStart}}};
  const std::string plain = summary_json(run(decoded(kMinimal, {{"/motion/duration_s", "1"}})));
  for (Overrides scene : scenes) {
    scene.emplace_back("/motion/duration_s", "1");
    const Scenario scenario = decoded(kMinimal, scene);
    const std::string summary = summary_json(run(scenario));
    EXPECT_EQ(summary_json(run(decoded(canonical_json(scenario)))), summary) << scene.front().first;
    EXPECT_NE(summary.substr(0, summary.find("\"scenario\"")), plain.substr(0, plain.find("\"scenario\""))) << scene[0].first;
  }
}

}  // namespace
}  // namespace earthtop::scenario_test
