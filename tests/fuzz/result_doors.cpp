// SPDX-License-Identifier: GPL-3.0-or-later
// The doors of what the program wrote and reads again: results of a run, compact references, documents, stores of studies.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/compact_reference.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/study/run_study.hpp"
#include "earthtop/study/study_columns.hpp"
#include "fuzz/door.hpp"
#include "fuzz/fixture.hpp"
#include "fuzz/properties.hpp"
#include "results/seal.hpp"
#include "study/sqlite.hpp"
#include "text/checksum.hpp"
#include "text/json.hpp"

namespace earthtop::fuzz {
namespace {

namespace fs = std::filesystem;

/// Options of a comparison, which the input decides.
CompareOptions options_for(std::string_view input) {
  const std::uint64_t choice = checksum_of(input);
  CompareOptions options;
  options.with_curves = true;
  options.tolerances.profile = std::array{Profile::regression, Profile::physics, Profile::bitwise}[choice % 3];
  options.may_lack_rows = (choice >> 8U) % 4 == 0;
  if ((choice >> 12U) % 2 == 0) options.may_change = {"/"};
  return options;
}

void check_comparison(const fs::path& reference, const fs::path& candidate, const CompareOptions& options = options_for("")) {
  accepts([&] {
    const CompareReport report = compare_results(reference, candidate, options);
    for (const PairReport& pair : report.pairs)
      for (const QuantityVerdict& quantity : pair.quantities)
        demand(!quantity.passed || !std::isnan(quantity.largest), "a difference that passes is a number", quantity.name);
    check_json(comparison_json(report));
    check_markup(svg(comparison_figure(report)));
    const std::string xml = comparison_junit(report);
    demand(printable(xml).find("\\x") == std::string::npos || xml.find('\0') == std::string::npos, "XML without NUL", xml);
  });
}

/// Sound results of the scenario that a summary names; else those of the fixture.
fs::path sound_results_like(const std::string& summary) {
  static const testing::TemporaryDirectory directory;
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const ResultFiles& bare : results_of_many_kinds()) {
      const ResultFiles files = with_checksums(bare);
      list.push_back(json_of(files.summary).value("name", ""));
      put(files, directory.path() / list.back());
    }
    return list;
  }();
  for (const std::string& name : names)
    if (summary.find('"' + name + '"') != summary.npos) return directory.path() / name;
  return Fixture::get().results();
}

/// Results that were read can be written, and read back the same, with checksums that fit.
void check_copy(const ResultTexts& texts, const fs::path& dir) {
  const nlohmann::ordered_json summary = json_of(texts.at("summary.json"));
  const auto scenario = summary.find("scenario");
  if (scenario == summary.end()) return;
  const ScenarioReport report = examine_scenario({"", written_replacing(*scenario), false});
  if (!report.scene) return;
  write_results(texts, *report.scene, dir, false);
  ResultTexts again;
  const auto are_same = [](const auto& a, const auto& b) {  // a document may be laid out otherwise
    return a.first == b.first &&
           (a.second == b.second || (a.first.ends_with(".json") && json_of(a.second) == json_of(b.second)));
  };
  demand(accepts([&] { again = read_result_texts(dir); }) &&
             std::equal(texts.begin(), texts.end(), again.begin(), again.end(), are_same),
         "results read back", texts.at("summary.json"));
  demand(seal_of(content_of(dir / "summary.json")) == Seal::fits, "written results have checksums", texts.at("summary.json"));
}

/// Every text as it is, and once more without the checksum that most changes would contradict.
template <class Enter>
void with_and_without_checksum(const std::string& document, const Enter& enter) {
  enter(document);
  const std::string bare = unsealed(document);
  if (bare != document) enter(bare);
}

/// The files of a run as a directory of results.
template <class Enter>
void with_results(std::string_view input, const Enter& enter) {
  const ResultFiles files = result_files_in(input);
  with_and_without_checksum(files.summary, [&](const std::string& summary) {
    const fs::path dir = Scratch::empty() / "results";
    put({summary, files.trajectory, files.torques, files.timing}, dir);
    enter(dir, files.trajectory);
  });
}

}  // namespace

/// Results that can be compared either way, and copied.
void enter_results(std::string_view input) {
  with_results(input, [&](const fs::path& dir, const std::string& trajectory) {
    const CompareOptions options = options_for(input);
    const fs::path sound = sound_results_like(result_files_in(input).summary);
    check_comparison(sound, dir, options);
    check_comparison(dir, sound, options);
    check_comparison(sound.parent_path(), dir.parent_path(), options);  // directories of several results
    accepts([&] {
      const ResultTexts texts = read_result_texts(dir);
      demand(texts.find("trajectory.csv")->second == trajectory, "texts are those of the files", input);
      check_copy(texts, dir.parent_path() / "copy");
    });
  });
}

/// The page of a run's results.
void enter_run_page(std::string_view input) {
  with_results(input, [](const fs::path& dir, const std::string&) { check_report(dir); });
}

std::vector<std::string> results_seeds() {
  const ResultFiles bare = Fixture::get().result_files();
  ResultFiles few = bare;
  few.torques.clear(), few.timing.clear();
  const ResultFiles shorter = results_of(Fixture::get().scenario(), {{"/motion/duration_s", "0.3"}});
  std::vector<std::string> seeds = {input_of(bare), input_of(few), input_of(with_checksums(bare)), input_of(shorter)};
  for (const ResultFiles& files : results_of_many_kinds()) seeds.push_back(input_of(files));
  return seeds;
}

/// An accepted input can be compared, and written again as a reference with the same rows.
void enter_reference(std::string_view input) {
  with_and_without_checksum(std::string(input), [&](const std::string& text) {
    Scratch::empty();
    const fs::path file = Scratch::write("reference.json", text);
    check_comparison(file, Fixture::get().results());
    check_report(file);
    std::string written;
    std::vector<compare::Row> rows;
    const auto read_rows = [](const compare::Comparand& reference) {
      std::vector<compare::Row> list;
      const auto source = reference.open_rows();
      for (compare::Row row; source->next(row);) list.push_back(row);
      return list;
    };
    const bool accepted = accepts([&] {
      try {
        const compare::Comparand reference = compare::open_comparand(file, nullptr);
        rows = read_rows(reference);
        written = compare::compact_reference(reference, nlohmann::ordered_json::array(), "again");
      } catch (const nlohmann::ordered_json::exception&) {  // what its callers make a refusal of
      }
    });
    constexpr std::size_t kAllAreKept = 6;
    if (!accepted || written.empty() || rows.size() > kAllAreKept) return;
    check_json(written);
    const fs::path again = Scratch::write("again.json", written);
    std::vector<compare::Row> read;
    demand(accepts([&] { read = read_rows(compare::open_comparand(again, nullptr)); }), "a reference written anew is accepted",
           written);
    const auto same = [](const compare::Row& a, const compare::Row& b) {
      for (std::size_t i = 0; i < compare::trajectory_table().columns.size(); ++i)
        if (a.kind[i] != b.kind[i] || (a.kind[i] == compare::CellKind::number && a.value[i] != b.value[i])) return false;
      return a.t_s == b.t_s;
    };
    demand(std::equal(rows.begin(), rows.end(), read.begin(), read.end(), same), "a reference reads back", written);
  });
}

std::vector<std::string> reference_seeds() { return {Fixture::get().reference()}; }

/// A document, from which a page is made.
void enter_document(std::string_view input) {
  Scratch::empty();
  check_report(Scratch::write("document.json", input));
}

std::vector<std::string> comparison_document_seeds() { return {Fixture::get().comparison()}; }
std::vector<std::string> bench_document_seeds() { return {Fixture::get().bench()}; }
std::vector<std::string> measurement_document_seeds() { return {Fixture::get().measurement(), Fixture::get().releases()}; }
std::vector<std::string> plan_document_seeds() { return {Fixture::get().plan()}; }

/// The store of a study. What is found intact is shown, exported, compared and merged, and the copy holds the same points.
void enter_store(std::string_view input) {
  const fs::path store = study_store(Scratch::empty() / "study");
  Scratch::write("study/study.sqlite", input);
  std::string table;
  const auto export_table = [](const fs::path& from) {
    std::string text;
    study_csv(from, [&](std::string_view piece) { text += piece; });
    return text;
  };
  bool intact = false;
  accepts([&] {
    const StudyStoreCheck check = check_study_store(store);
    if (!check.damage.empty()) check_message(check.damage);
    intact = check.damage.empty() && check.has_checksums;  // without them nothing is known
  });
  const bool has_table = accepts([&] { table = export_table(store); });
  if (has_table) {
    const std::size_t rows = check_csv(table, true);
    accepts([&] {
      for (const StudyColumn& column : study_columns(store))
        demand(column.numbers.size() == rows, "a column has the table's rows", column.name);
    });
  }
  accepts([&] { check_json(study_json(store)); });
  check_report(store);
  check_comparison(Fixture::get().store(), store);
  if (!intact || !has_table) return;
  accepts([&] {
    merge_study_stores({store}, store.parent_path() / "merged", false);
    demand(export_table(study_store(store.parent_path() / "merged")) == table, "a merged store holds the same points", table);
  });
}

/// A damaged store of a study: once it has been repaired it holds what a sound one does.
void enter_repair(std::string_view input) {
  const auto table_of = [](const fs::path& store) {
    std::string text;
    study_csv(store, [&](std::string_view piece) { text += piece; });
    return text;
  };
  static const std::string kSound = table_of(Fixture::get().store());
  StudyRunOptions options;
  options.dir = Scratch::empty() / "study";
  options.jobs = 1;
  options.repair = true;
  Scratch::write("study/study.sqlite", input);
  accepts([&] {
    const StudyRunReport report = run_study(Fixture::get().study(), options);
    check_message("repaired: " + report.damage);
    const std::string table = table_of(report.store);
    check_csv(table, true);
    if (report.has_checksums) demand(table == kSound, "a repaired store holds what a sound one does", table);
  });
}

std::vector<std::string> store_seeds() {
  std::vector<std::string> seeds = stores_of_many_kinds();
  seeds.insert(seeds.begin(), content_of(Fixture::get().store()));
  return seeds;
}

/// The fixture's store, and the same one in pages so small that some points can be read where others cannot.
std::vector<std::string> repair_seeds() {
  const fs::path small = Scratch::write("small.sqlite", content_of(Fixture::get().store()));
  study::sqlite::Connection(small.string(), study::sqlite::Connection::Mode::write).execute("PRAGMA page_size = 512; VACUUM");
  return {content_of(Fixture::get().store()), content_of(small)};
}

}  // namespace earthtop::fuzz
