// What a study's store holds, as one JSON document and as one table.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "earthtop/results/provenance.hpp"
#include "earthtop/study/run_study.hpp"
#include "results/file_set.hpp"
#include "study/figure.hpp"
#include "study/json_text.hpp"
#include "study/statistics.hpp"
#include "study/store.hpp"

namespace earthtop {
namespace study {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostListed = 1000;  // points in the document
constexpr std::size_t kMostLevels = 500;     // of an axis, in the marginal means
constexpr std::size_t kMostFailures = 20;
constexpr int kBins = 10;  // of a range that is drawn from

Json json_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return nullptr;
}
Json json_of(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); }
std::optional<double> number_of(const Value& value) {
  const auto* number = std::get_if<double>(&value);
  return number ? std::optional(*number) : std::nullopt;
}

/// Where on an axis a point counts for the marginal means.
class Levels {
 public:
  Levels(const StudyAxis& axis, bool drawn) : axis_(axis), binned_(drawn && axis.range) {}
  /// Its place in order; nothing at the base.
  std::optional<std::pair<double, std::string>> of(const Value& value) {
    if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
    if (!binned_) {
      const std::string text = csv_cell(value);
      const auto place = order_.try_emplace(text, static_cast<double>(order_.size())).first->second;
      const auto number = number_of(value);
      return std::pair(number ? *number : place, text);
    }
    const double from = axis_.range->from.front(), to = axis_.range->to.front(), x = number_of(value).value_or(from);
    const double part = axis_.range->logarithmic ? std::log(x / from) / std::log(to / from) : (x - from) / (to - from);
    const int bin = std::clamp(static_cast<int>(part * kBins), 0, kBins - 1);
    const auto edge = [&](int i) {
      const double share = static_cast<double>(i) / kBins;
      return axis_.range->logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
    };
    return std::pair(static_cast<double>(bin), fmt::format("{:.6g} to {:.6g}", edge(bin), edge(bin + 1)));
  }

 private:
  const StudyAxis& axis_;
  bool binned_;
  std::map<std::string, double> order_;
};

/// One pass over the points: counts, moments, means along each axis, lines.
class Gathering {
 public:
  explicit Gathering(const Study& study) : study_(study), moments_(study.quantities.size()) {
    const bool drawn = study.design.kind == DesignKind::random || study.design.kind == DesignKind::latin_hypercube ||
                       study.design.kind == DesignKind::sobol;
    levels_.reserve(study.axes.size());
    for (const StudyAxis& axis : study.axes) levels_.emplace_back(axis, drawn);
    along_.resize(study.axes.size());
    fits_ = std::vector<LineFit>(study.fits.size());
    for (const StudyFit& fit : study.fits) {
      places_.emplace_back(index_of(study.axes, fit.axis), index_of(study.quantities, fit.quantity));
    }
  }

  void include(const PointResult& point) {
    ++statuses_[point.status];
    if (point.failed()) {
      if (failures_.size() < kMostFailures)
        failures_.push_back({{"point", point.number}, {"status", point.status}, {"reason", point.reason}});
    } else {
      include_values(point);
    }
    if (points_.size() <= kMostListed) list(point);
  }

  const std::map<std::string, std::uint64_t>& statuses() const { return statuses_; }
  const std::vector<Moments>& moments() const { return moments_; }
  const Json& failures() const { return failures_; }
  /// All points; nothing where they are too many.
  const Json& points() const {
    static const Json kNone;
    return points_.size() <= kMostListed ? points_ : kNone;
  }

  Json marginals() const {
    Json axes = Json::object();
    for (std::size_t a = 0; a < study_.axes.size(); ++a) {
      if (along_[a].size() > kMostLevels) continue;
      Json& rows = axes[study_.axes[a].name] = Json::array();
      for (const auto& [place, level] : along_[a]) {
        Json row = {{"value", place.second}};
        for (std::size_t q = 0; q < level.size(); ++q)
          if (level[q].count > 0)
            row[study_.quantities[q].name] = {{"count", level[q].count},
                                              {"mean", level[q].mean},
                                              {"standard_deviation", json_of(level[q].standard_deviation())}};
        rows.push_back(std::move(row));
      }
    }
    return axes;
  }

  Json fits() {
    Json list = Json::array();
    for (std::size_t f = 0; f < fits_.size(); ++f) {
      const StudyFit& fit = study_.fits[f];
      Json json = {{"kind", to_string(fit.kind)}, {"axis", fit.axis}, {"quantity", fit.quantity}};
      const auto line = fits_[f].line();
      const bool power = fit.kind == FitKind::power_law;
      const std::optional<double> none;
      // Of a power law, a is exp of the line's: its error goes with it.
      const auto a = !line ? none : power ? std::optional(std::exp(line->a)) : std::optional(line->a);
      const auto a_error = !line || !line->a_standard_error ? none
                           : power                          ? std::optional(*a * *line->a_standard_error)
                                                            : line->a_standard_error;
      json["points"] = line ? line->points : 0;
      json["a"] = json_of(a);
      json["a_standard_error"] = json_of(a_error);
      json["b"] = json_of(line ? std::optional(line->b) : none);
      json["b_standard_error"] = json_of(line ? line->b_standard_error : none);
      json[power ? "residual_rms_of_logarithm" : "residual_rms"] = json_of(line ? line->residual_rms : none);
      list.push_back(std::move(json));
    }
    return list;
  }

 private:
  template <class List>
  static std::size_t index_of(const List& list, const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.name == name; }) - list.begin());
  }

  void include_values(const PointResult& point) {
    for (std::size_t q = 0; q < moments_.size(); ++q)
      if (const auto y = number_of(point.values[q])) moments_[q].include(*y);
    for (std::size_t a = 0; a < levels_.size(); ++a) {
      if (along_[a].size() > kMostLevels) continue;
      const auto place = levels_[a].of(point.axis_values[a]);
      if (!place) continue;
      std::vector<Moments>& level = along_[a][*place];
      level.resize(moments_.size());
      for (std::size_t q = 0; q < level.size(); ++q)
        if (const auto y = number_of(point.values[q])) level[q].include(*y);
    }
    for (std::size_t f = 0; f < fits_.size(); ++f) {
      const auto x = number_of(point.axis_values[places_[f].first]), y = number_of(point.values[places_[f].second]);
      if (!x || !y) continue;
      switch (study_.fits[f].kind) {
        case FitKind::linear: fits_[f].include(*x, *y); break;
        case FitKind::sin_latitude: fits_[f].include(std::sin(*x * std::numbers::pi / 180), *y); break;
        case FitKind::cos_latitude: fits_[f].include(std::cos(*x * std::numbers::pi / 180), *y); break;
        case FitKind::logarithmic:
          if (*x != 0) fits_[f].include(std::log(std::abs(*x)), *y);
          break;
        case FitKind::power_law:
          if (*x != 0 && *y != 0) fits_[f].include(std::log(std::abs(*x)), std::log(std::abs(*y)));
          break;
      }
    }
  }

  void list(const PointResult& point) {
    Json row = {{"point", point.number}};
    for (std::size_t a = 0; a < study_.axes.size(); ++a) row[study_.axes[a].name] = json_of(point.axis_values[a]);
    for (std::size_t q = 0; q < study_.quantities.size(); ++q) row[study_.quantities[q].name] = json_of(point.values[q]);
    row["status"] = point.status;
    points_.push_back(std::move(row));
  }

  const Study& study_;
  std::vector<Moments> moments_;
  std::vector<Levels> levels_;
  std::vector<std::map<std::pair<double, std::string>, std::vector<Moments>>> along_;
  std::vector<LineFit> fits_;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  // axis and quantity of each fit
  std::map<std::string, std::uint64_t> statuses_;
  Json failures_ = Json::array(), points_ = Json::array();
};

/// Another pass: the blocks of Saltelli's scheme.
Json sobol_indices(Store& store, const std::vector<Moments>& moments) {
  const Study& study = store.study();
  const std::size_t inputs = study.axes.size(), quantities = study.quantities.size();
  std::vector<SobolSums> sums;
  sums.reserve(quantities);
  for (std::size_t q = 0; q < quantities; ++q) sums.emplace_back(inputs, moments[q].mean);
  std::vector<PointResult> block;
  store.for_each([&](const PointResult& point) {
    if (point.number % (inputs + 2) == 0) block.clear();
    block.push_back(point);
    const bool whole = block.size() == inputs + 2 && block.front().number % (inputs + 2) == 0 &&
                       block.back().number == block.front().number + inputs + 1;
    if (!whole || std::any_of(block.begin(), block.end(), [](const PointResult& p) { return p.failed(); })) return;
    for (std::size_t q = 0; q < quantities; ++q) {
      std::vector<double> f;
      f.reserve(block.size());
      for (const PointResult& p : block)
        if (const auto y = number_of(p.values[q])) f.push_back(*y);
      if (f.size() == block.size()) sums[q].include(f[0], f[1], {f.begin() + 2, f.end()});
    }
  });
  Json json = Json::object();
  for (std::size_t q = 0; q < quantities; ++q) {
    const auto indices = sums[q].indices();
    if (indices.empty()) continue;
    Json& of = json[study.quantities[q].name] = Json::object();
    for (std::size_t i = 0; i < inputs; ++i)
      of[study.axes[i].name] = {{"first_order", indices[i].first},
                                {"first_order_standard_error", indices[i].first_standard_error},
                                {"total_order", indices[i].total},
                                {"total_order_standard_error", indices[i].total_standard_error}};
  }
  return json;
}

Json axes_json(const Study& study) {
  Json axes = Json::array();
  for (const StudyAxis& axis : study.axes) {
    Json json = {{"name", axis.name}, {"pointers", axis.pointers}};
    if (axis.range)
      json[axis.range->logarithmic ? "log_range" : "range"] = {
          {"from", axis.range->from}, {"to", axis.range->to}, {"points", axis.range->points}};
    else if (axis.levels.size() <= kMostLevels)
      for (const auto& level : axis.levels) json["values"].push_back(Json::parse(level.front()));
    axes.push_back(std::move(json));
  }
  return axes;
}

Json statistics_json(Store& store, const std::vector<Moments>& moments) {
  Json statistics = Json::object();
  for (std::size_t q = 0; q < moments.size(); ++q) {
    const Moments& m = moments[q];
    const std::string& name = store.study().quantities[q].name;
    if (m.count == 0) continue;
    statistics[name] = {{"count", m.count},
                        {"mean", m.mean},
                        {"standard_deviation", json_of(m.standard_deviation())},
                        {"min", m.least},
                        {"quantile_05", json_of(store.quantile(name, 0.05, m.count))},
                        {"median", json_of(store.quantile(name, 0.5, m.count))},
                        {"quantile_95", json_of(store.quantile(name, 0.95, m.count))},
                        {"max", m.most}};
  }
  return statistics;
}

Json figures_json(const Study& study, const Json& document) {
  Json figures = Json::array();
  for (const StudyFigure& figure : study.figures) {
    Json json = {
        {"figure", figure.figure}, {"value", figure.value}, {"tolerance", figure.tolerance}, {"origin", figure.origin}};
    std::optional<double> computed;
    try {
      if (const Json& at = document.at(Json::json_pointer(figure.figure)); at.is_number()) computed = at.get<double>();
    } catch (const Json::exception&) {  // no such place, or no pointer
      computed.reset();
    }
    json["computed"] = json_of(computed);
    json["difference"] = json_of(computed ? std::optional(*computed - figure.value) : std::nullopt);
    json["met"] = computed && std::abs(*computed - figure.value) <= figure.tolerance;
    figures.push_back(std::move(json));
  }
  return figures;
}

Json provenance_json(const Store& store) {
  const BuildInfo& build = build_info();
  Json libraries = Json::object();
  for (const auto& [name, version] : build.libraries) libraries[name] = version;
  return {{"study_sha256", store.sha256()}, {"base", store.study().base.file}, {"version", build.version},
          {"commit", build.commit},         {"compiler", build.compiler},      {"flags", build.flags},
          {"libraries", libraries}};
}

Json document_of(Store& store) {
  const Study& study = store.study();
  Gathering gathering(study);
  store.for_each([&](const PointResult& point) { gathering.include(point); });
  std::uint64_t computed = 0, failed = 0;
  for (const auto& [status, count] : gathering.statuses()) {
    computed += count;
    if (status != "completed") failed += count;
  }
  Json document = {
      {"$schema", "earthtop-study-results-1.json"},
      {"name", study.name},
      {"title", study.title},
      {"purpose", study.purpose},
      {"finding", study.finding},
      {"design", {{"kind", to_string(study.design.kind)}, {"seed", study.design.seed}, {"indices", study.design.indices}}},
      {"points_planned", point_count(study).value_or(0)},
      {"points_computed", computed},
      {"points_failed", failed},
      {"statuses", gathering.statuses()},
      {"failures", gathering.failures()},
      {"axes", axes_json(study)}};
  Json& quantities = document["quantities"] = Json::array();
  for (const StudyQuantity& quantity : study.quantities)
    quantities.push_back({{"name", quantity.name}, {"path", quantity.path}});
  document["statistics"] = statistics_json(store, gathering.moments());
  document["marginals"] = gathering.marginals();
  document["fits"] = gathering.fits();
  if (study.design.indices) document["indices"] = sobol_indices(store, gathering.moments());
  document["points"] = gathering.points();
  document["figures"] = figures_json(study, document);
  document["provenance"] = provenance_json(store);
  return document;
}

std::string text_of(const Json& document) { return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n'; }

void write_table(Store& store, const FileSet::Sink& sink) {
  const Study& study = store.study();
  std::string text = "point";
  for (const StudyAxis& axis : study.axes) text.append(1, ',').append(axis.name);
  for (const StudyQuantity& quantity : study.quantities) text.append(1, ',').append(quantity.name);
  text += ",status,reason\n";
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  store.for_each([&](const PointResult& point) {
    text += fmt::format("{}", point.number);
    for (const Value& value : point.axis_values) text.append(1, ',').append(csv_cell(value));
    for (const Value& value : point.values) text.append(1, ',').append(csv_cell(value));
    text += fmt::format(",{},{}\n", point.status, csv_cell(point.reason));
    if (text.size() < kPiece) return;
    sink(text);
    text.clear();
  });
  sink(text);
}

}  // namespace
}  // namespace study

std::string study_json(const std::filesystem::path& file) {
  study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
  return study::text_of(study::document_of(store));
}

void study_csv(const std::filesystem::path& file, const std::function<void(std::string_view)>& sink) {
  study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
  study::write_table(store, sink);
}

void write_study_results(const std::filesystem::path& file) {
  study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
  static constexpr std::array<std::string_view, 3> kNames = {"study.csv", "study.svg", "study.json"};
  FileSet files(file.parent_path(), kNames);
  files.add("study.csv", [&](const FileSet::Sink& sink) { study::write_table(store, sink); });
  const auto document = study::document_of(store);
  if (const auto figure = study::study_figure(store.study(), document)) files.add("study.svg", svg(*figure));
  files.add("study.json", study::text_of(document));
  files.commit();
}

}  // namespace earthtop
