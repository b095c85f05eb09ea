// SPDX-License-Identifier: GPL-3.0-or-later
/// The sets of variables and equations in which the motion of a top on a table can be integrated.
#pragma once

#include <vector>

#include "earthtop/scenario/support.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// A set of variables and their equations: the observer and the form.
struct Equations {
  Observer observer;
  ModelForm form;
};

/// @returns those that a run takes first; the last are as unlike them as there are
inline std::vector<Equations> equations_on_table(const Scene& scene) {
  constexpr Equations kReduced{Observer::laboratory, ModelForm::reduced}, kInertial{Observer::inertial, ModelForm::reduced};
  constexpr Equations kGeneral{Observer::laboratory, ModelForm::general}, kUnlike{Observer::inertial, ModelForm::general};
  if (has_exact_coulomb(scene.table<double>().contact)) return {kReduced};  // only these stop the slip
  if (scene.form({}) == ModelForm::reduced) return {kReduced, kInertial, kGeneral, kUnlike};
  return {kGeneral, kUnlike};
}

}  // namespace earthtop
