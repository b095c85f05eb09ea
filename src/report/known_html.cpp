// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/known_html.hpp"

#include <fmt/core.h>

#include <cmath>

#include "report/html.hpp"

namespace earthtop::report {
namespace {

std::string data_html(double exact, const std::string& shown) {
  return fmt::format("<data value=\"{}\">{}</data>", exact, powers_html(shown));
}

}  // namespace

std::string powers_html(std::string_view text) {
  const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  std::string html;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool exponent = i > 0 && is_digit(i - 1) && text[i] == 'e' && i + 1 < text.size() &&
                          (text[i + 1] == '-' || text[i + 1] == '+') && is_digit(i + 2);
    if (!exponent) {
      html += text[i];
      continue;
    }
    html += text[i + 1] == '-' ? "×10<sup>−" : "×10<sup>";
    for (i += 2; text[i] == '0' && is_digit(i + 1);) ++i;
    for (; is_digit(i); ++i) html += text[i];
    html += "</sup>";
    --i;
  }
  return html;
}

std::string known_html(double si, double error_si, const ReadableUnit& unit, bool strong) {
  const bool known = std::isfinite(error_si) && std::isfinite(si);
  const KnownNumber number = known_number(si * unit.per_si, known ? error_si * unit.per_si : 0);
  const std::string symbol = escaped(unit.symbol);
  const std::string value = data_html(si, number.value) + symbol;
  return (strong ? "<strong>" + value + "</strong>" : value) +
         (known ? " ± " + data_html(error_si, number.error) + symbol : std::string());
}

std::string known_html(double value, double error, std::string_view unit) {
  const std::string symbol = " " + std::string(unit);
  return known_html(value, error, ReadableUnit{unit, symbol, 1});
}

std::string known_angle_html(double rad, double error_rad, bool strong) {
  return known_html(rad, error_rad, angle_unit(rad), strong);
}

std::string error_html(double si, double error_si, const ReadableUnit& unit) {
  return data_html(error_si, known_number(si * unit.per_si, error_si * unit.per_si).error) + escaped(unit.symbol);
}

}  // namespace earthtop::report
