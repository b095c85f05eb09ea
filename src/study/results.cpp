// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the contents of a study's store as one JSON document and as one table.
#include "earthtop/results/results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/results/output_files.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/file.hpp"
#include "results/file_set.hpp"
#include "results/seal.hpp"
#include "study/figure.hpp"
#include "study/gathering.hpp"
#include "study/influence.hpp"
#include "study/json_text.hpp"
#include "study/rank_search.hpp"
#include "study/store.hpp"
#include "text/checksum.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace study {
namespace {

constexpr std::string_view kTableFile = "study.csv", kPictureFile = "study.svg", kDocumentFile = "study.json";
constexpr const char* kResultsSchema = "earthtop-study-results-1.json";
constexpr std::array<std::string_view, 3> kResultFiles = {kTableFile, kPictureFile,
                                                          kDocumentFile};  // the last one has the checksums of the others

constexpr std::size_t kMostListedValues = 500;  // largest list of values of an axis that is written out

void stop_if_asked(const Watch& watch) {
  if (watch.asks_to_stop()) throw Interrupted();
}

Json axes_json(const Study& study) {
  Json axes = Json::array();
  for (const StudyAxis& axis : study.axes) {
    Json json = {{"name", axis.name}, {"pointers", axis.pointers}};
    if (axis.range)
      json[axis.range->logarithmic ? "log_range" : "range"] = {
          {"from", axis.range->from}, {"to", axis.range->to}, {"points", axis.range->points}};
    else if (axis.levels.size() <= kMostListedValues) {
      Json& values = json["values"] = Json::array();
      for (const auto& level : axis.levels) values.push_back(json_of(level.front()));
    }
    axes.push_back(std::move(json));
  }
  return axes;
}

/// The 5 %, 50 % and 95 % quantiles of each quantity: the values at positions share * (count - 1), rounded, in ascending order.
std::vector<std::vector<double>> quantiles_of(Store& store, const std::vector<Moments>& moments, const Watch& watch) {
  std::vector<RankSearch> searches;
  searches.reserve(moments.size());
  for (const Moments& m : moments) {
    std::vector<std::uint64_t> ranks;
    for (const double share : kShares) ranks.push_back(rank_of(share, m.count));
    searches.emplace_back(ranks);
  }
  for (int pass = 0; pass < RankSearch::kPasses; ++pass) {
    store.for_each_number([&](std::size_t quantity, double number) {
      stop_if_asked(watch);
      searches[quantity].include(number);
    });
    for (RankSearch& search : searches) search.end_pass();
  }
  std::vector<std::vector<double>> quantiles;
  quantiles.reserve(searches.size());
  for (const RankSearch& search : searches) quantiles.push_back(search.found());
  return quantiles;
}

Json statistics_json(Store& store, const std::vector<Moments>& moments, const Watch& watch) {
  const auto quantiles = quantiles_of(store, moments, watch);
  Json statistics = Json::object();
  for (std::size_t q = 0; q < moments.size(); ++q) {
    const Moments& m = moments[q];
    const std::string& name = store.study().quantities[q].name;
    if (m.count == 0) continue;
    statistics[name] = {{"count", m.count},
                        {"mean", m.mean},
                        {"standard_deviation", number_json(m.standard_deviation())},
                        {"min", m.least},
                        {"quantile_05", number_json(quantiles[q][0])},
                        {"median", number_json(quantiles[q][1])},
                        {"quantile_95", number_json(quantiles[q][2])},
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
    } catch (const Json::exception&) {  // there is no such place, or it is not a pointer
      computed.reset();
    }
    json["computed"] = number_json(computed);
    json["difference"] = number_json(computed ? std::optional(*computed - figure.value) : std::nullopt);
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

Json document_of(Store& store, const Watch& watch) {
  const Study& study = store.study();
  Gathering gathering(study);
  store.for_each([&](const PointResult& point) {
    stop_if_asked(watch);
    gathering.include(point);
  });
  std::uint64_t computed = 0, failed = 0;
  for (const auto& [status, count] : gathering.statuses()) {
    computed += count;
    if (status != "completed") failed += count;
  }
  Json document = {
      {"$schema", kResultsSchema},
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
  document["statistics"] = statistics_json(store, gathering.moments(), watch);
  document["marginals"] = gathering.marginals();
  document["fits"] = gathering.fits();
  if (study.design.indices) add_sobol_indices(store, gathering.moments(), watch, document);
  add_derivative_indices(store, gathering.moments(), watch, document);
  document["points"] = gathering.points();
  document["figures"] = figures_json(study, document);
  document["provenance"] = provenance_json(store);
  return document;
}

void write_table(Store& store, const FileSet::Sink& sink, const Watch& watch) {
  const Study& study = store.study();
  std::string text = "point";
  for (const StudyAxis& axis : study.axes) text.append(1, ',').append(axis.name);
  for (const StudyQuantity& quantity : study.quantities) text.append(1, ',').append(csv_cell(quantity.name));
  text += ",status,reason\n";
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  store.for_each([&](const PointResult& point) {
    stop_if_asked(watch);
    text += fmt::format("{}", point.number);
    for (const Value& value : point.axis_values) text.append(1, ',').append(csv_cell(value));
    for (const Value& value : point.values) text.append(1, ',').append(csv_cell(value));
    text += fmt::format(",{},{}\n", csv_cell(point.status), csv_cell(point.reason));
    if (text.size() < kPiece) return;
    sink(text);
    text.clear();
  });
  sink(text);
}

[[noreturn]] void refuse_present(const std::filesystem::path& file, std::string_view reason) {
  throw ScenarioError(
      std::vector<Diagnostic>{
          {0, 0, "", fmt::format("already exists, and {}; choose another --out, or --force to overwrite it", reason)}},
      file.string());
}

/// The text of a document of a study's results; empty where the file is none, or cannot be opened.
std::string document_in(const std::filesystem::path& file) {
  try {
    constexpr std::size_t kMost_MiB = 1024;
    const std::string text = input::read_regular_file(file.string(), file.string(), {"document", false, kMost_MiB});
    const Json json = Json::parse(text, nullptr, false);
    return json.is_object() && json.value("$schema", Json()) == kResultsSchema ? text : "";
  } catch (const ScenarioError&) {
    return "";
  }
}

/// Whether a document has results of another study, of which a point was completed.
bool is_of_another(const std::string& document, const std::vector<std::string>& identities) {
  const Json json = Json::parse(document);
  const Json::json_pointer identity("/provenance/study_sha256");
  const auto is_known = [&](const std::string& known) { return json.at(identity) == known; };
  return json.contains(identity) && std::none_of(identities.begin(), identities.end(), is_known) &&
         json.value("points_computed", Json()) != json.value("points_failed", Json());
}

/// Refuses files of results that are not this study's as they were written. @throws ScenarioError; ReadError, WriteError
/// @param identities  of the study, and of the designs from which it has grown
void require_own_results(const std::filesystem::path& dir, const std::vector<std::string>& identities, bool force) {
  constexpr const char* kNotAsWritten = "is not as earthtop study wrote it";
  std::error_code error;
  for (const std::string_view name : kResultFiles)
    if (std::filesystem::is_directory(std::filesystem::symlink_status(dir / name, error)))
      refuse_file(dir / name, "is a directory; choose another --out");
  if (force) return;
  std::string document;
  if (is_something_at(dir / kDocumentFile)) {
    document = document_in(dir / kDocumentFile);
    if (document.empty() || seal_of(document) == Seal::broken) refuse_present(dir / kDocumentFile, kNotAsWritten);
    if (is_of_another(document, identities)) refuse_present(dir / kDocumentFile, "has the results of another study");
  } else {  // a study that was killed while it put its files in place left it under a temporary name
    for (const std::filesystem::path& left : FileSet::temporaries(dir, kDocumentFile))
      if (!document_in(left).empty()) return;
  }
  for (const std::string_view name : {kTableFile, kPictureFile})
    if (is_something_at(dir / name) && (document.empty() || !is_as_stated(dir, name, document)))
      refuse_present(dir / name, kNotAsWritten);
}

/// The identities of the results that a study may overwrite in a directory: its own, and those of the store there, of which
/// `run_study` says whether it may grow.
std::vector<std::string> identities_in(const std::filesystem::path& dir, const Study& study) {
  std::vector<std::string> identities = {study_sha256(study)};
  try {
    const std::vector<std::string> there = Store::open(study_store(dir), sqlite::Connection::Mode::read).identities();
    identities.insert(identities.end(), there.begin(), there.end());
  } catch (const std::runtime_error&) {  // there is none, or it is for `run_study` to say what is wrong with it
  }
  return identities;
}

/// The results of a study as the contents of its files.
struct Files {
  std::optional<std::string> picture;
  std::string document;  ///< with the checksums of the others
};
/// @param table_sink  receives the table
Files files_of(Store& store, const FileSet::Sink& table_sink, const Watch& watch) {
  Checksum table;
  write_table(
      store,
      [&](std::string_view piece) {
        table.add(piece);
        table_sink(piece);
      },
      watch);
  FileChecksums checksums = {{std::string(kTableFile), checksum_text(table.value())}};
  const Json document = document_of(store, watch);
  Files files;
  if (const auto figure = study_figure(store.study(), document)) {
    files.picture = svg(*figure);
    checksums.emplace_back(kPictureFile, checksum_text(checksum_of(*files.picture)));
  }
  files.document = sealed(json_with_escapes(written_replacing(document, 1)) + '\n', checksums);
  return files;
}

}  // namespace
}  // namespace study

StudyStoreCheck check_study_store(const std::filesystem::path& file) {
  const study::StoreCheck check = study::Store::open(file, study::sqlite::Connection::Mode::read).check();
  return {check.is_damaged() ? check.text() : "", check.has_checksums, check.has_checksums ? "" : unverified(file)};
}

std::string study_json(const std::filesystem::path& file, const Watch& watch) {
  study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
  store.check();  // so that the quantiles, too, pass over damaged points
  return study::files_of(
             store, [](std::string_view) {}, watch)
      .document;
}

void study_whole_json(const std::filesystem::path& file, const std::function<void(std::string_view)>& sink) {
  using namespace study;
  Store store = Store::open(file, sqlite::Connection::Mode::read);
  store.check();  // so that the quantiles, too, pass over damaged points
  Json document = document_of(store, {});
  document["points"] = Json::array();
  const std::string text = json_with_escapes(written_replacing(document, 1)) + '\n';
  constexpr std::string_view kNoPoints = "\n \"points\": []";  // at this indentation only the document's own
  const std::size_t begin = text.find(kNoPoints) + kNoPoints.size() - 1;
  sink(std::string_view(text).substr(0, begin));
  bool is_first = true;
  store.for_each([&](const PointResult& point) {
    Json row = point_json(store.study(), point);
    if (point.failed()) row["reason"] = point.reason;
    sink((is_first ? "\n  " : ",\n  ") + json_with_escapes(written_replacing(row)));
    is_first = false;
  });
  if (!is_first) sink("\n ");
  sink(std::string_view(text).substr(begin));
}

void study_csv(const std::filesystem::path& file, const std::function<void(std::string_view)>& sink) {
  study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
  study::write_table(store, sink, {});
}

void check_study_results(const std::filesystem::path& dir, const Study& study, bool force) {
  study::require_own_results(dir, study::identities_in(dir, study), force);
}

void write_study_results(const std::filesystem::path& file, const Watch& watch, bool force) {
  study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
  FileSet files(file.parent_path(), study::kResultFiles, watch);
  study::require_own_results(file.parent_path(), store.identities(), force);
  study::Files contents;
  files.add(study::kTableFile, [&](const FileSet::Sink& sink) { contents = study::files_of(store, sink, watch); });
  if (contents.picture) files.add(study::kPictureFile, *contents.picture);
  files.add(study::kDocumentFile, contents.document);
  files.commit();
}

}  // namespace earthtop
