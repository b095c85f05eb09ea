// SPDX-License-Identifier: GPL-3.0-or-later
/// Results of a run with known numbers, made without an integration, for testing what reads and writes results.
#pragma once

#include <cmath>

#include "earthtop/run.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "support/changed_scene.hpp"
#include "support/scenes.hpp"

namespace earthtop::test {

inline RunResult made_up_run(std::size_t rows = 201) {
  RunResult result;
  Scenario scenario;
  scenario.name = "made-up";
  scenario.title = "A fast top, slowly precessing";
  scenario.site = {45, 0, 0, 9.80665};
  scenario.body.mass_kg = 0.1;
  scenario.body.center_of_mass_m = {0, 0, 0.03};
  scenario.body.inertia_kg_m2 = {{{1.2e-4, 0, 0}, {0, 1.2e-4, 0}, {0, 0, 4e-5}}};
  scenario.release.tilt_deg = 20;
  scenario.release.azimuth_deg = 90;
  scenario.release.spin_rad_s = 200;
  scenario.duration_s = 60;
  scenario.output_step_s = 0.3;
  result.scene = resolve(std::move(scenario));
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 60.0 * static_cast<double>(i) / static_cast<double>(rows - 1);
    DriftRow row;
    row.t_s = t;
    row.drift_azimuth_rad = 5.15e-5 * t + 2e-4 * std::sin(1.3 * t);
    row.drift_tilt_rad = 1.5e-4 * (1 - std::cos(1.3 * t));
    row.drift_axis_rad = std::hypot(*row.drift_azimuth_rad * std::sin(0.35), row.drift_tilt_rad);
    row.drift_axis_bound_rad = 1e-13 * (1 + t * t);
    row.drift_attitude_rad = 2 * row.drift_axis_rad;
    row.drift_attitude_bound_rad = 2e-13 * (1 + t * t);
    row.drift_spin_rad = -1e-5 * t;
    result.rows.push_back(row);
  }
  result.reached_s = result.rows.back().t_s;
  result.drift.axis_final_rad = result.rows.back().drift_axis_rad;
  result.drift.axis_max_rad = 1.25e-3;
  result.drift.axis_bound_rad = 3.6e-10;
  result.drift.attitude_final_rad = 2 * result.drift.axis_final_rad;
  result.drift.attitude_bound_rad = 7.2e-10;
  result.drift.spin_final_rad = -6e-4;
  result.drift.azimuth_final_rad = result.rows.back().drift_azimuth_rad;
  result.drift.tilt_final_rad = result.rows.back().drift_tilt_rad;
  result.drift.axis_final_over_earth_angle = result.drift.axis_final_rad / (kEarthRateWgs84 * 60);
  result.drift.secular = SecularDrift{5.15e-5, 3e-7, 18.5, {0, 60}, 2e-4, false, ""};
  result.solution.method = Method::rkf78;
  result.solution.relative_tolerance = 1e-12;
  result.solution.counters = {12345, 67, 161196};
  result.solution.seconds = 0.125;
  result.certificate = result.solution;
  result.certificate.observer = Observer::inertial;
  result.attitude_bound_rad = 1e-9;
  result.invariants = {{"jacobi_integral", "J", 0.8, 1e-14, 0.83}};
  result.theory = {{"precession_rate_change", "-Omega sin(latitude)", "rad/s", -5.156e-5, -5.15e-5, 4e-8, true, 3e-7}};
  result.why = {{"earth_turns", "In the 60 s of this run the Earth turns by 902.46″.", {{"earth_angle_rad", 4.375269e-3}}},
                {"laboratory_turns", "About <its> vertical & so on.", {}}};
  result.notes = {"made up"};
  return result;
}

/// The same with a ledger whose numbers are 1 to 18 times the row's number, which counts from 1.
inline RunResult made_up_run_with_ledger(std::size_t rows = 201) {
  RunResult result = made_up_run(rows);
  result.scene = testing::changed(result.scene, [](Scenario& s) { s.ledger = LedgerObserver::platform; });
  LedgerReport& ledger = result.ledger.emplace();
  ledger.observer = LedgerObserver::platform;
  for (std::size_t i = 0; i < rows; ++i) {
    LedgerRow<double> entry;
    double number = 0;
    for (std::array<double, 3>* column :
         {&entry.tau_phys_A, &entry.tau_cor_A, &entry.tau_trans_A, &entry.tau_cent_A, &entry.dL_dt_A, &entry.residual_A})
      for (std::size_t k = 0; k < 3; ++k) (*column)[k] = ++number * static_cast<double>(i + 1);
    ledger.entries.push_back(entry);
  }
  ledger.largest = {1, 2, 3, 4, 5, 0.5};
  return result;
}

/// The same of a top on a table: its tip runs in circles and its drift to the North; with all that a result tells about the
/// contact.
inline RunResult made_up_contact_run(std::size_t rows = 201) {
  RunResult result = made_up_run(rows);
  result.scene = testing::changed(result.scene, [](Scenario& s) {
    ContactSpec& contact = s.contact.emplace();
    contact.tip_radius_m = 0.002;
    contact.law = ContactLaw::contensou;
    contact.friction_coefficient = 0.2;
    contact.patch_radius_m = 3e-5;
  });
  result.modelled = result.scene;
  for (DriftRow& row : result.rows) {
    const double t = row.t_s;
    BasicContactRow<double>& contact = row.contact.emplace();
    contact.drift_tip_xy_m = {1e-7 * std::sin(0.4 * t), 2e-6 * t};
    contact.drift_tip_m = std::hypot(contact.drift_tip_xy_m[0], contact.drift_tip_xy_m[1]);
    contact.drift_tip_bound_m = 1e-15 * (1 + t * t);
    contact.ref_tip_m = {0.02 * std::cos(0.4 * t), 0.02 * std::sin(0.4 * t)};
    for (std::size_t i = 0; i < 2; ++i) contact.tip_m[i] = contact.ref_tip_m[i] + contact.drift_tip_xy_m[i];
    contact.ref_slip_m_s = 0.01 * std::exp(-0.1 * t);
    contact.drift_slip_m_s = -1e-7 * t;
    contact.slip_m_s = contact.ref_slip_m_s + contact.drift_slip_m_s;
    contact.ref_normal_force_N = 0.98 + 1e-3 * std::cos(t);
    contact.normal_force_N = contact.ref_normal_force_N - 1e-6;
    contact.drift_spin_rate_rad_s = 4e-5;
    contact.state = t < 30 ? ContactState::slide : ContactState::roll;
  }
  result.drift.tip_final_m = result.rows.back().contact->drift_tip_m;
  result.drift.tip_max_m = 1.25e-4;
  result.drift.tip_bound_m = 3.601e-12;
  ContactReport& contact = result.contact.emplace();
  contact.events = {{ContactEventKind::slip_stopped, Prediction::reference, 29.75, -8e-7, 1e-9},
                    {ContactEventKind::inverted, Prediction::rotating, 50.5, 3e-6, 1e-8}};
  contact.at_s = 60;
  contact.changes = {{"friction_coefficient", "1 %", 8e-3, 8.8e-4}, {"table_tilt", "1 arcsec", 8e-6, 4e-5}};
  return result;
}

/// The same of a body with a rotor on a slanted axis, whose bearing slows it.
inline RunResult made_up_rotor_run(std::size_t rows = 201) {
  RunResult result = made_up_run(rows);
  result.scene = testing::changed(result.scene, [](Scenario& s) {
    RotorSpec& rotor = s.rotor.emplace();
    rotor.mass_kg = 0.02, rotor.axial_kg_m2 = 1e-5, rotor.transverse_kg_m2 = 6e-6;
    rotor.axis = {0, 0.6, 0.8}, rotor.spin_rad_s = 300;
  });
  result.modelled = result.scene;
  for (DriftRow& row : result.rows) {
    const double t = row.t_s;
    BasicRotorRow<double>& rotor = row.rotor.emplace();
    rotor.ref_rate_rad_s = 300 * std::exp(-0.01 * t), rotor.ref_angle_rad = 300 * t * (1 - 0.005 * t);
    rotor.drift_rate_rad_s = 1e-6 * t, rotor.drift_angle_rad = 5e-7 * t * t;
    rotor.rate_rad_s = rotor.ref_rate_rad_s + rotor.drift_rate_rad_s,
    rotor.angle_rad = rotor.ref_angle_rad + rotor.drift_angle_rad;
    rotor.axis_L = {0.6 * std::cos(t), 0.6 * std::sin(t), 0.8}, rotor.ref_axis_L = {0.6 * std::cos(t), 0.6 * std::sin(t), 0.8};
    rotor.drift_axis_rad = 1.5 * row.drift_axis_rad, rotor.drift_axis_bound_rad = row.drift_attitude_bound_rad;
  }
  result.drift.rotor_axis_final_rad = result.rows.back().rotor->drift_axis_rad;
  result.drift.rotor_axis_max_rad = 1.9e-3, result.drift.rotor_axis_max_at_s = 59,
  result.drift.rotor_axis_max_bound_rad = 7e-10;
  result.drift.rotor_axis_bound_rad = 7.2e-10;
  return result;
}

/// The same of a rotor in gimbals; with a centre of mass below them they have a place of rest, else a drift by nutation.
inline RunResult made_up_gimbals_run(std::size_t rows = 201, bool hangs = false) {
  RunResult result = made_up_rotor_run(rows);
  result.scene = testing::changed(result.scene, [hangs](Scenario& s) {
    s.body.center_of_mass_m = {hangs ? 0.05 : 0, 0, 0};
    s.rotor->axis = {0, 0, 1};
    BodySpec& ring = s.gimbals.emplace().ring.emplace();
    ring.mass_kg = 0.1;
    testing::set_principal(ring, 1e-4, 1e-4, 1e-4);
    s.release.gimbals = GimbalReleaseSpec{0, hangs ? 90.0 : 60.0, 0, 0};
    s.release.spin_rad_s = 0;
  });
  result.modelled = result.scene;
  for (DriftRow& row : result.rows) {
    const double t = row.t_s;
    BasicGimbalRow<double>& gimbals = row.gimbals.emplace();
    gimbals.ref_outer_angle_rad = 0.1 * std::sin(t), gimbals.ref_inner_angle_rad = 1 + 0.1 * std::cos(t);
    gimbals.ref_outer_rate_rad_s = 0.1 * std::cos(t), gimbals.ref_inner_rate_rad_s = -0.1 * std::sin(t);
    gimbals.drift_outer_angle_rad = 1e-5 * t, gimbals.drift_inner_angle_rad = -2e-5 * t;
    gimbals.drift_outer_rate_rad_s = 1e-5, gimbals.drift_inner_rate_rad_s = -2e-5;
    gimbals.outer_angle_rad = gimbals.ref_outer_angle_rad + gimbals.drift_outer_angle_rad;
    gimbals.inner_angle_rad = gimbals.ref_inner_angle_rad + gimbals.drift_inner_angle_rad;
    gimbals.outer_rate_rad_s = gimbals.ref_outer_rate_rad_s + gimbals.drift_outer_rate_rad_s;
    gimbals.inner_rate_rad_s = gimbals.ref_inner_rate_rad_s + gimbals.drift_inner_rate_rad_s;
    gimbals.drift_outer_angle_bound_rad = gimbals.drift_inner_angle_bound_rad = 1e-15 * (1 + t * t);
  }
  result.drift.outer_angle = {6e-4, 6e-4, 3.6e-12, 60, 3.6e-12};
  result.drift.inner_angle = {-1.2e-3, 1.2e-3, 3.6e-12, 60, 3.6e-12};
  result.gimbal_events = {{GimbalEventKind::gimbal_lock_passed, 20.5, 1e-3, 9, 1e-9}};
  return result;
}

/// A run of the same body in gimbals aboard a ship.
inline RunResult made_up_journey_run(std::size_t rows = 201) {
  RunResult result = made_up_gimbals_run(rows, true);
  result.scene = testing::changed(result.scene, [](Scenario& s) {
    TravelSpec& travel = s.travel.emplace();
    travel.course_deg = 30, travel.speed_m_s = 10;
  });
  result.modelled = result.scene;
  for (DriftRow& row : result.rows)
    row.journey = {50 + 1e-6 * row.t_s, 10 + 2e-6 * row.t_s, 3 + 1e-3 * row.t_s, 30 + 1e-4 * row.t_s, 10 + 1e-3 * row.t_s};
  return result;
}

/// The same with everything that a result may have, and no number of its summary null.
inline RunResult made_up_full_run() {
  RunResult result = made_up_run_with_ledger(11);
  Scenario scenario = result.scene.scenario();
  scenario.headline = HeadlineSpec{"drift_axis_rad", 60, 1e-3, 1e-3, "made up"};
  scenario.threshold_rad = 1e-3;
  scenario.accuracy_rad = 1e-9;
  scenario.sensitivities = true;
  scenario.uncertainty.emplace().fill(1e-3);
  scenario.effects.tide.emplace().given = true;
  scenario.effects.applied = {1e-6, 1e-8, 1e-5, AirDragSpec{}, GravityGradientSpec{GradientField::given, 1e-3}, GimbalSpec{}};
  scenario.effects.applied.unequal_support.emplace(), scenario.effects.applied.given_torque.emplace();
  result.scene = result.modelled = resolve(std::move(scenario));
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    for (std::size_t k = 0; k < kAppliedShares.size(); ++k)
      result.ledger->entries[i].share_A[k] = {static_cast<double>(20 + 3 * k), static_cast<double>(i + 1), 0.5};
  result.selection = Selection{1e-9, {"tide"}, {"polar_motion"}, 2e-10, 0.25};
  result.accuracy = AccuracyReport{1e-9, 5e-10, 2};
  result.drift.threshold_time_s = 41;
  result.drift.threshold_time_bound_s = 1e-6;
  result.drift.threshold_crossing = ThresholdCrossing::clear;
  const auto pair = [](double value) { return BoundedPair{{value, 1e-9}, {value + 1e-5, 2e-9}}; };
  const MotionReport::Reached reached{40.5, 41.5, 1e-7, 2e-7};
  result.motion = MotionReport{pair(190), reached, reached,
                               MotionReport::OfSwing{pair(0.1), pair(-0.01), pair(0.09), pair(-0.02), pair(5e-5)}};
  result.verdict.from_s = result.verdict.reliable_until_s = 60.5;
  result.verdict.intervals = {{58, 59, Doubt::one_at_rest}, {60.5, {}, Doubt::rounding_grown}};
  result.verdict.lyapunov_exponent_1_s = 0.1;
  result.verdict.round_off_grown_s = 200;
  result.verdict.earth_grown_s = 150;
  result.stops = {{Prediction::rotating, 58, 1e-3}, {Prediction::reference, 59, 1e-3}};
  result.solution.step_s = result.certificate.step_s = 1e-3;
  SensitivityReport& sensitivities = result.sensitivities.emplace();
  sensitivities.at_s = 60;
  double number = 0;
  for (const std::string_view name : kInputNames)
    sensitivities.inputs.push_back({name, ++number, 2e-3 * number, 3e-3 * number, 4e-3, 5e-3, 1e-6 * number, 1e-12 * number});
  sensitivities.axis_error_rad = 1e-5;
  return result;
}

}  // namespace earthtop::test
