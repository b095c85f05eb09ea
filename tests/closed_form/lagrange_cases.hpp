// SPDX-License-Identifier: GPL-3.0-or-later
/// Random motions of the heavy symmetric top, by regime.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "closed_form/error_table.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"

namespace earthtop::test {

/// A top, its start and the time of evaluation; every number is exact in double.
struct LagrangeCase {
  SymmetricTop<double> top;
  Quaternion<double> q0_NB;
  Vec3<double> w0_NB_B = Vec3<double>::Zero();
  double t_s = 0;
};

struct LagrangeGenerator {
  std::string name;
  LagrangeCase (*draw)(std::mt19937_64&);
};
inline void PrintTo(const LagrangeGenerator& generator, std::ostream* out) { *out << generator.name; }
const std::vector<LagrangeGenerator>& lagrange_generators();

/// The closed form in 113 bits, with one of the eleven inputs changed by one ulp (input 0 ... 10; -1: none).
ClosedFormState<float128> wide_state(const LagrangeCase& c, int changed_input = -1);

Measure measure(const LagrangeCase& c);
std::string to_string(const LagrangeCase& c);

}  // namespace earthtop::test
