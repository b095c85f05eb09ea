// SPDX-License-Identifier: GPL-3.0-or-later
/// The criteria that a scenario's results must satisfy, known independently of any run; `earthtop verify` judges them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace earthtop {

enum class CriterionKind {
  value,         ///< a number known from elsewhere
  invariant,     ///< a quantity that the exact motion conserves
  closed_form,   ///< the rows against a formula
  equivalence,   ///< the rows against those of another scene, of which they are known to follow
  exactly_zero,  ///< bit for bit
  order,         ///< how the error falls with the step
  verdict,       ///< what the run says of the worth of its drift, and from when
  refused        ///< a scene that cannot be run must not be
};

struct CriterionSpec {
  CriterionKind kind = CriterionKind::value;
  std::string quantity;             ///< what is judged; of an equivalence, how the two runs are related
  std::vector<std::string> set;     ///< "/json/pointer=value": the scene judged; of an equivalence, the other scene
  std::vector<double> values;       ///< one to four, unit of the quantity
  std::optional<double> at_s;       ///< time of the row; default: the duration
  std::optional<double> until_s;    ///< rows up to here only
  std::optional<double> tolerance;  ///< largest error; unit of the error
  std::string why;                  ///< where values and tolerance come from
  bool slow = false;                ///< takes over a minute
  bool operator==(const CriterionSpec&) const = default;
};

}  // namespace earthtop
