// SPDX-License-Identifier: GPL-3.0-or-later
// These tests check the scene that a scenario resolves to, and that each part of it is made only once.
#include "earthtop/scene/scene.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "earthtop/drift/drift_integration.hpp"
#include "scene/once.hpp"
#include "support/changed_scene.hpp"
#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"
#include "text/sha256.hpp"

namespace earthtop {
namespace {

using testing::changed;

TEST(Once, MakesItsValueOnceAlsoWhereThreadsAskAtOnce) {
  const Once<int> once;
  std::atomic<int> made = 0;
  const auto ask = [&] { EXPECT_EQ(once.get([&] { return ++made; }), 1); };
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) threads.emplace_back(ask);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
}

TEST(Once, TriesAgainWhereMakingThrew) {
  const Once<int> once;
  EXPECT_THROW(once.get([]() -> int { throw ScenarioError("", ""); }), ScenarioError);
  EXPECT_EQ(once.get([] { return 3; }), 3);
}

// A part that is made anew would have another address.
TEST(Scene, CopiesShareWhatTheyCompute) {
  const Scene scene = testing::toy_top(), copy = scene;
  EXPECT_EQ(&scene.body<double>(), &copy.body<double>());
  EXPECT_EQ(&scene.release<float128>(), &scene.release<float128>());
  EXPECT_EQ(&scene.model<float80>(), &copy.model<float80>());
  EXPECT_EQ(&scene.problem<double>(), &copy.problem<double>());
  EXPECT_EQ(&scene.choice(), &copy.choice());
  EXPECT_EQ(&scene.estimate(), &copy.estimate());
  EXPECT_EQ(&scene.identity(), &copy.identity());
  EXPECT_EQ(&scene.method_refusal(Method::closed_form), &copy.method_refusal(Method::closed_form));
  EXPECT_NE(&scene.body<double>(), &Scene(testing::toy_top()).body<double>());
}

TEST(Scene, HasTheBodyTheReleaseAndTheModelOfItsScenario) {
  const Scenario scenario = testing::toy_top();
  const Scene scene = scenario;
  const auto body = make_body<float80>(scenario.body);
  const auto release = make_release<float80>(scenario.release, body, static_cast<float80>(scene.site().gravity_m_s2));
  EXPECT_EQ(scene.body<float80>().I_BP_B, body.I_BP_B);
  EXPECT_EQ(scene.release<float80>().w_XB_B, release.w_XB_B);
  const auto model = make_model<float80>(body, scenario.site, scenario.rotation_rate_rad_s, {}, nullptr, scene.units());
  EXPECT_EQ(scene.problem<float80>().model.mass_moment_B, model.mass_moment_B);
  EXPECT_EQ(scene.problem<float80>().model.W_IL_L, model.W_IL_L);
  EXPECT_NE(scene.model<float80>().W_IL_L, model.W_IL_L);  // which is in SI units
  EXPECT_EQ(scene.problem<double>().times_s, output_times(scenario.duration_s, scenario.output_step_s));
  EXPECT_EQ(scene.sha256(), sha256_hex(identity_json(scenario)));
  EXPECT_TRUE(scene.is_plain());
  EXPECT_EQ(scene.symmetry_axis(), 2);
}

TEST(Scene, GravitysTorqueIsMassTimesGravityTimesDistance) {
  const Scene top = changed(testing::toy_top(), [](Scenario& s) {
    s.body.mass_kg = 2;
    s.body.center_of_mass_m = {0, 0, -0.25};
    s.body.inertia_kg_m2 = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}}};
    s.site.gravity_m_s2 = 9;
  });
  EXPECT_EQ(top.gravity_torque_N_m(), 4.5);
  EXPECT_EQ(top.gravity_torque_N_m(3), 6);
  EXPECT_EQ(top.axial_gravity_torque_N_m(), -4.5);
}

TEST(Scene, OfAnEarthThatDoesNotTurnIsTheSameButForItsRate) {
  const Scene scene = testing::toy_top(), still = scene.without_rotation();
  EXPECT_EQ(still.rotation_rate_rad_s(), 0);
  EXPECT_EQ(still.site().gravity_m_s2, scene.site().gravity_m_s2);
  EXPECT_EQ(still.release<double>().w_XB_B, scene.release<double>().w_XB_B);
  EXPECT_FALSE(scene.is_one_motion());
  EXPECT_TRUE(still.is_one_motion());
}

// One rule says which form the equations take: the scene's, by what its scenario gives, is the integrations', by their model.
TEST(Scene, TakesTheFormThatIntegrationsTake) {
  const Scene plain = testing::toy_top(), asymmetric = testing::asymmetric_top();
  const Scene rubbed = changed(plain, [](Scenario& s) { s.effects.applied.viscous_N_m_s = 1e-6; });
  const Scene leaving_out = changed(plain, [](Scenario& s) { s.effects.coriolis = false; });
  const Scene carried = changed(plain, [](Scenario& s) { s.platform = PlatformSpec{}; });
  // Wheels in a gimbal: a compass, and what is none.
  const auto disc = [](Scenario& s) { s.effects.applied.air_drag.emplace().disc_radius_m = 0.03; };
  const auto lying = [](Scenario& s) {  // symmetric about body axis 1
    testing::set_principal(s.body, 4e-5, 1.2e-4, 1.2e-4);
    s.body.center_of_mass_m = {0.01, 0, 0};
  };
  const auto balanced = [](Scenario& s) { testing::set_principal(s.body, 1e-3, 5e-4, 5e-4); };
  const Scene compass = testing::gyrocompass(30, 10, 1e-5);
  const Scene asymmetric_wheel = testing::held_rotor(), wheel_on_edge = changed(compass, balanced);
  const Scene wheel_in_air = changed(compass, disc),
              wheel_left_out = changed(compass, [](Scenario&s) { s.effects.centrifugal = false; });
  const Scene in_air = changed(plain, disc), lying_plain = changed(plain, lying);
  const Scene lying_rubbed = changed(rubbed, lying), lying_in_air = changed(lying_plain, disc);
  EXPECT_NE(leaving_out.choice().reason.find("left out"), std::string::npos);
  int reduced = 0;
  for (const Scene& scene : {plain, asymmetric, rubbed, leaving_out, carried, compass, asymmetric_wheel, wheel_on_edge,
                             wheel_in_air, wheel_left_out, in_air, lying_plain, lying_rubbed, lying_in_air})
    for (const Method method : {Method::rkf78, Method::splitting, Method::taylor, Method::long_horizon, Method::closed_form})
      for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial})
        for (const ModelForm form : {ModelForm::automatic, ModelForm::general}) {
          IntegrationOptions options;
          options.method = method, options.observer = observer, options.form = form;
          const bool taken = takes_reduced_form(scene.problem<double>().model, options);
          EXPECT_EQ(scene.form(options) == ModelForm::reduced, taken) << to_string(method) << ' ' << to_string(observer);
          reduced += taken;
        }
  // Each of the two plain symmetric tops in laboratory axes, and by splitting in inertial ones too; by their series the driven
  // ones: two that stand, one in air, one that lies, and the compass, also in air.
  EXPECT_EQ(reduced, 2 * 5 + 6);
}

// The parts of an estimate are those of the run, and the whole is their sum.
TEST(Scene, EstimatesTheSumOfItsPhases) {
  const Scene top = changed(testing::toy_top(), [](Scenario& s) {
    s.ledger = LedgerObserver::laboratory;
    s.sensitivities = true;
  });
  const RunSeconds& seconds = top.estimate().seconds;
  for (const double part :
       {seconds.solution, seconds.bound, seconds.rows, seconds.sensitivities, seconds.largest, seconds.ledger})
    EXPECT_GT(part, 0);
  EXPECT_EQ(seconds.growth, 0);  // a fast symmetric top is next to a closed form, far from every separatrix
  EXPECT_DOUBLE_EQ(seconds.all(),
                   seconds.solution + seconds.bound + seconds.rows + seconds.sensitivities + seconds.largest + seconds.ledger);
  EXPECT_EQ(top.estimate().solution.steps, top.cost(top.choice().options).work.steps);
  EXPECT_GT(Scene(testing::asymmetric_top()).estimate().seconds.growth, 0);
  const Scene plain = testing::toy_top();
  const RunSeconds& less = plain.estimate().seconds;
  EXPECT_EQ(less.ledger, 0);
  EXPECT_EQ(less.sensitivities, 0);
}

TEST(Scene, SaysWhyAMethodDoesNotFit) {
  const Scene asymmetric = changed(testing::asymmetric_top(), [](Scenario& s) { s.numerics.method = Method::splitting; });
  EXPECT_NE(asymmetric.method_refusal().value_or("").find("symmetric tops"), std::string::npos);
  EXPECT_FALSE(asymmetric.method_refusal(Method::taylor));
  EXPECT_FALSE(Scene(testing::toy_top()).method_refusal());
}

TEST(Scene, ARealRateThatDoesNotExistIsRefusedWhereverItIsNeeded) {
  const Scene slow = changed(testing::toy_top(), [](Scenario& s) {
    s.release.precession = Precession::steady_slow;
    s.release.spin_rad_s = 1;
  });
  EXPECT_NO_THROW(slow.body<double>());
  for (int i = 0; i < 2; ++i) {
    EXPECT_THROW(slow.release<double>(), ScenarioError);
    EXPECT_THROW(slow.choice(), ScenarioError);
  }
}

constexpr const char* kText = R"({"site": {"latitude_deg": 30},
  "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 0.1], "inertia": {"principal_kg_m2": [0.02, 0.02, 0.01]}},
  "release": {"tilt_deg": 20, "spin_rad_s": SPIN, "precession": "steady_slow"},
  "numerics": {"method": "METHOD"}, "effects": {"coulomb_torque_N_m": 0},
  "motion": {"duration_s": 1}})";

ScenarioReport examined(const std::string& spin, const std::string& method) {
  std::string text = kText;
  text.replace(text.find("SPIN"), 4, spin);
  text.replace(text.find("METHOD"), 6, method);
  return examine_scenario({"", text});
}

TEST(ExamineScenario, GivesTheSceneThatItJudged) {
  const ScenarioReport report = examined("100", "auto");
  ASSERT_TRUE(report.scene);
  EXPECT_EQ(report.scene->identity(), identity_json(*report.scenario));
}

// The scene's own complaints stand at their places in the text, sorted with those of the decoder.
TEST(ExamineScenario, PlacesWhatTheSceneHasToSay) {
  const ScenarioReport no_start = examined("1", "auto");
  EXPECT_FALSE(no_start.scene);
  ASSERT_EQ(no_start.errors.size(), 1U);
  EXPECT_EQ(no_start.errors[0].pointer, "/release/precession");
  EXPECT_EQ(no_start.errors[0].line, 3);
  const ScenarioReport no_method = examined("1e3, \"unknown\": 1", "closed_form");
  ASSERT_EQ(no_method.errors.size(), 2U);
  EXPECT_EQ(no_method.errors[0].pointer, "/release/unknown");
  EXPECT_EQ(no_method.errors[1].pointer, "/numerics/method");
  EXPECT_EQ(no_method.errors[1].line, 4);
}

}  // namespace
}  // namespace earthtop
