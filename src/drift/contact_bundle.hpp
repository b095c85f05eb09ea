// SPDX-License-Identifier: GPL-3.0-or-later
/// One motion on a table and its derivatives along several changes at once: of its inputs (contact_change.hpp), or of its start.
/// The equations of each derivative are those of a pair of motions with epsilon = 0; the pairs share the motion, which is recorded
/// and expanded once.
#pragma once

#include <stdexcept>
#include <utility>
#include <vector>

#include "drift/contact_general_drift.hpp"
#include "drift/contact_reduced_drift.hpp"

namespace earthtop {

/// A bundle is followed for at most this many steps.
inline constexpr std::int64_t kMostBundleSteps = 20'000'000;

/// The motion (the first half of a pair's state), then the derivatives, each like the second half.
template <class PairShape>
struct ContactBundleShape {
  static constexpr std::size_t kMostChanges = 6;
  static constexpr std::size_t kEach = PairShape::kHalf, kSize = kEach * (1 + kMostChanges);
  static constexpr auto kPairGroups = PairShape::groups();
  static constexpr std::size_t kMotionGroups = [] {
    std::size_t count = 0;
    for (const ComponentGroup& group : kPairGroups) count += group.begin < kEach ? 1U : 0U;
    return count;
  }();
  static constexpr auto groups() {
    constexpr std::size_t kChangeGroups = kPairGroups.size() - kMotionGroups;
    std::array<ComponentGroup, kMotionGroups + kMostChanges * kChangeGroups> all{};
    for (std::size_t g = 0; g < kMotionGroups; ++g) all[g] = kPairGroups[g];
    for (std::size_t c = 0; c < kMostChanges; ++c)
      for (std::size_t g = 0; g < kChangeGroups; ++g) {
        ComponentGroup group = kPairGroups[kMotionGroups + g];
        group.begin += c * kEach;
        all[kMotionGroups + c * kChangeGroups + g] = group;
      }
    return all;
  }
};

/// @tparam Equations  of a pair of motions, in laboratory axes
template <class T, class Equations>
class ContactBundleEquations {
 public:
  using Pair = typename Equations::Shape;
  using Shape = ContactBundleShape<Pair>;
  using State = std::array<T, Shape::kSize>;
  using PairState = typename Equations::State;

  /// @param each  the equations of each pair; their motion is the same
  explicit ContactBundleEquations(std::vector<Equations> each) : each_(std::move(each)) {
    if (each_.empty() || each_.size() > Shape::kMostChanges) throw std::logic_error("a bundle of none or too many changes");
  }
  void operator()(const State& x, State& dxdt, T t) const {
    for (T& rate : dxdt) rate = T(0);
    for (std::size_t c = 0; c < each_.size(); ++c) {
      PairState rate;
      each_[c](pair(x, c), rate, t);
      // The integrals, which come last, have no derivatives here.
      for (std::size_t i = 0; i < Pair::kWork; ++i) {
        if (c == 0) dxdt[i] = rate[i];
        dxdt[(1 + c) * Shape::kEach + i] = rate[Shape::kEach + i];
      }
    }
  }
  /// The motion with one of its derivatives.
  static PairState pair(const State& x, std::size_t c) {
    PairState both;
    for (std::size_t i = 0; i < Shape::kEach; ++i) both[i] = x[i], both[Shape::kEach + i] = x[(1 + c) * Shape::kEach + i];
    return both;
  }
  static void put_pair(const PairState& both, State& x, std::size_t c) {
    for (std::size_t i = 0; i < Shape::kEach; ++i) x[i] = both[i], x[(1 + c) * Shape::kEach + i] = both[Shape::kEach + i];
  }
  const std::vector<Equations>& each() const { return each_; }

 private:
  std::vector<Equations> each_;
};

/// The operations of a bundle's right-hand side.
taylor::Operations<double> record_contact_bundle(
    const ContactBundleEquations<double, ContactReducedEquations<double, Observer::laboratory>>& bundle,
    std::span<const double> x, double t);
taylor::Operations<double> record_contact_bundle(
    const ContactBundleEquations<double, ContactGeneralEquations<double, Observer::laboratory>>& bundle,
    std::span<const double> x, double t);

/// The system of a bundle, for steps of a Taylor series.
/// @tparam Drift  ContactReducedDrift or ContactGeneralDrift of double, in laboratory axes
template <class Drift>
class ContactBundle {
 public:
  using Equations = typename Drift::Equations;
  using Bundle = ContactBundleEquations<double, Equations>;
  using Shape = typename Bundle::Shape;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<double, kSize>;
  using Series = RecordedSeries<double, kSize>;

  /// @param drifts  the pairs: their models have epsilon = 0
  explicit ContactBundle(std::vector<Drift> drifts) : drifts_(std::move(drifts)), bundle_(equations_of(drifts_)) {}

  std::size_t size() const { return drifts_.size(); }
  const Drift& drift(std::size_t c) const { return drifts_[c]; }
  State initial_state() const { return filled(&Drift::initial_state); }
  State typical_state() const { return filled(&Drift::typical_state); }
  ContactDriftState<double> contact_state(const State& x, std::size_t c, double t) const {
    return drifts_[c].contact_state(Bundle::pair(x, c), t);
  }
  Series series() const {
    return Series([this](const State& x, double t) { return record_contact_bundle(bundle_, x, t); });
  }

 private:
  static std::vector<Equations> equations_of(const std::vector<Drift>& drifts) {
    std::vector<Equations> each;
    each.reserve(drifts.size());
    for (const Drift& drift : drifts) each.push_back(drift.equations());
    return each;
  }
  State filled(typename Drift::State (Drift::*state)() const) const {
    State x{};
    for (std::size_t c = 0; c < Shape::kMostChanges; ++c) Bundle::put_pair((drifts_[c < size() ? c : 0].*state)(), x, c);
    return x;
  }

  std::vector<Drift> drifts_;
  Bundle bundle_;
};

}  // namespace earthtop
