// SPDX-License-Identifier: GPL-3.0-or-later
/// Which method fits which scene.
#pragma once

#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// `Scene::closed_form_kind`.
ExactKind closed_form_of(const Scene& scene);

/// How fast both motions and the laboratory turn together (rad/s), without the spin of a top that is symmetric about body axis
/// 3. @param scene  with a closed form
double closed_form_turn_rate_rad_s(const Scene& scene);

/// `Scene::method_refusal`.
std::optional<std::string> refuse_method(Method method, const Scene& scene);

}  // namespace earthtop
