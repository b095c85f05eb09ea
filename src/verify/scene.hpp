// SPDX-License-Identifier: GPL-3.0-or-later
/// The data of a judged scene that the closed forms need.
#pragma once

#include "earthtop/closed_form/state.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::verify_detail {

/// The symmetric top of a scene.   @throws NotJudged if the body is not symmetric about body axis 3
SymmetricTop<double> symmetric_top(const Scene& scene);
/// The Earth's rate in laboratory axes (rad/s).
Vec3<double> earth_rate_L(const Scene& scene);

}  // namespace earthtop::verify_detail
