// SPDX-License-Identifier: GPL-3.0-or-later
/// Suspensions whose motion and drift are known to 20 digits (tests/data/gimbals/references.json), and how far an integration is from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "earthtop/scenario/scenario.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/contact_references.hpp"
#include "support/json.hpp"

namespace earthtop::testing {

inline const nlohmann::json& gimbal_references() {
  static const nlohmann::json made = parse_json(read_file(EARTHTOP_TESTS "/data/gimbals/references.json"));
  return made;
}

/// The largest errors of a case: of both motions, relative to the largest value of the same quantity in the run (angles: in rad), and of
/// the drifts, absolute and relative to the largest of their kind.
struct GimbalErrors {
  double motion = 0, drift = 0, relative_drift = 0;
};

template <class T>
GimbalErrors gimbal_errors(const nlohmann::json& reference, const DriftTrajectory<T>& made) {
  GimbalErrors errors;
  const auto size = [](const T& x) { return static_cast<double>(real::abs(x)); };
  T fastest[2] = {T(0), T(0)}, turned[2] = {T(1), T(1)};  // rates of the gimbals; rate and angle of the rotor
  for (const DriftSample<T>& sample : made.samples) {
    fastest[0] = std::max(fastest[0], T(real::abs(sample.gimbals->outer_rate.rot)));
    fastest[1] = std::max(fastest[1], T(real::abs(sample.gimbals->inner_rate.rot)));
    if (!sample.rotor) continue;
    turned[0] = std::max(turned[0], T(real::abs(sample.rotor->rate)));
    turned[1] = std::max(turned[1], T(real::abs(sample.rotor->angle)));
  }
  std::map<std::string, T> largest;
  const auto number = [](const nlohmann::json& text) { return parsed<T>(text.get<std::string>()); };
  for (const nlohmann::json& row : reference.at("rows")) {
    if (row.at("kind") != "D") continue;
    for (const char* name : {"angles", "rotor"})
      for (std::size_t i = 0; row.contains(name) && i < 2; ++i) {
        T& most = largest[name + std::to_string(i)];
        most = std::max(most, T(real::abs(number(row.at(name).at(i)))));
      }
    if (row.contains("axis")) largest["axis"] = std::max(largest["axis"], number(row.at("axis")));
  }
  for (const nlohmann::json& row : reference.at("rows")) {
    const double t_s = row.at("t_s");
    const auto sample =
        std::ranges::find_if(made.samples, [&](const auto& s) { return static_cast<double>(s.state.t_s) == t_s; });
    if (sample == made.samples.end()) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    const GimbalState<T>& gimbals = *sample->gimbals;
    const T epsilon = sample->state.epsilon;
    if (row.at("kind") == "D") {
      const auto drift = [&](const T& value, const nlohmann::json& truth, const std::string& name) {
        const T apart = value - number(truth);
        errors.drift = std::max(errors.drift, size(apart));
        if (largest[name] > T(0))
          errors.relative_drift = std::max(errors.relative_drift, size(T(apart / largest[name])));
        else
          errors.relative_drift = std::max(errors.relative_drift, size(apart) > 0 ? 1.0 : 0.0);  // a zero is a zero
      };
      drift(epsilon * gimbals.outer.diff, row.at("angles").at(0), "angles0");
      drift(epsilon * gimbals.inner.diff, row.at("angles").at(1), "angles1");
      if (row.contains("rotor")) {
        drift(epsilon * sample->rotor->rate_difference_scaled, row.at("rotor").at(0), "rotor0");
        drift(epsilon * sample->rotor->angle_difference_scaled, row.at("rotor").at(1), "rotor1");
      }
      if (row.contains("axis")) drift(sample->measures.axis, row.at("axis"), "axis");
      continue;
    }
    const bool earth = row.at("kind") == "E";
    const auto motion = [&](const T& value, const nlohmann::json& truth, const T& scale) {
      if (scale > T(0)) errors.motion = std::max(errors.motion, size(T((value - number(truth)) / scale)));
    };
    const auto of = [&](const Paired<T>& both) { return earth ? both.rot : both.ref; };
    motion(of(gimbals.outer), row.at("angles").at(0), T(1)), motion(of(gimbals.inner), row.at("angles").at(1), T(1));
    motion(of(gimbals.outer_rate), row.at("rates").at(0), fastest[0]),
        motion(of(gimbals.inner_rate), row.at("rates").at(1), fastest[1]);
    if (!row.contains("rotor")) continue;
    motion(earth ? sample->rotor->rate : sample->rotor->ref_rate, row.at("rotor").at(0), turned[0]);
    motion(earth ? sample->rotor->angle : sample->rotor->ref_angle, row.at("rotor").at(1), turned[1]);
  }
  return errors;
}

/// @param tolerance  of Taylor series
template <class T>
GimbalErrors gimbal_errors(const nlohmann::json& reference, Observer observer, double tolerance) {
  const Scene scene = parse_scene({"gimbals.json", text_of(reference.at("scenario"))}, {});
  IntegrationOptions options;
  options.method = Method::taylor, options.observer = observer, options.form = ModelForm::general;
  options.relative_tolerance = tolerance;
  return gimbal_errors<T>(reference, integrate_drift(scene.problem<T>(), options));
}

}  // namespace earthtop::testing
