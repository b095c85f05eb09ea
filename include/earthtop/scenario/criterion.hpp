// SPDX-License-Identifier: GPL-3.0-or-later
/// The criteria that a scenario's results must satisfy, known independently of any run; `earthtop verify` judges them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace earthtop {

enum class CriterionKind {
  value,         ///< a number known from another source
  invariant,     ///< a quantity that the exact motion conserves
  closed_form,   ///< the rows are compared with a formula
  equivalence,   ///< the rows are compared with those that follow from another scene's rows
  exactly_zero,  ///< the quantity is zero, bit for bit
  order,         ///< how the error decreases with the step
  verdict,       ///< the run's verdict on its drift, and from which time it holds
  refused        ///< the scene cannot be run and must be refused
};

struct CriterionSpec {
  CriterionKind kind = CriterionKind::value;
  std::string quantity;             ///< what is judged; for an equivalence: how the two runs are related
  std::vector<std::string> set;     ///< "/json/pointer=value": the scene judged; for an equivalence: the other scene
  std::vector<double> values;       ///< one to four expected values, in the unit of the quantity
  std::optional<double> at_s;       ///< time of the row (s); default: the duration
  std::optional<double> until_s;    ///< only rows up to this time are judged (s)
  std::optional<double> tolerance;  ///< largest error allowed, in the unit of the error
  std::string why;                  ///< source of values and tolerance
  bool slow = false;                ///< whether judging takes over a minute
  bool operator==(const CriterionSpec&) const = default;
};

}  // namespace earthtop
