// SPDX-License-Identifier: GPL-3.0-or-later
/// The times at which something happens to the contact of a top with its table, in both motions, by integrations without the
/// program's own search for events. Their values are in tests/data/contact/references.json; the generator and the test share the
/// scenes.
#pragma once

#include <fmt/format.h>

#include <stdexcept>

#include "earthtop/drift/contact_event.hpp"
#include "support/contact_more_scenes.hpp"

namespace earthtop::testing {

struct NamedEvent {
  std::string name;
  ContactEventKind kind;
  ContactScene scene;
};

/// Tops that turn over, whose stem or rim touches the table, and one whose rolling takes too much friction. The patches are those
/// of scenarios/studies/tippe-inversion.json.
inline std::vector<NamedEvent> named_events() {
  std::vector<NamedEvent> events;
  for (const ContactReference& top : tippe_tops())
    events.push_back({std::string("inversion, ") + top.name, ContactEventKind::inverted, top.scene});
  for (const auto& [friction, patch_m] :
       {std::pair(0.1, 5e-5), std::pair(0.1, 1.6e-3), std::pair(0.2, 5e-5), std::pair(0.2, 1.6e-3), std::pair(0.4, 1.6e-3)}) {
    ContactSpec contact{.tip_radius_m = 0.015, .law = ContactLaw::contensou};
    contact.friction_coefficient = friction, contact.patch_radius_m = patch_m, contact.max_tilt_deg = 140.3;
    const std::string of = fmt::format("Leine and Glocker's top, friction {:g}, patch {:g} m", friction, patch_m);
    events.push_back({"inversion, " + of, ContactEventKind::inverted, leine_glocker_top(contact)});
    if (friction == 0.4) events.push_back({"stem touches, " + of, ContactEventKind::rim_touched, leine_glocker_top(contact)});
  }
  ContactSpec patch{.tip_radius_m = 0.002, .law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4};
  patch.max_tilt_deg = 60;
  ContactScene slow = toy_on_table(patch);
  slow.spin_rad_s = 60;
  events.push_back({"rim touches, a toy top too slow to stand", ContactEventKind::rim_touched, slow});
  ContactSpec rolling{.tip_radius_m = 0.002, .law = ContactLaw::rolling, .start = ContactStart::rolling};
  rolling.static_coefficient = 0.35;
  ContactScene hard = toy_on_table(rolling);
  hard.transverse_rad_s = {-3, 0};
  events.push_back({"slip starts, a toy top that rolls", ContactEventKind::slip_started, hard});
  return events;
}

/// A number that becomes negative as the event happens.
template <class T>
T before_event(const NamedEvent& event, const ContactDriftState<T>& contact, T Paired<T>::*member) {
  const auto radians = [](double degrees) { return T(degrees) * real::pi<T>() / T(180); };
  switch (event.kind) {
    case ContactEventKind::inverted: return contact.axis_L[2].*member;
    case ContactEventKind::rim_touched:
      return contact.axis_L[2].*member - real::cos(radians(event.scene.contact.max_tilt_deg.value()));
    case ContactEventKind::slip_started: {
      const T most = T(event.scene.contact.static_coefficient.value()) * contact.reaction.normal_force.*member;
      T square = most * most;
      for (int i = 0; i < 3; ++i) square -= contact.reaction.friction[i].*member * contact.reaction.friction[i].*member;
      return square;
    }
    default: throw std::logic_error("no such event here");
  }
}

/// The times in the reference and in the rotating motion (s), each within rounding of where a secant's steps converge.
template <class T, Observer O>
std::array<T, 2> event_times(const NamedEvent& event, double tolerance) {
  const ContactProblem<T> problem(event.scene);
  const auto system = problem.template system<O>();
  using System = decltype(problem.template system<O>());
  using State = typename System::State;
  State x = system.initial_state(), x_before = x;
  GroupScales<T, typename System::Shape> scales;
  scales.include(x), scales.include(system.typical_state());
  Extrapolation<T, typename System::Shape> stepper(T(tolerance), scales);
  T t = T(0), dt = T(0.05), before = t;
  std::array<T, 2> times;
  const std::array members{&Paired<T>::ref, &Paired<T>::rot};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto number = [&](const State& y, T at) { return before_event<T>(event, system.contact_state(y, at), members[k]); };
    while (number(x, t) > T(0)) {
      x_before = x, before = t;
      stepper.try_step(system, x, t, dt);
      scales.include(x);
    }
    const auto after = [&](T duration) {  // the number so long after `before`, by a shorter step
      State y = x_before;
      Extrapolation<T, typename System::Shape> fresh(T(tolerance), scales);
      const T end = before + duration;
      T at = before, step = duration;
      for (bool landed = false; !landed;) {
        step = std::min(step, T(end - at));
        const bool lands = at + step >= end;
        landed = fresh.try_step(system, y, at, step) == boost::numeric::odeint::success && lands;
      }
      return number(y, end);
    };
    T a = T(0), b = t - before, at_a = number(x_before, before), at_b = number(x, t);
    if (!(at_a > T(0))) throw std::runtime_error(event.name + ": the two motions' events are more than a step apart");
    // The steps' own errors make the number noisy; the last secant step gains more digits than it shows.
    const T close = std::max(T(2) * real::epsilon<T>(), T(tolerance) / T(100));
    for (int i = 0; i < 60; ++i) {
      // The secant, with the number at the end that stays halved (Illinois).
      const T c = b - at_b * (b - a) / (at_b - at_a), change = c - b, at_c = after(c);
      if (at_c == T(0) || real::abs(change) <= close * t) {
        b = c;
        break;
      }
      if ((at_c > T(0)) == (at_b > T(0)))
        at_a /= T(2);
      else
        a = b, at_a = at_b;
      b = c, at_b = at_c;
    }
    times[k] = real::scale(T(before + b), problem.units.time_exponent);
  }
  return times;
}

}  // namespace earthtop::testing
