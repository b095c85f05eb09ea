// SPDX-License-Identifier: GPL-3.0-or-later
// The start of a motion whose measurement begins after the release.
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scene/scene.hpp"
#include "input/text_edit.hpp"

namespace earthtop {

std::vector<std::string> with_free_start_estimates(std::vector<std::string> names) {
  for (const char* name : {"tilt_deg", "/release/azimuth_deg", "/release/angular_velocity_body_rad_s/0",
                           "/release/angular_velocity_body_rad_s/1", "/release/angular_velocity_body_rad_s/2"})
    if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
  return names;
}

ScenarioSource with_free_start(const ScenarioSource& source, const Overrides& overrides) {
  const Scene scene = parse_scene(source, overrides);
  const Scenario& scenario = scene.scenario();
  if (scenario.gimbals || scenario.contact || scenario.release.quaternion_LB)
    throw ScenarioError("--free-start", "needs a top on a fixed pivot whose release is given by tilt_deg and azimuth_deg");
  const Vec3<double> w_B = scene.release<double>().w_XB_B;
  std::string text = changed_text(source.text, overrides);
  for (const char* member : {"/release/spin_rad_s", "/release/spin_rpm", "/release/precession"})
    text = input::without_member(text, member);
  text = input::with_value(text, "/release/angular_velocity_body_rad_s", fmt::format("[{}, {}, {}]", w_B[0], w_B[1], w_B[2]));
  return {source.file, std::move(text), source.may_name_files};
}

}  // namespace earthtop
