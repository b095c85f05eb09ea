// SPDX-License-Identifier: GPL-3.0-or-later
/// More random journeys than the gate has, and the reference values in 113 bits.
#include <gtest/gtest.h>

#include "earthtop/drift/drift_integration.hpp"
#include "support/gimbal_references.hpp"
#include "support/gyrostat_references.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"
#include "support/travel_runs.hpp"

namespace earthtop {
namespace {

TEST(Travel, SixtyJourneysDriftAsTheirPlacesInSpaceSay) {
  for (std::uint64_t seed = 1000; seed < 1060; ++seed) testing::expect_as_by_force(testing::random_journey(seed, 20));
}

TEST(Travel, BoundsOfAHundredJourneysHoldAndAreClose) {
  for (std::uint64_t seed = 2000; seed < 2100; ++seed)
    testing::expect_sound(testing::random_journey(seed, 40), seed % 2 == 0 ? Observer::inertial : Observer::body);
}

TEST(Travel, MeetsItsReferencesIn113Bits) {
  // The digits that are printed: 25 of motions, the last two of which may differ, and 20 of drifts.
  constexpr double kOfMotion = testing::reference(23, 10), kOfDrift = testing::reference(20, 10);
  for (const nlohmann::json& reference : testing::travel_references().at("cases")) {
    const std::string name = reference.at("name").get<std::string>();
    const bool gimbals = reference.at("scenario").contains("gimbals");
    if (name == "T1 both" || name == "T7") continue;  // drifts of the axis alone; a day and a half
    // Integrations of minutes have one observer each.
    const Observer own = name == "T3" || name == "T8"   ? Observer::body
                         : name == "T2" || name == "T4" ? Observer::inertial
                                                        : Observer::laboratory;
    const std::vector<Observer> every{Observer::laboratory, Observer::inertial}, one{own};
    for (const Observer observer : gimbals ? every : one) {
      SCOPED_TRACE(name + ", " + std::string(to_string(observer)));
      IntegrationOptions options;
      const bool series = gimbals || reference.at("scenario").contains("rotor");  // of 113 bits there are those alone
      options.method = series ? Method::taylor : Method::extrapolation;
      options.observer = observer, options.form = ModelForm::general;
      options.relative_tolerance = 1e-28;
      DriftProblem<float128> problem = Scene(testing::travel_scenario(reference)).problem<float128>();
      const auto made = integrate_drift(problem, options);
      ASSERT_EQ(made.status, RunStatus::completed);
      if (gimbals) {
        const auto errors = testing::gimbal_errors(reference, made);
        EXPECT_LT(errors.motion, kOfMotion);
        EXPECT_LT(errors.relative_drift, kOfDrift);
      } else {
        const auto errors = testing::gyrostat_errors(reference, made);
        EXPECT_LT(errors.motion, kOfMotion);
        EXPECT_LT(errors.relative_drift, kOfDrift);
      }
    }
  }
}

}  // namespace
}  // namespace earthtop
