// SPDX-License-Identifier: GPL-3.0-or-later
// Where exact dry friction ends a slip: the instant is found, and the run goes on rolling, whatever the slip at release was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bounds/table_strata.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {
namespace {

using testing::Random;

/// A small heavy top at the North Pole, let go with its centre of mass at rest and the rates of inertial space.
Scenario heavy_pin() {
  Scenario s;
  s.name = "heavy-pin";
  s.site = {90, 0, 0, 9.80665};
  s.body.mass_kg = 0.117874;
  s.body.center_of_mass_m = {0, 0, 0.0121292};
  testing::set_principal(s.body, 4.9646e-06, 4.9646e-06, 2.28339e-06);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.release.tilt_deg = 3.17, s.release.azimuth_deg = 159.9, s.release.spin_angle_deg = 343.5;
  s.release.spin_rad_s = 475.039;
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.contact = ContactSpec{.tip_radius_m = 0.00462171,
                          .law = ContactLaw::coulomb,
                          .friction_coefficient = 0.04132,
                          .start = ContactStart::center_of_mass_at_rest};
  s.duration_s = 0.5295, s.output_step_s = 0.05295;
  return s;
}

std::vector<ContactEvent> stops_of(const RunResult& result) {
  std::vector<ContactEvent> stops;
  for (const ContactEvent& event : result.contact->events)
    if (event.kind == ContactEventKind::slip_stopped) stops.push_back(event);
  return stops;
}

/// A top, a tippe top or a ball under the exact law of dry friction: with hardly any or much of it, with its centre of mass at rest,
/// with a slip from next to none to a large one, on level and tilted tables.
Scenario slipping(std::uint64_t index) {
  const auto exact = std::ranges::find(testing::table_strata(), std::string_view("coulomb, exact"), &testing::Stratum::name);
  for (std::uint64_t attempt = 0;; ++attempt) {
    Scenario s = testing::random_scene_on_table(*exact, index + 100'000 * attempt, 2, 400);
    Random random(977 * index + 31 + 1'000'003 * attempt);
    ContactSpec& contact = *s.contact;
    contact.friction_coefficient = random.log_uniform(3e-3, 1);
    const double start = random.uniform(0, 1);
    if (start < 0.4) {
      contact.start = ContactStart::center_of_mass_at_rest, contact.tip_velocity_m_s = {0, 0};
    } else if (start < 0.6) {
      // Nearly rolling.
      const Mat3<double> R_LB =
          rotation_matrix(release_attitude<double>(s.release.tilt_deg, s.release.azimuth_deg, s.release.spin_angle_deg));
      const double rolling = contact.tip_radius_m * s.release.spin_rad_s, slip = random.log_uniform(1e-7, 1e-2);
      const double direction = random.uniform(-3, 3);
      contact.start = ContactStart::tip_velocity;
      contact.tip_velocity_m_s = {rolling * R_LB(1, 2) + slip * std::cos(direction),
                                  -rolling * R_LB(0, 2) + slip * std::sin(direction)};
    }
    if (!examine_scenario({"slipping", canonical_json(s), false}).error_count) return s;
  }
}

// The reference's time is that of Newton's and Euler's equations about the centre of mass, integrated in 64 bits by a program that
// shares nothing with this one; that of the drift, and the difference of the stops, are of a run in 113 bits, whose reference stops
// at the same time in every printed digit.
TEST(SlipStops, OfATopWhoseCentreOfMassIsAtRestIsFound) {
  constexpr double kStop_s = 0.06113932359385964, kApart_s = 4.2438395722178963e-8, kAxis_rad = 5.677208067731272e-7;
  constexpr double kTime = 1e-11, kDifference = 1e-10;  // relative, as of the other stops (contact_stop_test)
  const RunResult result = run(heavy_pin());
  ASSERT_EQ(result.status, RunStatus::completed);
  const auto stops = stops_of(result);
  ASSERT_EQ(stops.size(), 2U);
  EXPECT_EQ(stops[0].prediction, Prediction::reference);
  EXPECT_NEAR(stops[0].t_s / kStop_s, 1, kTime);
  EXPECT_NEAR(stops[1].t_s / (kStop_s + kApart_s), 1, kTime);
  EXPECT_NEAR(*stops[0].time_difference_s / kApart_s, 1, kDifference);
  EXPECT_EQ(result.contact->events.size(), 2U);  // rolling needs less friction than there is
  EXPECT_EQ(result.rows.size(), 11U);
  EXPECT_NEAR(result.drift.axis_final_rad, kAxis_rad, result.drift.axis_bound_rad);
  EXPECT_LT(result.drift.axis_bound_rad, 1e-9 * kAxis_rad);
}

TEST(SlipStops, EveryRunEndsWithANamedOutcome) {
  constexpr std::uint64_t kScenes = 120;
  int stopped = 0, started = 0, sliding = 0;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const Scenario scenario = slipping(i);
    const RunResult result = run(scenario);
    EXPECT_EQ(result.status, RunStatus::completed) << i << ' ' << canonical_json(scenario);
    if (result.status != RunStatus::completed || !result.contact) continue;
    const auto stops = stops_of(result);
    // Both predictions stop, close to each other, or none.
    ASSERT_TRUE(stops.empty() || stops.size() == 2U) << i;
    const bool starts = std::ranges::any_of(
        result.contact->events, [](const ContactEvent& event) { return event.kind == ContactEventKind::slip_started; });
    stopped += !stops.empty(), started += starts, sliding += stops.empty() && !starts;
    for (const DriftRow& row : result.rows) {
      if (stops.empty()) continue;
      if (row.t_s < stops.front().t_s) {
        EXPECT_GT(row.contact->ref_slip_m_s, 0) << i << " at " << row.t_s;
      }
      if (row.t_s > stops.back().t_s) {
        EXPECT_EQ(row.contact->ref_slip_m_s, 0) << i << " at " << row.t_s;
      }
    }
  }
  // The family has all of these.
  EXPECT_GT(stopped, 40);
  EXPECT_GT(started, 0);
  EXPECT_GT(sliding, 10);
}

// A point tip under a centre of mass at rest has a slip of rounding alone: it rolls from its release on, and so do the predictions
// that are moved with the inputs.
TEST(SlipStops, WithoutASlipAtReleaseTheMovedPredictionsRollToo) {
  Scenario s = testing::toy_top();
  s.body.inertia_about = InertiaAbout::center_of_mass;
  testing::set_principal(s.body, 7.8e-5, 7.8e-5, 4.3e-5);
  s.body.center_of_mass_m = {0, 0, 0.024};
  s.release.tilt_deg = 0.0027, s.release.spin_rad_s = -224;
  s.contact =
      ContactSpec{.law = ContactLaw::coulomb, .friction_coefficient = 0.117, .start = ContactStart::center_of_mass_at_rest};
  s.duration_s = 0.2, s.output_step_s = 0.02;
  const RunResult result = run(s);
  ASSERT_EQ(result.status, RunStatus::completed);
  EXPECT_TRUE(result.contact->events.empty());
  ASSERT_FALSE(result.contact->changes.empty());
  for (const PredictionChange& change : result.contact->changes)
    if (change.input == "friction_coefficient") {
      EXPECT_EQ(change.axis_rad, 0);
    } else {
      EXPECT_GT(change.axis_rad, 0) << change.input;
    }
}

}  // namespace
}  // namespace earthtop
