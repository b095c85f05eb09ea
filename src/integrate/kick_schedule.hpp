/// When and how hard the kicks of a step come, for a composition of exact flows A (the large one) and B (the kick).
///
/// gauss(s): the s nodes and weights of Gauss and Legendre, ABA(2s, 2) in the language of near-integrable systems: a local
/// error eps h^2s + eps^2 h^2, where B is of the size eps against A (J. Laskar, P. Robutel 2001). aba864: ABA(8, 6, 4) of S.
/// Blanes, F. Casas, A. Farres, J. Laskar, J. Makazaga and A. Murua 2013 (arXiv 1208.0716), for an eps that is not small.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace earthtop {

struct KickSchedule {
  static constexpr int kMost = 8;
  int kicks = 1;
  std::array<double, kMost> at{0.5};    ///< in units of the step
  std::array<double, kMost> weight{1};  ///< their sum is 1
};

namespace kick_schedules {

/// @param kicks  1 to KickSchedule::kMost
inline KickSchedule gauss(int kicks) {
  KickSchedule schedule;
  schedule.kicks = kicks;
  for (int i = 0; i < (kicks + 1) / 2; ++i) {
    // Newton's method from a value between two extrema, on [-1, 1].
    long double x = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (kicks + 0.5L)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      long double value = 1, before = 0;
      for (int j = 0; j < kicks; ++j) {
        const long double next = ((2 * j + 1) * x * value - j * before) / (j + 1);
        before = value;
        value = next;
      }
      slope = kicks * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    const int mirrored = kicks - 1 - i;
    schedule.at[i] = static_cast<double>((1 - x) / 2);
    schedule.at[mirrored] = static_cast<double>((1 + x) / 2);
    schedule.weight[i] = schedule.weight[mirrored] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  }
  return schedule;
}

inline KickSchedule aba864() {
  constexpr std::array<long double, 4> a{0.0711334264982231177779387300061549964174L,
                                         0.241153427956640098736487795326289649618L, 0.521411761772814789212136078067994229991L,
                                         -0.333698616227678005726562603400438876027L};
  constexpr std::array<long double, 4> b{0.183083687472197221961703757166430291072L, 0.310782859898574869507522291054262796375L,
                                         -0.0265646185119588006972121379164987592663L,
                                         0.0653961422823734184559721793911134363710L};
  KickSchedule schedule;
  schedule.kicks = 7;
  long double now = 0;
  for (int i = 0; i < 7; ++i) {
    now += a[static_cast<std::size_t>(i < 4 ? i : 7 - i)];
    schedule.at[static_cast<std::size_t>(i)] = static_cast<double>(now);
    schedule.weight[static_cast<std::size_t>(i)] = static_cast<double>(b[static_cast<std::size_t>(i < 4 ? i : 6 - i)]);
  }
  return schedule;
}

}  // namespace kick_schedules
}  // namespace earthtop
