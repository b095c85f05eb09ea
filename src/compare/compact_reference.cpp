// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/compact_reference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/elementary.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/provenance.hpp"
#include "results/csv.hpp"
#include "results/figures.hpp"
#include "results/number_ranges.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop::compare {
namespace {

constexpr std::uint64_t kRows = 11;

class KeptRows : public RowSource {
 public:
  KeptRows(std::shared_ptr<const std::vector<Row>> rows, std::vector<bool> columns, std::string file)
      : rows_(std::move(rows)), columns_(std::move(columns)), file_(std::move(file)) {}
  bool next(Row& row) override {
    if (at_ == rows_->size()) return false;
    row = (*rows_)[at_++];
    return true;
  }
  bool has_column(std::size_t column) const override { return columns_[column]; }
  std::string where() const override { return fmt::format("{}, row {}", file_, at_); }

 private:
  std::shared_ptr<const std::vector<Row>> rows_;
  std::vector<bool> columns_;
  std::string file_;
  std::size_t at_ = 0;
};

Row row_of(const Json& numbers, const std::vector<std::size_t>& places, const fs::path& file) {
  if (!numbers.is_array() || numbers.size() != places.size() + 1 || !numbers[0].is_number())
    refuse_file(file,
                "the number of cells in a row is not the number of columns, or a row has no time; write the reference again");
  Row row;
  row.t_s = numbers[0].get<double>();
  row.kind.fill(CellKind::empty);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!numbers[i + 1].is_number()) continue;
    row.value[places[i]] = numbers[i + 1].get<double>();
    const std::string& column = trajectory_table().columns[places[i]];
    if (const std::string_view wanted = fault_of(range_of(column), row.value[places[i]]); !wanted.empty())
      refuse_file(file, fmt::format("its {} at {} s is {}, but must be {}; write the reference again", column, row.t_s,
                                    row.value[places[i]], wanted));
    row.kind[places[i]] = CellKind::number;
  }
  return row;
}

/// The part of a summary that a compact reference keeps: the top-level members in which something is compared or counted as
/// cost, and the members that state where the results come from.
Json kept_of(const Json& summary) {
  Json kept = Json::object();
  for (const auto& [key, value] : summary.items()) {
    const auto members = summary_members();
    const bool counts = std::any_of(members.begin(), members.end(), [&, name = key](const SummaryMember& member) {
      return member.path.substr(0, member.path.find('.')) == name && member.kind != FigureKind::not_compared;
    });
    if (counts || key == "$schema" || key == "name" || key == "scenario" || key == "provenance") kept[key] = value;
  }
  for (const std::string_view key : describing_keys()) kept["scenario"].erase(std::string(key));
  for (const char* key : {"constants", "libraries", "flags"}) kept["provenance"].erase(key);
  return kept;
}

/// The number of digits of the final drift that are certain by its error bound; for a run without a drift, of the attitude.
int known_digits(const Comparand& results) {
  const double drift = results.number("/drift/axis_final_rad").value_or(0);
  const double bound = drift > 0 ? results.number("/drift/axis_bound_rad").value_or(drift) / drift
                                 : results.number("/attitude_bound_rad").value_or(1);
  constexpr int kOfDouble = 16;
  return bound > 0 ? std::clamp(static_cast<int>(-real::log10(bound)), 0, kOfDouble) : kOfDouble;
}

std::string row_text(const Row& row, const std::vector<std::size_t>& places) {
  std::string text = "  [";
  append_number(text, row.t_s);
  for (const std::size_t place : places) {
    text += ',';
    if (row.kind[place] == CellKind::number)
      append_number(text, row.value[place]);
    else
      text += "null";
  }
  return text + ']';
}

void require_members(const Json& json, const fs::path& file) {
  if (!json.contains("$schema") || json.at("$schema") != kReferenceSchema)
    refuse_file(file,
                fmt::format("is not a reference: its $schema is not \"{}\"; give a directory of results, or a reference that "
                            "compare --update has written",
                            kReferenceSchema));
  for (const char* key : {"summary", "columns", "rows", "generator"})
    if (!json.contains(key)) refuse_file(file, fmt::format("has no \"{}\"; write the reference again", key));
}

void require_whole_summary(const Comparand& reference) {
  if (!reference.has_summary() || reference.word("/provenance/scenario_sha256").empty())
    refuse_file(reference.path, "its summary has no scenario hash; write the reference again");
  for (const char* key : {"scenario", "drift", "outcome", "motion", "invariants"})
    if (!reference.summary->contains(key))
      refuse_file(reference.path, fmt::format("its summary has no \"{}\"; write the reference again", key));
}

/// The places of the columns after the time in a row of trajectory.csv.
std::vector<std::size_t> places_of(const Json& columns, const fs::path& file) {
  std::vector<std::size_t> places;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    const Json& name = columns.at(i);
    const auto place = name.is_string() ? trajectory_table().find(name.get<std::string>()) : std::nullopt;
    if (!place || std::find(places.begin(), places.end(), *place) != places.end())
      refuse_file(file, fmt::format("its column {} is not one of trajectory.csv, or occurs twice", written(name)));
    places.push_back(*place);
  }
  return places;
}

std::vector<Row> rows_of(const Json& json, const std::vector<std::size_t>& places, const fs::path& file) {
  std::vector<Row> rows;
  for (const Json& numbers : json.at("rows")) {
    rows.push_back(row_of(numbers, places, file));
    if (rows.size() > 1 && !(rows.back().t_s > rows[rows.size() - 2].t_s)) refuse_file(file, "its rows are not in order");
  }
  if (rows.empty() || json.value("row_count", Json()) != rows.size())
    refuse_file(file, "does not have as many rows as it states (row_count); write the reference again");
  return rows;
}

}  // namespace

Comparand open_compact_reference(const fs::path& file) {
  Comparand reference;
  reference.path = file;
  const Json json = read_json_file(file, "reference", [&](std::string_view text) {
    if (!check_seal(text, file, "write the reference again")) reference.unverified.push_back(file);
  });
  require_members(json, file);
  reference.summary = json.at("summary");
  require_whole_summary(reference);
  const Json& names = json.at("columns");
  if (!names.is_array() || names.empty() || names.at(0) != "t_s" || !json.at("rows").is_array())
    refuse_file(file, "its columns do not begin with t_s, or it has no rows; write the reference again");
  reference.has_some_rows_only = true;
  reference.generator = json.at("generator").is_string() ? json.at("generator").get<std::string>() : "";
  const std::vector<std::size_t> places = places_of(names, file);
  std::vector<bool> columns(Row::kMostColumns, false);
  for (const std::size_t place : places) columns[place] = true;
  const auto rows = std::make_shared<const std::vector<Row>>(rows_of(json, places, file));
  reference.stated_rows = rows->size();
  reference.open_rows = [rows, columns, name = file.string()] { return std::make_unique<KeptRows>(rows, columns, name); };
  return reference;
}

Json with_reason(Json history, const std::string& reason) {
  Json entry = {{"reason", reason}, {"version", build_info().version}, {"commit", build_info().commit}};
  if (history.empty() || history.back() != entry) history.push_back(std::move(entry));
  return history;
}

std::string compact_reference(const Comparand& results, Json history, const std::string& reason) {
  const Table& table = trajectory_table();
  const std::unique_ptr<RowSource> rows = results.open_rows();
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (rows->has_column(i)) places.push_back(i);
  const std::uint64_t last = std::max<std::uint64_t>(results.stated_rows.value_or(1), 1) - 1;
  std::string rows_text;
  Row row;
  std::uint64_t number = 0, kept = 0, kept_rows = 0;
  // Equally spaced, the ends included.
  const auto wanted = [last](std::uint64_t k) { return (k * last + (kRows - 1) / 2) / (kRows - 1); };
  for (; rows->next(row); ++number) {
    if (number != wanted(kept)) continue;
    while (number == wanted(kept) && kept < kRows) ++kept;
    rows_text += (rows_text.empty() ? "" : ",\n") + row_text(row, places);
    ++kept_rows;
  }

  Json columns = Json::array({"t_s"});
  for (const std::size_t place : places) columns.push_back(table.columns[place]);
  const auto tolerance = results.number("/solution/relative_tolerance");
  Json head = {{"$schema", kReferenceSchema},
               {"generator",
                fmt::format("earthtop run, {} in {}{}", results.word("/solution/method"), results.word("/solution/precision"),
                            tolerance ? fmt::format(", relative tolerance {}", *tolerance) : "")},
               {"precision", results.word("/solution/precision")},
               {"digits", known_digits(results)},
               {"history", with_reason(std::move(history), reason)},
               {"summary", kept_of(*results.summary)},
               {"row_count", kept_rows},
               {"columns", std::move(columns)}};
  std::string text = written(head, 1);
  text.resize(text.rfind('\n'));  // the closing brace comes after the rows
  return sealed(text + ",\n \"rows\": [\n" + rows_text + "\n ]\n}\n");
}

}  // namespace earthtop::compare
