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

using Recorded = real::Recorded<double>;

/// Takes a coefficient with its derivatives to a parameter of the recording, or to a number if it has none.
class ToParameter {
 public:
  ToParameter(taylor::Recording<double>& recording, std::vector<double>& derivatives, const BesideJets& beside)
      : recording_(recording), derivatives_(derivatives), beside_(beside) {}

  Recorded operator()(const Jet& jet) const {
    if (std::ranges::all_of(jet.d, [](double d) { return d == 0; })) return jet.value;
    derivatives_.insert(derivatives_.end(), jet.d.begin(), jet.d.end());
    return {recording_, recording_.parameter(jet.value)};
  }
  std::shared_ptr<const AngleSpline<Recorded>> operator()(const std::shared_ptr<const AngleSpline<Jet>>&) const {
    return ToRecorded<double>()(beside_.model.platform.turn.table);
  }
  /// The table of a given torque. Derivatives of motions with moving masses are found by differences.
  std::shared_ptr<const PiecewisePath<Recorded>> operator()(const std::shared_ptr<const PiecewisePath<Jet>>&) const {
    return ToRecorded<double>()(beside_.model.applied.given.table);
  }
  Journey<Recorded> operator()(const Journey<Jet>&) const {
    return with_inputs(Journey<Recorded>(beside_.model.journey), &ProblemDerivative::journey);
  }
  std::shared_ptr<const Journey<Recorded>> operator()(const std::shared_ptr<const Journey<Jet>>&) const {
    return ToRecorded<double>()(beside_.model.platform.turn.journey);
  }
  TideSeries<Recorded> operator()(const TideSeries<Jet>&) const {
    return with_inputs(TideSeries<Recorded>(beside_.model.tide), &ProblemDerivative::tide);
  }

 private:
  /// Adds to functions of time what the inputs add to them.
  template <class Sum, class Function>
  Sum with_inputs(Sum sum, Function ProblemDerivative::*added) const {
    for (std::size_t k = 0; k < beside_.inputs.size(); ++k) {
      if ((beside_.inputs[k].*added).empty()) continue;
      Jet strength = 0.0;
      strength.d[k] = 1;
      sum.add((*this)(strength), beside_.inputs[k].*added);
    }
    return sum;
  }
  taylor::Recording<double>& recording_;
  std::vector<double>& derivatives_;
  const BesideJets& beside_;
};

/// The first components of a pair's state on a table, without the integrals of friction's work.
template <class Pair>
struct FollowedOnTable {
  using Shape = typename Pair::Shape;
  Pair pair;
  template <std::size_t N>
  void operator()(const std::array<Recorded, N>& x, std::array<Recorded, N>& dxdt, const Recorded& t) const {
    typename Pair::State both{}, rate;
    std::ranges::copy(x, both.begin());
    pair(both, rate, t);
    dxdt = {};
    for (std::size_t half = 0; half < N; half += Shape::kHalf) std::copy_n(&rate[half], Shape::kWork, &dxdt[half]);
  }
};
template <class Pair>
FollowedOnTable(Pair) -> FollowedOnTable<Pair>;

ContactReducedEquations<Recorded, Observer::laboratory> made_of(
    const ContactReducedEquations<Jet, Observer::laboratory>& equations, const Model<Recorded>& model,
    const Contact<Recorded>& contact, const Quaternion<Recorded>& q_LH, const ToParameter& to) {
  return {model, contact, q_LH, to(equations.w3())};
}
ContactGeneralEquations<Recorded, Observer::laboratory> made_of(const ContactGeneralEquations<Jet, Observer::laboratory>&,
                                                                const Model<Recorded>& model, const Contact<Recorded>& contact,
                                                                const Quaternion<Recorded>& q_LH, const ToParameter&) {
  return {model, contact, q_LH};
}

/// Records a right-hand side of N numbers with their derivatives.   @param make  gives it, with coefficients by ToParameter
template <std::size_t N, class Make>
taylor::Operations<double> record(const Make& make, const BesideJets& beside, std::span<const double> x, double t) {
  taylor::Recording<double> recording;
  std::vector<double> derivatives;
  const auto equations = make(ToParameter(recording, derivatives, beside));
  const auto plain = recorded_equations<double, N>(equations, recording, x.first(N), t);
  return taylor::with_tangents<double>(plain, beside.count, derivatives, x, t);
}

template <class Equations>
taylor::Operations<double> record_on_table(const Equations& equations, OnTable motions, const BesideJets& beside,
                                           std::span<const double> x, double t) {
  const auto make = [&](const ToParameter& to) {
    Model<Recorded> model;
    Contact<Recorded> contact;
    Quaternion<Recorded> q_LH;
    convert(equations.model(), model, to), convert(equations.contact(), contact, to), convert(equations.q_LH(), q_LH, to);
    return FollowedOnTable{made_of(equations, model, contact, q_LH, to)};
  };
  return motions == OnTable::both_motions ? record<Equations::kSize>(make, beside, x, t)
                                          : record<Equations::kHalf>(make, beside, x, t);
}

}  // namespace

taylor::Operations<double> record_tangents(const Model<Jet>& model, const BesideJets& beside, std::span<const double> x,
                                           double t) {
  Model<Recorded> made;
  const auto make = [&](const ToParameter& to) {
    convert(model, made, to);
    return DriftSystem<Recorded, Observer::body, SceneKind::full, RotatingMotion::composed>(made);
  };
  return record<DriftShape<RotatingMotion::composed>::kSize>(make, beside, x, t);
}

taylor::Operations<double> record_tangents(const DrivenReducedEquations<Jet, Observer::laboratory>& equations,
                                           const BesideJets& beside, std::span<const double> x, double t) {
  const auto make = [&](const ToParameter& to) {
    DrivenReducedEquations<Recorded, Observer::laboratory> made;
    convert(equations, made, to);
    return made;
  };
  return record<DrivenReducedShape::kSize>(make, beside, x, t);
}

taylor::Operations<double> record_tangents(const ContactReducedEquations<Jet, Observer::laboratory>& equations, OnTable motions,
                                           const BesideJets& beside, std::span<const double> x, double t) {
  return record_on_table(equations, motions, beside, x, t);
}
taylor::Operations<double> record_tangents(const ContactGeneralEquations<Jet, Observer::laboratory>& equations, OnTable motions,
                                           const BesideJets& beside, std::span<const double> x, double t) {
  return record_on_table(equations, motions, beside, x, t);
}

}  // namespace earthtop
