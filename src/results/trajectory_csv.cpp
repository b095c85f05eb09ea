#include "earthtop/results/results.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"

namespace earthtop {
namespace {

void append_header(std::string& text) {
  for (const Column& column : trajectory_columns()) {
    if (&column != trajectory_columns().data()) text += ',';
    text += column.name;
  }
  text += '\n';
}

void append_row(std::string& text, const DriftRow& row) {
  for (const Column& column : trajectory_columns()) {
    if (&column != trajectory_columns().data()) text += ',';
    if (const auto value = column.value(row)) append_number(text, *value);
  }
  text += '\n';
}

}  // namespace

void write_trajectory_csv(const RunResult& result, const std::function<void(std::string_view)>& sink) {
  std::string text;
  append_header(text);
  for (const DriftRow& row : result.rows) {
    append_row(text, row);
    if (text.size() < kCsvPiece) continue;
    sink(text);
    text.clear();
  }
  sink(text);
}

std::string trajectory_csv(const RunResult& result) {
  std::string text;
  write_trajectory_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
