// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/diagnosis.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/evidence.hpp"
#include "compare/explanation.hpp"
#include "compare/physics_search.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/frames/earth.hpp"
#include "text/json.hpp"
#include "text/number_words.hpp"

namespace earthtop::compare {
namespace {

constexpr double kLeast_rad = 1e-8, kWithoutEarth_rad = 1e-6;
constexpr double kLeastOfRate = 1e-8, kWithoutEarthOfRate = 1e-6;  // of the largest rate
constexpr double kSurely = 1e-3;          // a mistake that leaves no more needs no comparison with others
constexpr double kLeastRounding = 1e-12;  // rad, or of the rates: smaller differences are those of any computation

/// Finds what explains the differences, in sentences. @param now  the differences
std::vector<std::string> explanations(const Explainer& explainer, const std::optional<Scene>& scene, const Explanation& now,
                                      const Watch& watch) {
  const Reader& reader = explainer.reader();
  const Tops& reference = explainer.evidence().reference;
  const auto by_reading = [&](const Explanation& one) {
    return fmt::format("the new result agrees to {} if {}", explainer.left_words(one.left),
                       explainer.if_words(one.reading, ""));
  };
  Explanation best = explainer.best_reading(reader.mapped(), reference);
  const std::vector<Reading> likely = explainer.likely_readings();
  for (const Reading& reading : likely) {
    const Explanation one = explainer.best_reading(reading, reference);
    if (one.ratio * kAlike < best.ratio) best = one;
  }
  // Several other conventions at once may look like a mistake in physics, and are less likely.
  const std::size_t changes = reader.words(best.reading).size();
  const bool is_read = best.ratio <= 1, is_simple = is_read && changes == 1;
  if (is_simple && best.ratio <= kSurely) return {by_reading(best)};
  std::optional<PhysicsSearch> physics;
  if (scene) physics.emplace(explainer, *scene, now.ratio, watch);
  const bool has_physics = physics && physics->predicts_reference();
  if (has_physics) {
    const NamedMistake named = physics->by_name(reader.mapped());
    if (!named.sentences.empty() && (!is_simple || named.ratio * kAlike < best.ratio)) return named.sentences;
  }
  if (is_read) return {by_reading(best)};
  std::vector<Reading> readings = {reader.mapped()};
  for (const Reading& reading : likely)
    if (reading.later == 0) readings.push_back(reading);
  if (has_physics)
    if (auto found = physics->further(readings); !found.empty()) return found;
  const char* rest = has_physics ? "; no single mistake explains the rest" : "";
  if (has_physics && physics->nearest().ratio * kAlike < best.ratio) return {physics->nearest().sentences.front() + rest};
  const bool mostly = best.ratio <= kExplainsMost * now.ratio && best.reading != reader.mapped();
  if (mostly) return {by_reading(best) + rest};
  return has_physics ? std::vector<std::string>{"no single mistake explains this"} : std::vector<std::string>();
}

/// Returns by how much another program may differ, for each measure.
ByMeasure tolerance_of(const Evidence& evidence, const RowsComparison& rows) {
  const bool has_effect = evidence.effect.attitude > 0 || evidence.effect.axis > 0;
  const auto angle = [&](double effect) { return has_effect ? std::max(kOfEffect * effect, kLeast_rad) : kWithoutEarth_rad; };
  ByMeasure tolerance{angle(evidence.effect.attitude), angle(evidence.effect.axis),
                      has_effect ? std::max(kOfEffect * evidence.effect.rates, kLeastOfRate * evidence.largest_rate)
                                 : kWithoutEarthOfRate * evidence.largest_rate};
  for (const QuantityVerdict& quantity : rows.quantities)
    for (const auto& [name, one] :
         {std::pair("attitude_rad", &tolerance.attitude), {"axis_rad", &tolerance.axis}, {"rates_rad_s", &tolerance.rates}})
      if (quantity.name == name) *one = std::max(*one, 2 * quantity.interpolation_error.value_or(0));
  return tolerance;
}

/// The factor by which a file's times have to be multiplied, as its last time says, and a sentence on it.
std::pair<double, std::vector<std::string>> time_unit(double file_last_s, double reference_last_s, const Mapping& mapping) {
  constexpr double kOtherUnit = 1.5, kNear = 0.05;
  const double times = reference_last_s > 0 ? file_last_s / reference_last_s : 0;
  if (!(times > 0) || std::max(times, 1 / times) < kOtherUnit) return {1, {}};
  if (const auto unit = time_unit_for(mapping.time_unit_s, times))
    return {unit->value / mapping.time_unit_s,
            {fmt::format("its last time is {:.6g} times the reference's: its times are in {} (time.unit of the mapping)", times,
                         unit->word)}};
  for (const double ratio : {1e3, 60.0, 3600.0})
    if (std::abs(times / ratio - 1) < kNear || std::abs(times * ratio - 1) < kNear)
      return {1, {fmt::format("its last time is {:.6g} times the reference's: are its times in another unit?", times)}};
  return {1, {}};
}

}  // namespace

std::optional<Scene> scene_of(const Comparand& reference) {
  if (!reference.has_summary() || !reference.summary->contains("scenario")) return std::nullopt;
  return examine_scenario({"", written(reference.summary->at("scenario")), false}).scene;
}

std::vector<std::string> other_time_unit(const Comparand& reference, const Comparand& candidate, const Mapping& mapping,
                                         const CompareOptions& options) {
  const auto rows = reference.open_rows();
  const Watch watch = options.watch.part(0, 0);
  const Survey known = survey(*rows, trajectory_table(), false, watch);
  const Evidence evidence = gather(reference, candidate, known, mapping, 1, options.until_s, watch);
  return time_unit(evidence.last_s, known.last_s, mapping).second;
}

std::vector<std::string> diagnose(const Comparand& reference, const Comparand& candidate, const Mapping& mapping,
                                  const RowsComparison& rows, const CompareOptions& options) {
  const auto surveyed = reference.open_rows();
  const Watch watch = options.watch.part(0, 0);
  const Survey known = survey(*surveyed, trajectory_table(), false, watch);
  Evidence evidence = gather(reference, candidate, known, mapping, 1, options.until_s, watch);
  auto [factor, found] = time_unit(evidence.last_s, known.last_s, mapping);
  if (factor != 1) evidence = gather(reference, candidate, known, mapping, factor, options.until_s, watch);
  // The axis of a file that has attitudes alone follows from them.
  if (mapping.quaternion && !mapping.axis) evidence.axis = false;
  if (evidence.zeros > 0)
    found.push_back(fmt::format("{} of its {} quaternions are zero, the first one at t = {}: rows that were never filled?",
                                evidence.zeros, evidence.rows, time_text(evidence.first_zero_s)));
  if (evidence.size() == 0 || !(evidence.attitude || evidence.axis || evidence.rates)) return found;
  const double norm_error = std::max(std::abs(evidence.least_norm - 1), std::abs(evidence.largest_norm - 1));
  constexpr double kUnitNorm = 1e-7;
  if (evidence.attitude && norm_error > std::max(kUnitNorm, evidence.rounding.attitude))
    found.push_back(fmt::format("its quaternions have lengths from {:.6g} to {:.6g}, and not 1; normalise them",
                                evidence.least_norm, evidence.largest_norm));
  ByMeasure tolerance = tolerance_of(evidence, rows);
  const std::optional<Scene> scene = candidate.has_summary() ? std::nullopt : scene_of(reference);
  const Eigen::Vector3d rate_IL_L =
      scene ? Eigen::Vector3d(scene->rotation_rate_rad_s() * celestial_axis_L<double>(scene->site()))
            : Eigen::Vector3d(0, 0, 0);
  const auto as_mapped = [&](const Explainer& explainer) {
    return explainer.explained(explainer.reader().mapped(), evidence.reference);
  };
  const Explanation now = as_mapped(Explainer(evidence, mapping, tolerance, rate_IL_L));
  const ByMeasure& rounding = evidence.rounding;
  const auto is_explained = [](double left, double by, double besides) { return left <= 2 * by + besides; };
  const bool is_rounded =
      is_explained(now.left.attitude, rounding.attitude, tolerance.attitude) &&
      is_explained(now.left.axis, rounding.axis, tolerance.axis) &&
      is_explained(now.left.rates, rounding.rates, tolerance.rates) &&
      ((now.left.attitude > kLeastRounding && is_explained(now.left.attitude, rounding.attitude, 0)) ||
       (now.left.axis > kLeastRounding && is_explained(now.left.axis, rounding.axis, 0)) ||
       (now.left.rates > kLeastRounding * evidence.largest_rate && is_explained(now.left.rates, rounding.rates, 0)));
  if (is_rounded) {
    found.push_back(
        fmt::format("its numbers have {} digits, and their rounding, up to {:.2g} rad, explains the differences; write 17",
                    evidence.digits, std::max(rounding.attitude, rounding.axis)));
    return found;
  }
  if (now.ratio <= 1) return found;
  const bool is_coarse = 2 * rounding.attitude > tolerance.attitude || 2 * rounding.axis > tolerance.axis;
  for (auto [one, other] : {std::pair(&tolerance.attitude, rounding.attitude),
                            {&tolerance.axis, rounding.axis},
                            {&tolerance.rates, rounding.rates}})
    *one = std::max(*one, 2 * other);
  const Explainer explainer(evidence, mapping, tolerance, rate_IL_L);
  const Explanation rest = as_mapped(explainer);
  if (rest.ratio <= 1) return found;
  const std::vector<std::string> more = explanations(explainer, scene, rest, watch);
  found.insert(found.end(), more.begin(), more.end());
  if (is_coarse && !more.empty() && more.back().find("no single mistake") == std::string::npos)
    found.push_back(fmt::format("its numbers have {} digits, and what is left is their rounding; write 17", evidence.digits));
  return found;
}

}  // namespace earthtop::compare
