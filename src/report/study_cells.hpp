// SPDX-License-Identifier: GPL-3.0-or-later
/// Points counted in the cells of a plane.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "report/html.hpp"
#include "study/value.hpp"

namespace earthtop::report {

/// Divides one axis of a picture into cells: a range of numbers into equal parts (of the logarithm where the numbers are positive
/// and span more than two decades), or one cell for each value where there are few.
class CellScale {
 public:
  explicit CellScale(std::size_t most_cells) : most_cells_(most_cells) {}
  void include(const study::Value& value);  ///< first pass: every value
  void divide();                            ///< between the passes
  /// Second pass. @returns the cell of a value that was included; none for nothing, or for a word among too many words
  std::optional<std::size_t> cell(const study::Value& value) const;
  bool empty() const { return numbers_ == 0 && words_.empty(); }
  /// {"low", "high", "cells", "log"}, or {"values"} where each cell is one value.
  Json json() const;

 private:
  std::size_t most_cells_, cells_ = 0;
  std::uint64_t numbers_ = 0;
  double low_ = 0, high_ = 0;
  bool log_ = false, too_many_words_ = false;
  std::map<double, std::size_t> values_;  ///< the different numbers, as long as they are few
  bool few_values_ = true;
  std::map<std::string, std::size_t> words_;
};

/// The points of one picture, in the cells of its plane.
struct CellPicture {
  std::size_t quantity = 0;       ///< what the mean is taken of
  std::size_t across = 0;         ///< the axis from left to right
  std::optional<std::size_t> up;  ///< the axis upwards; none: the quantity itself
  struct Cell {
    std::uint64_t count = 0, example = 0;  ///< number of points, and the number of the first of them
    double mean = 0;                       ///< of the quantity
    void include(std::uint64_t number, double value);
  };
  std::map<std::pair<std::size_t, std::size_t>, Cell> cells;
};

/// The pictures that are made of a study, in order of importance, at most kMostCellPictures: each quantity over each axis, and
/// its mean over each pair of axes.
inline constexpr std::size_t kMostCellPictures = 8;
std::vector<CellPicture> cell_pictures(std::size_t axes, std::size_t quantities);

}  // namespace earthtop::report
