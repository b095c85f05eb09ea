// SPDX-License-Identifier: GPL-3.0-or-later
/// Records right-hand sides of drift integrations together with their derivatives by some inputs (tangents.hpp). The recording
/// scalar is compiled apart, since it takes long. To be included before any header of the model.
#pragma once

#include "drift/derivatives/problem_jets.hpp"
//
#include <span>

#include "drift/pivot/driven_reduced_equations.hpp"
#include "drift/table/contact_general_equations.hpp"
#include "drift/table/contact_reduced_equations.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop {

/// Where the functions of time are that jets leave out.
struct BesideJets {
  const Model<double>& model;  ///< its table of angles and its tide
  const Inputs& inputs;        ///< the tides that they add
  std::size_t count;           ///< of the inputs that are followed
};

/// The equations of any body in body axes (drift_system.hpp).
/// @param x  the state and its derivatives by each input at which they are recorded   @param t  its time
taylor::Operations<double> record_tangents(const Model<Jet>& model, const BesideJets& beside, std::span<const double> x,
                                           double t);
/// The equations of a symmetric top without its spin, in the laboratory (driven_reduced_equations.hpp).
taylor::Operations<double> record_tangents(const DrivenReducedEquations<Jet, Observer::laboratory>& equations,
                                           const BesideJets& beside, std::span<const double> x, double t);

/// What is followed of a top on a table: both motions, or the non-rotating prediction alone. The integrals of friction's work,
/// which nothing depends on, stay as they are.
enum class OnTable { both_motions, reference };
/// The equations of a top on a table (contact_reduced_equations.hpp, contact_general_equations.hpp), in laboratory axes.
taylor::Operations<double> record_tangents(const ContactReducedEquations<Jet, Observer::laboratory>& equations, OnTable motions,
                                           const BesideJets& beside, std::span<const double> x, double t);
taylor::Operations<double> record_tangents(const ContactGeneralEquations<Jet, Observer::laboratory>& equations, OnTable motions,
                                           const BesideJets& beside, std::span<const double> x, double t);

}  // namespace earthtop
