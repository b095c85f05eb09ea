// SPDX-License-Identifier: GPL-3.0-or-later
/// Results of a short run, changed copies of them, and how they are compared.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "earthtop/compare/compare.hpp"
#include "earthtop/results/results.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::testing {

namespace fs = std::filesystem;

inline std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}
inline void write_text(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// A CSV file, split into cells.
struct Csv {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    return cells;
  }
  explicit Csv(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    header = cells(line);
    while (std::getline(stream, line)) rows.push_back(cells(line));
  }
  std::string text() const {
    std::ostringstream out;
    const auto put = [&](const std::vector<std::string>& line) {
      for (std::size_t i = 0; i < line.size(); ++i) out << (i ? "," : "") << line[i];
      out << '\n';
    };
    put(header);
    for (const auto& row : rows) put(row);
    return out.str();
  }
  std::size_t column(const std::string& name) const {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i] == name) return i;
    throw std::runtime_error("no column " + name);
  }
  double get(std::size_t row, const std::string& name) const { return std::stod(rows[row][column(name)]); }
  void set(std::size_t row, const std::string& name, double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    rows[row][column(name)] = text.str();
  }
};

/// A toy top over six seconds, 61 rows, run once for all tests of a process.
class ShortRun {
 public:
  static const ShortRun& get() {
    static const ShortRun run;
    return run;
  }
  fs::path path() const { return directory_.path() / "reference"; }

 private:
  ShortRun() {
    const Scenario scenario =
        parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json"), {{"/motion/duration_s", "6"}});
    write_results(run(scenario), path(), false);
  }
  TemporaryDirectory directory_;
};

/// Removes the checksums of results that are to be changed.
inline void forget_checksums(const fs::path& directory) {
  auto summary = parse_ordered_json(read_text(directory / "summary.json"));
  summary.erase("files");
  summary.erase("checksum");
  write_text(directory / "summary.json", text_of(summary));
}

inline void write_results_to_be_changed(const RunResult& result, const fs::path& directory) {
  write_results(result, directory, false);
  forget_checksums(directory);
}

/// A copy of the short run's results, to be changed.
class ChangedCopy {
 public:
  explicit ChangedCopy(const std::function<void(Csv&)>& change) : ChangedCopy() {
    Csv csv(path() / "trajectory.csv");
    change(csv);
    write_text(path() / "trajectory.csv", csv.text());
  }
  /// Without checksums, which would say that it has been changed.
  ChangedCopy() {
    fs::copy(ShortRun::get().path(), path());
    forget_checksums(path());
  }
  fs::path path() const { return directory_.path() / "new"; }

 private:
  TemporaryDirectory directory_;
};

/// A row in the middle of the short run, t = 3 s.
constexpr std::size_t kSome = 30;

inline CompareOptions with_profile(Profile profile) {
  CompareOptions options;
  options.tolerances.profile = profile;
  return options;
}

/// Compares a candidate with the short run as its reference.
inline PairReport compared(const fs::path& candidate, const CompareOptions& options = {}) {
  return compare_results(ShortRun::get().path(), candidate, options).pairs.at(0);
}

inline const QuantityVerdict& quantity(const PairReport& pair, const std::string& name) {
  for (const QuantityVerdict& verdict : pair.quantities)
    if (verdict.name == name) return verdict;
  throw std::runtime_error("no quantity " + name);
}

inline bool has_finding(const PairReport& pair, const std::string& kind) {
  return std::any_of(pair.findings.begin(), pair.findings.end(), [&](const CompareFinding& f) { return f.kind == kind; });
}

inline bool mentions(const std::vector<std::string>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) { return text.find(part) != text.npos; });
}

}  // namespace earthtop::testing
