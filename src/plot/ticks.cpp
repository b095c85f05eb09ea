// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/ticks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "earthtop/elementary.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

std::string with_minus_sign(std::string number) {
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

/// The decimal exponent of a value; for 0 and infinite values -330, below that of every double.
int decade_of(double value) {
  const double decade = std::floor(real::log10(value));
  return std::isfinite(decade) ? static_cast<int>(decade) : -330;
}

/// mantissa x 10^exponent, correctly rounded like a literal.
double decimal(double mantissa, int exponent) {
  return exponent < 0 && exponent > -300 ? mantissa / real::power_of_ten(-exponent) : mantissa * real::power_of_ten(exponent);
}

struct Step {
  int mantissa = 1;  ///< 1, 2 or 5
  int exponent = 0;
  double value() const { return decimal(mantissa, exponent); }
};

Step nice_step(double span, int wanted) {
  const double rough = span / wanted;
  Step step{1, decade_of(rough)};
  const double ratio = rough / step.value();
  if (ratio > 7.07) return {1, step.exponent + 1};
  if (ratio > 3.16) return {5, step.exponent};
  if (ratio > 1.41) return {2, step.exponent};
  return step;
}

}  // namespace

Ticks linear_ticks(double low, double high, int wanted, bool tight) {
  double span = high - low;
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(span > size * 1e-14) || !(span > 1e-290)) {  // a constant: leave room above and below
    const double room = size > 1e-280 ? size * 0.5 : 0.5;
    low -= room;
    high += room;
    span = high - low;
    tight = false;
  }
  const Step step = nice_step(span, wanted);
  const double h = step.value();
  const double slack = 1e-9 + 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high)) / h;
  const double first = tight ? std::ceil(low / h - slack) : std::floor(low / h + slack);
  const double last = tight ? std::floor(high / h + slack) : std::ceil(high / h - slack);

  Ticks axis;
  axis.low = tight ? low : first * h;
  axis.high = tight ? high : last * h;
  const double largest = std::max(std::abs(first), std::abs(last)) * h;
  // Leading digits that all ticks share become an offset if they are many, and large or small powers a factor; otherwise the
  // labels are plain numbers.
  const double base = largest / h > 5e4 ? first : 0;
  const double written = base != 0 ? (last - first) * h : largest;
  int factor = decade_of(written);
  factor = factor >= 5 || factor <= -3 ? 3 * static_cast<int>(std::floor(factor / 3.0)) : 0;
  const int decimals = std::max(0, factor - step.exponent);
  if (factor != 0) axis.factor = "×10" + raised(factor);
  if (base != 0) {
    const int digits = std::clamp(-step.exponent, 0, 300);
    axis.offset = (base < 0 ? "− " : "+ ") + fmt::format("{:.{}f}", std::abs(base * h), digits);
  }
  for (double k = first; k <= last; ++k) {
    const double shown = decimal((k - base) * step.mantissa, step.exponent - factor);
    axis.ticks.push_back({k * h, with_minus_sign(fmt::format("{:.{}f}", shown == 0 ? 0.0 : shown, decimals))});
  }
  return axis;
}

Ticks logarithmic_ticks(double low, double high, int wanted) {
  int first = decade_of(low * (1 + 1e-12));
  int last = static_cast<int>(std::ceil(real::log10(high * (1 - 1e-12))));
  if (last <= first) last = first + 1;
  first = std::max(first, -307);
  last = std::min(last, 308);
  Ticks axis;
  axis.low = real::power_of_ten(first);
  axis.high = real::power_of_ten(last);
  const int decades = last - first;
  int stride = 1;
  for (const int candidate : {1, 2, 3, 5, 10, 20, 50, 100}) {
    stride = candidate;
    if (decades / stride <= wanted) break;
  }
  for (int exponent = first; exponent <= last; ++exponent) {
    const bool labelled = exponent % stride == 0;
    axis.ticks.push_back({real::power_of_ten(exponent), labelled ? "10" + raised(exponent) : ""});
    if (decades > 3 || exponent == last) continue;
    for (const int mantissa : {2, 5}) axis.ticks.push_back({mantissa * real::power_of_ten(exponent), ""});
  }
  return axis;
}

}  // namespace earthtop
