// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study_cells.hpp"

#include <algorithm>
#include <cmath>

#include "earthtop/elementary.hpp"

namespace earthtop::report {
namespace {

constexpr double kDecades = 100;  ///< a scale is logarithmic if its numbers span more than this ratio, as on the page

}  // namespace

void CellScale::include(const study::Value& value) {
  if (const auto* word = std::get_if<std::string>(&value)) {
    if (words_.size() < most_cells_) words_.emplace(*word, 0);
    too_many_words_ = too_many_words_ || !words_.contains(*word);
    return;
  }
  const auto* number = std::get_if<double>(&value);
  if (!number) return;
  low_ = numbers_ == 0 ? *number : std::min(low_, *number);
  high_ = numbers_ == 0 ? *number : std::max(high_, *number);
  ++numbers_;
  if (!few_values_) return;
  values_.emplace(*number, 0);
  if (values_.size() > most_cells_) {
    few_values_ = false;
    values_.clear();
  }
}

void CellScale::divide() {
  log_ = low_ > 0 && high_ / low_ > kDecades;
  cells_ = few_values_ ? values_.size() : most_cells_;
  std::size_t next = 0;
  for (auto& [number, at] : values_) at = next++;
  if (numbers_ > 0) words_.clear();  // an axis of numbers and words shows its numbers
  for (auto& [word, at] : words_) at = next++;
  if (numbers_ == 0) cells_ = words_.size();
}

std::optional<std::size_t> CellScale::cell(const study::Value& value) const {
  if (const auto* word = std::get_if<std::string>(&value)) {
    const auto at = words_.find(*word);
    return at == words_.end() ? std::nullopt : std::optional(at->second);
  }
  const auto* number = std::get_if<double>(&value);
  if (!number || numbers_ == 0) return std::nullopt;
  if (few_values_) return values_.at(*number);
  const auto scaled = [&](double x) { return log_ ? real::log(x) : x; };
  const double share = (scaled(*number) - scaled(low_)) / (scaled(high_) - scaled(low_));
  const double place = std::min(share * static_cast<double>(cells_), static_cast<double>(cells_ - 1));
  return place > 0 ? static_cast<std::size_t>(place) : 0;  // none of a span that is no number, beyond 1.8e308
}

Json CellScale::json() const {
  Json values = Json::array();
  if (numbers_ > 0 && !few_values_) return {{"low", low_}, {"high", high_}, {"cells", cells_}, {"log", log_}};
  for (const auto& [number, at] : values_) values.push_back(number);
  for (const auto& [word, at] : words_) values.push_back(word);
  return {{"values", std::move(values)}};
}

void CellPicture::Cell::include(std::uint64_t number, double value) {
  if (count == 0) example = number;
  ++count;
  mean += (value - mean) / static_cast<double>(count);
}

std::vector<CellPicture> cell_pictures(std::size_t axes, std::size_t quantities) {
  std::vector<CellPicture> list;
  const auto add = [&](CellPicture picture) {
    if (list.size() < kMostCellPictures) list.push_back(std::move(picture));
  };
  for (std::size_t q = 0; q < quantities; ++q) {
    for (std::size_t a = 0; a < axes; ++a) add({q, a, std::nullopt, {}});
    for (std::size_t a = 0; a < axes; ++a)
      for (std::size_t b = a + 1; b < axes; ++b) add({q, a, b, {}});
  }
  return list;
}

}  // namespace earthtop::report
