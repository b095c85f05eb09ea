// SPDX-License-Identifier: GPL-3.0-or-later
/// Tops whose drift is known to 20 digits and more, from integrations of order 50 to 72 in 113 bits that share no code with the library:
/// two for each digit, in steps that differ by a factor of 1.3 to 2.
#pragma once

#include <array>
#include <cstdlib>
#include <type_traits>
#include <vector>

#include "earthtop/model/model.hpp"
#include "integrate/spinless_pair.hpp"

#ifdef __SIZEOF_FLOAT128__
extern "C" earthtop::float128 strtoflt128(const char*, char**);  // of libquadmath, whose header clang does not find
#else
inline earthtop::float128 strtoflt128(const char* text, char** end) { return std::strtold(text, end); }
#endif

namespace earthtop::testing {

/// A top released with its axis toward a compass azimuth, and its body axis 1 down the slope; or at a quaternion (w, x, y, z). Numbers in
/// decimal.
struct FourierCase {
  struct At {
    double t_s;
    const char* drift_rad;
  };
  const char* name;
  const char *mass, *lever, *gravity, *I1, *I3, *latitude, *tilt, *azimuth;
  const char *w1, *w2, *w3;  // rad/s
  RatesRelativeTo X;
  std::vector<At> drifts;
  std::array<const char*, 4> quaternion = {};  // nulls: tilt and azimuth are given
};

inline const std::vector<FourierCase>& fourier_cases() {
  constexpr auto kI = RatesRelativeTo::inertial, kL = RatesRelativeTo::laboratory;
  // clang-format off
  static const std::vector<FourierCase> cases{
      {"toy top", "0.1", "0.03", "9.80665", "1.2e-4", "4e-5", "45", "20", "90", "0", "0", "200", kL,
       {{1, "9.921017151138216964310145e-6"}, {10, "1.866717279586694542701930e-4"}, {60, "1.140228028617515248810935e-3"}}},
      {"fast gyroscope", "0.5", "0.005", "9.80665", "4e-4", "5e-4", "45", "60", "90", "0", "0", "1047.2", kL,
       {{60, "1.645805202017006127140907e-3"}, {600, "2.568777690328440052035e-2"}}},
      {"unbalanced gyroscope", "0.14", "0.05", "9.81", "4.2e-4", "6e-5", "-33.9", "", "", "0", "0", "1047.2", kL,
       {{60, "2.372653069551312832776479e-3"}, {600, "2.321968104130550865876e-2"}, {3600, "1.409216023791875703882e-1"}},
       {"0.7933533402912352", "-0.5720486226585795", "-0.2082086712007015", "0"}},
      {"cusped top", "0.2", "0.05", "9.80665", "6e-4", "1.6e-4", "45", "40", "90", "0", "0", "110", kL,
       {{1, "4.033332255529708667901441e-5"}, {10, "4.055325551733172647174770e-4"}, {20, "8.667076845939194090440377e-4"}}},
      {"fast top from rest", "0.2", "0.05", "9.80665", "6e-4", "1.6e-4", "45", "30", "90", "0", "0", "200", kL,
       {{1, "2.400534223863842865817551e-6"}, {60, "1.711017597541221912466482e-3"}}},
      {"thrown sidewards", "0.2", "0.05", "9.80665", "6e-4", "1.6e-4", "52.5", "100", "30", "3", "-2", "150", kI,
       {{1, "6.570043386842223477643542e-5"}, {10, "6.563234373133251187839624e-4"}, {60, "3.507314573313437501706e-3"}}},
  };
  // clang-format on
  return cases;
}

inline constexpr const char* kEarthRate = "7.292115e-5";

template <class T>
T parsed(const char* text) {
  if constexpr (std::is_same_v<T, float128>)
    return strtoflt128(text, nullptr);
  else
    return static_cast<T>(std::strtold(text, nullptr));
}

/// A model in SI units and its release, to the digits of T.
template <class T>
struct FourierProblem {
  Model<T> model;
  NaturalRelease<T> release;
};
template <class T>
FourierProblem<T> problem_of(const FourierCase& c, T earth_rate) {
  const auto number = [](const char* text) { return parsed<T>(text); };
  const T degree = real::pi<T>() / T(180);
  FourierProblem<T> p;
  Model<T>& m = p.model;
  m.I_BP_B = Vec3<T>(number(c.I1), number(c.I1), number(c.I3)).asDiagonal();
  m.I_BP_B_inverse = Vec3<T>(T(1) / number(c.I1), T(1) / number(c.I1), T(1) / number(c.I3)).asDiagonal();
  m.mass_moment_B = Vec3<T>(T(0), T(0), number(c.mass) * number(c.lever));
  m.apparent_gravity_L = Vec3<T>(T(0), T(0), -number(c.gravity));
  const T latitude = number(c.latitude) * degree;
  m.epsilon = earth_rate;
  m.W_IL_L_scaled = Vec3<T>(T(0), real::cos(latitude), real::sin(latitude));
  m.W_IL_L = earth_rate * m.W_IL_L_scaled;
  p.release.w_XB_B = Vec3<T>(number(c.w1), number(c.w2), number(c.w3));
  p.release.X = c.X;
  if (const auto& q = c.quaternion; q[0] != nullptr) {
    p.release.q_LB = Quaternion<T>{number(q[0]), Vec3<T>(number(q[1]), number(q[2]), number(q[3]))}.normalized();
    return p;
  }
  const SinCos<T> tilt = real::sin_cos(T(number(c.tilt) * degree)), azimuth = real::sin_cos(T(number(c.azimuth) * degree));
  Mat3<T> R_LB;
  R_LB.col(2) = Vec3<T>(tilt.sin * azimuth.sin, tilt.sin * azimuth.cos, tilt.cos);
  R_LB.col(0) = Vec3<T>(tilt.cos * azimuth.sin, tilt.cos * azimuth.cos, -tilt.sin);
  R_LB.col(1) = R_LB.col(2).cross(R_LB.col(0));
  p.release.q_LB = quaternion_of(R_LB);
  return p;
}

template <class T>
T axis_drift(const SpinlessPair<T>& pair, T epsilon) {
  const T across = epsilon * real::hypot(pair.y[0], pair.y[1]), along = real::hypot(pair.e_w, T(epsilon * pair.y[2]));
  return T(2) * real::atan2(across, along);
}

}  // namespace earthtop::testing
