#include "earthtop/results/results.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"

namespace earthtop {
namespace {

std::string header() {
  std::string text;
  for (const Column& column : trajectory_columns()) {
    if (&column != trajectory_columns().data()) text += ',';
    text += column.name;
  }
  text += '\n';
  return text;
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
  const auto append = [&](std::string& text, std::size_t i) { append_row(text, result.rows[i]); };
  write_csv(header(), result.rows.size(), append, sink);
}

std::string trajectory_csv(const RunResult& result) {
  std::string text;
  write_trajectory_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
