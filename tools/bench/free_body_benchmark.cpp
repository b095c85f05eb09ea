// SPDX-License-Identifier: GPL-3.0-or-later
/// Time of one evaluation of the free body's closed form, and of its construction.

#include <benchmark/benchmark.h>

#include "earthtop/closed_form/free_body.hpp"

namespace {

using earthtop::FreeBody;
using earthtop::Quaternion;
using earthtop::Vec3;

template <class T>
struct Start {
  Vec3<T> moments, w0;
  Quaternion<T> q0{T(0.9), Vec3<T>(T(0.3), T(0.1), T(0.2))};
};
template <class T>
Start<T> far_from_separatrix() {
  return {Vec3<T>(T(1), T(2), T(3)), Vec3<T>(T(0.2), T(0.1), T(1))};
}
template <class T>
Start<T> near_separatrix() {
  return {Vec3<T>(T(1), T(2), T(3)), Vec3<T>(T(1), T(0.1), T(0.6))};
}
template <class T>
Start<T> symmetric() {
  return {Vec3<T>(T(1), T(1), T(3)), Vec3<T>(T(1), T(0.1), T(0.6))};
}

template <class T, Start<T> (*start)()>
void free_body_at(benchmark::State& state) {
  const Start<T> s = start();
  const FreeBody<T> body(s.moments, s.q0, s.w0);
  T t = T(0);
  for (auto _ : state) benchmark::DoNotOptimize(body.at(t += T(0.37)));
}
template <class T, Start<T> (*start)()>
void free_body_construct(benchmark::State& state) {
  Start<T> s = start();
  for (auto _ : state) {
    s.w0[0] += T(1e-9);
    benchmark::DoNotOptimize(FreeBody<T>(s.moments, s.q0, s.w0));
  }
}
BENCHMARK_TEMPLATE(free_body_at, double, far_from_separatrix<double>);
BENCHMARK_TEMPLATE(free_body_at, double, near_separatrix<double>);
BENCHMARK_TEMPLATE(free_body_at, double, symmetric<double>);
BENCHMARK_TEMPLATE(free_body_at, float80, far_from_separatrix<float80>);
BENCHMARK_TEMPLATE(free_body_at, earthtop::float128, far_from_separatrix<earthtop::float128>);
BENCHMARK_TEMPLATE(free_body_construct, double, far_from_separatrix<double>);
BENCHMARK_TEMPLATE(free_body_construct, double, near_separatrix<double>);
BENCHMARK_TEMPLATE(free_body_construct, double, symmetric<double>);

}  // namespace
