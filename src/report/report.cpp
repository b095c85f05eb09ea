// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/report/report.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "compare/comparand.hpp"
#include "compare/replacement.hpp"
#include "earthtop/error.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/document.hpp"
#include "input/file.hpp"
#include "report/pages.hpp"
#include "results/number_ranges.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace report {
namespace {

// A measurement of 200,000 axes makes 150 MiB with 4 million values.
constexpr std::size_t kMostDocument_MiB = 256, kMostDocumentValues = 10'000'000;
constexpr const char* kStandardInput = "-";

/// Whether a file, or standard input, holds a document and not a store: its name, or its first character, tells.
bool is_document(const std::filesystem::path& what) {
  if (what == kStandardInput) return true;
  const input::PathType type = input::type_of(what.string());
  if (what.extension() == ".json") return type != input::PathType::directory;
  if (type != input::PathType::file) return false;
  const input::Descriptor file = input::open_regular_file(what.string(), what.string(), {"document", false});
  std::string head(std::size_t{1} << 10, '\0');
  head.resize(input::read_some(file, what.string(), head.data(), head.size()));
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != head.npos && head[first] == '{';
}

/// The function that makes the page of a document; null where there is none.
Report (*page_maker(const Json& document))(const Json&, const std::vector<std::string>&) {
  const Json schema = document.value("$schema", Json());
  if (schema == "earthtop-comparison-1.json") return comparison_page;
  if (schema == "earthtop-measurement-1.json") return measurement_page;
  if (schema == "earthtop-releases-1.json") return releases_page;
  if (schema == "earthtop-plan-1.json") return plan_page;
  return document.contains("scenarios") && document.contains("processor") ? bench_page : nullptr;
}

Report document_page(const std::filesystem::path& file) {
  const input::FileUse use{"document", false, kMostDocument_MiB};
  const std::string text =
      file == kStandardInput ? input::read_standard_input(use) : input::read_regular_file(file.string(), file.string(), use);
  const std::string name = file == kStandardInput ? "<stdin>" : file.string();
  const Json document = input::read_document(text, name, {use.noun, use.most_MiB, kMostDocumentValues});
  std::vector<std::string> notes;
  if (!check_seal(text, name, "write it anew; if you have changed it yourself, remove its member \"checksum\""))
    notes.push_back(unverified(name));
  const auto make_page = page_maker(document);
  if (make_page == nullptr)
    refuse_file(file, "is no document of compare, plan or bench --json; give one, or a directory of results or of a study");
  check_ranges(document, name);
  return make_page(document, notes);
}

}  // namespace
}  // namespace report

Report make_report(const std::filesystem::path& what, const Watch& watch, const std::string& gallery) try {
  using compare::ComparandKind;
  if (report::is_document(what)) return report::document_page(what);
  compare::finish_update(what);
  switch (compare::kind_of(what)) {
    case ComparandKind::results: return report::run_page(what, watch, gallery);
    case ComparandKind::store: return report::study_page(store_at(what), watch, gallery);
    default:
      refuse_file(what,
                  "is neither the results of a run nor a study; give one of them, or a document of compare, plan or bench");
  }
} catch (const report::Json::exception& error) {
  refuse_file(what, fmt::format("is not as this program writes it; write it anew ({})", complaint_of(error)));
}

std::filesystem::path report_file(const std::filesystem::path& what) {
  if (what == report::kStandardInput) return "report.html";
  if (input::type_of(what.string()) == input::PathType::directory) return what / "report.html";
  std::filesystem::path file = what;
  return file.replace_extension(".html");
}

}  // namespace earthtop
