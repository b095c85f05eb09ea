// SPDX-License-Identifier: GPL-3.0-or-later
/// The points of a design: computes from a point's number where the point lies along each axis.
#pragma once

#include <gsl/gsl_qrng.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "earthtop/study/study.hpp"
#include "input/overrides.hpp"
#include "study/value.hpp"

namespace earthtop::study {

/// Where a point lies along one axis.
struct Setting {
  bool at_base = false;     ///< the axis leaves the base as it is
  std::uint64_t level = 0;  ///< for a list: index of the value
  double fraction = 0;      ///< for a range: 0 at its beginning, 1 at its end
};

/// A point of the study: its number and its settings, one for each axis.
struct PlannedPoint {
  std::uint64_t number = 0;
  std::vector<Setting> settings;
};

/// The points of a design. Each is computed when it is asked for; none is stored.
class Design {
 public:
  explicit Design(const Study& study);

  /// @param number less than the study's count; for a Sobol design, not less than that of the previous call
  PlannedPoint point(std::uint64_t number);

 private:
  void fill_grid(PlannedPoint& point) const;
  void fill_one_at_a_time(PlannedPoint& point) const;
  void fill_drawn(PlannedPoint& point);
  double coordinate(std::uint64_t draw, std::size_t axis) const;
  void advance_sobol(std::uint64_t draw);

  const Study& study_;
  struct Free {
    void operator()(gsl_qrng* generator) const { gsl_qrng_free(generator); }
  };
  std::unique_ptr<gsl_qrng, Free> sobol_;
  std::uint64_t sobol_drawn_ = 0;     ///< number of vectors drawn so far
  std::vector<double> sobol_vector_;  ///< the last one drawn
};

/// The value at the axis's first pointer, which the results list for the axis; nothing at the base.
Value axis_value(const StudyAxis& axis, const Setting& setting);

/// A value of an axis with the digits that were meant, for labels: a step of a range without its rounding error.
Value meant_value(const StudyAxis& axis, const Value& value);

/// The changes that a point's axes make to the study's base; the study's own changes come before them.
std::vector<input::TreeChange> point_changes(const Study& study, const PlannedPoint& point);

}  // namespace earthtop::study
