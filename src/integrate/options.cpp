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

std::string_view to_string(Method method) {
  switch (method) {
    case Method::automatic: return "auto";
    case Method::dopri5: return "dopri5";
    case Method::rkf78: return "rkf78";
    case Method::bulirsch_stoer: return "bulirsch_stoer";
    case Method::extrapolation: return "extrapolation";
    case Method::abm8: return "abm8";
  }
  return "unknown";
}

}  // namespace earthtop
