// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "earthtop/elementary.hpp"

namespace earthtop {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi, kArcseconds = 3600 * kDegrees;  // in a radian
constexpr ReadableUnit kAngles[] = {{"degrees", "°", kDegrees},
                                    {"arcseconds", "″", kArcseconds},
                                    {"milliarcseconds", " milliarcsec", 1e3 * kArcseconds},
                                    {"microarcseconds", " microarcsec", 1e6 * kArcseconds}};
constexpr double kLeastAngles[] = {1 / kDegrees, 0.1 / kArcseconds, 1e-4 / kArcseconds};  // of each but the last
constexpr ReadableUnit kLengths[] = {
    {"km", " km", 1e-3}, {"m", " m", 1}, {"mm", " mm", 1e3}, {"µm", " µm", 1e6}, {"nm", " nm", 1e9}};

/// The decade of a positive number as it is written with this many digits: 0.0996 with two digits is 0.10.
int decade_of(double number, int digits) {
  const std::string text = fmt::format("{:.{}e}", number, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// The decimal with this many digits that is nearest to a number, as a double.
double rounded(double number, int digits) { return std::strtod(fmt::format("{:.{}e}", number, digits - 1).c_str(), nullptr); }

/// One unit of the last of the digits that such a decimal has.
double rounded_by(double number, int digits) {
  return std::strtod(fmt::format("1e{}", decade_of(std::abs(number), digits) - (digits - 1)).c_str(), nullptr);
}

}  // namespace

ReadableUnit angle_unit(double size_rad) {
  const double size = std::abs(size_rad);
  if (size == 0 || !std::isfinite(size)) return kAngles[1];
  std::size_t i = 0;
  while (i < std::size(kLeastAngles) && size < kLeastAngles[i]) ++i;
  return kAngles[i];
}

ReadableUnit length_unit(double size_m) {
  constexpr double kAlmost = 0.999;
  const double size = std::abs(size_m);
  if (size == 0 || !std::isfinite(size)) return kLengths[1];
  std::size_t i = 0;
  while (i + 1 < std::size(kLengths) && size * kLengths[i].per_si < kAlmost) ++i;
  return kLengths[i];
}

std::string angle_text(double rad, int digits) {
  const ReadableUnit unit = angle_unit(rad);
  const double number = rad * unit.per_si;
  if (number == 0 || !std::isfinite(number)) return fmt::format("{:g}{}", number, unit.symbol);
  constexpr double kSmall = 1e-4;  // microarcseconds; other units have larger numbers
  if (std::abs(number) < kSmall) return fmt::format("{:.{}e}{}", number, digits - 1, unit.symbol);
  return fmt::format("{:.{}f}{}", number, std::max(0, digits - 1 - decade_of(std::abs(number), digits)), unit.symbol);
}

std::optional<double> share_of(double part, double whole) {
  if (whole == 0 || !std::isfinite(part) || !std::isfinite(whole)) return std::nullopt;
  const double share = part / whole;
  return std::isfinite(share) ? std::optional(share) : std::nullopt;
}

std::pair<std::string, std::string> told_apart(double one, double other, int digits, char style) {
  constexpr int kMostDigits = 17;  // those that tell any two doubles apart
  const auto text = [&](double x) {
    return style == 'e' ? fmt::format("{:.{}e}", x, digits - 1) : fmt::format("{:.{}g}", x, digits);
  };
  while (digits < kMostDigits && one != other && text(one) == text(other)) ++digits;
  return {text(one), text(other)};
}

std::string least_text(double least, int digits) {
  if (!std::isfinite(least) || least == 0) return fmt::format("{:g}", least);
  double shown = rounded(least, digits);
  if (shown < least) shown = rounded(least + rounded_by(least, digits), digits);
  return fmt::format("{:.{}g}", shown, digits);
}

std::string most_text(double most, int digits) {
  const std::string text = least_text(-most, digits);
  return text.front() == '-' ? text.substr(1) : "-" + text;
}

double rounding_of_step(double from, double to, bool logarithmic, double value) {
  // Of from + x (to - from): one rounding each of x, the difference, the product and the sum; of from exp(x ln(to/from)): the
  // exponent's rounding errors grow with its size.
  constexpr double kRoundings = 4;
  const double size =
      logarithmic ? std::abs(value) * (1 + std::abs(real::log(to / from))) : std::max(std::abs(from), std::abs(to));
  return kRoundings * std::numeric_limits<double>::epsilon() / 2 * size;
}

double meant_number(double value, double error) {
  if (!std::isfinite(value) || !(error > 0)) return value;
  constexpr int kAllDigits = 17;
  if (std::abs(value) <= error) return 0;
  for (int digits = 1; digits < kAllDigits; ++digits) {
    const std::string text = fmt::format("{:.{}e}", value, digits - 1);
    double near = value;
    std::from_chars(text.data(), text.data() + text.size(), near);
    if (std::abs(near - value) <= error) return near;
  }
  return value;
}

std::string time_text(double t_s) {
  constexpr int kDigits = 10;  // those of a nanosecond in a run of seconds
  return fmt::format("{:.{}g} s", t_s, kDigits);
}

KnownNumber known_number(double value, double error, int digits) {
  constexpr int kErrorDigits = 2, kMostDigits = 16, kPlain = 7, kLarge = 15;
  if (!(error > 0)) return {fmt::format("{:.{}g}", value, digits), "0"};
  const int last = decade_of(error, kErrorDigits) - (kErrorDigits - 1);  // decade of the last digit
  const int first = value == 0 ? last : decade_of(std::abs(value), kMostDigits);
  const int decimals = std::max(0, -std::max(last, first - (kMostDigits - 1)));
  // A number far from 1 has an exponent, and its error the same one.
  if (std::max(first, last) < -4 || std::max(first, last) > kLarge) {
    const int shown = std::clamp(first - last, 1, kMostDigits - 1);
    const std::string text = value == 0 ? "0" : fmt::format("{:.{}e}", value, shown);
    return {text, fmt::format("{:.{}e}", error, kErrorDigits - 1)};
  }
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_of("123456789") == text.npos) text.erase(0, 1);  // 0, to within its error
  return {std::move(text),
          -last > kPlain ? fmt::format("{:.{}e}", error, kErrorDigits - 1) : fmt::format("{:.{}f}", error, std::max(0, -last))};
}

std::string raised(int exponent) {
  constexpr std::string_view kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : fmt::format("{}", exponent)) text += c == '-' ? std::string_view("⁻") : kRaised[c - '0'];
  return text;
}

std::string with_powers(std::string_view text) {
  const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  const auto is_of_word = [&](std::size_t i) {
    return is_digit(i) || text[i] == '.' || text[i] == '_' || std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string written;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_exponent = i > 0 && is_digit(i - 1) && text[i] == 'e' && i + 1 < text.size() &&
                             (text[i + 1] == '-' || text[i + 1] == '+') && is_digit(i + 2);
    if (!is_exponent) {
      written += text[i];
      continue;
    }
    const bool is_power_alone = text[i - 1] == '1' && (i == 1 || !is_of_word(i - 2));
    if (is_power_alone) written.pop_back();
    written += is_power_alone ? "10" : " × 10";
    const int sign = text[i + 1] == '-' ? -1 : 1;
    int exponent = 0;
    constexpr int kMost = 10'000;  // more digits than any number has
    for (i += 2; is_digit(i); ++i) exponent = std::min(kMost, 10 * exponent + (text[i] - '0'));
    written += raised(sign * exponent);
    --i;
  }
  return written;
}

}  // namespace earthtop
