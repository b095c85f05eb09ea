// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/results/results.hpp"
#include "plot/svg_text.hpp"
#include "plot/ticks.hpp"
#include "results/made_up_run.hpp"
#include "results/turns.hpp"
#include "support/count.hpp"
#include "support/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace {

using test::made_up_run;
using testing::count;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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

/// A sine with some swings over the picture, twelve points for each.
Figure swings(int count, double size = 1, AxisScale scale = AxisScale::linear) {
  std::vector<double> y;
  for (int i = 0; i <= 12 * count; ++i) y.push_back(2 + size * std::sin(2 * std::numbers::pi * i / 12));
  return figure_of(std::move(y), scale);
}
std::size_t bands(const std::string& picture) { return count(picture, "class=\"et-band\""); }
bool legend_names_band(const std::string& picture) { return picture.find("line (band: least to most)") != picture.npos; }

/// The smallest and the largest y of the points of a band (px).
std::pair<double, double> extent_of_band(const std::string& picture) {
  const std::size_t end = picture.find("Z\" class=\"et-band\"");
  std::string path = picture.substr(0, end);
  path = path.substr(path.rfind("d=\"M") + 4);
  std::replace(path.begin(), path.end(), 'L', ' ');
  std::istringstream numbers(path);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (double x = 0, y = 0; numbers >> x >> y;) low = std::min(low, y), high = std::max(high, y);
  return {low, high};
}

// The wide picture has 756 px across: a swing has 15 px for itself, or 1.5.
TEST(Svg, SwingsTooFastForPixelsAreABand) {
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
    const std::string few = svg(swings(50, 1, scale)), many = svg(swings(500, 1, scale));
    EXPECT_EQ(bands(few), 0U);
    EXPECT_FALSE(legend_names_band(few));
    EXPECT_EQ(bands(many), 1U);
    EXPECT_TRUE(legend_names_band(many));
    EXPECT_LT(many.size(), few.size()) << "straight edges need few points";
    expect_well_formed(many);
    // From 1 to 3: the ends of the axis are 1 and 3, or 1 and 10. A second has three px that the sine's samples may miss.
    const PlotFrame frame = frame_of(swings(500, 1, scale));
    const auto [top, bottom] = extent_of_band(many);
    const double high = scale == AxisScale::linear ? frame.top : frame.floor + (frame.top - frame.floor) * std::log10(3.0);
    constexpr double kRounding = 0.011;  // px: two decimals
    EXPECT_NEAR(bottom, frame.floor, kRounding);
    EXPECT_NEAR(top, high, kRounding);
  }
}

// Swings that are smaller than a straight line's thickness are no band in words.
TEST(Svg, SwingsThatCannotBeSeenAreALine) {
  Figure figure = swings(500, 1e-3);
  figure.panels[0].lines.push_back({"whole", {0, 6000}, {0, 4}});
  EXPECT_FALSE(legend_names_band(svg(figure)));
}

// A value that is no number breaks a band as it breaks a line.
TEST(Svg, GapsBreakABand) {
  Figure figure = swings(500);
  figure.panels[0].lines[0].y[3000] = kNan;
  EXPECT_EQ(bands(svg(figure)), 2U);
  figure = swings(500);
  figure.panels[0].lines[0].style = LineStyle::filled;
  const std::string filled = svg(figure);
  EXPECT_EQ(bands(filled), 1U);
  expect_well_formed(filled);
}

// A motion that swings fast for a third of the time only is a band there and a line elsewhere.
TEST(Svg, OnlyTheFastPartIsABand) {
  std::vector<double> y;
  for (int i = 0; i < 9000; ++i) y.push_back(std::sin(2 * std::numbers::pi * i / (i > 3000 && i < 6000 ? 12 : 600)));
  const std::string picture = svg(figure_of(std::move(y)));
  EXPECT_EQ(bands(picture), 1U);
  EXPECT_EQ(pieces(picture), 3U);
}

// Windows are a band's columns: with points that are close together in each, however far apart windows are.
TEST(Svg, WindowsAreTheColumnsOfABand) {
  constexpr int kWindows = 100, kEach = 13;
  Line line{"line", {}, {}};
  for (int w = 0; w < kWindows; ++w)
    for (int k = 0; k < kEach; ++k) {
      line.x.push_back(1000.0 * w + k);
      line.y.push_back((1 + 0.01 * w) * std::sin(2 * std::numbers::pi * k / 12));
    }
  line.a_column = kEach;
  const Figure figure{"title", "", {"Time", "s"}, {{{"y", "m"}, {line}}}};
  const std::string picture = svg(figure);
  EXPECT_EQ(bands(picture), 1U);
  const std::size_t end = picture.find("Z\" class=\"et-band\""), begin = picture.rfind("d=\"M", end);
  EXPECT_EQ(count(picture.substr(begin, end - begin), "L") + 1, 4U) << "edges as straight as the growth of the swings";
}

/// Where a text of a picture stands: x of its anchor and y of its baseline (px); NaN where it is not.
std::pair<double, double> place_of_text(const std::string& picture, const std::string& text) {
  const std::size_t end = picture.find(">" + text + "</text>");
  if (end == picture.npos) return {kNan, kNan};
  const std::size_t begin = picture.rfind("<text x=\"", end);
  double x = 0, y = 0;
  EXPECT_EQ(std::sscanf(picture.c_str() + begin, "<text x=\"%lf\" y=\"%lf\"", &x, &y), 2);
  return {x, y};
}

bool has_legend(const std::string& picture) { return picture.find("h22") != picture.npos; }

/// Two lines with labels, the one at 1 and the other at a height.
Figure two_lines(double height) {
  Figure figure = figure_of({1, 1, 1});
  figure.panels[0].lines[0].label = "lower";
  figure.panels[0].lines.push_back({"higher", {0, 1, 2}, {height, height, height}});
  figure.panels[0].labels_at_lines = true;
  return figure;
}

// Labels stand beside their lines, each nearer to its own; where there is no room between the lines, in a legend.
TEST(Svg, LabelsStandAtTheirLines) {
  const Figure apart = two_lines(2), touching = two_lines(1.01);
  for (const PlotWidth width : {PlotWidth::wide, PlotWidth::narrow}) {
    const std::string picture = svg(apart, width);
    EXPECT_FALSE(has_legend(picture));
    const PlotFrame frame = frame_of(apart, width);
    const auto y_of = [&](double y) {
      return frame.floor + (y - frame.y_low) / (frame.y_high - frame.y_low) * (frame.top - frame.floor);
    };
    constexpr double kHigh = 10, kGap = 20;  // px: of a letter, and the farthest that a text may stand from its line
    for (const auto& [label, y] : std::vector<std::pair<std::string, double>>{{"lower", 1}, {"higher", 2}}) {
      const auto [x, baseline] = place_of_text(picture, label);
      EXPECT_TRUE(x > frame.left && x <= frame.right) << label;
      EXPECT_TRUE(baseline < y_of(y) || baseline - kHigh > y_of(y)) << label << " lies on its line";
      EXPECT_LT(std::abs(baseline - y_of(y)), kGap) << label;
    }
  }
  Figure crowded = touching;
  for (int i = 0; i < 12; ++i) crowded.panels[0].lines.push_back({"line", {0, 1, 2}, {1 + 0.1 * i, 1 + 0.1 * i, 1 + 0.1 * i}});
  EXPECT_TRUE(has_legend(svg(crowded)));
  Figure plain = apart;
  plain.panels[0].labels_at_lines = false;
  EXPECT_TRUE(has_legend(svg(plain)));
}

// A line that swings too fast is a band; without a legend the caption says so.
TEST(Svg, ACaptionNamesTheBandWhereThereIsNoLegend) {
  Figure figure = swings(500);
  figure.panels[0].labels_at_lines = true;
  figure.panels[0].lines[0].label = "";
  figure.panels[0].y.label = "Angle";
  EXPECT_NE(svg(figure).find(">Angle (m; band: least to most)<"), std::string::npos);
  figure = swings(5);
  figure.panels[0].labels_at_lines = true;
  EXPECT_EQ(svg(figure).find("least to most"), std::string::npos);
}

// The end of a line is marked by a dot and a text, which stands within the picture and not on the line, whether that rises, falls or is
// level, and even at the panel's upper edge.
TEST(Svg, TheEndOfALineIsMarked) {
  for (const double end : {0.0, 0.5, 1.0}) {
    Figure figure = figure_of({0.5, 1, 0, 0.5 + 0.8 * (end - 0.5), end});
    figure.panels[0].lines[0].end_label = "the end";
    for (const PlotWidth width : {PlotWidth::wide, PlotWidth::narrow}) {
      const std::string picture = svg(figure, width);
      const PlotFrame frame = frame_of(figure, width);
      const auto y_of = [&](double y) {
        return frame.floor + (y - frame.y_low) / (frame.y_high - frame.y_low) * (frame.top - frame.floor);
      };
      const std::size_t dot = picture.find("<circle cx=\"");
      ASSERT_NE(dot, picture.npos);
      double cx = 0, cy = 0;
      ASSERT_EQ(std::sscanf(picture.c_str() + dot, "<circle cx=\"%lf\" cy=\"%lf\"", &cx, &cy), 2);
      constexpr double kRounding = 0.011;  // px: two decimals
      EXPECT_NEAR(cx, frame.right, kRounding);
      EXPECT_NEAR(cy, y_of(end), kRounding);
      const auto [x, baseline] = place_of_text(picture, "the end");
      EXPECT_TRUE(x <= frame.right + 5 && baseline > frame.top && baseline <= frame.floor) << baseline;
      EXPECT_TRUE(baseline < cy || baseline - 10 > cy) << "the text lies on the dot";
      EXPECT_LT(std::abs(baseline - cy), 70) << "the text is far from the dot";
    }
  }
}

// A sine's largest value lies between its twelve points a period.
TEST(Turns, OfASineAreWhereItTurns) {
  std::vector<double> x, y;
  for (int i = 0; i < 120; ++i) x.push_back(i), y.push_back(std::sin(2 * std::numbers::pi * (i + 0.37) / 12));
  move_to_turns(x, y);
  // The polynomial of nine points errs by 3e-7 of the sine at most.
  constexpr double kTruncation = 1e-6;
  std::size_t turns = 0;
  for (std::size_t i = 8; i + 8 < x.size(); ++i) {
    if (std::abs(y[i]) < 0.97) continue;
    const double phase = 2 * std::numbers::pi * (x[i] + 0.37) / 12;
    EXPECT_NEAR(y[i], std::sin(phase), kTruncation);
    if (x[i] == static_cast<double>(i)) continue;
    ++turns;
    EXPECT_NEAR(std::abs(y[i]), 1, kTruncation);
  }
  EXPECT_EQ(turns, 18U);
}

// The length of a vector that passes near zero is least where no sample is, with a corner that no polynomial through lengths follows.
TEST(Turns, OfALengthComeFromItsVector) {
  constexpr double kNearest = 0.002, kTruncation = 1e-6;
  std::vector<double> x, y;
  std::array<std::vector<double>, 2> parts;
  for (int i = 0; i < 60; ++i) {
    x.push_back(i);
    parts[0].push_back(std::sin(2 * std::numbers::pi * (i + 0.4) / 12));
    parts[1].push_back(kNearest);
    y.push_back(std::hypot(parts[0].back(), kNearest));
  }
  move_to_turns(x, y, parts);
  for (std::size_t i = 5; i < 55; i += 6) EXPECT_NEAR(std::min(y[i], y[i + 1]), kNearest, kTruncation) << i;
}

// Where the steps are not equal, and at the ends, nothing is known between the points.
TEST(Turns, OfFewOrUnevenPointsAreThePoints) {
  std::vector<double> x{0, 1, 2, 4, 8, 16, 32, 64, 128, 256}, y{0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
  const std::vector<double> before = y;
  move_to_turns(x, y);
  EXPECT_EQ(y, before);
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
  // All at one end of what a double holds: an axis of no length would have no place for them.
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic})
    for (const double end : {1e308, 5e307, 5e-324}) {
      Figure figure = figure_of({end, end}, scale);
      figure.x.scale = scale;
      figure.panels[0].lines[0].x = {end, end};
      const std::string picture = svg(figure);
      expect_well_formed(picture);
      EXPECT_EQ(picture.find("nan"), picture.npos);
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
