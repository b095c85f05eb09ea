// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/meanings.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

bool stands_alone(const std::string& unit) { return unit != "°" && unit != "″"; }

std::string without_space(std::string_view symbol) { return std::string(symbol.substr(symbol.starts_with(' ') ? 1 : 0)); }

/// The largest size of a quantity's numbers, from its statistics; 0 where there are none.
double size_of(const Json& statistics) {
  double size = 0;
  for (const char* key : {"min", "max"})
    if (const Json end = statistics.value(key, Json()); end.is_number()) size = std::max(size, std::abs(end.get<double>()));
  return size;
}

}  // namespace

std::string read_number(double number, int digits) {
  const std::string text = with_powers(fmt::format("{:.{}g}", std::abs(number), digits));
  return number < 0 ? "−" + text : text;
}

std::string StudyColumn::label() const { return unit.empty() ? words : fmt::format("{} ({})", words, unit); }

std::string StudyColumn::html() const {
  return fmt::format("<span title=\"{}\">{}</span>", escaped(key == where ? key : key + ": " + where), escaped(label()));
}

std::string StudyColumn::text(double number, int digits) const {
  return read_number(number * factor, digits) + (unit.empty() || !stands_alone(unit) ? "" : " ") + unit;
}

StudyColumn StudyColumn::in_own_unit(double rad) const {
  StudyColumn column = *this;
  const ReadableUnit own = angle_unit(rad);
  column.factor = own.per_si;
  column.unit = without_space(own.symbol);
  return column;
}

std::string StudyColumn::number(const Json& number, int digits) const {
  if (!number.is_number()) return "";
  const double value = number.get<double>();
  return fmt::format("<data value=\"{0}\">{1}</data>", value, read_number(value * factor, digits));
}

std::vector<StudyColumn> settings_of(const Json& study) {
  std::vector<StudyColumn> list;
  for (const Json& axis : study.at("axes")) {
    StudyColumn column{axis.value("name", ""), {}, {}, {}};
    const Json pointers = axis.value("pointers", Json::array());
    for (const Json& pointer : pointers) column.where += (column.where.empty() ? "" : ", ") + pointer.get<std::string>();
    // Keys that vary together have one name; only where that has the unit of the first one are its numbers those of that key.
    const std::string first = pointers.empty() ? "" : pointers.front().get<std::string>();
    QuantityWords words = words_of_setting(column.key, first);
    std::string whole = column.key;
    std::replace_if(
        whole.begin(), whole.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
    if (pointers.size() > 1 && words.words == whole) words.unit.clear();
    column.words = std::move(words.words);
    column.unit = unit_in_signs(words.unit);
    list.push_back(std::move(column));
  }
  return list;
}

std::vector<StudyColumn> quantities_of(const Json& study) {
  std::vector<StudyColumn> list;
  const Json statistics = study.value("statistics", Json::object());
  for (const Json& quantity : study.at("quantities")) {
    StudyColumn column{quantity.value("name", ""), quantity.value("path", quantity.value("name", "")), {}, {}};
    QuantityWords words = words_of_quantity(column.key, column.where);
    column.words = std::move(words.words);
    column.unit = unit_in_signs(words.unit);
    const double size = size_of(statistics.value(column.key, Json::object()));
    if (words.unit == "rad" || words.unit == "m") {
      const ReadableUnit unit = words.unit == "rad" ? angle_unit(size) : length_unit(size);
      column.factor = unit.per_si;
      column.unit = without_space(unit.symbol);
      column.is_angle = words.unit == "rad";
    }
    list.push_back(std::move(column));
  }
  return list;
}

}  // namespace earthtop::report
