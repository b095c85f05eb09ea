// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the platform.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "earthtop/real.hpp"
#include "scenario/decode.hpp"
#include "scenario/filed_table.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {

std::optional<PlatformSpec> decode_platform(const Section& platform, const ScenarioSource& source, double duration_s) {
  PlatformSpec spec;
  Reading codec(platform);
  platform_keys(codec, spec);
  const auto word = platform.word("motion");
  if (word) {
    const MotionRule& rule = row_of(kMotionRules, spec.motion);
    for (const std::string_view key : split_words(kMotionKeys)) {
      if (lists(rule.required, key)) platform.require(key);
      if (!lists(rule.allowed, key) && platform.has(key))
        platform.refuse_key(key, fmt::format("does not belong to \"{}\" motion; allowed with it: {}", rule.word,
                                             fmt::join(split_words(rule.allowed), ", ")));
    }
  }
  const auto axis = platform.vector("axis");
  // The square of a shorter axis would underflow, and its direction would be lost.
  if (axis && real::hypot((*axis)[0], (*axis)[1], (*axis)[2]) < 1e-150)
    platform.refuse("axis", "is the zero vector, or nearly; must have a direction, best with length 1");
  if (word == "table") decode_table(platform, source, duration_s, kTableOfAngles, spec.table);
  return spec;
}

}  // namespace earthtop::scenario
