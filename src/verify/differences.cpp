// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/differences.hpp"

#include "verify/geometry.hpp"

namespace earthtop::verify_detail {

double attitude_distance(const std::array<double, 4>& p, const std::array<double, 4>& q) {
  return attitude_distance(quaternion<float80>(p), quaternion<float80>(q));
}

double return_error(const DriftRow& returned, const DriftRow& release) {
  const Vec3<double> missed = vector(returned.w_LB_B) + vector(release.w_LB_B);
  return worse(attitude_distance(quaternion(returned.q_LB), quaternion(release.q_LB)),
               norm(missed) / norm(vector(release.w_LB_B)));
}

}  // namespace earthtop::verify_detail
