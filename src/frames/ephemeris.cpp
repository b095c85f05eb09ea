// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames/ephemeris.hpp"

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <charconv>

namespace earthtop {

std::optional<UtcInstant> parse_utc(std::string_view text) {
  constexpr std::string_view kForm = "dddd-dd-ddTdd:dd:dd";  // d: a digit
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.size() <= kForm.size() || text.back() != 'Z') return std::nullopt;
  for (std::size_t i = 0; i < kForm.size(); ++i)
    if (kForm[i] == 'd' ? !is_digit(text[i]) : text[i] != kForm[i]) return std::nullopt;
  const std::string_view decimals = text.substr(kForm.size(), text.size() - kForm.size() - 1);
  if (!decimals.empty() &&
      (decimals.size() < 2 || decimals[0] != '.' || !std::all_of(decimals.begin() + 1, decimals.end(), is_digit)))
    return std::nullopt;

  const auto whole = [&](std::size_t begin, std::size_t size) {
    int value = 0;
    std::from_chars(text.data() + begin, text.data() + begin + size, value);
    return value;
  };
  double seconds = 0;
  std::from_chars(text.data() + 17, text.data() + text.size() - 1, seconds);
  UtcInstant utc;
  const int verdict =
      eraDtf2d("UTC", whole(0, 4), whole(5, 2), whole(8, 2), whole(11, 2), whole(14, 2), seconds, &utc.day, &utc.fraction);
  // ERFA's code 1 marks a year before UTC existed, or one whose leap seconds ERFA cannot know; the date itself is valid.
  if (verdict != 0 && verdict != 1) return std::nullopt;
  return utc;
}

TerrestrialTime terrestrial_time(const UtcInstant& utc, double seconds_later) {
  double tai_day = 0, tai_fraction = 0;
  TerrestrialTime tt;
  eraUtctai(utc.day, utc.fraction, &tai_day, &tai_fraction);
  eraTaitt(tai_day, tai_fraction, &tt.day, &tt.fraction);
  tt.fraction += seconds_later / ERFA_DAYSEC;
  return tt;
}

Vec3<double> moon_position_I(const TerrestrialTime& tt) {
  double moon[2][3];
  eraMoon98(tt.day, tt.fraction, moon);
  return ERFA_DAU * Vec3<double>(moon[0][0], moon[0][1], moon[0][2]);
}

Vec3<double> sun_position_I(const TerrestrialTime& tt) {
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(tt.day, tt.fraction, heliocentric, barycentric);
  return -ERFA_DAU * Vec3<double>(heliocentric[0][0], heliocentric[0][1], heliocentric[0][2]);
}

Vec3<double> mean_axis_I(const TerrestrialTime& tt) {
  double R[3][3];
  eraPmat06(tt.day, tt.fraction, R);
  return {R[2][0], R[2][1], R[2][2]};
}

Mat3<double> celestial_to_terrestrial(const UtcInstant& utc, double seconds_later) {
  const TerrestrialTime tt = terrestrial_time(utc, seconds_later);
  double R[3][3];
  eraC2t00b(tt.day, tt.fraction, utc.day, utc.fraction + seconds_later / ERFA_DAYSEC, 0, 0, R);
  Mat3<double> R_EI;
  R_EI << R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2];
  return R_EI;
}

}  // namespace earthtop
