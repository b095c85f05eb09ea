// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion of a symmetric top on the rotating Earth as a finite Fourier sum of two phases.
///
/// The plain motion fills a torus (plain_torus.hpp). The Earth's rotation deforms it and changes its rates nu, p and c; a motion
/// on it stays as regular. In axes G, whose third one is the effective vertical, the rotating motion is sought as
///
///   q_GF = turn(third axis, theta2) q(theta1) e(theta1, theta2) turn(axis, theta3) ,  e = (e_w, epsilon y) ,
///
/// with the rate across the axis u + epsilon Y in F', u being that of the plain motion. Inserting this into the equations of a
/// reduced top (reduced_top.hpp) gives, with D = (nu + epsilon dnu) d/dtheta1 + (p + epsilon dp) d/dtheta2 and y, Y, dnu, dp, dc
/// divided by epsilon as they stand,
///
///   D y = (e_w (a - s) + y x (2 w + epsilon (a + s))) / 2 ,   a = (Y, -dc) - R^T W ,   s = dnu t1 + dp Up ,
///   D Y = i (b + c) Y + i (db + dc) (u + epsilon Y) - i (R^T g_rot - R0^T g_ref) / epsilon - dnu du/dtheta1 .
///
/// Here w = (u, -c) is the rate of F' in the plain motion, t1 = (w - p Up) / nu, R = R0 R(e) its attitude in axes G but for the turn
/// theta2, g the gravity and b = I3 w3 / I1. y and Y are functions on the torus; with the three changes of rates they are found
/// by Newton's method (tangent_frame.hpp), each pass of which makes the error smaller by about the Earth's rate over that of the
/// precession. No term is a difference of nearly equal numbers, and none grows with the time.
///
/// That a perturbation in two phases has such a solution, but for resonances, is A. N. Kolmogorov's theorem; the solution by
/// Newton's method in the frame of the motion's own tangents follows R. de la Llave, A. Gonzalez, A. Jorba and J. Villanueva,
/// Nonlinearity 18 (2005) 855.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <vector>

#include "integrate/fourier/tangent_frame.hpp"

namespace earthtop {

/// How the rotating motion differs from the plain one; all but the first divided by epsilon, and in units of I1 = 1.
template <class T>
struct TorusChange {
  T epsilon = T(0);
  Vec3<T> W_G = Vec3<T>::Zero();        ///< the Earth's rate
  Vec3<T> gravity_G = Vec3<T>::Zero();  ///< gravity upward, less what it is if Up is the third axis
  T b = T(0);
  Vec3<T> y = Vec3<T>::Zero();  ///< of the attitude at the release
  Complex<T> across;            ///< of the rate across the axis at the release
};

/// How the search for a torus ended.
enum class TorusStatus { found, no_convergence, too_many_harmonics };

template <class T>
class RotatingTorus {
 public:
  /// @param plain  is sampled here   @param nutation_points, precession_points  the grid to begin with, powers of two
  RotatingTorus(PlainTorus<T>& plain, const TorusChange<T>& change, std::size_t nutation_points, std::size_t precession_points);

  TorusStatus status() const { return status_; }
  /// The changes of the three rates over epsilon.
  struct Rates {
    T nutation = T(0), precession = T(0), axis_turn = T(0);
  };
  const Rates& rates() const { return rates_; }
  /// How fast these changes move the motion away from the plain one, over epsilon.
  T speed() const {
    return real::abs(rates_.nutation) * reach_[0] + real::abs(rates_.precession) * reach_[1] +
           real::abs(rates_.axis_turn) * reach_[2];
  }
  /// (y, Y / nu) at two phases, given by exp(i theta1) and exp(i theta2).
  TorusVector<T> at(const Complex<T>& nutation, const Complex<T>& precession) const;

  /// The sum of the sizes of all coefficients.
  T size() const;
  /// What the last pass has changed and the grid leaves out: estimates of the errors of `at` and of `speed`.
  T error() const { return error_; }
  T rate_error() const { return rate_error_; }
  std::size_t nutation_points() const { return grid_.nutation_points(); }
  std::size_t precession_points() const { return grid_.precession_points(); }
  /// How much each pass has changed, over the largest coefficient.
  const std::vector<T>& changes() const { return changes_; }

 private:
  using Vector = TorusVector<T>;
  using Coefficients = typename TorusGrid<T>::Coefficients;
  using Values = typename TorusGrid<T>::Values;
  /// The plain motion at one point of the nutation, in F'.
  struct Plain {
    Vec3<T> w, up, slope, gravity;  ///< rate of F', Up, rate that belongs to the change of q with theta1, and gravity
    Complex<T> across, across_slope;
    Mat3<T> R;
  };

  void prepare();
  bool converge();
  void make_residual();
  T correct();
  T largest() const;
  T size_along(int harmonic) const;
  T size_across(std::size_t j) const;
  bool is_resolved(bool along);
  void find_highest();

  PlainTorus<T>& plain_torus_;
  TorusChange<T> change_;
  TorusGrid<T> grid_;
  std::optional<TangentFrame<T>> frame_;
  std::vector<Plain> plain_;
  std::vector<Vec3<T>> W_, gravity_;  ///< at the points of the grid, in F' of the plain motion
  Coefficients x_, residual_, step_;
  Values values_, along_, across_, work_;
  std::array<Vector, 3> tangents_;  ///< means over the torus of what each rate changes in the residual, times Q^-1
  std::array<T, 3> reach_{};        ///< their sizes: how far a unit of each phase moves the motion
  Rates rates_;
  std::vector<T> changes_;
  T error_ = T(0), rate_error_ = T(0);
  TorusStatus status_ = TorusStatus::no_convergence;
  std::vector<int> highest_;  ///< the harmonics of the nutation that are not negligible, for each of the precession
};

/// The factors of three columns that come nearest to a target, by Gram and Schmidt's method. A column that lies in the span of those
/// before it gets the factor 0.
template <class T>
std::array<T, 3> nearest_factors(const std::array<TorusVector<T>, 3>& columns, TorusVector<T> target) {
  constexpr double kIndependent = 1e-10;
  std::array<TorusVector<T>, 3> across;
  Mat3<T> upper = Mat3<T>::Zero();
  std::array<T, 3> along{T(0), T(0), T(0)}, factors = along;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    across[i] = columns[i];
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t j = 0; j < i; ++j) {
        const T part = across[j].dot(across[i]);
        upper(static_cast<Eigen::Index>(j), column) += part;
        across[i] -= part * across[j];
      }
    const T size = real::sqrt(T(columns[i].squaredNorm())), rest = real::sqrt(T(across[i].squaredNorm()));
    if (!(rest > T(kIndependent) * size)) {
      across[i].setZero();
      continue;
    }
    upper(column, column) = rest;
    across[i] /= rest;
    along[i] = across[i].dot(target);
    target -= along[i] * across[i];
  }
  for (Eigen::Index i = 2; i >= 0; --i) {
    if (!(upper(i, i) > T(0))) continue;
    T sum = along[static_cast<std::size_t>(i)];
    for (Eigen::Index j = i + 1; j < 3; ++j) sum -= upper(i, j) * factors[static_cast<std::size_t>(j)];
    factors[static_cast<std::size_t>(i)] = sum / upper(i, i);
  }
  return factors;
}

template <class T>
RotatingTorus<T>::RotatingTorus(PlainTorus<T>& plain, const TorusChange<T>& change, std::size_t nutation_points,
                                std::size_t precession_points)
    : plain_torus_(plain), change_(change), grid_(nutation_points, precession_points) {
  constexpr std::size_t kMostAlong = 512, kMostAcross = 32;
  for (;;) {
    plain_torus_.sample(grid_.nutation_points());
    bool is_fine_along = plain_torus_.harmonics_beyond(grid_.highest()) <= T(4) * real::epsilon<T>(), is_fine_across = true;
    if (is_fine_along) {
      prepare();
      const bool has_converged = converge();
      is_fine_along = is_resolved(true), is_fine_across = is_resolved(false);
      if (has_converged && is_fine_along && is_fine_across) break;
      if (!has_converged && is_fine_along) return;
    }
    const std::size_t along = grid_.nutation_points() * (is_fine_along ? 1 : 2),
                      across = grid_.precession_points() * (is_fine_across ? 1 : 2);
    if (along > kMostAlong) status_ = TorusStatus::too_many_harmonics;
    if (along > kMostAlong || across > kMostAcross) return;
    grid_ = TorusGrid<T>(along, across);
  }
  status_ = TorusStatus::found;
  find_highest();
}

template <class T>
void RotatingTorus<T>::prepare() {
  frame_.emplace(plain_torus_);
  const T nu = plain_torus_.nutation(), p = plain_torus_.precession(), c = plain_torus_.turn_about_axis();
  const SpinlessTop<T>& top = plain_torus_.top();
  plain_.resize(grid_.nutation_points());
  for (std::size_t i = 0; i < plain_.size(); ++i) {
    const typename PlainTorus<T>::Point& point = plain_torus_.points()[i];
    Plain& x = plain_[i];
    x.R = rotation_matrix(point.q);
    x.up = x.R.row(2).transpose();
    x.across = point.across;
    x.w = Vec3<T>(x.across.re, x.across.im, -c);
    x.slope = (x.w - p * x.up) / nu;
    x.gravity = top.gravity() * x.up;
    x.across_slope =
        T(T(1) / nu) * (T(top.b() + c) * times_i(x.across) + T(-1) * times_i(Complex<T>{x.gravity[0], x.gravity[1]}));
  }
  W_.resize(grid_.points()), gravity_.resize(grid_.points());
  for (std::size_t l = 0; l < grid_.precession_points(); ++l)
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      const auto seen = [&](const Vec3<T>& u_G) -> Vec3<T> {
        const Complex<T> level = conj(grid_.turn(l)) * Complex<T>{u_G[0], u_G[1]};
        return transposed_times(plain_[i].R, Vec3<T>(level.re, level.im, u_G[2]));
      };
      W_[grid_.point(i, l)] = seen(change_.W_G);
      gravity_[grid_.point(i, l)] = seen(change_.gravity_G);
    }
}

/// Makes passes until the corrections are rounding.
template <class T>
bool RotatingTorus<T>::converge() {
  constexpr int kMostPasses = 60;
  constexpr double kDivided = 0.7, kEnough = 1e-9;  // what is left at rest counts as error
  x_.assign(grid_.coefficients(), {});
  rates_ = {};
  changes_.clear();
  for (int pass = 0; pass < kMostPasses; ++pass) {
    make_residual();
    const T change = correct();
    if (!real::isfinite(change)) return false;
    changes_.push_back(change);
    if (change <= T(2) * real::epsilon<T>()) return true;
    // Rounding is reached where a correction is no smaller than the last, or the search goes astray.
    if (pass > 1 && change > T(kDivided) * changes_[changes_.size() - 2]) return change < T(kEnough);
  }
  return false;
}

/// Makes the coefficients of Q^-1 (left sides minus right sides of the equations), and the means of the tangents.
template <class T>
void RotatingTorus<T>::make_residual() {
  const T epsilon = change_.epsilon, nu = plain_torus_.nutation();
  const T nu_now = nu + epsilon * rates_.nutation, p_now = plain_torus_.precession() + epsilon * rates_.precession;
  const T b_less = plain_torus_.top().b() + plain_torus_.turn_about_axis();
  grid_.to_values(x_, values_);
  grid_.nutation_slope(x_, along_);
  grid_.precession_slope(x_, across_);
  for (Vector& tangent : tangents_) tangent.setZero();
  const Vec3<T> axis = Vec3<T>::UnitZ();
  work_.resize(grid_.points());
  for (std::size_t l = 0; l < grid_.precession_points(); ++l)
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      const std::size_t here = grid_.point(i, l);
      const Plain& plain = plain_[i];
      const Vec3<T> y = values_[here].template head<3>();
      const Complex<T> Y{nu * values_[here][3], nu * values_[here][4]}, u = plain.across + epsilon * Y;
      const T w = real::sqrt(T(T(1) - epsilon * epsilon * y.dot(y)));
      const auto turned_back = [&](const Vec3<T>& v) -> Vec3<T> {
        return v + epsilon * turn_back_minus_one_scaled<T>(w, y, epsilon, v);
      };
      const Vec3<T> a = Vec3<T>(Y.re, Y.im, -rates_.axis_turn) - turned_back(W_[here]);
      const Vec3<T> s = rates_.nutation * plain.slope + rates_.precession * plain.up;
      const Vec3<T> y_rate = (w * (a - s) + y.cross(T(2) * plain.w + epsilon * (a + s))) / T(2);
      const Vec3<T> pull = turn_back_minus_one_scaled<T>(w, y, epsilon, plain.gravity) + turned_back(gravity_[here]);
      const Complex<T> Y_rate =
          times_i(b_less * Y + T(change_.b + rates_.axis_turn) * u + T(-1) * Complex<T>{pull[0], pull[1]}) +
          T(-rates_.nutation) * plain.across_slope;
      Vector right;
      right << y_rate, Y_rate.re / nu, Y_rate.im / nu;
      work_[here] = frame_->Q_inverse[i] * (nu_now * along_[here] + p_now * across_[here] - right);

      // What a unit of each change of a rate adds to the residual.
      const auto shifted = [&](const Vec3<T>& v) -> Vec3<T> { return (w * v - epsilon * y.cross(v)) / T(2); };
      Vector tangent;
      tangent << shifted(plain.slope), plain.across_slope.re / nu, plain.across_slope.im / nu;
      tangents_[0] += frame_->Q_inverse[i] * (tangent + epsilon * along_[here]);
      tangent << shifted(plain.up), T(0), T(0);
      tangents_[1] += frame_->Q_inverse[i] * (tangent + epsilon * across_[here]);
      const Complex<T> iu = times_i(u);
      tangent << (w * axis + epsilon * y.cross(axis)) / T(2), -iu.re / nu, -iu.im / nu;
      tangents_[2] += frame_->Q_inverse[i] * tangent;
    }
  for (Vector& tangent : tangents_) tangent /= T(grid_.points());
  grid_.to_coefficients(work_, residual_);
}

/// Makes one pass of Newton's method. @returns the largest change of a coefficient over the largest coefficient
template <class T>
T RotatingTorus<T>::correct() {
  const T epsilon = change_.epsilon, nu = plain_torus_.nutation();
  const T nu_now = nu + epsilon * rates_.nutation, p_now = plain_torus_.precession() + epsilon * rates_.precession;
  const typename TangentFrame<T>::Matrix& N = frame_->N;
  step_.assign(grid_.coefficients(), {});
  Vector start;
  start << change_.y, change_.across.re / nu, change_.across.im / nu;
  for (std::size_t j = 0; j < grid_.classes(); ++j)
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      for (std::size_t m = 0; m < kTorusSize; ++m)
        start[static_cast<Eigen::Index>(m)] -= grid_.weight(j) * x_[grid_.place(j, m) + i].re;
      if (2 * i == plain_.size() || (j == 0 && i == 0)) continue;
      // (i s - N) c = -residual, where N N = 0
      const T inverse = T(1) / (T(grid_.along().harmonic(i)) * nu_now + T(j) * p_now);
      Vector re, im;
      for (std::size_t m = 0; m < kTorusSize; ++m) {
        const Complex<T>& r = residual_[grid_.place(j, m) + i];
        re[static_cast<Eigen::Index>(m)] = -inverse * r.im, im[static_cast<Eigen::Index>(m)] = inverse * r.re;
      }
      const Vector shear_re = inverse * (N * im), shear_im = -inverse * (N * re);
      re += shear_re, im += shear_im;
      for (std::size_t m = 0; m < kTorusSize; ++m) {
        const auto k = static_cast<Eigen::Index>(m);
        step_[grid_.place(j, m) + i] = {re[k], im[k]};
        start[k] -= grid_.weight(j) * re[k];
      }
    }
  // What is missing at the release is the constant; what it then lacks of a motion that stays is a change of the rates.
  Vector target = N * start;
  for (std::size_t m = 0; m < kTorusSize; ++m) {
    const auto k = static_cast<Eigen::Index>(m);
    step_[grid_.place(0, m)] = {start[k], T(0)};
    target[k] -= residual_[grid_.place(0, m)].re;
  }
  const std::array<T, 3> change = nearest_factors<T>(tangents_, target);
  rates_.nutation += change[0], rates_.precession += change[1], rates_.axis_turn += change[2];

  grid_.to_values(step_, work_);
  for (std::size_t l = 0; l < grid_.precession_points(); ++l)
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      Vector& x = work_[grid_.point(i, l)];
      x = Vector(frame_->Q[i] * x);
    }
  grid_.to_coefficients(work_, step_);
  grid_.keep(step_);
  T largest_step = T(0), largest = T(0), steps = T(0);
  for (std::size_t k = 0; k < x_.size(); ++k) {
    x_[k] = x_[k] + step_[k];
    const T size = real::sqrt(norm2(step_[k]));
    largest_step = std::max(largest_step, size), steps += size;
    largest = std::max(largest, norm2(x_[k]));
    if (!real::isfinite(size)) return size;
  }
  error_ = steps;
  for (std::size_t i = 0; i < 3; ++i) reach_[i] = real::sqrt(T(tangents_[i].squaredNorm()));
  rate_error_ = real::abs(change[0]) * reach_[0] + real::abs(change[1]) * reach_[1] + real::abs(change[2]) * reach_[2];
  return largest > T(0) ? T(largest_step / real::sqrt(largest)) : T(0);
}

/// The size of the largest coefficient.
template <class T>
T RotatingTorus<T>::largest() const {
  T square = T(0);
  for (const Complex<T>& c : x_) square = std::max(square, norm2(c));
  return real::sqrt(square);
}
/// The size of the coefficients of one harmonic of the nutation, or of the precession.
template <class T>
T RotatingTorus<T>::size_along(int harmonic) const {
  T largest = T(0);
  for (std::size_t j = 0; j < grid_.classes(); ++j)
    for (std::size_t m = 0; m < kTorusSize; ++m)
      for (const int k : {harmonic, -harmonic})
        largest = std::max(largest, norm2(x_[grid_.place(j, m) + grid_.along().place(k)]));
  return real::sqrt(largest);
}
template <class T>
T RotatingTorus<T>::size() const {
  T sum = T(0);
  for (const Complex<T>& c : x_) sum += T(2) * real::sqrt(norm2(c));
  return sum;
}
template <class T>
T RotatingTorus<T>::size_across(std::size_t j) const {
  T largest = T(0);
  for (std::size_t i = grid_.place(j, 0); i < grid_.place(j + 1, 0); ++i) largest = std::max(largest, norm2(x_[i]));
  return real::sqrt(largest);
}

/// Whether the harmonics that the grid leaves out are rounding, and adds them to the error.
template <class T>
bool RotatingTorus<T>::is_resolved(bool along) {
  T left_out;
  if (along) {
    left_out = size_along(grid_.highest()) + size_along(grid_.highest() - 1);
  } else {  // those of the precession fall off evenly
    const T before = size_across(grid_.classes() - 2), last = size_across(grid_.classes() - 1);
    left_out = before > T(0) ? T(last * std::min(T(1), T(last / before))) : last;
  }
  constexpr double kTail = 8, kRounding = 4;
  error_ += T(kTail) * left_out;
  return left_out <= T(kRounding) * real::epsilon<T>() * largest();
}

/// Finds how far the harmonics of the nutation are above what no digit of a sum shows.
template <class T>
void RotatingTorus<T>::find_highest() {
  constexpr double kUnseen = 1.0 / 64;
  const T least = T(kUnseen) * real::epsilon<T>() * largest();
  highest_.assign(grid_.classes(), -1);
  for (std::size_t j = 0; j < grid_.classes(); ++j)
    for (std::size_t m = 0; m < kTorusSize; ++m)
      for (std::size_t i = 0; i < grid_.nutation_points(); ++i)
        if (norm2(x_[grid_.place(j, m) + i]) > least * least)
          highest_[j] = std::max(highest_[j], std::abs(grid_.along().harmonic(i)));
}

template <class T>
TorusVector<T> RotatingTorus<T>::at(const Complex<T>& nutation, const Complex<T>& precession) const {
  Vector sum = Vector::Zero();
  Complex<T> turn{T(1), T(0)};  // exp(i j theta2)
  for (std::size_t j = 0; j < grid_.classes(); ++j, turn = turn * precession) {
    if (highest_[j] < 0) continue;
    for (std::size_t m = 0; m < kTorusSize; ++m) {
      const Complex<T>* c = &x_[grid_.place(j, m)];
      // Horner's scheme in exp(i theta1), for the harmonics above and below 0.
      Complex<T> above = c[grid_.along().place(highest_[j])], below = c[grid_.along().place(-highest_[j])];
      for (int k = highest_[j] - 1; k > 0; --k) {
        above = above * nutation + c[grid_.along().place(k)];
        below = below * conj(nutation) + c[grid_.along().place(-k)];
      }
      Complex<T> whole = c[0];
      if (highest_[j] > 0) whole = whole + above * nutation + below * conj(nutation);
      sum[static_cast<Eigen::Index>(m)] += grid_.weight(j) * (turn.re * whole.re - turn.im * whole.im);
    }
  }
  return sum;
}

}  // namespace earthtop
