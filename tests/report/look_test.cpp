// SPDX-License-Identifier: GPL-3.0-or-later
// The table of colours and sizes against the pages' style sheet, its own description, and what can be read.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "plot/palette.hpp"
#include "plot/strokes.hpp"

namespace earthtop {
namespace {

std::string source(const char* file) {
  std::ifstream in(std::string(EARTHTOP_TESTS) + "/../" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Contrast by WCAG 2: (L1 + 0.05)/(L2 + 0.05) of the relative luminances.
double luminance(std::string_view hex) {
  const double weights[] = {0.2126, 0.7152, 0.0722};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = static_cast<double>(std::strtol(std::string(hex.substr(1 + 2 * i, 2)).c_str(), nullptr, 16)) / 255;
    sum += weights[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}
double contrast(std::string_view a, std::string_view b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

std::vector<Ink> all_inks() {
  std::vector<Ink> inks = {kHeading, kText, kMuted, kGrid, kMinor};
  for (const CurveInk& curve : kCurveInks) inks.push_back(curve.ink);
  return inks;
}

/// The value that a part of a style sheet gives to a custom property; empty where it gives none.
std::string property(const std::string& rules, std::string_view name) {
  const std::string key = fmt::format("--{}: ", name);
  const std::size_t at = rules.find(key);
  return at == rules.npos ? "" : rules.substr(at + key.size(), rules.find(';', at) - at - key.size());
}

TEST(Look, CurvesAndTextCanBeSeen) {
  for (const CurveInk& curve : kCurveInks) EXPECT_GE(contrast(curve.ink.dark, kPage.dark), 4.5) << curve.ink.name;
  for (const Ink& ink : {kHeading, kText, kMuted}) {
    EXPECT_GE(contrast(ink.light, kPage.light), 4.5) << ink.name;
    EXPECT_GE(contrast(ink.dark, kPage.dark), 4.5) << ink.name;
  }
}

TEST(Look, ThePagesHaveTheColoursOfThePictures) {
  const std::string css = source("src/report/assets/page.css");
  const std::size_t dark = css.find("prefers-color-scheme: dark");
  ASSERT_NE(dark, css.npos);
  const std::string light_rules = css.substr(0, dark), dark_rules = css.substr(dark, css.find("prefers-contrast", dark) - dark);
  std::vector<Ink> inks = all_inks();
  inks.push_back(kPage);
  for (const Ink& ink : inks) {
    EXPECT_EQ(property(light_rules, ink.name), ink.light) << ink.name;
    if (ink.dark != ink.light) EXPECT_EQ(property(dark_rules, ink.name), ink.dark) << ink.name;
  }
  for (const CurveInk& curve : kCurveInks)
    for (const char* what : {"stroke", "fill"})
      EXPECT_NE(css.find(fmt::format(".et [{0}=\"{1}\"] {{ {0}: var(--{2}); }}", what, curve.ink.light, curve.ink.name)),
                css.npos)
          << curve.ink.name;
  EXPECT_NE(css.find(fmt::format(".et {{ font-size: {}px; }}", kLabelSize)), css.npos);
  EXPECT_NE(css.find(fmt::format("font-size: {}px; font-weight: 600; }}\n.et .et-b", kTitleSize)), css.npos);
  EXPECT_NE(css.find(fmt::format(".et .et-b {{ fill: var(--fg); font-size: {}px;", kCaptionSize)), css.npos);
}

/// A picture by itself changes each of its colours in the dark.
TEST(Look, APictureByItselfIsReadableInTheDark) {
  Figure figure{"t", "", {"x", ""}, {}};
  figure.panels.push_back({{"y", ""}, {{"a", {0, 1}, {0, 1}, LineColor::blue}}});
  const std::string picture = svg(figure);
  const std::size_t dark = picture.find("prefers-color-scheme:dark");
  ASSERT_NE(dark, picture.npos);
  for (const CurveInk& curve : kCurveInks)
    if (curve.ink.dark != curve.ink.light)
      EXPECT_NE(picture.find(fmt::format("[stroke=\"{}\"]{{stroke:{}}}", curve.ink.light, curve.ink.dark), dark), picture.npos)
          << curve.ink.name;
}

TEST(Look, PythonHasTheColoursOfThePictures) {
  const std::string look = source("tools/python/earthtop/_look.py");
  std::string curves;
  for (const CurveInk& curve : kCurveInks) curves += fmt::format("{}\"{}\"", curves.empty() ? "" : ", ", curve.ink.light);
  EXPECT_NE(look.find("CURVES = (" + curves + ")"), look.npos);
  EXPECT_NE(look.find(fmt::format("MUTED = \"{}\"", kMuted.light)), look.npos);
  EXPECT_NE(look.find(fmt::format("BAND_OPACITY = {}\n", kBandOpacity)), look.npos);
}

TEST(Look, TheDescriptionHasTheTablesNumbers) {
  const std::string text = source("src/plot/README.md");
  for (const Ink& ink : all_inks())
    EXPECT_NE(text.find(fmt::format("| `{}` | `{}` | {:.1f} | `{}` | {:.1f} |", ink.name, ink.light,
                                    contrast(ink.light, kPage.light), ink.dark, contrast(ink.dark, kPage.dark))),
              text.npos)
        << ink.name;
  EXPECT_NE(text.find(fmt::format("Labels of pictures are {} px, captions of panels {} px, titles {} px", kLabelSize,
                                  kCaptionSize, kTitleSize)),
            text.npos);
}

}  // namespace
}  // namespace earthtop
