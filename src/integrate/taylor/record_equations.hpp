// SPDX-License-Identifier: GPL-3.0-or-later
/// Records a right-hand side that is a template on its scalar. To be included after recorded_model.hpp.
#pragma once

#include <span>
#include <stdexcept>
#include <vector>

#include "integrate/taylor/recorded_model.hpp"

namespace earthtop {

/// @param equations  called with (x, dxdt, t)   @param x, t  state and time at which they are recorded
template <class T, std::size_t N, class Equations>
taylor::Operations<T> recorded_equations(const Equations& equations, taylor::Recording<T>& recording, std::span<const T> x,
                                         T t) {
  using R = real::Recorded<T>;
  if (x.size() != N) throw std::logic_error("record: a state of another size");
  std::array<R, N> state, rate;
  for (std::size_t i = 0; i < N; ++i)
    state[i] = R(recording, recording.add({.kind = taylor::Kind::state, .a = static_cast<int>(i)}, x[i]));
  const R time(recording, recording.add({.kind = taylor::Kind::time}, t));
  equations(state, rate, time);
  std::vector<int> outputs;
  outputs.reserve(N);
  for (const R& component : rate) outputs.push_back(component.place_in(recording));
  return recording.finish(outputs);
}

}  // namespace earthtop
