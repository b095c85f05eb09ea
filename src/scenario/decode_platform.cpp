// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the platform, and the table of angles that may move it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

#include "earthtop/real.hpp"
#include "input/file.hpp"
#include "scenario/angle_table.hpp"
#include "scenario/decode.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"
#include "text/sha256.hpp"

namespace earthtop::scenario {
namespace {

constexpr std::size_t kLongestShownPath = 200;

/// Returns the table's bytes; empty if the file has been refused.
std::optional<std::string> read_table(const Section& platform, const ScenarioSource& source, const std::string& file) {
  if (!source.may_name_files)
    platform.refuse("file", "files are not read here; give a motion without a table");
  else if (file.empty() || file.find('\0') != std::string::npos)
    platform.refuse("file", "names no file; must be the path of a CSV file");
  else
    try {
      const std::filesystem::path path = std::filesystem::path(source.file).parent_path() / file;
      return input::read_regular_file(path.string(), excerpt(path.string(), kLongestShownPath), {"table"});
    } catch (const ScenarioError& error) {
      for (const Diagnostic& diagnostic : error.diagnostics())
        platform.refuse("file", fmt::format("{}: {}", error.file(), diagnostic.message));
    }
  return std::nullopt;
}

void decode_table(const Section& platform, const ScenarioSource& source, double duration_s, PlatformSpec& spec) {
  const auto file = platform.word("file");
  if (!file) return;
  const auto text = read_table(platform, source, *file);
  if (!text) return;
  spec.file_sha256 = sha256_hex(*text);
  const auto sha256 = platform.word("file_sha256");
  if (sha256 && *sha256 != spec.file_sha256)
    platform.refuse("file_sha256", fmt::format("is not that of {}, {}; use the file that was meant, or leave this key out",
                                               excerpt(*file, kLongestShownPath), spec.file_sha256));
  auto parsed = parse_angle_table(*text, duration_s);
  if (const auto* fault = std::get_if<TableFault>(&parsed))
    return platform.refuse("file", fmt::format("{}:{}: {}", excerpt(*file, kLongestShownPath), fault->line, fault->message));
  spec.table = std::make_shared<const AngleTable>(std::get<AngleTable>(std::move(parsed)));
}

}  // namespace

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
  if (word == "table") decode_table(platform, source, duration_s, spec);
  return spec;
}

}  // namespace earthtop::scenario
