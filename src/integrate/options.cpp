// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/integrate/options.hpp"

namespace earthtop {

std::string_view to_string(Observer observer) {
  switch (observer) {
    case Observer::laboratory: return "laboratory";
    case Observer::body: return "body";
    case Observer::inertial: return "inertial";
  }
  return "unknown";
}

std::string_view to_string(ModelForm form) {
  switch (form) {
    case ModelForm::automatic: return "auto";
    case ModelForm::general: return "general";
    case ModelForm::reduced: return "reduced";
  }
  return "unknown";
}

std::string_view to_string(Composition composition) {
  switch (composition) {
    case Composition::automatic: return "auto";
    case Composition::aba82: return "aba82";
    case Composition::aba84: return "aba84";
    case Composition::aba864: return "aba864";
    case Composition::aba1064: return "aba1064";
    case Composition::rkn6: return "rkn6";
    case Composition::kahan_li8: return "kahan_li8";
  }
  return "unknown";
}

std::string_view to_string(Method method) {
  switch (method) {
    case Method::automatic: return "auto";
    case Method::dopri5: return "dopri5";
    case Method::rkf78: return "rkf78";
    case Method::bulirsch_stoer: return "bulirsch_stoer";
    case Method::extrapolation: return "extrapolation";
    case Method::abm8: return "abm8";
    case Method::taylor: return "taylor";
    case Method::dop853: return "dop853";
    case Method::gauss: return "gauss";
    case Method::splitting: return "splitting";
    case Method::long_horizon: return "long_horizon";
    case Method::closed_form: return "closed_form";
  }
  return "unknown";
}

std::string_view to_string(Precision precision) {
  switch (precision) {
    case Precision::bits53: return "double";
    case Precision::bits64: return "long_double";
    case Precision::bits113: return "float128";
  }
  return "unknown";
}

bool is_built(Method method, Precision precision) {
  switch (method) {
    case Method::automatic:
    case Method::rkf78:
    case Method::extrapolation:
    case Method::taylor:
    case Method::closed_form: return true;
    case Method::bulirsch_stoer: return precision != Precision::bits113;
    case Method::dopri5:
    case Method::abm8:
    case Method::dop853:
    case Method::gauss:
    case Method::splitting:
    case Method::long_horizon: return precision == Precision::bits53;
  }
  return false;
}

double least_tolerance(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return 5e-18;
    case Precision::bits113: return 1e-32;
  }
  return 1e-14;
}

double default_tolerance(Precision precision) {
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return 1e-16;
    case Precision::bits113: return 1e-28;
  }
  return 1e-12;
}

}  // namespace earthtop
