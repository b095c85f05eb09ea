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

std::string trajectory_csv(const RunResult& result) {
  constexpr std::size_t kTypicalRow = 560;  // 28 numbers of up to 20 characters
  std::string text;
  text.reserve((1 + result.rows.size()) * kTypicalRow);
  append_header(text);
  for (const DriftRow& row : result.rows) append_row(text, row);
  return text;
}

}  // namespace earthtop
