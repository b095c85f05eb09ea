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

std::string_view to_string(Precision precision) {
  switch (precision) {
    case Precision::bits53: return "double";
    case Precision::bits64: return "long_double";
    case Precision::bits113: return "float128";
  }
  return "unknown";
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
