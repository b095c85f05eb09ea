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

/// A sum of given functions of time, each times a number or a parameter.
template <class T, class Function>
class RecordedSum {
 public:
  using Scalar = real::Recorded<T>;
  using Rows = std::span<std::array<T, 3>>;
  void add(Scalar factor, Function function) {
    if (!function.empty()) terms_.push_back({factor, std::move(function)});
  }
  bool empty() const { return terms_.empty(); }

 protected:
  struct Term {
    Scalar factor;
    Function function;
  };
  /// @param expand  puts the coefficients of one of the functions at a time into rows
  template <class Expand>
  Vec3<Scalar> sum(const Scalar& t, const Expand& expand) const {
    Vec3<Scalar> sum = Vec3<Scalar>::Zero();
    for (const Term& term : terms_) {
      taylor::GivenFunction<T> given;
      given.components = 3;
      given.expand = [function = term.function, expand](T at, Rows rows) { expand(function, at, rows); };
      const std::array<int, 3> places = t.recording()->given(std::move(given), t.value());
      for (std::size_t i = 0; i < 3; ++i) sum[static_cast<int>(i)] += term.factor * Scalar(*t.recording(), places[i]);
    }
    return sum;
  }
  std::vector<Term> terms_;
};

template <class T>
class TideSeries<real::Recorded<T>> : public RecordedSum<T, TideSeries<T>> {
 public:
  using Scalar = real::Recorded<T>;
  TideSeries() = default;
  explicit TideSeries(TideSeries<T> tide) { this->add(Scalar(T(1)), std::move(tide)); }

  Vec3<Scalar> acceleration_L(const Scalar& t) const {
    return this->sum(t, [](const TideSeries<T>& tide, T at, auto rows) { tide.expand(at, rows); });
  }
};

/// Journeys of one kind. Steps have to end where pieces do.
template <class T>
class Journey<real::Recorded<T>> : public RecordedSum<T, Journey<T>> {
 public:
  using Scalar = real::Recorded<T>;
  Journey() = default;
  explicit Journey(Journey<T> journey) { this->add(Scalar(T(1)), std::move(journey)); }

  bool has_still_reference() const { return !this->empty() && first().has_still_reference(); }
  bool is_felt_by_both() const { return first().is_felt_by_both(); }
  bool is_felt() const { return first().is_felt(); }
  Vec3<Scalar> at(JourneyPart part, const Scalar& t) const {
    return this->sum(t, [part](const Journey<T>& journey, T at, auto rows) { journey.expand(part, at, rows); });
  }
  /// The turn of one journey alone, since no derivative is taken of a platform's turn.
  Scalar turned(const Scalar& t, int order) const {
    taylor::GivenFunction<T> function;
    function.components = 1;
    function.expand = [journey = first(), order](T at, std::span<std::array<T, 3>> rows) {
      const auto skipped = static_cast<std::size_t>(order);
      std::vector<std::array<T, 3>> course(rows.size() + skipped);
      journey.expand(JourneyPart::course, at, course);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        T factor = T(1);
        for (std::size_t j = 1; j <= skipped; ++j) factor *= T(static_cast<int>(k + j));
        rows[k] = {factor * course[k + skipped][0], T(0), T(0)};
      }
    };
    return {*t.recording(), t.recording()->given(std::move(function), t.value())[0]};
  }

 private:
  const Journey<T>& first() const { return this->terms_[0].function; }
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
  std::shared_ptr<const Journey<R>> operator()(const std::shared_ptr<const Journey<T>>& journey) const {
    return journey ? std::make_shared<const Journey<R>>(*journey) : nullptr;
  }
};

/// A struct of coefficients, over the scalar that records operations.
template <template <class> class Struct, class T>
Struct<real::Recorded<T>> recorded(const Struct<T>& coefficients) {
  return converted<real::Recorded<T>>(coefficients, ToRecorded<T>());
}

}  // namespace earthtop
