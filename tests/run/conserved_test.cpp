// SPDX-License-Identifier: GPL-3.0-or-later
/// What is reported as conserved, and may be named in a criterion, on each support: names and units are part of the interface.
#include "earthtop/model/conserved.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "earthtop/run.hpp"
#include "scenario/quantities.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"
#include "support/rotor_scenes.hpp"
#include "support/scenes.hpp"
#include "support/travel_scenes.hpp"

namespace earthtop::conserved_run {
namespace {

using Names = std::vector<std::string>;

/// The quantities that a run reports, with their units, each of which has to be constant.
Names reported(Scenario scenario) {
  scenario.duration_s = 0.5, scenario.output_step_s = 0.05;
  Names names;
  for (const InvariantReport& invariant : run(scenario).invariants) {
    names.push_back(invariant.name + " " + invariant.unit);
    EXPECT_GT(invariant.scale, 0) << invariant.name;
    EXPECT_LT(invariant.largest_change, 1e-11 * invariant.scale) << invariant.name;  // a hundred times the runs' tolerance
  }
  return names;
}

TEST(Conserved, OnAPivot) {
  EXPECT_EQ(reported(testing::toy_top()), (Names{"jacobi_integral J", "reference_energy J", "inertial_spin rad/s"}));
  EXPECT_EQ(reported(testing::asymmetric_top()), (Names{"jacobi_integral J", "reference_energy J"}));
  Scenario braked = testing::toy_top();
  braked.effects.applied.viscous_N_m_s = 1e-8;
  EXPECT_EQ(reported(braked), Names{});
}

/// Aboard, the spin of a symmetric top is kept on any journey, and the Jacobi integrals where the laboratory turns evenly: on a parallel. The
/// rate of East, North and Up by the journey is a part of all of them, 1e-7 of the Jacobi integral.
TEST(Conserved, OnAJourney) {
  const std::string jacobi = "jacobi_integral J", energy = "reference_energy J", spin = "inertial_spin rad/s",
                    rotor = "rotor_momentum kg m^2/s";
  for (const TravelReference reference : {TravelReference::same_path, TravelReference::at_rest}) {
    const auto aboard = [&](Scenario s, TravelPath path, double course_deg) {
      s.site.latitude_deg = 50;
      s.travel = testing::sailing(path, course_deg, 2500);
      s.travel->reference = reference;
      return s;
    };
    for (const double course_deg : {90.0, -90.0})
      EXPECT_EQ(reported(aboard(testing::toy_top(), TravelPath::rhumb, course_deg)), (Names{jacobi, energy, spin}));
    EXPECT_EQ(reported(aboard(testing::toy_top(), TravelPath::rhumb, 30)), Names{spin});
    EXPECT_EQ(reported(aboard(testing::toy_top(), TravelPath::geodesic, 90)), Names{spin});
    EXPECT_EQ(reported(aboard(testing::asymmetric_top(), TravelPath::rhumb, 270)), (Names{jacobi, energy}));
    EXPECT_EQ(reported(aboard(testing::asymmetric_top(), TravelPath::rhumb, 30)), Names{});
    EXPECT_EQ(reported(aboard(testing::caged_gyroscope(), TravelPath::rhumb, 30)), Names{rotor});
    EXPECT_EQ(reported(aboard(testing::caged_gyroscope(), TravelPath::rhumb, 90)), (Names{jacobi, energy, rotor}));
    Scenario speeding = aboard(testing::toy_top(), TravelPath::rhumb, 90);
    speeding.travel->legs = {{0.5, 2501, 0, 0}};
    EXPECT_EQ(reported(speeding), Names{spin});
    Scenario braked = aboard(testing::toy_top(), TravelPath::rhumb, 90);
    braked.effects.applied.viscous_N_m_s = 1e-8;
    EXPECT_EQ(reported(braked), Names{});
  }
}

TEST(Conserved, OnATable) {
  const auto on_table = [](ContactLaw law, double tip_radius_m, double table_tilt_deg) {
    ContactSpec contact{.tip_radius_m = tip_radius_m, .law = law};
    contact.sliding_viscosity_N_s_m = 0.05;
    if (law == ContactLaw::rolling) contact.start = ContactStart::rolling;
    contact.table_tilt_deg = table_tilt_deg;
    return reported(testing::scenario_of(testing::toy_on_table(contact)));
  };
  const std::string jacobi = "jacobi_integral J", energy = "reference_energy J", spin = "inertial_spin rad/s",
                    jellett = "reference_jellett_integral kg m^3/s", routh = "reference_routh_integral kg m^2 rad/s";
  EXPECT_EQ(on_table(ContactLaw::frictionless, 0.003, 0), (Names{jacobi, energy, spin, jellett}));
  EXPECT_EQ(on_table(ContactLaw::viscous, 0.003, 0), Names{jellett});
  EXPECT_EQ(on_table(ContactLaw::viscous, 0, 0), (Names{spin, jellett}));
  EXPECT_EQ(on_table(ContactLaw::rolling, 0.003, 0), (Names{jacobi, energy, jellett, routh}));
  EXPECT_EQ(on_table(ContactLaw::rolling, 0.003, 1), (Names{jacobi, energy, jellett}));
}

// A top that turns about its axis alone, on a tip at rest: I3 w3^2 / 2 + m g (r + l cos), and L_C.rho = I3 w3 (l + r cos).
TEST(Conserved, OnATableWithTheirValues) {
  Scenario s = testing::scenario_of(testing::toy_on_table({.tip_radius_m = 0.003, .law = ContactLaw::frictionless}));
  s.rotation_rate_rad_s = 0;
  s.duration_s = s.output_step_s = 0.01;
  const Scene scene(s);
  const Body<double>& body = scene.body<double>();
  const double cosine = rotation_matrix(scene.release<double>().q_LB)(2, 2), w3 = scene.release<double>().w_XB_B[2];
  ASSERT_EQ(norm(scene.release<double>().w_XB_B), std::abs(w3));
  const double r = s.contact->tip_radius_m, l = scene.problem<double>().table->contact.height_of_center;
  const RunResult result = run(s);
  const auto initial = [&](std::string_view name) {
    for (const InvariantReport& invariant : result.invariants)
      if (invariant.name == name) return invariant.initial;
    return 0.0;
  };
  const double energy = body.I_BP_B(2, 2) * w3 * w3 / 2 + body.mass * scene.site().gravity_m_s2 * (r + l * cosine);
  const double jellett = body.I_BP_B(2, 2) * w3 * (l + r * cosine);
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(initial("jacobi_integral"), energy, kRounding * energy);
  EXPECT_NEAR(initial("reference_energy"), energy, kRounding * energy);
  EXPECT_NEAR(initial("reference_jellett_integral"), jellett, kRounding * jellett);
  EXPECT_NEAR(initial("inertial_spin"), w3, kRounding * w3);
}

TEST(Conserved, AsCriteriaNameIt) {
  EXPECT_EQ(scenario::kInvariants,
            "jacobi_integral|reference_energy|inertial_spin|rotor_momentum|outer_momentum|vertical_momentum|kovalevskaya|"
            "goryachev_chaplygin");
  EXPECT_EQ(scenario::kRunNumbers, "jacobi_integral_J|reference_energy_J|critical_spin_rad_s");
}

// The unit in words, and the powers by which its numbers go from natural units to it.
TEST(Conserved, UnitsHaveTheirPowers) {
  const auto powers = [](std::string_view unit) {
    if (unit == "J") return std::array{1, 2};
    const std::size_t per = unit.find("/s");
    const int rate = per + 2 == unit.size() ? 1 : unit.back() - '0';
    return std::array{unit.starts_with("kg") ? 1 : 0, rate};
  };
  for (const auto& quantity : kConserved<double>)
    EXPECT_EQ((std::array{quantity.mass_power, quantity.rate_power}), powers(quantity.unit)) << quantity.name;
}

}  // namespace
}  // namespace earthtop::conserved_run
