// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of recorded_drift_kernels.hpp for one instruction set.
#pragma once

#include "drift/lanes/recorded_drift_kernels.hpp"
#include "integrate/lanes/recorded_kernel.ipp"

namespace earthtop::lanes {
namespace {

struct DrivenDriftLanes {
  static constexpr int kVariables = kDrivenDriftVariables, kGroupCount = 7;
  static constexpr const Group* kGroups = kDrivenDriftGroups;
};
struct CompassDriftLanes {
  static constexpr int kVariables = kCompassDriftVariables, kGroupCount = 8;
  static constexpr const Group* kGroups = kCompassDriftGroups;
};
struct ComposedDriftLanes {
  static constexpr int kVariables = kComposedDriftVariables, kGroupCount = 4;
  static constexpr const Group* kGroups = kComposedDriftGroups;
};

struct GyrostatDriftLanes {
  static constexpr int kVariables = kGyrostatDriftVariables, kGroupCount = 7;
  static constexpr const Group* kGroups = kGyrostatDriftGroups;
};
struct GimbalDriftLanes {
  static constexpr int kVariables = kGimbalDriftVariables, kGroupCount = 5;
  static constexpr const Group* kGroups = kGimbalDriftGroups;
};

}  // namespace
}  // namespace earthtop::lanes

#define EARTHTOP_RECORDED_DRIFT_KERNELS(set)                                            \
  namespace earthtop::lanes {                                                           \
  const Kernel kDrivenDrift_##set{step_block<RecordedLanes<DrivenDriftLanes>>,          \
                                  evaluate_block<RecordedLanes<DrivenDriftLanes>>};     \
  const Kernel kCompassDrift_##set{step_block<RecordedLanes<CompassDriftLanes>>,        \
                                   evaluate_block<RecordedLanes<CompassDriftLanes>>};   \
  const Kernel kComposedDrift_##set{step_block<RecordedLanes<ComposedDriftLanes>>,      \
                                    evaluate_block<RecordedLanes<ComposedDriftLanes>>}; \
  const Kernel kGyrostatDrift_##set{step_block<RecordedLanes<GyrostatDriftLanes>>,      \
                                    evaluate_block<RecordedLanes<GyrostatDriftLanes>>}; \
  const Kernel kGimbalDrift_##set{step_block<RecordedLanes<GimbalDriftLanes>>,          \
                                  evaluate_block<RecordedLanes<GimbalDriftLanes>>};     \
  }
