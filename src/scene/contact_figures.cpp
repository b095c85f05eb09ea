// SPDX-License-Identifier: GPL-3.0-or-later
// The steady precessions of a symmetric top on a level table, for the laws of friction that let one be steady.
#include <cmath>

#include "earthtop/scene/top_figures.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {

void TableLaws::add_figures(TopFigures& top, const Scene& scene, double cosine) const {
  const Contact<double>& contact = scene.table<double>().contact;
  const bool may_be_steady = contact.law == ContactLaw::frictionless || contact.law == ContactLaw::rolling;
  const bool is_level = scene.scenario().contact->table_tilt_deg == 0;
  if (may_be_steady && is_level && scene.symmetry_axis() == 2 && std::abs(cosine) < 1) {
    const auto rate = [&](Precession which) {
      const auto found = steady_precession_on_table(contact, scene.site().gravity_m_s2, cosine, top.spin_rad_s, which);
      return found && std::isfinite(*found) ? found : std::nullopt;
    };
    top.slow_precession_rad_s = rate(Precession::steady_slow);
    top.fast_precession_rad_s = rate(Precession::steady_fast);
    if (top.slow_precession_rad_s) {
      top.notes.emplace_back("the precessions are those on this table, with the tip's motion");
      top.left_out.emplace_back(
          "nutation and critical spin: the formulas are those of a fixed pivot, and the tip moves on the table");
      return;
    }
  }
  top.left_out.emplace_back(
      "precession, nutation and critical spin: the formulas are those of a fixed pivot, and the tip moves on the table");
}

}  // namespace earthtop
