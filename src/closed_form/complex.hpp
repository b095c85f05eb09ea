// SPDX-License-Identifier: GPL-3.0-or-later
/// The few operations on complex numbers that the closed forms need, for every scalar type and without the special cases of
/// std::complex.
#pragma once

#include "earthtop/real.hpp"

namespace earthtop {

template <class T>
struct Complex {
  T re = T(0), im = T(0);

  friend Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
  friend Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator*(T s, const Complex& a) { return {s * a.re, s * a.im}; }
};
template <class T>
Complex<T> conj(const Complex<T>& a) {
  return {a.re, -a.im};
}
template <class T>
Complex<T> times_i(const Complex<T>& a) {
  return {-a.im, a.re};
}
template <class T>
T norm2(const Complex<T>& a) {
  return a.re * a.re + a.im * a.im;
}
/// a / |a|; 1 for 0.
template <class T>
Complex<T> direction(const Complex<T>& a) {
  const T size = real::hypot(a.re, a.im);
  if (!(size > T(0))) return {T(1), T(0)};
  return {a.re / size, a.im / size};
}
/// exp(i angle).
template <class T>
Complex<T> turned(T angle) {
  const SinCos<T> both = real::sin_cos(angle);
  return {both.cos, both.sin};
}

}  // namespace earthtop
