// SPDX-License-Identifier: GPL-3.0-or-later
/// Measurements made up from closed forms that are written here, apart from the code that is tested.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/vectors.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::test {

using Overrides = std::vector<std::pair<std::string, std::string>>;

inline constexpr double kPi = std::numbers::pi, kDegree = kPi / 180, kArcsecond = kDegree / 3600;
inline constexpr double kOmega = 7.292115e-5;  // rad/s
/// Accuracy of predictions (rad): the rounding of some hundred operations, or the tolerance 1e-12 over a run.
inline constexpr double kComputed = 1e-11;

class MeasurementTest : public ::testing::Test {
 protected:
  Measurement read(const std::string& text, const MeasurementFormat& format = {}) const {
    const std::string file = (directory_.path() / "measured.csv").string();
    std::ofstream(file, std::ios::binary) << text;
    return read_measurement(file, format);
  }
  std::vector<Diagnostic> refusal(const std::string& text, const MeasurementFormat& format = {}) const {
    try {
      read(text, format);
    } catch (const ScenarioError& error) {
      const bool is_of_option = error.diagnostics().front().pointer.starts_with("--");
      if (!is_of_option) EXPECT_EQ(error.file(), (directory_.path() / "measured.csv").string());
      expect_refused_alike(text, format, error.diagnostics());
      return error.diagnostics();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {{}};
  }
  /// Expects that the text is refused without a file, too, with the same findings.
  static void expect_refused_alike(const std::string& text, const MeasurementFormat& format,
                                   const std::vector<Diagnostic>& expected) {
    try {
      parse_measurement("<text>", text, format);
      ADD_FAILURE() << "accepted as a text: " << text;
    } catch (const ScenarioError& error) {
      if (!error.diagnostics().front().pointer.starts_with("--")) EXPECT_EQ(error.file(), "<text>");
      ASSERT_EQ(error.diagnostics().size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(format_diagnostic("", error.diagnostics()[i]), format_diagnostic("", expected[i]));
    }
  }
  testing::TemporaryDirectory directory_;
};

inline ScenarioSource shipped(const std::string& name) {
  return read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json");
}

/// The axis of a balanced gyroscope keeps its direction in inertial space. In the laboratory it turns by -|W| t about W, the
/// Earth's rate, with a northward and a vertical component [Rodrigues].
inline Vec3<double> free_axis(const Vec3<double>& n0_L, double northward, double vertical, double t_s) {
  const double rate = std::hypot(northward, vertical);
  const Vec3<double> k_L(0, northward / rate, vertical / rate);
  const double angle = -rate * t_s;
  return n0_L * std::cos(angle) + k_L.cross(n0_L) * std::sin(angle) + k_L * (k_L.dot(n0_L) * (1 - std::cos(angle)));
}
inline double azimuth(const Vec3<double>& n_L) { return std::atan2(n_L[0], n_L[1]); }
inline double tilt(const Vec3<double>& n_L) { return std::atan2(std::hypot(n_L[0], n_L[1]), n_L[2]); }

inline const Vec3<double> kEast(1, 0, 0);
inline const double kNorthward45 = kOmega * std::cos(45 * kDegree), kVertical45 = kOmega * std::sin(45 * kDegree);

class Normal {
 public:
  explicit Normal(std::uint64_t seed) : bits_(seed) {}
  /// Box and Muller's transformation, which gives the same numbers with every library.
  double operator()() {
    const double a = uniform(), b = uniform();
    return std::sqrt(-2 * std::log(a)) * std::cos(2 * kPi * b);
  }

 private:
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }
  std::mt19937_64 bits_;
};

}  // namespace earthtop::test
