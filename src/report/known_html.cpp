// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/known_html.hpp"

#include <fmt/core.h>

#include <cmath>

#include "report/html.hpp"

namespace earthtop::report {
namespace {

std::string data_html(double exact, const std::string& shown) {
  return fmt::format("<data value=\"{}\">{}</data>", exact, with_powers(shown));
}

}  // namespace

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
