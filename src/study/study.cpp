// SPDX-License-Identifier: GPL-3.0-or-later
// Constructors, assignments and destructor of Study: much code, compiled here once instead of in every source that holds one.
#include "earthtop/study/study.hpp"

namespace earthtop {

Study::Study() = default;
Study::Study(const Study&) = default;
Study::Study(Study&&) noexcept = default;
Study& Study::operator=(const Study&) = default;
Study& Study::operator=(Study&&) noexcept = default;
Study::~Study() = default;

}  // namespace earthtop
