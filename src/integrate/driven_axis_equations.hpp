// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a symmetric top's axis on the rotating Earth, with applied torques, a tide or a moving pivot, in laboratory axes.
/// Those of the axis are in reduced_top.hpp; the torques are those of reduced_torques.hpp, and the spin w3 changes by the one along the
/// axis. The angle through which the top has turned about its axis enters nowhere.
///
/// The state:  [0,3) axis n   [3,6) transverse inertial rate u   [6] w3 minus that at release
#pragma once

#include <array>

#include "earthtop/model/equations.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/state_vectors.hpp"
#include "model/seen_beside_axis.hpp"

namespace earthtop {

/// The shape of a state. The spin is measured against a full spin, not against its change.
struct DrivenAxisShape {
  static constexpr std::size_t kSize = 7;
  static constexpr auto groups() { return std::array<ComponentGroup, 3>{{{0, 3, 1.0}, {3, 3, 1e-3}, {6, 1, 1e-3}}}; }
};

/// @tparam T  a number, or a scalar that records operations
template <class T>
struct DrivenAxisEquations {
  static constexpr std::size_t kSize = DrivenAxisShape::kSize;
  using State = std::array<T, kSize>;

  Model<T> model;
  ReducedTop<T> top;
  T w3;         ///< inertial spin at release
  T b, b_rest;  ///< (I3/I1) w3, and its rounding error
  EARTHTOP_MEMBERS(model, top, w3, b, b_rest)

  void operator()(const State& x, State& dxdt, T t) const {
    const Vec3<T> n = load_vector(x, 0), u = load_vector(x, 3), &W_L = model.W_IL_L;
    SeenBesideAxis<T> seen;
    seen.n = n, seen.u = u, seen.w3 = w3 + x[6], seen.w_IP = W_L;
    seen.field = pivot_field<SceneKind::full>(model, t).rotating_L;
    see_rotating_motion(top, model, t, seen);
    const AxisTorques<T> torques = axis_torques<T, T>(top, model, moment_factor(top, n), seen);
    const T nutation = b + (b_rest + top.spin_ratio * x[6]);
    const Vec3<T> s = u.cross(n);
    store_vector(Vec3<T>(s - W_L.cross(n)), dxdt, 0);
    store_vector(Vec3<T>(torques.across - nutation * s - W_L.cross(u)), dxdt, 3);
    dxdt[6] = torques.along;
  }
};

}  // namespace earthtop
