// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/design.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "earthtop/elementary.hpp"
#include "error/gsl_errors.hpp"
#include "study/permutation.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace study {
namespace {

constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 53U;

/// A product that is limited to kMostPoints + 1.
std::uint64_t times_up_to(std::uint64_t a, std::uint64_t b) { return a != 0 && b > kMostPoints / a ? kMostPoints + 1 : a * b; }

double value_of(const StudyAxis::Range& range, std::size_t pointer, double fraction) {
  const double from = range.from[pointer], to = range.to[pointer];
  if (fraction == 0) return from;
  if (fraction == 1) return to;
  if (range.logarithmic) return from * real::exp(fraction * real::log(to / from));
  return from + fraction * (to - from);
}

/// Saltelli's order: for each base point first its A, then its B, then A with one column taken from B, axis by axis.
struct SobolPlace {
  std::uint64_t draw, member;
};
SobolPlace sobol_place(const Study& study, std::uint64_t number) {
  if (!study.design.indices) return {number, 0};
  const std::uint64_t block = study.axes.size() + 2;
  return {number / block, number % block};
}

/// The setting for the i-th value of an axis.
Setting level_setting(const StudyAxis& axis, std::uint64_t i) {
  if (!axis.range) return {false, i, 0};
  const std::uint64_t last = axis.range->points - 1;
  return {false, 0, last == 0 ? 0 : static_cast<double>(i) / static_cast<double>(last)};
}

/// The setting for a number 0 <= u < 1: a position within a range, or one of the levels, all equally likely.
Setting drawn_setting(const StudyAxis& axis, double u) {
  if (axis.range) return {false, 0, u};
  const auto count = static_cast<double>(axis.levels.size());
  return {false, std::min<std::uint64_t>(static_cast<std::uint64_t>(u * count), axis.levels.size() - 1), 0};
}

}  // namespace

Design::Design(const Study& study) : study_(study) {
  if (study.design.kind != DesignKind::sobol) return;
  const std::size_t dimensions = study.axes.size() * (study.design.indices ? 2 : 1);
  const ReturnedGslErrors returned;
  sobol_.reset(allocated(gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimensions))));
  sobol_vector_.resize(dimensions);
}

PlannedPoint Design::point(std::uint64_t number) {
  PlannedPoint point{number, std::vector<Setting>(study_.axes.size())};
  switch (study_.design.kind) {
    case DesignKind::grid: fill_grid(point); break;
    case DesignKind::one_at_a_time: fill_one_at_a_time(point); break;
    case DesignKind::random:
    case DesignKind::latin_hypercube:
    case DesignKind::sobol: fill_drawn(point); break;
  }
  return point;
}

void Design::fill_grid(PlannedPoint& point) const {
  std::uint64_t rest = point.number;
  for (std::size_t a = study_.axes.size(); a-- > 0;) {
    const std::uint64_t size = study_.axes[a].size();
    point.settings[a] = level_setting(study_.axes[a], rest % size);
    rest /= size;
  }
}

void Design::fill_one_at_a_time(PlannedPoint& point) const {
  std::uint64_t rest = point.number;
  for (Setting& setting : point.settings) setting.at_base = true;
  if (rest == 0) return;  // the base itself
  --rest;
  for (std::size_t a = 0; a < study_.axes.size(); ++a) {
    const std::uint64_t size = study_.axes[a].size();
    if (rest < size) {
      point.settings[a] = level_setting(study_.axes[a], rest);
      return;
    }
    rest -= size;
  }
}

void Design::advance_sobol(std::uint64_t draw) {
  if (sobol_drawn_ > draw + 1) throw std::logic_error("a Sobol sequence goes forward only");
  for (; sobol_drawn_ <= draw; ++sobol_drawn_) gsl_qrng_get(sobol_.get(), sobol_vector_.data());
}

/// @param axis values from the number of axes on address the second matrix (B) of Saltelli's scheme
double Design::coordinate(std::uint64_t draw, std::size_t axis) const {
  const StudyDesign& design = study_.design;
  if (design.kind == DesignKind::sobol) {
    // Each axis is shifted (modulo 1) by a random number (Cranley and Patterson, 1976); each seed gives another, equally good
    // sequence.
    const double turned = sobol_vector_[axis] + unit_number(mixed(design.seed, axis, 0));
    return turned < 1 ? turned : turned - 1;
  }
  const double within = unit_number(mixed(design.seed, 2 * axis, draw));
  if (design.kind == DesignKind::random) return within;
  const std::uint64_t cell = permuted(draw, design.points, design.seed, 2 * axis + 1);
  const double u = (static_cast<double>(cell) + within) / static_cast<double>(design.points);
  return std::min(u, 1 - 0x1p-53);
}

void Design::fill_drawn(PlannedPoint& point) {
  const auto [draw, member] = sobol_place(study_, point.number);
  if (sobol_) advance_sobol(draw);
  const std::size_t axes = study_.axes.size();
  for (std::size_t a = 0; a < axes; ++a) {
    const bool of_second = member == 1 || member == a + 2;
    point.settings[a] = drawn_setting(study_.axes[a], coordinate(draw, of_second ? axes + a : a));
  }
}

Value axis_value(const StudyAxis& axis, const Setting& setting) {
  if (setting.at_base) return {};
  if (!axis.range) return read_value(axis.levels[setting.level].front());
  const double value = value_of(*axis.range, 0, setting.fraction);
  return std::isfinite(value) ? Value(value) : Value();
}

Value meant_value(const StudyAxis& axis, const Value& value) {
  const auto* number = std::get_if<double>(&value);
  if (!axis.range || !number) return value;
  return meant_number(*number,
                      rounding_of_step(axis.range->from.front(), axis.range->to.front(), axis.range->logarithmic, *number));
}

std::vector<input::TreeChange> point_changes(const Study& study, const PlannedPoint& point) {
  std::vector<input::TreeChange> list;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const StudyAxis& axis = study.axes[a];
    const Setting& setting = point.settings[a];
    if (setting.at_base) continue;
    for (std::size_t i = 0; i < axis.pointers.size(); ++i)
      if (axis.range)
        list.push_back({axis.pointers[i], value_of(*axis.range, i, setting.fraction)});
      else
        list.push_back({axis.pointers[i], axis.levels[setting.level][i]});
  }
  return list;
}

}  // namespace study

std::optional<std::uint64_t> point_count(const Study& study) {
  using namespace study;
  std::uint64_t count = 0;
  switch (study.design.kind) {
    case DesignKind::grid:
      count = 1;
      for (const StudyAxis& axis : study.axes) count = times_up_to(count, axis.size());
      break;
    case DesignKind::one_at_a_time:
      count = 1;
      for (const StudyAxis& axis : study.axes) count = std::min(count + std::min(axis.size(), kMostPoints), kMostPoints + 1);
      break;
    case DesignKind::latin_hypercube: count = study.design.points; break;
    case DesignKind::random:
    case DesignKind::sobol:
      count = study.design.indices ? times_up_to(study.design.points, study.axes.size() + 2) : study.design.points;
      break;
  }
  if (count > kMostPoints) return std::nullopt;
  return count;
}

}  // namespace earthtop
