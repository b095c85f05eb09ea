// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of numbers in any of the three scalar types, evaluated for arrays that NumPy has broadcast.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

#include "default_arithmetic.hpp"
#include "earthtop/real.hpp"

namespace earthtop::python {

/// How a number of the scalar type T passes: a double as itself; a wider one as the 16 bytes of a float128, which holds it
/// exactly and which NumPy carries with the type "V16".
template <class T>
using Passed = std::conditional_t<std::is_same_v<T, double>, double, float128>;

template <class T>
pybind11::dtype passed_dtype() {
  return std::is_same_v<T, double> ? pybind11::dtype::of<double>() : pybind11::dtype("V16");
}

/// Calls `use(std::type_identity<T>())` with the scalar type that a scenario's `precision` names.
template <class Use>
auto in_precision(std::string_view precision, const Use& use) {
  if (precision == "double") return use(std::type_identity<double>());
  if (precision == "long_double") return use(std::type_identity<float80>());
  if (precision == "float128") return use(std::type_identity<float128>());
  throw std::invalid_argument("no such precision");
}

/// Calls one(i) for every i below n, without the interpreter's lock and with default arithmetic. Signals are checked every
/// 20 ms; if a handler raises, the rest is left undone.
template <class One>
void for_each_index(std::size_t n, const One& one) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kLook(20);
  constexpr std::size_t kBetweenClocks = 64;
  std::size_t i = 0;
  while (i < n) {
    {
      const pybind11::gil_scoped_release released;
      const DefaultArithmetic arithmetic;
      const auto end = Clock::now() + kLook;
      do {
        for (const std::size_t stop = std::min(n, i + kBetweenClocks); i < stop; ++i) one(i);
      } while (i < n && Clock::now() < end);
    }
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }
}

/// The numbers in an array of the passed type.
template <class T>
std::vector<T> numbers_of(const pybind11::array& array) {
  if (!array.dtype().equal(passed_dtype<T>()) || !(array.flags() & pybind11::array::c_style))
    throw std::invalid_argument("not an array of the passed type");
  std::vector<T> numbers(static_cast<std::size_t>(array.size()));
  const auto* bytes = static_cast<const char*>(array.data());
  for (T& number : numbers) {
    Passed<T> passed;
    std::memcpy(&passed, bytes, sizeof passed);
    bytes += sizeof passed;
    number = static_cast<T>(passed);
  }
  return numbers;
}

/// An array of the passed type, of shape (number of numbers).
template <class T>
pybind11::array array_of_numbers(const std::vector<T>& numbers) {
  pybind11::array array(passed_dtype<T>(), numbers.size());
  auto* bytes = static_cast<char*>(array.mutable_data());
  for (const T& number : numbers) {
    const auto passed = static_cast<Passed<T>>(number);
    std::memcpy(bytes, &passed, sizeof passed);
    bytes += sizeof passed;
  }
  return array;
}

/// How many numbers each argument, or each result, of a function has: 1 for a number, 3 for a vector, ...
using Widths = std::vector<std::size_t>;

/// A function of some numbers, which follow one another in `x`, that stores its results one after the other in `y`.
template <class T>
using Formula = std::function<void(const T* x, T* y)>;

/// Evaluates a function for every element of arrays.
/// @param arguments  C-contiguous arrays of the passed type; each has its numbers for every element, or once for all
/// @param shape  of the elements
/// @returns an array for each result, of the shape of the elements, with one more axis for a vector
template <class T>
pybind11::tuple evaluate(const Formula<T>& formula, const Widths& widths, const std::vector<pybind11::array>& arguments,
                         const Widths& result_widths, const std::vector<pybind11::ssize_t>& shape) {
  constexpr std::size_t kMost = 16, kSize = sizeof(Passed<T>);
  struct Place {
    char* first;
    std::size_t width, step;
  };
  std::size_t elements = 1;
  for (const pybind11::ssize_t length : shape) elements *= static_cast<std::size_t>(length);

  std::vector<Place> from, to;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const pybind11::array& array = arguments.at(k);
    const auto size = static_cast<std::size_t>(array.size());
    const bool once = size == widths[k];
    if (!array.dtype().equal(passed_dtype<T>()) || !(array.flags() & pybind11::array::c_style) ||
        !(once || size == widths[k] * elements))
      throw std::invalid_argument("an argument has not been broadcast");
    from.push_back({const_cast<char*>(static_cast<const char*>(array.data())), widths[k], once ? 0 : widths[k] * kSize});
  }
  pybind11::tuple results(result_widths.size());
  for (std::size_t k = 0; k < result_widths.size(); ++k) {
    std::vector<pybind11::ssize_t> whole = shape;
    if (result_widths[k] > 1) whole.push_back(static_cast<pybind11::ssize_t>(result_widths[k]));
    pybind11::array array(passed_dtype<T>(), whole);
    to.push_back({static_cast<char*>(array.mutable_data()), result_widths[k], result_widths[k] * kSize});
    results[k] = std::move(array);
  }

  for_each_index(elements, [&](std::size_t i) {
    std::array<T, kMost> x, y;
    std::size_t n = 0;
    for (const Place& place : from) {
      const char* at = place.first + i * place.step;
      for (std::size_t k = 0; k < place.width; ++k, at += kSize) {
        Passed<T> passed;
        std::memcpy(&passed, at, kSize);
        x[n++] = static_cast<T>(passed);
      }
    }
    formula(x.data(), y.data());
    n = 0;
    for (const Place& place : to) {
      char* at = place.first + i * place.step;
      for (std::size_t k = 0; k < place.width; ++k, at += kSize) {
        const auto passed = static_cast<Passed<T>>(y[n++]);
        std::memcpy(at, &passed, kSize);
      }
    }
  });
  return results;
}

}  // namespace earthtop::python
