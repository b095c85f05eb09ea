// SPDX-License-Identifier: GPL-3.0-or-later
/// One side of a comparison: the results, reference or other file at a path.
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
  csv,        ///< a trajectory in one CSV file
  store,      ///< the store of a study
  collection  ///< a directory of several of these
};

/// Whether a name is there, a link that leads nowhere included. @throws as `input::type_of`
bool is_there(const fs::path& path);

/// The kind of the file or directory at a path. @throws ScenarioError where it is none of these kinds
ComparandKind kind_of(const fs::path& path);

/// A JSON document, wrapped so that code which only hands it on does not need the full JSON type. Copies share the content.
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
  Document summary;                          ///< summary of a run; null for a CSV
  Document timing;                           ///< null where there is none
  bool has_some_rows_only = false;           ///< a compact reference: the other side's rows between its own are not compared
  std::optional<double> attitude_error_rad;  ///< for a mapped CSV: the error stated by its author
  /// Opens the rows at the first one; may be called several times. @throws as `RowSource`
  std::function<std::unique_ptr<RowSource>()> open_rows;
  std::function<std::unique_ptr<RowSource>()> open_torques;  ///< null where there are none
  std::optional<std::uint64_t> stated_rows;                  ///< number of rows stated by the summary
  std::vector<fs::path> unverified;                          ///< the files, or the directory, that have no checksums
  std::string generator;                                     ///< for a compact reference: the program that made it

  /// The number at a JSON pointer of the summary; none where there is no number.
  std::optional<double> number(const std::string& pointer) const;
  std::string word(const std::string& pointer) const;
  /// Wall time of both integrations (s); none where it is not known.
  std::optional<double> seconds() const;
  /// Whether it has a run's summary.
  bool has_summary() const;
};

/// @param mapping  meaning of a foreign CSV's columns; may be null
Comparand open_comparand(const fs::path& path, const Mapping* mapping);

/// The comparands in a directory of several, with their names: the paths below it (without .json for a compact reference).
/// Sorted by name. Updates of them that were interrupted are completed first.
std::vector<std::pair<std::string, fs::path>> members(const fs::path& directory);

/// Reads a JSON file that earthtop has written. @param noun  the kind of file, for messages   @throws ScenarioError where it is not
/// JSON, or a number is out of its range; ReadError
/// @param check  is given the text before it is read; may be null
Json read_json_file(const fs::path& file, std::string_view noun, const std::function<void(std::string_view)>& check = nullptr);

}  // namespace earthtop::compare
