// SPDX-License-Identifier: GPL-3.0-or-later
/// Evaluation of a benchmark report: the Pareto front, the cost at equal error, and the documents made of them.
#pragma once

#include <array>
#include <filesystem>

#include "earthtop/bench/bench.hpp"
#include "earthtop/plot/plot.hpp"

namespace earthtop {

/// The error of a completed entry, but at least the error of the reference. None if the entry has no such error.
std::optional<double> error_of(const BenchEntry& entry, const CertifiedReference& reference, ErrorKind kind);

/// For each entry, whether it is on the Pareto front: no other entry is at least as fast and as exact, and better in one of the
/// two.
std::vector<bool> pareto_front(const BenchReport& report, ErrorKind kind);

/// Entries that differ only in tolerance or step.
struct BenchFamily {
  Contender first;
  std::vector<std::size_t> entries;
};
std::vector<BenchFamily> families(const BenchReport& report);

/// The errors at which costs are compared (rad).
inline constexpr std::array<double, 3> kEqualErrors = {1e-6, 1e-9, 1e-12};

/// The time that a family needs to reach an error (s): interpolated between two of its entries, or else (`at_most`) the time of
/// the cheapest entry that is more exact.
struct FamilyCost {
  double seconds = 0;
  bool at_most = false;
};
std::optional<FamilyCost> family_cost(const BenchReport& report, const BenchFamily& family, ErrorKind kind, double error);

/// E.g. "AMD EPYC, 2 cores", from /proc/cpuinfo.
std::string processor_description();

/// One header line and one line for each entry; seconds and rad; the errors as computed, empty if there are none.
std::string bench_csv(const BenchReport& report);

/// All reports as one JSON document with a final newline.
std::string bench_json(std::span<const BenchReport> reports);

/// Error against processor time, both logarithmic: one line for each family, with the Pareto front drawn under them.
Figure bench_figure(const BenchReport& report);

/// Checks whether NAME.csv and NAME.svg of these scenarios may be written to `dir`, which need not exist.
/// @param force  overwrite existing files   @throws ScenarioError, WriteError
void check_bench_directory(const std::filesystem::path& dir, std::span<const std::string> scenarios, bool force);

/// Writes the files of all reports, or none.   @throws as check_bench_directory, which it calls; WriteError
void write_bench(std::span<const BenchReport> reports, const std::filesystem::path& dir, bool force);

}  // namespace earthtop
