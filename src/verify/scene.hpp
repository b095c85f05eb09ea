// SPDX-License-Identifier: GPL-3.0-or-later
/// What the closed forms take of a judged scene.
#pragma once

#include "earthtop/closed_form/state.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::verify_detail {

/// The symmetric top of a scene. @throws NotJudged where it is none about body axis 3
SymmetricTop<double> symmetric_top(const Scene& scene);
/// The Earth's rate in laboratory axes (rad/s).
Vec3<double> earth_rate_L(const Scene& scene);

}  // namespace earthtop::verify_detail
