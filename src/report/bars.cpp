// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/bars.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/elementary.hpp"
#include "plot/strokes.hpp"
#include "plot/svg_text.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

/// The measures of the picture (px). In the narrow one a bar has its label above it.
struct BarLayout {
  double width, bars_left, bars_right, step;
  bool label_above;
  int most_decades;  ///< labelled
  const char* suffix;
};
constexpr BarLayout kWideBars{860, 230, 790, 28, false, 9, ""}, kNarrowBars{340, 14, 262, 42, true, 4, "-narrow"};
constexpr double kBarTop = 62;
constexpr std::size_t kLabelCharacters = 46;  // of the narrow picture

std::string power(int exponent) { return exponent == 0 ? "1" : with_powers(fmt::format("1e{:+03}", exponent)); }

std::string drawn_bars(const BarLayout& layout, const std::string& name, const std::string& title, const std::string& unit,
                       const std::vector<Bar>& bars) {
  double low = 0, high = 0;
  for (const Bar& bar : bars) {
    const double decade = real::log10(bar.value);
    low = bars.data() == &bar ? decade : std::min(low, decade);
    high = bars.data() == &bar ? decade : std::max(high, decade);
  }
  low = std::floor(low - 0.3);
  high = std::max(std::ceil(high), low + 1);
  const double bottom = kBarTop + layout.step * static_cast<double>(bars.size()), height = bottom + 52;
  const auto x = [&](double decade) {
    return layout.bars_left + (decade - low) / (high - low) * (layout.bars_right - layout.bars_left);
  };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\">\n"
      "<title>{2}</title>\n<defs><pattern id=\"{3}-hatch\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><path d=\"M0 0V7\" stroke=\"{5}\" stroke-width=\"3\"/></pattern></defs>\n"
      "<rect class=\"et-page\" width=\"{0}\" height=\"{1}\"/>\n<text x=\"{4}\" y=\"30\" class=\"et-h\">{2}</text>\n",
      layout.width, height, escape_xml(title), name, layout.label_above ? layout.bars_left : 24, hex(LineColor::vermillion));
  const int decades = static_cast<int>(high - low);
  const int stride = (decades + layout.most_decades - 1) / layout.most_decades;
  for (int decade = static_cast<int>(low); decade <= static_cast<int>(high); decade += stride)
    out += fmt::format(
        "<path class=\"et-grid\" d=\"M{0:.2f} {1}V{2}\"/><text x=\"{0:.2f}\" y=\"{3}\" text-anchor=\"{5}\">{4}</text>\n",
        x(decade), kBarTop - 8, bottom, bottom + 18, power(decade),
        layout.label_above && decade == static_cast<int>(low) ? "start" : "middle");
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const Bar& bar = bars[i];
    const double row = kBarTop + layout.step * static_cast<double>(i), top = layout.label_above ? row + 16 : row;
    const double width = std::max(2.0, x(real::log10(bar.value)) - layout.bars_left);
    const std::string fill = bar.left_out ? fmt::format("url(#{}-hatch)", name) : std::string(hex(LineColor::blue));
    out += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\">{}</text><rect x=\"{}\" y=\"{:.2f}\" width=\"{:.2f}\" "
        "height=\"16\" "
        "fill=\"{}\" stroke=\"{}\"/><text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
        layout.label_above ? layout.bars_left : layout.bars_left - 8, row + (layout.label_above ? 11 : 13),
        layout.label_above ? "start" : "end", escape_xml(layout.label_above ? shorten(bar.label, kLabelCharacters) : bar.label),
        layout.bars_left, top, width, fill, hex(bar.left_out ? LineColor::vermillion : LineColor::blue),
        layout.bars_left + width + 6, top + 13, with_powers(fmt::format("{:.2g}", bar.value)));
  }
  return out + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" class=\"et-b\">{}</text>\n</svg>\n",
                           (layout.bars_left + layout.bars_right) / 2, bottom + 42, escape_xml(unit));
}

}  // namespace

Drawings bars_svg(const std::string& name, const std::string& title, const std::string& unit, const std::vector<Bar>& bars) {
  return {drawn_bars(kWideBars, name, title, unit, bars),
          drawn_bars(kNarrowBars, name + kNarrowBars.suffix, title, unit, bars)};
}

}  // namespace earthtop::report
