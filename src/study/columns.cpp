// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <unordered_map>

#include "earthtop/results/results.hpp"
#include "earthtop/study/study_columns.hpp"
#include "study/store.hpp"

namespace earthtop {
namespace study {
namespace {

/// Fills a column cell by cell.
class ColumnWriter {
 public:
  ColumnWriter(std::string name, std::uint64_t rows) {
    column_.name = std::move(name);
    column_.numbers.reserve(rows);
  }

  void add(double number) {
    column_.has_numbers = true;
    add_cell(number, kNoWord);
  }
  void add(const std::string& word) {
    if (column_.words.empty()) column_.places.assign(column_.numbers.size(), kNoWord);
    const auto [known, is_new] = places_.try_emplace(word, static_cast<std::int32_t>(column_.words.size()));
    if (is_new) column_.words.push_back(word);
    add_cell(kNoNumber, known->second);
  }
  void add(const Value& value) {
    if (const auto* number = std::get_if<double>(&value))
      add(*number);
    else if (const auto* word = std::get_if<std::string>(&value))
      add(*word);
    else
      add_cell(kNoNumber, kNoWord);
  }
  StudyColumn column() && { return std::move(column_); }

 private:
  static constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::int32_t kNoWord = -1;

  void add_cell(double number, std::int32_t place) {
    column_.numbers.push_back(number);
    if (!column_.words.empty()) column_.places.push_back(place);
  }

  StudyColumn column_;
  std::unordered_map<std::string, std::int32_t> places_;
};

}  // namespace
}  // namespace study

std::vector<StudyColumn> study_columns(const std::filesystem::path& file, const Watch& watch) {
  using namespace study;
  Store store = Store::open(file, sqlite::Connection::Mode::read);
  const std::uint64_t rows = store.check_intact().intact;
  std::vector<ColumnWriter> writers;
  writers.emplace_back("point", rows);
  for (const StudyAxis& axis : store.study().axes) writers.emplace_back(axis.name, rows);
  for (const StudyQuantity& quantity : store.study().quantities) writers.emplace_back(quantity.name, rows);
  writers.emplace_back("status", rows);
  writers.emplace_back("reason", rows);
  store.for_each([&](const PointResult& point) {
    if (watch.asks_to_stop()) throw Interrupted();
    auto writer = writers.begin();
    (writer++)->add(static_cast<double>(point.number));
    for (const Value& value : point.axis_values) (writer++)->add(value);
    for (const Value& value : point.values) (writer++)->add(value);
    (writer++)->add(point.status);
    writer->add(point.reason.empty() ? Value() : Value(point.reason));
  });
  std::vector<StudyColumn> columns;
  columns.reserve(writers.size());
  for (ColumnWriter& writer : writers) columns.push_back(std::move(writer).column());
  return columns;
}

}  // namespace earthtop
