// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of laboratories that travel against reference values of 20 digits, which two formulations written apart agree on: tops and free
/// bodies, suspensions, a gyrostat on a platform; and against the journey by brute force.
#include <gtest/gtest.h>

#include <algorithm>

#include "earthtop/run.hpp"
#include "support/soundness.hpp"
#include "support/travel_runs.hpp"

namespace earthtop {
namespace {

using nlohmann::json;
using testing::travel_references;
using testing::travel_scenario;

/// What a run in double promises, of a motion (relative to the largest value of the same quantity, of an angle in rad) and of a drift
/// (relative to its largest value).
constexpr double kOfMotion = 1e-11, kOfDrift = 1e-9;
/// What methods of steps leave at 1e-14 over a thousand radians, as a multiple of that.
constexpr double kSteps = 10;

double printed(const json& text) { return testing::printed<double>(text); }

/// A pair of numbers of a row, and their largest sizes in the run.
struct Pair {
  double first, second;
};
Pair largest(const RunResult& result, Pair (*of)(const DriftRow&)) {
  Pair most{0, 0};
  for (const DriftRow& row : result.rows) {
    const Pair here = of(row);
    most = {std::max(most.first, std::abs(here.first)), std::max(most.second, std::abs(here.second))};
  }
  return most;
}
void expect_pair(const json& row, const char* name, const Pair& made, const Pair& allowed) {
  if (!row.contains(name)) return;
  EXPECT_NEAR(made.first, printed(row.at(name).at(0)), allowed.first) << name;
  EXPECT_NEAR(made.second, printed(row.at(name).at(1)), allowed.second) << name;
}

void expect_attitude(const std::array<double, 4>& q, const json& known, double allowed) {
  const double sign = q[0] * printed(known.at(0)) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(sign * q[i], printed(known.at(i)), allowed) << i;
}

Pair rotor_of(const DriftRow& r) { return r.rotor ? Pair{r.rotor->rate_rad_s, r.rotor->angle_rad} : Pair{0, 0}; }
Pair rates_of(const DriftRow& r) {
  return r.gimbals ? Pair{r.gimbals->outer_rate_rad_s, r.gimbals->inner_rate_rad_s} : Pair{0, 0};
}
Pair rotor_drift_of(const DriftRow& r) {
  return r.rotor ? Pair{r.rotor->drift_rate_rad_s, r.rotor->drift_angle_rad} : Pair{0, 0};
}
Pair angle_drift_of(const DriftRow& r) {
  return r.gimbals ? Pair{r.gimbals->drift_outer_angle_rad, r.gimbals->drift_inner_angle_rad} : Pair{0, 0};
}
Pair times(double factor, const Pair& p) { return {factor * p.first, factor * p.second}; }

void expect_motion(const json& known, const DriftRow& row, const RunResult& result, double allowed) {
  const bool earth = known.at("kind") == "E";
  if (known.contains("q_LB")) expect_attitude(earth ? row.q_LB : row.ref_q_LB, known.at("q_LB"), allowed);
  if (row.rotor)
    expect_pair(known, "rotor", earth ? rotor_of(row) : Pair{row.rotor->ref_rate_rad_s, row.rotor->ref_angle_rad},
                times(allowed, largest(result, rotor_of)));
  if (!row.gimbals) return;
  const auto& g = *row.gimbals;
  const Pair turned{allowed * std::max(1.0, std::abs(g.outer_angle_rad)), allowed};
  expect_pair(known, "angles",
              earth ? Pair{g.outer_angle_rad, g.inner_angle_rad} : Pair{g.ref_outer_angle_rad, g.ref_inner_angle_rad}, turned);
  constexpr double kSlow = 1e-3;  // rad/s: slower gimbals are held up by a rotor, whose rounding they get
  const Pair fastest = largest(result, rates_of);
  expect_pair(known, "rates", earth ? rates_of(row) : Pair{g.ref_outer_rate_rad_s, g.ref_inner_rate_rad_s},
              {allowed * (kSlow + fastest.first), allowed * (kSlow + fastest.second)});
}

void expect_drift(const json& known, const DriftRow& row, const RunResult& result, double allowed) {
  double axis = 0, attitude = 0, rotor_axis = 0;
  for (const DriftRow& one : result.rows) {
    axis = std::max(axis, one.drift_axis_rad), attitude = std::max(attitude, one.drift_attitude_rad);
    if (one.rotor) rotor_axis = std::max(rotor_axis, one.rotor->drift_axis_rad);
  }
  if (known.contains("axis")) {
    const bool of_rotor = row.gimbals.has_value();
    EXPECT_NEAR(of_rotor ? row.rotor->drift_axis_rad : row.drift_axis_rad, printed(known.at("axis")),
                allowed * (of_rotor ? rotor_axis : axis));
  }
  if (known.contains("attitude")) {
    EXPECT_NEAR(row.drift_attitude_rad, printed(known.at("attitude")), allowed * attitude);
  }
  if (row.rotor) expect_pair(known, "rotor", rotor_drift_of(row), times(allowed, largest(result, rotor_drift_of)));
  if (row.gimbals) expect_pair(known, "angles", angle_drift_of(row), times(allowed, largest(result, angle_drift_of)));
}

void expect_references(const json& reference, const RunResult& result, double times_as_much = 1) {
  ASSERT_EQ(result.status, RunStatus::completed);
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable);
  for (const json& known : reference.at("rows")) {
    const double t_s = known.at("t_s").get<double>();
    const auto row = std::ranges::find(result.rows, t_s, &DriftRow::t_s);
    ASSERT_NE(row, result.rows.end()) << t_s;
    SCOPED_TRACE(known.at("kind").get<std::string>() + " at " + std::to_string(t_s));
    if (known.at("kind") == "D")
      expect_drift(known, *row, result, times_as_much * kOfDrift);
    else
      expect_motion(known, *row, result, times_as_much * kOfMotion);
  }
}

TEST(Travel, RunsMeetTheirReferences) {
  for (const json& reference : travel_references().at("cases")) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    expect_references(reference, run(travel_scenario(reference)));
  }
}

/// The same by every observer and by methods of other kinds.
TEST(Travel, EveryObserverAndMethodMeetsTheReferences) {
  for (const json& reference : travel_references().at("cases")) {
    const std::string name = reference.at("name").get<std::string>();
    if (name == "T7") continue;  // a day and a half
    for (const char* observer : {"laboratory", "body", "inertial"})
      for (const char* method : {"taylor", "steps", "extrapolation"}) {
        const json& scene = reference.at("scenario");
        if (scene.contains("gimbals") && observer == std::string_view("body")) continue;  // there are no such equations
        if (method == std::string_view("steps")) method = scene.contains("rotor") ? "rkf78" : "dop853";
        SCOPED_TRACE(name + ", " + observer + ", " + method);
        const Scenario s = travel_scenario(
            reference,
            {{"/numerics/observer", observer}, {"/numerics/method", method}, {"/numerics/relative_tolerance", "1e-14"}});
        expect_references(reference, run(s), method == std::string_view("taylor") ? 1 : kSteps);
      }
  }
}

/// Random journeys: a run's drift is that of the places in space, within its own bound.
TEST(Travel, DriftsAsItsPlacesInSpaceSay) {
  for (std::uint64_t seed = 100; seed < 106; ++seed) testing::expect_as_by_force(testing::random_journey(seed, 12));
}
/// And that of the same equations in 113 bits.
TEST(Travel, BoundsHoldAndAreClose) {
  for (std::uint64_t seed = 200; seed < 206; ++seed)
    testing::expect_sound(testing::random_journey(seed, 60), seed % 2 == 0 ? Observer::inertial : Observer::body);
}

}  // namespace
}  // namespace earthtop
