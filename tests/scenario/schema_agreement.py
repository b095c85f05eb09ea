#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that schema and decoder give the same verdict: on the shipped scenarios, on others that together use every key, and
on hundreds of mutations of keys, types, words and ranges. Rules that a schema cannot express are listed below; only the decoder
enforces them.

usage: schema_agreement.py PATH_OF_EARTHTOP SCENARIO_DIRECTORY
"""

import copy
import hashlib
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import jsonschema

SEED = 20120904
MUTANTS = 600

BODY = {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
        "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}}
SCENE = {"name": "scene", "site": {"latitude_deg": 45}, "body": BODY, "release": {"tilt_deg": 20, "spin_rad_s": 200},
         "motion": {"duration_s": 1}}


ANGLES = b"t_s,angle_rad\n0,0\n0.5,0.1\n1,0.1\n2,0\n"  # angles.csv, beside every scene
PLACES = b"t_s,x_m,y_m,z_m\n0,0,0,0.03\n0.5,0.01,0,0.03\n1,0.02,0,0.03\n2,0.01,0,0.03\n"  # places.csv, too
TORQUES = PLACES.replace(b"_m", b"_N_m")  # torques.csv, too
VOYAGE = b"t_s,latitude_deg,longitude_deg,height_m\n0,45,10,5\n0.5,45,10,5\n1,45,10,5\n2,45,10,5\n"  # voyage.csv, too
SAILING = {"path": "rhumb", "course_deg": 30, "speed_m_s": 10}
RATES = b"t_s,rate_rad_s\n0,300\n0.5,310\n1,290\n2,280\n"  # rates.csv, too


SLIDING = {"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.2, "regularisation_m_s": 0.01}
RING = {"mass_kg": 0.15, "inertia": {"principal_kg_m2": [4e-4, 4e-4, 3e-4]}}
IN_GIMBALS = {"outer_angle_deg": 20, "inner_angle_deg": 60}
ROTOR = {"mass_kg": 0.05, "axial_kg_m2": 1.6e-5, "transverse_kg_m2": 8.5e-6}


def scene(**sections):
    return {**copy.deepcopy(SCENE), **copy.deepcopy(sections)}


# Between them these hold every key of the schema.
WHOLE = [
    scene(),
    scene(release={"tilt_deg": 20, "spin_rpm": 1910, "precession": "steady_slow"}),
    scene(**{"$schema": "earthtop-scenario-1.json", "title": "t", "purpose": "p", "_note": 1, "//": [None]},
          site={"latitude_deg": -90, "longitude_deg": 10, "height_m": 100, "gravity_m_s2": 9.8},
          earth={"rotation_rate_rad_s": -1}, report={"threshold_rad": 0.1, "until_spin_rad_s": 1, "until_tilt_deg": 30}, accuracy={},
          headline={"quantity": "drift_axis_rad", "at_s": 0.5, "value": 1, "tolerance": 1e-9, "origin": "somewhere"},
          motion={"duration_s": 1, "output_step_s": 0.1}),
    scene(criteria=[{"kind": "value", "quantity": "q_LB", "values": [1, 0, 0, 0], "at_s": 1, "tolerance": 0, "why": "",
                     "set": ["/motion/duration_s=2", "/title=a=b"], "slow": True},
                    {"kind": "value", "quantity": "drift_axis_rad", "values": [0.5], "tolerance": 1e-9, "why": "known"},
                    {"kind": "invariant", "quantity": "jacobi_integral", "tolerance": 1e-12, "why": ""},
                    {"kind": "closed_form", "quantity": "reference", "until_s": 0.5, "tolerance": 1e-12, "why": ""},
                    {"kind": "equivalence", "quantity": "same", "tolerance": 0, "why": "", "set": ["/name=x"]},
                    {"kind": "exactly_zero", "quantity": "drift", "why": "", "slow": False},
                    {"kind": "order", "quantity": "convergence", "values": [8], "tolerance": 0.5, "why": ""},
                    {"kind": "verdict", "quantity": "chaotic", "values": [1, 9], "why": ""},
                    {"kind": "refused", "set": ["/site/latitude_deg=91"], "why": ""}]),
    scene(site={"gravity_m_s2": 9.8}, earth={"rotation_rate_rad_s": 0},
          headline={"quantity": "drift.axis_max_rad", "value": 0, "tolerance": 1, "origin": ""}),
    scene(body={"solids": [{"shape": "disc", "radius_m": 0.05, "mass_kg": 0.1, "at_m": 0.03},
                           {"shape": "cylinder", "radius_m": 0.01, "length_m": 0.02, "density_kg_m3": 7800, "at_m": 0.01},
                           {"shape": "ring", "radius_m": 0.05, "inner_radius_m": 0.04, "length_m": 0.01, "mass_kg": 0.1},
                           {"shape": "cone", "radius_m": 0.01, "length_m": 0.02, "mass_kg": 0.1, "at_m": 0.01},
                           {"shape": "sphere", "radius_m": 0.02, "inner_radius_m": 0.01, "mass_kg": 0.1, "at_m": 0.02},
                           {"shape": "rod", "length_m": 0.1, "mass_kg": 0.01, "at_m": 0.05}]}),
    scene(release={"quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "angular_velocity_body_rad_s": [1, 2, 30],
                   "rates_relative_to": "inertial"},
          body={"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": {
              "about": "center_of_mass", "matrix_kg_m2": [[1e-4, 0, 0], [0, 1.1e-4, 1e-6], [0, 1e-6, 1.2e-4]]}}),
    scene(release={"tilt_deg": 20, "azimuth_deg": -90, "spin_angle_deg": 10, "spin_rad_s": 200,
                   "precession": {"rate_rad_s": 1}, "rates_relative_to": "laboratory"},
          effects={"coriolis": False, "centrifugal": True, "transverse": False},
          numerics={"method": "rkf78", "observer": "body", "model": "general", "precision": "double", "relative_tolerance": 1e-10,
                    "ledger": "platform"}),
    scene(numerics={"method": "extrapolation", "precision": "float128", "relative_tolerance": 1e-30}),
    scene(numerics={"method": "bulirsch_stoer", "precision": "long_double", "relative_tolerance": 1e-16}),
    scene(release={"tilt_deg": 20, "spin_rad_s": 200, "precession": "steady_slow"},
          numerics={"method": "abm8", "step_s": 1e-3},
          platform={"motion": "constant", "axis": [0, 1, 1], "rate_rad_s": 1, "pivot_offset_m": [1, 0, 0]}),
    scene(site={"latitude_deg": -90}, numerics={"method": "closed_form", "precision": "long_double"}),
    scene(numerics={"method": "splitting", "composition": "aba864", "step_s": 1e-3}),
    scene(report={"sensitivities": True}),
    scene(instrument={"turn_east_deg": 0.1, "turn_east_se_deg": 0.1, "turn_north_deg": 0.1, "turn_north_se_deg": 0.1, "turn_up_deg": 0.1,
                      "turn_up_se_deg": 0.1, "azimuth_zero_deg": 180, "azimuth_zero_se_deg": 1, "azimuth_reversed": True,
                      "tilt_zero_deg": 90, "tilt_zero_se_deg": 1, "tilt_reversed": True, "outer_angle_zero_deg": 1,
                      "outer_angle_zero_se_deg": 1, "outer_angle_reversed": False, "inner_angle_zero_deg": 1,
                      "inner_angle_zero_se_deg": 1, "inner_angle_reversed": False, "rotor_rate_bias_rad_s": 1,
                      "rotor_rate_bias_se_rad_s": 1, "rotor_rate_scale": 2, "rotor_rate_scale_se": 0.1, "spin_bias_rad_s": 1, "spin_bias_se_rad_s": 1, "spin_scale": 2,
                      "spin_scale_se": 0.1, "w_x_bias_rad_s": 1, "w_x_bias_se_rad_s": 1, "w_y_bias_rad_s": 1, "w_y_bias_se_rad_s": 1,
                      "w_z_bias_rad_s": 1, "w_z_bias_se_rad_s": 1, "w_scale": 2, "w_scale_se": 0.1, "time_offset_s": 0.004,
                      "time_offset_se_s": 0.001, "clock_rate": 0.999, "clock_rate_se": 1e-3}),
    scene(uncertainty={"latitude_deg": 0.1, "gravity_m_s2": 1e-5, "spin_rad_s": 0.1, "tilt_deg": 0.1,
                       "rotation_rate_rad_s": 1e-12, "inertia_ratio": 1e-3, "center_of_mass_m": 1e-5}),
    scene(uncertainty={"quadratic_torque_N_m_s2": 1e-10, "disc_radius_m": 1e-4, "air_density_kg_m3": 0.01,
                       "air_viscosity_m2_s": 1e-7, "platform_amplitude_rad": 1e-3, "platform_frequency_hz": 1e-3,
                       "platform_phase_deg": 1},
          effects={"quadratic_torque_N_m_s2": 1e-9, "air_drag": {"disc_radius_m": 0.05}},
          platform={"motion": "harmonic", "amplitude_rad": 0.1, "frequency_hz": 1}),
    scene(uncertainty={"coulomb_torque_N_m": 1e-5}, effects={"coulomb_torque_N_m": 1e-3}),
    scene(uncertainty={"platform_acceleration_rad_s2": 1e-3}, platform={"motion": "ramp", "acceleration_rad_s2": 0.1}),
    scene(uncertainty={"gimbal_damping_N_m_s": 1e-7}, effects={"gimbal": {"damping_N_m_s": 1e-6}},
          release={"tilt_deg": 90, "spin_rad_s": 200}),
    scene(uncertainty={"tip_radius_m": 1e-5, "sliding_viscosity_N_s_m": 1e-3},
          contact={"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.05}),
    scene(uncertainty={"sliding_viscosity_s_m": 1e-3},
          contact={"tip_radius_m": 0.002, "law": "viscous_load", "sliding_viscosity_s_m": 0.3}),
    scene(uncertainty={"friction_coefficient": 0.01, "patch_radius_m": 1e-6, "spinning_friction_m": 1e-7,
                       "rolling_resistance_m": 1e-7},
          contact={"tip_radius_m": 0.002, "law": "contensou", "friction_coefficient": 0.2, "patch_radius_m": 1e-4,
                   "spinning_friction_m": 1e-5, "rolling_resistance_m": 1e-5, "regularisation_rad_s": 0.1}),
    scene(uncertainty={"viscous_torque_N_m_s": 1e-9, "platform_rate_rad_s": 1e-3, "pivot_offset_m": 1e-4},
          effects={"viscous_torque_N_m_s": 1e-7},
          platform={"motion": "constant", "rate_rad_s": 1, "pivot_offset_m": [0.1, 0, 0]}),
    scene(numerics={"method": "gauss", "relative_tolerance": 1e-10}),
    scene(numerics={"method": "dop853"}),
    scene(platform={"motion": "ramp", "rate_rad_s": 1, "acceleration_rad_s2": 0.1}),
    scene(rotor={**ROTOR, "spin_rad_s": 300, "axis": [0, 0.1, 1], "center_m": [0, 0, 0.03], "drive": "none",
                 "viscous_torque_N_m_s": 1e-7, "coulomb_torque_N_m": 1e-6, "regularisation_rad_s": 1},
          uncertainty={"rotor_viscous_torque_N_m_s": 1e-8, "rotor_coulomb_torque_N_m": 1e-7}),
    scene(rotor={**ROTOR, "spin_rpm": 3000, "drive": "ramp", "acceleration_rad_s2": 1}),
    scene(rotor={**ROTOR, "spin_rad_s": 300, "drive": "harmonic", "amplitude_rad_s": 1, "frequency_hz": 2, "phase_deg": 30}),
    scene(rotor={**ROTOR, "spin_rad_s": 300}, release={"tilt_deg": 20}),
    scene(rotor={**ROTOR, "spin_rad_s": 300, "axis": [0, 0.1, 1]}, numerics={"ledger": "body"}, effects={"gravity_gradient": True},
          platform={"motion": "constant", "rate_rad_s": 1, "pivot_offset_m": [0.1, 0, 0]},
          uncertainty={"rotor_spin_rad_s": 1, "rotor_axial_kg_m2": 1e-7, "rotor_transverse_kg_m2": 1e-7}),
    scene(rotor={**ROTOR, "drive": "table", "file": "rates.csv", "file_sha256": hashlib.sha256(RATES).hexdigest()}),
    scene(moving_masses=[{"mass_kg": 0.01, "carrier": "body", "motion": "fixed", "center_m": [0, 0, 0.03]},
                         {"mass_kg": 0.01, "motion": "harmonic", "center_m": [0, 0, 0.03], "amplitude_m": [0.01, 0, 0],
                          "frequency_hz": 1, "phase_deg": 30},
                         {"mass_kg": 0.01, "motion": "circle", "center_m": [0, 0, 0.03], "start_m": [0.01, 0, 0],
                          "axis": [0, 0, 1], "frequency_hz": -1, "phase_deg": 30}]),
    scene(moving_masses=[{"mass_kg": 0.01, "motion": "waypoints", "times_s": [0.1, 0.5],
                          "points_m": [[0, 0, 0.03], [0.01, 0, 0.03]]},
                         {"mass_kg": 0.01, "motion": "table", "file": "places.csv",
                          "file_sha256": hashlib.sha256(PLACES).hexdigest()}], release={"tilt_deg": 20}),
    scene(travel={**SAILING, "reference": "same_path", "eotvos": "both", "figure": "wgs84",
                  "legs": [{"duration_s": 1}, {"duration_s": 5, "speed_m_s": 11, "turn_deg": 3, "climb_m": -1},
                           {"duration_s": 5, "speed_kn": 20}]}),
    scene(travel=SAILING, platform={"motion": "course", "axis": [0, 0, 2], "pivot_offset_m": [3, 0, 1]}),
    scene(travel=SAILING, uncertainty={"travel_speed_m_s": 0.1, "travel_course_deg": 0.5}),
    scene(travel={"path": "geodesic", "course_deg": -90, "speed_kn": 20, "reference": "at_rest", "eotvos": "off",
                  "figure": "sphere", "radius_m": 6.4e6}),
    scene(site={}, travel={"path": "table", "file": "voyage.csv", "file_sha256": hashlib.sha256(VOYAGE).hexdigest()}),
    scene(gimbals={"outer": {**RING, "axis_tilt_deg": 10, "axis_azimuth_deg": -30, "center_of_mass_m": [1e-3, 0, 0],
                             "viscous_torque_N_m_s": 1e-5, "coulomb_torque_N_m": 1e-5, "regularisation_rad_s": 0.01,
                             "torsion_N_m_rad": 1e-3, "torsion_rest_deg": 5},
                   "inner": {"axis_skew_deg": 2, "locked": False, "viscous_torque_N_m_s": 1e-5, "coulomb_torque_N_m": 1e-5,
                             "regularisation_rad_s": 0.01, "torsion_N_m_rad": 1e-3, "torsion_rest_deg": 5}},
          release={**IN_GIMBALS, "outer_rate_rad_s": 1, "inner_rate_rad_s": -1, "rates_relative_to": "inertial"},
          rotor={**ROTOR, "spin_rad_s": 300},
          uncertainty={"outer_angle_deg": 0.1, "inner_angle_deg": 0.1, "outer_rate_rad_s": 0.1, "inner_rate_rad_s": 0.1,
                       "outer_torsion_N_m_rad": 1e-5, "inner_torsion_N_m_rad": 1e-5, "outer_torsion_rest_deg": 0.1,
                       "inner_torsion_rest_deg": 0.1, "outer_viscous_torque_N_m_s": 1e-7, "inner_viscous_torque_N_m_s": 1e-7,
                       "outer_coulomb_torque_N_m": 1e-7, "inner_coulomb_torque_N_m": 1e-7, "axis_skew_deg": 0.1,
                       "outer_axis_tilt_deg": 0.1, "outer_axial_kg_m2": 1e-6}),
    scene(gimbals={"outer": {"locked": True, "mass_kg": 0.1, "inertia": {"about": "center_of_mass", "matrix_kg_m2": [
        [1e-4, 0, 0], [0, 1.1e-4, 1e-6], [0, 1e-6, 1.2e-4]]}}}, release=IN_GIMBALS),
    scene(gimbals={}, release=IN_GIMBALS, moving_masses=[
        {"mass_kg": 0.01, "carrier": "outer", "motion": "fixed", "center_m": [0, 0, 0.03]}]),
    scene(platform={"motion": "harmonic", "amplitude_rad": 0.1, "frequency_hz": 1, "phase_deg": 30}),
    scene(effects={"viscous_torque_N_m_s": [1e-7, 2e-7, 3e-7], "unequal_support": {"kappa_N_m": 0.1, "azimuth_deg": 30},
                   "given_torque": {"axes": "laboratory", "course": "harmonic", "torque_N_m": [1e-5, 1e-5, 1e-5], "frequency_hz": 1,
                                    "phase_deg": 30}},
          uncertainty={"viscous_torque_1_N_m_s": 1e-8, "viscous_torque_2_N_m_s": 1e-8, "viscous_torque_3_N_m_s": 1e-8,
                       "support_kappa_N_m": 0.01, "support_azimuth_deg": 1, "given_torque_1_N_m": 1e-6,
                       "given_torque_2_N_m": 1e-6, "given_torque_3_N_m": 1e-6, "given_torque_frequency_hz": 0.1,
                       "given_torque_phase_deg": 1}),
    scene(effects={"unequal_support": {"periods_s": [1.9, 2], "azimuth_deg": -30},
                   "given_torque": {"axes": "body", "torque_N_m": [0, 0, 1e-5]}}),
    scene(effects={"given_torque": {"axes": "body", "course": "table", "file": "torques.csv",
                                    "file_sha256": hashlib.sha256(TORQUES).hexdigest()}}),
    scene(effects={"viscous_torque_N_m_s": 1e-7, "air_drag": {"disc_radius_m": 0.05},
                   "air_force": {"linear_N_s_m": 0.01, "quadratic_N_s2_m2": 0.01}}, contact=SLIDING,
          uncertainty={"air_force_linear_N_s_m": 1e-3, "air_force_quadratic_N_s2_m2": 1e-3}),
    scene(effects={"gravity_gradient": True, "viscous_torque_N_m_s": 1e-7, "quadratic_torque_N_m_s2": 1e-9, "tide": False,
                   "air_drag": {"disc_radius_m": 0.05, "density_kg_m3": 1.2, "kinematic_viscosity_m2_s": 1.5e-5,
                                "flow": "laminar"}}),
    scene(effects={"gravity_gradient": "normal", "tide": True, "polar_motion": True, "gimbal": False},
          motion={"duration_s": 1, "start_utc": "2026-03-20T14:46:00Z"}),
    scene(effects={"gravity_gradient": {"gm_over_r3_s2": 1e-6}, "polar_motion": {"x_arcsec": 0.1, "y_arcsec": 0.3},
                   "tide": {"amplitude_m_s2": [1e-6, 0, 1e-6], "frequency_hz": 2.2e-5, "phase_deg": 10},
                   "excess_length_of_day_ms": 1, "deflection_of_vertical": {"north_arcsec": 5, "east_arcsec": -5}},
          site={"latitude_deg": 45, "gravity_anomaly_m_s2": 1e-4}),
    scene(effects={"tide": {"gravimetric_factor": 1.16, "tilt_factor": 0.69}},
          motion={"duration_s": 1, "start_utc": "2026-03-20T14:46:00.5Z"}),
    scene(effects={"gimbal": {"damping_N_m_s": 1e-6}}, release={"tilt_deg": 90, "spin_rad_s": 200}),
    scene(effects={"coulomb_torque_N_m": 1e-3}),
    scene(effects="auto", accuracy={"drift_rad": 1e-9}),
    scene(effects={"select": "auto", "viscous_torque_N_m_s": 1e-7}, accuracy={"drift_rad": 1e-9}),
    scene(contact={"tip_radius_m": 0.002, "law": "frictionless", "start": "center_of_mass_at_rest", "tip_position_m": [0.1, -0.1],
                   "max_tilt_deg": 75, "table": {"tilt_deg": 1, "tilt_azimuth_deg": -30}}),
    scene(contact={"tip_radius_m": 0, "law": "viscous", "sliding_viscosity_N_s_m": 0.05, "start": "rolling"}),
    scene(contact={"tip_radius_m": 0.002, "law": "viscous_load", "sliding_viscosity_s_m": 0.3, "tip_velocity_m_s": [0.1, 0]}),
    scene(contact={"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.2, "regularisation_m_s": 0.01,
                   "spinning_friction_m": 1e-5, "rolling_resistance_m": 1e-5, "regularisation_rad_s": 0.1}),
    scene(contact={"tip_radius_m": 0.002, "law": "contensou", "friction_coefficient": 0.2, "patch_radius_m": 1e-4}),
    scene(contact={"tip_radius_m": 0.002, "law": "rolling", "start": "rolling", "static_coefficient": 0.3},
          release={"tilt_deg": 20, "spin_rad_s": 200, "precession": "steady_slow"}),
    scene(platform={"motion": "table", "file": "angles.csv", "file_sha256": hashlib.sha256(ANGLES).hexdigest()}),
]


# Faults that a schema cannot express: sections to replace, and a part of the decoder's message.
BEYOND_THE_SCHEMA = [
    ({"uncertainty": {"viscous_torque_N_m_s": 1e-9}}, "the scenario has no such number"),
    ({"body": {**BODY, "inertia": {"principal_kg_m2": [1e-4, 1e-4, 3e-4]}}}, "triangle"),
    ({"body": {**BODY, "center_of_mass_m": [0, 0, 1]}}, "a principal moment is negative"),
    ({"body": {**BODY, "inertia": {"principal_kg_m2": [0, 1e-4, 1e-4]}}}, "positive definite"),
    ({"body": {**BODY, "inertia": {"matrix_kg_m2": [[1e-4, 1e-6, 0], [0, 1e-4, 0], [0, 0, 1e-4]]}}}, "is not symmetric"),
    ({"body": {"solids": [{"shape": "disc", "radius_m": 0.1, "density_kg_m3": 1000}]}}, "has no volume"),
    ({"body": {"solids": [{"shape": "ring", "radius_m": 0.1, "inner_radius_m": 0.2, "mass_kg": 1}]}}, "larger than radius_m"),
    ({"body": {"solids": [{"shape": "rod", "length_m": 1e-160, "mass_kg": 1e-3, "radius_m": 1e-160}]}}, "for a double"),
    ({"body": {"solids": [{"shape": "sphere", "radius_m": 1e5, "density_kg_m3": 1e5}]}}, "the mass is"),
    ({"release": {"quaternion_LB": {"w": 1, "x": 0.1, "y": 0, "z": 0}, "spin_rad_s": 1}}, "has the norm"),
    ({"release": {"tilt_deg": 20, "spin_rad_s": 1, "precession": "steady_slow"}}, "no steady precession"),
    ({"release": {"tilt_deg": 90, "spin_rad_s": 200, "precession": "steady_fast"}}, "steady precession"),
    ({"motion": {"duration_s": 1, "output_step_s": 1e-9}}, "output rows"),
    ({"motion": {"duration_s": 1e9}, "numerics": {"method": "taylor"}}, "steps"),
    ({"numerics": {"method": "abm8", "step_s": 1e-12}}, "steps"),
    ({"numerics": {"method": "closed_form"}}, "away from the poles"),
    ({"numerics": {"method": "closed_form"}, "body": {**BODY, "center_of_mass_m": [0, 0.01, 0.02]}}, "only a symmetric top"),
    ({"numerics": {"method": "closed_form"}, "effects": {"coriolis": False}}, "not available without"),
    ({"numerics": {"method": "closed_form"}, "rotor": {
        "mass_kg": 0.05, "axial_kg_m2": 1.6e-05, "transverse_kg_m2": 8.5e-06, "spin_rad_s": 300, "axis": [0, 0.1, 1],
        "center_m": [0, 0, 0.03]}}, "a body with a rotor has no closed form"),
    ({"numerics": {"method": "closed_form"}, "platform": {"motion": "ramp", "acceleration_rad_s2": 1}}, "not available on a platform"),
    ({"numerics": {"method": "splitting", "observer": "body"}}, "no body axes"),
    ({"numerics": {"method": "splitting", "model": "general"}}, "no general model"),
    ({"platform": {"motion": "constant", "rate_rad_s": 1, "axis": [0, 0, 0]}}, "zero vector"),
    ({"effects": {"gimbal": True}}, "holds body axis 3 level"),
    ({"effects": {"gimbal": True}, "release": {"tilt_deg": 90, "spin_rad_s": 1, "rates_relative_to": "inertial"}}, "leave the level"),
    ({"effects": {"gimbal": True}, "release": {"tilt_deg": 90, "angular_velocity_body_rad_s": [0, 1, 9]}}, "out of the level"),
    ({"effects": {"coulomb_torque_N_m": 1}, "platform": {"motion": "ramp", "acceleration_rad_s2": 1}}, "on a platform"),
    ({"effects": {"coulomb_torque_N_m": 1}, "rotor": {**ROTOR, "spin_rad_s": 300}}, "is not available with /rotor"),
    ({"body": {**BODY, "inertia": {"principal_kg_m2": [1e-4, 1e-4, 0]}}, "rotor": {**ROTOR, "spin_rad_s": 300}},
     "are not free to turn about three axes"),
    ({"effects": {"unequal_support": {"kappa_N_m": 1}}, "platform": {"motion": "ramp", "acceleration_rad_s2": 1}},
     "is not available with /platform"),
    ({"effects": {"unequal_support": {"kappa_N_m": 1}, "gimbal": True}, "release": {"tilt_deg": 90, "spin_rad_s": 1}},
     "is not available with /effects/gimbal"),
    ({"effects": {"unequal_support": {"kappa_N_m": 1}}, "contact": SLIDING}, "is not available with /contact"),
    ({"effects": {"given_torque": {"axes": "body", "torque_N_m": [0, 0, 1]}}, "contact": SLIDING}, "is not available with /contact"),
    ({"effects": {"unequal_support": {"periods_s": [1, 2]}}, "body": {**BODY, "center_of_mass_m": [0, 0.01, 0.02]}},
     "are those of a pendulum"),
    ({"effects": {"air_force": {"linear_N_s_m": 1}}}, "there is no /contact"),
    ({"effects": {"given_torque": {"axes": "body", "course": "table", "file": "places.csv"}}}, "must be the header"),
    ({"effects": {"tide": True}}, "by date"),
    ({"effects": {"polar_motion": True}}, "by date"),
    ({"effects": "auto"}, "error asked for"),
    ({"motion": {"duration_s": 1, "start_utc": "2026-02-30T00:00:00Z"}}, "an instant of UTC"),
    ({"platform": {"motion": "table", "file": "none.csv"}}, "there is no such file"),
    ({"rotor": {**ROTOR, "drive": "table", "file": "angles.csv"}}, "must be the header"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "table", "file": "angles.csv"}]}, "must be the header"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "fixed", "center_m": [0, 0, 0]}] * 65}, "at most 64"),
    ({"moving_masses": [{"mass_kg": 1, "carrier": "outer", "motion": "fixed", "center_m": [0, 0, 0]}]}, "no outer gimbal"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "circle", "center_m": [0, 0, 0], "start_m": [1, 0, 1], "axis": [0, 0, 1],
                         "frequency_hz": 1}]}, "is not perpendicular to axis"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "circle", "center_m": [0, 0, 0], "start_m": [1, 0, 0], "axis": [0, 0, 0],
                         "frequency_hz": 1}]}, "zero vector"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "waypoints", "times_s": [1, 1], "points_m": [[0, 0, 0], [1, 0, 0]]}]}, "must ascend"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "waypoints", "times_s": [1, 2], "points_m": [[0, 0, 0]]}]}, "one point for each time"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "fixed", "center_m": [0, 0, 0]}], "effects": {"gimbal": True}},
     "not available with /moving_masses"),
    ({"moving_masses": [{"mass_kg": 1, "motion": "fixed", "center_m": [0, 0, 0]}], "contact": SLIDING},
     "not available with /contact"),
    ({"travel": {**SAILING, "legs": [{"duration_s": 1}] * 10001}}, "at most 10000"),
    ({"travel": {"path": "table", "file": "voyage.csv"}, "site": {"latitude_deg": 46}}, "the table of /travel begins at"),
    ({"travel": {"path": "table", "file": "places.csv"}, "site": {}}, "must be the header"),
    ({"travel": SAILING, "site": {"latitude_deg": 89.95}}, "near a pole"),
    ({"travel": SAILING, "contact": SLIDING}, "not available with /travel"),
    ({"travel": SAILING, "effects": {"coriolis": False}}, "not available with /travel"),
    ({"travel": SAILING, "effects": "auto", "accuracy": {"drift_rad": 1e-9}}, "a laboratory at rest"),
    ({"gimbals": {"outer": RING, "inner": {"locked": True}}, "release": {**IN_GIMBALS, "inner_rate_rad_s": 1}}, "of a locked gimbal"),
    ({"gimbals": {"outer": {**RING, "locked": True}, "inner": {"locked": True}}, "release": IN_GIMBALS}, "both gimbals are locked"),
    ({"gimbals": {"outer": {"mass_kg": 0.1, "inertia": {"principal_kg_m2": [1e-4, 1e-4, 3e-4]}}}, "release": IN_GIMBALS}, "triangle"),
    ({"gimbals": {}, "release": {"outer_angle_deg": 0, "inner_angle_deg": 0}, "body": {**BODY, "inertia": {
        "about": "center_of_mass", "principal_kg_m2": [1e-4, 1e-4, 0]}}}, "gimbal lock"),
    ({"gimbals": {}, "release": IN_GIMBALS, "effects": {"viscous_torque_N_m_s": 1e-7}}, "not available with /gimbals"),
    ({"gimbals": {}, "release": IN_GIMBALS, "effects": {"coriolis": False}}, "not available with /gimbals"),
    ({"gimbals": {}, "release": IN_GIMBALS, "numerics": {"observer": "body"}}, "with /gimbals"),
    ({"gimbals": {}, "release": IN_GIMBALS, "numerics": {"method": "dop853"}}, "not built for a body in gimbals"),
    ({"gimbals": {}, "release": IN_GIMBALS, "numerics": {"method": "closed_form"}}, "not available for a body in gimbals"),
    ({"gimbals": {}, "release": IN_GIMBALS, "contact": SLIDING}, "not available with /contact"),
    ({"platform": {"motion": "table", "file": "."}}, "is a directory"),
    ({"platform": {"motion": "table", "file": ""}}, "names no file"),
    ({"platform": {"motion": "table", "file": "angles.csv", "file_sha256": ""}}, "is not that of"),
    ({"platform": {"motion": "table", "file": "angles.csv"}, "motion": {"duration_s": 2.5}}, "it must reach the duration"),
    ({"headline": {"quantity": "drift.threshold_time_s", "value": 1, "tolerance": 1, "origin": ""}}, "no threshold to pass"),
    ({"contact": SLIDING, "platform": {"motion": "ramp", "acceleration_rad_s2": 1}}, "is not available with /contact"),
    ({"contact": SLIDING, "effects": {"coulomb_torque_N_m": 1e-7}}, "is not available with /contact"),
    ({"contact": SLIDING, "numerics": {"observer": "body"}}, "with /contact"),
    ({"contact": SLIDING, "numerics": {"method": "splitting"}}, "not available for a top on a table"),
    ({"contact": SLIDING, "numerics": {"method": "dop853"}}, "not built for a top on a table"),
    ({"site": {"latitude_deg": 90}, "numerics": {"method": "closed_form"}, "effects": {"gravity_gradient": "normal"}},
     "leave the other effects out"),
    ({"effects": {"polar_motion": True}}, "is looked up by date"),
    ({"contact": SLIDING, "release": {"tilt_deg": 20, "spin_rad_s": 200, "precession": "steady_slow"}}, "with /contact/law"),
    ({"contact": {"tip_radius_m": 0.002, "law": "rolling", "table": {"tilt_deg": 1}},
      "release": {"tilt_deg": 20, "spin_rad_s": 200, "precession": "steady_slow"}}, "on a tilted table"),
    ({"contact": {**SLIDING, "table": {"tilt_deg": 1}},
      "release": {"quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "spin_rad_s": 1}}, "a release on a tilted table"),
    ({"contact": {**SLIDING, "max_tilt_deg": 10}}, "is not above the tilt of the release"),
    ({"contact": {**SLIDING, "friction_coefficient": 1e3, "tip_velocity_m_s": [0, -1]}}, "Painleve"),
    ({"contact": SLIDING, "release": {"tilt_deg": 60, "angular_velocity_body_rad_s": [0, -100, 0]}}, "leaves the table"),
    ({"contact": {**SLIDING, "regularisation_m_s": 1e-9}}, "makes a slip die out"),
    ({"contact": SLIDING, "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": {
        "about": "center_of_mass", "principal_kg_m2": [0, 1e-4, 1e-4]}}}, "all three moments must be above 0"),
    ({"criteria": [{"kind": "value", "quantity": "q_LB", "values": [1], "tolerance": 0, "why": ""}]}, "numbers; "),
]
# The same where the fault is in the text: a parser takes these silently, or a schema never sees them.
TEXTS_BEYOND_THE_SCHEMA = [
    ('"latitude_deg": 45', '"latitude_deg": 45, "latitude_deg": 46', "duplicate key"),
    ('"latitude_deg": 45', '"latitude_deg": 45, "height_m": 1e-400', "too small"),
    ('"latitude_deg": 45', '"latitude_deg": 45, "_": 1e999', "too large"),
    ('"spin_rad_s": 200', '"spin_rad_s": NaN', "NaN"),
]


def places(value, path=()):
    """Every path into a document; objects and arrays come before their contents."""
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in items:
        yield from places(child, path + (key,))


def at(document, path):
    for key in path:
        document = document[key]
    return document


def schema_at(schema, path):
    """The schema that applies at a place of the document; None if there is no single one."""
    for key in path:
        if "oneOf" in schema:
            schema = schema["oneOf"][1]
        schema = schema.get("items") if isinstance(key, int) else schema.get("properties", {}).get(key)
        if not isinstance(schema, dict):
            return None
    return schema


def other_value(rng, value, schema):
    """A value near the border of what is allowed, or of another type."""
    choices = [None, "word", "", True, False, [], {}, [1, 2, 3], [1, 2], {"rate_rad_s": 1}, 0, -1, 1, 2, 1e5, -1e5, 1e300, -1e300]
    schema = schema or {}
    for word in schema.get("enum", []):
        choices += [word, word.upper(), word + " "]
    for bound in ("minimum", "maximum", "exclusiveMinimum"):
        if bound in schema:
            choices += 4 * [schema[bound], schema[bound] * (1 + 1e-9) + 1e-9, schema[bound] * (1 - 1e-9) - 1e-9]
    if isinstance(value, list):
        choices += 3 * [value[:-1], value + value[-1:], [str(v) for v in value], value[0]]
    return rng.choice(choices)


def mutate(rng, document, schema):
    document = copy.deepcopy(document)
    path = rng.choice([p for p in places(document) if p])
    parent, key = at(document, path[:-1]), path[-1]
    kind = rng.randrange(5)
    if kind == 0:
        parent[key] = other_value(rng, parent[key], schema_at(schema, path))
    elif kind == 1:
        del parent[key]
    elif isinstance(parent, dict) and kind == 2:
        parent[rng.choice([key + "s", key.upper(), "_" + key, "//" + key, key[:-1], " " + key])] = parent.pop(key)
    elif isinstance(parent, dict) and kind == 3:
        parent[rng.choice(["colour", "_colour", "//", "mass", "tilt", "Name", ""])] = rng.choice([1, "x", None, [1], {}])
    elif isinstance(parent, dict):  # a key that exists, where it may not belong
        siblings = (schema_at(schema, path[:-1]) if path[:-1] else schema) or {}
        names = sorted(siblings.get("properties", {}))
        if names:
            name = rng.choice(names)
            donors = [at(d, path[:-1])[name] for d in WHOLE if holds(d, path[:-1] + (name,))]
            parent[name] = rng.choice(donors or [1])
    return document


def holds(document, path):
    try:
        at(document, path)
    except (KeyError, IndexError, TypeError):
        return False
    return True


def check(earthtop, texts):
    """The decoder's errors for every text, a list of messages each."""
    with tempfile.TemporaryDirectory() as directory:
        files = []
        pathlib.Path(directory, "angles.csv").write_bytes(ANGLES)
        pathlib.Path(directory, "rates.csv").write_bytes(RATES)
        pathlib.Path(directory, "places.csv").write_bytes(PLACES)
        pathlib.Path(directory, "torques.csv").write_bytes(TORQUES)
        pathlib.Path(directory, "voyage.csv").write_bytes(VOYAGE)
        for index, text in enumerate(texts):
            path = pathlib.Path(directory, f"s{index}.json")
            path.write_text(text, encoding="utf-8")
            files.append(str(path))
        done = subprocess.run([earthtop, "check", "--json", *files], capture_output=True, text=True, check=False)
        report = json.loads(done.stdout)
    messages = {file: [] for file in files}
    for error in report["errors"]:
        messages[error["file"]].append(error["message"])
    for entry in report["files"]:
        assert entry["valid"] == (not messages[entry["file"]]), entry
    return [messages[file] for file in files]


def main():
    earthtop, directory = sys.argv[1:]
    schema = json.loads(subprocess.run([earthtop, "schema"], capture_output=True, text=True, check=True).stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    faults = 0

    def fault(what, document):
        nonlocal faults
        faults += 1
        print(f"FAULT: {what}\n  {document if isinstance(document, str) else json.dumps(document)}")

    # The scenes use every key, or the mutants would not reach it.
    used = {tuple("*" if isinstance(k, int) else k for k in p) for d in WHOLE for p in places(d)}

    def keys(part, path=()):
        for option in (part, *part.get("oneOf", [])):
            for key, child in option.get("properties", {}).items():
                yield path + (key,)
                yield from keys(child, path + (key,))
        if isinstance(part.get("items"), dict) and "properties" in part["items"]:
            yield from keys(part["items"], path + ("*",))

    for path in keys(schema):
        if path not in used:
            fault("no scene here uses this key", "/".join(path))

    shipped = [json.loads(p.read_text(encoding="utf-8")) for p in sorted(pathlib.Path(directory).glob("*.json"))]
    sound = shipped + WHOLE
    for document, errors in zip(sound, check(earthtop, [json.dumps(d) for d in sound])):
        if errors or not validator.is_valid(document):
            fault(f"a sound scenario is refused: {errors}", document)

    rng = random.Random(SEED)
    mutants = []
    for index in range(MUTANTS):
        mutant = mutate(rng, rng.choice(sound), schema)
        mutants.append(mutate(rng, mutant, schema) if index % 4 == 3 and mutant else mutant)
    refused = 0
    for mutant, errors in zip(mutants, check(earthtop, [json.dumps(m) for m in mutants])):
        allowed = validator.is_valid(mutant)
        refused += bool(errors)
        beyond = errors and all(any(part in e for _, part in BEYOND_THE_SCHEMA) for e in errors)
        if allowed and errors and not beyond:
            fault(f"the schema allows what the decoder refuses: {errors}", mutant)
        if not allowed and not errors:
            fault(f"the decoder allows what the schema refuses: {next(validator.iter_errors(mutant)).message}", mutant)
    if not MUTANTS // 4 < refused < MUTANTS:
        fault(f"only {refused} of {MUTANTS} mutants are refused: nothing is tested", "")

    documents = [scene(**sections) for sections, _ in BEYOND_THE_SCHEMA]
    for document, (_, part), errors in zip(documents, BEYOND_THE_SCHEMA, check(earthtop, [json.dumps(d) for d in documents])):
        if not validator.is_valid(document):
            fault(f"the schema can say this after all: {part}", document)
        if not any(part in e for e in errors):
            fault(f"the decoder does not refuse this with '{part}': {errors}", document)
    whole = json.dumps(SCENE)
    texts = [whole.replace(a, b) for a, b, _ in TEXTS_BEYOND_THE_SCHEMA]
    for text, (_, _, part), errors in zip(texts, TEXTS_BEYOND_THE_SCHEMA, check(earthtop, texts)):
        if not any(part in e for e in errors):
            fault(f"the decoder does not refuse this with '{part}': {errors}", text)

    studies = jsonschema.Draft7Validator(json.loads(subprocess.run(
        [earthtop, "schema", "--study"], capture_output=True, check=True, text=True).stdout))
    shipped = sorted(pathlib.Path(sys.argv[2], "studies").glob("*.json"))
    if not shipped:
        fault("no study is shipped", "")
    for file in shipped:
        study = json.loads(file.read_text())
        if not studies.is_valid(study):
            fault(f"the schema refuses {file.name}: {next(studies.iter_errors(study)).message}", "")
        if studies.is_valid({**study, "axis": []}) or studies.is_valid({**study, "design": {"kind": "grids"}}):
            fault(f"the schema of studies refuses nothing in {file.name}", "")

    mappings = jsonschema.Draft7Validator(json.loads(subprocess.run(
        [earthtop, "schema", "--mapping"], capture_output=True, check=True, text=True).stdout))
    mapping = json.loads(pathlib.Path(sys.argv[2], "../tests/data/simbody/mapping.json").read_text())
    if not mappings.is_valid(mapping):
        fault(f"the schema refuses the shipped mapping: {next(mappings.iter_errors(mapping)).message}", "")
    if mappings.is_valid({**mapping, "times": {}}) or mappings.is_valid({**mapping, "time": {}}):
        fault("the schema of mappings refuses nothing", "")

    print(f"{len(sound)} sound scenarios, {MUTANTS} mutants of which {refused} are refused, "
          f"{len(documents) + len(texts)} faults beyond the schema; seed {SEED}: {faults} disagreements")
    return faults != 0


if __name__ == "__main__":
    sys.exit(main())
