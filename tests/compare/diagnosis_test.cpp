// SPDX-License-Identifier: GPL-3.0-or-later
/// Mistakes of a small engine, each of which a comparison names, on three scenarios.
#include <gtest/gtest.h>

#include "compare/mistaken_files.hpp"

namespace earthtop {
namespace {

using namespace mistaken;

class DiagnosisOf : public ::testing::TestWithParam<std::tuple<Ground, Told>> {};

TEST_P(DiagnosisOf, NamesEveryMistakeAndNoOther) {
  const auto& [ground, told] = GetParam();
  const Bench bench(ground);
  {
    const PairReport pair = bench.compared(SmallEngine::csv(bench.rows(bench.right()), 17, told), "", told);
    EXPECT_TRUE(pair.passed()) << all_of(pair.hints);
    EXPECT_TRUE(pair.hints.empty()) << all_of(pair.hints);
  }
  for (const Case& one : cases()) {
    SmallEngine engine = bench.right();
    if (one.physics) one.physics(engine);
    std::vector<State> rows = bench.rows(engine);
    if (one.writing) one.writing(rows, engine);
    const PairReport pair = bench.compared(SmallEngine::csv(rows, one.digits, told), "", told);
    const std::string text = all_of(pair.hints);
    const std::string context = std::string(ground.name) + ", " + one.name + ": " + text;
    if (told == Told::axes && one.needs_attitude) continue;  // an axis made of such numbers is none
    if (told != Told::attitudes_and_rates && one.needs_rates) {
      EXPECT_TRUE(pair.passed()) << context;
      continue;
    }
    EXPECT_FALSE(pair.passed()) << context;
    EXPECT_EQ(pair.hints.size(), 1u) << context;
    EXPECT_TRUE(is_named(one, text)) << context;
    EXPECT_EQ(others_named(text, {&one}), "") << context;
  }
}

INSTANTIATE_TEST_SUITE_P(OnThreeScenarios, DiagnosisOf,
                         ::testing::Combine(::testing::ValuesIn(mistaken::kGrounds),
                                            ::testing::Values(Told::attitudes_and_rates, Told::attitudes, Told::axes)),
                         [](const auto& info) {
                           std::string name = std::get<0>(info.param).name;
                           std::erase(name, '-');
                           const Told told = std::get<1>(info.param);
                           return name + (told == Told::axes        ? "AxesAlone"
                                          : told == Told::attitudes ? "AttitudesAlone"
                                                                    : "WithRates");
                         });

TEST(Diagnosis, NamesNothingOfRightFiles) { expect_nothing_of_right_files(20); }
TEST(Diagnosis, NamesBothOfTwoMistakesOrNone) { expect_both_of_two_mistakes(16); }

/// Every orientation of world axes, and every one of body axes, is named by its own words.
TEST(Diagnosis, NamesAll24OrientationsOfWorldAndOfBodyAxes) {
  const Bench bench(kGrounds[1]);
  const std::vector<State> right = bench.rows(bench.right());
  const std::string_view world_words[] = {"East", "West", "North", "South", "Up", "Down"},
                         body_words[] = {"1", "-1", "2", "-2", "3", "-3"};
  const V axes[] = {kX, kY, kZ};
  int frames = 0;
  std::array<std::size_t, 3> order = {0, 1, 2};
  do
    for (unsigned signs = 0; signs < 8; ++signs) {
      V columns[3];
      std::string world, body;
      for (std::size_t i = 0; i < 3; ++i) {
        const bool minus = (signs >> i & 1U) != 0;
        columns[i] = axes[order[i]] * (minus ? -1 : 1);
        world += (i ? ", " : "") + std::string(world_words[2 * order[i] + (minus ? 1 : 0)]);
        body += (i ? ", " : "") + std::string(body_words[2 * order[i] + (minus ? 1 : 0)]);
      }
      if (columns[0].cross(columns[1]).dot(columns[2]) < 0 || world == "East, North, Up") continue;
      ++frames;
      const Q frame = frame_of(columns[0], columns[1], columns[2]);
      for (const bool is_world : {true, false}) {
        std::vector<State> rows = right;
        is_world ? turn_world(rows, frame) : turn_body(rows, frame);
        const std::string text = all_of(bench.compared(SmallEngine::csv(rows)).hints);
        const std::string wanted = is_world ? "its world axes are taken as " + world : "its body axes are taken as our " + body;
        EXPECT_NE(text.find(wanted), text.npos) << wanted << ": " << text;
      }
    }
  while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(frames, 23);
}

SmallEngine some_scene() {
  SmallEngine scene;
  scene.moments = V(2.1e-4, 2.0e-4, 1.2e-4), scene.spin = 60, scene.tilt_deg = 50, scene.azimuth_deg = 33,
  scene.latitude_deg = 30;
  return scene;
}
constexpr double kDuration_s = 4, kStep_s = 0.05;

/// What is said of the file of a changed engine.
std::string said_of(const std::function<void(SmallEngine&)>& physics,
                    const std::function<void(std::vector<State>&)>& writing = nullptr, Told told = Told::attitudes_and_rates,
                    int digits = 17) {
  const Bench bench(some_scene(), kDuration_s, kStep_s);
  SmallEngine engine = bench.right();
  if (physics) physics(engine);
  std::vector<State> rows = bench.rows(engine);
  if (writing) writing(rows);
  return all_of(bench.compared(SmallEngine::csv(rows, digits, told), "", told).hints);
}
void expect_said(const std::string& text, const std::vector<std::string>& wanted) {
  for (const std::string& part : wanted) EXPECT_NE(text.find(part), text.npos) << part << " is not in: " << text;
}
/// Sets the components of the engine's Earth along North and Up, as multiples of the right ones.
void stretch_earth(SmallEngine& engine, double north, double up) {
  const V earth(0, north * engine.earth().y(), up * engine.earth().z());
  engine.earth_rate = earth.norm(), engine.latitude_deg = std::atan2(earth.z(), earth.y()) / kDegree;
}
void without_first(std::vector<State>& rows) { rows.erase(rows.begin()); }

TEST(Diagnosis, FitsANumberThatNoRuleNames) {
  expect_said(said_of([](SmallEngine& e) { stretch_earth(e, 1, 1.25); }),
              {"the Earth's rate times sin(latitude) 4.56e-05", " instead of 3.6460575e-05 rad/s explains all but "});
  expect_said(said_of([](SmallEngine& e) { stretch_earth(e, 0.5, 1); }),
              {"the Earth's rate times cos(latitude) 3.16e-05", " instead of 6.3151568e-05 rad/s explains all but "});
  expect_said(said_of([](SmallEngine& e) { e.spin = 60.3; }, without_first, Told::attitudes),
              {"the spin at the release 60.3 instead of 60 rad/s explains all but "});
  expect_said(said_of([](SmallEngine& e) { e.tilt_deg = 50.1; }, without_first),
              {"the tilt at the release 50.1 instead of 50 degrees explains all but "});
  expect_said(said_of([](SmallEngine& e) { e.azimuth_deg = 33.25; }, without_first),
              {"the azimuth at the release 33.25 instead of 33 degrees explains all but "});
  expect_said(said_of([](SmallEngine& e) { e.moments[2] = 1.21e-4; }),
              {"the moment of inertia about body axis 3 0.000121 instead of 0.00012 kg m^2 explains all but "});
  expect_said(said_of([](SmallEngine& e) { e.gravity = 9.83; },
                      [](std::vector<State>& rows) { turn_world(rows, frame_of(kY, kX, -kZ)); }),
              {"gravity 9.83 instead of 9.80665 m/s^2 explains all but ",
               ", if its world axes are taken as North, East, Down (\"NED\")"});
}

TEST(Diagnosis, SaysWhatDiffersAtTheRelease) {
  expect_said(said_of([](SmallEngine& e) { e.tilt_deg = 50.002, e.spin = 61; }),
              {"it differs at the release already: tilt 50.002 instead of 50 degrees, spin 61 instead of 60 rad/s; the motion "
               "from there "
               "agrees to "});
  expect_said(said_of([](SmallEngine& e) { e.azimuth_from_east = true, e.earth_rate = 2 * std::numbers::pi / 86400; }),
              {"it differs at the release already: azimuth 57 instead of 33 degrees, as if it were counted from East; from "
               "there the new "
               "result is, to ",
               "the motion of an Earth that turns once in a solar day (86400 s), and not in a sidereal one"});
  expect_said(said_of([](SmallEngine& e) { e.rates_are_inertial = true, e.tilt_deg = 49; }),
              {"tilt 49 instead of 50 degrees, its rates by the Earth's rate, as if rates relative to the laboratory were "
               "taken as inertial"});
  expect_said(said_of([](SmallEngine& e) { e.across = 0.5; }),
              {"it differs at the release already: rate across the spin axis 0.5 instead of 0 rad/s; the motion from there"});
  expect_said(
      said_of([](SmallEngine& e) { e.tilt_deg = 49, e.moments[2] = 1.21e-4; }),
      {"tilt 49 instead of 50 degrees; besides, the moment of inertia about body axis 3 0.000121 instead of 0.00012 kg m^2"});
}

/// Without rows in a row at the beginning none can be shifted.
TEST(Diagnosis, NeedsRowsToFindThemShifted) {
  const auto zero_first = [](std::vector<State>& rows) {
    rows[0].q.coeffs().setZero();
    for (std::size_t i = 1; i < rows.size(); ++i) rows[i].q = rows[i].q.conjugate();
  };
  const std::string text = said_of(nullptr, zero_first);
  expect_said(text, {"1 of its 81 quaternions are zero"});
  EXPECT_EQ(text.find("shifted"), text.npos) << text;
}

TEST(Diagnosis, SaysWhereNoSingleMistakeExplains) {
  const auto three = [](SmallEngine& e) { e.gravity = 9.83, e.moments[2] = 1.21e-4, e.earth_rate = 0; };
  EXPECT_EQ(said_of(three), "no single mistake explains this\n");
  const std::string rest = said_of([](SmallEngine& e) { e.gravity = 9.80668, e.moments[2] = 1.20002e-4; },
                                   [](std::vector<State>& rows) {
                                     for (State& s : rows) s.q = s.q.conjugate();
                                   });
  expect_said(rest, {"the new result agrees to ",
                     " if its quaternions are taken as world-to-body; no single mistake explains the rest"});
}

TEST(Diagnosis, NamesOppositeRatesAndWhatIsLeftToRounding) {
  expect_said(said_of(nullptr,
                      [](std::vector<State>& rows) {
                        for (State& s : rows) s.w = -s.w;
                      }),
              {"the new result agrees to ", " if its rates have the opposite sign"});
  expect_said(said_of([](SmallEngine& e) { e.azimuth_from_east = true; }, nullptr, Told::attitudes_and_rates, 6),
              {"with an azimuth that was counted from East",
               "its numbers have 6 digits, and what is left is their rounding; write 17"});
}

TEST(Diagnosis, NamesInertialRatesThatWereTakenAsRelativeToTheLaboratory) {
  SmallEngine scene = some_scene();
  scene.rates_are_inertial = true;
  const Bench bench(scene, kDuration_s, kStep_s, [](Scenario& s) { s.release.rates_relative_to = RatesRelativeTo::inertial; });
  EXPECT_TRUE(bench.compared(SmallEngine::csv(bench.rows(scene))).passed());
  expect_said(said_of([](SmallEngine& e) { e.rates_are_inertial = true; }),
              {"the motion in which the rates at the release, which are relative to the laboratory, were taken as inertial"});
  scene.rates_are_inertial = false;
  expect_said(all_of(bench.compared(SmallEngine::csv(bench.rows(scene))).hints),
              {"the motion in which the rates at the release, which are inertial, were taken as relative to the laboratory"});
}

TEST(Diagnosis, NamesMomentsAboutThePivotOrAboutTheCentreOfMass) {
  expect_said(said_of([](SmallEngine& e) { e.moments_about_center = true; }),
              {"with moments of inertia, which are about the pivot, taken as about the centre of mass"});
  SmallEngine scene = some_scene();
  scene.moments_about_center = true;
  const Bench bench(scene, kDuration_s, kStep_s, [](Scenario& s) { s.body.inertia_about = InertiaAbout::center_of_mass; });
  EXPECT_TRUE(bench.compared(SmallEngine::csv(bench.rows(scene))).passed());
  scene.moments_about_center = false;
  expect_said(all_of(bench.compared(SmallEngine::csv(bench.rows(scene))).hints),
              {"with moments of inertia, which are about the centre of mass, taken as about the pivot"});
}

}  // namespace
}  // namespace earthtop
