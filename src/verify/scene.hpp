// SPDX-License-Identifier: GPL-3.0-or-later
/// The data of a judged scene that the closed forms need.
#pragma once

#include "earthtop/closed_form/state.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop::verify_detail {

/// The symmetric top of a scene.   @throws NotJudged if the body is not symmetric about body axis 3
SymmetricTop<double> symmetric_top(const Scenario& scenario);
/// The release as the scene gives it.
Release<double> release_of(const Scenario& scenario);
/// The Earth's rate in laboratory axes (rad/s).
Vec3<double> earth_rate_L(const Scenario& scenario);

}  // namespace earthtop::verify_detail
