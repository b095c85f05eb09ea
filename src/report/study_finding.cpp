// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study_finding.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

#include "text/json.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

bool is_bound(const StudyColumn& quantity) { return quantity.where.find("bound") != quantity.where.npos; }

double number_at(const Json& json, const char* key) {
  const Json value = json.value(key, Json());
  return value.is_number() ? value.get<double>() : NAN;
}

}  // namespace

// The first quantity with numbers: none of the bounds, where there is another.
std::optional<StudyColumn> quantity_told(const Json& study) {
  std::optional<StudyColumn> found;
  const Json statistics = study.value("statistics", Json::object());
  for (const StudyColumn& quantity : quantities_of(study)) {
    if (!statistics.contains(quantity.key)) continue;
    if (!is_bound(quantity)) return quantity;
    if (!found) found = quantity;
  }
  return found;
}

namespace {

/// The largest error bound of a drift, where the study collects it: "drift.axis_bound_rad" of "drift.axis_final_rad".
std::optional<double> bound_of(const Json& study, const StudyColumn& told) {
  const Json statistics = study.value("statistics", Json::object());
  for (const StudyColumn& quantity : quantities_of(study)) {
    const std::size_t end = quantity.where.find("_bound");
    if (end == quantity.where.npos || is_bound(told) || !statistics.contains(quantity.key)) continue;
    const std::size_t unit = quantity.where.rfind('_'), unit_told = told.where.rfind('_');
    const bool same_unit = unit_told != told.where.npos && quantity.where.substr(unit) == told.where.substr(unit_told);
    // The bound of the axis holds for its largest drift and for the last one, but not for its azimuth or tilt.
    if (same_unit && told.where.starts_with(quantity.where.substr(0, end) + "_"))
      return number_at(statistics.at(quantity.key), "max");
  }
  return std::nullopt;
}

/// A number of the told quantity, with as many digits as tell it from another. An angle far smaller than the other has a unit of its size.
std::string apart(const StudyColumn& quantity, double one, double other) {
  const auto digits = [&](int count) {
    return std::pair(fmt::format("{:.{}g}", one * quantity.factor, count),
                     fmt::format("{:.{}g}", other * quantity.factor, count));
  };
  constexpr double kFar = 100;
  if (quantity.is_angle && one != 0 && kFar * std::abs(one) < std::abs(other)) return quantity.in_own_unit(one).text(one);
  int count = 4;
  while (count < 15 && one != other && digits(count).first == digits(count).second) ++count;
  return quantity.text(one, count);
}

/// The levels of a setting in ascending order where they are numbers; none where they do not tell points apart: keys that vary together
/// are known by the first one only.
std::vector<Level> levels_of(const Json& study, std::size_t axis, const StudyColumn& setting, const StudyColumn& quantity) {
  std::vector<Level> levels;
  const Json rows = study.value("marginals", Json::object()).value(setting.key, Json::array());
  const Json given = study.at("axes").at(axis).value("values", Json());
  if (given.is_array() && given.size() != rows.size() && study.at("axes").at(axis).value("pointers", Json::array()).size() > 1)
    return {};
  for (const Json& row : rows) {
    const Json of = row.value(quantity.key, Json());
    if (!of.is_object()) continue;
    const Json value = row.value("value", Json());
    Level level{value.is_string() ? value.get<std::string>() : value.dump(), {}, number_at(of, "mean"), number_at(of, "count")};
    char* end = nullptr;
    const double place = std::strtod(level.name.c_str(), &end);
    if (!level.name.empty() && *end == '\0') {
      level.place = place;
      level.name = setting.text(place);
    }
    levels.push_back(std::move(level));
  }
  if (std::all_of(levels.begin(), levels.end(), [](const Level& level) { return level.place.has_value(); }))
    std::sort(levels.begin(), levels.end(),
              [](const Level& a, const Level& b) { return a.place.value_or(0) < b.place.value_or(0); });
  return levels;
}

struct LeastAndMost {
  const Level *least, *most;
  double spread() const { return most->mean - least->mean; }
};
LeastAndMost extremes_of(const std::vector<Level>& levels) {
  const auto [least, most] =
      std::minmax_element(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.mean < b.mean; });
  return {&*least, &*most};
}

/// "falls from 320″ at 10° to 40″ at 80°"; where it turns back on the way, "is least, 3″, at 0°, and largest, 320″, at 90°".
std::string course(const std::vector<Level>& levels, const StudyColumn& quantity) {
  const auto [least, most] = extremes_of(levels);
  const bool ordered = levels.front().place.has_value();
  const auto rises = [](const Level& a, const Level& b) { return a.mean < b.mean; };
  const bool up = ordered && std::is_sorted(levels.begin(), levels.end(), rises);
  const bool down = ordered && std::is_sorted(levels.rbegin(), levels.rend(), rises);
  const std::string low = apart(quantity, least->mean, most->mean), high = apart(quantity, most->mean, least->mean);
  if (up) return fmt::format("rises from {} at {} to {} at {}", low, levels.front().name, high, levels.back().name);
  if (down) return fmt::format("falls from {} at {} to {} at {}", high, levels.front().name, low, levels.back().name);
  return fmt::format("is least, {}, at {} and largest, {}, at {}", low, least->name, high, most->name);
}

/// The setting along which the mean over all others moves most.
std::optional<ToldMeans> most_moving(const Json& study, const StudyColumn& quantity) {
  std::optional<ToldMeans> chosen;
  const std::vector<StudyColumn> settings = settings_of(study);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    std::vector<Level> levels = levels_of(study, i, settings[i], quantity);
    if (levels.size() < 2) continue;
    if (!chosen || extremes_of(levels).spread() > extremes_of(chosen->levels).spread())
      chosen = ToldMeans{quantity, settings[i], std::move(levels)};
  }
  if (chosen && !(extremes_of(chosen->levels).spread() > 0)) chosen.reset();
  return chosen;
}

std::string grid_finding(const Json& study, const StudyColumn& quantity, double least, double most) {
  const auto chosen = most_moving(study, quantity);
  if (!chosen)
    return fmt::format("The {} lies between {} and {}", quantity.words, apart(quantity, least, most),
                       apart(quantity, most, least));
  if (settings_of(study).size() == 1)
    return fmt::format("With the {}, the {} {}", chosen->setting.words, quantity.words, course(chosen->levels, quantity));
  return fmt::format("The {} depends most on the {}: on average over the other settings it {}", quantity.words,
                     chosen->setting.words, course(chosen->levels, quantity));
}

/// The point where no setting is changed; null where the document does not list it.
const Json* unchanged_point(const Json& study, const std::vector<StudyColumn>& settings) {
  const auto points = study.find("points");
  if (points == study.end() || !points->is_array()) return nullptr;  // there are more than a document lists
  for (const Json& point : *points)
    if (std::all_of(settings.begin(), settings.end(), [&](const auto& s) { return point.value(s.key, Json()).is_null(); }))
      return &point;
  return nullptr;
}

/// Returns, among settings that are changed one at a time, the one whose change moves the quantity most from the point where none is changed.
std::string one_by_one_finding(const Json& study, const StudyColumn& quantity, double least, double most) {
  const std::vector<StudyColumn> settings = settings_of(study);
  const auto value_of = [&](const Json& point) { return number_at(point, quantity.key.c_str()); };
  const Json* base = unchanged_point(study, settings);
  const Json* farthest = nullptr;
  if (base)
    for (const Json& point : study.at("points"))
      if (std::isfinite(value_of(point)) &&
          (!farthest || std::abs(value_of(point) - value_of(*base)) > std::abs(value_of(*farthest) - value_of(*base))))
        farthest = &point;
  if (!base || !farthest || !std::isfinite(value_of(*base)) || farthest == base)
    return fmt::format("With one setting changed at a time, the {} lies between {} and {}", quantity.words,
                       apart(quantity, least, most), apart(quantity, most, least));
  for (const StudyColumn& setting : settings) {
    const Json value = farthest->value(setting.key, Json());
    if (value.is_null()) continue;
    const double from = value_of(*base), to = value_of(*farthest);
    return fmt::format("Of {} settings changed one at a time, the {} moves the {} most: from {} to {}, at {}", settings.size(),
                       setting.words, quantity.words, apart(quantity, from, to), apart(quantity, to, from),
                       value.is_number()   ? setting.text(value.get<double>())
                       : value.is_string() ? value.get<std::string>()
                                           : value.dump());
  }
  return "";
}

/// The setting that most of the spread of drawn points comes from, in a clause.
std::string source_of_spread(const Json& study, const StudyColumn& quantity) {
  const std::vector<StudyColumn> settings = settings_of(study);
  if (settings.size() < 2) return "";
  const Json indices = study.value("indices", Json::object()).value(quantity.key, Json());
  const StudyColumn* most = nullptr;
  double share = 0, error = 0;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    double of = 0, of_error = 0;
    if (indices.is_object()) {
      const Json index = indices.value(settings[i].key, Json::object());
      of = number_at(index, "total_order"), of_error = number_at(index, "total_order_standard_error");
    } else {
      // Between the means of parts of the setting's range; as much as this would be there by chance.
      double count = 0, sum = 0, between = 0;
      const std::vector<Level> levels = levels_of(study, i, settings[i], quantity);
      for (const Level& level : levels) count += level.count, sum += level.count * level.mean;
      for (const Level& level : levels) between += level.count * (level.mean - sum / count) * (level.mean - sum / count);
      const double deviation = number_at(study.at("statistics").at(quantity.key), "standard_deviation");
      of = between / ((count - 1) * deviation * deviation);
      of_error = levels.empty() ? 0 : static_cast<double>(levels.size() - 1) / (count - 1);
    }
    if (std::isfinite(of) && of > share) most = &settings[i], share = of, error = of_error;
  }
  constexpr double kErrors = 3;
  if (!most || !(share > kErrors * error)) return "; the points do not tell which setting that comes from";
  return fmt::format("; most of that comes from the {}", most->words);
}

std::string drawn_finding(const Json& study, const StudyColumn& quantity, const Json& statistics) {
  const double low = number_at(statistics, "quantile_05"), high = number_at(statistics, "quantile_95"),
               median = number_at(statistics, "median");
  if (!std::isfinite(low) || !std::isfinite(high) || !std::isfinite(median)) return "";
  return fmt::format("The {} has a median of {}, and nine tenths of it lie between {} and {}{}", quantity.words,
                     quantity.text(median), apart(quantity, low, high), apart(quantity, high, low),
                     source_of_spread(study, quantity));
}

std::string counted_points(std::uint64_t count) { return count == 1 ? "1 point" : fmt::format("{} points", count); }

}  // namespace

std::optional<ToldMeans> told_means(const Json& study) {
  const auto quantity = quantity_told(study);
  if (!quantity) return std::nullopt;
  if (study.value("design", Json::object()).value("kind", "grid") != "one_at_a_time") return most_moving(study, *quantity);
  const std::vector<StudyColumn> settings = settings_of(study);
  const Json* base = unchanged_point(study, settings);
  const double from = base ? number_at(*base, quantity->key.c_str()) : NAN;
  if (!std::isfinite(from)) return std::nullopt;
  ToldMeans changes{*quantity, StudyColumn{}, {}};
  for (std::size_t i = 0; i < settings.size(); ++i)
    for (const Level& level : levels_of(study, i, settings[i], *quantity))
      changes.levels.push_back({settings[i].words, {}, level.mean - from, level.count});
  if (changes.levels.size() < 2 || !(extremes_of(changes.levels).spread() > 0)) return std::nullopt;
  return changes;
}

std::string study_finding(const Json& study) {
  const std::uint64_t computed = count_in(study.at("points_computed")), failed = count_in(study.at("points_failed"));
  if (computed == 0) return "No point of this study has been computed yet";
  if (failed == computed)
    return fmt::format("{} failed: there is nothing to tell",
                       computed == 1 ? "The only point" : fmt::format("All {} points", computed));
  const auto quantity = quantity_told(study);
  if (!quantity) return "No point has a number of what this study collects";
  const Json& statistics = study.at("statistics").at(quantity->key);
  const double least = number_at(statistics, "min"), most = number_at(statistics, "max");
  const auto count = static_cast<std::uint64_t>(number_at(statistics, "count"));
  if (count == 1) return fmt::format("The {} is {} at the only point that has it", quantity->words, quantity->text(most));
  if (least == most)
    return fmt::format("The {} is {} at all {} points that have it", quantity->words, quantity->text(most), count);
  if (const auto bound = bound_of(study, *quantity); bound && most - least <= 2 * *bound)
    return fmt::format("The {} is {} at all {} points, as far as its error bound tells", quantity->words, quantity->text(most),
                       count);
  const std::string kind = study.value("design", Json::object()).value("kind", "grid");
  std::string found;
  if (kind == "one_at_a_time")
    found = one_by_one_finding(study, *quantity, least, most);
  else if (kind != "grid")
    found = drawn_finding(study, *quantity, statistics);
  return found.empty() ? grid_finding(study, *quantity, least, most) : found;
}

std::string study_certainty(const Json& study) {
  const std::uint64_t failed = count_in(study.at("points_failed")), computed = count_in(study.at("points_computed")),
                      planned = count_in(study.at("points_planned"));
  std::string text = computed == planned ? fmt::format("All {} are computed", counted_points(planned))
                                         : fmt::format("{} of {} are computed so far", computed, counted_points(planned));
  if (planned == 1 && computed == 1) text = "The only point is computed";
  if (failed > 0) text += fmt::format("; {} of them failed and {} left out", failed, failed == 1 ? "is" : "are");
  std::uint64_t reliable = 0, judged = 0;
  const Json points = study.value("points", Json());
  for (const StudyColumn& quantity : quantities_of(study)) {
    if (quantity.where != "drift.verdict" || !points.is_array()) continue;
    for (const Json& point : points) {
      const Json verdict = point.value(quantity.key, Json());
      judged += verdict.is_string() ? 1 : 0, reliable += verdict == "reliable" ? 1 : 0;
    }
  }
  if (judged > 0 && judged == reliable) text += "; the drift is reliable at all of them";
  if (judged > reliable) text += fmt::format("; the drift is reliable at {} of {}", reliable, judged);
  const auto quantity = quantity_told(study);
  if (!quantity) return text + ".";
  const auto with_value = static_cast<std::uint64_t>(number_at(study.at("statistics").at(quantity->key), "count"));
  if (with_value + failed < computed)
    text += fmt::format("; {} without a {}", counted_points(computed - failed - with_value), quantity->words);
  if (const auto bound = bound_of(study, *quantity)) {
    text += "; the error is at most " + (quantity->is_angle ? quantity->in_own_unit(*bound) : *quantity).text(*bound, 2);
  }
  return text + ".";
}

}  // namespace earthtop::report
