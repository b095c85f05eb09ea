// SPDX-License-Identifier: GPL-3.0-or-later
/// Both motions of a plain symmetric top at any time, from the torus of each (plain_torus.hpp, rotating_torus.hpp). The cost of a
/// time does not depend on how late it is.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "earthtop/model/model.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "integrate/fourier/rotating_torus.hpp"
#include "integrate/spinless_pair.hpp"

namespace earthtop {

/// The axes in which the torus of the rotating motion is sought. In those of the effective vertical, along which gravity and the gyroscopic
/// torque of the Earth's rotation add up, it is least deformed; in those of the laboratory the same motion comes from other numbers.
enum class TorusAxes { effective_vertical, laboratory };

template <class T>
class FourierTop {
 public:
  /// @param model  plain, symmetric about body axis 3
  /// @param fineness  the grid begins so many times as fine as is usual, a power of two
  FourierTop(const Model<T>& model, const NaturalRelease<T>& release, TorusAxes axes = TorusAxes::effective_vertical,
             std::size_t fineness = 1);

  FourierTop(const FourierTop&) = delete;
  FourierTop& operator=(const FourierTop&) = delete;

  /// Why there is no such sum; empty if there is one.
  std::string_view refusal() const { return refusal_; }
  /// Both motions at a time from the release on; their quaternions are continuous in time.
  SpinlessPair<T> at(T t) const;
  /// Bounds on the errors: of the reference's attitude, and of the deviation at a time besides what that one causes (rad).
  T attitude_error() const { return T(2) * plain_.error(); }
  T deviation_error(T t) const;
  /// A time within which no angle of the drift goes round.
  T longest_step() const;
  /// Roughly the rates of the fast motion, and of the precession with the Earth's rotation.
  T fast_rate() const { return real::abs(plain_.nutation()) + real::abs(plain_.top().b()) + slow_rate(); }
  T slow_rate() const { return real::abs(plain_.precession()) + norm(W_L_); }
  /// The mean rate at which the rotating axis turns about Up, less that of the reference, over epsilon; and a bound on its error. None
  /// where the axis goes so near Up that its azimuth has no mean rate.
  std::optional<T> turning_change() const;
  T turning_error() const;
  const std::optional<RotatingTorus<T>>& torus() const { return torus_; }
  const PlainTorus<T>& plain() const { return plain_; }

 private:
  /// A rotation by a small angle: its quaternion is (w, epsilon v).
  struct SmallTurn {
    T w = T(1);
    Vec3<T> v = Vec3<T>::Zero();
  };
  SmallTurn product(const SmallTurn& a, const SmallTurn& b) const {
    return {a.w * b.w - epsilon_ * epsilon_ * a.v.dot(b.v), Vec3<T>(a.w * b.v + b.w * a.v + epsilon_ * a.v.cross(b.v))};
  }
  /// sin(epsilon a) / epsilon
  T scaled_sine(T a) const {
    const T x = epsilon_ * a;
    return real::abs(x) < real::epsilon<T>() ? a : a * (real::sin(x) / x);
  }
  /// The two halves of q at theta1 of the plain motion, their changes up to that of the rotating one over epsilon, and the rate across the
  /// axis at either.
  struct Nutated {
    Complex<T> A, B, A_change, B_change, ref_across, across;
  };
  Nutated nutated(const Complex<T>& turn, const Complex<T>& shift, const Complex<T>& shift_scaled) const;
  static SpinlessTop<T> spinless(const Model<T>& model, const NaturalRelease<T>& release);
  TorusChange<T> change(const Model<T>& model, const NaturalRelease<T>& release, TorusAxes axes);

  T epsilon_;
  Vec3<T> W_L_;
  T spin_change_ = T(0);  ///< inertial rate along the axis less that of the reference, over epsilon
  SmallTurn vertical_;    ///< takes Up to the effective vertical
  PlainTorus<T> plain_;
  std::optional<RotatingTorus<T>> torus_;
  int highest_ = 0;  ///< the harmonics of the plain motion that are not negligible
  std::string_view refusal_;
};

extern template class FourierTop<double>;
extern template class FourierTop<float80>;
extern template class FourierTop<float128>;

}  // namespace earthtop
