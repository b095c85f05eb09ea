// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/jet.hpp"            // must come first: the model's formulas call the jets' functions
#include "integrate/taylor/recorded_model.hpp"  // and those of the recording scalar
//
#include <vector>

#include "drift/derivatives/record_tangents.hpp"
#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/driven_reduced_equations.hpp"
#include "integrate/taylor/record_equations.hpp"
#include "integrate/taylor/tangents.hpp"

namespace earthtop {
namespace {

using R = real::Recorded<double>;

/// Takes a coefficient with its derivatives to a parameter of the recording, or to a number if it has none.
class ToParameter {
 public:
  ToParameter(taylor::Recording<double>& recording, std::vector<double>& derivatives, const BesideJets& beside)
      : recording_(recording), derivatives_(derivatives), beside_(beside) {}

  R operator()(const Jet& jet) const {
    if (std::ranges::all_of(jet.d, [](double d) { return d == 0; })) return jet.value;
    derivatives_.insert(derivatives_.end(), jet.d.begin(), jet.d.end());
    return {recording_, recording_.parameter(jet.value)};
  }
  std::shared_ptr<const AngleSpline<R>> operator()(const std::shared_ptr<const AngleSpline<Jet>>&) const {
    return ToRecorded<double>()(beside_.model.platform.turn.table);
  }
  TideSeries<R> operator()(const TideSeries<Jet>&) const {
    TideSeries<R> tide(beside_.model.tide);
    for (std::size_t k = 0; k < beside_.inputs.size(); ++k) {
      if (beside_.inputs[k].tide.empty()) continue;
      Jet strength = 0.0;
      strength.d[k] = 1;
      tide.add((*this)(strength), beside_.inputs[k].tide);
    }
    return tide;
  }

 private:
  taylor::Recording<double>& recording_;
  std::vector<double>& derivatives_;
  const BesideJets& beside_;
};

/// Records a right-hand side of N numbers with their derivatives.   @param make  gives it, with coefficients by ToParameter
template <std::size_t N, class Make>
taylor::Operations<double> record(const Make& make, const BesideJets& beside, std::span<const double> x, double t) {
  taylor::Recording<double> recording;
  std::vector<double> derivatives;
  const auto equations = make(ToParameter(recording, derivatives, beside));
  const auto plain = recorded_equations<double, N>(equations, recording, x.first(N), t);
  return taylor::with_tangents<double>(plain, beside.count, derivatives, x, t);
}

}  // namespace

taylor::Operations<double> record_tangents(const Model<Jet>& model, const BesideJets& beside, std::span<const double> x,
                                           double t) {
  Model<R> made;
  const auto make = [&](const ToParameter& to) {
    convert(model, made, to);
    return DriftSystem<R, Observer::body, SceneKind::full, RotatingMotion::composed>(made);
  };
  return record<DriftShape<RotatingMotion::composed>::kSize>(make, beside, x, t);
}

taylor::Operations<double> record_tangents(const DrivenReducedEquations<Jet, Observer::laboratory>& equations,
                                           const BesideJets& beside, std::span<const double> x, double t) {
  const auto make = [&](const ToParameter& to) {
    DrivenReducedEquations<R, Observer::laboratory> made;
    convert(equations, made, to);
    return made;
  };
  return record<DrivenReducedShape::kSize>(make, beside, x, t);
}

}  // namespace earthtop
