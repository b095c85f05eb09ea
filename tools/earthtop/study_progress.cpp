// SPDX-License-Identifier: GPL-3.0-or-later
#include "study_progress.hpp"

#include <fmt/core.h>

#include <cmath>

#include "earthtop/study/run_study.hpp"
#include "progress_line.hpp"

namespace earthtop::tool {

std::string progress_text(const StudyProgress& progress) {
  const std::uint64_t there = progress.before + progress.done;
  const double rate = progress.seconds > 0 ? static_cast<double>(progress.done) / progress.seconds : 0;
  std::string text = fmt::format("{:3.0f}%  {} of {} points", std::floor(100 * progress.share), there, progress.wanted);
  if (rate > 0) text += fmt::format(", {:.3g} a second", rate);
  if (const double since = progress.share - progress.share_before; since > 0)
    text += fmt::format(", {} left", duration_text(progress.seconds * (1 - progress.share) / since));
  if (progress.failed > 0) text += fmt::format(", {} failed", progress.failed);
  return text;
}

}  // namespace earthtop::tool
