// SPDX-License-Identifier: GPL-3.0-or-later
/// The balances of a run on a table: of the Jacobi integral with the work of friction, and of Jellett's integral with the Earth and
/// friction's moment; and where they are left out.
#include <gtest/gtest.h>

#include <random>

#include "earthtop/run.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"
#include "support/tolerances.hpp"

namespace earthtop::contact_balance_run {
namespace {

using Law = ContactLaw;
constexpr Law kLaws[] = {Law::frictionless, Law::viscous, Law::viscous_load, Law::coulomb, Law::contensou, Law::rolling};

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A random scene under a law: any latitude, matching rule, tip radius and slope of the table, with moments of friction or without.
Scenario random_scene(Law law, std::mt19937_64& random) {
  ContactSpec contact{.tip_radius_m = random() % 4 == 0 ? 0.0 : uniform(random, 0.001, 0.01), .law = law};
  contact.sliding_viscosity_N_s_m = 0.05, contact.sliding_viscosity_s_m = 0.1;
  contact.friction_coefficient = uniform(random, 0.05, 0.3), contact.regularisation_m_s = 0.02;
  contact.patch_radius_m = 1e-4;
  if (law == Law::rolling) contact.start = ContactStart::rolling;
  if (random() % 2 == 0) {
    contact.spinning_friction_m = 1e-5, contact.rolling_resistance_m = 1e-5, contact.regularisation_rad_s = 3;
  }
  if (random() % 3 == 0) contact.table_tilt_deg = uniform(random, 0, 3), contact.table_tilt_azimuth_deg = 70;
  testing::ContactScene scene = testing::toy_on_table(contact);
  scene.latitude_deg = uniform(random, -90, 90), scene.tilt_deg = uniform(random, 5, 40);
  scene.spin_rad_s = uniform(random, 150, 250);
  scene.rates = random() % 2 == 0 ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  Scenario s = testing::scenario_of(scene);
  s.duration_s = 0.5, s.output_step_s = 0.01;  // a top may lift off before the end
  return s;
}

double missed(const std::optional<ContactBalance>& balance) { return std::abs(balance.value().balance) / balance->size; }

// A wrong rate is off by the whole change, 1e-6 of the size and more; an integral summed from the rows, by a percent of that.
TEST(ContactBalances, HoldInRandomScenes) {
  constexpr double kAllowed = 1e-11;
  std::mt19937_64 random(23);
  double worst = 0;
  for (const Law law : kLaws)
    for (int i = 0; i < 3; ++i) {
      Scenario s = random_scene(law, random);
      const bool symmetric = i > 0;
      if (!symmetric) testing::set_principal(s.body, 3e-5, 2.7e-5, 4e-5);
      const RunResult result = run(s);
      ASSERT_EQ(result.status, RunStatus::completed);
      ASSERT_TRUE(result.contact);
      ASSERT_GT(result.rows.size(), 1U);
      for (const ContactBalances* motion : {&result.contact->rotating, &result.contact->reference}) {
        ASSERT_TRUE(motion->jacobi) << i;
        EXPECT_EQ(motion->jellett.has_value(), symmetric);
        worst = std::max({worst, missed(motion->jacobi), symmetric ? missed(motion->jellett) : 0});
        const bool rubs = (law != Law::frictionless && law != Law::rolling) || s.contact->spinning_friction_m > 0;
        if (rubs) {
          EXPECT_LT(motion->jacobi->integral, -1e-7 * motion->jacobi->size)
              << "law " << static_cast<int>(law) << ", tip " << s.contact->tip_radius_m << ", moments "
              << s.contact->spinning_friction_m;
        } else {
          EXPECT_EQ(motion->jacobi->integral, 0);
        }
      }
      // Without moments only the Earth changes Jellett's integral; on a point it does not.
      if (!symmetric || law == Law::contensou || s.contact->spinning_friction_m > 0) continue;
      EXPECT_EQ(result.contact->reference.jellett->integral, 0);
      const bool pole = s.site.latitude_deg == 90;
      EXPECT_EQ(result.contact->rotating.jellett->integral != 0, s.contact->tip_radius_m > 0 && !pole);
    }
  RecordProperty("worst_in_1e_18", static_cast<int>(worst * 1e18));
  EXPECT_LT(worst, kAllowed);
}

TEST(ContactBalances, HoldAcrossTheStopOfTheSlip) {
  Scenario s =
      testing::scenario_of(testing::toy_on_table({.tip_radius_m = 0.002, .law = Law::coulomb, .friction_coefficient = 0.2}));
  s.duration_s = 0.06, s.output_step_s = 0.03;
  const RunResult result = run(s);
  ASSERT_EQ(result.contact->events.size(), 2U);
  for (const ContactBalances* motion : {&result.contact->rotating, &result.contact->reference}) {
    EXPECT_LT(missed(motion->jacobi), testing::rounding(200));
    EXPECT_LT(missed(motion->jellett), testing::rounding(200));
    EXPECT_LT(motion->jacobi->integral, -1e-4 * motion->jacobi->size);
  }
}

TEST(ContactBalances, AreRoundOffInFloat128) {
  Scenario s = testing::scenario_of(testing::toy_on_table(
      {.tip_radius_m = 0.002, .law = Law::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4}));
  s.duration_s = s.output_step_s = 0.002, s.precision = Precision::bits113;
  s.numerics.relative_tolerance = 1e-30;
  const RunResult result = run(s);
  for (const ContactBalances* motion : {&result.contact->rotating, &result.contact->reference}) {
    EXPECT_LT(missed(motion->jacobi), testing::rounding<float128>(100));
    EXPECT_LT(missed(motion->jellett), testing::rounding<float128>(100));
  }
}

TEST(ContactBalances, AreLeftOutWhereTheyDoNotHold) {
  Scenario s = testing::scenario_of(testing::toy_on_table(
      {.tip_radius_m = 0.002, .law = Law::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4}));
  s.duration_s = s.output_step_s = 0.02;
  const auto found = [&](const auto& change) {
    Scenario changed = s;
    change(changed);
    const RunResult result = run(changed);
    return std::pair(result.contact->rotating.jellett.has_value(), result.contact->rotating.jacobi.has_value());
  };
  using Both = std::pair<bool, bool>;
  EXPECT_EQ(found([](Scenario&) {}), Both(true, true));
  EXPECT_EQ(found([](Scenario& x) { x.effects.coriolis = false; }), Both(false, false));
  EXPECT_EQ(found([](Scenario& x) { x.effects.applied.gravity_gradient.emplace().gm_over_r3_s2 = 0.5; }), Both(false, false));
  EXPECT_EQ(found([](Scenario& x) {
              x.effects.tide.emplace().given = true;
              x.effects.tide->amplitude_m_s2 = {0.5, 0, 0}, x.effects.tide->frequency_hz = 1;
            }),
            Both(true, false));
  EXPECT_EQ(found([](Scenario& x) { x.numerics.observer = Observer::inertial; }), Both(false, false));
}

// Jellett's integral without moments and without the Earth, Routh's of pure rolling on a level table only: in the runs' own report.
TEST(ContactBalances, IntegralsOfRollingAreConstant) {
  std::mt19937_64 random(5);
  int routh = 0;
  for (int i = 0; i < 8; ++i) {
    const Scenario s = random_scene(i % 4 == 3 ? Law::contensou : Law::rolling, random);
    const RunResult result = run(s);
    const bool pure = s.contact->law == Law::rolling && s.contact->spinning_friction_m == 0;
    bool has_jellett = false, has_routh = false;
    for (const InvariantReport& invariant : result.invariants) {
      EXPECT_LT(invariant.largest_change, 1e-11 * invariant.scale) << invariant.name;
      has_jellett = has_jellett || invariant.name == "reference_jellett_integral";
      has_routh = has_routh || invariant.name == "reference_routh_integral";
    }
    EXPECT_EQ(has_jellett, pure);
    EXPECT_EQ(has_routh, pure && s.contact->table_tilt_deg == 0);
    routh += has_routh ? 1 : 0;
  }
  EXPECT_GT(routh, 0);
}

}  // namespace
}  // namespace earthtop::contact_balance_run
