// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "earthtop/error.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/results/row_arrays.hpp"
#include "earthtop/run/each_row.hpp"
#include "earthtop/scenario/support.hpp"
#include "input/csv_reader.hpp"
#include "input/document.hpp"
#include "input/file.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"
#include "results/file_set.hpp"
#include "results/number_ranges.hpp"
#include "results/seal.hpp"
#include "text/checksum.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

/// summary.json names the scenario, and is the seal of the file set: it comes last in the list.
constexpr std::string_view kSummary = "summary.json", kRowTable = "trajectory.csv", kTorqueTable = "torques.csv",
                           kFigure = "drift.svg", kTiming = "timing.json";
constexpr std::array<std::string_view, 5> kFiles = {kRowTable, kTorqueTable, kFigure, kTiming, kSummary};
constexpr std::size_t kLargestText_MiB = 4096;

/// The SHA-256 of the scenario whose results `summary` holds; empty if the file is not a summary that this program wrote.
std::string scenario_of(const fs::path& summary) {
  try {
    const std::string text = input::read_regular_file(summary.string(), summary.string(), {"summary"});
    const nlohmann::ordered_json json = input::read_document(text, summary.string(), {"summary"});
    const nlohmann::ordered_json::json_pointer hash("/provenance/scenario_sha256");
    return json.contains(hash) && json.at(hash).is_string() ? json.at(hash).get<std::string>() : "";
  } catch (const ScenarioError&) {  // it is not a file, cannot be opened, or is not a document
    return "";
  }
}

/// Refuses an existing directory whose files must not be overwritten. @throws ScenarioError
void check_present_files(const fs::path& dir, const Scene& scene, bool force) {
  for (const std::string_view name : kFiles)
    if (std::error_code error; fs::is_directory(fs::symlink_status(dir / name, error)))
      refuse_file(dir, std::string(name) + " in it is a directory; choose another --out");
  if (force) return;
  const fs::path summary = dir / kSummary;
  if (is_something_at(summary)) {
    const std::string present = scenario_of(summary);
    if (present.empty())
      refuse_file(dir, "its summary.json was not written by earthtop; choose another --out, or --force to overwrite it");
    if (present != scene.sha256())
      refuse_file(dir, "holds the results of another scenario; choose another --out, or --force to overwrite them");
    if (!scene.scenario().ledger && is_something_at(dir / kTorqueTable))
      refuse_file(dir,
                  "its torques.csv does not belong to this scenario's results; choose another --out, or --force to remove it");
    return;
  }
  // A run that was killed while it put its files in place left the summary under a temporary name.
  const auto left = FileSet::temporaries(dir, kSummary);
  const std::string& ours = scene.sha256();
  if (std::any_of(left.begin(), left.end(), [&](const fs::path& path) { return scenario_of(path) == ours; })) return;
  for (const std::string_view name : kFiles)
    if (is_something_at(dir / name))
      refuse_file(dir,
                  std::string(name) + " is in it without a summary.json; choose another --out, or --force to overwrite it");
}

/// The files of a run that change together, each with its checksum in the summary.
class SealedSet {
 public:
  SealedSet(const fs::path& dir, const Watch& watch) : files_(dir, kFiles, watch) {}
  void add(std::string_view name, const std::function<void(const FileSet::Sink&)>& produce) {
    Checksum checksum;
    files_.add(name, [&](const FileSet::Sink& sink) {
      produce([&](std::string_view piece) {
        checksum.add(piece);
        sink(piece);
      });
    });
    checksums_.emplace_back(name, checksum_text(checksum.value()));
  }
  /// Puts all in place. The timing, which differs from run to run as the summary does not, states the summary's checksum, and not the
  /// other way round.
  /// @param timing  may be empty: there is none   @returns the summary as written
  std::string commit(std::string_view summary, std::string_view timing) {
    std::string text = sealed(summary, checksums_);
    if (!timing.empty()) files_.add(kTiming, sealed_timing(timing, text));
    files_.add(kSummary, text);
    files_.commit();
    return text;
  }

 private:
  FileSet files_;
  FileChecksums checksums_;
};

struct Documents {
  std::string summary, timing;
};

/// @param add_files  adds all files but these documents, which it returns   @returns the summary as written
std::string write_set(const fs::path& dir, const Scene& scene, bool force, const Watch& watch,
                      const std::function<Documents(SealedSet&)>& add_files) {
  check_output_directory(dir, scene, force);
  SealedSet set(dir, watch);
  check_present_files(dir, scene, force);  // once more, since no other run can write there while the directory is locked
  const Documents documents = add_files(set);
  return set.commit(documents.summary, documents.timing);
}

/// Holds the texts of result files against the checksums in them. @param notes  as of `read_result_texts`   @throws ScenarioError
void check_result_texts(const fs::path& dir, const ResultTexts& texts, std::vector<std::string>* notes) {
  const std::string& summary = texts.find(kSummary)->second;
  const Seal seal = seal_of(summary);
  if (seal == Seal::broken) refuse_damaged(dir / kSummary);
  const auto timing = texts.find(kTiming);
  const bool timing_is_sealed = timing == texts.end() || check_timing(dir, timing->second, summary);
  if (notes && seal == Seal::absent) notes->push_back(unverified(dir));
  if (notes && seal == Seal::fits && !timing_is_sealed) notes->push_back(unverified(dir / kTiming));
  const FileChecksums checksums = checksums_in(summary, dir / kSummary);
  for (const auto& [name, checksum] : checksums)
    if (const auto found = texts.find(name); found == texts.end() || checksum_text(checksum_of(found->second)) != checksum)
      refuse_damaged(dir / name);
}

/// Reads a table to its end. @throws ScenarioError for a line whose number of cells differs from that of the header, and for a
/// cell that is not of its column's kind   @param kinds  the columns that it may have; others are passed over
void check_table(const fs::path& file, const std::string& text, const std::vector<RowArray>& kinds) {
  if (text.find('"') != text.npos)
    refuse_file(file, "has quotation marks, which no table of results has; run the scenario again");
  constexpr input::CsvFormat kWithoutComments = {',', '\0', false};
  input::CsvReader reader = input::CsvReader::of_text(file.string(), text, kWithoutComments);
  std::vector<std::size_t> places;
  std::vector<std::string_view> words;
  std::vector<NumberRange> ranges;
  for (const RowArray& kind : kinds) {
    if (reader.find(kind.columns.front()) == reader.header().size() && kind.columns.front() != kTimeColumn) continue;
    for (const std::string& column : kind.columns) {
      places.push_back(reader.find(column));
      words.push_back(kind.words);
      ranges.push_back(range_of(column));
      if (places.back() == reader.header().size())
        refuse_file(file, fmt::format("has no column {}; run the scenario again", column));
    }
  }
  reader.want(places);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!words[i].empty()) reader.take_words(i, words[i]);
  while (reader.next())
    for (std::size_t i = 0; i < ranges.size(); ++i)
      if (const std::string_view wanted = fault_of(ranges[i], reader.numbers()[i]); !wanted.empty())
        refuse_file(file, fmt::format("has a {} of {} in line {}, which must be {}; run the scenario again",
                                      reader.header()[places[i]], reader.numbers()[i], reader.line(), wanted));
}

/// Holds the texts of result files to their formats. @throws ScenarioError
void check_formats(const fs::path& dir, const ResultTexts& texts) {
  const auto text_of = [&](std::string_view name) -> const std::string* {
    const auto found = texts.find(name);
    return found == texts.end() ? nullptr : &found->second;
  };
  for (const auto& [name, noun] : {std::pair(kSummary, "summary"), std::pair(kTiming, "timing")})
    if (const std::string* text = text_of(name); text != nullptr) {
      const std::string file = dir / name;
      check_ranges(input::read_document(*text, file, {noun}), file);
    }
  check_table(dir / kRowTable, *text_of(kRowTable), row_array_kinds());
  if (const std::string* torques = text_of(kTorqueTable)) check_table(dir / kTorqueTable, *torques, torque_array_kinds());
}

}  // namespace

void check_output_directory(const fs::path& dir, const Scene& scene, bool force) {
  if (dir.empty()) refuse_file("--out", "the directory's name is empty; give a name");
  require_place_for_directory(dir, "choose another --out");
  if (is_something_at(dir)) check_present_files(dir, scene, force);
}

fs::path free_output_directory(const fs::path& dir, const Scene& scene) {
  constexpr int kMost = 1000;
  for (int number = 1;; ++number) {
    const fs::path candidate = number == 1 ? dir : fs::path(fmt::format("{}-{}", dir.string(), number));
    try {
      check_output_directory(candidate, scene, false);
      return candidate;
    } catch (const ScenarioError&) {
      if (number == kMost || !is_something_at(candidate)) throw;
    }
  }
}

void write_file(const fs::path& file, const std::function<std::string()>& content) {
  struct stat status = {};
  if (::lstat(file.c_str(), &status) != 0 && errno != ENOENT && errno != ENOTDIR) fail_to_write(file, errno);
  if (!file.has_filename() || (status.st_mode != 0 && !S_ISREG(status.st_mode)))
    refuse_file(file, "is not the name of a file, or something other than a file has that name; give a file");
  const std::string name = file.filename().string();
  const std::string_view names[] = {name};
  FileSet files(file.has_parent_path() ? file.parent_path() : fs::path("."), names);
  files.add(name, content());
  files.commit();
}

void write_file(const fs::path& file, std::string_view content) {
  write_file(file, [&] { return std::string(content); });
}

double writing_seconds(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  // As measured; rows that are made when they are written take as long again.
  const double seconds_a_row = (scenario.precision == Precision::bits53 ? 3e-6 : 8e-5) * (is_made_row_by_row(scene) ? 2 : 1);
  return (scenario.ledger ? 2 : 1) * seconds_a_row * scenario.duration_s / scenario.output_step_s;
}

RunSize expected_size(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  // As measured in 15 runs of 1e4 to 2.4e5 rows; the rest is the program, and the files beside the rows.
  struct BytesARow {
    double memory, of_ledger, trajectory, torques;
  };
  const bool on_table = support_of(scenario).has_contact;
  const BytesARow row = [&]() -> BytesARow {
    switch (scenario.precision) {
      case Precision::bits53: return on_table ? BytesARow{2400, 150, 870, 490} : BytesARow{1130, 150, 550, 330};
      case Precision::bits64: return on_table ? BytesARow{4600, 1300, 1010, 560} : BytesARow{2300, 1300, 630, 370};
      case Precision::bits113: break;
    }
    return on_table ? BytesARow{4500, 1000, 1600, 850} : BytesARow{2200, 1200, 1000, 500};
  }();
  constexpr double kProgram = 2.2e7, kOtherFiles = 4e4;
  const double rows = scenario.duration_s / scenario.output_step_s + 1;
  const double held = is_made_row_by_row(scene) ? 0 : row.memory + (scenario.ledger ? row.of_ledger : 0);
  return {kProgram + rows * held, kOtherFiles + rows * (row.trajectory + (scenario.ledger ? row.torques : 0))};
}

std::string bytes_text(double bytes) {
  constexpr double kMega = 1e6, kGiga = 1e9;
  if (bytes < 0.095 * kMega) return "less than 0.1 MB";
  return bytes < 0.995 * kGiga ? fmt::format("{:.2g} MB", bytes / kMega) : fmt::format("{:.2g} GB", bytes / kGiga);
}

std::string write_results(const RunResult& result, const fs::path& dir, bool force, const Watch& watch) {
  return write_set(dir, result.scene, force, watch, [&](SealedSet& set) {
    set.add(kRowTable,
            [&](const FileSet::Sink& sink) { write_trajectory_csv(result, sink, watch.part(0, result.ledger ? 0.5 : 1)); });
    if (result.ledger)
      set.add(kTorqueTable, [&](const FileSet::Sink& sink) { write_torques_csv(result, sink, watch.part(0.5, 1)); });
    set.add(kFigure, [&](const FileSet::Sink& sink) { sink(svg(drift_figure(result))); });
    return Documents{summary_json(result), timing_json(result)};
  });
}

void write_results(const ResultTexts& texts, const Scene& scene, const fs::path& dir, bool force) {
  write_set(dir, scene, force, {}, [&](SealedSet& set) {
    for (const std::string_view name : {kRowTable, kTorqueTable, kFigure})
      if (const auto found = texts.find(name); found != texts.end())
        set.add(name, [&](const FileSet::Sink& sink) { sink(found->second); });
    const auto timing = texts.find(kTiming);
    return Documents{texts.at(std::string(kSummary)), timing == texts.end() ? "" : timing->second};
  });
}

ResultTexts read_result_texts(const fs::path& dir, std::vector<std::string>* notes) {
  ResultTexts texts;
  for (const std::string_view name : kFiles) {
    const std::string file = dir / name;
    if (!is_something_at(file)) continue;
    texts.emplace(name, input::read_regular_file(file, file, {"result file", false, kLargestText_MiB}));
  }
  for (const std::string_view name : {kSummary, kRowTable})
    if (!texts.contains(name)) refuse_file(dir, fmt::format("holds no results: it has no {}", name));
  check_result_texts(dir, texts, notes);  // which reads the summary
  check_formats(dir, texts);
  for (auto& [name, text] : texts)
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  for (const std::string_view name : {kSummary, kTiming})
    if (const auto found = texts.find(name); found != texts.end()) found->second = unsealed(found->second);
  return texts;
}

}  // namespace earthtop
