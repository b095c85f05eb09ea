// SPDX-License-Identifier: GPL-3.0-or-later
/// A scalar that writes down what is computed with it. A formula that is a template on its scalar, evaluated once with this
/// one, leaves the list of its operations (operations.hpp), from which its Taylor series is computed. So each torque is written
/// once, and has a series as soon as it is written.
///
/// Operations on numbers are carried out immediately; adding 0, multiplying by 0 or 1, and repeating an operation add nothing
/// to the list. As a formula may branch, every result also has the value that it had in the recorded evaluation; comparisons are
/// decided by these values and noted as guards.
///
/// The scalar lives in the namespace `real`. This header has to be included before any header whose templates call the
/// functions of that namespace by their qualified names, vectors.hpp among them.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "earthtop/real.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop {
namespace taylor {

/// Follows from what an operation computes, and not from its place in the list. The form comes first, so that tops whose numbers differ
/// have the same list wherever it can be.
struct Mark {
  std::uint64_t form = 0;     ///< of the operation and its operands, without their numbers
  std::uint64_t numbers = 0;  ///< of form and numbers
  auto operator<=>(const Mark&) const = default;
};

/// The list while it is written.
template <class T>
class Recording {
 public:
  /// Adds an operation, unless the same one is in the list. @returns its place
  int add(const Operation<T>& operation, T value) {
    const auto [found, is_new] = places_.try_emplace(key_of(operation), static_cast<int>(operations_.list.size()));
    if (is_new) operations_.list.push_back(operation), values_.push_back(value), marks_.push_back(mark_of(operation, value));
    return found->second;
  }
  Mark mark(int place) const { return marks_[static_cast<std::size_t>(place)]; }
  int constant(T number) { return add({.kind = Kind::constant, .number = number}, number); }
  /// Adds a number by which the right-hand side may be differentiated; each call makes another one.
  int parameter(T number) { return add({.kind = Kind::parameter, .a = parameters_++, .number = number}, number); }
  /// Adds sine and cosine of a result. @returns the place of the sine; the cosine has the next one
  int sine_and_cosine(int argument) {
    const auto known = sines_.find(argument);
    if (known != sines_.end()) return known->second;
    const SinCos<T> both = real::sin_cos(value(argument));
    const int sine = add({.kind = Kind::sine, .a = argument}, both.sin);
    add({.kind = Kind::cosine, .a = argument, .b = sine}, both.cos);
    sines_.emplace(argument, sine);
    return sine;
  }
  /// Adds a function of time. @returns the places of its first three components (fewer if it has fewer)
  std::array<int, 3> given(GivenFunction<T> function, T t) {
    std::array<std::array<T, 3>, 1> now{};
    function.expand(t, now);
    const int number = static_cast<int>(operations_.given.size());
    std::array<int, 3> places = {-1, -1, -1};
    for (int i = 0; i < function.components; ++i)
      places[static_cast<std::size_t>(i)] =
          add({.kind = Kind::given, .a = number, .b = i}, now[0][static_cast<std::size_t>(i)]);
    operations_.given.push_back(std::move(function));
    return places;
  }
  bool compare(int less, int more) {
    const bool outcome = value(less) < value(more);
    operations_.guards.push_back({less, more, outcome});
    return outcome;
  }
  /// If a result is a number times another result: that other one, and the number; otherwise the result itself, and 1.
  std::pair<int, T> unscaled(int place) const {
    const Operation<T>& o = operations_.list[static_cast<std::size_t>(place)];
    const bool scales = o.kind == Kind::linear && o.b < 0 && o.number == T(0);
    return scales ? std::pair(o.a, o.factor_a) : std::pair(place, T(1));
  }
  T value(int place) const { return values_[static_cast<std::size_t>(place)]; }
  /// Takes the list, with the results that are the right-hand side.
  Operations<T> finish(const std::vector<int>& outputs) {
    operations_.outputs = outputs;
    return std::move(operations_);
  }

 private:
  using Bits = std::pair<std::uint64_t, std::uint64_t>;
  using Key = std::tuple<Kind, int, int, Bits, Bits, Bits>;
  static Key key_of(const Operation<T>& o) { return {o.kind, o.a, o.b, bits(o.number), bits(o.factor_a), bits(o.factor_b)}; }
  Mark mark_of(const Operation<T>& o, T value) const {
    const auto mix = [](std::uint64_t& mark, std::uint64_t bits) {
      mark = (mark ^ bits) * 0x9e3779b97f4a7c15U;
      mark ^= mark >> 32U;
    };
    const bool has_operands = has_operand(o.kind), is_numbered = o.kind == Kind::state || o.kind == Kind::parameter;
    const Mark a = has_operands && o.a >= 0 ? this->mark(o.a) : Mark{is_numbered ? static_cast<std::uint64_t>(o.a) : 0U, 0};
    const Mark b = has_operands && o.b >= 0 ? this->mark(o.b) : Mark{};
    Mark mark{static_cast<std::uint64_t>(o.kind), 0};
    mix(mark.form, a.form), mix(mark.form, b.form);
    mark.numbers = mark.form;
    mix(mark.numbers, a.numbers), mix(mark.numbers, b.numbers);
    for (const T number : {o.number, o.factor_a, o.factor_b})
      mix(mark.numbers, bits(number).first), mix(mark.numbers, bits(number).second);
    // Functions of time are numbered as they are met.
    if (o.kind == Kind::given) mix(mark.numbers, bits(value).first), mix(mark.numbers, bits(value).second);
    return mark;
  }
  /// A number as an ordered key; -0 and 0 are different numbers.
  static Bits bits(T number) {
    const auto high = static_cast<double>(number);
    const auto rest = static_cast<double>(number - T(high));
    return {std::bit_cast<std::uint64_t>(high), std::bit_cast<std::uint64_t>(rest)};
  }

  Operations<T> operations_;
  std::vector<T> values_;
  std::vector<Mark> marks_;
  std::map<Key, int> places_;
  std::map<int, int> sines_;
  int parameters_ = 0;
};

}  // namespace taylor

namespace real {

/// A number, or the result of a recorded operation.
template <class T>
class Recorded {
 public:
  using Recording = taylor::Recording<T>;
  using Kind = taylor::Kind;

  Recorded() = default;
  Recorded(T number) : number_(number) {}  // NOLINT(google-explicit-constructor): numbers in formulas are constants
  Recorded(int number) : number_(static_cast<T>(number)) {}  // NOLINT(google-explicit-constructor): the same
  explicit Recorded(double number) requires(!std::is_same_v<T, double>) : number_(static_cast<T>(number)) {}
  Recorded(Recording& recording, int place) : recording_(&recording), place_(place), number_(recording.value(place)) {}

  bool is_number() const { return recording_ == nullptr; }
  /// The number, or the result's value in the recorded evaluation.
  T value() const { return number_; }
  Recording* recording() const { return recording_; }
  /// The place in the list of a recording; a number gets one.
  int place_in(Recording& recording) const { return is_number() ? recording.constant(number_) : place_; }

  Recorded& operator+=(const Recorded& y) { return *this = *this + y; }
  Recorded& operator-=(const Recorded& y) { return *this = *this - y; }
  Recorded& operator*=(const Recorded& y) { return *this = *this * y; }
  Recorded& operator/=(const Recorded& y) { return *this = *this / y; }

  friend Recorded operator+(const Recorded& x, const Recorded& y) { return sum(x, T(1), y, T(1)); }
  friend Recorded operator-(const Recorded& x, const Recorded& y) { return sum(x, T(1), y, T(-1)); }
  friend Recorded operator-(const Recorded& x) { return scaled(x, T(-1)); }
  friend Recorded operator*(const Recorded& x, const Recorded& y) {
    if (x.is_number()) return scaled(y, x.number_);
    if (y.is_number()) return scaled(x, y.number_);
    // Factors come out of the product, so that x y, y x and (2 x) y share one operation. A product's series is summed from its
    // first factor on: which one comes first must not depend on the order in which a compiler has x y and y x computed.
    Recording& recording = *x.recording_;
    const auto [u, f] = recording.unscaled(x.place_);
    const auto [v, g] = recording.unscaled(y.place_);
    const auto [a, b] = recording.mark(u) <= recording.mark(v) ? std::pair(u, v) : std::pair(v, u);
    return scaled(x.made({.kind = Kind::product, .a = a, .b = b}, recording.value(a) * recording.value(b)), f * g);
  }
  friend Recorded operator/(const Recorded& x, const Recorded& y) {
    if (x.is_number() && (y.is_number() || x.number_ == T(0))) return x.number_ / y.number_;
    Recording& recording = x.is_number() ? *y.recording_ : *x.recording_;
    if (y.is_number()) {
      // A division by a power of two is exact as a product; any other keeps its own rounding.
      const T inverse = T(1) / y.number_;
      if (T(1) / inverse == y.number_ && real::fma(inverse, y.number_, T(-1)) == T(0)) return scaled(x, inverse);
    }
    const int a = x.place_in(recording), b = y.place_in(recording);
    return {recording, recording.add({.kind = Kind::quotient, .a = a, .b = b}, x.number_ / y.number_)};
  }
  friend bool operator<(const Recorded& x, const Recorded& y) {
    if (x.is_number() && y.is_number()) return x.number_ < y.number_;
    Recording& recording = x.is_number() ? *y.recording_ : *x.recording_;
    const int less = x.place_in(recording), more = y.place_in(recording);
    return recording.compare(less, more);
  }
  friend bool operator>(const Recorded& x, const Recorded& y) { return y < x; }
  /// Formulas ask whether two scalars are equal to leave out what is 0 for the whole scene; a result never is.
  friend bool operator==(const Recorded& x, const Recorded& y) {
    return x.is_number() && y.is_number() ? x.number_ == y.number_ : x.place_ == y.place_ && x.recording_ == y.recording_;
  }

  /// The result of an operation on this result alone, which is not a number.
  Recorded made(const taylor::Operation<T>& operation, T value) const {
    return {*recording_, recording_->add(operation, value)};
  }
  int place() const { return place_; }

 private:
  static Recorded scaled(const Recorded& x, T factor) {
    if (x.is_number()) return x.number_ * factor;
    if (factor == T(0)) return T(0);
    const auto [place, before] = x.recording_->unscaled(x.place_);
    const Recorded inner(*x.recording_, place);
    if (before * factor == T(1)) return inner;
    return x.made({.kind = Kind::linear, .a = place, .factor_a = before * factor}, before * factor * inner.number_);
  }
  /// f x + g y for factors of +1 and -1.
  static Recorded sum(const Recorded& x, T f, const Recorded& y, T g) {
    if (x.is_number() && y.is_number()) return f * x.number_ + g * y.number_;
    if (x.is_number() && x.number_ == T(0)) return scaled(y, g);
    if (y.is_number() && y.number_ == T(0)) return scaled(x, f);
    const T value = f * x.number_ + g * y.number_;
    if (x.is_number()) return y.made({.kind = Kind::linear, .a = y.place_, .number = f * x.number_, .factor_a = g}, value);
    if (y.is_number()) return x.made({.kind = Kind::linear, .a = x.place_, .number = g * y.number_, .factor_a = f}, value);
    return x.made({.kind = Kind::linear, .a = x.place_, .b = y.place_, .factor_a = f, .factor_b = g}, value);
  }

  Recording* recording_ = nullptr;
  int place_ = -1;
  T number_ = T(0);
};

/// See `held` in operations.hpp.
template <class T>
Recorded<T> conserved(const Recorded<T>& x) {
  if (x.is_number()) return x;
  return x.made({.kind = taylor::Kind::held, .a = x.place()}, x.value());
}
template <class T>
Recorded<T> sqrt(const Recorded<T>& x) {
  if (x.is_number()) return sqrt(x.value());
  return x.made({.kind = taylor::Kind::square_root, .a = x.place()}, sqrt(x.value()));
}
template <class T>
Recorded<T> pow(const Recorded<T>& x, const Recorded<T>& exponent) {
  if (!exponent.is_number()) throw std::logic_error("a recorded power has a number for its exponent");
  if (x.is_number()) return pow(x.value(), exponent.value());
  return x.made({.kind = taylor::Kind::power, .a = x.place(), .number = exponent.value()}, pow(x.value(), exponent.value()));
}
template <class T>
Recorded<T> sin(const Recorded<T>& x) {
  if (x.is_number()) return sin(x.value());
  return {*x.recording(), x.recording()->sine_and_cosine(x.place())};
}
template <class T>
Recorded<T> cos(const Recorded<T>& x) {
  if (x.is_number()) return cos(x.value());
  return {*x.recording(), x.recording()->sine_and_cosine(x.place()) + 1};
}
template <class T>
SinCos<Recorded<T>> sin_cos(const Recorded<T>& x) {
  return {sin(x), cos(x)};
}
/// sqrt(x^2 + y^2 + z^2) of components of ordinary size, such as those of unit vectors.
template <class T>
Recorded<T> hypot(const Recorded<T>& x, const Recorded<T>& y, const Recorded<T>& z = Recorded<T>()) {
  if (x.is_number() && y.is_number() && z.is_number()) return hypot(x.value(), y.value(), z.value());
  return sqrt(x * x + y * y + z * z);
}
/// x^(1/5) for x >= 0.
template <class T>
Recorded<T> fifth_root(const Recorded<T>& x) {
  if (x.is_number()) return x.value() > T(0) ? real::pow(x.value(), T(1) / T(5)) : T(0);
  return pow(x, Recorded<T>(T(1) / T(5)));
}

}  // namespace real
}  // namespace earthtop

namespace Eigen {
template <class T>
struct NumTraits<earthtop::real::Recorded<T>> : GenericNumTraits<double> {
  using Real = earthtop::real::Recorded<T>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 2, AddCost = 4, MulCost = 4 };
};
}  // namespace Eigen
