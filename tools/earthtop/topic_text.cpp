// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "topics.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

/// The cells of a row of a table in Markdown, without its marks.
std::vector<std::string> cells_of(std::string_view row) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] == '\\' && i + 1 < row.size()) {
      cell += row[++i];
    } else if (row[i] == '|') {
      const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
      cells.push_back(first == cell.npos ? "" : cell.substr(first, last + 1 - first));
      cell.clear();
    } else if (row[i] != '`') {
      cell += row[i];
    }
  }
  return cells;
}

}  // namespace

std::string topic_text(const Topic& topic, std::size_t width) {
  std::vector<std::vector<std::string>> rows;
  for (std::string_view rest = topic.table; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (end > 0 && !rest.starts_with("| ---")) rows.push_back(cells_of(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const std::vector<std::string> header = rows.front();
  rows.erase(rows.begin());
  constexpr std::size_t kGap = 2, kWidest = 24;
  std::size_t indent = 0;
  for (const auto& row : rows)
    if (const std::size_t columns = columns_of(row.front()) + kGap; columns <= kWidest) indent = std::max(indent, columns);
  std::string text;
  for (const auto& row : rows) {
    std::string label = row.front();
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (row[i].empty() || row[i] == "-") continue;
      text += wrapped_entry(label, i == 1 ? row[i] : header[i] + ": " + row[i], width, indent);
      label.clear();
    }
  }
  return text;
}

}  // namespace earthtop::tool
