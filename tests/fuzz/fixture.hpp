// SPDX-License-Identifier: GPL-3.0-or-later
/// Sound files of every kind, made once a process: what seeds are made of, and what hostile files are held against.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "earthtop/scenario/scenario.hpp"
#include "earthtop/study/study.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::fuzz {

/// The results of a run as texts.
struct ResultFiles {
  std::string summary, trajectory, torques, timing;
};
/// As the parts of an input; parts that are missing are empty.
std::string input_of(const ResultFiles& files);
ResultFiles result_files_in(std::string_view input);
/// Writes them, but none that is empty.
void put(const ResultFiles& files, const std::filesystem::path& directory);
/// The same with the checksums that documents would have been written with.
ResultFiles with_checksums(ResultFiles files);
/// The results, without their checksums, of a run.
using Sets = std::vector<std::pair<std::string, std::string>>;
ResultFiles results_of(const ScenarioSource& scenario, const Sets& sets);
/// The same of runs whose pages differ in what they show.
std::vector<ResultFiles> results_of_many_kinds();

class Fixture {
 public:
  static const Fixture& get();

  std::filesystem::path results() const { return directory_.path() / "results"; }  ///< of a run, with checksums
  std::filesystem::path store() const;  ///< of a study of four points, one of which is refused
  std::string content(const std::filesystem::path& name) const;
  ResultFiles result_files() const;  ///< of a top's run over six rows, with a ledger, without their checksums
  ScenarioSource scenario() const;
  Study study() const;

  std::string reference() const;   ///< a compact reference of the results, without its checksum
  std::string comparison() const;  ///< documents
  std::string bench() const;
  std::string measurement() const;
  std::string releases() const;
  std::string plan() const;

 private:
  Fixture();
  testing::TemporaryDirectory directory_;
};

/// Stores of studies that differ in their designs, axes and fits; the numbers of their points are made up.
std::vector<std::string> stores_of_many_kinds();

/// A shipped file, by its path below scenarios/.
std::string shipped(const std::string& path);
/// The paths below scenarios/ of the shipped files of a directory that end in .json.
std::vector<std::string> shipped_in(const std::string& directory);
/// The texts of JSONTestSuite's kinds (tests/hostile), whatever becomes of them.
std::vector<std::string> hostile_texts();

}  // namespace earthtop::fuzz
