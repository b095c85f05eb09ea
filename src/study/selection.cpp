// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/study/selection.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "input/suggest.hpp"
#include "results/figures.hpp"
#include "study/gathering.hpp"
#include "study/json_text.hpp"
#include "study/store.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace study {
namespace {

constexpr std::size_t kMostSelected = 10'000, kWorst = 10;
constexpr std::string_view kStatus = "status", kPoint = "point";

enum class Comparison { less, more, at_most, at_least, equal, unequal };

/// Where a column's cells are found in a point.
struct ColumnPlace {
  enum class Kind { point, axis, quantity, status } kind = Kind::point;
  std::size_t index = 0;
};

Value cell_of(const PointResult& point, const ColumnPlace& place) {
  switch (place.kind) {
    case ColumnPlace::Kind::point: return static_cast<double>(point.number);
    case ColumnPlace::Kind::axis: return point.axis_values[place.index];
    case ColumnPlace::Kind::quantity: return point.values[place.index];
    case ColumnPlace::Kind::status: return point.status;
  }
  return {};
}

/// A condition on the cells of one column.
struct Condition {
  std::string text, name;
  ColumnPlace place;
  Comparison comparison = Comparison::equal;
  std::string word;
  std::optional<double> number;
  bool saw_number = false, saw_word = false;

  [[noreturn]] void refuse(const std::string& what) const {
    throw ScenarioError("", fmt::format("--where {}: {}", printable(text), what));
  }
};

bool is_one_of_order(Comparison comparison) { return comparison != Comparison::equal && comparison != Comparison::unequal; }

/// The numbers of a grid have rounding errors, and 0.3 is to find what was computed as 0.1 * 3.
bool are_equal(double a, double b) {
  constexpr double kRounding = 1e-12;
  return a == b || std::abs(a - b) <= kRounding * std::max(std::abs(a), std::abs(b));
}

bool holds(double x, Comparison comparison, double y) {
  switch (comparison) {
    case Comparison::less: return x < y && !are_equal(x, y);
    case Comparison::more: return x > y && !are_equal(x, y);
    case Comparison::at_most: return x <= y || are_equal(x, y);
    case Comparison::at_least: return x >= y || are_equal(x, y);
    case Comparison::equal: return are_equal(x, y);
    case Comparison::unequal: return !are_equal(x, y);
  }
  return false;
}

/// Whether a cell meets the condition; one without a value never does.
bool meets(const Value& cell, Condition& condition) {
  if (const auto* number = std::get_if<double>(&cell)) {
    condition.saw_number = true;
    return condition.number ? holds(*number, condition.comparison, *condition.number)
                            : condition.comparison == Comparison::unequal;
  }
  const auto* word = std::get_if<std::string>(&cell);
  if (!word) return false;
  condition.saw_word = true;
  if (condition.comparison == Comparison::equal) return *word == condition.word;
  return condition.comparison == Comparison::unequal && *word != condition.word;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// "there is no column "x"; did you mean "y"", or the list of those that there are.
std::string no_column(std::string_view kind, std::string_view name, const std::vector<std::string_view>& there) {
  std::string text = fmt::format("there is no {} \"{}\"", kind, printable(std::string(name)));
  if (const auto meant = input::suggest(name, there)) return text + fmt::format("; did you mean \"{}\"", *meant);
  return text + fmt::format("; there are: {}", fmt::join(there, ", "));
}

ColumnPlace place_of_column(const Study& study, const Condition& condition) {
  if (condition.name == kPoint) return {ColumnPlace::Kind::point, 0};
  if (condition.name == kStatus) return {ColumnPlace::Kind::status, 0};
  std::vector<std::string_view> there;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    if (study.axes[a].name == condition.name) return {ColumnPlace::Kind::axis, a};
    there.push_back(study.axes[a].name);
  }
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    if (study.quantities[q].name == condition.name) return {ColumnPlace::Kind::quantity, q};
    there.push_back(study.quantities[q].name);
  }
  there.insert(there.end(), {kStatus, kPoint});
  condition.refuse(no_column("column", condition.name, there));
}

/// The statuses that a point of a store can have.
std::vector<std::string_view> statuses() {
  return {to_string(RunStatus::completed),
          to_string(RunStatus::not_finite),
          to_string(RunStatus::step_underflow),
          to_string(RunStatus::not_converged),
          to_string(RunStatus::step_limit),
          "refused",
          "accuracy_not_reached"};
}

Condition read_condition(const Study& study, const std::string& text) {
  constexpr std::string_view kSigns = "<>=!";
  Condition condition;
  condition.text = text;
  const std::size_t at = text.find_first_of(kSigns), end = at == std::string::npos ? at : text.find_first_not_of(kSigns, at);
  const std::string_view whole = text;
  constexpr const char* kForm = "must be a column, one of < > <= >= = !=, and a value, e.g. tilt_deg>=20";
  if (at == std::string::npos) condition.refuse(kForm);
  condition.name = trimmed(whole.substr(0, at));
  const std::string_view sign = whole.substr(at, end == std::string::npos ? end : end - at);
  constexpr std::pair<std::string_view, Comparison> kComparisons[] = {
      {"<", Comparison::less},  {">", Comparison::more},   {"<=", Comparison::at_most}, {">=", Comparison::at_least},
      {"=", Comparison::equal}, {"==", Comparison::equal}, {"!=", Comparison::unequal}};
  const auto* const known =
      std::find_if(std::begin(kComparisons), std::end(kComparisons), [&](const auto& one) { return one.first == sign; });
  if (known == std::end(kComparisons) || condition.name.empty()) condition.refuse(kForm);
  condition.comparison = known->second;
  condition.word = end == std::string::npos ? "" : trimmed(whole.substr(end));
  if (condition.word.empty()) condition.refuse(std::string("gives no value; it ") + kForm);
  if (condition.word.find_first_of(kSigns) != std::string::npos)
    condition.refuse("has more than one comparison; give --where once for each");
  condition.number = finite_number(condition.word);
  condition.place = place_of_column(study, condition);
  if (is_one_of_order(condition.comparison) && !condition.number)
    condition.refuse(fmt::format("{} compares numbers, and \"{}\" is none", sign, printable(condition.word)));
  if (condition.place.kind == ColumnPlace::Kind::status) {
    if (is_one_of_order(condition.comparison))
      condition.refuse(fmt::format("{} compares numbers, and a status is a word", sign));
    const auto known_words = statuses();
    if (std::find(known_words.begin(), known_words.end(), condition.word) == known_words.end())
      condition.refuse(no_column("status", condition.word, known_words));
  }
  if (condition.place.kind == ColumnPlace::Kind::point && !condition.number)
    condition.refuse(fmt::format("\"{}\" is no number of a point", printable(condition.word)));
  return condition;
}

/// Refuses a condition that no cell of its column could meet or fail, as they are of another kind than the value.
void require_comparable(const Condition& condition) {
  if (condition.saw_word && !condition.saw_number && is_one_of_order(condition.comparison))
    condition.refuse(fmt::format("compares numbers, and {} holds words; compare with = or !=", condition.name));
  if (condition.saw_number && !condition.saw_word && !condition.number)
    condition.refuse(fmt::format("{} holds numbers, and \"{}\" is none", condition.name, printable(condition.word)));
}

std::size_t worst_place(const Study& study, const std::string& name) {
  std::vector<std::string_view> there;
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    if (study.quantities[q].name == name) return q;
    there.push_back(study.quantities[q].name);
  }
  const bool is_axis =
      std::any_of(study.axes.begin(), study.axes.end(), [&](const StudyAxis& axis) { return axis.name == name; });
  throw ScenarioError("", fmt::format("--worst {}: {}", printable(name),
                                      is_axis ? fmt::format("is an axis, not a quantity; there are: {}", fmt::join(there, ", "))
                                              : no_column("quantity", name, there)));
}

/// Whether a quantity is an error or a bound on one.
bool is_error_bound(const StudyQuantity& quantity) {
  const SummaryMember* const member = find_member(quantity.path);
  return member != nullptr && member->kind == FigureKind::error;
}

Json value_json(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return nullptr;
}

Json row_json(const Study& study, const PointResult& point, std::optional<std::size_t> only) {
  Json row = {{"point", point.number}};
  for (std::size_t a = 0; a < study.axes.size(); ++a) row[study.axes[a].name] = value_json(point.axis_values[a]);
  for (std::size_t q = 0; q < study.quantities.size(); ++q)
    if (!only || *only == q) row[study.quantities[q].name] = value_json(point.values[q]);
  row["status"] = point.status;
  if (!point.reason.empty()) row["reason"] = point.reason;
  return row;
}

/// The points with the largest values so far, largest first; of equal ones those with lower numbers.
class Largest {
 public:
  void include(double size, const PointResult& point) {
    const auto at = std::find_if(points_.begin(), points_.end(), [&](const auto& other) { return other.first < size; });
    if (at == points_.end() && points_.size() == kWorst) return;
    points_.insert(at, {size, point});
    if (points_.size() > kWorst) points_.pop_back();
  }
  const std::vector<std::pair<double, PointResult>>& points() const { return points_; }

 private:
  std::vector<std::pair<double, PointResult>> points_;
};

}  // namespace
}  // namespace study

std::string selected_points_json(const std::filesystem::path& file, const PointSelection& selection, const Watch& watch) {
  using namespace study;
  Store store = Store::open(file, sqlite::Connection::Mode::read);
  const Study& study = store.study();
  std::vector<Condition> conditions;
  bool asks_status = false;
  for (const std::string& text : selection.where) {
    conditions.push_back(read_condition(study, text));
    asks_status = asks_status || conditions.back().place.kind == ColumnPlace::Kind::status;
  }
  std::optional<std::size_t> worst;
  if (selection.worst) worst = worst_place(study, *selection.worst);
  store.check();  // so that damaged points are passed over
  const bool is_bound = worst && is_error_bound(study.quantities[*worst]);
  std::uint64_t matching = 0, numbers = 0;
  bool saw_word = false;
  Json points = Json::array();
  Largest largest;
  store.for_each([&](const PointResult& point) {
    if (watch.asks_to_stop()) throw Interrupted();
    bool all = true;  // every cell is looked at, so that each condition sees what its column holds
    for (Condition& condition : conditions) all = meets(cell_of(point, condition.place), condition) && all;
    if (worst) saw_word = saw_word || std::holds_alternative<std::string>(point.values[*worst]);
    if (!all) return;
    ++matching;
    if (!worst) {
      if (points.size() < kMostSelected) points.push_back(row_json(study, point, std::nullopt));
      return;
    }
    const auto number = number_of(point.values[*worst]);
    if (!number) return;
    ++numbers;
    if (!point.failed() || asks_status) largest.include(is_bound ? *number : std::abs(*number), point);
  });
  for (const Condition& condition : conditions) require_comparable(condition);
  if (worst && numbers == 0 && saw_word)
    throw ScenarioError("",
                        fmt::format("--worst {}: it holds words, of which none is the largest", printable(*selection.worst)));
  for (const auto& [size, point] : largest.points()) points.push_back(row_json(study, point, worst));
  Json document = {{"$schema", "earthtop-study-points-1.json"}, {"name", study.name}, {"where", selection.where}};
  if (worst) {
    document["worst"] = *selection.worst;
    document["worst_means"] = is_bound ? "largest bound" : "largest absolute value";
  }
  document["matching"] = matching;
  document["listed"] = points.size();
  Json& columns = document["columns"] = Json::array({"point"});
  for (const StudyAxis& axis : study.axes) columns.push_back(axis.name);
  for (std::size_t q = 0; q < study.quantities.size(); ++q)
    if (!worst || *worst == q) columns.push_back(study.quantities[q].name);
  columns.push_back("status");
  document["points"] = std::move(points);
  return json_with_escapes(written_replacing(document, 1)) + '\n';
}

}  // namespace earthtop
