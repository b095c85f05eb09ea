// SPDX-License-Identifier: GPL-3.0-or-later
/// One side of a comparison: what a path leads to.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/row_source.hpp"

namespace earthtop::compare {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

enum class ComparandKind {
  results,    ///< a directory that `run` has written
  reference,  ///< compact: summary and some rows in one JSON file
  csv,
  store,      ///< of a study
  collection  ///< a directory of several of these
};

/// @throws ScenarioError for a file or directory that is not what it should be
[[noreturn]] void refuse_path(const fs::path& path, std::string message);
bool is_there(const fs::path& path);

/// The kind of the file or directory at a path. @throws ScenarioError where it is none of these kinds
ComparandKind kind_of(const fs::path& path);

/// A JSON document that those who only hand it on need not know. Copies share it.
class Document {
 public:
  Document();           ///< null
  Document(Json json);  // NOLINT: its content is what it is
  const Json& operator*() const { return *json_; }
  const Json* operator->() const { return json_.get(); }

 private:
  std::shared_ptr<const Json> json_;
};

struct Comparand {
  fs::path path;
  Document summary;                          ///< of a run; null of a CSV
  Document timing;                           ///< null where there is none
  bool has_some_rows_only = false;           ///< a compact reference: rows of the other between its own are of no concern
  std::optional<double> attitude_error_rad;  ///< of a mapped CSV, stated
  /// Opens the rows anew. @throws as `RowSource`
  std::function<std::unique_ptr<RowSource>()> open_rows;
  std::function<std::unique_ptr<RowSource>()> open_torques;  ///< null where there are none
  std::optional<std::uint64_t> stated_rows;                  ///< by its summary
  std::string generator;                                     ///< of a compact reference

  /// A number of the summary, null where it has none.
  std::optional<double> number(const std::string& pointer) const;
  std::string word(const std::string& pointer) const;
  /// Wall time of both integrations (s), where it is known.
  std::optional<double> seconds() const;
  /// Whether it is of a run.
  bool has_summary() const;
};

/// @param mapping  of a foreign CSV; may be null
Comparand open_comparand(const fs::path& path, const Mapping* mapping);

/// The comparands in a directory of several, by their paths below it (a compact reference without its .json), sorted.
std::vector<std::pair<std::string, fs::path>> members(const fs::path& directory);

/// JSON of a file that a program wrote. @throws ScenarioError where it is none; ReadError
Json read_json_file(const fs::path& file, std::string_view noun);

}  // namespace earthtop::compare
