// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/playable.hpp"

#include <fmt/core.h>

#include "earthtop/run.hpp"

namespace earthtop {
namespace {

constexpr double kLongestRun_s = 10;  ///< by the library's own estimate, for one core of the program
constexpr double kMostRows = 2e5;     ///< a page has no use for more, and some hundred bytes of memory for each number
constexpr const char* kProgram = "run it with the program, earthtop run";

}  // namespace

std::string unplayable(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  if (scenario.precision != Precision::bits53) return fmt::format("a page computes in double alone; {}", kProgram);
  if (scenario.start_utc || scenario.effects.tide || scenario.effects.automatic)
    return fmt::format("{}; {}", kNoSunOrMoon, kProgram);
  if (scenario.travel) return fmt::format("{}; {}", kNoJourney, kProgram);
  if (const double seconds = estimated_run_seconds(scene); seconds > kLongestRun_s)
    return fmt::format("this run would take {} even outside of a page; shorten it, or {}", about_seconds(seconds), kProgram);
  if (scene.rows() > kMostRows)
    return fmt::format("this run has {:.0f} rows, and a page takes {:.0f}; lengthen /motion/output_step_s, or {}", scene.rows(),
                       kMostRows, kProgram);
  return "";
}

}  // namespace earthtop
