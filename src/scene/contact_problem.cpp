// SPDX-License-Identifier: GPL-3.0-or-later
// Makes contact and start of a top on a table.
#include <numbers>

#include "scene/support_laws.hpp"

namespace earthtop {

template <class T>
TableProblem<T> table_of(const Scene& scene, const Body<T>& body) {
  const ContactSpec& spec = *scene.scenario().contact;
  const EffectsSpec& effects = scene.scenario().effects;
  const auto& gradient = effects.applied.gravity_gradient;
  TableProblem<T> table;
  table.contact = make_contact<T>(spec, body, scene.site(), weights_of<T>(effects), gradient ? &*gradient : nullptr);
  if (effects.applied.friction()) {
    // The rates at release are found from the contact, and the spin alone as it is given.
    const ReleaseSpec& release = scene.scenario().release;
    const auto& w = release.angular_velocity_body_rad_s;
    table.contact.air = make_air_on_table<T>(effects.applied, scene.site(), w ? (*w)[2] : release.spin_rad_s);
  }
  table.start = make_contact_release<T>(spec, {});
  if (spec.max_tilt_deg) table.max_tilt_rad = *spec.max_tilt_deg * std::numbers::pi / 180;
  table.static_coefficient = spec.static_coefficient;
  return table;
}
template TableProblem<double> table_of(const Scene&, const Body<double>&);
template TableProblem<float80> table_of(const Scene&, const Body<float80>&);
template TableProblem<float128> table_of(const Scene&, const Body<float128>&);

}  // namespace earthtop
