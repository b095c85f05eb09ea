// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes reference values for the scenarios' headline figures in 113-bit arithmetic. The program shares nothing with
/// earthtop: it integrates the top in inertial axes (dL/dt = torque), in gimbals the accelerations of their angles (masses on
/// given paths as particles), by extrapolation, and subtracts the two motions to get the drift.
///
///   earthtop-headlines SCENARIO.json... > values.json
///
/// Every scene is integrated twice, with steps of different length; the largest difference between the two, over all
/// columns, is printed as the error of the values. Seconds to minutes a scene; `fast-gyro` takes most of an hour.

#include <cstdio>
#include <nlohmann/json.hpp>

#include "measures.hpp"

namespace headlines {
namespace {

/// @param tolerance error of one step: of the quaternion, and of the angular momentum relative to its size
Columns columns_at(const Scene& scene, Real time, Real tolerance) {
  const bool stays = scene.travel && scene.travel->still_reference;
  Motion rotating(scene, scene.rotation_rate, true), reference(scene, stays ? scene.rotation_rate : 0, !stays);
  // The size of the angular momentum: its initial value, or what gravity produces during a swing.
  const Real momentum = norm(rotating.state().L_I);
  const Real swing =
      sqrtq(norm(scene.mass_moment) * scene.gravity * (scene.inertia.a.x + scene.inertia.b.y + scene.inertia.c.z));
  const Real scale = fmaxq(momentum, swing);
  constexpr int kOrder = 31;  // of the error estimate in the step
  DriftMeasures measures;
  measures.follow(rotating, reference);
  Real step = 1e-3Q;
  while (rotating.time() < time) {
    const Real end = scene.next_corner(rotating.time(), time);  // a step lies between two corners
    const bool last = rotating.time() + step >= end;
    const Real h = last ? end - rotating.time() : step;
    State next_rotating, next_reference;
    const Real error = fmaxq(rotating.try_step(h, scale, next_rotating), reference.try_step(h, scale, next_reference));
    const Real factor = error > 0 ? 0.9Q * powq(tolerance / error, Real(1) / kOrder) : 2;
    step = h * fminq(2, fmaxq(0.2Q, factor));
    if (error > tolerance) continue;
    const Real t = last ? end : rotating.time() + h;
    rotating.accept(t, next_rotating), reference.accept(t, next_reference);
    measures.follow(rotating, reference);
  }
  return measures.columns(rotating, reference);
}

nlohmann::ordered_json values_of(const std::string& file) {
  constexpr int kDigits = 25;
  const Scene scene = read_scene(file);
  const Columns coarse = columns_at(scene, scene.headline_time, 1e-24Q);
  const Columns fine = columns_at(scene, scene.headline_time, 1e-28Q);
  nlohmann::ordered_json columns = nlohmann::ordered_json::object();
  Real error = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const auto& [name, value] = fine[i];
    if (value && coarse[i].second) error = fmaxq(error, fabsq(*value - *coarse[i].second));
    columns[name] = value ? nlohmann::ordered_json(to_text(*value, kDigits)) : nlohmann::ordered_json(nullptr);
  }
  return {{"name", scene.name}, {"at_s", scene.headline_time}, {"error", to_text(error, 2)}, {"columns", columns}};
}

}  // namespace
}  // namespace headlines

int main(int argc, char** argv) {
  nlohmann::ordered_json document = {
      {"generator", "tests/headlines (earthtop-headlines): inertial axes, Gragg-Bulirsch-Stoer of order 32, plain subtraction"},
      {"precision", "113 bits (__float128); two integrations whose steps keep to 1e-24 and 1e-28"},
      {"digits", 25},
      {"scenarios", nlohmann::ordered_json::array()}};
  for (int i = 1; i < argc; ++i) {
    try {
      document["scenarios"].push_back(headlines::values_of(argv[i]));
    } catch (const std::exception& problem) {
      std::fprintf(stderr, "%s: %s\n", argv[i], problem.what());
      return 1;
    }
    std::fprintf(stderr, "%s: done\n", argv[i]);
  }
  std::puts(document.dump(1).c_str());
  return 0;
}
