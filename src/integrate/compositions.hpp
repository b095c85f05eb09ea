// SPDX-License-Identifier: GPL-3.0-or-later
/// Symmetric compositions of two exact flows A and B,
///
///   exp(a_1 h A) exp(b_1 h B) exp(a_2 h A) ... exp(b_s h B) exp(a_{s+1} h A) ,
///
/// as tables. An ABA composition of generalised order (p, q, ...) has a local error eps h^p + eps^2 h^q + ... (times h), where
/// eps is the size of B relative to A.
///
/// Sources: aba82 Laskar and Robutel 2001 (their SABA_4: Gauss-Legendre nodes); aba84 McLachlan 1995; aba864 and aba1064
/// Blanes, Casas, Farres, Laskar, Makazaga and Murua 2013 (arXiv 1208.0716); rkn6 Blanes and Moan 2002, their SRKN_14^a, for
/// [B, [B, [B, A]]] = 0, which holds for a force that depends on the position alone; kahan_li8 Kahan and Li 1997 (s17odr8a), a
/// composition of steps exp(h A / 2) exp(h B) exp(h A / 2), which treats A and B alike.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "earthtop/integrate/options.hpp"

namespace earthtop {

struct CompositionTable {
  static constexpr int kMostStages = 17;
  Composition name;
  int order;   ///< the least p for which the local error is O(h^(p+1)), whatever the size of B
  int stages;  ///< number of flows of B; there is one more of A
  std::array<double, kMostStages + 1> a{};
  std::array<double, kMostStages> b{};
};

namespace compositions {

/// A symmetric composition. @param a, b  the first halves a_1, a_2, ... and b_1, b_2, ..., including those in the middle
template <std::size_t NA, std::size_t NB>
constexpr CompositionTable symmetric(Composition name, int order, int stages, const std::array<double, NA>& a,
                                     const std::array<double, NB>& b) {
  CompositionTable table{name, order, stages, {}, {}};
  for (std::size_t i = 0; i < NA; ++i) table.a[i] = table.a[static_cast<std::size_t>(stages) - i] = a[i];
  for (std::size_t i = 0; i < NB; ++i) table.b[i] = table.b[static_cast<std::size_t>(stages) - 1 - i] = b[i];
  return table;
}

/// A symmetric composition of steps g_1 h, g_2 h, ..., each of which is one step A, B, A. @param g  the first half
template <std::size_t N>
constexpr CompositionTable of_strang_steps(Composition name, int order, const std::array<double, N>& g) {
  constexpr int stages = 2 * static_cast<int>(N) - 1;
  CompositionTable table{name, order, stages, {}, {}};
  for (std::size_t i = 0; i < N; ++i) table.b[i] = table.b[static_cast<std::size_t>(stages) - 1 - i] = g[i];
  table.a[0] = table.a[stages] = g[0] / 2;
  for (std::size_t i = 1; i < static_cast<std::size_t>(stages); ++i) table.a[i] = (table.b[i - 1] + table.b[i]) / 2;
  return table;
}

}  // namespace compositions

inline constexpr std::array kCompositionTables = {
    compositions::symmetric(
        Composition::aba82, 2, 4,
        std::array{0.06943184420297371238802675555, 0.26057763400459815521064036486, 0.33998104358485626480266575910},
        std::array{0.17392742256872692868653197461, 0.32607257743127307131346802539}),
    compositions::symmetric(
        Composition::aba84, 4, 5,
        std::array{0.07534696026989288841652780368, 0.51791685468825678230077397850, -0.09326381495814967071730178218},
        std::array{0.19022593937367661924523076274, 0.84652407044352625705508054465, -1.07350001963440575260062261478}),
    compositions::symmetric(Composition::aba864, 4, 7,
                            std::array{0.07113342649822311777793873001, 0.24115342795664009873648779533,
                                       0.52141176177281478921213607807, -0.33369861622767800572656260340},
                            std::array{0.18308368747219722196170375717, 0.31078285989857486950752229105,
                                       -0.02656461851195880069721213792, 0.06539614228237341845597217939}),
    compositions::symmetric(
        Composition::aba1064, 4, 8,
        std::array{0.03809449742241219545697532231, 0.14529871611691374929402007266, 0.20762769572554125071620561132,
                   0.43590970365152615922315486240, -0.65386122583278670938071173739},
        std::array{0.09585888083707521061077150377, 0.20444615314299878068050778392, 0.21707034797899110171433859243,
                   -0.01737538195906509300561788012}),
    compositions::symmetric(Composition::rkn6, 6, 14,
                            std::array{0.0378593198406116, 0.102635633102435, -0.0258678882665587, 0.314241403071447,
                                       -0.130144459517415, 0.106417700369543, -0.00879424312851058, 0.20730506905689536},
                            std::array{0.09171915262446165, 0.183983170005006, -0.05653436583288827, 0.004914688774712854,
                                       0.143761127168358, 0.328567693746804, -0.19641146648645423}),
    compositions::of_strang_steps(
        Composition::kahan_li8, 8,
        std::array{0.13020248308889008087881763, 0.56116298177510838456196441, -0.38947496264484728640807860,
                   0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
                   0.25837438768632204729397911, 0.29501172360931029887096624, -0.60550853383003451169892108}),
};

constexpr const CompositionTable& composition_table(Composition name) {
  for (const CompositionTable& table : kCompositionTables)
    if (table.name == name) return table;
  return composition_table(Composition::rkn6);
}

}  // namespace earthtop
