// SPDX-License-Identifier: GPL-3.0-or-later
// Copies, moves and ends of a RunResult: much code, which sources that hold one would each compile for themselves.
#include "earthtop/run.hpp"

namespace earthtop {

RunResult::RunResult() = default;
RunResult::RunResult(const RunResult&) = default;
RunResult::RunResult(RunResult&&) noexcept = default;
RunResult& RunResult::operator=(const RunResult&) = default;
RunResult& RunResult::operator=(RunResult&&) noexcept = default;
RunResult::~RunResult() = default;

}  // namespace earthtop
