// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "study/design.hpp"
#include "study/json_text.hpp"
#include "text/json.hpp"

namespace earthtop::study {
namespace {

/// The keys that make a study's identity, with their values, in the order in which they are compared.
using Keys = std::vector<std::pair<std::string, std::string>>;

std::string level_text(const std::vector<std::string>& level) {
  std::string text;
  for (const std::string& value : level) text += (text.empty() ? "" : " ") + plain_text(read_value(value));
  return text;
}

Keys keys_of(const Study& study) {
  Keys keys;
  for (const auto& [pointer, value] : study.set) keys.emplace_back("/set" + pointer, plain_text(read_value(value)));
  // The base's own comments are not compared.
  const Json base = Json::parse(study.base.text, nullptr, false, true);
  const Json leaves = base.is_object() ? base.flatten() : Json::object();
  if (!leaves.empty())
    for (const auto& [pointer, value] : leaves.items())
      if (pointer.find("/_") == std::string::npos && pointer.find("/~1~1") == std::string::npos && pointer != "/name" &&
          pointer != "/title" && pointer != "/purpose")
        keys.emplace_back("/base" + pointer, written_replacing(value));
  for (const auto& [key, value] : Keys{{"/design/kind", std::string(to_string(study.design.kind))},
                                       {"/design/points", fmt::format("{}", study.design.points)},
                                       {"/design/seed", fmt::format("{}", study.design.seed)},
                                       {"/design/indices", fmt::format("{}", study.design.indices)},
                                       {"/rows", study.needed_rows_only ? "needed" : "all"}})
    keys.emplace_back(key, value);
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const StudyAxis& axis = study.axes[a];
    const std::string at = fmt::format("/axes/{}", a);
    keys.emplace_back(at + "/name", axis.name);
    keys.emplace_back(at + "/pointers", fmt::format("{}", fmt::join(axis.pointers, " ")));
    if (axis.range) {
      const std::string range = at + (axis.range->logarithmic ? "/log_range" : "/range");
      keys.emplace_back(range + "/from", fmt::format("{}", fmt::join(axis.range->from, " ")));
      keys.emplace_back(range + "/to", fmt::format("{}", fmt::join(axis.range->to, " ")));
      keys.emplace_back(range + "/points", fmt::format("{}", axis.range->points));
    } else {
      for (std::size_t i = 0; i < axis.levels.size(); ++i)
        keys.emplace_back(fmt::format("{}/values/{}", at, i), level_text(axis.levels[i]));
    }
  }
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    const StudyQuantity& quantity = study.quantities[q];
    keys.emplace_back(fmt::format("/collect/{}", q),
                      quantity.name == quantity.path ? quantity.path : quantity.name + " = " + quantity.path);
  }
  return keys;
}

std::string shortened(const std::string& value) {
  constexpr std::size_t kLongest = 40;
  return printable(value.size() > kLongest ? value.substr(0, kLongest) + "..." : value);
}

/// The first half of a scenario's SHA-256: enough to tell the points of any study apart.
using Half = std::array<std::uint64_t, 2>;
Half half_of(std::string_view sha256) {
  Half half{};
  for (std::size_t i = 0; i < half.size() && sha256.size() >= 16 * (i + 1); ++i)
    std::from_chars(sha256.data() + 16 * i, sha256.data() + 16 * (i + 1), half[i], 16);
  return half;
}

struct OldPoint {
  Half half;
  std::uint64_t number;
  bool fits;     // its run was completed, or would end in the same way
  bool is_kept;  // the new design has it
  bool operator<(const OldPoint& other) const { return half != other.half ? half < other.half : number < other.number; }
};

using OldPoints = std::vector<OldPoint>;

std::pair<OldPoints::iterator, OldPoints::iterator> found(OldPoints& points, std::string_view sha256) {
  const Half half = half_of(sha256);
  return {std::lower_bound(points.begin(), points.end(), half, [](const OldPoint& p, const Half& h) { return p.half < h; }),
          std::upper_bound(points.begin(), points.end(), half, [](const Half& h, const OldPoint& p) { return h < p.half; })};
}

/// Whether a quantity may tell of words of the base that are not part of a scenario's identity.
bool tells_of_words(const StudyQuantity& quantity) {
  const std::string section = quantity.path.substr(0, quantity.path.find('.'));
  return section == "name" || section == "title" || section == "purpose" || section == "scenario" || section == "provenance";
}

}  // namespace

std::string difference(const Study& there, const Study& here) {
  const Keys a = keys_of(there), b = keys_of(here);
  const std::map<std::string, std::string> in_a(a.begin(), a.end()), in_b(b.begin(), b.end());
  const auto value = [](const std::map<std::string, std::string>& keys, const std::string& key) {
    const auto at = keys.find(key);
    return at == keys.end() ? std::string("none") : shortened(at->second);
  };
  // What makes other scenarios comes first: it is why no point is shared.
  std::vector<std::string> keys;
  for (const bool of_scenario : {true, false})
    for (const Keys* list : {&b, &a})
      for (const auto& [key, unused] : *list) {
        if ((key.starts_with("/base") || key.starts_with("/set")) != of_scenario) continue;
        const auto at_a = in_a.find(key), at_b = in_b.find(key);
        const bool differs = at_a == in_a.end() || at_b == in_b.end() || at_a->second != at_b->second;
        if (differs && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
      }
  constexpr std::size_t kNamed = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(keys.size(), kNamed); ++i)
    text += fmt::format("{}{}: {} there, {} here", i > 0 ? "; " : "", shortened(keys[i]), value(in_a, keys[i]),
                        value(in_b, keys[i]));
  return keys.size() > kNamed ? text + fmt::format("; and {} more keys", keys.size() - kNamed) : text;
}

std::optional<Study> united(const Study& one, const Study& other) {
  if (one.design.kind != DesignKind::grid || other.design.kind != DesignKind::grid || one.axes.size() != other.axes.size())
    return std::nullopt;
  std::optional<std::size_t> unlike;
  for (std::size_t a = 0; a < one.axes.size(); ++a) {
    if (one.axes[a].levels == other.axes[a].levels) continue;
    if (unlike || one.axes[a].range || other.axes[a].range) return std::nullopt;
    unlike = a;
  }
  if (!unlike) return std::nullopt;
  // What else differs is for the comparison of the points to find.
  std::vector<std::vector<std::string>> levels = one.axes[*unlike].levels;
  const auto number = [](const std::vector<std::string>& level) {
    const Value value = read_value(level.front());
    return std::holds_alternative<double>(value) ? std::get<double>(value) : std::numeric_limits<double>::quiet_NaN();
  };
  const auto ascends = [&](const std::vector<std::vector<std::string>>& list) {
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!(i == 0 ? number(list[0]) == number(list[0]) : number(list[i - 1]) < number(list[i]))) return false;
    return true;
  };
  const bool both_ascend = ascends(levels) && ascends(other.axes[*unlike].levels);
  for (const auto& level : other.axes[*unlike].levels)
    if (std::none_of(levels.begin(), levels.end(), [&](const auto& known) { return level_text(known) == level_text(level); }))
      levels.push_back(level);
  if (both_ascend) std::sort(levels.begin(), levels.end(), [&](const auto& a, const auto& b) { return number(a) < number(b); });
  Json values = Json::array();
  for (const auto& level : levels) {
    Json each = Json::array();
    for (const std::string& value : level) each.push_back(Json::parse(value));
    values.push_back(level.size() == 1 ? each.front() : each);
  }
  Json text = Json::parse(one.text, nullptr, false, true);
  if (text.is_discarded()) return std::nullopt;
  text[Json::json_pointer(fmt::format("/axes/{}/values", *unlike))] = std::move(values);
  Study both = parse_study({one.name + ".json", text.dump(2) + "\n"}, one.base);
  both.name = one.name;
  return both;
}

SharedPoints shared_points(Store& older, const Study& study, const StudyShard& shard, const std::string& build,
                           const Watch& watch) {
  const Study& old = older.study();
  const std::uint64_t count = point_count(study).value_or(0);
  SharedPoints shared;
  shared.growth.points = count < shard.k ? 0 : (count - shard.k) / shard.n + 1;
  const bool same_stop = old.limits.stops_beyond_estimate == study.limits.stops_beyond_estimate;
  OldPoints points;
  older.for_each([&](const PointResult& point) {
    if (!point.scenario_sha256.empty())
      points.push_back({half_of(point.scenario_sha256), point.number, same_stop || !point.failed(), false});
  });
  std::sort(points.begin(), points.end());
  shared.growth.held = points.size();

  // What the older store does not tell is told by no copy.
  std::string missing;
  const bool same_words = old.base.text == study.base.text && old.set == study.set;
  for (const StudyQuantity& quantity : study.quantities) {
    const auto at = std::find_if(old.quantities.begin(), old.quantities.end(),
                                 [&](const StudyQuantity& q) { return q.path == quantity.path; });
    if (at == old.quantities.end() || (!same_words && tells_of_words(quantity)))
      missing = missing.empty() ? quantity.path : missing;
    else
      shared.columns.push_back(static_cast<std::size_t>(at - old.quantities.begin()));
  }
  const Collector now(study);
  const Collector then_as_it_was(old);
  Study as_then = study;
  as_then.quantities = old.quantities;
  as_then.needed_rows_only = old.needed_rows_only;
  as_then.limits = old.limits;
  const Collector then(as_then);
  const bool asks_alike = now.asks_like(then), looks_alike = now.looks_between() == then_as_it_was.looks_between();
  const bool same_build = !build.empty() && older.build() == build;
  const bool may_copy = missing.empty() && same_build && looks_alike;

  Design design(study);
  std::uint64_t in_both = 0;
  for (std::uint64_t number = shard.k - 1; number < count && !points.empty(); number += shard.n) {
    if (watch.asks_to_stop()) throw Interrupted();
    const auto changes = point_changes(study, design.point(number));
    std::string refusal;
    const auto scene = now.scene(changes, refusal);
    if (!scene) continue;
    const auto [first, last] = found(points, scene->sha256());
    if (may_copy && first != last && first->fits) shared.pairs.emplace_back(number, first->number);
    if (asks_alike) {
      in_both += first != last;
      for (auto at = first; at != last; ++at) at->is_kept = true;
    } else if (const auto earlier = then.scene(changes, refusal)) {
      const auto [first_then, last_then] = found(points, earlier->sha256());
      in_both += first_then != last_then;
      for (auto at = first_then; at != last_then; ++at) at->is_kept = true;
    }
  }
  for (const OldPoint& point : points) shared.growth.left_out += !point.is_kept;
  shared.growth.reused = shared.pairs.size();
  shared.of_quantities =
      in_both > 0 && shared.pairs.empty() && same_build &&
      (!missing.empty() || (old.needed_rows_only == study.needed_rows_only && (!asks_alike || !looks_alike)));

  std::string& why = shared.growth.why;
  if (in_both == 0) {
    const bool cube = study.design.kind == DesignKind::latin_hypercube && old.design.kind == DesignKind::latin_hypercube;
    why = cube && old.design.points != study.design.points ? "a Latin hypercube of another length shares no point"
                                                           : "the designs share no point";
  } else if (!same_build) {
    why = older.build().empty() ? "several versions of earthtop computed them"
                                : fmt::format("another version of earthtop computed them ({})", older.build());
  } else if (!missing.empty()) {
    why = fmt::format("{} was not collected, so every point is computed again", missing);
  } else if (shared.pairs.empty() && !asks_alike) {
    why = "the points need other rows or derivatives now, so every point is computed again";
  } else if (!looks_alike) {
    why = "the motion between the rows is looked at otherwise now, so every point is computed again";
  }
  return shared;
}

std::uint64_t copy_shared(const SharedPoints& shared, Store& older, const Study& study, Store& store) {
  Design design(study);
  std::uint64_t copied = 0;
  constexpr std::uint64_t kAhead = 4096;
  std::vector<std::uint64_t> known;
  std::uint64_t known_until = 0;
  for (const auto& [number, old_number] : shared.pairs) {
    if (number >= known_until) {
      known_until = number + kAhead;
      known = store.numbers(number, known_until);
    }
    if (std::binary_search(known.begin(), known.end(), number)) continue;
    std::optional<PointResult> point = older.point(old_number);
    if (!point) continue;
    const std::vector<Value> values = std::move(point->values);
    point->number = number;
    const PlannedPoint planned = design.point(number);
    point->axis_values.clear();
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      point->axis_values.push_back(axis_value(study.axes[a], planned.settings[a]));
    point->values.clear();
    for (const std::size_t column : shared.columns) point->values.push_back(values[column]);
    store.insert(*point);
    ++copied;
  }
  return copied;
}

}  // namespace earthtop::study
