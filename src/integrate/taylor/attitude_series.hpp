// SPDX-License-Identifier: GPL-3.0-or-later
/// The products of series that contain an attitude quaternion: its own rate of change, and vectors of the laboratory seen from
/// the body.
#pragma once

#include "earthtop/frames/rotation.hpp"
#include "integrate/state_vectors.hpp"
#include "integrate/taylor/products.hpp"

namespace earthtop {

template <class T, std::size_t N>
Quaternion<T> load_quaternion(const std::array<T, N>& x, std::size_t at) {
  return {x[at], load_vector(x, at + 1)};
}

/// Puts the factors of these products into lanes (`put_...`) and reads the results from them. Each kind takes the given number
/// of lanes, from the lane that the caller names.
template <class T>
class AttitudeSeries {
 public:
  static constexpr int kRateLanes = 12, kVectorLanes = 10;

  /// Notes |q|, which is constant along the exact motion: its round-off must not scale a torque.
  void start(const Quaternion<T>& q) { inverse_norm_squared_ = T(1) / (q.w * q.w + q.v.dot(q.v)); }

  /// 2 / |q|^2
  T double_inverse_norm_squared() const { return T(2) * inverse_norm_squared_; }

  /// Puts in the factors of q w_B at order k.
  template <class ProductsOfSystem>
  static void put_rate(ProductsOfSystem& products, int k, int lane, const Quaternion<T>& q, const Vec3<T>& w_B) {
    products.put_scaled(k, lane, q.w, w_B);
    products.put_parallel(k, lane + 3, q.v, w_B);
    products.put_cross(k, lane + 6, q.v, w_B);
  }
  /// q w_B / 2 at the order last convolved.
  template <class ProductsOfSystem>
  static Quaternion<T> half_product(const ProductsOfSystem& products, int lane) {
    const Vec3<T> v = products.vector(lane) + products.cross(lane + 6);
    return {-products.sum_of_three(lane + 3) / T(2), v / T(2)};
  }

  /// Puts in the factors of any constant vectors of the laboratory as seen from the body.
  template <class ProductsOfSystem>
  static void put_vectors(ProductsOfSystem& products, int k, int lane, const Quaternion<T>& q) {
    products.put_parallel(k, lane, q.v, q.v);
    products.put_parallel(k, lane + 3, q.v, Vec3<T>(q.v[1], q.v[2], q.v[0]));
    products.put_scaled(k, lane + 6, q.w, q.v);
    products.put(k, lane + 9, q.w, q.w);
  }
  /// A constant vector as seen from the body, R_LB^T u_L = ((w^2 - v^2) u + 2 v (v.u) - 2 w v x u) / |q|^2 for q = (w, v).
  template <class ProductsOfSystem>
  Vec3<T> into_body(const ProductsOfSystem& products, int lane, const Vec3<T>& u_L) const {
    const Vec3<T> vv = products.vector(lane), mixed = products.vector(lane + 3), wv = products.vector(lane + 6);
    const Vec3<T> v_of_v_dot_u(vv[0] * u_L[0] + mixed[0] * u_L[1] + mixed[2] * u_L[2],
                               mixed[0] * u_L[0] + vv[1] * u_L[1] + mixed[1] * u_L[2],
                               mixed[2] * u_L[0] + mixed[1] * u_L[1] + vv[2] * u_L[2]);
    const T difference = products.at(lane + 9) - vv.sum();
    return inverse_norm_squared_ * (difference * u_L + T(2) * v_of_v_dot_u - T(2) * wv.cross(u_L));
  }

 private:
  T inverse_norm_squared_ = T(1);
};

}  // namespace earthtop
