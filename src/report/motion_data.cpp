// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/motion_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/model/model.hpp"
#include "earthtop/scene/top_figures.hpp"
#include "report/packed.hpp"

namespace earthtop::report {
namespace {

using compare::Row;

constexpr double kDiscHeight = 0.58;  // of the top drawn, in stems: where its disc is
constexpr double kShownPath = 1.5;    // largest extent of the path in the animation, in stems

/// Three numbers for each row, the direction of an axis.
std::vector<double> directions(const Motion& motion, std::string_view first) {
  std::vector<double> list;
  const std::size_t at = column(first);
  for (const Row& row : motion.rows) list.insert(list.end(), &row.value[at], &row.value[at] + 3);
  return list;
}

bool all_finite(const std::vector<double>& list) {
  return std::ranges::all_of(list, [](double number) { return std::isfinite(number); });
}

/// How a body turns that is no symmetric top about its axis 3, and the largest rate at which it does: it is drawn as a body.
void add_attitude(const Run& run, Json& data) {
  constexpr int kAttitudeBits = 14;
  if (!run.played_is_mean)
    for (const auto& [name, first] : {std::pair{"attitude_LB", column("q_LB_w")}, {"ref_attitude_LB", column("ref_q_LB_w")}}) {
      Json components = Json::array();
      for (std::size_t i = first; i < first + 4; ++i) {
        std::vector<double> list;
        for (const Row& row : run.played.rows) list.push_back(row.value[i]);
        if (all_finite(list)) components.push_back(packed(list, kAttitudeBits));
      }
      if (components.size() == 4) data["packed"]["vectors"][name] = std::move(components);
    }
  double largest = 0;
  for (const char* first : {"w_LB_B_x_rad_s", "ref_w_LB_B_x_rad_s"})
    for (const Row& row : run.drawn.rows)
      largest = std::fmax(largest, Eigen::Map<const Vec3<double>>(&row.value[column(first)]).norm());
  data["rate_rad_s"] = largest;
}

/// The angle about body axis 3 by which a body has turned in the rows: the integral of its rate, for a picture.
std::vector<double> angle_about_axis(const Motion& motion, std::string_view rate) {
  const std::vector<double> rates = values(motion, rate);
  std::vector<double> angles(rates.size(), 0);
  for (std::size_t i = 1; i < rates.size(); ++i)
    angles[i] = angles[i - 1] + (motion.rows[i].t_s - motion.rows[i - 1].t_s) * (rates[i - 1] + rates[i]) / 2;
  return angles;
}

/// The rotor in the body: where it is, its size as that of a uniform disc, and both angles in both motions.
void add_rotor(const Run& run, const RotorSpec& spec, Json& data) {
  constexpr int kAngleBits = 20;
  Json angles = Json::object();
  for (const char* prefix : {"", "ref_"}) {
    angles[std::string(prefix) + "rotor_angle"] = values(run.played, std::string(prefix) + "rotor_angle_rad");
    angles[std::string(prefix) + "body_angle"] = angle_about_axis(run.played, std::string(prefix) + "w_LB_B_z_rad_s");
  }
  for (const auto& [name, list] : angles.items()) {
    const auto numbers = list.get<std::vector<double>>();
    if (!all_finite(numbers)) return;
    data["packed"]["vectors"][name] = Json::array({packed(numbers, kAngleBits)});
  }
  const Vec3<double> c = make_rotor<double>(spec).axis_B, p = c.unitOrthogonal(), q = c.cross(p);
  Json axes = Json::array();
  for (const Vec3<double>& axis : {c, p, q}) axes.push_back({axis[0], axis[1], axis[2]});
  data["rotor"] = {{"axes_B", std::move(axes)},
                   {"center_m", spec.center_m},
                   {"radius_m", std::sqrt(2 * spec.axial_kg_m2 / spec.mass_kg)},
                   {"rate_rad_s", largest_size(values(run.drawn, "rotor_rate_rad_s"))}};
}

/// The masses that move in the body: where each is in body axes, the heaviest ones where there are many.
void add_masses(const Run& run, Json& data) {
  constexpr int kPlaceBits = 12;
  constexpr std::size_t kMost = 12;
  std::vector<MassOnPath<double>> masses = run.scene->model<double>().masses.masses;
  std::ranges::stable_sort(masses, std::ranges::greater(), &MassOnPath<double>::mass);
  masses.resize(std::min(masses.size(), kMost));
  for (std::size_t i = 0; i < masses.size(); ++i) {
    Json place = Json::array();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> list;
      for (const Row& row : run.played.rows) list.push_back(masses[i].at(row.t_s).place[axis]);
      place.push_back(packed(list, kPlaceBits));
    }
    data["packed"]["vectors"]["mass_" + std::to_string(i)] = std::move(place);
  }
  data["masses"] = masses.size();
}

/// The outer gimbal of a suspension: its axis, and the normal of the plane of both axes, in both motions.
void add_ring(const Run& run, Json& data) {
  constexpr int kDirectionBits = 14;
  const Model<double>& model = run.scene->model<double>();
  const PrescribedMotion<double>& turn = model.platform.turn;
  const auto add = [&](const std::string& name, const std::function<Vec3<double>(double, double)>& direction_P,
                       const char* angle) {
    const std::vector<double> angles = values(run.played, angle);
    std::array<std::vector<double>, 3> components;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double t_s = run.played.rows[i].t_s;
      const Vec3<double> v = earthtop::times(turn_matrix(turn.axis, turn.angle(t_s)), direction_P(angles[i], t_s));
      for (int k = 0; k < 3; ++k) components[static_cast<std::size_t>(k)].push_back(v[k]);
    }
    Json packed_components = Json::array();
    for (const auto& list : components) {
      if (!all_finite(list)) return;
      packed_components.push_back(packed(list, kDirectionBits));
    }
    data["packed"]["vectors"][name] = std::move(packed_components);
  };
  const Mat3<double>& R_P0 = model.gimbals.R_P0;
  const auto normal = [&](double outer, double) -> Vec3<double> {
    return R_P0 * Vec3<double>(real::cos(outer), real::sin(outer), 0);
  };
  add("ring_normal", normal, "outer_angle_rad");
  add("ref_ring_normal", normal, "ref_outer_angle_rad");
  add(
      "ring_axis", [&](double, double) -> Vec3<double> { return R_P0.col(2); }, "outer_angle_rad");
}

/// Half way between the least and the greatest of the numbers that are finite.
double middle(const std::vector<double>& list) {
  const Reach reach = reach_of(list);
  return (reach.low + reach.high) / 2;
}

/// Adds the places of both contact points, in lengths of the animation's stem.
void add_tip(const Run& run, Json& data) {
  const std::vector<double> x = values(run.played, "tip_L_x_m"), y = values(run.played, "tip_L_y_m");
  double stem_m = 0;
  if (run.scene) {
    const Scenario& scenario = run.scene->scenario();
    stem_m = std::abs(scenario.body.center_of_mass_m[2]) / kDiscHeight;
    if (scenario.contact) stem_m = std::max(stem_m, 2 * scenario.contact->tip_radius_m);
  }
  // A path much longer than the top is drawn smaller, so that it stays in the picture.
  const double path_m = extent(x, y), unit_m = std::max(stem_m, path_m / kShownPath);
  if (!(unit_m > 0)) return;
  const double centres[] = {middle(x), middle(y)};
  const auto add = [&](const char* name, std::vector<double> east, std::vector<double> north) {
    constexpr int kTipBits = 14;  // the path fills a picture of 500 px
    Json place = Json::array();
    const double* centre = centres;
    for (std::vector<double>* list : {&east, &north}) {
      for (double& m : *list) m = (m - *centre) / unit_m;
      ++centre;
      if (!std::ranges::all_of(*list, [](double m) { return std::isfinite(m); })) return;
      place.push_back(packed(*list, kTipBits));
    }
    place.push_back(packed(std::vector<double>(east.size(), 0), kTipBits));
    data["packed"]["vectors"][name] = std::move(place);
  };
  add("tip", x, y);
  add("ref_tip", values(run.played, "ref_tip_L_x_m"), values(run.played, "ref_tip_L_y_m"));
  data["path_shrunk"] = stem_m > 0 ? unit_m / stem_m : 0.0;
}

}  // namespace

Reach reach_of(const std::vector<double>& list) {
  Reach reach;
  for (const double number : list) {
    if (!std::isfinite(number)) continue;
    reach.low = std::fmin(reach.low, number);
    reach.high = std::fmax(reach.high, number);
  }
  return reach;
}

double extent(const std::vector<double>& x, const std::vector<double>& y) {
  const Reach along_x = reach_of(x), along_y = reach_of(y);
  return std::fmax(0, std::fmax(along_x.high - along_x.low, along_y.high - along_y.low));
}

void add_motion(const Run& run, Json& data) {
  std::vector<double> times_s;
  for (const Row& row : run.played.rows) times_s.push_back(row.t_s);
  data["packed"]["times"] = packed_times(times_s);
  const std::vector<double> axis = directions(run.played, "axis_L_x"), reference = directions(run.played, "ref_axis_L_x");
  if (all_finite(axis) && all_finite(reference)) data["packed"]["axes"] = packed_axes(axis, reference);
  data["spin_rad_s"] = run.drawn.rows.empty() ? 0.0 : run.drawn.rows.front().value[column("w_LB_B_z_rad_s")];
  data["cause"] = run.compared().cause;
  data["earth_rate_L"] = {0, 0, 0};
  data["precession_axis_L"] = {0, 0, 1};
  data["torques"] = nullptr;
  if (run.has_contact) add_tip(run, data);
  if (!run.scene) return;
  const TopFigures top = run.scene->top();
  data["top"] = {{"mass_kg", top.mass_kg},
                 {"center_of_mass_m", top.center_of_mass_m},
                 {"moments_about_center_kg_m2", top.moments_about_center_kg_m2}};
  if (run.scene->symmetry_axis() != 2) add_attitude(run, data);
  if (const auto& rotor = run.scene->scenario().rotor; rotor && !run.played.rows.empty()) add_rotor(run, *rotor, data);
  if (run.scene->model<double>().masses.any()) add_masses(run, data);
  if (run.scene->scenario().gimbals && !run.played.rows.empty()) add_ring(run, data);
  const Vec3<double> rate_L = earth_rate_L(*run.scene, 0);
  data["earth_rate_L"] = {rate_L[0], rate_L[1], rate_L[2]};
}

Vec3<double> earth_rate_L(const Scene& scene, double t_s) {
  const Model<double>& model = scene.model<double>();
  if (model.journey.empty()) return model.W_IL_L;
  const SinCos<double> phi = sin_cos_degrees(model.journey.place(t_s).latitude_deg);
  return Vec3<double>(scene.rotation_rate_rad_s() * Vec3<double>(0, phi.cos, phi.sin));
}

}  // namespace earthtop::report
