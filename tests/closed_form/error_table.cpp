// SPDX-License-Identifier: GPL-3.0-or-later
/// earthtop-closed-form-errors [COUNT] [REGIME ...]
/// Prints, as a Markdown table, the errors of the closed forms in double, compared with 113 bits, over COUNT random motions per
/// regime (1000 by default). A regime is named by any part of its name.

#include "closed_form/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace {

using namespace earthtop::test;

struct Row {
  long count = 0, beyond = 0, understated = 0;
  double error = 0, used = 0, statement = 0, tightness = 0, rate_used = 0, looseness = 0;
  std::string worst, loosest, tightest;
};

/// Motions are drawn in blocks, each with its own seed, so that the table does not depend on the number of threads.
constexpr long kBlock = 500;

void add_block(const Regime& regime, unsigned seed, long count, Row& row, std::mutex& lock) {
  std::mt19937_64 engine(seed);
  for (long k = 0; k < count; ++k) {
    const Measure m = regime.sample(engine);
    const double used = std::isfinite(m.error) && !std::isnan(m.error) ? used_part(m) : INFINITY;
    const std::lock_guard guard(lock);
    ++row.count;
    row.error = std::max(row.error, m.error);
    if (!(used <= row.used)) {
      row.used = used;
      row.worst = m.describe();
    }
    row.beyond += !(used <= 1);
    row.understated += !(m.error <= m.statement) || !(m.rate_error <= m.rate_statement);
    row.statement = std::max(row.statement, m.statement);
    const double rate_used = m.rate_error > 0 ? m.rate_error / m.rate_statement : 0;
    if (std::max(rate_used, m.error / m.statement) > std::max(row.rate_used, row.tightness)) row.tightest = m.describe();
    row.rate_used = std::max(row.rate_used, rate_used);
    row.tightness = std::max(row.tightness, m.error / m.statement);
    // Below one eps, the size of the error is a matter of chance.
    const double loose = m.statement / std::max(m.error, 1.11e-16 * (1 + m.phase / 1000));
    if (loose > row.looseness) {
      row.looseness = loose;
      row.loosest = m.describe();
    }
  }
}

Row run(const Regime& regime, long count) {
  Row row;
  std::mutex lock;
  std::atomic<long> next = 0;
  const auto work = [&] {
    for (long block; (block = next++) * kBlock < count;)
      add_block(regime, static_cast<unsigned>(1 + block), std::min(kBlock, count - block * kBlock), row, lock);
  };
  std::vector<std::thread> threads;
  for (unsigned k = 0; k < std::max(1u, std::thread::hardware_concurrency()); ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 1000;
  const bool verbose = std::getenv("EARTHTOP_WORST") != nullptr;
  fmt::print(
      "| regime | motions | worst error (rad) | worst error / (1e-13 + 4 eps phase + 4 eps kappa) | beyond it | "
      "worst error / statement | worst rate error / statement | statement too small |\n|---|---|---|---|---|---|---|---|\n");
  std::vector<Regime> regimes = lagrange_regimes();
  for (Regime& regime : free_body_regimes()) regimes.push_back(std::move(regime));
  for (const Regime& regime : regimes) {
    const auto named = [&](const char* part) { return regime.name.find(part) != std::string::npos; };
    if (argc > 2 && std::none_of(argv + 2, argv + argc, named)) continue;
    const Row row = run(regime, count);
    fmt::print("| {} | {} | {:.2g} | {:.2g} | {} | {:.2g} | {:.2g} | {} |\n", regime.name, row.count, row.error, row.used,
               row.beyond, row.tightness, row.rate_used, row.understated);
    if (verbose)
      fmt::print("    worst: {}\n    tightest statement: {}\n    loosest statement {:.2g}: {}\n", row.worst, row.tightest,
                 row.looseness, row.loosest);
    std::fflush(stdout);
  }
}
