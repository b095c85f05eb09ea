// SPDX-License-Identifier: GPL-3.0-or-later
/// A model over the scalar that records operations: the same numbers, and functions of time that bring their Taylor
/// coefficients. It has to be included before any header of the model.
#pragma once

#include <vector>

#include "integrate/taylor/recorded.hpp"
#include "integrate/taylor/recorded_pair.hpp"
//
#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/frames/journey.hpp"
#include "earthtop/frames/tide.hpp"
#include "earthtop/model/mass_path.hpp"

namespace earthtop {

/// A table of angles: the coefficients are those of the cubic piece at the time asked for. Steps have to end where pieces do.
template <class T>
class AngleSpline<real::Recorded<T>> {
 public:
  using Scalar = real::Recorded<T>;
  explicit AngleSpline(std::shared_ptr<const AngleSpline<T>> table) : table_(std::move(table)) {}

  Scalar angle(const Scalar& t) const { return derivative(t, 0); }
  Scalar angle_rate(const Scalar& t) const { return derivative(t, 1); }
  Scalar angle_acceleration(const Scalar& t) const { return derivative(t, 2); }
  bool is_zero() const { return table_->is_zero(); }

 private:
  Scalar derivative(const Scalar& t, int order) const {
    taylor::GivenFunction<T> function;
    function.components = 1;
    function.expand = [table = table_, order](T at, std::span<std::array<T, 3>> rows) {
      std::array<T, 4> c = table->cubic(at);
      for (int i = 0; i < order; ++i) c = {c[1], T(2) * c[2], T(3) * c[3], T(0)};
      for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = {k < 4 ? c[k] : T(0), T(0), T(0)};
    };
    return {*t.recording(), t.recording()->given(std::move(function), t.value())[0]};
  }
  std::shared_ptr<const AngleSpline<T>> table_;
};

/// The path of a mass: the coefficients are those of the polynomial at the time asked for. Steps have to end where pieces do.
template <class T>
class PiecewisePath<real::Recorded<T>> {
 public:
  using Scalar = real::Recorded<T>;
  explicit PiecewisePath(std::shared_ptr<const PiecewisePath<T>> path) : path_(std::move(path)) {}

  PointOnPath<Scalar> at(const Scalar& t) const { return {derivative(t, 0), derivative(t, 1), derivative(t, 2)}; }
  Vec3<Scalar> place(const Scalar& t) const { return derivative(t, 0); }

 private:
  Vec3<Scalar> derivative(const Scalar& t, int order) const {
    taylor::GivenFunction<T> function;
    function.components = 3;
    function.expand = [path = path_, order](T at, std::span<std::array<T, 3>> rows) { path->expand(at, order, rows); };
    const std::array<int, 3> places = t.recording()->given(std::move(function), t.value());
    return {Scalar(*t.recording(), places[0]), Scalar(*t.recording(), places[1]), Scalar(*t.recording(), places[2])};
  }
  std::shared_ptr<const PiecewisePath<T>> path_;
};

/// The tide: a sum of tides, each times a number or a parameter.
template <class T>
class TideSeries<real::Recorded<T>> {
 public:
  using Scalar = real::Recorded<T>;
  TideSeries() = default;
  explicit TideSeries(TideSeries<T> tide) { add(Scalar(T(1)), std::move(tide)); }
  void add(Scalar factor, TideSeries<T> tide) {
    if (!tide.empty()) terms_.push_back({factor, std::move(tide)});
  }

  bool empty() const { return terms_.empty(); }
  Vec3<Scalar> acceleration_L(const Scalar& t) const {
    Vec3<Scalar> sum = Vec3<Scalar>::Zero();
    for (const Term& term : terms_) {
      taylor::GivenFunction<T> function;
      function.components = 3;
      function.expand = [tide = term.tide](T at, std::span<std::array<T, 3>> rows) { tide.expand(at, rows); };
      const std::array<int, 3> places = t.recording()->given(std::move(function), t.value());
      for (std::size_t i = 0; i < 3; ++i) sum[static_cast<int>(i)] += term.factor * Scalar(*t.recording(), places[i]);
    }
    return sum;
  }

 private:
  struct Term {
    Scalar factor;
    TideSeries<T> tide;
  };
  std::vector<Term> terms_;
};

/// A journey: a sum of journeys of one kind, each times a number or a parameter. Steps have to end where pieces do.
template <class T>
class Journey<real::Recorded<T>> {
 public:
  using Scalar = real::Recorded<T>;
  Journey() = default;
  explicit Journey(Journey<T> journey) { add(Scalar(T(1)), std::move(journey)); }
  void add(Scalar factor, Journey<T> journey) {
    if (!journey.empty()) terms_.push_back({factor, std::move(journey)});
  }

  bool empty() const { return terms_.empty(); }
  bool has_still_reference() const { return !empty() && terms_[0].journey.has_still_reference(); }
  bool is_felt_by_both() const { return terms_[0].journey.is_felt_by_both(); }
  bool is_felt() const { return terms_[0].journey.is_felt(); }
  Vec3<Scalar> at(JourneyPart part, const Scalar& t) const {
    Vec3<Scalar> sum = Vec3<Scalar>::Zero();
    for (const Term& term : terms_) {
      taylor::GivenFunction<T> function;
      function.components = 3;
      function.expand = [journey = term.journey, part](T at, std::span<std::array<T, 3>> rows) {
        journey.expand(part, at, rows);
      };
      const std::array<int, 3> places = t.recording()->given(std::move(function), t.value());
      for (std::size_t i = 0; i < 3; ++i) sum[static_cast<int>(i)] += term.factor * Scalar(*t.recording(), places[i]);
    }
    return sum;
  }

 private:
  struct Term {
    Scalar factor;
    Journey<T> journey;
  };
  std::vector<Term> terms_;
};

}  // namespace earthtop

// The formulas of the model follow, now that the functions above are known to them.
#include "earthtop/model/converted.hpp"
#include "earthtop/model/model.hpp"

namespace earthtop {

/// Takes a coefficient, or a function of time, to the scalar that records operations: see converted.hpp.
template <class T>
struct ToRecorded {
  using R = real::Recorded<T>;
  R operator()(const T& number) const { return number; }
  std::shared_ptr<const AngleSpline<R>> operator()(const std::shared_ptr<const AngleSpline<T>>& table) const {
    return table ? std::make_shared<const AngleSpline<R>>(table) : nullptr;
  }
  std::shared_ptr<const PiecewisePath<R>> operator()(const std::shared_ptr<const PiecewisePath<T>>& path) const {
    return path ? std::make_shared<const PiecewisePath<R>>(path) : nullptr;
  }
  TideSeries<R> operator()(const TideSeries<T>& tide) const { return TideSeries<R>(tide); }
  Journey<R> operator()(const Journey<T>& journey) const { return Journey<R>(journey); }
};

/// A struct of coefficients, over the scalar that records operations.
template <template <class> class Struct, class T>
Struct<real::Recorded<T>> recorded(const Struct<T>& coefficients) {
  return converted<real::Recorded<T>>(coefficients, ToRecorded<T>());
}

}  // namespace earthtop
