// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/filed_table.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>

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

}  // namespace

void decode_table(const Section& section, const ScenarioSource& source, double duration_s, const TableKind& kind,
                  FiledTable& table) {
  const auto file = section.word("file");
  if (!file) return;
  const auto text = read_table(section, source, *file);
  if (!text) return;
  table.file_sha256 = sha256_hex(*text);
  const auto sha256 = section.word("file_sha256");
  if (sha256 && *sha256 != table.file_sha256)
    section.refuse("file_sha256", fmt::format("is not that of {}, {}; use the file that was meant, or leave this key out",
                                              excerpt(*file, kLongestShownPath), table.file_sha256));
  auto parsed = parse_angle_table(*text, duration_s, kind);
  if (const auto* fault = std::get_if<TableFault>(&parsed))
    return section.refuse("file", fmt::format("{}:{}: {}", excerpt(*file, kLongestShownPath), fault->line, fault->message));
  table.rows = std::make_shared<const AngleTable>(std::get<AngleTable>(std::move(parsed)));
}

}  // namespace earthtop::scenario
