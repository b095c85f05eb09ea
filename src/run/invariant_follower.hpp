// SPDX-License-Identifier: GPL-3.0-or-later
/// Follows what a motion conserves over the rows of a run.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "earthtop/model/conserved.hpp"
#include "earthtop/model/laboratory_now.hpp"
#include "earthtop/real.hpp"
#include "earthtop/run.hpp"
#include "run/row_vectors.hpp"

namespace earthtop {

/// Records the change of one conserved quantity over the rows.
template <class T>
class InvariantFollower {
 public:
  explicit InvariantFollower(const ConservedQuantity<T>& quantity) {
    report_.name = quantity.name, report_.unit = quantity.unit;
  }
  void include(const ConservedValue<T>& now) {
    if (first_) initial_ = now.value;
    first_ = false;
    const T change = real::abs(now.value - initial_);
    if (!(change <= largest_change_)) largest_change_ = change;  // also where it is no number
    scale_ = std::max(scale_, now.scale);
  }
  InvariantReport report() const {
    InvariantReport report = report_;
    report.initial = static_cast<double>(initial_);
    report.largest_change = static_cast<double>(largest_change_);
    report.scale = static_cast<double>(scale_);
    return report;
  }

 private:
  InvariantReport report_;
  T initial_ = T(0), largest_change_ = T(0), scale_ = T(0);
  bool first_ = true;
};

/// The angles of a row's gimbals and their rates, of one of its two motions.
template <class T>
GimbalAngles<T> gimbal_angles(const BasicGimbalRow<T>& row, bool rotating) {
  if (rotating) return {row.outer_angle_rad, row.inner_angle_rad, row.outer_rate_rad_s, row.inner_rate_rad_s};
  return {row.ref_outer_angle_rad, row.ref_inner_angle_rad, row.ref_outer_rate_rad_s, row.ref_inner_rate_rad_s};
}

/// @param quantity  must have a meaning on a pivot   @param model  in SI units
template <class T>
InvariantReport followed_on_pivot(const ConservedQuantity<T>& quantity, const Model<T>& model,
                                  const std::vector<BasicDriftRow<T>>& rows, const Watch& watch = {}) {
  const Vec3<T> across_up = model.W_IL_L.cross(Vec3<T>(Vec3<T>::UnitZ()));
  const Vec3<T> across_outer = model.W_IL_L.cross(Vec3<T>(model.gimbals.R_P0.col(2)));
  constexpr int kRounding = 8;  // units in the last place, of an outer axis that is parallel to the Earth's
  const bool rotating = quantity.motion == ConservingMotion::rotating ||
                        (quantity.motion == ConservingMotion::about_up && norm(across_up) == T(0)) ||
                        (quantity.motion == ConservingMotion::about_outer_axis &&
                         norm(across_outer) <= T(kRounding) * real::epsilon<T>() * norm(model.W_IL_L));
  const ModelInTime<T> in_time(model);
  InvariantFollower<T> follower(quantity);
  for (const BasicDriftRow<T>& row : rows) {
    if (watch.asks_to_stop()) break;
    const T rate = !row.rotor ? T(0) : rotating ? row.rotor->rate_rad_s : row.rotor->ref_rate_rad_s;
    const GimbalAngles<T> gimbals = row.gimbals ? gimbal_angles(*row.gimbals, rotating) : GimbalAngles<T>();
    const Model<T>& now = row.gimbals ? model : in_time.at(row.t_s);
    const MassSums<T>* masses = in_time.masses_at(row.t_s);
    const LaboratoryOf<T> laboratory(now, row.t_s, rotating);
    follower.include(quantity.on_pivot(
        InstantOnPivot<T>{now, laboratory.w_IL_L, laboratory.gravity_L, quaternion_of(rotating ? row.q_LB : row.ref_q_LB),
                          vector_of(rotating ? row.w_LB_B : row.ref_w_LB_B), rate, gimbals, masses, row.t_s}));
  }
  return follower.report();
}

}  // namespace earthtop
