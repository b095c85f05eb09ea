// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of a page. Whatever text comes in is escaped here, and nowhere else.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "earthtop/report/report.hpp"

namespace earthtop::report {

using Json = nlohmann::ordered_json;

/// Text between tags or in a quoted attribute.
std::string escaped(std::string_view text);

/// A term and what it is; the latter is HTML.
using Facts = std::vector<std::pair<std::string, std::string>>;
std::string facts_html(const Facts& facts);

/// Cells are HTML; the header's are text.
std::string table_html(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

/// "1.14023e-03 rad", the number machine-readable to its last bit.
std::string number_html(double value, std::string_view unit, int digits = 7);

class Page {
 public:
  Page(std::string kind, std::string title);

  /// The sentence under the title; HTML.
  void headline(std::string html) { headline_ = std::move(html); }
  void verdict(std::string_view word, std::string html);
  void section(std::string_view id, std::string_view title, std::string html);
  /// A figure with its data as a table, and the same for the crosshair. Its pictures are kept for `--svg`.
  std::string chart(const std::string& name, Figure figure, std::string_view caption);
  /// A picture that is no plot, with its own table.
  std::string picture(const std::string& name, std::string svg_text, std::string_view caption, const std::string& table);
  /// A text to copy.
  static std::string command(std::string_view text);
  Json& data() { return data_; }

  Report finish();

 private:
  std::string title_, headline_, verdict_, navigation_, sections_;
  Json data_;
  std::vector<std::pair<std::string, std::string>> pictures_;
};

}  // namespace earthtop::report
