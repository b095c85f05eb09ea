// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/mapping.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/fields.hpp"
#include "earthtop/error.hpp"
#include "input/check.hpp"
#include "input/file.hpp"
#include "input/section.hpp"

namespace earthtop::compare {
namespace {

using namespace input;

/// The words of an array of `count` strings; anything else is refused.
std::vector<std::string> words_of(const Section& section, std::string_view key, std::size_t count) {
  std::vector<std::string> words;
  const Node* node = section.any(key);
  if (!node) return words;
  if (node->kind == JsonKind::array)
    for (const Node& child : node->children)
      if (child.kind == JsonKind::string && !child.text.empty()) words.push_back(child.text);
  const bool whole = words.size() == count && node->children.size() == count;
  if (!whole || std::set<std::string>(words.begin(), words.end()).size() != count) {
    section.refuse(key, fmt::format("must be an array of {} different names", count));
    words.clear();
  }
  return words;
}

/// A word for one of earthtop's axes: the axis's number, and the sign of its direction.
struct AxisWord {
  std::string_view word;
  std::size_t index;
  double sign;
};
constexpr AxisWord kWorldWords[] = {{"east", 0, 1},   {"west", 0, -1}, {"north", 1, 1},
                                    {"south", 1, -1}, {"up", 2, 1},    {"down", 2, -1}};
constexpr AxisWord kBodyWords[] = {{"1", 0, 1}, {"-1", 0, -1}, {"2", 1, 1}, {"-2", 1, -1}, {"3", 2, 1}, {"-3", 2, -1}};

/// A name for a frame whose axes are given by three of the words.
struct FrameName {
  std::string_view name;
  std::array<std::string_view, 3> words;
};
constexpr FrameName kWorldNames[] = {{"ENU", {"east", "north", "up"}},
                                     {"NED", {"north", "east", "down"}},
                                     {"NWU", {"north", "west", "up"}},
                                     {"y-up", {"east", "up", "south"}}};
constexpr FrameName kBodyNames[] = {{"z-spin", {"1", "2", "3"}}, {"x-forward", {"3", "1", "2"}}};

std::string listed(std::span<const FrameName> names) {
  std::string text;
  for (const FrameName& frame : names) text += fmt::format("\"{}\", ", frame.name);
  return text;
}

bool is_right_handed(const AxisTurn& turn) {
  const auto& index = turn.index;
  const bool cyclic = (index[0] + 1) % 3 == index[1] && (index[1] + 1) % 3 == index[2];
  return turn.sign[0] * turn.sign[1] * turn.sign[2] * (cyclic ? 1 : -1) > 0;
}

AxisTurn decode_axes(const Section& root, std::string_view key, std::span<const FrameName> names,
                     std::span<const AxisWord> words) {
  AxisTurn turn;
  const Node* node = root.any(key);
  if (!node) return turn;
  std::vector<std::string> given;
  if (node->kind == JsonKind::string) {
    for (const FrameName& frame : names)
      if (frame.name == node->text) given.assign(frame.words.begin(), frame.words.end());
  } else if (node->kind == JsonKind::array && node->children.size() == 3) {
    for (const Node& child : node->children)
      given.push_back(child.kind == JsonKind::number ? fmt::format("{}", child.number) : child.text);
  }
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto word = std::find_if(words.begin(), words.end(), [&](const AxisWord& w) { return w.word == given[i]; });
    if (word == words.end() || !taken.insert(word->index).second) break;
    turn.index[i] = word->index;
    turn.sign[i] = word->sign;
  }
  if (taken.size() != 3) {
    std::string allowed;
    for (const AxisWord& word : words) allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", word.word);
    root.refuse(key, fmt::format("must be {}or an array of three of {}, with each direction once", listed(names), allowed));
  } else if (!is_right_handed(turn)) {
    root.refuse(key, "is a left-handed frame; reverse one of its axes");
  }
  return turn;
}

char decode_character(const Section& root, std::string_view key) {
  const std::string text = root.word(key).value_or(",");
  const bool fits = text.size() == 1 && text.find_first_of("\r\n\".-+0123456789eE") == std::string::npos;
  if (!fits) root.refuse(key, "must be one character that does not occur in numbers");
  return fits ? text.front() : ',';
}

std::optional<std::array<std::string, 3>> three_columns(const Section& section) {
  if (!section.present() || !section.require("columns")) return std::nullopt;
  const auto words = words_of(section, "columns", 3);
  if (words.empty()) return std::nullopt;
  return std::array{words[0], words[1], words[2]};
}

constexpr NamedUnit kTimeUnits[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60}, {"h", 3600}};
constexpr double kTurn = 6.283185307179586;
constexpr NamedUnit kRateUnits[] = {{"rad/s", 1}, {"deg/s", kTurn / 360}, {"rev/s", kTurn}, {"rpm", kTurn / 60}};

double unit_value(std::span<const NamedUnit> units, const std::optional<std::string>& word) {
  for (const NamedUnit& unit : units)
    if (word == unit.word) return unit.value;
  return 1;
}

/// The unit of this value, to a relative error.
std::optional<NamedUnit> unit_for(std::span<const NamedUnit> units, double value, double error) {
  for (const NamedUnit& unit : units)
    if (std::abs(value / unit.value - 1) < error) return unit;
  return std::nullopt;
}

std::string words_on(const AxisTurn& turn, std::span<const FrameName> names, std::span<const AxisWord> words) {
  std::array<std::string_view, 3> given;
  for (std::size_t i = 0; i < 3; ++i)
    for (const AxisWord& word : words)
      if (word.index == turn.index[i] && word.sign == turn.sign[i]) given[i] = word.word;
  std::string text;
  for (std::string_view word : given) {
    std::string shown(word);
    if (shown[0] >= 'a' && shown[0] <= 'z') shown[0] = static_cast<char>(shown[0] - 'a' + 'A');
    text += (text.empty() ? "" : ", ") + shown;
  }
  for (const FrameName& frame : names)
    if (frame.words == given) text += fmt::format(" (\"{}\")", frame.name);
  return text;
}

Mapping decode_mapping(const Section& root) {
  Mapping mapping;
  mapping.format = {decode_character(root, "separator"), decode_character(root, "comment"), false};
  const Section time = root.section("time");
  if (root.require("time") && time.require("column")) mapping.time_column = time.word("column").value_or("");
  mapping.time_unit_s = unit_value(kTimeUnits, time.word("unit"));
  mapping.time_offset_s = time.number("offset_s").value_or(0);
  if (const auto repeated = time.word("repeated"); repeated && *repeated != "refused")
    mapping.repeated = *repeated == "first" ? RepeatedTime::first : RepeatedTime::last;

  if (root.has("quaternion")) {
    const Section quaternion = root.section("quaternion");
    const auto words = quaternion.require("columns") ? words_of(quaternion, "columns", 4) : std::vector<std::string>();
    const bool scalar_last = quaternion.word("order") == "xyzw";
    if (!words.empty())
      mapping.quaternion =
          scalar_last ? std::array{words[3], words[0], words[1], words[2]} : std::array{words[0], words[1], words[2], words[3]};
    mapping.body_to_world = quaternion.word("rotation") != "world_to_body";
  }
  if (root.has("rates")) {
    const Section rates = root.section("rates");
    mapping.rates = three_columns(rates);
    mapping.rate_unit_rad_s = unit_value(kRateUnits, rates.word("unit"));
    mapping.rates_in_world_axes = rates.word("axes") == "world";
    if (mapping.rates_in_world_axes && !root.has("quaternion"))
      rates.refuse("axes", "the rates along body axes cannot be found without a quaternion; give one");
  }
  if (root.has("axis")) mapping.axis = three_columns(root.section("axis"));
  if (!root.has("quaternion") && !root.has("rates") && !root.has("axis"))
    root.missing("quaternion",
                 "is missing, and so are the rates and the axis, so that there is nothing to compare; give one of them");
  mapping.world = decode_axes(root, "world_axes", kWorldNames, kWorldWords);
  mapping.body = decode_axes(root, "body_axes", kBodyNames, kBodyWords);
  mapping.attitude_error_rad = root.number("attitude_error_rad");
  return mapping;
}

}  // namespace

Eigen::Matrix3d matrix_of(const AxisTurn& turn) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) matrix(static_cast<int>(turn.index[i]), static_cast<int>(i)) = turn.sign[i];
  return matrix;
}

const std::vector<AxisTurn>& all_turns() {
  static const std::vector<AxisTurn> all = [] {
    std::vector<AxisTurn> turns;
    AxisTurn turn;
    do
      for (unsigned signs = 0; signs < 8; ++signs) {
        for (unsigned i = 0; i < 3; ++i) turn.sign[i] = (signs >> i & 1U) != 0 ? -1 : 1;
        if (is_right_handed(turn)) turns.push_back(turn);
      }
    while (std::next_permutation(turn.index.begin(), turn.index.end()));
    return turns;
  }();
  return all;
}

std::string world_words(const AxisTurn& turn) { return words_on(turn, kWorldNames, kWorldWords); }
std::string body_words(const AxisTurn& turn) { return words_on(turn, kBodyNames, kBodyWords); }
std::optional<NamedUnit> time_unit_for(double unit_s, double ratio) {
  constexpr double kNearEnd = 0.05;  // a file may end a little earlier
  return unit_for(kTimeUnits, unit_s / ratio, kNearEnd);
}
std::optional<NamedUnit> rate_unit_for(double unit_rad_s, double ratio) {
  constexpr double kSameRates = 1e-3;
  return unit_for(kRateUnits, unit_rad_s / ratio, kSameRates);
}

Mapping read_mapping(const std::string& file) {
  const std::string content = read_regular_file(file, file, {"mapping file", false});
  std::string_view text = content;
  Findings findings;
  const Node root = read_checked(text, file, mapping_fields(), findings);
  Mapping mapping = decode_mapping(Section(root, findings, mapping_fields()));
  if (!findings.empty()) throw ScenarioError(findings.errors(text), file);
  mapping.file = file;
  return mapping;
}

}  // namespace earthtop::compare
