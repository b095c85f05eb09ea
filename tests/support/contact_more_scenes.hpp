// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes on a table whose references tests/data/contact/references.json holds: combinations of effects and bodies. The generator
/// and the test share them.
#pragma once

#include <string>
#include <vector>

#include "support/contact_references.hpp"

namespace earthtop::testing {

struct NamedScene {
  std::string name;
  ContactScene scene;
  double t_s;
  bool symmetric;
};

inline std::vector<NamedScene> more_contact_scenes() {
  ContactSpec contensou{.tip_radius_m = 0.002,
                        .law = ContactLaw::contensou,
                        .friction_coefficient = 0.2,
                        .patch_radius_m = 1e-4,
                        .spinning_friction_m = 1e-4,
                        .rolling_resistance_m = 2e-5,
                        .regularisation_rad_s = 3};
  ContactSpec rolling = contensou;
  rolling.law = ContactLaw::rolling, rolling.start = ContactStart::rolling;
  ContactSpec pure = rolling;
  pure.spinning_friction_m = pure.rolling_resistance_m = 0;
  ContactSpec slope{.tip_radius_m = 0.002, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.05};
  slope.table_tilt_deg = 2, slope.table_tilt_azimuth_deg = 30;
  std::vector<NamedScene> scenes{
      {"contensou with spinning friction and rolling resistance", toy_on_table(contensou), 1, true},
      {"rolling with spinning friction and rolling resistance", toy_on_table(rolling), 1, true},
      {"a tilted table", toy_on_table(slope), 1, true},
      {"rolling without symmetry", toy_on_table(pure), 0.25, false},
      {"contensou without symmetry on a slope, inertial rates", toy_on_table(contensou), 0.25, false}};
  scenes[3].scene.I2_kg_m2 = scenes[4].scene.I2_kg_m2 = 2.5e-5;
  scenes[4].scene.center_across_m = 0.001, scenes[4].scene.rates = RatesRelativeTo::inertial;
  scenes[4].scene.contact.table_tilt_deg = 1, scenes[4].scene.contact.table_tilt_azimuth_deg = 200;
  return scenes;
}

/// Rows are compared by these numbers: axis, tip, spin and normal force of the reference and of the rotating motion, then the drift of all
/// of them, in SI units.
template <class T>
std::vector<T> figures_of(const ContactProblem<T>& problem, const ContactRow<T>& row) {
  std::vector<T> figures;
  const int force = problem.units.mass_exponent - 2 * problem.units.time_exponent;
  const Paired<T>& N = row.contact.reaction.normal_force;
  for (const auto member : {&Paired<T>::ref, &Paired<T>::rot, &Paired<T>::diff}) {
    const T scale = member == &Paired<T>::diff ? row.epsilon : T(1);
    for (const Vec3<Paired<T>>* v : {&row.contact.axis_L, &row.contact.tip_L})
      for (int i = 0; i < 3; ++i) figures.push_back(scale * (*v)[i].*member);
    figures.push_back(scale * row.spin_rad_s.*member);
    figures.push_back(real::scale(T(scale * N.*member), force));
  }
  return figures;
}
/// The groups of figures that are one quantity, by their number of components.
inline constexpr std::array kFigureGroups{3, 3, 1, 1, 3, 3, 1, 1, 3, 3, 1, 1};

/// The largest error of a quantity relative to its size.
template <class T>
double worst_error(const std::vector<T>& found, const std::vector<T>& known) {
  double worst = 0;
  std::size_t at = 0;
  for (const int count : kFigureGroups) {
    T error = T(0), size = T(0);
    for (int i = 0; i < count; ++i, ++at) {
      error += (found[at] - known[at]) * (found[at] - known[at]);
      size += known[at] * known[at];
    }
    worst = std::max(worst, static_cast<double>(real::sqrt(T(error / size))));
  }
  return worst;
}

/// The tippe tops that turn over.
inline std::vector<ContactReference> tippe_tops() {
  std::vector<ContactReference> all = contact_references();
  std::erase_if(all, [](const ContactReference& r) { return r.name[1] < '5' || r.name[1] > '7'; });
  return all;
}

}  // namespace earthtop::testing
