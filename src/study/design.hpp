// SPDX-License-Identifier: GPL-3.0-or-later
/// Which points a design takes: from a point's number to where it lies along each axis.
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
  std::uint64_t level = 0;  ///< of a list
  double fraction = 0;      ///< of a range: 0 at its beginning, 1 at its end
};

/// A point of the study: its number and its settings, one for each axis.
struct PlannedPoint {
  std::uint64_t number = 0;
  std::vector<Setting> settings;
};

/// The points of a design, in ascending order; nothing is built but the point asked for.
class Design {
 public:
  explicit Design(const Study& study);

  /// @param number  below the study's count; of a Sobol design not below that of the call before
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
  std::uint64_t sobol_drawn_ = 0;     ///< how many vectors have been drawn
  std::vector<double> sobol_vector_;  ///< the last one
};

/// The first pointer's value: what the results list for the axis; nothing at the base.
Value axis_value(const StudyAxis& axis, const Setting& setting);

/// What a point's axes change of the study's base; the study's own changes come before.
std::vector<input::TreeChange> point_changes(const Study& study, const PlannedPoint& point);

}  // namespace earthtop::study
