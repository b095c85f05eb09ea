// SPDX-License-Identifier: GPL-3.0-or-later
/// Building blocks of a page. All text is escaped here, and nowhere else.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "earthtop/report/report.hpp"
#include "report/drawings.hpp"

namespace earthtop::report {

using Json = nlohmann::ordered_json;

/// Escapes text to be put between tags or in a quoted attribute.
std::string escaped(std::string_view text);

/// A picture without its style: a page's own style contains its rules.
std::string without_style(std::string picture);

/// A list of terms and their descriptions; the descriptions are HTML.
using Facts = std::vector<std::pair<std::string, std::string>>;
std::string facts_html(const Facts& facts);

/// A table in a box that scrolls by itself where the page is narrow. The cells are HTML; the header's cells are text.
std::string table_html(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

/// A number with its unit, e.g. "1.14 × 10⁻³ rad", with a machine-readable value that is exact to the last bit; empty where
/// it is not finite.
std::string number_html(double value, std::string_view unit, int digits = 4);
/// The same of a document's value; empty where that is no number.
std::string number_html(const Json& value, std::string_view unit, int digits);

/// A point of a chart, and what it is.
struct Mark {
  double x = 0, y = 0;
  std::string text;
};

class Page {
 public:
  /// @param notes  sentences on what could not be verified
  Page(std::string kind, std::string title, std::vector<std::string> notes = {});

  /// Replaces the title on the page, not that of the document, by a finding, with the title as a small line above it; HTML.
  void finding(std::string html) { finding_ = std::move(html); }
  /// Sets the sentence under the title; HTML.
  void headline(std::string html) { headline_ = std::move(html); }
  void verdict(std::string_view word, std::string html);
  void section(std::string_view id, std::string_view title, std::string html);
  /// Puts the sections that follow into a part of their own, which is closed on a screen and open on paper.
  void fold(std::string_view id, std::string_view title);
  /// A figure, drawn for a desk and for a phone, with its data as a table, and the same data for the crosshair. The wide
  /// picture is also kept for `--svg`.
  /// @param at  the values of x that table and crosshair have, ascending; empty: all of the figure's
  std::string chart(const std::string& name, Figure figure, std::string_view caption, std::vector<double> at = {});
  /// A figure whose lines have more points than a page can list: table and crosshair have those of another figure with the same lines.
  std::string chart(const std::string& name, Figure figure, const Figure& listed, std::string_view caption);
  /// A figure of one panel whose points speak for themselves: each shows its text under the pointer. The page has their table.
  std::string chart_of_marks(const std::string& name, Figure figure, const std::vector<Mark>& marks, std::string_view caption);
  /// A picture that is not a plot, with its own table.
  std::string picture(const std::string& name, Drawings drawings, std::string_view caption, const std::string& table);
  /// A picture in the place of one that moves, on paper and where there are no scripts.
  std::string still(const std::string& name, Drawings drawings);
  /// A text with a button to copy it.
  static std::string command(std::string_view text);
  Json& data() { return data_; }
  /// The kind of thing that the page is about, as a gallery groups them.
  void group(std::string_view title) { group_ = title; }
  /// A link back to the gallery's index above the title, and a sentence beside it; HTML. The page is then one of a gallery.
  void belongs_to(const std::string& index, const std::string& html);
  /// A small picture for an index, where the page has none to take it from; an SVG document.
  void small_picture(std::string svg) { small_ = std::move(svg); }

  Report finish();

 private:
  /// Both drawings of a figure with its caption and a table; the wide one is kept.
  std::string drawn(const std::string& name, Figure figure, std::string_view caption, const std::string& table);

  /// Keeps the drawings of a picture: the wide one for `--svg`, of the first the narrow one for an index.
  void keep(const std::string& name, const Drawings& drawings);

  std::string title_, finding_, headline_, verdict_, navigation_, sections_, group_, above_, small_;
  std::string folded_,
      folded_navigation_;  ///< the begin of the folded part, and the links to its sections; empty: there is none
  Json data_ = Json::object();
  std::vector<std::pair<std::string, std::string>> pictures_;
  std::vector<std::string> notes_;
};

}  // namespace earthtop::report
