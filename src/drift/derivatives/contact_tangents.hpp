// SPDX-License-Identifier: GPL-3.0-or-later
/// A top on a table whose numbers carry their derivatives by some inputs: both motions, or the non-rotating prediction alone, which
/// is half of their state. To be included before any header of the model.
#pragma once

#include "drift/derivatives/record_tangents.hpp"
//
#include <algorithm>

#include "drift/derivatives/jet_tangents.hpp"
#include "drift/table/contact_general_drift.hpp"
#include "drift/table/contact_reduced_drift.hpp"

namespace earthtop {

/// @tparam Made  ContactReducedDrift or ContactGeneralDrift of jets, in laboratory axes
template <class Made, OnTable kMotions>
class ContactTangents {
 public:
  using System = Made;
  using Shape = typename System::Shape;
  static constexpr std::size_t kValues = kMotions == OnTable::both_motions ? System::kSize : Shape::kHalf;
  using Values = std::array<Jet, kValues>;
  using Tangents = JetTangents<ContactTangents>;
  /// Slip and position are lengths, whose changes are often small.
  static constexpr double least_scale(double of_motion) { return of_motion < 1e-3 ? 1e-9 : 1e-5; }

  ContactTangents(const DriftProblem<double>& problem, const Inputs& inputs, std::size_t count)
      : inputs_(inputs),
        model_(kMotions == OnTable::both_motions ? problem.model : without_earth_rate(problem.model)),
        beside_{model_, inputs_, count},
        system_(jets_of(model_, inputs), jets_of(problem.table->contact, inputs, &TableDerivative::contact),
                jets_of(problem.table->start, inputs, &TableDerivative::start), jets_of(problem.natural_release(), inputs)) {}
  ContactTangents(const ContactTangents&) = delete;

  Values initial_state() const { return part(system_.initial_state()); }
  /// Sizes that errors are measured against from the start.
  Values typical_state() const {
    Values sizes = part(system_.typical_state());
    for (Jet& size : sizes) size = size.value;
    return sizes;
  }
  const System& system() const { return system_; }
  void follow(const Values& x, double t) {
    if constexpr (!requires { system_.follow(x); }) system_.follow(x, Jet(t));
  }
  taylor::Operations<double> record(std::span<const double> x, double t) const {
    return record_tangents(system_.equations(), kMotions, beside_, x, t);
  }

 private:
  static Values part(const typename System::State& x) {
    Values taken;
    std::copy_n(x.begin(), kValues, taken.begin());
    return taken;
  }
  Inputs inputs_;
  Model<double> model_;
  BesideJets beside_;
  System system_;
};

using ContactReducedJets = ContactReducedDrift<Jet, Observer::laboratory>;
using ContactGeneralJets = ContactGeneralDrift<Jet, Observer::laboratory>;

/// Body axis 3 of the non-rotating prediction, in the table's axes.
template <class System, std::size_t N>
Vec3<Jet> reference_axis(const std::array<Jet, N>& x) {
  if constexpr (std::is_same_v<System, ContactReducedJets>)
    return load_vector(x, System::Shape::kN);
  else
    return rotation_matrix(load_quaternion(x, 0)).col(2);
}

}  // namespace earthtop
