// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "earthtop/results/results.hpp"
#include "plot/svg_text.hpp"
#include "plot/ticks.hpp"
#include "results/made_up_run.hpp"
#include "support/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace {

using test::made_up_run;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, std::string_view what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

/// Checks that elements are closed in the right order, attributes are quoted, and the text has no bare & or <.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < xml.size(); ++at) {
    if (xml[at] == '&') {
      const std::string entity = xml.substr(at, xml.find(';', at) - at + 1);
      EXPECT_TRUE(entity == "&amp;" || entity == "&lt;" || entity == "&gt;" || entity == "&quot;" || entity == "&#39;")
          << entity;
    }
    if (xml[at] != '<') continue;
    const std::size_t end = xml.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    EXPECT_EQ(tag.find('<'), std::string::npos) << tag;
    EXPECT_EQ(count(tag, "\"") % 2, 0U) << tag;
    if (tag.starts_with('/')) {
      ASSERT_FALSE(open.empty()) << tag;
      EXPECT_EQ(open.back(), tag.substr(1));
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
    at = end;
  }
  EXPECT_TRUE(open.empty());
}

Figure figure_of(std::vector<double> y, AxisScale scale = AxisScale::linear) {
  std::vector<double> x;
  for (std::size_t i = 0; i < y.size(); ++i) x.push_back(static_cast<double>(i));
  return {"title", "", {"Time", "s"}, {{{"y", "m", scale}, {{"line", x, std::move(y)}}}}};
}

/// The number of pieces in which the single line of `figure_of` is drawn.
std::size_t pieces(const std::string& picture) { return count(picture, "stroke-linejoin"); }

/// The number of straight segments in those pieces.
std::size_t segments(const std::string& picture) {
  std::size_t found = 0;
  for (std::size_t end = picture.find("\" fill=\"none\""); end != std::string::npos;
       end = picture.find("\" fill=\"none\"", end + 1)) {
    const std::size_t begin = picture.rfind("d=\"", end);
    found += count(picture.substr(begin, end - begin), "L");
  }
  return found;
}

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks.ticks)
    if (!tick.label.empty()) texts.push_back(tick.label);
  return texts;
}

TEST(DriftFigure, IsWellFormedAndStable) {
  const std::string picture = svg(drift_figure(made_up_run()));
  expect_well_formed(picture);
  EXPECT_EQ(picture, svg(drift_figure(made_up_run())));
  EXPECT_NE(picture.find("A fast top, slowly precessing"), std::string::npos);
  EXPECT_NE(picture.find("relative to the laboratory"), std::string::npos);
  for (const char* banned : {"<script", "http://www.w3.org/1999/xlink", "nan", "inf\"", "url(http", "<image"})
    EXPECT_EQ(picture.find(banned), std::string::npos) << banned;
}

TEST(DriftFigure, SurvivesRunsWithoutMuchToShow) {
  RunResult result = made_up_run();
  for (DriftRow& row : result.rows) {
    const double t = row.t_s;
    row = {};
    row.t_s = t;
    row.drift_axis_bound_rad = std::numeric_limits<double>::infinity();
  }
  expect_well_formed(svg(drift_figure(result)));
  result.rows.resize(1);
  expect_well_formed(svg(drift_figure(result)));
  result.rows.clear();
  const std::string picture = svg(drift_figure(result));
  expect_well_formed(picture);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST(DriftFigure, SizeDoesNotGrowWithTheRows) {
  const std::size_t few = svg(drift_figure(made_up_run(20'001))).size();
  const std::size_t many = svg(drift_figure(made_up_run(200'001))).size();
  EXPECT_LT(many, few + few / 4);
}

TEST(Svg, GapsBreakTheLine) {
  EXPECT_EQ(pieces(svg(figure_of({1, 3, 2, 4, 1}))), 1U);
  EXPECT_EQ(segments(svg(figure_of({1, 3, 2, 4, 1}))), 4U);
  EXPECT_EQ(pieces(svg(figure_of({1, 3, kNan, 4, 5}))), 2U);
  EXPECT_EQ(segments(svg(figure_of({1, 3, kNan, 4, 5}))), 2U);
  EXPECT_EQ(pieces(svg(figure_of({1, kNan, 3, std::numeric_limits<double>::infinity(), 5}))), 3U);
  EXPECT_EQ(pieces(svg(figure_of({1, 2, 0, 4, 5}, AxisScale::logarithmic))), 2U);
}

TEST(Svg, ExtremeNumbersStayInTheFrame) {
  constexpr double kMax = std::numeric_limits<double>::max();
  for (const std::vector<double>& y : {std::vector<double>{-kMax, 0, kMax}, {5e-324, 0, 5e-324}, {1e300, 1e300}, {0, 0}, {}}) {
    for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
      const std::string picture = svg(figure_of(y, scale));
      expect_well_formed(picture);
      EXPECT_EQ(picture.find("nan"), std::string::npos);
      EXPECT_EQ(count(picture, "inf"), 0U);
    }
  }
}

TEST(Svg, TextIsEscaped) {
  Figure figure = figure_of({1, 2});
  figure.title = "<script>alert(\"a\" & 'b')</script>\x01\xff";
  figure.panels[0].lines[0].label = "a < b";
  const std::string picture = svg(figure);
  expect_well_formed(picture);
  EXPECT_EQ(picture.find("<script"), std::string::npos);
  EXPECT_EQ(picture.find('\x01'), std::string::npos);
  EXPECT_EQ(picture.find('\xff'), std::string::npos);
  EXPECT_NE(picture.find("a &lt; b"), std::string::npos);
}

TEST(Printable, WhatCannotBeSeenStandsAsAnEscape) {
  for (const char32_t code :
       {0x1,    0x7F,   0x85,   0xAD,   0x34F,  0x61C,  0x115F, 0x180E, 0x200B, 0x200D, 0x200F,  0x2028, 0x2029,
        0x202A, 0x202E, 0x2060, 0x2066, 0x2069, 0x3164, 0xFE0F, 0xFEFF, 0xFFF9, 0xFFFE, 0xE0041, 0xE0100}) {
    std::string text = "a";
    append_utf8(code, text);
    for (const std::string& shown : {printable(text), escape_xml(text)}) {
      EXPECT_EQ(shown.substr(0, 2), "a\\") << static_cast<unsigned>(code);
      EXPECT_TRUE(std::all_of(shown.begin(), shown.end(), [](char c) { return c >= 0x20 && c < 0x7F; }));
    }
    const std::string document = json_with_escapes(testing::text_of(nlohmann::json(text)));
    EXPECT_EQ(testing::parse_json(document).get<std::string>(), text);
  }
  for (const char* seen : {"°Ω—😀", "a b", "é", "漢字", "\xC2\xA0"}) EXPECT_EQ(printable(seen), seen);
}

TEST(SvgText, OnlyWhatXmlHolds) {
  EXPECT_EQ(escape_xml("°Ω—😀"), "°Ω—😀");
  EXPECT_EQ(escape_xml("a\xE2\x80\x8B"
                       "b"),
            "a\\u200bb");
  EXPECT_EQ(escape_xml("\n\t\r"), "\n\t\r");
  EXPECT_EQ(escape_xml("\xC0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong
  EXPECT_EQ(escape_xml("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(shorten("°°°°", 4), "°°°°");
  EXPECT_EQ(shorten("°°°°", 3), "°°…");
}

TEST(Ticks, OneTwoFive) {
  EXPECT_EQ(labels(linear_ticks(0, 60, 8, true)), (std::vector<std::string>{"0", "10", "20", "30", "40", "50", "60"}));
  EXPECT_EQ(labels(linear_ticks(0, 24, 6, false)), (std::vector<std::string>{"0", "5", "10", "15", "20", "25"}));
  EXPECT_EQ(labels(linear_ticks(0, 9, 6, false)), (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(linear_ticks(-0.3, 1, 6, false)),
            (std::vector<std::string>{"−0.4", "−0.2", "0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
}

TEST(Ticks, SmallNumbersCarryAFactor) {
  const Ticks ticks = linear_ticks(0, 4e-6, 4, false);
  EXPECT_EQ(ticks.factor, "×10⁻⁶");
  EXPECT_EQ(labels(ticks), (std::vector<std::string>{"0", "1", "2", "3", "4"}));
}

TEST(Ticks, SharedLeadingDigitsBecomeAnOffset) {
  const Ticks ticks = linear_ticks(45.1230001, 45.1230005, 4, false);
  EXPECT_EQ(ticks.offset, "+ 45.1230001");
  EXPECT_EQ(ticks.factor, "×10⁻⁹");
  EXPECT_EQ(labels(ticks), (std::vector<std::string>{"0", "100", "200", "300", "400"}));
}

TEST(Ticks, PowersOfTen) {
  EXPECT_EQ(labels(logarithmic_ticks(2e-3, 5, 6)), (std::vector<std::string>{"10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"}));
  const Ticks wide = logarithmic_ticks(1e-16, 1, 6);
  EXPECT_EQ(wide.low, 1e-16);
  EXPECT_EQ(wide.high, 1);
  EXPECT_LE(labels(wide).size(), 7U);
}

}  // namespace
}  // namespace earthtop
