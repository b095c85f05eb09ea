// SPDX-License-Identifier: GPL-3.0-or-later
/// Time of one evaluation of a closed form, without and with its construction.

#include <benchmark/benchmark.h>

#include "earthtop/closed_form/lagrange_top.hpp"

namespace {

using earthtop::LagrangeTop;
using earthtop::Quaternion;
using earthtop::SymmetricTop;
using earthtop::Vec3;

/// Spins that select the two branches: k^2 > 1/2 for the slow one, k^2 << 1/2 for the fast one.
constexpr double kSlow = 0.7, kFast = 50;

const SymmetricTop<double> kTop{1, 1.5, 1};
const Quaternion<double> kStart{0.9, {0.3, 0.1, 0.2}};

void lagrange_at(benchmark::State& state, double spin) {
  const LagrangeTop<double> top(kTop, kStart, {0.1, 0.2, spin});
  double t = 0;
  for (auto _ : state) benchmark::DoNotOptimize(top.at(t += 0.37));
}
void lagrange_construct_and_at(benchmark::State& state, double spin) {
  Vec3<double> w(0.1, 0.2, spin);
  for (auto _ : state) {
    w[0] += 1e-9;
    benchmark::DoNotOptimize(LagrangeTop<double>(kTop, kStart, w).at(0.37));
  }
}
BENCHMARK_CAPTURE(lagrange_at, slow, kSlow);
BENCHMARK_CAPTURE(lagrange_at, fast, kFast);
BENCHMARK_CAPTURE(lagrange_construct_and_at, slow, kSlow);
BENCHMARK_CAPTURE(lagrange_construct_and_at, fast, kFast);

}  // namespace

BENCHMARK_MAIN();
