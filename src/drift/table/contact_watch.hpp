// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the events of a top on a table, in both predictions, while its drift is integrated.
///
/// Each event is a function g(t) of the motion that falls through 0. As it is a pair, its difference gives the time between the
/// two predictions' events without cancellation: with g_rot(t_ref) = epsilon d, the rotating motion's event is epsilon D later,
/// where d + g' D + epsilon g''/2 D^2 = 0.
///
/// To look between two states of the integration, the equations are integrated once more from the first of the two, as the search
/// for a threshold does (flow_search.hpp).
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "drift/watch/close_in.hpp"
#include "drift/watch/flow_search.hpp"

namespace earthtop {

/// The functions of a motion that fall through 0 at its events; not all of them in every scene.
template <class T>
struct ContactEventFunctions {
  static constexpr std::array<ContactEventKind, 6> kKinds = {
      ContactEventKind::lifted_off, ContactEventKind::rim_touched,  ContactEventKind::no_unique_force,
      ContactEventKind::inverted,   ContactEventKind::slip_started, ContactEventKind::patch_stopped};
  static constexpr std::size_t kCount = kKinds.size();
  using Values = std::array<Paired<T>, kCount>;

  Vec3<T> normal_L;                ///< of the table
  T weight = T(1);                 ///< m g
  T least_cosine = T(-2);          ///< of the tilt at which the rim touches; below -1: it never does
  std::optional<T> most_friction;  ///< per normal force, of a tip that rolls
  /// For `contensou`, the slip that is worth as much as a unit of turning (contact_forces.hpp); 0 for other laws.
  T slip_per_turning = T(0);
  T patch_at_release = T(0);  ///< slip and turning of the patch together at release

  /// Slip and turning of a patch together.
  Paired<T> patch_speed(const ContactDriftState<T>& state) const {
    const Paired<T> turning = Paired<T>(slip_per_turning) * state.turning;
    return real::sqrt(inner(state.slip_L, state.slip_L) + turning * turning);
  }
  /// A patch that moves at less than this share of its speed at release has stopped: steps become as short as what is left.
  static constexpr T kPatchStopped() { return T(1e-5); }

  /// Each of the order of 1.
  Values operator()(const ContactDriftState<T>& state) const {
    using P = Paired<T>;
    const P height = state.axis_L[0] * P(normal_L[0]) + state.axis_L[1] * P(normal_L[1]) + state.axis_L[2] * P(normal_L[2]);
    const ContactReaction<P>& reaction = state.reaction;
    Values g;
    g[0] = reaction.normal_force / P(weight);
    g[1] = height - P(least_cosine);
    g[2] = reaction.denominator;
    g[3] = height;
    g[4] = P(T(1));
    g[5] = P(T(1));
    // Where this is 0, friction has no derivative; it is approached like dry friction's stop, within a finite time.
    if (slip_per_turning > T(0))
      g[5] = patch_at_release > T(0) ? patch_speed(state) / P(patch_at_release) - P(kPatchStopped()) : P(T(0));
    if (most_friction) {
      const P square = inner(reaction.friction, reaction.friction), most = P(*most_friction) * reaction.normal_force;
      // Both sides are squared: friction may be 0, where its size has no derivative.
      g[4] = (most * most - square) / P(weight * weight);
    }
    return g;
  }
};

/// The functions of a scene, but for its largest tilt and the friction that rolling may need.
template <class T>
ContactEventFunctions<T> contact_event_functions(const Model<T>& model, const Contact<T>& contact,
                                                 const ContactRelease<T>& start) {
  ContactEventFunctions<T> functions;
  functions.normal_L = rotation_matrix(start.q_LH).col(2);
  functions.weight = contact.mass * norm(model.apparent_gravity_L);
  if (contact.law == ContactLaw::contensou && contact.coefficient > T(0))
    functions.slip_per_turning = contact.slip_of_spin * contact.patch_radius;
  return functions;
}

/// @tparam System  called with (x, dxdt, t); has the `Shape` of its states and contact_state(x, t)
template <class T, class System>
class ContactWatch {
 public:
  using State = std::array<T, System::kSize>;
  using Functions = ContactEventFunctions<T>;
  using Values = typename Functions::Values;

  /// @param motion_rate  roughly the rate of the fastest part of the motion (rad per unit of time)
  ContactWatch(const System& system, const Functions& functions, T motion_rate)
      : system_(system), functions_(functions), motion_rate_(motion_rate) {}

  /// Goes on to the next state of the integration. @returns whether an event has ended the run
  bool follow(T t, const State& x) {
    if (!started_ && functions_.slip_per_turning > T(0))
      functions_.patch_at_release = functions_.patch_speed(system_.contact_state(x, t)).ref;
    Look next{t, x, values(t, x), {}, false};
    if (!started_) see_start(next);
    if (started_) {
      if (may_fall(next)) {
        if (!last_.has_rates) find_rates(last_);
        find_rates(next);
        search(last_, next);
      }
    }
    started_ = true;
    last_ = next;
    return end_.has_value();
  }
  /// To be called where the integration could not go on. A motion may run into Painleve's paradox from a side on which the
  /// denominator of the normal force falls to 0 together with its numerator: the force then grows without bound, in ever shorter
  /// steps, and the denominator reaches 0 at their end.   @returns whether this is what ended it
  bool see_jam() {
    constexpr double kNear = 0.1;  // the denominator is of the order of 1
    if (!started_ || end_) return false;
    const Paired<T>& denominator = last_.g[kDenominator];
    if (!(std::min(denominator.ref, denominator.rot) < T(kNear))) return false;
    Event event{ContactEventKind::no_unique_force, std::nullopt, std::nullopt, std::nullopt};
    // The motion that comes to it first has ended the integration of both.
    (denominator.rot < denominator.ref ? event.t_rot : event.t_ref) = last_.t;
    events_.push_back(event);
    end_ = last_.t;
    return true;
  }
  /// In natural units of time; ascending where they belong to one kind. The difference is over epsilon.
  struct Event {
    ContactEventKind kind;
    std::optional<T> t_ref, t_rot;
    std::optional<T> difference;  ///< between the two times, over epsilon
  };
  const std::vector<Event>& events() const { return events_; }
  /// The time of the event that ends the run, in the prediction that it comes to first.
  std::optional<T> end() const { return end_; }

 private:
  /// A state, with the functions there and their rates.
  struct Look {
    T t = T(0);
    State x{};
    Values g, rate;
    bool has_rates = false;
  };
  static constexpr T kEnough() { return T(0.05); }
  static constexpr std::size_t kDenominator = 2;
  static_assert(Functions::kKinds[kDenominator] == ContactEventKind::no_unique_force);

  Values values(T t, const State& x) const { return functions_(system_.contact_state(x, t)); }
  /// Whether a function may fall through 0 since the last state: not if it is well above 0 and a short step hardly changes it.
  bool may_fall(const Look& next) const {
    if ((next.t - last_.t) * motion_rate_ > T(1)) return true;
    for (std::size_t k = 0; k < Functions::kCount; ++k)
      for (T Paired<T>::*motion : {&Paired<T>::ref, &Paired<T>::rot}) {
        const T before = last_.g[k].*motion, after = next.g[k].*motion, least = std::min(before, after);
        // A function that stays below 0 does not fall again; not a number is looked into.
        if (before < T(0) && after < T(0)) continue;
        if (!(least > T(4) * real::abs(after - before) && (least > T(0.1) || least > T(20) * real::abs(after - before))))
          return true;
      }
    return false;
  }
  Look look(T t, const State& x) const {
    Look made{t, x, values(t, x), {}, false};
    find_rates(made);
    return made;
  }
  void find_rates(Look& at) const {
    State dxdt, ahead;
    system_(at.x, dxdt, at.t);
    const T h = T(real::cbrt(static_cast<double>(real::epsilon<T>()))) / motion_rate_;
    for (std::size_t i = 0; i < dxdt.size(); ++i) ahead[i] = at.x[i] + h * dxdt[i];
    const Values then = values(at.t + h, ahead);
    for (std::size_t k = 0; k < Functions::kCount; ++k) at.rate[k] = (then[k] - at.g[k]) * Paired<T>(T(1) / h);
    at.has_rates = true;
  }
  /// Hermite's cubic of a function, at the fraction s of the way from p to q.
  static T cubic(const Look& p, const Look& q, std::size_t k, T Paired<T>::*motion, T s) {
    const T h = q.t - p.t, r = T(1) - s;
    return r * r * ((T(1) + T(2) * s) * p.g[k].*motion + s * h * (p.rate[k].*motion)) +
           s * s * ((T(3) - T(2) * s) * q.g[k].*motion - r * h * (q.rate[k].*motion));
  }
  /// Whether a function may fall through 0 between two looks, and rise again before the second.
  static bool may_dip(const Look& p, const Look& q, std::size_t k, T Paired<T>::*motion) {
    T least = std::min(p.g[k].*motion, q.g[k].*motion), most = std::max(p.g[k].*motion, q.g[k].*motion);
    for (int i = 1; i < 8; ++i) {
      const T value = cubic(p, q, k, motion, T(i) / T(8));
      least = std::min(least, value), most = std::max(most, value);
    }
    return least - kEnough() * (most - least) < T(0);
  }

  /// A release from which the contact cannot go on is an event as well.
  void see_start(const Look& look) {
    for (std::size_t k = Functions::kCount; k-- > 0;) {
      const bool ends = ends_run(Functions::kKinds[k]);
      if (Functions::kKinds[k] == ContactEventKind::inverted || (ends && end_)) continue;
      Event event{Functions::kKinds[k], std::nullopt, std::nullopt, std::nullopt};
      if (!(look.g[k].ref > T(0))) event.t_ref = look.t;
      if (!(look.g[k].rot > T(0))) event.t_rot = look.t;
      if (!event.t_ref && !event.t_rot) continue;
      events_.push_back(event);
      if (ends) end_ = look.t;
    }
  }
  void search(const Look& p, const Look& q) {
    for (std::size_t k = 0; k < Functions::kCount; ++k) {
      // Only the first event of a kind counts in each prediction: nutation may bring the axis back for a moment.
      Event* known = first(Functions::kKinds[k]);
      std::optional<T> t_ref, t_rot;
      if (known == nullptr || !known->t_ref) t_ref = falls(p, q, k, &Paired<T>::ref, 0);
      if (known == nullptr || !known->t_rot) t_rot = falls(p, q, k, &Paired<T>::rot, 0);
      if (!t_ref && !t_rot) continue;
      if (known == nullptr)
        add(k, p, t_ref, t_rot);
      else
        complete(*known, t_ref, t_rot);
    }
  }
  /// The first time between two looks at which a function of one motion falls through 0.
  std::optional<T> falls(const Look& p, const Look& q, std::size_t k, T Paired<T>::*motion, int halvings) const {
    constexpr int kMostHalvings = 8;
    const T before = p.g[k].*motion, after = q.g[k].*motion;
    if (before > T(0) && !(after > T(0))) {
      // Between looks so far apart it may do so more than once; the first time counts.
      T root = q.t, least = T(1e300);
      close_in(
          p.t, before, q.t, after,
          [&](T t) {
            const T value = at(t, p)[k].*motion;
            if (real::abs(value) < least) least = real::abs(value), root = t;
            return value;
          },
          [] { return false; });
      return root;
    }
    if (!(before > T(0)) || halvings == kMostHalvings || !may_dip(p, q, k, motion)) return std::nullopt;
    const T middle_t = p.t + (q.t - p.t) / T(2);
    State x = p.x;
    if (!advance(p.t, x, middle_t)) return std::nullopt;
    const Look middle = look(middle_t, x);
    if (const auto found = falls(p, middle, k, motion, halvings + 1)) return found;
    return falls(middle, q, k, motion, halvings + 1);
  }

  void add(std::size_t k, const Look& p, std::optional<T> t_ref, std::optional<T> t_rot) {
    const ContactEventKind kind = Functions::kKinds[k];
    Event event{kind, t_ref, t_rot, std::nullopt};
    const T epsilon = system_.equations().model().epsilon;
    if (const auto difference = time_difference(k, p, t_ref ? *t_ref : *t_rot, t_ref.has_value())) {
      event.difference = difference;
      if (t_ref)
        event.t_rot = *t_ref + epsilon * *difference;
      else
        event.t_ref = *t_rot - epsilon * *difference;
    } else if (t_ref && t_rot && epsilon > T(0)) {
      event.difference = (*t_rot - *t_ref) / epsilon;
    }
    events_.push_back(event);
    if (ends_run(kind)) {
      T first = T(1e300);
      for (const auto& t : {event.t_ref, event.t_rot})
        if (t) first = std::min(first, *t);
      if (!end_ || first < *end_) end_ = first;
    }
  }
  /// Adds the other prediction's event, which came too much later to follow from the first.
  void complete(Event& event, std::optional<T> t_ref, std::optional<T> t_rot) const {
    if (t_ref) event.t_ref = t_ref;
    if (t_rot) event.t_rot = t_rot;
    const T epsilon = system_.equations().model().epsilon;
    if (event.t_ref && event.t_rot && epsilon > T(0)) event.difference = (*event.t_rot - *event.t_ref) / epsilon;
  }
  Event* first(ContactEventKind kind) {
    for (Event& event : events_)
      if (event.kind == kind) return &event;
    return nullptr;
  }

  /// The time from the reference's event to the rotating motion's, over epsilon, from the pair near one of them; none where the
  /// two are too far apart for a polynomial.
  /// @param t  time of one of the events   @param from_reference  whether it is the reference's
  std::optional<T> time_difference(std::size_t k, const Look& p, T t, bool from_reference) const {
    const T epsilon = system_.equations().model().epsilon;
    // The values around the event have an error of order h^4 in the slope, as large as that by rounding.
    const T h = T(real::pow(static_cast<double>(real::epsilon<T>()), 0.2)) / motion_rate_;
    Paired<T> g[5];
    for (int i = 0; i < 5; ++i) {
      State x = p.x;
      if (!advance(p.t, x, t + T(i - 2) * h)) return std::nullopt;
      g[i] = values(t + T(i - 2) * h, x)[k];
    }
    // The other motion's function at the one's event is +-epsilon times the difference.
    T Paired<T>::*other = from_reference ? &Paired<T>::rot : &Paired<T>::ref;
    const T here = from_reference ? g[2].diff : -g[2].diff;
    // The other's function around there, minus its value, is a polynomial through the five values; its argument is time over h.
    const T odd = (g[3].*other - g[1].*other) / T(2), odd_far = (g[4].*other - g[0].*other) / T(2);
    const T even = (g[3].*other + g[1].*other) / T(2) - g[2].*other,
            even_far = (g[4].*other + g[0].*other) / T(2) - g[2].*other;
    const T cubic = (odd_far - T(2) * odd) / T(6), slope = odd - cubic;
    const T quartic = (even_far - T(4) * even) / T(12), parabola = even - quartic;
    if (!(slope < T(0))) return std::nullopt;
    const T linear = -here / slope;
    constexpr double kNear = 1e-3;  // then the polynomial's next term is below 1e-15 of the first
    if (!(real::abs(T(2) * epsilon * parabola * linear / slope) < T(kNear)) ||
        !(real::abs(epsilon * linear * h) * motion_rate_ < T(kNear)))
      return std::nullopt;
    // here + D (slope + parabola (epsilon D) + ...) = 0: each repetition gains three digits.
    T steps = linear;
    for (int i = 0; i < 16; ++i) {
      const T x = epsilon * steps, before = steps;
      steps = -here / (slope + x * (parabola + x * (cubic + x * quartic)));
      if (real::abs(steps - before) <= real::epsilon<T>() * real::abs(steps)) break;
    }
    const T D = steps * h;
    return from_reference ? D : -D;
  }

  /// The functions at a time, from the state of a look.
  Values at(T t, const Look& p) const {
    State x = p.x;
    if (!advance(p.t, x, t)) {
      Values none;
      for (auto& g : none) g = Paired<T>(T(-1));  // the motion ends before
      return none;
    }
    return values(t, x);
  }
  /// @param x  the state at `begin`; afterwards that at t   @returns whether t was reached
  bool advance(T begin, State& x, T t) const {
    if (t == begin) return true;
    GroupScales<T, typename System::Shape> scales;
    scales.include(x), scales.include(last_.x);
    scales.include(system_.typical_state());
    std::int64_t evaluations = 0;  // not counted anywhere
    const RightHandSide<T, System::kSize> equations(system_, evaluations);
    const T tolerance = T(512) * real::epsilon<T>();
    if (t > begin) return extrapolate(equations, scales, tolerance, begin, t, x);
    // Backwards, by less than a step: time is turned round.
    const auto backwards = [&](const State& at, State& rate, T ago) {
      system_(at, rate, begin - ago);
      for (T& component : rate) component = -component;
    };
    const RightHandSide<T, System::kSize> turned(backwards, evaluations);
    return extrapolate(turned, scales, tolerance, T(0), T(begin - t), x);
  }

  const System& system_;
  Functions functions_;
  T motion_rate_;
  bool started_ = false;
  Look last_;
  std::vector<Event> events_;
  std::optional<T> end_;
};

/// The events of a watch in seconds, each prediction's by itself, ascending in time.
template <class T, class Watch>
std::vector<ContactEvent> contact_events(const Watch& watch, T epsilon, const NaturalUnits& units) {
  std::vector<ContactEvent> made;
  const auto seconds = [&](T t) { return static_cast<double>(real::scale(t, units.time_exponent)); };
  for (const auto& event : watch.events()) {
    const bool both = event.t_ref && event.t_rot;
    std::optional<double> difference;
    if (both && event.difference) difference = seconds(T(epsilon * *event.difference));
    if (event.t_ref) made.push_back({event.kind, Prediction::reference, seconds(*event.t_ref), difference, std::nullopt});
    if (event.t_rot) made.push_back({event.kind, Prediction::rotating, seconds(*event.t_rot), difference, std::nullopt});
  }
  std::ranges::stable_sort(made, {}, &ContactEvent::t_s);
  return made;
}

}  // namespace earthtop
