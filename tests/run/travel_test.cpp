// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run of a laboratory that travels must keep: no drift where nothing differs, one drift over Omega or over the speed at tiny rates,
/// the same motion as a laboratory at rest at speed 0, agreement of observers and methods, a ledger that closes, its columns, and its
/// derivatives.
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "support/gimbal_scenes.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"
#include "support/travel_runs.hpp"

namespace earthtop {
namespace {

using testing::rounding;
using testing::sailing;

/// The share of a drift that bounds must be below, so that what is compared within them can fail.
constexpr double kSmall = 1e-7;

/// Tops and a suspension on a journey with a turn, a climb and a change of speed.
std::vector<Scenario> voyages() {
  std::vector<Scenario> all{testing::toy_top(), testing::asymmetric_top(), testing::foucault_gyroscope(), testing::toy_top(),
                            testing::toy_top()};
  all[1].release.rates_relative_to = RatesRelativeTo::inertial;
  all[3].platform = PlatformSpec{PlatformMotion::harmonic, {1, 1, 0.2}, 0, 0, 0.1, 0.7, 20, {0.1, -0.2, 0.3}};
  all[4].platform = PlatformSpec{PlatformMotion::course, {0, 0, 2}, 0, 0, 0, 0, 0, {0.1, -0.2, 0.3}};
  for (Scenario& s : all) {
    s.site.latitude_deg = -41, s.site.height_m = 900;
    s.duration_s = 0.5, s.output_step_s = 0.1;
    s.travel = sailing(TravelPath::geodesic, 130, 60);
    s.travel->legs = {{0.1, {}, 0, 0}, {0.15, 59.5, 0.2, 0.05}};
  }
  return all;
}

/// The sizes of all drifts of a row.
std::vector<double> drifts(const DriftRow& row) {
  std::vector<double> all{row.drift_axis_rad, row.drift_azimuth_rad.value_or(0), row.drift_tilt_rad, row.drift_attitude_rad,
                          row.drift_spin_rad};
  if (row.rotor) all.insert(all.end(), {row.rotor->drift_axis_rad, row.rotor->drift_rate_rad_s, row.rotor->drift_angle_rad});
  if (row.gimbals)
    all.insert(all.end(), {row.gimbals->drift_outer_angle_rad, row.gimbals->drift_inner_angle_rad,
                           row.gimbals->drift_outer_rate_rad_s, row.gimbals->drift_inner_rate_rad_s});
  return all;
}

void expect_no_drift(const Scenario& scenario) {
  const RunResult result = run(scenario);
  ASSERT_EQ(result.status, RunStatus::completed);
  for (const DriftRow& row : result.rows) {
    for (const double drift : drifts(row)) ASSERT_EQ(drift, 0) << row.t_s;
    ASSERT_EQ(row.drift_attitude_bound_rad, 0);
    ASSERT_EQ(row.q_LB, row.ref_q_LB);
    ASSERT_EQ(row.w_LB_B, row.ref_w_LB_B);
  }
}

/// Calls with the scene in the equations of every observer and by methods of each kind.
template <class Call>
void by_all_means(Scenario scenario, const Call& call) {
  for (const Method method : {Method::automatic, Method::taylor, Method::dop853, Method::extrapolation})
    for (const testing::Equations& equations : testing::kEquations) {
      equations.take(scenario);
      scenario.numerics.method = method;
      if (scenario.gimbals && equations.observer == Observer::body) continue;
      if (Scene(scenario).method_refusal(method)) continue;
      SCOPED_TRACE(testing::text_of(nlohmann::json(std::string(to_string(method)))));
      SCOPED_TRACE(equations);
      call(scenario);
    }
}

TEST(Travel, WithoutTheEarthsRotationTheSamePathHasNoDrift) {
  for (Scenario& s : voyages()) {
    s.rotation_rate_rad_s = 0;
    for (const TravelEotvos eotvos : {TravelEotvos::rotating, TravelEotvos::both, TravelEotvos::off}) {
      s.travel->eotvos = eotvos;
      by_all_means(s, expect_no_drift);
    }
  }
}

TEST(Travel, WithoutAWayThereIsNoDriftFromALaboratoryAtRest) {
  for (Scenario& s : voyages()) {
    s.travel->reference = TravelReference::at_rest;
    s.travel->speed_m_s = 0, s.travel->legs.clear();
    by_all_means(s, expect_no_drift);
  }
}

/// A laboratory that travels at speed 0 sees the same as one at rest.
TEST(Travel, AtSpeedZeroIsALaboratoryAtRest) {
  for (Scenario& s : voyages()) {
    s.travel->speed_m_s = 0, s.travel->legs.clear();
    const RunResult moving = run(s);
    s.travel.reset();
    if (s.platform && s.platform->motion == PlatformMotion::course) s.platform->motion = PlatformMotion::constant;
    const RunResult still = run(s);
    ASSERT_EQ(moving.rows.size(), still.rows.size());
    for (std::size_t i = 0; i < still.rows.size(); ++i) {
      const DriftRow &a = moving.rows[i], &b = still.rows[i];
      EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad);
      EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad);
      const Mat3<float128> turned = testing::extended_matrix(a.q_LB).transpose() * testing::extended_matrix(b.q_LB);
      EXPECT_LE(static_cast<double>(testing::TravellingByForce::angle_of(turned)),
                moving.attitude_bound_rad + still.attitude_bound_rad + rounding(8));
    }
    EXPECT_LT(moving.drift.attitude_bound_rad, kSmall * moving.drift.attitude_final_rad);
  }
}

/// @param of  the small number that drifts are proportional to
template <class Of>
void expect_proportional(const Scenario& scenario, const Of& of, double at, std::initializer_list<double> sizes) {
  constexpr double kOneNumber = 1e-8;  // of second order at 1e-9, and some rounding
  Scenario s = scenario;
  of(s) = at;
  const RunResult known = run(s);
  for (const double size : sizes) {
    of(s) = size;
    const RunResult made = run(s);
    ASSERT_EQ(made.status, RunStatus::completed);
    for (std::size_t i = 1; i < known.rows.size(); ++i) {
      const double expected = known.rows[i].drift_axis_rad / at, attitude = known.rows[i].drift_attitude_rad / at;
      ASSERT_GT(expected, 0);
      EXPECT_NEAR(made.rows[i].drift_axis_rad / size, expected, kOneNumber * expected) << size;
      EXPECT_NEAR(made.rows[i].drift_attitude_rad / size, attitude, kOneNumber * attitude) << size;
    }
  }
}

TEST(Travel, DriftOverOmegaIsOneNumberAtTinyRates) {
  for (const Scenario& s : voyages())
    for (const TravelEotvos eotvos : {TravelEotvos::rotating, TravelEotvos::both}) {
      Scenario one = s;
      one.travel->eotvos = eotvos;
      const auto rate = [](Scenario& of) -> double& { return of.rotation_rate_rad_s; };
      expect_proportional(one, rate, 1e-12, {1e-15, 1e-30, 1e-300});
      // With `both` the reference, too, feels 2 Omega v, which is 1e-8 of gravity at 1e-9 rad/s.
      if (eotvos == TravelEotvos::rotating) expect_proportional(one, rate, 1e-9, {1e-300});
    }
}

TEST(Travel, DriftFromALaboratoryAtRestOverTheSpeedIsOneNumberAtTinySpeeds) {
  for (Scenario s : voyages()) {
    s.travel->reference = TravelReference::at_rest;
    s.travel->legs.clear();
    const auto speed = [](Scenario& of) -> double& { return of.travel->speed_m_s; };
    expect_proportional(s, speed, 1e-6, {1e-9, 1e-100, 1e-294});
  }
}

/// The rows by all observers, methods and forms are apart by no more than their bounds, which are small.
TEST(Travel, ObserversAndMethodsAgreeWithinTheirBounds) {
  for (Scenario& s : voyages())
    for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest}) {
      s.travel->reference = reference;
      const RunResult known = run(s);
      by_all_means(s, [&](Scenario scenario) {
        scenario.numerics.relative_tolerance = 1e-13;
        const RunResult made = run(scenario);
        ASSERT_EQ(made.status, RunStatus::completed);
        for (std::size_t i = 0; i < known.rows.size(); ++i) {
          const DriftRow &a = made.rows[i], &b = known.rows[i];
          EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad);
          EXPECT_NEAR(a.drift_attitude_rad, b.drift_attitude_rad, a.drift_attitude_bound_rad + b.drift_attitude_bound_rad);
        }
        EXPECT_LT(made.drift.attitude_bound_rad, kSmall * made.drift.attitude_final_rad);
      });
    }
}

/// In the axes of each observer the torques sum up to the rate of the momentum, and the transverse torque of the laboratory's observer is
/// that of the journey, -Theta alpha_IL.
TEST(TravelLedger, ClosesAndHasTheTransverseTorqueOfTheJourney) {
  for (Scenario s : {voyages()[0], voyages()[1], voyages()[3], voyages()[4]})
    for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest})
      for (const LedgerObserver observer :
           {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
        s.travel->reference = reference;
        s.ledger = observer;
        SCOPED_TRACE(to_string(observer));
        const RunResult result = run(s);
        ASSERT_TRUE(result.ledger);
        EXPECT_LT(result.ledger->largest.relative_residual(), 4e-15);  // some twenty roundings of the largest torque
        if (observer != LedgerObserver::laboratory) continue;
        const testing::TravellingByForce force(s);
        const Body<float128> body = Scene(s).body<float128>();
        for (std::size_t i = 0; i < result.rows.size(); ++i) {
          const float128 t = result.rows[i].t_s;
          const auto way = i == 0 ? force.start() : force.way_at(t);
          const auto laboratory = force.both(force.place(way, t), t)[0];
          const Mat3<float128> R = testing::extended_matrix(result.rows[i].q_LB);
          const Vec3<float128> expected = -(R * (body.I_BP_B * (R.transpose() * laboratory.alpha)));
          const double size = static_cast<double>(norm(Vec3<float128>(body.I_BP_B.diagonal())) * norm(laboratory.alpha));
          ASSERT_GT(size, 0);
          const auto& made = result.ledger->entries[i].tau_trans_A;
          for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(made[j], static_cast<double>(expected[static_cast<int>(j)]), 1e-10 * size)
                << result.rows[i].t_s;  // of alpha in double
        }
      }
}

/// A vehicle has turned, clockwise from above, by what its course has changed, by a leg and by the path of a geodesic.
TEST(TravelPlatform, TurnsWithTheCourse) {
  Scenario s = voyages()[4];
  s.travel->speed_m_s = 2000, s.travel->legs[1].turn_deg = 70, s.travel->legs[1].speed_m_s.reset();
  const Scene scene(s);
  const PrescribedMotion<float128>& turn = scene.model<float128>().platform.turn;
  const testing::TravellingByForce force(s);
  const auto course = [&](double t_s) { return t_s == 0 ? force.start()[2] : force.way_at(t_s)[2]; };
  EXPECT_EQ(turn.angle(0), 0);
  // The quotients err by the step's square times a sixth of the third derivative, and a twelfth of the fourth.
  constexpr double kStep_s = 1e-5;
  for (const double t_s : {0.07, 0.13, 0.19, 0.4}) {
    const float128 turned = course(0) - course(t_s);
    EXPECT_NEAR(static_cast<double>(turn.angle(t_s) - turned), 0, 1e-22) << t_s;  // as the force's integration of the path
    const float128 before = course(t_s - kStep_s), after = course(t_s + kStep_s);
    const double rate = static_cast<double>(turn.angle_rate(t_s)),
                 acceleration = static_cast<double>(turn.angle_acceleration(t_s));
    EXPECT_NEAR(rate, static_cast<double>((before - after) / (2 * kStep_s)), 4e3 * kStep_s * kStep_s) << t_s;
    EXPECT_NEAR(acceleration, static_cast<double>((2 * course(t_s) - before - after) / (kStep_s * kStep_s)),
                1e5 * kStep_s * kStep_s)
        << t_s;
    EXPECT_LE(std::abs(rate), static_cast<double>(turn.largest_rate(s.duration_s)));
    if (t_s > 0.1 && t_s < 0.25) {
      EXPECT_GT(std::abs(rate), 1) << t_s;
    }
  }
}

/// The transport rate's part is all of the Coriolis torque where the Earth stands still, and the rest is linear in the Earth's rate.
TEST(TravelLedger, TellsTheTransportRatesPartOfTheCoriolisTorque) {
  for (Scenario s : {voyages()[0], voyages()[2]})
    for (const LedgerObserver observer : {LedgerObserver::laboratory, LedgerObserver::inertial}) {
      s.ledger = observer;
      s.rotation_rate_rad_s = 0;
      const auto still = run(s).ledger->entries;
      s.rotation_rate_rad_s = kEarthRateWgs84;
      const auto turning = run(s).ledger->entries;
      const auto length = [](const std::array<double, 3>& v) { return real::hypot(v[0], v[1], v[2]); };
      for (std::size_t j = 0; j < 3; ++j) {
        for (const auto& entry : still)
          EXPECT_NEAR(entry.tau_cor_transport_A[j], entry.tau_cor_A[j], rounding(40) * std::abs(entry.tau_cor_A[j]));
        // At the release both have the same attitude and rates.
        EXPECT_NEAR(turning[0].tau_cor_transport_A[j], still[0].tau_cor_A[j], rounding(40) * length(still[0].tau_cor_A));
      }
      const double size = length(turning.back().tau_cor_transport_A), all = length(turning.back().tau_cor_A);
      if (observer == LedgerObserver::inertial) {
        EXPECT_EQ(size, 0);
      } else {
        EXPECT_GT(size, 0.01 * all);
        EXPECT_LT(size, all);
      }
    }
}

TEST(TravelLedger, OfASuspensionCloses) {
  Scenario s = voyages()[2];
  for (const LedgerObserver observer : {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::body}) {
    s.ledger = observer;
    const RunResult result = run(s);
    ASSERT_TRUE(result.ledger);
    const LedgerLargest& l = result.ledger->largest;
    const double largest = std::max({l.tau_phys, l.tau_cor, l.tau_trans, l.tau_cent, l.dL_dt, l.bearing});
    EXPECT_LT(l.residual, 1e-13 * largest) << to_string(observer);  // sums over all parts
  }
}

TEST(TravelResults, RowsAndSummarySayWhereItIs) {
  Scenario s = voyages()[0];
  const RunResult result = run(s);
  const std::string csv = trajectory_csv(result);
  const std::string header = csv.substr(0, csv.find('\n'));
  EXPECT_TRUE(
      header.ends_with(",latitude_deg,longitude_deg,height_m,course_deg,speed_m_s,w_IL_L_x_rad_s,w_IL_L_y_rad_s,"
                       "w_IL_L_z_rad_s,G_L_x_m_s2,G_L_y_m_s2,G_L_z_m_s2"))
      << header;
  const testing::TravellingByForce force(s);
  for (const DriftRow& row : result.rows) {
    ASSERT_TRUE(row.journey);
    const auto way = row.t_s == 0 ? force.start() : force.way_at(row.t_s);
    const auto place = force.place(way, row.t_s);
    constexpr double kDegrees = 180 / std::numbers::pi;
    EXPECT_NEAR(row.journey->latitude_deg, static_cast<double>(way[0]) * kDegrees, rounding(400 * 41));
    EXPECT_NEAR(row.journey->longitude_deg, static_cast<double>(way[1]) * kDegrees, rounding(400 * 1));
    EXPECT_NEAR(row.journey->course_deg, static_cast<double>(way[2]) * kDegrees, rounding(400 * 130));
    EXPECT_NEAR(row.journey->height_m, static_cast<double>(place.height.value), rounding(4 * 900));
    const auto laboratory = force.both(place, row.t_s)[0];
    constexpr double kSeries = 1e-12;  // some hundred roundings, of derivatives of series
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_NEAR(row.journey->w_IL_L_rad_s[at], static_cast<double>(laboratory.w[i]),
                  kSeries * static_cast<double>(norm(laboratory.w)));
      EXPECT_NEAR(row.journey->G_L_m_s2[at], static_cast<double>(laboratory.felt[i]),
                  kSeries * static_cast<double>(norm(laboratory.felt)));
    }
  }
  EXPECT_EQ(result.rows.back().journey->speed_m_s, 59.5);
  const nlohmann::json travel = testing::parse_json(summary_json(result)).at("travel");
  const auto number = [&](const char* key) { return travel.at(key).get<double>(); };
  EXPECT_EQ(travel.at("reference"), "same_path");
  EXPECT_EQ(travel.at("eotvos"), "rotating");
  EXPECT_NEAR(number("length_m"), 60 * 0.1 + 59.75 * 0.15 + 59.5 * 0.25, rounding(100 * 30));
  const auto& last = *result.rows.back().journey;
  EXPECT_EQ(number("end_latitude_deg"), last.latitude_deg);
  EXPECT_EQ(number("end_longitude_deg"), last.longitude_deg);
  EXPECT_EQ(number("end_height_m"), last.height_m);
  double rate = 0;
  for (double t_s = 0; t_s <= s.duration_s; t_s += 0.01) {
    const auto at = force.place(t_s == 0 ? force.start() : force.way_at(t_s), t_s);
    rate = std::max(rate, static_cast<double>(norm(force.laboratory(at, 0, 0).w)));
  }
  EXPECT_NEAR(number("transport_rate_rad_s"), rate, 1e-4 * rate);  // looks at other times; the turn changes it by 1e-3 in all
  EXPECT_NEAR(number("transport_over_earth"), number("transport_rate_rad_s") / s.rotation_rate_rad_s, rounding(4 * 0.1));
}

/// Derivatives by what a journey begins with against differences of runs.
TEST(TravelSensitivity, IsThatOfMovedInputs) {
  for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest}) {
    Scenario s = testing::asymmetric_top();
    s.site.latitude_deg = 33;
    s.duration_s = s.output_step_s = 0.4;
    s.travel = sailing(TravelPath::rhumb, 50, 120);
    s.travel->reference = reference;
    s.sensitivities = true;
    const auto report = run(s).sensitivities;
    ASSERT_TRUE(report);
    ASSERT_TRUE(report->unavailable.empty()) << report->unavailable;
    s.sensitivities = false;
    const auto drift_of = [](const Scenario& moved) { return run(moved).drift.axis_final_rad; };
    int found = 0;
    const auto expect = [&](const char* name, double step, auto number) {
      const auto input = std::ranges::find(report->inputs, std::string_view(name), &InputSensitivity::name);
      ASSERT_NE(input, report->inputs.end()) << name;
      ASSERT_TRUE(input->unavailable.empty()) << input->unavailable;
      // The quotient of five points errs by step^4.
      const auto at = [&](double share) {
        Scenario moved = s;
        number(moved) += share * step;
        return drift_of(moved);
      };
      const double expected = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
      constexpr double kOfQuotient = 1e-6;  // the quotients' own, of runs at 1e-12
      EXPECT_NEAR(input->axis_rad, expected, kOfQuotient * std::abs(expected)) << name;
      EXPECT_LT(input->axis_bound_rad, 1e-3 * std::abs(expected)) << name;
      ++found;
    };
    expect("travel_speed_m_s", 2, [](Scenario& x) -> double& { return x.travel->speed_m_s; });
    expect("travel_course_deg", 0.5, [](Scenario& x) -> double& { return x.travel->course_deg; });
    expect("latitude_deg", 0.5, [](Scenario& x) -> double& { return x.site.latitude_deg; });
    EXPECT_EQ(found, 3);
  }
}

}  // namespace
}  // namespace earthtop
