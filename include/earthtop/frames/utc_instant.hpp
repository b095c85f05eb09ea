// SPDX-License-Identifier: GPL-3.0-or-later
/// An instant of civil time, for what depends on where the Moon and the Sun stand.
#pragma once

#include <optional>
#include <string_view>

namespace earthtop {

/// UTC as a quasi Julian date in two parts, day + fraction, as ERFA takes it: a day with a leap second is as long as any other.
struct UtcInstant {
  double day = 0;
  double fraction = 0;
};

/// The year, with its fraction, counted in Julian years from J2000: 2000 + (JD - 2451545) / 365.25.
constexpr double julian_epoch_year(const UtcInstant& utc) { return 2000 + ((utc.day - 2451545) + utc.fraction) / 365.25; }

/// Reads ISO 8601 "YYYY-MM-DDThh:mm:ss[.fff]Z" with any number of decimals: UTC only, nothing before or after it, a date of the
/// calendar, second 60 only where a leap second was. Nothing if it is anything else.
std::optional<UtcInstant> parse_utc(std::string_view text);

}  // namespace earthtop
