// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/filed_table.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "input/file.hpp"
#include "text/sha256.hpp"

namespace earthtop::scenario {
namespace {

constexpr std::size_t kLongestShownPath = 200;

/// Returns the table's bytes; empty if the file has been refused.
std::optional<std::string> read_table(const Section& section, const ScenarioSource& source, const std::string& file) {
  if (!source.may_name_files)
    section.refuse("file", "files are not read here; give a motion without a table");
  else if (file.empty() || file.find('\0') != std::string::npos)
    section.refuse("file", "names no file; must be the path of a CSV file");
  else
    try {
      const std::filesystem::path path = std::filesystem::path(source.file).parent_path() / file;
      return input::read_regular_file(path.string(), excerpt(path.string(), kLongestShownPath), {"table"});
    } catch (const ScenarioError& error) {
      for (const Diagnostic& diagnostic : error.diagnostics())
        section.refuse("file", fmt::format("{}: {}", error.file(), diagnostic.message));
    }
  return std::nullopt;
}

/// Reads the tables, one for each column after the times; refuses the file where they are not sound.
std::vector<AngleTable> decode_columns(const Section& section, const ScenarioSource& source, double duration_s,
                                       const TableKind& kind, FiledTable& table) {
  const auto file = section.word("file");
  if (!file) return {};
  const auto text = read_table(section, source, *file);
  if (!text) return {};
  table.file_sha256 = sha256_hex(*text);
  const auto sha256 = section.word("file_sha256");
  if (sha256 && *sha256 != table.file_sha256)
    section.refuse("file_sha256", fmt::format("is not that of {}, {}; use the file that was meant, or leave this key out",
                                              excerpt(*file, kLongestShownPath), table.file_sha256));
  auto parsed = parse_tables(*text, duration_s, kind);
  if (const auto* fault = std::get_if<TableFault>(&parsed)) {
    section.refuse("file", fmt::format("{}:{}: {}", excerpt(*file, kLongestShownPath), fault->line, fault->message));
    return {};
  }
  return std::get<std::vector<AngleTable>>(std::move(parsed));
}

}  // namespace

void decode_table(const Section& section, const ScenarioSource& source, double duration_s, const TableKind& kind,
                  FiledTable& table) {
  std::vector<AngleTable> columns = decode_columns(section, source, duration_s, kind, table);
  if (!columns.empty()) table.rows = std::make_shared<const AngleTable>(std::move(columns.front()));
}

void decode_table(const Section& section, const ScenarioSource& source, double duration_s, const TableKind& kind,
                  std::array<FiledTable, 3>& coordinates) {
  FiledTable& first = coordinates[0];
  std::vector<AngleTable> columns = decode_columns(section, source, duration_s, kind, first);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    coordinates[i].file = first.file, coordinates[i].file_sha256 = first.file_sha256;
    coordinates[i].rows = std::make_shared<const AngleTable>(std::move(columns[i]));
  }
}

}  // namespace earthtop::scenario
