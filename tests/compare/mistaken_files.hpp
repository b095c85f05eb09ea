// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of a small engine with mistakes, and what a comparison is to say of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "compare/results_copy.hpp"
#include "compare/small_engine.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::mistaken {

using testing::SmallEngine;
using testing::TemporaryDirectory;
using testing::write_text;
using State = SmallEngine::State;
using Told = SmallEngine::Told;
using V = SmallEngine::V;
using Q = SmallEngine::Q;

inline constexpr double kDegree = std::numbers::pi / 180;

/// A scenario of the engine's kind, its results, and how finely the engine has to step.
struct Ground {
  const char* name;
  double duration, step;
  int inner;
};
inline constexpr Ground kGrounds[] = {
    {"toy-top", 10, 0.05, 1000}, {"asymmetric-top", 10, 0.02, 200}, {"foucault-pendulum", 120, 0.5, 3000}};

class Bench {
 public:
  explicit Bench(const Ground& ground)
      : Bench(parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + ground.name + ".json"),
                             {{"/motion/duration_s", std::to_string(ground.duration)},
                              {"/motion/output_step_s", std::to_string(ground.step)}}),
              ground.inner) {}
  Bench(const SmallEngine& scene, double duration, double step)
      : Bench(scenario_of(scene, duration, step), static_cast<int>(std::ceil(step * (scene.spin + 40) / 0.01))) {}
  const SmallEngine& right() const { return right_; }
  /// @param scenario  of a scene of the engine's kind, which need not be as the engine takes it
  Bench(const SmallEngine& scene, double duration, double step, const std::function<void(Scenario&)>& change)
      : Bench(changed(scenario_of(scene, duration, step), change),
              static_cast<int>(std::ceil(step * (scene.spin + 40) / 0.01))) {
    right_ = scene;
  }
  std::vector<State> rows(const SmallEngine& engine) const { return engine.run(duration_, step_, inner_); }

  PairReport compared(const std::string& csv, const std::string& more = "", Told told = Told::attitudes_and_rates,
                      Profile profile = Profile::physics) const {
    write_text(directory_.path() / "theirs.csv", csv);
    write_text(directory_.path() / "mapping.json",
               R"({"time": {"column": "t"}, )" +
                   std::string(told == Told::axes ? R"("axis": {"columns": ["x", "y", "z"]})"
                                                  : R"("quaternion": {"columns": ["q0", "q1", "q2", "q3"]})") +
                   (told == Told::attitudes_and_rates ? R"(, "rates": {"columns": ["wx", "wy", "wz"]})" : "") + more + "}");
    CompareOptions options;
    options.tolerances.profile = profile;
    options.mapping = (directory_.path() / "mapping.json").string();
    return compare_results(directory_.path() / "ours", directory_.path() / "theirs.csv", options).pairs.at(0);
  }

 private:
  Bench(const Scenario& scenario, int inner) : duration_(scenario.duration_s), step_(scenario.output_step_s), inner_(inner) {
    write_results(earthtop::run(scenario), directory_.path() / "ours", false);
    right_.mass = scenario.body.mass_kg, right_.gravity = scenario.site.gravity_m_s2;
    right_.latitude_deg = scenario.site.latitude_deg;
    right_.center = V(scenario.body.center_of_mass_m.data());
    for (std::size_t i = 0; i < 3; ++i) right_.moments[static_cast<int>(i)] = scenario.body.inertia_kg_m2[i][i];
    right_.moments_about_center = scenario.body.inertia_about == InertiaAbout::center_of_mass;
    right_.tilt_deg = scenario.release.tilt_deg, right_.azimuth_deg = scenario.release.azimuth_deg;
    right_.spin = scenario.release.spin_rad_s;
  }
  static Scenario changed(Scenario scenario, const std::function<void(Scenario&)>& change) {
    change(scenario);
    return scenario;
  }
  static Scenario scenario_of(const SmallEngine& scene, double duration, double step) {
    Scenario scenario;
    scenario.site.latitude_deg = scene.latitude_deg, scenario.site.gravity_m_s2 = scene.gravity;
    scenario.body.mass_kg = scene.mass;
    for (std::size_t i = 0; i < 3; ++i) {
      scenario.body.center_of_mass_m[i] = scene.center[static_cast<int>(i)];
      scenario.body.inertia_kg_m2[i][i] = scene.moments[static_cast<int>(i)];
    }
    scenario.release.tilt_deg = scene.tilt_deg, scenario.release.azimuth_deg = scene.azimuth_deg;
    scenario.release.spin_rad_s = scene.spin;
    scenario.duration_s = duration, scenario.output_step_s = step;
    return scenario;
  }

  double duration_, step_;
  int inner_;
  TemporaryDirectory directory_;
  SmallEngine right_;
};

inline Q frame_of(const V& x, const V& y, const V& z) {
  Eigen::Matrix3d matrix;
  matrix << x, y, z;
  return Q(matrix);
}
inline const V kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

struct Case {
  const char* name;
  std::function<void(SmallEngine&)> physics;                             // changes the engine; may be null
  std::function<void(std::vector<State>&, const SmallEngine&)> writing;  // changes what it writes; may be null
  std::vector<std::string> named;                                        // what the only sentence says
  int digits = 17;
  bool needs_rates = false, of_earth = false, of_axes = false, needs_attitude = false;
};

inline void turn_world(std::vector<State>& rows, const Q& q_LF) {
  for (State& s : rows) s.q = q_LF.conjugate() * s.q;
}
inline void turn_body(std::vector<State>& rows, const Q& q_BG) {
  for (State& s : rows) s.q = s.q * q_BG, s.w = q_BG.conjugate() * s.w;
}
inline Q earth_turn(const SmallEngine& engine, double t) {
  return Q(Eigen::AngleAxisd(engine.earth().norm() * t, engine.earth().normalized()));
}

inline const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"no Earth",
       [](SmallEngine& e) { e.earth_rate = 0; },
       nullptr,
       {"the motion without the Earth's rotation"},
       17,
       false,
       true},
      {"wrong sign",
       [](SmallEngine& e) { e.earth_rate *= -1; },
       nullptr,
       {"an Earth that turns the other way"},
       17,
       false,
       true},
      {"no Coriolis torque",
       [](SmallEngine& e) { e.coriolis = false; },
       nullptr,
       {"without the Coriolis torque"},
       17,
       false,
       true},
      {"laboratory rates as inertial",
       [](SmallEngine& e) { e.rates_are_inertial = true; },
       nullptr,
       {"were taken as inertial"},
       17,
       false,
       true},
      {"inertial rates",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine& e) {
         for (State& s : rows) s.w += s.q.conjugate() * e.earth();
       },
       {"its rates are taken as relative to space, with the Earth's rate in them"},
       17,
       true,
       true},
      {"inertial attitude",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine& e) {
         for (State& s : rows) s.q = earth_turn(e, s.t) * s.q;
       },
       {"its attitudes are taken as relative to space, and not to the laboratory"},
       17,
       false,
       true},
      {"solar day",
       [](SmallEngine& e) { e.earth_rate *= 2 * std::numbers::pi / 86400 / 7.292115e-5; },
       nullptr,
       {"once in a solar day"},
       17,
       false,
       true},
      {"gravity 9.81", [](SmallEngine& e) { e.gravity = 9.81; }, nullptr, {"gravity 9.81 instead of"}},
      {"latitude in radians",
       [](SmallEngine& e) { e.latitude_in_radians = true; },
       nullptr,
       {"in degrees that was taken as radians"},
       17,
       false,
       true},
      {"southern", [](SmallEngine& e) { e.latitude_deg *= -1; }, nullptr, {"at the opposite latitude"}, 17, false, true},
      {"tilt", [](SmallEngine& e) { e.tilt_deg += 0.002; }, nullptr, {"tilt", "instead of"}},
      {"spin", [](SmallEngine& e) { e.spin += 0.1; }, nullptr, {"spin", "instead of"}},
      {"azimuth from East", [](SmallEngine& e) { e.azimuth_from_east = true; }, nullptr, {"counted from East"}},
      {"moments about the other point",
       [](SmallEngine& e) { e.moments_about_center = !e.moments_about_center; },
       nullptr,
       {"with moments of inertia, which are about the"}},
      {"inverse quaternion",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (State& s : rows) s.q = s.q.conjugate();
       },
       {"its quaternions are taken as world-to-body"},
       17,
       false,
       false,
       false,
       true},
      {"scalar last",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (State& s : rows) s.q = Q(s.q.x(), s.q.y(), s.q.z(), s.q.w());
       },
       {"with the scalar part last"},
       17,
       false,
       false,
       false,
       true},
      {"degrees",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (State& s : rows) s.w /= kDegree;
       },
       {"57.2958 times the reference's, are taken as in deg/s"},
       17,
       true},
      {"shifted rows",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (std::size_t i = 0; i + 1 < rows.size(); ++i) rows[i].q = rows[i + 1].q, rows[i].w = rows[i + 1].w;
       },
       {"each row is taken as that of the reference one row", "are the times shifted by a sample?"}},
      {"NED",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) { turn_world(rows, frame_of(kY, kX, -kZ)); },
       {"its world axes are taken as North, East, Down (\"NED\")"},
       17,
       false,
       false,
       true},
      {"NWU",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) { turn_world(rows, frame_of(kY, -kX, kZ)); },
       {"its world axes are taken as North, West, Up (\"NWU\")"},
       17,
       false,
       false,
       true},
      {"y-up",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) { turn_world(rows, frame_of(kX, kZ, -kY)); },
       {"its world axes are taken as East, Up, South (\"y-up\")"},
       17,
       false,
       false,
       true},
      {"x-forward",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) { turn_body(rows, frame_of(V(0, 0, 1), V(1, 0, 0), V(0, 1, 0))); },
       {"its body axes are taken as our 3, 1, 2 (\"x-forward\")"},
       17,
       false,
       false,
       false,
       true},
      {"rates along world axes",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (State& s : rows) s.w = s.q * s.w;
       },
       {"its rates are taken along world axes"},
       17,
       true},
      {"milliseconds",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (State& s : rows) s.t *= 1000;
       },
       {"its last time is 1000 times the reference's: its times are in ms"}},
      {"norm 1.001",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (State& s : rows) s.q.coeffs() *= 1.001;
       },
       {"its quaternions have lengths from 1.001 to 1.001, and not 1"},
       17,
       false,
       false,
       false,
       true},
      {"zero quaternions",
       nullptr,
       [](std::vector<State>& rows, const SmallEngine&) {
         for (std::size_t i = 30; i < 40; ++i) rows[i].q.coeffs().setZero();
       },
       {"10 of its ", "quaternions are zero, the first one at t = "},
       17,
       false,
       false,
       false,
       true},
      {"six digits", nullptr, nullptr, {"its numbers have 6 digits", "write 17"}, 6},
  };
  return all;
}

inline std::string all_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + '\n';
  return text;
}

inline bool is_named(const Case& one, const std::string& text) {
  return std::all_of(one.named.begin(), one.named.end(), [&](const std::string& part) { return text.find(part) != text.npos; });
}

/// The names of mistakes that a text names beside those that were made. Without its Coriolis torque the Earth does next to nothing: a file
/// need not tell that from no Earth.
inline std::string others_named(const std::string& text, const std::vector<const Case*>& made) {
  const bool untold = text.find("the file does not tell them apart") != text.npos;
  std::string names;
  for (const Case& other : cases())
    if (std::find(made.begin(), made.end(), &other) == made.end() && is_named(other, text) && !untold)
      names += std::string(other.name) + "; ";
  return names;
}

/// Scenes of the engine's kind at random, run for a short time.
inline SmallEngine random_scene(std::mt19937& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  SmallEngine scene;
  scene.mass = between(0.05, 2), scene.gravity = between(9.78, 9.83), scene.latitude_deg = between(-80, 80);
  const double lever = between(0.01, 0.1), across = scene.mass * lever * lever;
  scene.center = V(0, 0, between(0, 1) < 0.3 ? -lever : lever);
  const double I1 = across * between(0.2, 2), I2 = between(0, 1) < 0.5 ? I1 : I1 * between(0.8, 1);  // about the centre of mass
  scene.moments = V(I1 + across, I2 + across, between(1.1 * (I1 - I2) + 0.2 * I1, 0.9 * (I1 + I2)));
  scene.tilt_deg = between(10, 160), scene.azimuth_deg = between(-180, 180), scene.spin = between(20, 120);
  return scene;
}

inline Q random_axes(std::mt19937& random, std::string& words, const std::vector<std::string>& names) {
  const V axes[] = {kX, kY, kZ};
  for (;;) {
    std::array<int, 3> order = {0, 1, 2};
    std::shuffle(order.begin(), order.end(), random);
    V columns[3];
    words.clear();
    for (int i = 0; i < 3; ++i) {
      const bool minus = random() % 2 == 0;
      columns[i] = axes[order[i]] * (minus ? -1 : 1);
      words += (i ? ", \"" : "\"") + names[2 * order[i] + (minus ? 1 : 0)] + '"';
    }
    if (columns[0].cross(columns[1]).dot(columns[2]) > 0) return frame_of(columns[0], columns[1], columns[2]);
  }
}

/// Right files of random scenes, in random axes and digits: nothing is named.
inline void expect_nothing_of_right_files(int count) {
  std::mt19937 random(7);
  int differ = 0;
  for (int i = 0; i < count; ++i) {
    const Bench bench(random_scene(random), 3, 0.05);
    std::vector<State> rows = bench.rows(bench.right());
    std::string world, body;
    turn_world(rows, random_axes(random, world, {"east", "west", "north", "south", "up", "down"}));
    turn_body(rows, random_axes(random, body, {"1", "-1", "2", "-2", "3", "-3"}));
    const Told told = random() % 2 == 0 ? Told::attitudes_and_rates : Told::attitudes;
    const int digits = 10 + static_cast<int>(random() % 8);
    const PairReport pair =
        bench.compared(SmallEngine::csv(rows, digits, told), ", \"world_axes\": [" + world + "], \"body_axes\": [" + body + "]",
                       told, random() % 2 == 0 ? Profile::physics : Profile::regression);
    EXPECT_TRUE(pair.hints.empty() || pair.hints[0].find("digits, and their rounding") != std::string::npos)
        << i << ": " << all_of(pair.hints);
    differ += pair.passed() ? 0 : 1;
  }
  EXPECT_GT(differ, count / 10);  // of the narrower profile, so that something was looked for
}

/// Files with two mistakes: both are named, or it is said that no single one explains them; never a third.
inline void expect_both_of_two_mistakes(int count) {
  std::mt19937 random(11);
  int both = 0;
  for (int i = 0; i < count; ++i) {
    const Bench bench(random_scene(random), 3, 0.05);
    const Case *a = nullptr, *b = nullptr;
    do {
      a = &cases()[random() % cases().size()], b = &cases()[random() % cases().size()];
    } while (a == b || (a->of_earth && b->of_earth) || (a->of_axes && b->of_axes));
    SmallEngine engine = bench.right();
    for (const Case* one : {a, b})
      if (one->physics) one->physics(engine);
    std::vector<State> rows = bench.rows(engine);
    for (const Case* one : {a, b})
      if (one->writing) one->writing(rows, engine);
    const auto differs_alone = [&](const Case& one) {
      SmallEngine alone = bench.right();
      if (one.physics) one.physics(alone);
      std::vector<State> written = bench.rows(alone);
      if (one.writing) one.writing(written, alone);
      return !bench.compared(SmallEngine::csv(written, one.digits)).passed();
    };
    const bool a_differs = differs_alone(*a), b_differs = differs_alone(*b);
    const PairReport pair = bench.compared(SmallEngine::csv(rows, std::min(a->digits, b->digits)));
    const std::string text = all_of(pair.hints);
    const bool names_both = (is_named(*a, text) || !a_differs) && (is_named(*b, text) || !b_differs),
               names_none = text.find("no single mistake explains") != text.npos;
    both += names_both ? 1 : 0;
    EXPECT_TRUE(names_both || names_none) << i << ", " << a->name << " and " << b->name << ": " << text;
    EXPECT_EQ(others_named(text, {a, b}), "") << i << ", " << a->name << " and " << b->name << ": " << text;
  }
  EXPECT_GT(both, count / 2);
}

}  // namespace earthtop::mistaken
