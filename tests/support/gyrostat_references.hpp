// SPDX-License-Identifier: GPL-3.0-or-later
/// Gyrostats, and bodies in which masses move, whose motion and drift are known to 20 digits (tests/data/gyrostat/references.json), and how far an integration is from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "earthtop/scenario/scenario.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/contact_references.hpp"
#include "support/json.hpp"

namespace earthtop::testing {

inline const nlohmann::json& gyrostat_references() {
  static const nlohmann::json made = parse_json(read_file(EARTHTOP_TESTS "/data/gyrostat/references.json"));
  return made;
}

/// The equations of a gyrostat are taken for a symmetric cage, too.
inline Scene gyrostat_scene(const nlohmann::json& reference) {
  return parse_scene({"gyrostat.json", text_of(reference.at("scenario"))}, {{"/numerics/model", "general"}});
}

/// The largest errors of a case: of both motions' quaternions and rotors (relative to the rotor's largest value), and of the drifts,
/// absolute and relative to the largest of their kind.
struct GyrostatErrors {
  double motion = 0, drift = 0, relative_drift = 0;
};

template <class T>
GyrostatErrors gyrostat_errors(const nlohmann::json& reference, const DriftTrajectory<T>& made) {
  GyrostatErrors errors;
  const auto size = [](const T& x) { return static_cast<double>(real::abs(x)); };
  const auto motion = [&](const T& value, const nlohmann::json& truth, T scale) {
    errors.motion = std::max(errors.motion, size((value - parsed<T>(truth.get<std::string>())) / scale));
  };
  const auto drift = [&](const T& value, const T& truth, const T& scale) {
    errors.drift = std::max(errors.drift, size(value - truth));
    if (scale > T(0)) errors.relative_drift = std::max(errors.relative_drift, size((value - truth) / scale));
  };
  T largest[4] = {T(0), T(0), T(0), T(0)};  // axis, attitude, rotor's rate, its angle
  const auto truths = [](const nlohmann::json& row) {
    std::vector<T> all{parsed<T>(row.at("axis").template get<std::string>()),
                       parsed<T>(row.at("attitude").template get<std::string>()), T(0), T(0)};
    if (row.contains("rotor"))
      for (std::size_t i = 0; i < 2; ++i) all[2 + i] = parsed<T>(row.at("rotor").at(i).template get<std::string>());
    return all;
  };
  for (const nlohmann::json& row : reference.at("rows"))
    if (row.at("kind") == "D")
      for (std::size_t i = 0; i < 4; ++i) largest[i] = std::max(largest[i], T(real::abs(truths(row)[i])));
  for (const nlohmann::json& row : reference.at("rows")) {
    const double t_s = row.at("t_s");
    const auto sample =
        std::ranges::find_if(made.samples, [&](const auto& s) { return static_cast<double>(s.state.t_s) == t_s; });
    if (sample == made.samples.end()) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    const DriftState<T>& state = sample->state;
    if (row.at("kind") == "D") {
      const std::vector<T> truth = truths(row);
      drift(sample->measures.axis, truth[0], largest[0]);
      drift(sample->measures.attitude, truth[1], largest[1]);
      if (!row.contains("rotor")) continue;
      drift(state.epsilon * sample->rotor->rate_difference_scaled, truth[2], largest[2]);
      drift(state.epsilon * sample->rotor->angle_difference_scaled, truth[3], largest[3]);
      continue;
    }
    const bool earth = row.at("kind") == "E";
    const Quaternion<T> q = (earth ? state.q_LB : state.ref_q_LB).normalized();
    const auto& truth = row.at("q_LB");
    const T sign = q.w * parsed<T>(truth.at(0).get<std::string>()) < T(0) ? T(-1) : T(1);
    motion(sign * q.w, truth.at(0), T(1));
    for (std::size_t i = 0; i < 3; ++i) motion(sign * q.v[static_cast<int>(i)], truth.at(i + 1), T(1));
    if (!row.contains("rotor")) continue;
    const RotorState<T>& rotor = *sample->rotor;
    motion(earth ? rotor.rate : rotor.ref_rate, row.at("rotor").at(0), T(real::abs(rotor.ref_rate)));
    motion(earth ? rotor.angle : rotor.ref_angle, row.at("rotor").at(1), T(real::abs(rotor.ref_angle)));
  }
  return errors;
}

/// The same of a case by series in the equations of an observer.
template <class T>
GyrostatErrors gyrostat_errors(const nlohmann::json& reference, Observer observer, double tolerance) {
  IntegrationOptions options;
  options.method = Method::taylor;
  options.observer = observer;
  options.form = ModelForm::general;
  options.relative_tolerance = tolerance;
  const DriftTrajectory<T> made = integrate_drift(gyrostat_scene(reference).problem<T>(), options);
  if (made.status != RunStatus::completed) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  return gyrostat_errors(reference, made);
}

}  // namespace earthtop::testing
