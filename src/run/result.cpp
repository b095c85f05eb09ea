// SPDX-License-Identifier: GPL-3.0-or-later
// Copy, move and destruction of a RunResult: compiled here once, so that other sources compile faster.
#include "earthtop/run.hpp"

namespace earthtop {

RunResult::RunResult() = default;
RunResult::RunResult(const RunResult&) = default;
RunResult::RunResult(RunResult&&) noexcept = default;
RunResult& RunResult::operator=(const RunResult&) = default;
RunResult& RunResult::operator=(RunResult&&) noexcept = default;
RunResult::~RunResult() = default;

}  // namespace earthtop
