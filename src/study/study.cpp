// SPDX-License-Identifier: GPL-3.0-or-later
// Copies, moves and ends of a Study: much code, which sources that hold one would each compile for themselves.
#include "earthtop/study/study.hpp"

namespace earthtop {

Study::Study() = default;
Study::Study(const Study&) = default;
Study::Study(Study&&) noexcept = default;
Study& Study::operator=(const Study&) = default;
Study& Study::operator=(Study&&) noexcept = default;
Study::~Study() = default;

}  // namespace earthtop
