// SPDX-License-Identifier: GPL-3.0-or-later
/// The right-hand side as steppers see it: any system with states of one size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace earthtop {

/// The right-hand side of a system, and a count of its evaluations. It refers to the system by address only, so that the
/// steppers are compiled once for all systems of a shape. That costs no time, since right-hand sides are separate functions
/// anyway (inline_all.hpp).
template <class T, std::size_t N>
class RightHandSide {
 public:
  using State = std::array<T, N>;
  template <class System>
  RightHandSide(const System& system, std::int64_t& evaluations)
      : system_(&system),
        evaluations_(&evaluations),
        call_([](const void* object, const State& x, State& dxdt, T t) { (*static_cast<const System*>(object))(x, dxdt, t); }) {
  }
  void operator()(const State& x, State& dxdt, T t) const {
    ++*evaluations_;
    call_(system_, x, dxdt, t);
  }

 private:
  const void* system_;
  std::int64_t* evaluations_;
  void (*call_)(const void*, const State&, State&, T);
};

}  // namespace earthtop
