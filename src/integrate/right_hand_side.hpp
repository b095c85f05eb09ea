// SPDX-License-Identifier: GPL-3.0-or-later
/// What a stepper asks for the slope: any system with states of one size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace earthtop {

/// The right-hand side of a system, and how often it was asked for. It knows the system by its address: the steppers are
/// compiled once for all systems of a shape, and nothing is lost, since right-hand sides are functions of their own
/// (inline_all.hpp).
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
