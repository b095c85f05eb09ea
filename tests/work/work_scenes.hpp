// SPDX-License-Identifier: GPL-3.0-or-later
/// Random scenes, from gentle to stiff, in which each effect, method and precision decides how much work a run takes.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "support/scenes.hpp"

namespace earthtop::testing {

struct WorkKind {
  std::string_view name;
  void (*add)(Scenario&, Random&);  ///< adds the effect to a scene whose duration is known; may change the duration
};
std::span<const WorkKind> work_kinds();

/// Scene `index` of a kind; the same on every platform.
Scenario work_scene(const WorkKind& kind, std::uint64_t index);

/// The estimated and the actual work of a run, in evaluations of the right-hand side.
struct WorkDone {
  Work promised[3], used[3];  ///< solution, certificate, growth of disturbances
  RunStatus status[2];
  bool growth_completed = true;
  double promised_s = 0, used_s = 0;  ///< processor time
};
WorkDone work_done(const Scenario& scenario);

}  // namespace earthtop::testing
