// SPDX-License-Identifier: GPL-3.0-or-later
/// An instant of civil time, needed where something depends on the positions of the Moon and the Sun.
#pragma once

#include <optional>
#include <string_view>

namespace earthtop {

/// UTC as a quasi Julian date in two parts, day + fraction, as ERFA uses it: a day with a leap second also has length 1.
struct UtcInstant {
  double day = 0;
  double fraction = 0;
};

/// The year with its fraction, counted in Julian years from J2000: 2000 + (JD - 2451545) / 365.25.
constexpr double julian_epoch_year(const UtcInstant& utc) { return 2000 + ((utc.day - 2451545) + utc.fraction) / 365.25; }

/// Reads ISO 8601 "YYYY-MM-DDThh:mm:ss[.fff]Z" with any number of decimals. Returns nothing unless the whole text has this
/// form, is in UTC (Z), names a date of the calendar, and has second 60 only where a leap second was.
std::optional<UtcInstant> parse_utc(std::string_view text);

}  // namespace earthtop
