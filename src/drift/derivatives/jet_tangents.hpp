// SPDX-License-Identifier: GPL-3.0-or-later
/// Jets of a motion as a state with its tangents, for steps of a Taylor series. To be included before any header of the model.
#pragma once

#include "drift/derivatives/problem_jets.hpp"
//
#include "integrate/taylor/recorded_series.hpp"
#include "integrate/taylor/tangent_shape.hpp"

namespace earthtop {

/// @tparam Form  has the `System` of the motion over jets, which has the `Shape` of its state; the number `kValues` of components
/// that are followed, which come first; and the least scale of a tangent (TangentShape)
template <class Form>
struct JetTangents {
  static constexpr std::size_t kValues = Form::kValues;
  using Values = std::array<Jet, kValues>;
  using Shape = taylor::TangentShape<typename Form::System::Shape, kValues, kInputsAtOnce, Form::least_scale>;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<double, kSize>;
  using Series = RecordedSeries<double, kSize>;

  static State packed(const Values& jets) {
    State x;
    for (std::size_t i = 0; i < kValues; ++i) {
      x[i] = jets[i].value;
      for (std::size_t k = 0; k < kInputsAtOnce; ++k) x[(k + 1) * kValues + i] = jets[i].d[k];
    }
    return x;
  }
  static Values unpacked(const State& x) {
    Values jets;
    for (std::size_t i = 0; i < kValues; ++i) {
      jets[i] = x[i];
      for (std::size_t k = 0; k < kInputsAtOnce; ++k) jets[i].d[k] = x[(k + 1) * kValues + i];
    }
    return jets;
  }
};

}  // namespace earthtop
