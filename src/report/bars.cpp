// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/bars.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/elementary.hpp"
#include "plot/svg_text.hpp"

namespace earthtop::report {
namespace {

constexpr double kPictureWidth = 860, kLabels = 230, kRight = 790, kBarTop = 62, kStep = 28;  // px

std::string power(int exponent) { return fmt::format("1e{}", exponent); }

}  // namespace

std::string bars_svg(const std::string& name, const std::string& title, const std::string& unit, const std::vector<Bar>& bars) {
  double low = 0, high = 0;
  for (const Bar& bar : bars) {
    const double decade = real::log10(bar.value);
    low = bars.data() == &bar ? decade : std::min(low, decade);
    high = bars.data() == &bar ? decade : std::max(high, decade);
  }
  low = std::floor(low - 0.3);
  high = std::max(std::ceil(high), low + 1);
  const double bottom = kBarTop + kStep * static_cast<double>(bars.size()), height = bottom + 52;
  const auto x = [&](double decade) { return kLabels + (decade - low) / (high - low) * (kRight - kLabels); };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\">\n"
      "<title>{2}</title>\n<defs><pattern id=\"{3}-hatch\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><path d=\"M0 0V7\" stroke=\"#d55e00\" stroke-width=\"3\"/></pattern></defs>\n"
      "<rect class=\"et-page\" width=\"{0}\" height=\"{1}\"/>\n<text x=\"24\" y=\"30\" class=\"et-h\">{2}</text>\n",
      kPictureWidth, height, escape_xml(title), name);
  const int stride = std::max(1, static_cast<int>((high - low) / 9));
  for (int decade = static_cast<int>(low); decade <= static_cast<int>(high); decade += stride)
    out += fmt::format(
        "<path class=\"et-grid\" d=\"M{0:.2f} {1}V{2}\"/><text x=\"{0:.2f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
        x(decade), kBarTop - 8, bottom, bottom + 18, power(decade));
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const Bar& bar = bars[i];
    const double top = kBarTop + kStep * static_cast<double>(i), width = std::max(2.0, x(real::log10(bar.value)) - kLabels);
    const std::string fill = bar.left_out ? fmt::format("url(#{}-hatch)", name) : "#0072b2";
    out += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text><rect x=\"{}\" y=\"{:.2f}\" width=\"{:.2f}\" "
        "height=\"16\" "
        "fill=\"{}\" stroke=\"{}\"/><text x=\"{:.2f}\" y=\"{:.2f}\">{:.2g}</text>\n",
        kLabels - 8, top + 13, escape_xml(bar.label), kLabels, top, width, fill, bar.left_out ? "#d55e00" : "#0072b2",
        kLabels + width + 6, top + 13, bar.value);
  }
  return out + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" class=\"et-b\">{}</text>\n</svg>\n",
                           (kLabels + kRight) / 2, bottom + 42, escape_xml(unit));
}

}  // namespace earthtop::report
