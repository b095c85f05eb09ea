// SPDX-License-Identifier: GPL-3.0-or-later
/// The instrument between a motion and the numbers that are written down: the mount of a camera, the zero and the sense of a scale, a
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
  tilt_zero,
  outer_angle_zero,
  inner_angle_zero,
  rotor_rate_bias,
  rotor_rate_scale,
  spin_bias,
  spin_scale,
  w_x_bias,
  w_y_bias,
  w_z_bias,
  w_scale,
  time_offset,
  clock_rate
};
inline constexpr std::size_t kInstrumentInputs = 17;

struct InstrumentRow {
  std::string_view pointer;         ///< of the number
  std::string_view standard_error;  ///< pointer of the standard error with which it is known beforehand
  std::string_view unit;
  double least, most;         ///< range
  std::string_view fallback;  ///< its value if it is left out, as a text
  double scale;               ///< a size that is not unusual, in the unit: a fit looks for it within a third of this
  std::string_view doc;
};

inline constexpr std::array<InstrumentRow, kInstrumentInputs> kInstrument = {
    InstrumentRow{"/instrument/turn_east_deg", "/instrument/turn_east_se_deg", "deg", -30, 30, "0", 10,
                  "small turn about East by which the mount shows the top turned"},
    {"/instrument/turn_north_deg", "/instrument/turn_north_se_deg", "deg", -30, 30, "0", 10, "the same about North"},
    {"/instrument/turn_up_deg", "/instrument/turn_up_se_deg", "deg", -30, 30, "0", 10, "the same about Up"},
    {"/instrument/azimuth_zero_deg", "/instrument/azimuth_zero_se_deg", "deg", -360, 360, "0", 60,
     "reading of the circle at azimuth 0, North"},
    {"/instrument/tilt_zero_deg", "/instrument/tilt_zero_se_deg", "deg", -360, 360, "0", 60, "reading at tilt 0, upright"},
    {"/instrument/outer_angle_zero_deg", "/instrument/outer_angle_zero_se_deg", "deg", -360, 360, "0", 60,
     "reading at outer angle 0"},
    {"/instrument/inner_angle_zero_deg", "/instrument/inner_angle_zero_se_deg", "deg", -360, 360, "0", 60,
     "reading at inner angle 0"},
    {"/instrument/rotor_rate_bias_rad_s", "/instrument/rotor_rate_bias_se_rad_s", "rad/s", -1e6, 1e6, "0", 1,
     "reading of a tachometer at rest"},
    {"/instrument/rotor_rate_scale", "/instrument/rotor_rate_scale_se", "", 1e-6, 1e6, "1", 0.1,
     "what a tachometer adds to that for a rad/s of the rotor"},
    {"/instrument/spin_bias_rad_s", "/instrument/spin_bias_se_rad_s", "rad/s", -1e6, 1e6, "0", 1,
     "reading of the tachometer of the body's spin where that is 0"},
    {"/instrument/spin_scale", "/instrument/spin_scale_se", "", 1e-6, 1e6, "1", 0.1, "what it adds to that for a rad/s"},
    {"/instrument/w_x_bias_rad_s", "/instrument/w_x_bias_se_rad_s", "rad/s", -1e6, 1e6, "0", 0.1,
     "reading of a gyroscope chip about body axis 1 at rest; of w_IB_B_x and w_LB_B_x"},
    {"/instrument/w_y_bias_rad_s", "/instrument/w_y_bias_se_rad_s", "rad/s", -1e6, 1e6, "0", 0.1, "the same about axis 2"},
    {"/instrument/w_z_bias_rad_s", "/instrument/w_z_bias_se_rad_s", "rad/s", -1e6, 1e6, "0", 0.1, "the same about axis 3"},
    {"/instrument/w_scale", "/instrument/w_scale_se", "", 1e-6, 1e6, "1", 0.1, "what all three add to that for a rad/s"},
    {"/instrument/time_offset_s", "/instrument/time_offset_se_s", "s", -1e9, 1e9, "0", 0.1,
     "reading of the clock at the release; before it, the top is held as it is released"},
    {"/instrument/clock_rate", "/instrument/clock_rate_se", "", 1e-3, 1e3, "1", 0.01,
     "seconds that the clock counts in a second"},
};

/// A scale on which angles are read, and may be reversed.
struct InstrumentScale {
  std::string_view reversed;  ///< pointer of the flag
  InstrumentInput zero;
  std::string_view doc;
};
inline constexpr std::size_t kInstrumentScales = 4;
inline constexpr std::array<InstrumentScale, kInstrumentScales> kReadScales = {
    InstrumentScale{"/instrument/azimuth_reversed", InstrumentInput::azimuth_zero,
                    "whether readings of the circle grow anticlockwise, seen from above"},
    {"/instrument/tilt_reversed", InstrumentInput::tilt_zero,
     "whether readings fall as the tilt grows; an elevation is reversed, and 90 at tilt 0"},
    {"/instrument/outer_angle_reversed", InstrumentInput::outer_angle_zero, "whether readings fall as the outer angle grows"},
    {"/instrument/inner_angle_reversed", InstrumentInput::inner_angle_zero, "whether readings fall as the inner angle grows"},
};

/// The last part of a pointer.
constexpr std::string_view instrument_key(std::string_view pointer) { return pointer.substr(pointer.rfind('/') + 1); }

/// The numbers of an instrument, and the standard errors with which they are known beforehand.
struct Instrument {
  std::array<double, kInstrumentInputs> value{0, 0, 0, 0, 0, 0, 0, 0, 1,
                                              0, 1, 0, 0, 0, 1, 0, 1};  ///< each in the unit of its row
  std::array<double, kInstrumentInputs> standard_error{};               ///< 0: not stated
  std::array<bool, kInstrumentScales> reversed{};

  bool operator==(const Instrument&) const = default;

  double operator[](InstrumentInput input) const { return value[static_cast<std::size_t>(input)]; }

  /// The reading (rad) of an angle (rad) on a scale.
  double reading(std::size_t scale, double angle) const {
    constexpr double kDegree = 0.017453292519943295;
    return (*this)[kReadScales[scale].zero] * kDegree + (reversed[scale] ? -angle : angle);
  }
  /// The time since the release at which the clock shows t_s.
  double time_of_motion_s(double t_s) const {
    return (t_s - (*this)[InstrumentInput::time_offset]) / (*this)[InstrumentInput::clock_rate];
  }
};

}  // namespace earthtop
