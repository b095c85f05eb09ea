// SPDX-License-Identifier: GPL-3.0-or-later
/// The path of a mass that a motor moves, as a function of time: a turn or a swing at a frequency, or polynomials one after another.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "earthtop/members.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// Where a mass is, and how it moves; seen from its carrier, in the carrier's axes.
template <class T>
struct PointOnPath {
  Vec3<T> place = Vec3<T>::Zero(), velocity = Vec3<T>::Zero(), acceleration = Vec3<T>::Zero();
};

/// A path of polynomials one after another, or any vector that is a function of time. Place, velocity and acceleration are
/// continuous; steps of an integration end where pieces do.
template <class T>
class PiecewisePath {
 public:
  static constexpr std::size_t kPowers = 6;
  /// A polynomial of the time since `start`, until the next piece starts. The first one holds before its start, too.
  struct Piece {
    T start = T(0);
    std::array<Vec3<T>, kPowers> coefficients;
  };

  /// @param pieces  at least one, ascending
  explicit PiecewisePath(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  PointOnPath<T> at(const T& t) const {
    const Piece& p = piece(t);
    return {derivative(p, t - p.start, 0), derivative(p, t - p.start, 1), derivative(p, t - p.start, 2)};
  }
  Vec3<T> place(const T& t) const {
    const Piece& p = piece(t);
    return derivative(p, t - p.start, 0);
  }
  /// Puts the coefficients of the powers of (t' - t) of a derivative of the place into a row for each power, just after t. A t that is
  /// earlier than a joint only by rounding counts as the joint.
  template <class Rows>
  void expand(const T& t, int order, Rows& rows) const {
    const Piece& p = piece(t + T(64) * real::epsilon<T>() * (real::abs(t) + T(1)));
    T factorial = T(1);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k > 0) factorial *= T(static_cast<int>(k));
      const int total = order + static_cast<int>(k);
      const Vec3<T> row =
          total < static_cast<int>(kPowers) ? Vec3<T>(derivative(p, t - p.start, total) / factorial) : Vec3<T>(Vec3<T>::Zero());
      for (std::size_t i = 0; i < 3; ++i) rows[k][i] = row[static_cast<int>(i)];
    }
  }
  /// The times at which a higher derivative jumps.
  std::vector<T> joints() const {
    std::vector<T> times;
    for (std::size_t i = 1; i < pieces_.size(); ++i) times.push_back(pieces_[i].start);
    return times;
  }
  /// The same path with its places in another unit of 2^-exponent: exact, no digit changes.
  PiecewisePath scaled(int exponent) const {
    PiecewisePath made = *this;
    for (Piece& p : made.pieces_)
      for (Vec3<T>& coefficient : p.coefficients)
        for (int i = 0; i < 3; ++i) coefficient[i] = real::scale(coefficient[i], exponent);
    return made;
  }
  /// The same path with times in units of 2^time_exponent s: exact, no digit changes.
  PiecewisePath in_time_units(int time_exponent) const {
    PiecewisePath scaled = *this;
    for (Piece& p : scaled.pieces_) {
      p.start = real::scale(p.start, -time_exponent);
      for (std::size_t k = 0; k < kPowers; ++k)
        for (int i = 0; i < 3; ++i)
          p.coefficients[k][i] = real::scale(p.coefficients[k][i], static_cast<int>(k) * time_exponent);
    }
    return scaled;
  }

 private:
  const Piece& piece(const T& t) const {
    const auto later = [](const T& at, const Piece& p) { return at < p.start; };
    return *(std::upper_bound(pieces_.begin() + 1, pieces_.end(), t, later) - 1);
  }
  static Vec3<T> derivative(const Piece& p, const T& u, int order) {
    Vec3<T> sum = Vec3<T>::Zero();
    for (int k = static_cast<int>(kPowers) - 1; k >= order; --k) {
      T factor = T(1);
      for (int j = 0; j < order; ++j) factor *= T(k - j);
      sum = u * sum + factor * p.coefficients[static_cast<std::size_t>(k)];
    }
    return sum;
  }

  std::vector<Piece> pieces_;
};

/// A mass and its path: center + cos(2 pi f t + phase) cosine + sin(2 pi f t + phase) sine, or the pieces where there are any.
template <class T>
struct MassOnPath {
  T mass = T(0);
  Vec3<T> center = Vec3<T>::Zero(), cosine = Vec3<T>::Zero(), sine = Vec3<T>::Zero();
  T frequency = T(0), phase = T(0);
  std::shared_ptr<const PiecewisePath<T>> pieces = nullptr;
  EARTHTOP_MEMBERS(mass, center, cosine, sine, frequency, phase, pieces)

  PointOnPath<T> at(const T& t) const {
    if (pieces) return pieces->at(t);
    const T pulsation = T(2) * real::pi<T>() * frequency;
    const auto turn = real::sin_cos(T(pulsation * t + phase));
    const Vec3<T> arm = turn.cos * cosine + turn.sin * sine;
    return {center + arm, pulsation * Vec3<T>(turn.cos * sine - turn.sin * cosine), -(pulsation * pulsation) * arm};
  }
};

}  // namespace earthtop
