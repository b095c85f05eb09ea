// SPDX-License-Identifier: GPL-3.0-or-later
/// What lies between a motion and the numbers that are written down: the mount of a camera, the zero and the sense of a scale, a
/// clock. No motion depends on it; comparisons with measurements and plans of them do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace earthtop {

/// The numbers of an instrument, in the order of their table.
enum class InstrumentInput : std::uint8_t {
  turn_east,
  turn_north,
  turn_up,
  azimuth_zero,
  azimuth_sense,
  tilt_zero,
  tilt_sense,
  outer_angle_zero,
  outer_angle_sense,
  inner_angle_zero,
  inner_angle_sense,
  rotor_rate_bias,
  rotor_rate_scale,
  time_offset,
  clock_rate
};
inline constexpr std::size_t kInstrumentInputs = 15;

struct InstrumentRow {
  InstrumentInput input;
  std::string_view pointer;         ///< of the number
  std::string_view standard_error;  ///< pointer of the standard error with which it is known beforehand; empty for a sense
  std::string_view unit;
  double least, most;         ///< range
  std::string_view fallback;  ///< its value if it is left out, as a text
  double scale;               ///< a size that is not unusual, in the unit: a fit looks for it within a third of this
  std::string_view doc;

  static constexpr std::string_view key_of(std::string_view pointer) { return pointer.substr(pointer.rfind('/') + 1); }
  constexpr std::string_view key() const { return key_of(pointer); }
  constexpr bool is_sense() const { return standard_error.empty(); }
};

inline constexpr std::array<InstrumentRow, kInstrumentInputs> kInstrument = {
    InstrumentRow{InstrumentInput::turn_east, "/instrument/turn_east_deg", "/instrument/turn_east_se_deg", "deg", -30, 30, "0",
                  10, "small turn about East by which the mount shows the top turned"},
    {InstrumentInput::turn_north, "/instrument/turn_north_deg", "/instrument/turn_north_se_deg", "deg", -30, 30, "0", 10,
     "the same about North"},
    {InstrumentInput::turn_up, "/instrument/turn_up_deg", "/instrument/turn_up_se_deg", "deg", -30, 30, "0", 10,
     "the same about Up"},
    {InstrumentInput::azimuth_zero, "/instrument/azimuth_zero_deg", "/instrument/azimuth_zero_se_deg", "deg", -360, 360, "0",
     60, "reading of the circle at azimuth 0, North"},
    {InstrumentInput::azimuth_sense, "/instrument/azimuth_sense", "", "", -1, 1, "1", 1,
     "1 if readings of the circle grow clockwise, seen from above, else -1"},
    {InstrumentInput::tilt_zero, "/instrument/tilt_zero_deg", "/instrument/tilt_zero_se_deg", "deg", -360, 360, "0", 60,
     "reading at tilt 0, upright"},
    {InstrumentInput::tilt_sense, "/instrument/tilt_sense", "", "", -1, 1, "1", 1,
     "1 if readings grow with the tilt, -1 if they fall; an elevation has -1, and 90 at tilt 0"},
    {InstrumentInput::outer_angle_zero, "/instrument/outer_angle_zero_deg", "/instrument/outer_angle_zero_se_deg", "deg", -360,
     360, "0", 60, "reading at outer angle 0"},
    {InstrumentInput::outer_angle_sense, "/instrument/outer_angle_sense", "", "", -1, 1, "1", 1,
     "1 if readings grow with the outer angle, else -1"},
    {InstrumentInput::inner_angle_zero, "/instrument/inner_angle_zero_deg", "/instrument/inner_angle_zero_se_deg", "deg", -360,
     360, "0", 60, "reading at inner angle 0"},
    {InstrumentInput::inner_angle_sense, "/instrument/inner_angle_sense", "", "", -1, 1, "1", 1,
     "1 if readings grow with the inner angle, else -1"},
    {InstrumentInput::rotor_rate_bias, "/instrument/rotor_rate_bias_rad_s", "/instrument/rotor_rate_bias_se_rad_s", "rad/s",
     -1e6, 1e6, "0", 1, "reading of a tachometer at rest"},
    {InstrumentInput::rotor_rate_scale, "/instrument/rotor_rate_scale", "/instrument/rotor_rate_scale_se", "", -1e3, 1e3, "1",
     0.1, "what a tachometer adds to that for a rad/s of the rotor"},
    {InstrumentInput::time_offset, "/instrument/time_offset_s", "/instrument/time_offset_se_s", "s", -1e9, 1e9, "0", 0.1,
     "reading of the clock at the release; before it, the top is held as it is released"},
    {InstrumentInput::clock_rate, "/instrument/clock_rate", "/instrument/clock_rate_se", "", 1e-3, 1e3, "1", 0.01,
     "seconds that the clock counts in a second"},
};

/// The numbers of an instrument, and the standard errors with which they are known beforehand.
struct Instrument {
  std::array<double, kInstrumentInputs> value{0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};  ///< each in the unit of its row
  std::array<double, kInstrumentInputs> standard_error{};                                    ///< 0: not stated

  bool operator==(const Instrument&) const = default;

  double operator[](InstrumentInput input) const { return value[static_cast<std::size_t>(input)]; }

  /// The time since the release at which the clock shows t_s.
  double time_of_motion_s(double t_s) const {
    return (t_s - (*this)[InstrumentInput::time_offset]) / (*this)[InstrumentInput::clock_rate];
  }
};

}  // namespace earthtop
