// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/influence.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "earthtop/elementary.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/study/indices_note.hpp"
#include "study/design.hpp"
#include "study/gathering.hpp"

namespace earthtop::study {
namespace {

constexpr double kErrors = 2;                                       // standard errors beyond which a difference counts
constexpr double kMostOfIt = 0.5;                                   // share of the variance from which on an input decides
constexpr double kHardlyAny = 0.01;                                 // total index below which an input is not worth more points
constexpr std::uint64_t kMostBasePoints = std::uint64_t{1} << 29U;  // the last power of two that a Sobol sequence reaches

/// A share of the variance with its error, to the first digit of that and at least the second behind the point.
std::string share_text(double share, double error) {
  const int digits = error > 0 ? std::clamp(static_cast<int>(std::ceil(-real::log10(error))), 2, 6) : 2;
  if (error > 0 && error < 1e-6) return fmt::format("{:.6f} +- {:.0e}", share, error);
  return fmt::format("{:.{}f} +- {:.{}f}", share, digits, error, digits);
}

/// "a", "a and b", "a, b and c".
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

struct Difference {
  double size = 0, error = 0;
  bool is_seen() const { return size > kErrors * error; }
};

Difference between_totals(const InputIndex& larger, const InputIndex& smaller) {
  return {larger.index.total - smaller.index.total,
          real::hypot(larger.index.total_standard_error, smaller.index.total_standard_error)};
}

/// How many base points would show a difference, if it stays what it is: a power of two.
std::string would_do(const Difference& difference, std::uint64_t base_points) {
  constexpr const char* kUnknown = "and how many would do, they do not tell";
  const double ratio = kErrors * difference.error / difference.size;
  const double needed = static_cast<double>(base_points) * ratio * ratio;
  constexpr double kRounding = 1 - 1e-12;
  if (!(needed * kRounding <= static_cast<double>(kMostBasePoints))) return kUnknown;
  const auto least = std::max(static_cast<std::uint64_t>(std::ceil(needed * kRounding)), base_points + 1);
  const std::uint64_t power = std::bit_ceil(least);
  return power > kMostBasePoints ? kUnknown : fmt::format("{} would do", power);
}

/// The first place and, where that is decided among three or more, the second.
std::string places_text(const std::string& quantity, const std::vector<InputIndex>& sorted, std::uint64_t base_points) {
  const auto total_text = [](const InputIndex& input) {
    return share_text(input.index.total, input.index.total_standard_error);
  };
  const InputIndex& first = sorted.front();
  std::vector<std::string> rivals = {first.name}, totals = {total_text(first)};
  Difference hardest;
  double most = -1;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const Difference difference = between_totals(first, sorted[i]);
    if (difference.is_seen()) continue;
    rivals.push_back(sorted[i].name);
    totals.push_back(total_text(sorted[i]));
    const double effort = difference.size > 0 ? difference.error / difference.size : std::numeric_limits<double>::infinity();
    if (effort > most) most = effort, hardest = difference;
  }
  if (rivals.size() > 1)
    return fmt::format("which of {} matters most for {} is not decided (total indices {}): {} base points are too few, {}",
                       joined(rivals), quantity, joined(totals), base_points, would_do(hardest, base_points));
  const SobolIndex& index = first.index;
  std::string text = index.first - kErrors * index.first_standard_error > kMostOfIt
                         ? fmt::format("{} decides {} ({} of its variance)", first.name, quantity,
                                       share_text(index.first, index.first_standard_error))
                         : fmt::format("{} matters most for {} (total index {})", first.name, quantity, total_text(first));
  if (sorted.size() < 3) return text;
  const bool all_small = std::all_of(sorted.begin() + 1, sorted.end(), [](const InputIndex& input) {
    return input.index.total + kErrors * input.index.total_standard_error < kHardlyAny;
  });
  if (all_small) return text + fmt::format("; no other input has {} of it", kHardlyAny);
  const Difference second = between_totals(sorted[1], sorted[2]);
  if (second.is_seen()) return text + fmt::format("; second is {} (total index {})", sorted[1].name, total_text(sorted[1]));
  return text + fmt::format("; for second place {} base points are too few: {}", base_points, would_do(second, base_points));
}

/// The inputs that act together with others, as far as the errors tell.
std::string interactions_text(const std::vector<InputIndex>& sorted) {
  std::vector<std::string> names, shares;
  for (const InputIndex& input : sorted) {
    const Difference shared{input.index.total - input.index.first,
                            real::hypot(input.index.total_standard_error, input.index.first_standard_error)};
    if (!shared.is_seen()) continue;
    names.push_back(input.name);
    shares.push_back(share_text(shared.size, shared.error));
  }
  if (names.empty()) return "";
  if (names.size() == 1)
    return fmt::format("; {} acts together with other inputs, too: its total index exceeds its first by {}", names[0],
                       shares[0]);
  return fmt::format("; {} act together with other inputs, too: their total indices exceed their first by {}", joined(names),
                     joined(shares));
}

}  // namespace

std::string influence_sentence(const std::string& quantity, const std::vector<InputIndex>& inputs, const IndexBasis& basis) {
  std::vector<InputIndex> sorted = inputs;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const InputIndex& a, const InputIndex& b) { return a.index.total > b.index.total; });
  const std::string where = basis.left_out() ? "over what is left of the box, " : "";
  if (sorted.size() == 1) return where + fmt::format("{} is the only input of {}", sorted[0].name, quantity);
  return where + places_text(quantity, sorted, basis.used) + interactions_text(sorted);
}

std::string basis_text(const IndexBasis& basis) {
  if (basis.used == basis.planned) return fmt::format("from {} base points", basis.planned);
  return fmt::format("from {} of {} base points", basis.used, basis.planned);
}

namespace {
/// The share of the design's box where a quantity has no value: the share of the points, each of which is spread evenly over it.
std::string share_left_out(const IndexBasis& basis) {
  const double percent = 100 * static_cast<double>(basis.without_value) / static_cast<double>(basis.points);
  return fmt::format("about {} % of the box of the axes cannot exist ({} of {} points)",
                     percent < 10 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent), basis.without_value,
                     basis.points);
}
}  // namespace

std::string left_out_warning(const IndexBasis& basis) {
  if (!basis.left_out()) return "";
  return fmt::format(
      "{} of {} base points are left out, as they have points that failed or have no value. The indices are therefore those of "
      "another distribution than the design's: {}",
      basis.computed - basis.used, basis.computed, share_left_out(basis));
}

std::string no_indices_reason(const IndexBasis& basis) {
  if (basis.planned < kFewestBasePoints)
    return fmt::format("{} base points are too few for Sobol indices: at least {} are needed", basis.planned,
                       kFewestBasePoints);
  if (basis.used >= kFewestBasePoints) return "its values do not vary, or those of one base point only";
  std::string text = fmt::format("only {} of {} base points have all their values, and Sobol indices need at least {}",
                                 basis.used, basis.planned, kFewestBasePoints);
  if (basis.left_out()) text += "; " + share_left_out(basis);
  return text;
}

void add_sobol_indices(Store& store, const std::vector<Moments>& moments, const Watch& watch, Json& document) {
  const Study& study = store.study();
  const std::size_t inputs = study.axes.size(), quantities = study.quantities.size(), members = inputs + 2;
  std::vector<SobolSums> sums;
  sums.reserve(quantities);
  for (std::size_t q = 0; q < quantities; ++q) sums.emplace_back(inputs, moments[q].mean);
  IndexBasis all;
  all.planned = study.design.points;
  std::vector<IndexBasis> bases(quantities, all);
  std::vector<PointResult> block;
  bool any_completed = false;
  const auto value = [](const PointResult& point, std::size_t q) {
    return point.failed() ? std::nullopt : number_of(point.values[q]);
  };
  store.for_each([&](const PointResult& point) {
    if (watch.asks_to_stop()) throw Interrupted();
    any_completed = any_completed || !point.failed();
    for (std::size_t q = 0; q < quantities; ++q) {
      ++bases[q].points;
      if (!value(point, q)) ++bases[q].without_value;
    }
    if (!block.empty() && block.front().number / members != point.number / members) block.clear();
    block.push_back(point);
    if (block.size() < members) return;
    for (std::size_t q = 0; q < quantities; ++q) {
      ++bases[q].computed;
      std::vector<double> f;
      f.reserve(members);
      for (const PointResult& p : block)
        if (const auto y = value(p, q)) f.push_back(*y);
      if (f.size() < members) continue;
      ++bases[q].used;
      sums[q].include(f[0], f[1], {f.begin() + 2, f.end()});
    }
  });
  Json json = Json::object(), told = Json::object();
  for (std::size_t q = 0; q < quantities; ++q) {
    if (moments[q].count == 0 && any_completed) continue;  // words, or a number that no run has
    const std::string& name = study.quantities[q].name;
    const IndexBasis& basis = bases[q];
    Json& basis_of = told[name] = Json::object();
    basis_of["base_points"] = basis.planned;
    basis_of["base_points_computed"] = basis.computed;
    basis_of["base_points_used"] = basis.used;
    basis_of["points"] = basis.points;
    basis_of["points_without_value"] = basis.without_value;
    basis_of["share_without_value"] = static_cast<double>(basis.without_value) / static_cast<double>(basis.points);
    const auto indices = sums[q].indices();
    if (indices.empty()) {
      basis_of["no_indices"] = no_indices_reason(basis);
      continue;
    }
    basis_of["basis"] = basis_text(basis);
    if (basis.left_out()) basis_of["warning"] = left_out_warning(basis);
    Json& of = json[name] = Json::object();
    std::vector<InputIndex> named;
    for (std::size_t i = 0; i < inputs; ++i) {
      of[study.axes[i].name] = {{"first_order", indices[i].first},
                                {"first_order_standard_error", indices[i].first_standard_error},
                                {"total_order", indices[i].total},
                                {"total_order_standard_error", indices[i].total_standard_error}};
      named.push_back({study.axes[i].name, indices[i]});
    }
    basis_of["sentence"] = influence_sentence(name, named, basis);
  }
  document["indices"] = std::move(json);
  document["indices_basis"] = std::move(told);
  if (const std::string note = indices_note(study); !note.empty()) document["indices_note"] = note;
}

namespace {

/// A derivative of the drift that a study can collect: its name below an input, and the drift that it is of.
struct DerivativeOf {
  std::string_view member, path;
};
constexpr DerivativeOf kDerivatives[] = {{"d_axis_rad", "drift.axis_final_rad"},
                                         {"d_attitude_rad", "drift.attitude_final_rad"},
                                         {"d_tilt_rad", "drift.tilt_final_rad"},
                                         {"d_azimuth_rad", "drift.azimuth_final_rad"}};
constexpr std::string_view kInputsPath = "sensitivities.inputs.";

/// What a collected path has below an input of the sensitivities: "sensitivities.inputs.3.d_axis_rad".
struct InputPath {
  std::size_t input = 0;
  std::string_view member;
};
std::optional<InputPath> input_path(std::string_view path) {
  if (!path.starts_with(kInputsPath)) return std::nullopt;
  path.remove_prefix(kInputsPath.size());
  InputPath found;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), found.input);
  if (error != std::errc() || end == path.data() + path.size() || *end != '.') return std::nullopt;
  found.member = path.substr(static_cast<std::size_t>(end - path.data()) + 1);
  return found;
}

/// The numbers of a study's scenarios that the sensitivities are by, as JSON pointers in the order of their list, empty where an input
/// is no number of its own; from the first point that can be resolved.
std::vector<std::string_view> input_pointers(const Study& study) {
  constexpr std::uint64_t kTried = 20;
  try {
    const Collector collector(study);
    Design design(study);
    const std::uint64_t count = std::min(point_count(study).value_or(0), kTried);
    for (std::uint64_t number = 0; number < count; ++number) {
      const ScenarioReport report = collector.examine(point_changes(study, design.point(number)));
      if (!report.scenario) continue;
      std::vector<std::string_view> pointers;
      for (const std::size_t input : inputs_of(*report.scenario)) pointers.push_back(kInputs[input].of);
      return pointers;
    }
  } catch (const std::runtime_error&) {  // the base of an old store, or a file that it names, cannot be read today
  }
  return {};
}

std::size_t place_of_path(const Study& study, std::string_view path) {
  return static_cast<std::size_t>(
      std::find_if(study.quantities.begin(), study.quantities.end(), [&](const auto& q) { return q.path == path; }) -
      study.quantities.begin());
}

/// A derivative by one axis of a quantity, both collected: places of the quantities and of the axis, and the sums.
struct CollectedDerivative {
  std::size_t quantity, derivative, axis;
  DerivativeSums sums;
};

/// The derivative by the place in an axis's range, which goes from 0 to 1, from that by the number itself.
double per_range(const StudyAxis::Range& range, double derivative, double x) {
  const double from = range.from.front(), to = range.to.front();
  return range.logarithmic ? derivative * x * real::log(to / from) : derivative * (to - from);
}

}  // namespace

void add_derivative_indices(Store& store, const std::vector<Moments>& moments, const Watch& watch, Json& document) {
  const Study& study = store.study();
  const bool any = std::any_of(study.quantities.begin(), study.quantities.end(), [](const StudyQuantity& quantity) {
    const auto path = input_path(quantity.path);
    return path && std::any_of(std::begin(kDerivatives), std::end(kDerivatives),
                               [&](const DerivativeOf& of) { return path->member == of.member; });
  });
  if (!any) return;
  Json notes = Json::array();
  const std::vector<std::string_view> pointers = input_pointers(study);
  if (pointers.empty()) notes.push_back("there are no derivative-based indices, as none of the first points has a scenario");
  const bool drawn = study.design.kind != DesignKind::grid && study.design.kind != DesignKind::one_at_a_time;
  std::vector<CollectedDerivative> collected;
  for (std::size_t d = 0; d < study.quantities.size(); ++d) {
    const auto path = input_path(study.quantities[d].path);
    if (!path || path->input >= pointers.size()) continue;
    const auto of = std::find_if(std::begin(kDerivatives), std::end(kDerivatives),
                                 [&](const DerivativeOf& one) { return one.member == path->member; });
    if (of == std::end(kDerivatives)) continue;
    const auto axis = std::find_if(study.axes.begin(), study.axes.end(), [&](const StudyAxis& one) {
      return std::find(one.pointers.begin(), one.pointers.end(), pointers[path->input]) != one.pointers.end();
    });
    if (axis == study.axes.end()) continue;  // a derivative by a number that does not vary
    const std::size_t quantity = place_of_path(study, of->path);
    if (quantity == study.quantities.size())
      notes.push_back(
          fmt::format("{} gives no derivative-based index, as {} is not collected", study.quantities[d].name, of->path));
    else if (!drawn || !axis->range || axis->pointers.size() > 1)
      notes.push_back(fmt::format("{} gives no derivative-based index, as {} is not drawn evenly from the range of one key",
                                  study.quantities[d].name, axis->name));
    else
      collected.push_back(
          {quantity, d, static_cast<std::size_t>(axis - study.axes.begin()), DerivativeSums(moments[quantity].mean)});
  }
  const std::size_t verdict = place_of_path(study, "drift.verdict");
  const bool knows_verdict = verdict < study.quantities.size();
  std::uint64_t doubtful = 0, without_value = 0;
  store.for_each([&](const PointResult& point) {
    if (watch.asks_to_stop()) throw Interrupted();
    if (point.failed()) ++without_value;
    if (point.failed() || collected.empty()) return;
    if (knows_verdict && point.values[verdict] != Value("reliable")) return static_cast<void>(++doubtful);
    for (CollectedDerivative& each : collected) {
      const auto f = number_of(point.values[each.quantity]), derivative = number_of(point.values[each.derivative]),
                 x = number_of(point.axis_values[each.axis]);
      if (f && derivative && x) each.sums.include(*f, *derivative, per_range(*study.axes[each.axis].range, *derivative, *x));
    }
  });
  Json json = Json::object();
  for (const CollectedDerivative& each : collected) {
    const std::string &quantity = study.quantities[each.quantity].name, &axis = study.axes[each.axis].name;
    const auto index = each.sums.index();
    if (!index) {
      notes.push_back(fmt::format("{} gives no derivative-based index, as fewer than two points have both, or {} does not vary",
                                  study.quantities[each.derivative].name, quantity));
      continue;
    }
    if (!json.contains(quantity)) json[quantity] = Json::object();
    json[quantity][axis] = {{"points", index->points},
                            {"mean_square", index->mean_square},
                            {"mean_square_standard_error", index->mean_square_standard_error},
                            {"total_order_bound", index->total_bound},
                            {"total_order_bound_standard_error", index->total_bound_standard_error}};
  }
  if (!json.empty() && without_value > 0)
    notes.push_back(
        fmt::format("{} points failed, so the derivatives are those of another distribution than the design's, and the bounds "
                    "those of what is left of the box",
                    without_value));
  if (!json.empty() && !knows_verdict)
    notes.push_back(
        "derivatives are those of the last drift that can be trusted; collect drift.verdict, and points where that is not "
        "the end are left out");
  if (doubtful > 0)
    notes.push_back(
        fmt::format("{} points are left out, as their derivatives are those of an earlier drift than the last: not all of "
                    "that is reliable",
                    doubtful));
  document["derivative_indices"] = std::move(json);
  document["derivative_notes"] = std::move(notes);
}

}  // namespace earthtop::study

namespace earthtop {

std::string indices_note(const Study& study) {
  if (!study.design.indices || study.design.points >= study::kFewestBasePoints) return "";
  study::IndexBasis basis;
  basis.planned = study.design.points;
  return study::no_indices_reason(basis);
}

}  // namespace earthtop
