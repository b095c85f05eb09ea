// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of two phases, theta1 of the nutation and theta2 of the precession: their values on a grid, and the coefficients
/// c_kj of their finite Fourier sums.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "integrate/fourier/fourier_transform.hpp"

namespace earthtop {

/// The deviation at one point: vector part of the attitude's, and rate across the axis over the nutation's rate.
template <class T>
using TorusVector = Eigen::Matrix<T, 5, 1>;
inline constexpr std::size_t kTorusSize = 5;

template <class T>
class TorusGrid {
 public:
  using Values = std::vector<TorusVector<T>>;    ///< at the place of `point`
  using Coefficients = std::vector<Complex<T>>;  ///< for j >= 0, at the place of `place`; the others are their conjugates

  /// @param nutation, precession  numbers of points, powers of two
  TorusGrid(std::size_t nutation, std::size_t precession) : along_(nutation), turns_(precession) {
    for (std::size_t l = 0; l < precession; ++l) turns_[l] = turned(T(T(2) * real::pi<T>() * T(l) / T(precession)));
  }
  std::size_t nutation_points() const { return along_.size(); }
  std::size_t precession_points() const { return turns_.size(); }
  std::size_t points() const { return nutation_points() * precession_points(); }
  /// How many harmonics j of the precession there are, from 0 on. The highest that the grid could tell is left out.
  std::size_t classes() const { return precession_points() / 2; }
  std::size_t coefficients() const { return classes() * kTorusSize * nutation_points(); }
  std::size_t point(std::size_t i, std::size_t l) const { return l * nutation_points() + i; }
  std::size_t place(std::size_t j, std::size_t component) const { return (j * kTorusSize + component) * nutation_points(); }
  /// exp(i theta2) at the points l of the precession.
  const Complex<T>& turn(std::size_t l) const { return turns_[l]; }
  const FourierTransform<T>& along() const { return along_; }
  /// The highest harmonic k that is kept: products of two sums then leave no trace of their higher harmonics among the kept ones (the
  /// rule of two thirds; S. A. Orszag, J. Atmos. Sci. 28 (1971) 1074).
  int highest() const { return static_cast<int>(nutation_points()) / 3; }
  void keep(Coefficients& c) const {
    for (std::size_t place = 0; place < c.size(); ++place)
      if (std::abs(along_.harmonic(place % nutation_points())) > highest()) c[place] = {};
  }
  static T weight(std::size_t j) { return j == 0 ? T(1) : T(2); }

  /// The values of a sum, or of its derivative: each coefficient is multiplied by `factor(k, j)`.
  template <class Factor>
  void to_values(const Coefficients& c, Factor&& factor, Values& values) {
    values.assign(points(), TorusVector<T>::Zero());
    work_.resize(nutation_points());
    for (std::size_t j = 0; j < classes(); ++j)
      for (std::size_t m = 0; m < kTorusSize; ++m) {
        for (std::size_t i = 0; i < nutation_points(); ++i)
          work_[i] = weight(j) * (factor(T(along_.harmonic(i)), T(j)) * c[place(j, m) + i]);
        along_.to_values(work_.data());
        for (std::size_t l = 0; l < precession_points(); ++l) {
          const Complex<T>& turn = turns_[j * l % precession_points()];
          for (std::size_t i = 0; i < nutation_points(); ++i)
            values[point(i, l)][static_cast<Eigen::Index>(m)] += turn.re * work_[i].re - turn.im * work_[i].im;
        }
      }
  }
  void to_values(const Coefficients& c, Values& values) {
    to_values(
        c,
        [](T, T) {
          return Complex<T>{T(1), T(0)};
        },
        values);
  }
  /// The derivative with theta1.
  void nutation_slope(const Coefficients& c, Values& values) {
    to_values(
        c,
        [](T k, T) {
          return Complex<T>{T(0), k};
        },
        values);
  }
  /// The derivative with theta2.
  void precession_slope(const Coefficients& c, Values& values) {
    to_values(
        c,
        [](T, T j) {
          return Complex<T>{T(0), j};
        },
        values);
  }
  void to_coefficients(const Values& values, Coefficients& c) const {
    c.assign(coefficients(), {});
    for (std::size_t j = 0; j < classes(); ++j)
      for (std::size_t m = 0; m < kTorusSize; ++m) {
        Complex<T>* out = &c[place(j, m)];
        for (std::size_t l = 0; l < precession_points(); ++l) {
          const Complex<T> turn = T(T(1) / T(precession_points())) * conj(turns_[j * l % precession_points()]);
          for (std::size_t i = 0; i < nutation_points(); ++i)
            out[i] = out[i] + values[point(i, l)][static_cast<Eigen::Index>(m)] * turn;
        }
        along_.to_coefficients(out);
        out[nutation_points() / 2] = {};  // its sign is unknown
      }
  }

 private:
  FourierTransform<T> along_;
  std::vector<Complex<T>> turns_, work_;
};

}  // namespace earthtop
