// SPDX-License-Identifier: GPL-3.0-or-later
/// The rotation by a deviation quaternion e = (w, epsilon y) as a series: (R(e)^T - 1) / epsilon.
#pragma once

#include "integrate/state_vectors.hpp"
#include "integrate/taylor/products.hpp"

namespace earthtop {

/// The matrix M = (R(e)^T - 1) / epsilon = s (-w [y]x + epsilon (y y^T - y.y)), where s = 2/|e|^2 is constant along the exact
/// motion.
template <class T>
class DeviationTurn {
 public:
  static constexpr int kLanes = 9;

  void start(T w, const Vec3<T>& y, T epsilon) {
    scale_ = T(2) / (w * w + epsilon * epsilon * y.dot(y));
    epsilon_ = epsilon;
  }
  /// Puts in the factors of order k, into kLanes lanes, starting at this one.
  template <class ProductsOfSystem>
  static void put(ProductsOfSystem& products, int k, int lane, T w, const Vec3<T>& y) {
    products.put_scaled(k, lane, w, y);
    products.put_parallel(k, lane + 3, y, y);
    products.put_parallel(k, lane + 6, y, Vec3<T>(y[1], y[2], y[0]));
  }
  /// M at the order last convolved.
  template <class ProductsOfSystem>
  Mat3<T> matrix(const ProductsOfSystem& products, int lane) const {
    const Vec3<T> wy = scale_ * products.vector(lane), yy = scale_ * epsilon_ * products.vector(lane + 3),
                  mixed = scale_ * epsilon_ * products.vector(lane + 6);
    Mat3<T> m;
    m << -yy[1] - yy[2], wy[2] + mixed[0], mixed[2] - wy[1],  //
        mixed[0] - wy[2], -yy[0] - yy[2], wy[0] + mixed[1],   //
        wy[1] + mixed[2], mixed[1] - wy[0], -yy[0] - yy[1];
    return m;
  }

 private:
  T scale_ = T(2), epsilon_ = T(1);
};

}  // namespace earthtop
