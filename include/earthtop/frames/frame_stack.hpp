// SPDX-License-Identifier: GPL-3.0-or-later
/// A stack of frames: an ordered list of frames, each moving relative to its parent. It yields attitude, angular velocity and
/// angular acceleration between any two of them, in the axes of any third.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/frames/earth.hpp"
#include "earthtop/frames/prescribed_motion.hpp"

namespace earthtop {

/// How frame B moves as seen from frame A, at one instant.
template <class T>
struct FrameKinematics {
  Rotation<T> R_AB;
  Vec3<T> w_AB_A = Vec3<T>::Zero();      ///< angular velocity of B relative to A, in A axes (rad/s)
  Vec3<T> alpha_AB_A = Vec3<T>::Zero();  ///< time derivative of w_AB taken in A, in A axes (rad/s^2)
};

/// Composes A -> B with B -> C:  w_AC = w_AB + w_BC,  alpha_AC = alpha_AB + alpha_BC + w_AB x w_BC.
/// The cross term is the change of w_BC because B carries it round [Poisson's formula].
template <class T>
FrameKinematics<T> compose(const FrameKinematics<T>& AB, const FrameKinematics<T>& BC) {
  const Mat3<T> R_AB = AB.R_AB.matrix();
  const Vec3<T> w_BC_A = R_AB * BC.w_AB_A;
  const Vec3<T> alpha_BC_A = R_AB * BC.alpha_AB_A;
  return {AB.R_AB * BC.R_AB, AB.w_AB_A + w_BC_A, AB.alpha_AB_A + alpha_BC_A + AB.w_AB_A.cross(w_BC_A)};
}

/// The inverse motion: how A moves as seen from B.
template <class T>
FrameKinematics<T> inverse(const FrameKinematics<T>& AB) {
  const Mat3<T> R_BA = AB.R_AB.inverse().matrix();
  // alpha_BA is the derivative in B of -w_AB; the derivatives of w_AB in A and in B are the same vector.
  return {AB.R_AB.inverse(), -(R_BA * AB.w_AB_A), -(R_BA * AB.alpha_AB_A)};
}

/// An ordered stack of frames with single-letter names, outermost first.
template <class T>
class FrameStack {
 public:
  /// The motion of a layer relative to its parent at time t (s).
  using Motion = std::function<FrameKinematics<T>(T t)>;

  /// @param root  name of the outermost frame
  explicit FrameStack(char root) {
    layers_.push_back({root, [](T) { return FrameKinematics<T>(); }});
  }

  /// Adds a frame inside the innermost one.   @throws std::invalid_argument if the name is taken
  FrameStack& add(char name, Motion motion) {
    for (const Layer& layer : layers_)
      if (layer.name == name) throw std::invalid_argument(std::string("frame name used twice: ") + name);
    layers_.push_back({name, std::move(motion)});
    return *this;
  }
  /// Adds a frame that is at rest relative to its parent.
  FrameStack& add(char name, const Rotation<T>& R_parent) {
    return add(name, [R_parent](T) {
      FrameKinematics<T> k;
      k.R_AB = R_parent;
      return k;
    });
  }
  /// Adds a frame that turns about a fixed axis of its parent and is parallel to the parent at angle 0.
  FrameStack& add(char name, const PrescribedMotion<T>& motion) {
    return add(name, [motion](T t) {
      return FrameKinematics<T>{Rotation<T>::about(motion.axis, motion.angle(t)), motion.angle_rate(t) * motion.axis,
                                motion.angle_acceleration(t) * motion.axis};
    });
  }

  /// How frame `b` moves as seen from frame `a` at time t: R_ab, and w_ab and alpha_ab in a's axes, the derivative taken in a.
  /// Either one may be the outer frame.   @throws std::invalid_argument for a name that is not in the stack
  FrameKinematics<T> kinematics(char a, char b, T t) const {
    const std::size_t ia = index(a), ib = index(b);
    if (ia > ib) return inverse(kinematics(b, a, t));
    FrameKinematics<T> k;
    for (std::size_t i = ia + 1; i <= ib; ++i) k = compose(k, layers_[i].motion(t));
    return k;
  }
  Rotation<T> attitude(char a, char b, T t) const { return kinematics(a, b, t).R_AB; }
  /// Angular velocity of b relative to a, in the axes of `expressed_in` (rad/s).
  Vec3<T> angular_velocity(char a, char b, char expressed_in, T t) const {
    return attitude(expressed_in, a, t) * kinematics(a, b, t).w_AB_A;
  }
  /// Time derivative, taken in a, of the angular velocity of b relative to a, in the axes of `expressed_in` (rad/s^2).
  Vec3<T> angular_acceleration(char a, char b, char expressed_in, T t) const {
    return attitude(expressed_in, a, t) * kinematics(a, b, t).alpha_AB_A;
  }

 private:
  struct Layer {
    char name;
    Motion motion;
  };
  std::size_t index(char name) const {
    for (std::size_t i = 0; i < layers_.size(); ++i)
      if (layers_[i].name == name) return i;
    throw std::invalid_argument(std::string("no frame of this name in the stack: ") + name);
  }
  std::vector<Layer> layers_;
};

/// The frames I, E, L (and P, if a platform is given) for a laboratory on an Earth that turns at `rate` (rad/s).
template <class T>
FrameStack<T> earth_laboratory_stack(const Site& site, T rate, const PrescribedMotion<T>* platform = nullptr) {
  PrescribedMotion<T> earth;
  earth.rate = rate;
  FrameStack<T> stack('I');
  stack.add('E', earth).add('L', laboratory_attitude<T>(site));
  if (platform != nullptr) stack.add('P', *platform);
  return stack;
}

}  // namespace earthtop
